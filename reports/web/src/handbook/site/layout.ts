// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The frame around the text of a page: contents, language, neighbours. Everything that a page loads lies in the folder
// of the site.
import { type Language, words } from './contents.ts';
import { commandOf, type SceneFence } from './fences.ts';
import { codeBlock, coloured, escaped } from './markup.ts';
import { chineseMetrics, chineseUnits } from './metric_titles.ts';
import type { RunResult } from './record.ts';

export interface NavigationItem {
  path: string; // path from the root of the site
  title: string;
}

export interface Frame {
  language: Language;
  path: string; // path of this page from the root of the site
  title: string;
  name: string; // title of the handbook
  home: string;
  parts: { title: string; pages: NavigationItem[] }[];
  otherLanguage: string | null; // path of the same page
  version: string;
}

const policy =
  "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data:; font-src data:; base-uri 'none'; form-action 'none'";

export const rootOf = (path: string): string => '../'.repeat(path.split('/').length - 1);

export function documentHtml(frame: Frame, body: string): string {
  const root = rootOf(frame.path);
  const w = words[frame.language];
  const flat = frame.parts.flatMap((part) => part.pages);
  const at = flat.findIndex((item) => item.path === frame.path);
  const link = (item: NavigationItem) =>
    `<li><a href="${root}${item.path}"${item.path === frame.path ? ' aria-current="page"' : ''}>${item.title}</a></li>`;
  const contents = frame.parts
    .map((part) => `<h2>${escaped(part.title)}</h2><ol>${part.pages.map(link).join('')}</ol>`)
    .join('\n');
  const neighbour = (item: NavigationItem | undefined, label: (title: string) => string) =>
    item ? `<a href="${root}${item.path}">${label(item.title)}</a>` : '<span></span>';
  const other = frame.otherLanguage
    ? `<a class="language" lang="${frame.language === 'en' ? 'zh' : 'en'}" href="${root}${frame.otherLanguage}">${w.other}</a>`
    : '';
  return `<!DOCTYPE html>
<html lang="${frame.language === 'zh' ? 'zh-Hans' : 'en'}">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<meta http-equiv="Content-Security-Policy" content="${policy}">
<title>${escaped(frame.title)} · ${escaped(frame.name)}</title>
<link rel="icon" href="data:,">
<link rel="stylesheet" href="${root}assets/handbook.css">
<script src="${root}assets/handbook.js"></script>
</head>
<body>
<header class="bar"><a class="name" href="${root}${frame.home}">${escaped(frame.name)}</a><span class="room"></span>${other}<button type="button" id="theme" aria-label="${w.theme}" title="${w.theme}">◐</button></header>
<div class="layout">
<nav class="contents" aria-label="${w.contents}"><details open><summary>${w.contents}</summary>${contents}</details></nav>
<main>
${body}
<div class="turn">${at >= 0 ? neighbour(flat[at - 1], (t) => `← ${t}`) : ''}${at >= 0 ? neighbour(flat[at + 1], (t) => `${t} →`) : ''}</div>
</main>
</div>
<footer>${w.made} ${escaped(frame.version)}</footer>
</body>
</html>
`;
}

const icon = (path: string, kind: string) =>
  `<svg class="${kind}" viewBox="0 0 24 24" aria-hidden="true"><path d="${path}"/></svg>`;

/** Three significant digits; very small and large ones with a power of ten. */
export function shown(value: number | null): string {
  if (value === null) return '—';
  if (value === 0) return '0';
  const size = Math.abs(value);
  if (size >= 0.01 && size < 1e5) return String(Number(value.toPrecision(3)));
  return value.toExponential(1).replace('e', ' · 10^').replace('+', '');
}

const prefixes = [
  ['', 1],
  ['m', 1e-3],
  ['µ', 1e-6],
  ['n', 1e-9],
] as const;

/** A value in a multiple of its unit that leaves digits before the point: 0.00123 m is "1.23 mm". */
export function shownIn(value: number | null, unit: string): string {
  const size = Math.abs(value ?? 0);
  const found = /^(m|s|m\/s|J|rad|rad\/s)$/.test(unit) ? prefixes.find(([, factor]) => size >= 0.1 * factor) : null;
  const [prefix, factor] = found ?? prefixes[0];
  const number = shown(value === null ? null : value / factor);
  return unit === '1' || value === null ? number : `${number} ${prefix}${unit}`;
}

