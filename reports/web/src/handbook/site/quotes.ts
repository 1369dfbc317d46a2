// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Pieces of source files that a page quotes. A quote names text of its first line, so that it moves with the code; one
// whose text is gone, or stands twice, is an error of the build.

export interface QuoteRequest {
  file: string; // path from the root of the repository
  from: string; // text of the first line; stands on one line of the file alone
  to: string | null; // text of the last line; null: the brace that closes the first one
}

export interface Quote extends QuoteRequest {
  first: number; // line number, from 1
  lines: string[];
}

const mostLines = 70;

/** The body of a fence "quote FILE": `from: TEXT`, and `to: TEXT` where the quote ends before the brace. */
export function readQuote(file: string, body: string): QuoteRequest {
  const value = (key: string) => body.match(new RegExp(`^${key}: (.*)$`, 'm'))?.[1]?.trim() ?? null;
  const from = value('from');
  if (!file || from === null) throw new Error(`a quote needs a file and a line "from: TEXT", found: ${file} ${body}`);
  return { file, from, to: value('to') };
}

const startsEarlier = (line: string | undefined) => line !== undefined && /^\s*(\/\/\/|template <)/.test(line);

/** Index of the line on which the brace opened at or after `start` is closed. */
function closingLine(lines: string[], start: number): number {
  let depth = 0;
  let opened = false;
  for (let i = start; i < lines.length; ++i) {
    const code = (lines[i] as string).replace(/\/\/.*$/, '').replace(/'[{}]'|"[^"]*"/g, '');
    for (const c of code) {
      if (c === '{') {
        ++depth;
        opened = true;
      } else if (c === '}') --depth;
    }
    if (opened && depth <= 0) return i;
  }
  return -1;
}

export function findQuote(request: QuoteRequest, text: string): Quote {
  const where = `quote of ${request.file}`;
  const lines = text.split('\n');
  const hits = lines.flatMap((line, i) => (line.includes(request.from) ? [i] : []));
  if (hits.length !== 1) throw new Error(`${where}: "${request.from}" stands on ${hits.length} lines, expected 1`);
  const named = hits[0] as number;
  let start = named;
  while (startsEarlier(lines[start - 1])) --start;
  const end =
    request.to === null
      ? closingLine(lines, named)
      : lines.findIndex((line, i) => i >= named && line.includes(request.to as string));
  if (end < 0) throw new Error(`${where}: no end ${request.to === null ? 'of its braces' : `"${request.to}"`}`);
  if (end - start >= mostLines) throw new Error(`${where}: ${end - start + 1} lines, at most ${mostLines}`);
  const quoted = lines.slice(start, end + 1);
  const indent = Math.min(...quoted.filter((l) => l.trim()).map((l) => l.length - l.trimStart().length));
  return { ...request, first: start + 1, lines: quoted.map((l) => l.slice(indent)) };
}
