// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A page of the handbook from Markdown: formulas by KaTeX, code with colours, and the fences `quote`, `scene`,
// `exercise`, `math`. What a page consists of is listed beside it, so that two languages can be compared.
import hljs from 'highlight.js/lib/core';
import bash from 'highlight.js/lib/languages/bash';
import cpp from 'highlight.js/lib/languages/cpp';
import json from 'highlight.js/lib/languages/json';
import python from 'highlight.js/lib/languages/python';
import katex from 'katex';
import { Marked, type Tokens } from 'marked';
import { type ExerciseFence, readExercise, readSceneFence, type SceneFence } from './fences.ts';
import { findQuote, type Quote, readQuote } from './quotes.ts';

hljs.registerLanguage('bash', bash);
hljs.registerLanguage('cpp', cpp);
hljs.registerLanguage('json', json);
hljs.registerLanguage('python', python);

export interface Heading {
  level: number;
  id: string;
  html: string;
}

export interface Page {
  html: string;
  title: string; // plain text of the first heading
  headings: Heading[];
  quotes: Quote[];
  scenes: SceneFence[];
  exercises: ExerciseFence[];
  formulas: string[]; // TeX of those that stand alone
  inlineFormulas: number;
  commands: string[]; // lines of ```sh fences that start with "./rigor" or a variable before it
  code: { lang: string; text: string }[]; // other fences
  links: string[];
}

/** Everything that the pages of one language share. */
export interface MarkupContext {
  readSource: (file: string) => string;
  siteRoot: string; // path that "site:" in a link stands for
  sourceLink: (file: string, line: number) => string;
  sceneHtml: (scene: SceneFence) => string;
  /** Place in the reference and title ("": none) of a metric of this name; null where there is none. */
  metric: (name: string) => { href: string; title: string } | null;
  words: { exercise: string; judge: string; look: string; answer: string; copy: string };
}

