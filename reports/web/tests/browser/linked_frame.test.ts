// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A link of the contact audit opens the frame that was measured, and the contact that is shown there is the one that was
// measured: a ball on a plank that turns by 0.05 rad a step, whose exact normal is the plank's at that step.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';
import { launch, open, query, skip, watched } from '../browser.ts';

const spin = 3; // [rad/s]
const box = { box: { half_extents: [3, 0.2, 3] }, material: 'wood' };
const scene = {
  rigor: 1,
  name: 'turning_plank',
  title: 'A ball on a plank that turns',
  description: 'A plank is turned under a ball.',
  source: 'none',
  isolates: ['contact normals'],
  dimension: 3,
  gravity: [0, -9.81, 0],
  duration: 0.4,
  dt: [1 / 60],
  materials: { wood: { friction: 0.6, restitution: 0 } },
  bodies: [
    { name: 'plank', type: 'kinematic', angular_velocity: [0, 0, spin], shapes: [box] },
    { name: 'ball', mass: 1, position: [2, 0.499, 0], shapes: [{ sphere: { radius: 0.3 }, material: 'wood' }] },
  ],
  observe: ['ball'],
};

test('the frame that a link of the audit opens is the one that was measured', { skip }, async (t) => {
  const folder = mkdtempSync(join(tmpdir(), 'rigor-linked-'));
  t.after(() => rmSync(folder, { recursive: true, force: true }));
  const run = join(folder, 'run');
  const file = join(folder, 'turning_plank.json');
  writeFileSync(file, JSON.stringify(scene));
  const program = join(process.env.RIGOR_BINARY_DIR ?? '', 'bin/rigor');
  const asked = [file, '--engines', 'rigor:preset=default bullet:preset=default', '--dt', '1/60', '-q', '--out', run];
  try {
    execFileSync(program, ['validate', ...asked], { stdio: 'ignore' });
  } catch {
    // a missed bound is a red run, and as good a run to look at
  }
  const browser = await launch();
  t.after(() => browser.close());
  const { page, faults } = await watched(browser);
  const sql = "SELECT spec, worst, normal_error_max FROM cases JOIN audit ON case_id = id WHERE auditor = 'in_run'";
  const audits = query(run, sql) as [string, string, number][];
  assert.equal(audits.length, 2);
  for (const [spec, worst, measured] of audits) {
    await open(page, run);
    const links = page.locator('#in-run tbody td a');
    const hrefs = await links.evaluateAll((all) => all.map((a) => a.getAttribute('href') ?? ''));
    const place = hrefs.findIndex((href) => new URLSearchParams(href.split('?')[1]).get('spec') === spec);
    assert.ok(place >= 0, `${spec} in ${hrefs}`);
    const step = Number(/, step (\d+) /.exec(worst)?.[1]);
    assert.equal(new URLSearchParams((hrefs[place] as string).split('?')[1]).get('step'), String(step), worst);
    await links.nth(place).click();
    const shown = page.locator('.replay .inspector dd[data-quantity="normal"]');
    await shown.waitFor({ timeout: 60_000 });
    const [nx, ny] = ((await shown.textContent()) ?? '').replaceAll('−', '-').split(', ').map(Number) as [
      number,
      number,
    ];
    const when = await page.locator('.replay .inspector dd[data-quantity="time"]').textContent();
    assert.match(when ?? '', new RegExp(`step ${step}$`), 'the frame of the step');
    const exact = [-Math.sin((spin * step) / 60), Math.cos((spin * step) / 60)] as const;
    const angle = Math.atan2(Math.abs(exact[0] * ny - exact[1] * nx), exact[0] * nx + exact[1] * ny);
    assert.ok(Math.abs(angle - measured) < 1e-6, `${spec}: ${angle} shown, ${measured} measured, ${worst}`);
    // The address that the view writes finds the same frame, whatever digits its time has lost.
    await page.waitForFunction(() => location.hash.includes('view='));
    const view = new URLSearchParams(new URLSearchParams(page.url().split('?')[1]).get('view') ?? '');
    assert.equal(view.get('n'), String(step));
  }
  assert.deepEqual(faults, []);
});
