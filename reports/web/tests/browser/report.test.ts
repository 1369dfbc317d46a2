// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The report of a real run, from disk, with the network cut: opens quickly, filters, sorts, opens cases, switches
// engines, and shows the numbers that the store holds.
import assert from 'node:assert/strict';
import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { describe, test } from 'node:test';
import { open, query, reportOf, screenshots, skip, smokeRun, watched } from '../browser.ts';

describe('the report of a real run', { skip }, () => {
  const it = reportOf(smokeRun);
  const rows = () => it.page.locator('#scoreboard tbody tr[data-scenario]').count();
  const shown = () => it.page.waitForSelector('#page[data-shown]');

  test('opens with a row for every scenario and a cell for every engine', async () => {
    await it.open();
    const elements = await it.page.evaluate(() => document.querySelectorAll('*').length);
    assert.ok(elements < 2000, `it opens soon: ${elements} elements`); // 700 were measured
    assert.ok(await it.page.locator('#trust [data-task="sliding"]').isVisible());
    const answer = await it.text('#trust [data-task="sliding"] .answer');
    const named = /^First: (\w+).* Next, each engine by its best preset: (.*)\.$/s.exec(answer);
    const engines = [named?.[1], ...(named?.[2] ?? '').split(', ').map((label) => label.split(' ')[0])];
    assert.ok(engines.length > 1 && new Set(engines).size === engines.length, answer);
    assert.match(await it.text('#trust'), /at least half as many scenarios as the one that completed most/);
    await it.page.screenshot({ path: join(screenshots, 'overview.png') });
    await it.open('#scoreboard');
    const names = query(it.run, 'SELECT name FROM scenarios ORDER BY position').flat();
    assert.deepEqual((await it.page.locator('#scoreboard tbody th a').allTextContents()).sort(), names.sort());
    const specs = query(it.run, 'SELECT count(DISTINCT spec) FROM cases').flat()[0] as number;
    assert.equal(await it.page.locator('#scoreboard a.cell').count(), names.length * specs);
    assert.match((await it.page.locator('body').textContent()) ?? '', /authors of one of the engines/);
    await it.page.screenshot({ path: join(screenshots, 'scoreboard.png') });
    it.clean();
  });

  test('has a row of totals, a heading for each task, and says which engine knows one dimension only', async () => {
    await it.open('#scoreboard');
    const spec = 'bullet:preset=matched';
    const graded = query(
      it.run,
      `SELECT count(*) FROM cases c WHERE spec = '${spec}' AND grade <> '' AND dt = (SELECT min(dt) FROM cases WHERE scenario = c.scenario)`,
    ).flat()[0];
    const near = query(
      it.run,
      `SELECT count(*) FROM cases c WHERE spec = '${spec}' AND grade IN ('A', 'B', 'C') AND dt = (SELECT min(dt) FROM cases WHERE scenario = c.scenario)`,
    ).flat()[0];
    assert.match(
      await it.text(`#scoreboard tr.totals [data-spec="${spec}"]`),
      new RegExp(`${near} of ${graded} ≤ 1e-2`),
    );
    const headings = await it.page.locator('#scoreboard tr.task-group th').allTextContents();
    assert.ok(
      headings.some((text) => text.startsWith('A sliding box')),
      headings.join('; '),
    );
    assert.match(await it.text('#scoreboard thead th.group:has(a[href="#/engine/box2d"])'), /2D only/);
    assert.match(await it.text('#scoreboard thead th.group:has(a[href="#/engine/bullet"])'), /3D and plane/);
    assert.doesNotMatch(await it.text('#scoreboard thead th.group:has(a[href="#/engine/rigor"])'), /only/);
    await it.page.locator('#scoreboard').getByLabel('Groups').selectOption('none');
    assert.equal(await it.page.locator('#scoreboard tr.task-group').count(), 0);
    assert.match(it.page.url(), /group=none/);
    it.clean();
  });

  test('hides engines and puts one first, and the address keeps it', async () => {
    await it.open('#scoreboard');
    const heads = () => it.page.locator('#scoreboard thead th.group a').allTextContents();
    const all = await heads();
    const [first, last] = [all[0] ?? '', all.at(-1) ?? ''];
    assert.ok(all.length > 2, all.join());
    await it.page.locator('.engines > summary').click();
    await it.page.locator('.engines').getByRole('checkbox', { name: first, exact: true }).uncheck();
    assert.deepEqual(await heads(), all.slice(1));
    await it.page
      .locator('.engines')
      .getByRole('button', { name: `${last} first`, exact: true })
      .click();
    assert.deepEqual(await heads(), [last, ...all.slice(1, -1)]);
    assert.match(it.page.url(), new RegExp(`hide=${first}&pin=${last}`));
    await it.page.reload();
    await it.page.waitForSelector('#page[data-shown]');
    assert.deepEqual(await heads(), [last, ...all.slice(1, -1)]);
    await it.page.locator('#scoreboard').getByRole('button', { name: 'Reset' }).click();
    assert.deepEqual(await heads(), all);
    it.clean();
  });

  test('terms say what they mean', async () => {
    await it.open('#scoreboard');
    const term = it.page.locator('#scoreboard abbr.term', { hasText: 'Grade' }).first();
    assert.match((await term.getAttribute('title')) ?? '', /Class of accuracy/);
    await it.open('#glossary');
    assert.match(await it.text('#glossary dl'), /Witness points/);
    assert.match(await it.text('#glossary'), /max_t \|x\(t\) - x_exact\(t\)\|/);
    it.clean();
  });

  test('the name of a metric leads to its formula, and Back to the table', async () => {
    await it.open('#/scenario/free_flight');
    await it.page.locator('#metrics tr[data-metric="position_max"] th a').first().click();
    await it.page.waitForSelector('#glossary');
    assert.match(it.page.url(), /#term-position_max$/);
    await it.page.waitForFunction(() => document.activeElement?.id === 'term-position_max');
    await it.page.goBack();
    await it.page.waitForSelector('#metrics tr[data-metric="position_max"]');
    it.clean();
  });

  test('tables and plots of a scenario are linked where they are files', async () => {
    await it.open('#/scenario/free_flight');
    const links = async (of: string) =>
      it.page.locator(`[data-files="${of}"] a`).evaluateAll((all) => all.map((a) => a.getAttribute('href') ?? ''));
    const tables = await links('tables');
    const plots = await links('plots');
    assert.deepEqual(
      tables.map((file) => file.split('.').at(-1)),
      ['csv', 'md', 'tex'],
    );
    const plot = 'plots/free_flight-position_error';
    assert.deepEqual(plots, [`${plot}.svg`, `${plot}.pdf`, `${plot}.csv`]);
    for (const file of [...tables, ...plots]) assert.ok(existsSync(join(it.run, file)), file);
    const drawing = readFileSync(join(it.run, plots[0] as string), 'utf8');
    assert.match(drawing, />position error of [a-z]+, time step 1\/\d+ s</, 'it says of which body');
    it.clean();
  });

  test('counts grades and changes as the store does, and never together', async () => {
    await it.open();
    const texts = async (what: string) =>
      (await it.page.locator(`#summary [data-count="${what}"] .stat b`).allTextContents()).map((t) => t.trim());
    const grades = query(
      it.run,
      "SELECT CASE grade WHEN '' THEN '–' ELSE grade END || ' ' || count(*) FROM cases WHERE outcome = 'completed' GROUP BY grade",
    ).flat();
    assert.deepEqual((await texts('accuracy')).sort(), grades.sort());
    const changes = query(it.run, 'SELECT count(*) FROM cases GROUP BY regression').flat().map(String);
    assert.deepEqual((await texts('regression')).sort(), changes.sort());
    it.clean();
  });

  test('a scenario says what is claimed of every run', async () => {
    await it.open('#/scenario/slide_and_stop');
    const rows = it.page.locator('#verdicts tbody tr');
    const ran = query(
      it.run,
      "SELECT count(*) FROM cases WHERE scenario = 'slide_and_stop' AND outcome = 'completed'",
    ).flat()[0];
    assert.equal(await rows.count(), ran);
    for (const claim of await rows.locator('td.claim:nth-of-type(2)').allTextContents())
      assert.match(claim, /^Grade [A-E] at 1\/\d+ s, by its worst error: .*(scheme|known)/);
    it.clean();
  });

  test('a run that is far off names the settings that are not as requested', async () => {
    const rows = query(
      it.run,
      `SELECT c.scenario, c.spec, c.dt FROM cases c JOIN ledger l ON l.case_id = c.id
       WHERE c.grade IN ('D', 'E') AND c.verdict <> 'known deviation' AND l.realisation <> 'exact' LIMIT 1`,
    ) as [string, string, number][];
    const [scenario, spec, dt] = rows[0] ?? assert.fail('smoke has such a run');
    await it.open(`#/scenario/${scenario}?dt=${dt}`);
    const said = it.page.locator(`#verdicts tr[data-spec="${spec}"] [data-inexact] abbr`);
    assert.ok((await said.count()) > 0);
    assert.ok(await said.first().getAttribute('title'), 'with the value that the engine has');
    it.clean();
  });

  test('filters and sorts', async () => {
    await it.open('#scoreboard');
    const all = await rows();
    const planar = query(it.run, 'SELECT count(*) FROM scenarios WHERE dimension = 2').flat()[0];
    await it.page.getByLabel('Dimension').selectOption('2');
    assert.equal(await rows(), planar);
    await it.page.getByLabel('Dimension').selectOption('');
    await it.page.getByLabel('Search', { exact: true }).fill('slid');
    assert.equal(await rows(), 1);
    assert.match(it.page.url(), /#scoreboard\?text=slid$/);
    await it.page.getByRole('button', { name: 'Reset' }).click();
    assert.equal(await rows(), all);
    await it.page.locator('#scoreboard').getByLabel('Preset').selectOption('matched');
    const columns = query(it.run, "SELECT count(DISTINCT spec) FROM cases WHERE preset = 'matched'").flat()[0];
    assert.equal(
      await it.page.locator('#scoreboard tbody tr[data-scenario]').first().locator('a.cell').count(),
      columns,
    );
    await it.page.getByRole('button', { name: 'Reset' }).click();
    await it.page.getByLabel('Ending', { exact: true }).selectOption('known_deviation');
    const deviating = query(
      it.run,
      "SELECT count(DISTINCT scenario) FROM cases WHERE verdict = 'known deviation'",
    ).flat()[0];
    assert.equal(await rows(), deviating);
    await it.page.getByRole('button', { name: 'Reset' }).click();
    await it.page.getByLabel('Grade', { exact: true }).selectOption('C');
    assert.equal(await rows(), query(it.run, "SELECT count(DISTINCT scenario) FROM cases WHERE grade = 'C'").flat()[0]);
    await it.page.getByRole('button', { name: 'Reset' }).click();
    await it.page.locator('#scoreboard thead th').first().getByRole('button').click();
    const sorted = await it.page.locator('#scoreboard tbody th a').allTextContents();
    assert.deepEqual(sorted, [...sorted].sort());
    it.clean();
  });

  test('a tab has its place and filters in the address, and Back returns to them', async () => {
    await it.open('#scoreboard?dimension=3&sort=name&descending=true&none=1');
    const names = () => it.page.locator('#scoreboard tbody th a').allTextContents();
    const first = await names();
    assert.deepEqual(first, [...first].sort().reverse());
    assert.equal(
      first.length,
      query(it.run, 'SELECT count(*) FROM scenarios WHERE dimension = 3').flat()[0],
      'those of the address alone',
    );
    await it.page.setViewportSize({ width: 1400, height: 400 });
    await it.page.evaluate(() => scrollTo(0, 300));
    await it.page.waitForFunction(() => history.state?.scrolled === 300);
    await it.page.locator('#scoreboard tbody th a').nth(3).click();
    await it.page.waitForSelector('#metrics');
    await it.page.goBack();
    await it.page.waitForSelector('#scoreboard');
    await it.page.waitForFunction(() => scrollY === 300);
    assert.deepEqual(await names(), first);
    await it.page.setViewportSize({ width: 1400, height: 1000 });
    await it.page.getByRole('link', { name: 'Cost', exact: true }).click();
    await it.page.waitForSelector('#timing');
    assert.equal(await it.page.locator('#scoreboard, #trust, #ledger').count(), 0, 'a tab alone');
    assert.equal(await it.page.locator('#top nav [aria-current]').textContent(), 'Cost');
    it.clean();
  });

  test('the search of the header opens scenarios, engines, tabs and lists', async () => {
    await it.open('#method');
    const searched = async (text: string, selector: string) => {
      await it.page.keyboard.press('/');
      await it.page.keyboard.type(text);
      await it.page.keyboard.press('Enter');
      await it.page.waitForSelector(selector);
      await it.page.evaluate(() => (document.activeElement as HTMLElement | null)?.blur());
    };
    await searched('slide_and_stop', '#metrics');
    await searched('bullet', '#capabilities');
    await searched('Contacts', '#in-run');
    await searched('bounc', '#scoreboard');
    for (const name of await it.page.locator('#scoreboard tbody th a').allTextContents()) assert.match(name, /bounc/);
    it.clean();
  });

  test('arrow keys go from cell to cell, and Enter opens one', async () => {
    await it.open('#scoreboard');
    await it.page.getByRole('button', { name: 'Reset' }).click();
    await it.page.locator('#scoreboard a.cell').first().focus();
    await it.page.keyboard.press('ArrowDown');
    await it.page.keyboard.press('ArrowRight');
    const href = await it.page.evaluate(() => document.activeElement?.getAttribute('href'));
    const second = it.page.locator('#scoreboard tbody tr[data-scenario]').nth(1).locator('a.cell').nth(1);
    assert.equal(href, await second.getAttribute('href'));
    await it.page.keyboard.press('Enter');
    await it.page.waitForSelector('#metrics, #outcomes');
    it.clean();
  });

  test('a scenario shows what the store holds', async () => {
    const scenario = 'slide_and_stop';
    await it.open(`#/scenario/${scenario}`);
    const stored = query(
      it.run,
      `SELECT c.spec, m.name, m.subject, m.value, m.bound FROM metrics m JOIN cases c ON c.id = m.case_id WHERE c.scenario = '${scenario}'`,
    ) as [string, string, string, number | string, number | null][];
    assert.ok(stored.length > 50);
    const cells = await it.page.locator('#metrics td[data-spec]').evaluateAll((list) =>
      list.map((td) => {
        const tr = td.closest('tr') as HTMLElement;
        const data = (td as HTMLElement).dataset;
        return [data.spec, tr.dataset.metric, tr.dataset.subject, data.value] as string[];
      }),
    );
    const found = new Map(cells.map(([spec, name, subject, value]) => [`${spec} ${name} ${subject}`, value]));
    let compared = 0;
    for (const [spec, name, subject, value] of stored) {
      const text = found.get(`${spec} ${name} ${subject}`);
      assert.equal(String(text), String(value), `${spec} ${name} ${subject}`);
      ++compared;
    }
    assert.ok(compared >= 10);
    const timings = query(
      it.run,
      `SELECT c.spec, t.median FROM timings t JOIN cases c ON c.id = t.case_id WHERE c.scenario = '${scenario}' AND t.phase = 'step'`,
    ) as [string, number][];
    for (const [spec, median] of timings) {
      const title = await it.page
        .locator(`#case-timing tr[data-spec="${spec}"][data-phase="step"] td.num`)
        .first()
        .getAttribute('title');
      assert.equal(title, `${median} s`);
    }
    const commands = query(it.run, `SELECT command FROM cases WHERE scenario = '${scenario}'`).flat();
    const listed = await it.page.locator('#commands code').allTextContents();
    assert.deepEqual([...listed].sort(), [...commands].sort());
    it.clean();
  });

  test('a scenario has its formula as mathematics, a drawing and curves that are drawn', async () => {
    await it.open('#/scenario/slide_and_stop');
    assert.ok((await it.page.locator('#scenario .katex').count()) > 0, 'set by KaTeX');
    assert.ok((await it.page.locator('#scenario svg.scene polygon').count()) > 5);
    await it.page.locator('#curves').scrollIntoViewIfNeeded();
    const canvas = it.page.locator('#curves canvas').first();
    await canvas.waitFor();
    const inked = await canvas.evaluate((node) => {
      const c = node as HTMLCanvasElement;
      return c
        .getContext('2d')
        ?.getImageData(0, 0, c.width, c.height)
        .data.some((v) => v !== 0);
    });
    assert.equal(inked, true);
    await it.page.evaluate(() => scrollTo(0, 0));
    await it.page.screenshot({ path: join(screenshots, 'scenario.png') });
    it.clean();
  });

  test('the curves that are used most are there', async () => {
    await it.open('#/scenario/box_stack');
    const plots = await it.page
      .locator('#curves .chart')
      .evaluateAll((list) => list.map((c) => (c as HTMLElement).dataset.plot));
    for (const name of ['energy', 'penetration', 'contact normal error'])
      assert.ok(plots.includes(name), `${name} among ${plots}`);
    it.clean();
  });

  test('switching an engine off holds for all charts', async () => {
    await it.open('#/scenario/slide_and_stop');
    // A replay that arrives moves what stands below it away from under the pointer.
    await it.page.locator('#replay').scrollIntoViewIfNeeded();
    await it.page.waitForSelector('.replay .label small:not(:empty)');
    const box = it.page.locator('#switches input').first();
    const ink = () =>
      it.page
        .locator('#curves canvas')
        .first()
        .evaluate((node) => (node as HTMLCanvasElement).toDataURL());
    await it.page.locator('#curves').scrollIntoViewIfNeeded();
    await it.page.locator('#curves canvas').first().waitFor();
    let before = '';
    for (let now = await ink(); now !== before; now = await ink()) {
      before = now;
      await it.page.waitForTimeout(200); // it is drawn once more where the page has moved
    }
    await box.uncheck();
    await it.page.waitForFunction(
      (old) => (document.querySelector('#curves canvas') as HTMLCanvasElement).toDataURL() !== old,
      before,
    );
    await it.page.getByRole('button', { name: 'all', exact: true }).click();
    await it.page.waitForFunction(() => document.querySelector<HTMLInputElement>('#switches input')?.checked === true);
    it.clean();
  });

  test('the worst of a contact audit is three clicks away, and sets the time', async () => {
    await it.open('#contacts');
    const worst = it.page.locator('#in-run tbody td a').first();
    const requested = new URLSearchParams(((await worst.getAttribute('href')) ?? '').split('?')[1]);
    await worst.click();
    await it.page.waitForSelector('#curves');
    await shown();
    const read = await it.page.locator('output.time').textContent();
    assert.ok(
      Math.abs(Number(read?.match(/[\d.e-]+/)?.[0]) - Number(requested.get('t'))) < 1e-3,
      `${read} ${requested}`,
    );
    const link = it.page.locator('#case-audit a.moment').last();
    await link.click();
    const text = (await link.textContent()) ?? '';
    const now = await it.page.locator('output.time').textContent();
    assert.ok(
      Math.abs(Number(now?.match(/[\d.e-]+/)?.[0]) - Number.parseFloat(text.split('t = ')[1] ?? '')) < 1e-3,
      `${now} ${text}`,
    );
    it.clean();
  });

  test('an engine has a page with its capabilities, ledger and failures', async () => {
    await it.open('#/engine/bullet');
    for (const id of ['engine', 'strengths', 'deviations', 'engine-ledger', 'capabilities'])
      assert.ok(await it.page.locator(`#${id}`).isVisible(), id);
    const deviating = query(
      it.run,
      "SELECT count(*) FROM cases WHERE engine = 'bullet' AND verdict = 'known deviation'",
    ).flat()[0];
    assert.match(
      (await it.page.locator('#deviations').textContent()) ?? '',
      new RegExp(deviating ? `Wrong physics with a reason on file: ${deviating}` : ''),
    );
    await it.page.screenshot({ path: join(screenshots, 'engine.png') });
    for (const [name, stored] of query(it.run, "SELECT name, capabilities FROM engines WHERE capabilities != ''")) {
      const { presets, options } = JSON.parse(stored as string) as { presets: string[]; options: unknown[] };
      if (options.length === 0) continue;
      await it.follow(`#/engine/${name}`);
      const heads = await it.page.locator('#capabilities thead th').allTextContents();
      assert.deepEqual(heads.slice(1, -2), presets, `a column for every preset of ${name}`);
    }
    it.clean();
  });

  test('a narrow and a dark page have nothing to scroll sideways but their tables', async () => {
    for (const options of [{ viewport: { width: 400, height: 900 } }, { colorScheme: 'dark' as const }]) {
      const other = await watched(it.browser, options);
      for (const hash of ['#/scenario/pendulum_chain', '#/engine/bullet', '']) {
        await open(other.page, it.run, hash);
        const wider = await other.page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
        assert.ok(wider <= 0, `${hash}: ${wider} px too wide`);
      }
      if (options.colorScheme) await other.page.screenshot({ path: join(screenshots, 'overview-dark.png') });
      assert.deepEqual(other.faults, []);
      await other.close();
    }
  });
});
