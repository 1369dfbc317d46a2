// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The page of `rigor history`: what changed comes first, with its numbers and statistics; filters stand in the address.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { describe, test } from 'node:test';
import type { History } from '../../src/history/data.ts';
import { caseKey, firstMoment } from '../../src/history/series.ts';
import { figureOf, makeHistory, makeRunOf, makeTwoRuns, program, reportOf, screenshots, skip } from '../browser.ts';

function dataOf(folder: string): History {
  const page = readFileSync(join(folder, 'index.html'), 'utf8');
  return JSON.parse(/id="history-data">(.*?)<\/script>/s.exec(page)?.[1] ?? '') as History;
}

describe('the history of three runs', { skip }, () => {
  const it = reportOf(makeHistory);
  const stored = (): History => dataOf(it.run);

  test('names the runs, and says of each step what changed', async () => {
    await it.open();
    assert.deepEqual(
      await it.page.locator('#runs tbody tr td:nth-child(2)').allTextContents(),
      stored().runs.map((r) => r.name),
    );
    assert.match(await it.text('#changes > div'), /no case in common. rigor history RUN RUN --pair dt, spec or engine/);
    const change = stored().changes[1];
    assert.ok(change);
    const text = await it.text('#changes .change');
    assert.ok(text.includes(change.metrics[0]?.scenario ?? '?'), text.slice(0, 200));
    assert.match(text, /×1\.2 \(1\.10 … 1\.30\)slower/);
    const heads = await it.page.locator('#changes .change th[scope="col"]').allTextContents();
    assert.deepEqual(heads.slice(4, 7), ['Cases better', 'worse', 'p of cases']);
    const cells = await it.page.locator('#changes .change tbody td').allTextContents();
    assert.deepEqual(cells.slice(0, 6), ['0', '15', '19', '0', '1', '1'], 'fifteen errors of one case are one case');
    assert.match(
      await it.text('#scenarios'),
      /times of its engine over all cases \(What changed\) are slower or faster/,
    );
    assert.equal(await it.page.locator('#changes code').count(), 3, 'commands are marked up');
    await it.page.screenshot({ path: join(screenshots, 'history.png'), fullPage: true });
    it.clean();
  });

  test('saves a plot that was never in view, without the lines that have no value', async () => {
    await it.open();
    const card = it.page.locator('#scenarios .chart').last();
    assert.equal(await card.locator('canvas').count(), 0, 'it is far below');
    const svg = await it.page.evaluate(
      () =>
        new Promise<string>((done) => {
          URL.createObjectURL = (blob) => {
            void (blob as Blob).text().then(done);
            return 'data:,';
          };
          const menu = [...document.querySelectorAll<HTMLSelectElement>('#scenarios .chart select.save')].at(-1);
          if (!menu) return;
          menu.value = 'svg';
          menu.dispatchEvent(new Event('change'));
        }),
    );
    const figure = await figureOf(it.page, svg);
    assert.ok(figure.lines.length > 0);
    assert.ok(
      figure.samples.every((n) => n > 0),
      figure.samples.join(),
    );
    for (const run of ['1', '2', '3']) assert.ok(figure.texts.includes(run), figure.texts.join());
    assert.ok(figure.texts.includes('time of a step [s]'));
    it.clean();
  });

  test('shows what is neither worse nor better, and opens the rest of a long list', async () => {
    await it.open();
    const verdict = it.page.locator('#changes .change li').first();
    assert.match((await verdict.textContent()) ?? '', /^◆ .*pass → unsupported, no such joint/);
    assert.equal(await verdict.locator('.other').getAttribute('aria-label'), 'other');
    const errors = it.page.locator('#changes .change li:has(.worse)');
    assert.equal(await errors.count(), 12);
    assert.match(
      (await errors.first().textContent()) ?? '',
      new RegExp(`▼ .*${stored().changes[1]?.metrics[0]?.spec}`),
    );
    await it.page.click('#changes summary');
    await errors.nth(14).waitFor();
    assert.equal(await errors.count(), stored().changes[1]?.metrics.length);
    assert.match(await it.text('#scenarios article li'), /^◆ run 3/, 'endings come first');
    it.clean();
  });

  test('the scenario that changed comes first, with the factors of error and time', async () => {
    await it.open();
    const first = it.page.locator('#scenarios article').first();
    assert.equal(await first.getAttribute('data-scenario'), stored().changes[1]?.metrics[0]?.scenario);
    const text = (await first.locator('ul').textContent()) ?? '';
    assert.match(text, /▼ run 3, .*: error ×4/);
    assert.match(text, /▼ run 3, .*: time ×2 /);
    assert.equal(await first.locator('.chart').count(), 2);
    assert.match(await it.text('#scenarios [role="status"]'), /, 1 with a change/);
    it.clean();
  });

  test('filters stand in the address', async () => {
    await it.open();
    const name =
      stored().series.find((s) => /^\w+$/.test(s.scenario) && s.scenario !== stored().series[0]?.scenario)?.scenario ??
      '';
    await it.page.getByLabel('Scenario').fill(name);
    const found = await it.page
      .locator('#scenarios article')
      .evaluateAll((all) => all.map((a) => a.getAttribute('data-scenario')));
    assert.ok(found.includes(name) && found.every((other) => other?.includes(name)), found.join());
    const hash = await it.page.evaluate(() => location.hash);
    await it.open(hash);
    assert.equal(await it.page.locator('#scenarios article').count(), found.length);
    it.clean();
  });
});