export const escaped = (text: string): string =>
  text.replace(/&/g, '&amp;').replace(/</g, '&lt;').replace(/>/g, '&gt;').replace(/"/g, '&quot;');

/** Options of a command, in HTML: "--" is not parted from its word at the end of a line. */
export const withOptions = (html: string): string =>
  html.replace(/(^|\s)(--?[a-z][\w-]*)/g, '$1<span class="option">$2</span>');

export function coloured(text: string, lang: string): string {
  const name = lang === 'sh' ? 'bash' : lang;
  if (!hljs.getLanguage(name)) return lang === 'text' ? withOptions(escaped(text)) : escaped(text);
  const html = hljs.highlight(text, { language: name }).value;
  // "--set" is an option, not the shell's built-in "set".
  return lang === 'sh' ? withOptions(html.replace(/(--?)<span class="hljs-built_in">([\w-]+)<\/span>/g, '$1$2')) : html;
}

const tex = (text: string, displayMode: boolean) =>
  katex.renderToString(text, {
    displayMode,
    throwOnError: true,
    trust: false,
    strict: 'ignore',
    output: 'htmlAndMathml',
  });

const inlineMath = /^\$((?:\\.|[^$\n\\])+)\$/;

/** A formula of the text that is short enough to stay on one line with the punctuation beside it. */
const longestHeld = 32;
const [heldFrom, heldTo] = ['\ue000', '\ue001'];

/** A browser breaks lines on both sides of a formula, so that a line would begin with a comma. */
const withHeld = (html: string): string =>
  html.replace(
    new RegExp(`([（(“]?)${heldFrom}([^${heldTo}]*)${heldTo}([，。；：、）！？”,.;:)]{0,2})`, 'g'),
    (_, before: string, formula: string, after: string) =>
      before || after ? `<span class="held">${before}${formula}${after}</span>` : formula,
  );

/** Languages of fences that a reader copies into a terminal or a file. */
const copied = ['sh', 'json', 'python'];

export function codeBlock(text: string, lang: string, copyWord: string): string {
  const copy = copied.includes(lang) ? `<button type="button" class="copy">${escaped(copyWord)}</button>` : '';
  const kind = lang === 'sh' || lang === 'text' ? 'code commands' : 'code';
  return `<div class="${kind}"><pre tabindex="0"><code class="hljs">${coloured(text, lang)}</code></pre>${copy}</div>\n`;
}

function quoteHtml(quote: Quote, context: MarkupContext): string {
  const last = quote.first + quote.lines.length - 1;
  const place = `${quote.file}, ${quote.first}–${last}`;
  const rows = coloured(quote.lines.join('\n'), 'cpp');
  return `<figure class="quote"><figcaption><a href="${context.sourceLink(quote.file, quote.first)}">${escaped(place)}</a></figcaption><pre tabindex="0"><code class="hljs">${rows}</code></pre></figure>\n`;
}

export function renderPage(source: string, context: MarkupContext): Page {
  const page: Page = {
    html: '',
    title: '',
    headings: [],
    quotes: [],
    scenes: [],
    exercises: [],
    formulas: [],
    inlineFormulas: 0,
    commands: [],
    code: [],
    links: [],
  };
  const marked = new Marked();

  const exerciseHtml = (fence: ExerciseFence): string => {
    const { words } = context;
    page.exercises.push(fence);
    const number = page.exercises.length;
    return `<section class="exercise"><h3>${escaped(words.exercise)} ${number}</h3>${marked.parse(fence.text)}
<p class="judge">${escaped(fence.isJudged ? words.judge : words.look)}</p>${codeBlock(fence.command, 'sh', words.copy)}
<details><summary>${escaped(words.answer)}</summary>${codeBlock(fence.answer.join('\n'), 'sh', words.copy)}${marked.parse(fence.solution)}</details></section>\n`;
  };

  const special: Record<string, (rest: string, body: string) => string> = {
    quote: (rest, body) => {
      const request = readQuote(rest, body);
      const quote = findQuote(request, context.readSource(request.file));
      page.quotes.push(quote);
      return quoteHtml(quote, context);
    },
    scene: (_, body) => {
      const scene = readSceneFence(body);
      page.scenes.push(scene);
      return context.sceneHtml(scene);
    },
    exercise: (_, body) => exerciseHtml(readExercise(body)),
    math: (_, body) => {
      page.formulas.push(body.trim());
      return `<div class="formula" tabindex="0">${tex(body, true)}</div>\n`;
    },
  };

  marked.use({
    extensions: [
      {
        name: 'math',
        level: 'inline',
        start: (src: string) => src.indexOf('$'),
        tokenizer(src: string) {
          const match = src.match(inlineMath);
          return match ? { type: 'math', raw: match[0], text: match[1] as string } : undefined;
        },
        renderer: (token) => {
          ++page.inlineFormulas;
          const text = (token as Tokens.Generic).text as string;
          const html = tex(text, false);
          return text.length <= longestHeld ? heldFrom + html + heldTo : html;
        },
      },
    ],
    renderer: {
      heading({ tokens, depth }) {
        const html = withHeld(this.parser.parseInline(tokens));
        const id = `s${page.headings.length}`;
        page.headings.push({ level: depth, id, html });
        return `<h${depth} id="${id}">${html}</h${depth}>\n`;
      },
      codespan({ text }) {
        const metric = context.metric(text);
        const code = `<code>${withOptions(escaped(text))}</code>`;
        if (!metric) return code;
        return `<a href="${metric.href}"${metric.title ? ` title="${escaped(metric.title)}"` : ''}>${code}</a>`;
      },
      link({ href, tokens }) {
        page.links.push(href);
        const target = href.replace(/^site:/, context.siteRoot).replace(/\.md(?=#|$)/, '.html');
        return `<a href="${escaped(target)}">${this.parser.parseInline(tokens)}</a>`;
      },
      table(token) {
        const cell = (c: Tokens.TableCell, tag: string) => `<${tag}>${this.parser.parseInline(c.tokens)}</${tag}>`;
        const head = token.header.map((c) => cell(c, 'th')).join('');
        const rows = token.rows.map((row) => `<tr>${row.map((c) => cell(c, 'td')).join('')}</tr>`).join('\n');
        return `<div class="table" tabindex="0"><table><thead><tr>${head}</tr></thead><tbody>${rows}</tbody></table></div>\n`;
      },
      code({ text, lang }) {
        const [kind = '', ...rest] = (lang ?? '').split(' ');
        const made = special[kind]?.(rest.join(' '), text);
        if (made !== undefined) return made;
        if (kind === 'sh')
          page.commands.push(...text.split('\n').filter((line) => /^([A-Z_]+=\S+ )*\.\/rigor\b/.test(line)));
        page.code.push({ lang: lang ?? '', text });
        return codeBlock(text, kind, context.words.copy);
      },
    },
  });
  page.html = withHeld(marked.parse(source, { async: false }));
  page.title = (page.headings[0]?.html ?? '').replace(/<[^>]+>/g, '');
  return page;
}
