// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Names of the sections of a page: each brings its section into view and moves the focus there.
import { el } from '../../common/elements.ts';

function go(section: HTMLElement): void {
  section.scrollIntoView();
  const title = section.querySelector('h2');
  title?.setAttribute('tabindex', '-1');
  title?.focus({ preventScroll: true });
}

/** Null for fewer than two titled sections. */
export function contents(sections: readonly HTMLElement[]): HTMLElement | null {
  const titled = sections.flatMap((section) => {
    const title = section.querySelector(':scope > h2')?.textContent;
    return title ? [{ section, title }] : [];
  });
  if (titled.length < 2) return null;
  const button = ({ section, title }: (typeof titled)[number]) =>
    el('button', { class: 'link', 'data-section': section.id, onclick: () => go(section) }, title);
  return el('nav', { class: 'contents noprint', 'aria-label': 'On this page' }, titled.map(button));
}