describe('two runs with their replays', { skip }, () => {
  const it = reportOf(makeTwoRuns);

  test('show a case of both side by side, by one clock; the address keeps it', async () => {
    await it.open();
    const box = it.page.locator('article[data-scenario="box_stack"] select');
    await it.page.getByLabel('Scenario').fill('box_stack');
    await box.first().selectOption({ index: 1 });
    await it.page.waitForSelector('.replay .label small:not(:empty)');
    assert.equal(await it.page.locator('.replay .label b:not(.ghost)').count(), 2);
    const stateOf = async () => await it.page.locator('.replay .label small').allTextContents();
    const [first] = await stateOf();
    assert.doesNotMatch(first ?? '', /^t = 0 s/, 'the runs are shown where they are worst, not at their start');
    await it.page.click('.replay [data-action="back"]');
    await it.page.waitForFunction(
      (before) => [...document.querySelectorAll('.replay .label small')].every((node) => node.textContent !== before),
      first,
    );
    const states = await stateOf();
    assert.equal(states.length, 2);
    assert.equal(states[0], states[1]);
    await it.page.screenshot({ path: join(screenshots, 'two_runs.png') });
    const hash = await it.page.evaluate(() => location.hash);
    await it.open(hash);
    await it.page.waitForSelector('.replay .label small:not(:empty)');
    assert.match(await it.text('.replay .label b'), /^run 1, smoke/);
    it.clean();
  });

  test('are shown at their end where there is no error, or none whose time is known', async () => {
    const unknown = dataOf(it.run).series.find(
      (s) => firstMoment(s, [0, 1]) === Infinity && s.outcome[0] === 'completed' && s.replay.every(Boolean),
    );
    assert.ok(unknown);
    await it.open(`#${new URLSearchParams({ replay: caseKey(unknown) })}`);
    await it.page.waitForSelector('.replay .label small:not(:empty)');
    assert.match(await it.text('.replay .label small'), /frame (\d+)\/\1/);
    it.clean();
  });
});

describe('two runs that differ in their time step', { skip }, () => {
  const it = reportOf(() => {
    const run = (name: string, dt: string) =>
      makeRunOf(name, 'box_stack', '--engines', 'rigor:preset=matched,ode:preset=matched', '--dt', dt);
    const folder = join(run('coarse', '1/60'), '..', 'steps');
    const fine = run('fine', '1/120');
    program('bin/rigor', 'history', join(folder, '..', 'coarse'), fine, '--pair', 'dt', '--out', folder);
    return folder;
  });

  test('are named by it in the table, the list, the lines and the replays', async () => {
    await it.open();
    assert.deepEqual(await it.page.locator('#runs tbody tr td:nth-child(5)').allTextContents(), ['1/60 s', '1/120 s']);
    assert.match(await it.text('#runs h2'), /differ in the time step/);
    assert.match(await it.text('#changes h2'), /What differs/);
    assert.match(await it.text('#changes .change li'), /1\/60 s → 1\/120 s: /);
    assert.deepEqual(await it.page.locator('article .lines span').allTextContents(), [
      'rigor: 1/60 s → 1/120 s',
      'ode: 1/60 s → 1/120 s',
    ]);
    await it.page.locator('#changes .to-replay').first().click();
    await it.page.waitForSelector('.replay .label small:not(:empty)');
    const labels = await it.page.locator('.replay .label b:not(.ghost)').allTextContents();
    assert.equal(labels.length, 2);
    assert.match(labels[0] ?? '', /^run 1, coarse: .*, 1\/60 s$/);
    assert.match(labels[1] ?? '', /^run 2, fine: .*, 1\/120 s$/);
    await it.page.screenshot({ path: join(screenshots, 'steps.png') });
    it.clean();
  });
});
