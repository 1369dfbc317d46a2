// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Header, theme and routes: "#/scenario/<name>?dt=..&spec=..&t=..&pair=.." is a scenario, "#/engine/<name>" an engine,
// anything else the overview.
import './style.css';
import './board.css';
import './charts.css';
import './scene.css';
import './widths.css';
import './print.css';
import { el } from '../common/elements.ts';
import { drawAllPlots, dropPlots } from './charts/live_plots.ts';
import { enginePage } from './engine/page.ts';
import { navigation, overview } from './overview/page.ts';
import { run } from './run.ts';
import { scenarioPage } from './scenario/page.ts';
import { themeButton } from './theme.ts';

const page = document.getElementById('page') as HTMLElement;
let shown = ''; // the route without its query: what is on the page
let leave = () => {}; // function that is called at the end of the page
let visit = 0; // a page that loads slowly is dropped when another one was opened

interface Page {
  title: string;
  nodes: HTMLElement[];
  more?: (() => HTMLElement | null)[]; // made when the first ones are on the screen
  shown?: () => void;
  left?: () => void;
}

const atOnce = 3; // sections of the overview

async function pageOf(hash: string): Promise<Page> {
  const [path = '', query = ''] = hash.split('?');
  const [, kind, name] = /^#\/(scenario|engine)\/(.*)$/.exec(path) ?? [];
  if (kind === undefined || name === undefined) {
    const nodes = overview.slice(0, atOnce).map((make) => make());
    return { title: '', nodes: nodes.filter((node) => node !== null), more: overview.slice(atOnce) };
  }
  const title = decodeURIComponent(name);
  if (kind === 'engine') return { title, nodes: enginePage(title) };
  return { title, ...(await scenarioPage(title, new URLSearchParams(query))) };
}

async function route(): Promise<void> {
  const { hash } = location;
  const path = hash.startsWith('#/') ? (hash.split('?')[0] as string) : '#';
  const mine = ++visit;
  const found = await pageOf(hash);
  if (mine !== visit) return;
  const stay = path === shown && path !== '#' ? scrollY : 0;
  leave();
  leave = found.left ?? (() => {});
  dropPlots(page);
  page.replaceChildren(...found.nodes);
  document.title = `${found.title ? `${found.title} – ` : ''}Rigor report${run.title ? `: ${run.title}` : ''}`;
  shown = path;
  for (const make of found.more ?? []) {
    await new Promise((done) => setTimeout(done));
    if (mine !== visit) return;
    const node = make();
    if (node) page.append(node);
  }
  const anchor = path === '#' && hash.length > 1 ? document.getElementById(hash.slice(1)) : null;
  if (anchor) anchor.scrollIntoView();
  else scrollTo(0, stay);
  found.shown?.();
  page.dataset.shown = String(mine);
}

function bars(): void {
  const links = navigation().map(({ id, title }) => el('a', { href: `#${id}` }, title));
  const brand = el('a', { class: 'brand', href: '#' }, 'Rigor');
  const bar = el(
    'div',
    { class: 'bar' },
    brand,
    el('nav', { 'aria-label': 'Sections' }, links),
    themeButton(() => void route()),
  );
  document.getElementById('top')?.append(bar);
  document
    .getElementById('foot')
    ?.append(
      `The hosts of this comparison are the authors of one of the engines in it, ${run.inHouse}. `,
      'Beside this page: results.csv, summary.md, junit.xml, results.sqlite; tables/ as CSV, Markdown and LaTeX; plots/ as SVG with their data as CSV; trajectories/ in HDF5.',
    );
}

addEventListener('hashchange', () => {
  if (shown === '#' && !location.hash.startsWith('#/')) return; // the browser scrolls
  void route();
});
/** Style for paper: light, and plots as wide as a column. */
function printing(now: boolean): void {
  const { classList, dataset } = document.documentElement;
  if (now === classList.contains('printing')) return;
  classList.toggle('printing', now);
  if (now) {
    themeBefore = dataset.theme;
    dataset.theme = 'light';
  } else if (themeBefore === undefined) delete dataset.theme;
  else dataset.theme = themeBefore;
  drawAllPlots();
}
let themeBefore: string | undefined;
addEventListener('beforeprint', () => printing(true));
addEventListener('afterprint', () => printing(false));
bars();
void route();
