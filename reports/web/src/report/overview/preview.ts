// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A small drawing of a scene beside its name, while the pointer or the focus rests on it.
import { loadJson } from '../../common/data_files.ts';
import { el } from '../../common/elements.ts';
import { scenePicture } from '../../drawing/picture.ts';
import { readScene } from '../../replay/scene.ts';
import type { Scenario, ScenarioData } from '../data.ts';
import { run } from '../run.ts';

const rest = 350; // [ms] before anything is loaded

async function drawn(scenario: Scenario): Promise<Element> {
  const data = await loadJson<ScenarioData>(`scenario-${run.scenarios.indexOf(scenario)}`);
  const file = JSON.parse(data.text);
  return scenePicture(readScene(file), file, { width: 300, height: 180, paths: [], labels: false });
}

/** Follows a link; what cannot be drawn is left out. */
export function withPreview(link: HTMLElement, scenario: Scenario): HTMLElement {
  let card: HTMLElement | null = null;
  let timer = 0;
  const hide = () => {
    clearTimeout(timer);
    card?.remove();
    card = null;
  };
  const show = () => {
    hide();
    const mine = el('div', { class: 'preview', 'aria-hidden': 'true' });
    card = mine;
    timer = window.setTimeout(() => {
      drawn(scenario).then(
        (picture) => {
          if (card !== mine || !link.isConnected) return;
          const place = link.getBoundingClientRect();
          mine.style.left = `${place.left + 20}px`;
          mine.style.top = `${place.bottom + 200 < innerHeight ? place.bottom + 46 : place.top - 190}px`;
          mine.append(picture);
          document.body.append(mine);
        },
        () => {},
      );
    }, rest);
  };
  for (const start of ['mouseenter', 'focus']) link.addEventListener(start, show);
  for (const end of ['mouseleave', 'blur', 'click']) link.addEventListener(end, hide);
  return link;
}
