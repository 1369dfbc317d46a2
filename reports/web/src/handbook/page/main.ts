// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The script of every page of the handbook: scenes, light or dark, commands to the clipboard, the filter of long
// tables. Without it the text is complete.
import 'katex/dist/katex.min.css';
import '../../common/theme.css';
import './style.css';
import type { Recording } from '../recording.ts';
import { mountPlayers, receive } from './player.ts';

declare global {
  interface Window {
    rigorScene: (id: string, recording: Recording) => void;
  }
}
window.rigorScene = receive;

const key = 'rigor-handbook-theme';

function stored(): string | null {
  try {
    return localStorage.getItem(key);
  } catch {
    return null; // pages opened from disk may have no storage
  }
}

function setTheme(theme: string | null): void {
  if (theme) document.documentElement.dataset.theme = theme;
  else delete document.documentElement.dataset.theme;
  document.dispatchEvent(new Event('themechange'));
}

setTheme(stored());

function mountTheme(): void {
  document.querySelector('#theme')?.addEventListener('click', () => {
    const now = document.documentElement.dataset.theme;
    const dark = now ? now === 'dark' : matchMedia('(prefers-color-scheme: dark)').matches;
    const next = dark ? 'light' : 'dark';
    try {
      localStorage.setItem(key, next);
    } catch {
      // holds for this page alone
    }
    setTheme(next);
  });
}

function mountCopies(): void {
  for (const button of document.querySelectorAll<HTMLButtonElement>('button.copy'))
    button.addEventListener('click', () => {
      const text = button.parentElement?.querySelector('code')?.textContent ?? '';
      void navigator.clipboard?.writeText(text).then(() => {
        button.classList.add('done');
        setTimeout(() => button.classList.remove('done'), 1200);
      });
    });
}

/** An input with class "filter" hides the entries of the page that lack its words. */
function mountFilters(): void {
  for (const input of document.querySelectorAll<HTMLInputElement>('input.filter'))
    input.addEventListener('input', () => {
      const words = input.value.toLowerCase().split(/\s+/).filter(Boolean);
      for (const entry of document.querySelectorAll<HTMLElement>('[data-entry]')) {
        const text = entry.textContent?.toLowerCase() ?? '';
        entry.hidden = !words.every((word) => text.includes(word));
      }
    });
}

/** On a narrow screen the contents are folded. */
function mountContents(): void {
  if (matchMedia('(max-width: 60rem)').matches) document.querySelector('nav.contents details')?.removeAttribute('open');
}

document.addEventListener('DOMContentLoaded', () => {
  mountContents();
  mountTheme();
  mountCopies();
  mountFilters();
  mountPlayers();
  const here = document.querySelector('nav a[aria-current]');
  here?.scrollIntoView({ block: 'nearest' });
});
