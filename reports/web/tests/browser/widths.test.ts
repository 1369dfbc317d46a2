// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Pages as wide as a laptop and as a telephone: nothing is cut, and what scrolls shows it.
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import type { Vec3 } from '../../src/replay/vectors.ts';
import { makeCollide, makeTwoRuns, reportOf, skip, smokeRun } from '../browser.ts';

const laptop = { width: 1366, height: 768 };
const telephone = { width: 390, height: 844 };

describe('a report on a laptop', { skip }, () => {
  const it = reportOf(smokeRun);

  test('names of engines stand beside their grades', async () => {
    await it.page.setViewportSize(laptop);
    await it.open();
    const parts = await it.page.locator('.ranking tbody tr:not(.why)').evaluateAll((rows) =>
      rows.map((row) => {
        const name = row.querySelector('th') as HTMLElement;
        name.textContent = 'chipmunk';
        const words = document.createRange();
        words.selectNodeContents(name);
        const [text, bar] = [words.getBoundingClientRect(), row.querySelector('.gradebar')?.getBoundingClientRect()];
        return { lines: words.getClientRects().length, gap: (bar?.left ?? Infinity) - text.right };
      }),
    );
    assert.ok(parts.length > 5);
    for (const { lines, gap } of parts) assert.ok(lines === 1 && gap >= 0, `${lines} lines, ${gap} px to the bar`);
    it.clean();
  });

  test('totals of the scoreboard are whole', async () => {
    await it.open('#scoreboard');
    const totals = it.page.locator('td.total .small');
    assert.match((await totals.first().textContent()) ?? '', /^\d+ of \d+ ≤ 1e-2 $|ran $/);
    const cut = await totals.evaluateAll(
      (all) =>
        all.filter((n) => n.scrollWidth > n.clientWidth + 1 || getComputedStyle(n).overflow !== 'visible').length,
    );
    assert.equal(cut, 0);
    it.clean();
  });

  test('a table that goes on beyond its card has a shadow at that edge alone', async () => {
    await it.open('#cost');
    const table = it.page.locator('#timing .scroll').first();
    const edge = async (side: 'left' | 'right') => {
      await it.page.waitForTimeout(100);
      const box = await table.boundingBox();
      assert.ok(box);
      const clip = {
        x: side === 'left' ? box.x + 1 : box.x + box.width - 3,
        y: box.y + box.height - 12,
        width: 2,
        height: 2,
      };
      const picture = await it.page.screenshot({ clip });
      return it.page.evaluate(async (bytes) => {
        const image = new Image();
        image.src = `data:image/png;base64,${bytes}`;
        await image.decode();
        const pen = document.createElement('canvas').getContext('2d') as CanvasRenderingContext2D;
        pen.drawImage(image, 0, 0);
        return (pen.getImageData(0, 0, 1, 1).data[0] as number) < 235;
      }, picture.toString('base64'));
    };
    await table.evaluate((n) => {
      (n.firstElementChild as HTMLElement).style.minWidth = '2000px';
      n.scrollIntoView({ block: 'end' });
    });
    assert.deepEqual([await edge('left'), await edge('right')], [false, true], 'at its start');
    await table.evaluate((n) => n.scrollTo(1e4, 0));
    assert.deepEqual([await edge('left'), await edge('right')], [true, false], 'at its end');
    it.clean();
  });

  test('the list of keys opens below the bar', async () => {
    await it.open('#/scenario/box_stack');
    await it.page.locator('#replay').scrollIntoViewIfNeeded();
    await it.page.waitForSelector('.replay .label small:not(:empty)');
    await it.page.locator('.replay canvas').focus();
    await it.page.locator('.replay .stage').evaluate((n) => scrollBy(0, n.getBoundingClientRect().top + 200));
    await it.page.keyboard.press('?');
    const [help, bar] = [
      await it.page.locator('.replay .help').boundingBox(),
      await it.page.locator('#top').boundingBox(),
    ];
    assert.ok(help && bar);
    assert.ok(help.y >= bar.y + bar.height, `${help.y} below ${bar.y + bar.height}`);
    assert.ok(help.y + help.height <= laptop.height);
    it.clean();
  });
});

describe('a report on a telephone', { skip }, () => {
  const it = reportOf(smokeRun);

  test('wrong normals have the link to their frame in sight', async () => {
    await it.page.setViewportSize(telephone);
    await it.open('#contacts');
    const links = await it.page
      .locator('#worst-normals a.frame')
      .evaluateAll((all) => all.map((a) => a.getBoundingClientRect().right));
    assert.ok(links.length > 0);
    for (const right of links) assert.ok(right <= telephone.width, `${right} px`);
    it.clean();
  });
});

describe('two runs on a telephone', { skip }, () => {
  const it = reportOf(makeTwoRuns);

  test('have labels that do not overlap', async () => {
    await it.page.setViewportSize(telephone);
    await it.open();
    await it.page.getByLabel('Scenario').fill('box_stack');
    await it.page.locator('article[data-scenario="box_stack"] select').first().selectOption({ index: 1 });
    await it.page.waitForSelector('.replay .label small:not(:empty)');
    const labels = it.page.locator('.replay .label');
    assert.equal(await labels.count(), 2);
    const beyond = await labels.evaluateAll((all) => all.map((n) => n.scrollWidth - n.clientWidth));
    assert.ok(Math.max(...beyond) <= 1, beyond.join());
    it.clean();
  });
});

describe('a collision query on a telephone', { skip }, () => {
  const it = reportOf(makeCollide);

  test('has both shapes in its picture', async () => {
    await it.page.setViewportSize(telephone);
    await it.open(`#${new URLSearchParams({ case: 'spheres_concentric', engine: 'fcl' })}`);
    await it.page.waitForSelector('.replay .notes .exact:not(:empty)');
    const outside = await it.page.evaluate(
      (points) => {
        const { view } = (document.querySelector('.replay') as never as { picture: { view: Projecting } }).picture;
        interface Projecting {
          panels: { sources: unknown[] }[];
          project: (source: unknown, at: Vec3) => [number, number];
        }
        const canvas = document.querySelector('.replay canvas') as HTMLElement;
        const source = view.panels[0]?.sources[0];
        return points
          .map((p) => view.project(source, p))
          .filter(([x, y]) => !(x >= 0 && y >= 0 && x <= canvas.clientWidth && y <= canvas.clientHeight));
      },
      [0, 1, 2].flatMap((k) => [-1, 1].map((s) => [0, 0, 0].map((_, i) => (i === k ? s : 0)) as Vec3)),
    );
    assert.deepEqual(outside, []);
    it.clean();
  });
});
