// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The ten audited contacts of a run with the largest errors, up to five of normals, the others of depths, each opened by its
// link: what is drawn is the stored contact, and the angle or depth measured in the picture is the stored number.
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import type { ContactFinding, Point } from '../../src/common/finding.ts';
import { query, reportOf, skip, smokeRun } from '../browser.ts';

interface Audited {
  scenario: string;
  spec: string;
  auditor: string; // engine that was queried for the frame; in_run: the one that ran
  found: ContactFinding;
}
interface Shown {
  arrows: { from: Point; to: Point }[];
  witnesses: Point[];
}

const minus = (a: Point, b: Point) => a.map((x, k) => x - (b[k] as number)) as Point;
const dot = (a: Point, b: Point) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const unit = (a: Point) => a.map((x) => x / Math.hypot(...a)) as Point;
/** Angle of two unit vectors [rad], exact where it is small. */
const angleOf = (a: Point, b: Point) =>
  2 * Math.atan2(Math.hypot(...minus(a, b)), Math.hypot(...a.map((x, k) => x + (b[k] as number))));

describe('the contacts with the largest errors', { skip }, () => {
  const it = reportOf(smokeRun);

  /** The largest errors of a kind, the largest first, one of each engine in a scenario. */
  function largest(what: ContactFinding['what']): Audited[] {
    const rows = query(
      it.run,
      "SELECT c.scenario, c.spec, a.auditor, a.findings FROM audit a JOIN cases c ON c.id = a.case_id WHERE a.findings <> ''",
    ) as [string, string, string, string][];
    const all = rows.flatMap(([scenario, spec, auditor, text]) =>
      (JSON.parse(text) as ContactFinding[])
        .filter((f) => f.what === what)
        .map((found) => ({ scenario, spec, auditor, found })),
    );
    return all.sort((a, b) => b.found.error - a.found.error);
  }
  /** The ten contacts, by what is wrong. */
  function ten(): { normals: Audited[]; depths: Audited[] } {
    const normals = largest('normal').slice(0, 5);
    const depths = largest('depth').slice(0, 10 - normals.length);
    assert.ok(normals.length >= 3 && normals.length + depths.length === 10, `${normals.length} + ${depths.length}`);
    return { normals, depths };
  }

  /** Opens a finding by its link in the audit of its scenario; what the picture has of it. */
  async function opened({ scenario, spec, auditor, found }: Audited): Promise<Shown> {
    await it.follow(`#/scenario/${scenario}`);
    const links = await it.page
      .locator('#case-audit a[data-finding]')
      .evaluateAll((all) => all.map((link) => link.getAttribute('href') ?? ''));
    const link = links.find((href) => {
      const wanted = new URLSearchParams(href.split('?')[1]);
      return wanted.get('spec') === spec && wanted.get('finding') === `${auditor}~${found.what}`;
    });
    assert.ok(link, `${scenario} links to ${found.what} of ${auditor} in ${spec}`);
    await it.follow(link);
    await it.page.waitForFunction(
      ([of, step]) => {
        const title = document.querySelector('.replay .inspector.pinned dd[data-quantity="time"]')?.textContent;
        return title?.endsWith(`step ${step}`) && document.querySelector('.replay .label b')?.textContent && of;
      },
      [spec, found.step] as const,
    );
    await it.page.waitForSelector('.replay .inspector.pinned [data-quantity="finding"]');
    return it.page.evaluate((of) => {
      const root = document.querySelector('.replay') as unknown as {
        stage: { view: { drawn: (of: string) => Shown } };
      };
      const { arrows, witnesses } = root.stage.view.drawn(of);
      return { arrows, witnesses };
    }, spec);
  }
  const near = (a: Point, b: Point) => Math.hypot(...minus(a, b)) < 1e-5 * (1 + Math.hypot(...b)); // drawn in float32
  const directionsOf = ({ arrows }: Shown) => arrows.map(({ from, to }) => unit(minus(to, from)));

  test('the angle between the normals that are drawn is the stored error', async () => {
    for (const audited of ten().normals) {
      const { scenario, spec, auditor, found } = audited;
      const at = `${scenario}, ${spec}, ${auditor}, step ${found.step}`;
      const shown = await opened(audited);
      const [engine, exact] = directionsOf(shown);
      assert.ok(engine && exact, `${at}: two normals`);
      const angle = angleOf(engine, exact);
      assert.ok(Math.abs(angle - found.error) < 2e-6 + 1e-5 * found.error, `${at}: ${angle} for ${found.error} rad`);
      assert.ok(near(engine, found.said?.normal as Point), at);
      const who = await it.text('.replay .inspector.pinned .who');
      assert.equal(who.startsWith(`${auditor}, queried at the poses of `), auditor !== 'in_run', `${at}: ${who}`);
    }
    it.clean();
  });

  test('the depths that are drawn are the stored ones, and differ by the stored error', async () => {
    for (const audited of ten().depths) {
      const { scenario, spec, auditor, found } = audited;
      const at = `${scenario}, ${spec}, ${auditor}, step ${found.step}`;
      assert.ok(found.said && found.exact, at);
      const shown = await opened(audited);
      const points = [found.said.pointA, found.said.pointB, found.exact.pointA, found.exact.pointB];
      assert.equal(shown.witnesses.length, points.length, at);
      for (const [k, point] of points.entries())
        assert.ok(near(shown.witnesses[k] as Point, point), `${at}: point ${k}`);
      const [a, b] = shown.witnesses.slice(2) as [Point, Point];
      const slack = 4e-7 * (1 + Math.hypot(...a));
      const depth = dot(minus(a, b), directionsOf(shown)[1] as Point);
      assert.ok(Math.abs(depth + found.exact.distance) < slack, `${at}: ${depth} m drawn, ${-found.exact.distance}`);
      const cell = async (name: string) =>
        Number.parseFloat((await it.text(`.replay .inspector.pinned [data-quantity="${name}"]`)).replaceAll('−', '-'));
      for (const [name, value] of [
        ['depthEngine', found.said.depth],
        ['depthExact', -found.exact.distance],
      ] as const) {
        const read = (await cell(name)) / 1000; // in mm there, six digits
        assert.ok(Math.abs(read - value) < 1e-5 * Math.abs(value) + 1e-12, `${at}: ${name} ${read} for ${value} m`);
      }
      const error = Math.abs(found.said.depth + found.exact.distance);
      assert.ok(Math.abs(error - found.error) < 1e-9, `${at}: ${error} for ${found.error} m`);
    }
    it.clean();
  });
});
