// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A link of the contact audit draws what it is about: the engine's normal, the exact one, the angle and the points of the
// stored finding, from near, one engine alone, nothing covered; the address restores it.
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { makeRunOf, query, reportOf, skip, smokeRun, watched } from '../browser.ts';

type Vec = [number, number, number];
interface Stored {
  what: string;
  error: number;
  step: number;
  said: { normal: Vec; depth: number; pointA: Vec; pointB: Vec };
  exact: { distance: number; normals: Vec[]; pointA: Vec; pointB: Vec };
}

const angleOf = (a: Vec, b: Vec) => {
  const dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const cross = Math.hypot(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
  return Math.atan2(cross, dot);
};

describe('a finding of the audit is drawn', { skip }, () => {
  const it = reportOf(smokeRun);

  /** The worst finding of a kind of all runs. */
  function worst(what: string): { scenario: string; spec: string; found: Stored } {
    const rows = query(
      it.run,
      "SELECT c.scenario, c.spec, a.findings FROM audit a JOIN cases c ON c.id = a.case_id WHERE a.auditor = 'in_run' AND a.findings <> ''",
    ) as [string, string, string][];
    const all = rows.flatMap(([scenario, spec, text]) =>
      (JSON.parse(text) as Stored[]).filter((f) => f.what === what).map((found) => ({ scenario, spec, found })),
    );
    assert.ok(all.length > 0, `a ${what} error is in the run`);
    return all.reduce((a, b) => (b.found.error > a.found.error ? b : a));
  }

  /** Opens it by its link in the audit of the scenario. */
  async function follow(what: string): Promise<ReturnType<typeof worst>> {
    const found = worst(what);
    await it.open(`#/scenario/${found.scenario}`);
    const link = `#case-audit tr.own a[data-finding="${what}"][href*="${encodeURIComponent(found.spec)}"]`;
    await it.page.click(link);
    await it.page.waitForSelector('.replay .inspector.pinned [data-quantity="finding"]');
    return found;
  }
  const drawn = (spec: string) =>
    it.page.evaluate((of) => {
      const root = document.querySelector('.replay') as unknown as {
        stage: { view: { drawn: (of: string) => { arrows: { from: Vec; to: Vec }[] } } };
      };
      return root.stage.view.drawn(of).arrows;
    }, spec);
  const cell = async (name: string) =>
    Number.parseFloat((await it.text(`.replay .inspector.pinned [data-quantity="${name}"]`)).replaceAll('−', '-'));

  test('the worst normal and the exact one, with the angle between them', async () => {
    const { spec, found } = await follow('normal');
    const [engine, exact] = (await drawn(spec)).map(({ from, to }) => to.map((x, k) => x - (from[k] as number)) as Vec);
    assert.ok(engine && exact, 'two arrows');
    assert.ok(angleOf(engine, found.said.normal) < 1e-5, 'the first is the normal of the engine');
    const nearest = Math.min(...found.exact.normals.map((n) => angleOf(exact, n)));
    assert.ok(nearest < 1e-5, 'the second is an exact one');
    const label = Number.parseFloat(await it.text('.replay .notes .angle'));
    const degrees = (found.error * 180) / Math.PI;
    assert.ok(Math.abs(label - degrees) < 0.006 * degrees, `${label}° is shown, ${degrees}° was measured`);
    assert.ok(Math.abs((await cell('angle')) - degrees) < 0.006 * degrees);
    it.clean();
  });

  test('one engine is shown, and the numbers stand beside the picture', async () => {
    await follow('normal');
    assert.equal(await it.page.locator('.replay .label').count(), 1);
    const boxes = await Promise.all(
      ['.replay canvas', '.replay .inspector.pinned'].map((s) => it.page.locator(s).boundingBox()),
    );
    const [picture, numbers] = boxes;
    assert.ok(picture && numbers && numbers.x >= picture.x + picture.width, JSON.stringify(boxes));
    for (const kind of ['engine', 'exact', 'angle']) {
      const note = await it.page.locator(`.replay .notes .${kind}`).boundingBox();
      assert.ok(note && note.x > picture.x && note.x + note.width < picture.x + picture.width, `${kind} is in view`);
      assert.ok(note.y > picture.y && note.y + note.height < picture.y + picture.height, `${kind} is in view`);
    }
    it.clean();
  });

  test('the worst depth, beside the exact one', async () => {
    const { found } = await follow('depth');
    const near = (shown: number, value: number) =>
      assert.ok(Math.abs(shown - value) <= 1e-5 * Math.abs(value) + 1e-9, `${shown} is shown, ${value} is stored`);
    near(await cell('depthEngine'), 1000 * found.said.depth);
    near(await cell('depthExact'), -1000 * found.exact.distance);
    assert.match(await it.text('.replay .notes .measure'), /^depth .*, exact /);
    it.clean();
  });

  test('the copied address goes to the replay and restores the finding', async () => {
    await follow('normal');
    const shown = await it.text('.replay .notes .angle');
    await it.page.waitForFunction(() => location.hash.includes('view='));
    const hash = await it.page.evaluate(() => location.hash);
    const other = await watched(it.browser);
    await other.page.goto(`file://${it.run}/index.html${hash}`);
    await other.page.waitForSelector('.replay .inspector.pinned [data-quantity="finding"]');
    await other.page.waitForFunction(
      (text) => document.querySelector('.replay .notes .angle')?.textContent === text,
      shown,
    );
    const top = await other.page.locator('#replay').evaluate((node) => node.getBoundingClientRect().top);
    assert.ok(Math.abs(top) < 200, `${top} px from the top`);
    assert.deepEqual(other.faults, []);
    await other.close();
  });

  test('it belongs to its frame alone', async () => {
    await follow('normal');
    await it.page.evaluate(() => {
      const root = document.querySelector('.replay') as unknown as { stage: { step: (forward: boolean) => void } };
      root.stage.step(true);
    });
    await it.page.waitForFunction(() => !document.querySelector('.replay .notes .angle')?.textContent);
    assert.equal(await it.page.locator('.replay [data-quantity="finding"]').count(), 0);
    it.clean();
  });
});

describe('a metric of normals is drawn', { skip }, () => {
  const it = reportOf(() => makeRunOf('normals', 'pile_2d', '--engines', 'bullet'));

  test('the number of the metric of normals leads to the point whose normal was the worst', async () => {
    const rows = query(
      it.run,
      `SELECT c.scenario, c.spec, c.dt, m.value, a.findings FROM metrics m JOIN cases c ON c.id = m.case_id JOIN audit a ON a.case_id = c.id
       WHERE m.name = 'normal_error' AND m.subject = '' AND a.auditor = 'in_run' AND a.findings <> '' ORDER BY m.value DESC`,
    ) as [string, string, number, number, string][];
    const row = rows.find(([, , , value, text]) =>
      (JSON.parse(text) as Stored[]).some((f) => f.what.endsWith('normal') && Math.abs(f.error - value) < 1e-7),
    );
    assert.ok(row, 'the audit has the point of a metric');
    const [scenario, spec, dt, value] = row;
    await it.open(`#/scenario/${scenario}?dt=${dt}`);
    const cell = `#metrics tr[data-metric="normal_error"][data-subject=""] td[data-spec="${spec}"] a.moment`;
    await it.page.click(cell);
    await it.page.waitForSelector('.replay .notes .angle:not(:empty)');
    const label = Number.parseFloat(await it.text('.replay .notes .angle'));
    const degrees = (value * 180) / Math.PI;
    assert.ok(Math.abs(label - degrees) < 0.006 * degrees, `${label}° is shown, ${degrees}° is the metric`);
    it.clean();
  });

  test('the list of wrong normals leads to the same point', async () => {
    await it.open('#contacts');
    const link = it.page.locator('#worst-normals tr[data-what="point_normal"] a.frame').first();
    const listed = Number.parseFloat((await link.textContent()) ?? '');
    await link.click();
    await it.page.waitForSelector('.replay .notes .angle:not(:empty)');
    const label = Number.parseFloat(await it.text('.replay .notes .angle'));
    assert.ok(Math.abs(label - listed) < 0.006 * listed, `${label}° is shown, ${listed}° is listed`);
    assert.ok(await it.page.evaluate(() => document.activeElement?.matches('.replay canvas, .replay-place')));
    it.clean();
  });
});
