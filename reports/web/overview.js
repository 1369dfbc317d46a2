// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The top of the overview: totals, and which engine to trust for what.
'use strict';
Rigor.headline = function () {
  const {el, run} = Rigor;
  const engines = new Set(run.columns.map((c) => c.engine));
  const judged = run.total - (run.symbols.unsupported?.count || 0) - (run.symbols.no_bound?.count || 0);
  const good = (run.symbols.pass?.count || 0);
  const known = (run.symbols.known_deviation?.count || 0);
  const shortRun = run.planned > run.total;
  return Rigor.panel('summary', null,
    el('h1', {}, 'Rigor report', run.suite ? [': ', run.suite] : ''),
    el('p', {class: 'muted'}, run.started, run.finished ? ` – ${run.finished}` : '', run.command ? [' · ', el('code', {}, run.command)] : ''),
    shortRun || !run.finished ? el('p', {class: 'notice'}, `This run is unfinished: ${run.total} of ${run.planned} cases are stored.`) : null,
    el('p', {}, `${engines.size} engines in ${run.columns.length} configurations ran ${run.scenarios.length} scenarios, each against the same reference: `,
      judged > 0 ? [el('b', {}, `${good} of ${judged} judged cases are within their bounds`), known ? `, ${known} more deviate as recorded.` : '.']
        : 'nothing was demanded of them, so errors can be compared but nothing passes or fails.'),
    el('div', {class: 'stats'}, Object.entries(run.symbols).filter(([, v]) => v.count).map(([key, v]) =>
      el('span', {class: `stat v v-${key}`}, el('span', {'aria-hidden': 'true'}, v.symbol), el('b', {}, v.count), v.word))),
    el('p', {class: 'notice small'}, 'The authors of this comparison wrote one of the engines in it (rigor). ',
      'Every number comes with the command that reproduces it, and what could not be matched between engines is in the ',
      el('a', {href: '#ledger'}, 'parity ledger'), '.'));
};

Rigor.ratioText = function (ratio) {
  const r = Rigor.number(ratio);
  if (!Number.isFinite(r)) return '';
  if (r < 1.05) return '×1';
  return '×' + (r < 10 ? r.toPrecision(2) : r < 1000 ? Math.round(r) : r.toExponential(0).replace('e+', 'e'));
};

/** One row per mechanism: the most accurate, who is close, who fails. */
Rigor.trust = function () {
  const {el, run} = Rigor;
  if (!run.mechanisms.length) return null;
  const row = function (m) {
    const ranked = m.standings.map((s, i) => ({...s, column: run.columns[i], index: i})).filter((s) => s.ran > 0);
    const share = (s) => s.bad / Math.max(1, s.scenarios);
    ranked.sort((a, b) => share(a) - share(b) || Rigor.number(a.ratio) - Rigor.number(b.ratio));
    const best = ranked.find((s) => s.index === m.best);
    // Differences below five per cent are no reason to prefer one of them.
    const first = best ? ranked.filter((s) => s === best || (share(s) === share(best) && Rigor.number(s.ratio) < 1.05 * Rigor.number(best.ratio))) : [];
    const close = ranked.filter((s) => !first.includes(s) && s.bad === 0 && Number.isFinite(Rigor.number(s.ratio))).slice(0, 3);
    const poor = m.standings.map((s, i) => ({...s, column: run.columns[i]})).filter((s) => s.bad > 0)
      .sort((a, b) => share(b) - share(a) || b.bad - a.bad);
    const shownPoor = poor.slice(0, 4);
    const title = (s) => `${s.column.label}: ${s.good} of ${s.scenarios} scenarios without a failure; typical error ${Rigor.ratioText(s.ratio) || 'unknown'} of the best`;
    return el('tr', {},
      el('th', {scope: 'row'}, el('button', {class: 'tag', title: 'Show these scenarios', onclick: () => Rigor.filterScoreboard({mechanism: m.name})}, m.name)),
      el('td', {class: 'num', 'data-label': 'Scenarios'}, m.scenarios.length),
      el('td', {'data-label': 'Trust first'}, first.length ? first.map((s) => Rigor.chip(s.bad ? 'fail' : 'pass', s.bad ? `${s.column.label}, fails in ${s.bad} of ${s.scenarios}` : s.column.label, title(s))) : el('span', {class: 'muted'}, 'nobody ranked')),
      el('td', {'data-label': 'Also without failure'}, close.map((s) => el('span', {class: 'chip v', title: title(s)}, s.column.label, ' ', el('b', {}, Rigor.ratioText(s.ratio)))),
        close.length ? '' : el('span', {class: 'muted'}, '—')),
      el('td', {'data-label': 'Fails'}, shownPoor.map((s) => Rigor.chip('fail', `${s.column.label} ${s.bad}/${s.scenarios}`, title(s))),
        poor.length > shownPoor.length ? el('span', {class: 'small muted'}, `and ${poor.length - shownPoor.length} more`) : '',
        poor.length ? '' : el('span', {class: 'muted'}, '—')));
  };
  return Rigor.panel('trust', 'Which engine for what',
    el('p', {class: 'muted'}, 'By mechanism, over the scenarios that isolate it. ', el('b', {}, 'Trust first'), ': fewest failures, then the smallest error; several where they agree within 5 %. Errors under 1e-6 (single-precision rounding) count as equal; scenarios without a reference rank nobody. ',
      '×', 'n is the typical error relative to the most accurate engine, at the same time step. ',
      el('b', {}, 'Fails'), ' counts scenarios with a missed bound, crash, timeout or NaN.'),
    Rigor.scroll(el('table', {class: 'full trust'},
      el('thead', {}, el('tr', {}, ['Mechanism', 'Scenarios', 'Trust first', 'Also without failure', 'Fails'].map((t, i) => el('th', {class: i === 1 ? 'num' : null, scope: 'col'}, t)))),
      el('tbody', {}, run.mechanisms.map(row)))));
};
