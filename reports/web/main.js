// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Header, theme and routes: "#/scenario/<name>?dt=..&spec=.." is a scenario, anything else the overview.
'use strict';
(function () {
  const {el, run} = Rigor;
  const page = document.getElementById('page');
  const themes = ['auto', 'light', 'dark'];
  let theme = 'auto';
  try { theme = localStorage.getItem('rigor-theme') || 'auto'; } catch { /* no storage from this place */ }
  const applyTheme = function () {
    if (theme === 'auto') delete document.documentElement.dataset.theme; else document.documentElement.dataset.theme = theme;
    themeButton.textContent = {auto: '◐ auto', light: '○ light', dark: '● dark'}[theme];
  };
  const themeButton = el('button', {class: 'button', title: 'Light or dark', onclick: () => {
    theme = themes[(themes.indexOf(theme) + 1) % themes.length];
    try { localStorage.setItem('rigor-theme', theme); } catch { /* lasts for this visit */ }
    applyTheme(); route();
  }});
  const links = [['#study', 'Study', Rigor.study], ['#trust', 'Which engine', run.mechanisms.length], ['#scoreboard', 'Scoreboard', true], ['#timing', 'Cost', run.scenarios.some((s) => s.cases.some((c) => c.step))],
    ['#in-run', 'Contacts', run.scenarios.some((s) => s.cases.some((c) => c.inRun && c.inRun.overlapping))], ['#audit', 'Contact queries', run.audit.length], ['#ledger', 'Parity ledger', true], ['#engines', 'Engines', true], ['#method', 'Method', true]];
  document.getElementById('top').append(el('div', {class: 'bar'}, el('a', {class: 'brand', href: '#'}, 'Rigor'),
    el('nav', {'aria-label': 'Sections'}, links.filter(([, , on]) => on).map(([href, text]) => el('a', {href}, text))), themeButton));
  document.getElementById('foot').append('The hosts of this comparison are the authors of one of the engines in it, rigor. ',
    'Beside this page: results.csv, summary.md, junit.xml, results.sqlite, plots.');

  const overview = () => [Rigor.headline(), Rigor.studyPanel(), Rigor.trust(), Rigor.scoreboard(), Rigor.timingTable(), Rigor.inRunSummary(), Rigor.auditSummary(), Rigor.ledgerSummary(), Rigor.enginesPanel(), Rigor.methodPanel()].filter(Boolean);
  let shown = null;
  const route = function () {
    const match = /^#\/scenario\/([^?]*)(?:\?(.*))?$/.exec(location.hash);
    const scenario = match ? decodeURIComponent(match[1]) : null;
    const stay = scenario !== null && shown === scenario ? scrollY : 0;
    Rigor.dropCharts();
    page.replaceChildren(...(match ? Rigor.scenarioPage(scenario, new URLSearchParams(match[2] || '')) : overview()));
    document.title = (scenario ? scenario + ' – ' : '') + 'Rigor report' + (run.suite ? ': ' + run.suite : '');
    shown = scenario;
    const anchor = !match && location.hash.length > 1 ? document.getElementById(location.hash.slice(1)) : null;
    if (anchor) anchor.scrollIntoView(); else scrollTo(0, stay);
  };
  addEventListener('hashchange', (event) => {
    const wasOverview = shown === null && document.getElementById('scoreboard');
    if (wasOverview && !location.hash.startsWith('#/')) return;  // the browser scrolls
    route();
  });
  addEventListener('beforeprint', () => Rigor.drawAllCharts?.());
  applyTheme();
  route();
})();
