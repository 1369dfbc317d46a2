// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The interface of the engine from the comments of its headers: what engine.hpp includes. A declaration is shown with
// the comment before it (///) or behind it (///<).
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { type Language, words } from './contents.ts';
import { coloured, escaped } from './markup.ts';
import { referenceWords } from './reference_words.ts';

export interface Declaration {
  line: number;
  code: string;
  comment: string;
}

export interface Header {
  file: string;
  purpose: string; // comment at the head of the file
  declarations: Declaration[];
}

const commentOf = (line: string) => line.replace(/^\s*\/\/[/!]?<?\s?/, '');

export function readHeader(file: string, text: string): Header {
  const lines = text.split('\n');
  const head: string[] = [];
  for (const line of lines) {
    if (!line.startsWith('//')) break;
    if (!line.includes('SPDX')) head.push(commentOf(line));
  }
  const declarations: Declaration[] = [];
  for (let i = 0; i < lines.length; ++i) {
    const line = lines[i] as string;
    const behind = line.match(/^(\s*\S.*?)\s*\/\/\/<\s?(.*)$/);
    if (behind && !/^\s*\/\//.test(line)) {
      let comment = behind[2] as string;
      let next = i + 1;
      while (/^\s*\/\/\/<?/.test(lines[next] ?? '') && (lines[next] as string).search(/\S/) > 12)
        comment += ` ${commentOf(lines[next++] as string)}`;
      declarations.push({ line: i + 1, code: (behind[1] as string).trim(), comment });
      continue;
    }
    if (!/^\s*\/\/\/(?!<)/.test(line)) continue;
    const comment: string[] = [];
    while (/^\s*\/\/\/(?!<)/.test(lines[i] ?? '')) comment.push(commentOf(lines[i++] as string));
    const first = i;
    const code: string[] = [];
    while (i < lines.length && code.length < 8) {
      code.push((lines[i] as string).trim());
      if (/[;{}]\s*(\/\/.*)?$/.test(lines[i] as string)) break;
      ++i;
    }
    const joined = code
      .join('\n')
      .replace(/\s*\{[\s\S]*$/, '')
      .replace(/;?\s*(\/\/.*)?$/, '');
    if (joined) declarations.push({ line: first + 1, code: joined, comment: comment.join(' ') });
  }
  return { file, purpose: head.join('\n').trim(), declarations };
}

export function apiHtml(root: string, language: Language): string {
  const included = [
    ...readFileSync(join(root, 'engine/engine.hpp'), 'utf8').matchAll(/#include "(engine\/[^"]+)"/g),
  ].map((m) => m[1] as string);
  const more = ['engine/state/world_def.hpp', 'engine/pipeline/shape_def.hpp'];
  const parts = [...included, ...more].map((file) => {
    const header = readHeader(file, readFileSync(join(root, file), 'utf8'));
    const rows = header.declarations.map(
      (d) =>
        `<section class="entry" data-entry><pre tabindex="0"><code class="hljs">${coloured(d.code, 'cpp')}</code></pre><p>${escaped(d.comment)} <span class="muted">(line ${d.line})</span></p></section>`,
    );
    return `<h2 id="${escaped(file)}"><code>${escaped(file)}</code></h2><pre class="muted" tabindex="0">${escaped(header.purpose)}</pre>${rows.join('\n')}`;
  });
  const filter = words[language].filter;
  return `<p>${referenceWords[language].apiText}</p><p><input class="filter" type="search" aria-label="${filter}" placeholder="${filter}"></p>\n${parts.join('\n')}`;
}
