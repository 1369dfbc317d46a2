// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The page of `rigor collide`: a case in 3D with the normals of its record, the wrong ones first, restored by the address.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { describe, test } from 'node:test';
import type { CollideRun } from '../../src/collide/data.ts';
import type { Point } from '../../src/common/finding.ts';
import { makeCollide, reportOf, screenshots, skip } from '../browser.ts';

describe('the page of collision queries', { skip }, () => {
  const it = reportOf(makeCollide);
  const record = () => JSON.parse(readFileSync(join(it.run, 'collide.json'), 'utf8')) as CollideRun;
  const away = ({ from, to }: { from: Point; to: Point }) => {
    const d = to.map((x, k) => x - (from[k] as number)) as Point;
    return d.map((x) => x / Math.hypot(...d)) as Point;
  };
  const arrows = (engine: string) =>
    it.page.evaluate((of) => {
      const root = document.querySelector('.replay') as unknown as {
        picture: { view: { drawn: (of: string) => { arrows: { from: Point; to: Point }[] } } };
      };
      return root.picture.view.drawn(of).arrows;
    }, engine);
  const open = async (name: string, engine: string) => {
    await it.open(`#${new URLSearchParams({ case: name, engine })}`);
    await it.page.waitForSelector('.replay .notes .exact:not(:empty)');
  };

  test('has a row for each engine, with what is wrong', async () => {
    await it.open();
    const rows = await it.page.locator('#summary tbody tr').allTextContents();
    assert.equal(rows.length, record().summary.length);
    await it.page.getByText('wrong ones only').locator('input').setChecked(false);
    assert.equal(await it.page.locator('#cases tbody tr').count(), record().cases.length);
    it.clean();
  });

  test('names the tolerances, and marks neither right nor wrong what was not answered', async () => {
    const text = async () => (await it.text('#summary p')) ?? '';
    await open('spheres_concentric', 'fcl');
    assert.match(await text(), /within 1e-9 m or 1e-6 of the distance/);
    assert.match(await text(), /box2d: single precision, so within 9\.5e-7 of the largest coordinate/);
    assert.equal(await it.text('#cases [data-engine="box2d"]'), '– box2d');
    assert.equal(await it.text('#cases [data-engine="rigor"]'), '✓ rigor');
    assert.equal(await it.text('#cases [data-engine="fcl"]'), '✗ fcl');
    it.clean();
  });

  test('an overlap without a normal has its depth', async () => {
    await open('spheres_concentric', 'fcl');
    assert.equal(await it.text('.replay .notes .engine'), 'no normal of fcl');
    assert.match(await it.text('.replay [data-quantity="depthEngine"]'), /^1500 mm$/);
    assert.equal(await it.text('.replay [data-quantity="normalEngine"]'), 'none');
    it.clean();
  });

  test('draws the normal of the engine and the exact one of each case', async () => {
    const cases = record().cases.filter(
      (c) => c.dimension === 3 && c.truth.witness_a && (c.truth.normals?.length ?? 0) === 1,
    );
    assert.ok(cases.length >= 2, `${cases.length} cases`);
    for (const c of cases.slice(0, 3))
      for (const answer of c.answers) {
        if (!answer.normal || !answer.witness_a) continue;
        await open(c.name, answer.engine);
        const [engine, exact] = (await arrows(answer.engine)).map(away);
        const apart = (a: Point | undefined, b: Point | undefined) =>
          Math.hypot(...(a ?? []).map((x, k) => x - (b?.[k] ?? 9)));
        assert.ok(apart(engine, answer.normal) < 1e-5, `${c.name}, ${answer.engine}`);
        assert.ok(apart(exact, c.truth.normals?.[0]) < 1e-5, `${c.name}, exact`);
      }
    await it.page.screenshot({ path: join(screenshots, 'collide.png') });
    it.clean();
  });

  test('another engine is a click away, and stands in the address', async () => {
    const c = record().cases[0];
    await open(c?.name ?? '', 'rigor');
    await it.page.click('#cases [data-engine="fcl"]');
    await it.page.waitForFunction(() => location.hash.includes('engine=fcl'));
    assert.equal(await it.page.getAttribute('#cases [data-engine="fcl"]', 'aria-pressed'), 'true');
    it.clean();
  });
});
