// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The ten audited contacts with the largest errors of each kind: the link, the numbers beside the picture, and the arrows
// and witness points in it, each compared with the finding in the store.
import assert from 'node:assert/strict';
import { before, describe, test } from 'node:test';
import { angleBetween, type ContactFinding, nearestExact, type Point } from '../../src/common/finding.ts';
import { query, reportOf, skip, smokeRun } from '../browser.ts';

type Audited = { scenario: string; spec: string; dt: number; auditor: string; found: ContactFinding };
interface Drawn {
  arrows: { from: Point; to: Point }[];
  witnesses: Point[];
}

const most = 10;
const minus = (a: Point, b: Point) => a.map((x, k) => x - (b[k] as number)) as Point;
const near = (shown: number, stored: number, share: number, least: number, what: string) =>
  assert.ok(Math.abs(shown - stored) <= share * Math.abs(stored) + least, `${what}: ${shown}, ${stored} is stored`);

describe('the largest errors of contacts', { skip }, () => {
  const it = reportOf(smokeRun);
  before(() => it.page.setDefaultTimeout(60_000));

  /** The largest of a kind, of runs and of collision engines that were queried at their poses. */
  function largest(what: ContactFinding['what']): Audited[] {
    const rows = query(
      it.run,
      "SELECT c.scenario, c.spec, c.dt, a.auditor, a.findings FROM audit a JOIN cases c ON c.id = a.case_id WHERE a.findings <> '' AND a.auditor NOT LIKE '%|%'",
    ) as [string, string, number, string, string][];
    const all = rows.flatMap(([scenario, spec, dt, auditor, text]) =>
      (JSON.parse(text) as ContactFinding[])
        .filter((found) => found.what === what)
        .map((found) => ({ scenario, spec, dt, auditor, found })),
    );
    return all.sort((a, b) => b.found.error - a.found.error).slice(0, most);
  }

  /** Follows the link of a finding in the audit of its scenario; returns the link's text. */
  async function follow({ scenario, spec, dt, auditor, found }: Audited): Promise<string> {
    await it.open(`#/scenario/${scenario}?dt=${dt}`);
    const key = `${auditor}~${found.what}`;
    const link = it.page.locator(`#case-audit a[data-finding="${found.what}"]`);
    const index = await link.evaluateAll(
      (all, wanted) =>
        all.findIndex((a) => {
          const asked = new URLSearchParams((a.getAttribute('href') ?? '').split('?')[1]);
          return asked.get('spec') === wanted.spec && asked.get('finding') === wanted.key;
        }),
      { spec, key },
    );
    assert.ok(index >= 0, `${scenario}, ${spec}: a link to ${key}`);
    const text = (await link.nth(index).textContent()) ?? '';
    await link.nth(index).click();
    await it.page.waitForSelector('.replay .inspector.pinned [data-quantity="finding"]');
    return text;
  }

  const drawn = (spec: string) =>
    it.page.evaluate((of) => {
      const root = document.querySelector('.replay') as unknown as {
        stage: { view: { drawn: (of: string) => Drawn } };
      };
      return root.stage.view.drawn(of);
    }, spec);

  /** Numbers of a row beside the picture; [] where it says that there is none. */
  async function cells(name: string): Promise<number[]> {
    const text = await it.text(`.replay .inspector.pinned [data-quantity="${name}"]`);
    if (/none|unknown/.test(text)) return [];
    return text.replaceAll('−', '-').split(',').map(Number.parseFloat);
  }
  async function assertCells(name: string, stored: readonly number[] | undefined): Promise<void> {
    const shown = await cells(name);
    assert.equal(shown.length, stored?.length ?? 0, name);
    shown.forEach((x, k) => {
      near(x, stored?.[k] as number, 1e-6, 1e-9, name);
    });
  }

  async function compare(audited: Audited): Promise<void> {
    const { scenario, spec, auditor, found } = audited;
    const { said, exact } = found;
    const where = `${scenario}, ${spec}, ${auditor}, ${found.what}`;
    assert.ok(exact, where);
    const text = await follow(audited);
    const number = Number.parseFloat(/ (\S+?)(?:°| m):/.exec(text)?.[1]?.replaceAll('−', '-') ?? '');
    const shown = found.unit === 'rad' ? (180 / Math.PI) * found.error : found.error;
    near(number, shown, 6e-3, 0, `${where}, link "${text}"`);

    // beside the picture
    await assertCells('normalEngine', said?.normal);
    await assertCells('depthEngine', said ? [1000 * said.depth] : undefined);
    await assertCells('depthExact', [-1000 * exact.distance]);
    await assertCells('witnessAEngine', said?.pointA);
    await assertCells('witnessBEngine', said?.pointB);
    await assertCells('witnessAExact', exact.pointA);
    await assertCells('witnessBExact', exact.pointB);

    // in the picture, whose numbers are in single precision
    const { arrows, witnesses } = await drawn(spec);
    const [first, second] = arrows.map(({ from, to }) => minus(to, from));
    const [engine, truth] = said ? [first, second] : [undefined, first];
    const nearest = nearestExact(found);
    assert.ok(truth && nearest && angleBetween(truth, nearest) < 1e-4, `${where}: the exact normal`);
    assert.equal(engine !== undefined, said !== null, where);
    if (engine && said) {
      assert.ok(angleBetween(engine, said.normal) < 1e-4, `${where}: the engine's normal`);
      if (found.what === 'normal') near(angleBetween(engine, truth), found.error, 0, 2e-4, `${where}: the angle`);
    } else assert.match(await it.text('.replay .notes .engine'), /no contact/);
    const points = [...(said ? [said.pointA, said.pointB] : []), exact.pointA, exact.pointB].filter((p) =>
      p.every(Number.isFinite),
    );
    assert.equal(witnesses.length, points.length, `${where}: witness points`);
    points.forEach((p, i) => {
      assert.ok(Math.hypot(...minus(p, witnesses[i] as Point)) < 1e-5, `${where}: witness point ${i}`);
    });
    if (found.what === 'missed' && !said)
      near(Math.hypot(...minus(exact.pointA, exact.pointB)), found.error, 1e-3, 1e-9, `${where}: the overlap`);
  }

  for (const what of ['normal', 'depth'] as const)
    test(`of the ${what}: link, numbers and picture are those of the store`, async () => {
      const all = largest(what);
      assert.equal(all.length, most);
      for (const one of all) await compare(one);
      it.clean();
    });

  test('of what was missed or invented', async () => {
    for (const one of [...largest('missed'), ...largest('spurious')]) await compare(one);
    it.clean();
  });
});