function metricHtml(name: string, result: RunResult | null, language: Language): string {
  const [metric = '', subject = ''] = name.split('@');
  const found = result?.metrics.find((m) => m.name === metric && m.subject === subject);
  if (result && !found) throw new Error(`scene: the run has no metric ${name}`);
  const unit = found && language === 'zh' ? (chineseUnits[found.unit] ?? found.unit) : found?.unit;
  const text = found ? shownIn(found.value, unit as string) : '–';
  const title = language === 'zh' ? `${escaped(chineseMetrics[metric] ?? '')} ` : '';
  const html = escaped(text).replace(/10\^(-?\d+)/, '10<sup>$1</sup>');
  return `<dt>${title}<code>${escaped(name)}</code></dt><dd>${html}</dd>`;
}

/** A scene with its players; without results (a check of the sources) its numbers are left out. */
export function sceneHtml(scene: SceneFence, results: (RunResult | null)[], path: string, language: Language): string {
  const w = words[language];
  const data = (name: string, value: string | null) => (value === null ? '' : ` data-${name}="${escaped(value)}"`);
  const panels = scene.sides.map((side, i) => {
    const result = results[i] ?? null;
    const metrics = scene.metrics.map((m) => metricHtml(m, result, language)).join('');
    const label = escaped(side.label);
    return `<div class="panel"><div class="panel-label">${label}</div><canvas role="img" aria-label="${w.picture}: ${label}" data-run="${result?.id ?? ''}"></canvas>${metrics ? `<dl>${metrics}</dl>` : ''}</div>`;
  });
  const button = (kind: string, label: string, ...icons: string[]) =>
    `<button type="button" class="${kind}" aria-label="${label}" title="${label}">${icons.join('')}</button>`;
  const commands = scene.sides.map((side) => commandOf(side.run)).join('\n');
  return `<figure class="scene"${data('folder', `${rootOf(path)}data`)}${data('view', scene.view && JSON.stringify(scene.view))}${data('trail', scene.trail.length > 0 ? JSON.stringify(scene.trail) : null)}${data('contacts', scene.contacts ? 'yes' : null)}${data('side', scene.side ? 'yes' : null)}${data('seconds', scene.seconds === null ? null : String(scene.seconds))}>
<div class="panels" style="--count:${scene.sides.length}">${panels.join('')}</div>
<noscript><p class="muted">${w.noScript}</p></noscript>
<div class="controls">${button('play', w.play, icon('M7 4v16l13-8z', 'start'), icon('M6 4h4v16H6zM14 4h4v16h-4z', 'pause'))}${button('back', w.back, icon('M18 5v14l-10-7zM5 5h2.5v14H5z', ''))}${button('next', w.next, icon('M6 5v14l10-7zM16.500 5H19v14h-2.500z', ''))}<input type="range" min="0" max="1" value="0" step="any" aria-label="${w.time}"><output>0.00 s</output></div>
<figcaption>${escaped(scene.caption)}<details><summary>${w.commands}</summary>${codeBlock(commands, 'sh', w.copy)}</details></figcaption>
</figure>
`;
}

/** A whole source file with anchors of its lines. */
export function sourceHtml(file: string, text: string): string {
  const lang = /\.(cpp|hpp|def)$/.test(file) ? 'cpp' : file.endsWith('.json') ? 'json' : 'text';
  // Colours may span lines; each line gets the spans that are open where it begins.
  const open: string[] = [];
  const lines = coloured(text.replace(/\n$/, ''), lang)
    .split('\n')
    .map((line) => {
      const before = open.join('');
      for (const tag of line.match(/<span[^>]*>|<\/span>/g) ?? []) {
        if (tag === '</span>') open.pop();
        else open.push(tag);
      }
      return `${before}${line}${'</span>'.repeat(open.length)}`;
    });
  const rows = lines.map((line, i) => `<span class="line" id="L${i + 1}">${line}</span>`).join('');
  return `<h1>${escaped(file)}</h1>\n<div class="code wide"><pre class="source" tabindex="0"><code class="hljs">${rows}</code></pre></div>`;
}
