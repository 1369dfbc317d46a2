// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Header, theme and routes: "#/scenario/<name>?dt=..&spec=..&t=..&pair=.." is a scenario, "#/engine/<name>" an engine,
// "#scoreboard?text=..&grade=.." and the like a tab of the overview. An entry of the history keeps how far its page was
// scrolled.
import './style.css';
import './board.css';
import './charts.css';
import './scene.css';
import './widths.css';
import './print.css';
import { el } from '../common/elements.ts';
import { drawAllPlots, dropPlots } from './charts/live_plots.ts';
import { enginePage } from './engine/page.ts';
import { loadCases, loadLists } from './loading.ts';
import { filtersOf } from './overview/filters.ts';
import { tabOf, tabs } from './overview/page.ts';
import { run, scenarioLink } from './run.ts';
import { scenarioPage } from './scenario/page.ts';
import { searchField } from './search.ts';
import { themeButton } from './theme.ts';
import { panel } from './widgets.ts';

const page = document.getElementById('page') as HTMLElement;
const home = run.single ? scenarioLink(run.single) : '';
let shown = ''; // the tab or the route without its query: what is on the page
let leave = () => {}; // function that is called at the end of the page
let visit = 0; // a page that loads slowly is dropped when another one was opened

interface Page {
  title: string;
  nodes: HTMLElement[];
  more?: (() => Promise<HTMLElement | null>)[]; // made when the first ones are on the screen
  shown?: () => void;
  left?: () => void;
}

/** Parts of an address: the page, the place on it, and what follows. */
function partsOf(hash: string): { path: string; anchor: string; query: URLSearchParams } {
  const [path = '', query = ''] = (hash || home).split('?');
  if (path.startsWith('#/')) return { path, anchor: '', query: new URLSearchParams(query) };
  const anchor = path.slice(1);
  return { path: `#${tabOf(anchor).id}`, anchor, query: new URLSearchParams(query) };
}

/** The section that `make` makes once what it needs is there, or the reason why it is not. */
async function withData(
  { id, cases, lists }: { id: string; cases?: boolean; lists?: boolean },
  make: () => HTMLElement | null,
): Promise<HTMLElement | null> {
  try {
    if (cases) await loadCases();
    if (lists) await loadLists();
  } catch (error) {
    return panel(id, 'Nothing to show', el('p', null, (error as Error).message));
  }
  return make();
}

async function pageOf(path: string, query: URLSearchParams): Promise<Page> {
  const [, kind, name] = /^#\/(scenario|engine)\/(.*)$/.exec(path) ?? [];
  if (kind === undefined || name === undefined) {
    const tab = tabOf(path.slice(1));
    if (tab.id === 'scoreboard' && query.size > 0) filtersOf(query);
    const [first, ...more] = tab.sections.map((section) => () => withData(section, section.make));
    const node = (await first?.()) ?? null;
    const nodes = node ? [node] : [];
    if (!node?.querySelector('h1')) nodes.unshift(el('h1', { class: 'read-aloud' }, tab.title));
    return { title: tab === tabs[0] ? '' : tab.title, nodes, more };
  }
  const title = decodeURIComponent(name);
  if (kind === 'engine') {
    let nodes: HTMLElement[] = [];
    const sorry = await withData({ id: 'missing', cases: true, lists: true }, () => {
      nodes = enginePage(title);
      return null;
    });
    return { title, nodes: sorry ? [sorry] : nodes };
  }
  return { title, ...(await scenarioPage(title, query)) };
}

/** Draws the page of the address; `place`: how far it was scrolled when it was left. */
async function route(place: number | null = null): Promise<void> {
  const { path, anchor, query } = partsOf(location.hash);
  const mine = ++visit;
  const found = await pageOf(path, query);
  if (mine !== visit) return;
  const stay = place ?? (path === shown ? scrollY : 0);
  leave();
  leave = found.left ?? (() => {});
  dropPlots(page);
  page.replaceChildren(...found.nodes);
  document.title = `${found.title ? `${found.title} – ` : ''}Rigor report${run.title ? `: ${run.title}` : ''}`;
  shown = path;
  markTab(path);
  for (const make of found.more ?? []) {
    await new Promise((done) => setTimeout(done));
    if (mine !== visit) return;
    const node = await make();
    if (mine !== visit) return;
    if (node) page.append(node);
  }
  const at = place === null && anchor && `#${anchor}` !== path ? document.getElementById(anchor) : null;
  if (at) {
    at.scrollIntoView();
    if (at.tabIndex === -1 && at.hasAttribute('tabindex')) at.focus({ preventScroll: true });
  } else scrollTo(0, stay);
  found.shown?.();
  page.dataset.shown = String(mine);
}

function markTab(path: string): void {
  for (const link of document.querySelectorAll('#top nav a'))
    if (link.getAttribute('href') === path) link.setAttribute('aria-current', 'page');
    else link.removeAttribute('aria-current');
}

function bars(): void {
  const links = tabs.map(({ id, title }) => el('a', { href: `#${id}` }, title));
  const skip = (event: Event) => {
    event.preventDefault(); // the part behind "#" is the address of a page
    page.focus();
    page.scrollIntoView();
  };
  page.tabIndex = -1;
  const toContent = el('a', { class: 'skip', href: '#page', onclick: skip }, 'Skip to the content');
  const brand = el('a', { class: 'brand', href: home || '#' }, 'Rigor');
  const bar = el(
    'div',
    { class: 'bar' },
    toContent,
    brand,
    el('nav', { 'aria-label': 'Sections' }, links),
    searchField(),
    themeButton(() => void route()),
  );
  document.getElementById('top')?.append(bar);
  document
    .getElementById('foot')
    ?.append(
      `The hosts of this comparison are the authors of one of the engines in it, ${run.inHouse}. `,
      'Beside this page: results.csv, summary.md, junit.xml, results.sqlite; tables/ as CSV, Markdown and LaTeX; plots/ as SVG and PDF with their data as CSV; trajectories/ in HDF5.',
    );
}

history.scrollRestoration = 'manual';
let keeping: ReturnType<typeof setTimeout>;
addEventListener('scroll', () => {
  clearTimeout(keeping);
  keeping = setTimeout(() => history.replaceState({ scrolled: scrollY }, ''), 100);
});
const keptPlace = (state: unknown) => (state as { scrolled: number } | null)?.scrolled ?? null;
/** Forwards and back come with the state of an entry, links without one. */
addEventListener('popstate', (event) => {
  clearTimeout(keeping);
  void route(keptPlace(event.state));
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
void route(keptPlace(history.state));
