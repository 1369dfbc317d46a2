// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A formula as mathematics; as plain text where there is no TeX, or none that KaTeX understands.
import katex from 'katex';
import 'katex/dist/katex.min.css';
import { el } from '../common/elements.ts';

export function formula(tex: string, plain: string): HTMLElement | null {
  if (tex) {
    const holder = el('div', { class: 'formula', title: plain, role: 'group', 'aria-label': 'formula', tabindex: 0 });
    try {
      katex.render(tex, holder, { displayMode: true, throwOnError: true, trust: false, strict: 'ignore' });
      return holder;
    } catch {
      // shown below in plain text
    }
  }
  return plain ? el('pre', { class: 'formula' }, plain) : null;
}
