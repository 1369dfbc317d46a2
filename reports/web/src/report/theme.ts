// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import { el } from '../common/elements.ts';

const themes = ['auto', 'light', 'dark'] as const;
const names = { auto: '◐ auto', light: '○ light', dark: '● dark' };
type Theme = (typeof themes)[number];

function stored(): Theme {
  try {
    const found = localStorage.getItem('rigor-theme');
    return themes.find((t) => t === found) ?? 'auto';
  } catch {
    return 'auto'; // no storage from this place
  }
}

/** The button that goes through automatic, light and dark; `changed` is called afterwards. */
export function themeButton(changed: () => void): HTMLElement {
  let theme = stored();
  const apply = () => {
    if (theme === 'auto') delete document.documentElement.dataset.theme;
    else document.documentElement.dataset.theme = theme;
    button.textContent = names[theme];
  };
  const next = () => {
    theme = themes[(themes.indexOf(theme) + 1) % themes.length] as Theme;
    try {
      localStorage.setItem('rigor-theme', theme);
    } catch {
      // lasts for this visit
    }
    apply();
    changed();
  };
  const button = el('button', { class: 'button', title: 'Light or dark', onclick: next });
  apply();
  return button;
}
