// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A report by the keyboard alone: from the overview to the scoreboard, a scenario, its replay, a contact and the search. The
// focus is seen wherever it is, nothing holds it, and keys reach whatever a pointer may click.
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { reportOf, skip, smokeRun } from '../browser.ts';

/** The element that has the focus, and whether it is marked. */
interface Focused {
  name: string;
  isMarked: boolean;
}

describe('a report by the keyboard alone', { skip }, () => {
  const it = reportOf(smokeRun);
  const press = (key: string) => it.page.keyboard.press(key);
  const has = (selector: string) => it.page.evaluate((s) => document.activeElement?.matches(s) ?? false, selector);
  const focused = (): Promise<Focused> =>
    it.page.evaluate(() => {
      const at = document.activeElement as HTMLElement;
      const { outlineStyle, outlineWidth, boxShadow } = getComputedStyle(at);
      const marked = (outlineStyle !== 'none' && Number.parseFloat(outlineWidth) >= 1) || boxShadow !== 'none';
      const name = at.getAttribute('aria-label') ?? at.textContent?.slice(0, 30) ?? '';
      return { name: `${at.tagName.toLowerCase()} ${name}`, isMarked: marked || at === document.body };
    });

  /** Presses a key until a part has the focus, and finds each part on the way marked. */
  async function tabTo(selector: string, most: number, key = 'Tab'): Promise<void> {
    const passed: string[] = [];
    for (let i = 0; i < most; ++i) {
      await press(key);
      const { name, isMarked } = await focused();
      assert.ok(isMarked, `no mark of the focus at ${name}`);
      passed.push(name);
      if (await has(selector)) return;
    }
    assert.fail(`${selector} is not reached by ${key}: ${passed.join(' | ')}`);
  }
  const shown = () => it.page.getAttribute('#page', 'data-shown');
  /** Presses a key that opens another page. */
  async function follow(key: string): Promise<void> {
    const old = await shown();
    await press(key);
    await it.page.waitForFunction((was) => document.querySelector('#page')?.getAttribute('data-shown') !== was, old);
  }

  test('leads from the overview to a contact of a replay, and on by the search', async () => {
    await it.open();
    await tabTo('#top nav a[href="#scoreboard"]', 6);
    await follow('Enter');
    assert.match(it.page.url(), /#scoreboard$/);
    await tabTo('#page a[href^="#/scenario/box_stack"]', 120);
    await follow('Enter');
    await tabTo('.contents [data-section="replay"]', 16);
    await press('Enter');
    assert.ok(await has('#replay > h2'), 'its heading has the focus');
    await tabTo('#replay *', 1);
    await it.page.waitForFunction(() => document.activeElement?.matches('.replay canvas'));
    const time = async () => Number.parseFloat((await it.page.textContent('.replay .clock')) ?? '');
    await tabTo('.replay [data-action="play"]', 8);
    await press('Space');
    await it.page.waitForFunction(
      () => Number.parseFloat(document.querySelector('.replay .clock')?.textContent ?? '') > 0.1,
    );
    assert.ok(await has('.replay [data-action="play"]'), 'playing keeps the focus');
    await press('Space');
    await press('End');
    const end = await time();
    await press('ArrowLeft');
    assert.ok((await time()) < end, 'the arrow steps');
    await press('k');
    const contact = it.page.locator('.replay .inspector.pinned [data-quantity="contact"]');
    assert.match((await contact.textContent()) ?? '', /^0 of \d+$/);
    await press('k');
    assert.match((await contact.textContent()) ?? '', /^1 of \d+$/);
    await press('Shift+K');
    assert.match((await contact.textContent()) ?? '', /^0 of \d+$/);
    await it.page.waitForFunction(() => {
      const view = new URLSearchParams(location.hash.split('?')[1]).get('view') ?? '';
      return new URLSearchParams(view).get('c') === '0';
    });
    await press('s');
    assert.match((await it.text('.replay .inspector.pinned [data-quantity="body"]')) ?? '', /^box/);
    await press('/');
    assert.ok(await has('input[type="search"]'));
    await it.page.keyboard.type('free_flight');
    await follow('Enter');
    assert.match(it.page.url(), /#\/scenario\/free_flight/);
    it.clean();
  });

  test('the first key leads past the bar', async () => {
    await it.open();
    const address = it.page.url();
    await press('Tab');
    assert.ok(await has('a.skip'));
    const box = await it.page.locator('a.skip').boundingBox();
    assert.ok(box && box.x >= 0 && box.width > 50, 'it is seen while it has the focus');
    await press('Enter');
    assert.equal(it.page.url(), address, 'the page stays');
    await tabTo('#page *', 1);
    it.clean();
  });

  test('switches keep the focus, and it leaves the replay on both sides', async () => {
    await it.open('#/scenario/box_stack');
    await it.page.locator('#replay').scrollIntoViewIfNeeded();
    await it.page.waitForSelector('.replay .label small:not(:empty)');
    for (const name of ['trails', 'overlaid', 'follow', 'bullet:preset=matched']) {
      const chip = `.replay [data-switch="${name}"]`;
      if ((await it.page.locator(chip).count()) === 0) continue;
      await it.page.focus(chip);
      await press('Enter');
      assert.ok(await has(chip), `${name} keeps the focus`);
    }
    await it.page.focus('.replay select[aria-label="Colours"]');
    await press('ArrowDown');
    assert.ok(await has('.replay select[aria-label="Colours"]'), 'the list of colours keeps the focus');
    await it.page.focus('.replay canvas');
    await tabTo('body, #page section:not(#replay) *', 60);
    await it.page.focus('.replay canvas');
    await tabTo('#page section:not(#replay) *, #top *', 6, 'Shift+Tab');
    it.clean();
  });

  test('keys reach all that a pointer may click', async () => {
    for (const hash of ['', '#scoreboard', '#cost', '#contacts', '#/scenario/box_stack', '#/engine/rigor']) {
      await it.follow(hash);
      const unreached = await it.page.evaluate(() => {
        const keyed = 'a[href], button, input, select, textarea, summary, label, [tabindex]:not([tabindex="-1"])';
        return [...document.querySelectorAll<HTMLElement>('#top *, #page *')]
          .filter((e) => getComputedStyle(e).cursor === 'pointer' && !e.closest(keyed) && !e.querySelector(keyed))
          .map((e) => `${e.tagName.toLowerCase()}.${e.getAttribute('class')} ${e.textContent?.slice(0, 40)}`);
      });
      assert.deepEqual(unreached, [], hash || 'the overview');
    }
    it.clean();
  });
});
