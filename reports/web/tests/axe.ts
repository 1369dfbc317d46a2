// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A page by the rules of axe-core: contrast, names of controls, headings, tables; light and dark, on a desktop and a phone.
import { readFileSync } from 'node:fs';
import type { Page } from 'playwright-core';

const axe = readFileSync(require.resolve('axe-core/axe.min.js'), 'utf8');
const wide = { width: 1400, height: 900 };
const narrow = { width: 390, height: 844 };
const colours = { runOnly: ['color-contrast', 'link-in-text-block'] };
/** All rules at both widths, and those about colours in each colour scheme at each width. */
const looks = [
  { colorScheme: 'light', viewport: wide, rules: {} },
  { colorScheme: 'dark', viewport: wide, rules: colours },
  { colorScheme: 'dark', viewport: narrow, rules: {} },
  { colorScheme: 'light', viewport: narrow, rules: colours },
] as const;

interface Finding {
  id: string;
  impact: string;
  nodes: { html: string }[];
}

/** Findings of the page that is open, a line each: "serious color-contrast, 3: <first element>". */
export async function axeFindings(page: Page): Promise<string[]> {
  const lines: string[] = [];
  if (await page.evaluate(() => !('axe' in window))) await page.evaluate(axe);
  for (const { colorScheme, viewport, rules } of looks) {
    await page.emulateMedia({ colorScheme });
    await page.setViewportSize(viewport);
    // Charts follow the page's width when they are notified of it, on a busy machine some seconds later.
    const fits = page.waitForFunction((w) => document.documentElement.scrollWidth <= w, viewport.width);
    const found = (await fits.then(
      () =>
        page.evaluate(`axe.run(document, ${JSON.stringify({ resultTypes: ['violations'], ...rules })})
        .then((r) => r.violations)`),
      async () => [{ id: 'width', impact: 'serious', nodes: [{ html: 'the page' }] }],
    )) as Finding[];
    for (const f of found)
      lines.push(`${colorScheme}, ${viewport.width} px: ${f.impact} ${f.id}, ${f.nodes.length}: ${f.nodes[0]?.html}`);
  }
  return lines;
}
