// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A page of one scenario in one file, to send or to keep: the code, the style and the data of this page with nothing else
// beside it.

import { loadText } from '../../common/data_files.ts';
import { saveText } from '../../common/download.ts';
import type { Run } from '../data.ts';
import { loadLists } from '../loading.ts';
import { run } from '../run.ts';
import type { Context } from './context.ts';

/** Text that may stand in a script element. */
const inScript = (text: string) => text.replaceAll('<', '\\u003c');
/** An element as text. Its tags are put together here: the code of a page must not have those of scripts and styles. */
const element = (tag: string, attributes: string, content: string) => `<${tag}${attributes}>${content}</${tag}>`;
const jsonElement = (id: string, json: string) => element('script', ` type="application/json" id="${id}"`, json);
const escaped = (text: string) => text.replaceAll('&', '&amp;').replaceAll('<', '&lt;').replaceAll('"', '&quot;');

/** The run with one scenario and nothing about the others. */
export function runOfOne(whole: Run, name: string): Run {
  return {
    ...whole,
    single: name,
    title: name,
    scenarios: whole.scenarios.filter((s) => s.name === name),
    mechanisms: [],
    tasks: [],
    costs: [],
    insertionOrders: null,
    caseFiles: null,
    redCases: [],
    audit: whole.audit.filter((a) => a.scenario === name),
    bench: null,
  };
}

async function dataOf(name: string, as: string): Promise<string> {
  return jsonElement(`data-${as}`, JSON.stringify(await loadText(name)));
}

/** The text of the page; replays of time steps that have none are left out. */
export async function singleFile({ scenario, index, data }: Context): Promise<string> {
  const style = [...document.querySelectorAll('style')].map((s) => s.textContent ?? '').join('\n');
  const code = document.querySelector<HTMLScriptElement>('script[nonce]');
  const policy = document.querySelector('meta[http-equiv]')?.getAttribute('content') ?? '';
  await loadLists();
  const parts = [await dataOf(`scenario-${index}`, 'scenario-0')];
  const steps = new Set(data.cases.map((c) => c.dt)).size;
  for (let j = 0; j < steps; ++j)
    await dataOf(`replay-${index}-${j}`, `replay-0-${j}`).then(
      (part) => parts.push(part),
      () => {},
    );
  return [
    '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">',
    '<meta name="viewport" content="width=device-width, initial-scale=1">',
    '<meta name="color-scheme" content="light dark">',
    `<meta http-equiv="Content-Security-Policy" content="${escaped(policy)}">`,
    `${element('title', '', escaped(scenario.name))}\n<link rel="icon" href="data:,">`,
    `${element('style', '', style)}\n</head>\n<body>`,
    '<header id="top"></header>\n<main id="page"></main>\n<footer id="foot"></footer>',
    jsonElement('run-data', inScript(JSON.stringify(runOfOne(run, scenario.name)))),
    ...parts,
    element('script', ' nonce="rigor"', code?.textContent ?? ''),
    '</body>\n</html>\n',
  ].join('\n');
}

export async function saveSingleFile(context: Context): Promise<void> {
  saveText(`${context.scenario.name}.html`, await singleFile(context), 'text/html');
}
