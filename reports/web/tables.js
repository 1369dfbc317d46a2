// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The overview's tables below the scoreboard: timing, contact audit, parity ledger, engines, method.
'use strict';
/** Cost and accuracy of the same run, never one without the other. */
Rigor.timingTable = function () {
  const {el, run} = Rigor;
  const cell = function (s, column, i) {
    const first = Rigor.isFirstOfEngine(run.columns, i) ? 'border-left:1px solid var(--line)' : null;
    const c = Rigor.cellCases(s, column, 'finest')[0];
    if (!c || !c.step) return el('td', {class: 'num muted', style: first}, c ? Rigor.verdict(c.shown).symbol : '');
    const t = c.step;
    return el('td', {class: 'num', style: first, title: `median ${Rigor.full(t.median)} s per step, 10 % ${Rigor.duration(t.p10)}, 90 % ${Rigor.duration(t.p90)}, ${t.samples} steps, ` +
      `${Rigor.format(t.contacts)} contacts on average; ${s.main.name} ${Rigor.full(c.value)} ${s.main.unit}`},
      Rigor.duration(t.median), el('span', {class: 'bound'}, Rigor.verdict(c.shown).symbol, ' ', Rigor.format(c.value)));
  };
  const rows = run.scenarios.filter((s) => s.cases.some((c) => c.step));
  if (!rows.length) return null;
  return Rigor.panel('timing', 'Cost, beside accuracy',
    el('p', {class: 'muted'}, 'Median wall time of one step at the finest time step; below it the verdict and the main error of the same run. ',
      'A fast step that misses its bound is not fast. Times depend on the machine named under ', el('a', {href: '#engines'}, 'environment'),
      '; spread and contact counts are in the cell’s tooltip and on the scenario’s page.'),
    Rigor.scroll(el('table', {class: 'full'},
      Rigor.specHead([el('th', {class: 'sticky', scope: 'col'}, 'Scenario'), el('th', {scope: 'col'}, 'Step, error')], run.columns,
        (c) => el('th', {class: 'num', scope: 'col', title: c.spec}, Rigor.specSubtitle(c))),
      el('tbody', {}, rows.map((s) => el('tr', {}, el('th', {class: 'sticky', scope: 'row'}, el('a', {href: Rigor.scenarioLink(s.name)}, s.name)),
        el('td', {class: 'small'}, Rigor.timeStep(Math.min(...s.cases.map((c) => c.dt))), el('span', {class: 'bound'}, s.main.name)),
        run.columns.map((c, i) => cell(s, c, i))))))));
};

Rigor.auditSummary = function () {
  const {el, run} = Rigor;
  if (!run.audit.length) return null;
  const auditors = [...new Set(run.audit.flatMap((a) => a.rows.map((r) => r.auditor)))].filter((name) => name !== 'oracle' && name !== 'in_run' && !name.includes('|'));
  const cell = function (rows, auditor) {
    const r = rows.find((x) => x.auditor === auditor);
    if (!r) return el('td', {class: 'num muted'}, '');
    if (r.outcome !== 'completed' && !r.queries) return el('td', {class: 'small muted', title: r.note}, r.outcome);
    const wrong = r.missed + r.spurious;
    return el('td', {class: 'num', title: `${r.queries} pairs in ${r.frames} frames; ${r.overlapping} overlapping; ${r.missed} missed, ${r.spurious} spurious, ${r.undecided} undecided; ` +
      `worst normal ${Rigor.full(r.normalErrorMax)} rad, depth ${Rigor.full(r.depthErrorMax)} m; ${r.worst}`},
      wrong ? Rigor.chip('fail', `${wrong} wrong`) : null, Rigor.angle(r.normalErrorMax),
      el('span', {class: 'bound'}, r.depthErrorMax === null ? '' : `${Rigor.format(r.depthErrorMax)} m`));
  };
  return Rigor.panel('audit', 'Contact queries',
    el('p', {class: 'muted'}, 'At sampled frames of every run, each collision engine is asked about the same poses and compared with an exact oracle. ',
      'Shown: the worst angle between its contact normal and the nearest exact one, and the worst penetration error below; ',
      '“wrong” counts overlaps that were missed or invented.'),
    Rigor.scroll(el('table', {}, el('thead', {}, el('tr', {}, el('th', {class: 'sticky', scope: 'col'}, 'Poses of'), auditors.map((a) => el('th', {class: 'num', scope: 'col'}, a)))),
      el('tbody', {}, run.audit.map((a) => el('tr', {}, el('th', {class: 'sticky', scope: 'row'}, el('a', {href: Rigor.scenarioLink(a.scenario)}, a.scenario)),
        auditors.map((auditor) => cell(a.rows, auditor))))))));
};

/** What each run acted upon, worst over its time steps. */
Rigor.inRunSummary = function () {
  const {el, run} = Rigor;
  const rows = run.scenarios.filter((s) => s.cases.some((c) => c.inRun && c.inRun.overlapping));
  if (!rows.length) return null;
  const cell = function (s, column) {
    const seen = s.cases.filter((c) => c.spec === column.spec && c.inRun).map((c) => c.inRun);
    if (!seen.length) return el('td', {class: 'num muted'}, '');
    const worst = (key) => seen.reduce((w, a) => (a[key] !== null && (w === null || !(Rigor.number(a[key]) <= w)) ? Rigor.number(a[key]) : w), null);
    const sum = (key) => seen.reduce((n, a) => n + a[key], 0);
    const wrong = sum('missed') + sum('spurious'), flicker = worst('contactFlicker');
    if (!sum('overlapping') && !wrong) return el('td', {class: 'small muted', title: `${sum('queries')} pairs asked about`}, 'no overlap');
    if (!wrong && worst('normal') === null) return el('td', {class: 'small muted', title: 'shapes for which the oracle has no exact answer'}, 'undecided');
    return el('td', {class: 'num', 'data-wrong': wrong, title: `${sum('queries')} pairs, ${sum('overlapping')} overlapping; ${sum('missed')} missed, ${sum('spurious')} spurious; worst normal ${Rigor.full(worst('normal'))} rad, ` +
      `depth ${Rigor.full(worst('depth'))} m, point ${Rigor.full(worst('point'))} m off its surface; normals flicker by ${Rigor.full(worst('normalFlicker'))} rad, ${Rigor.full(flicker)} of contacts blink; ${seen.map((a) => a.worst).filter(Boolean).join('; ')}`},
      wrong ? Rigor.chip('fail', `${wrong} wrong`) : null, Rigor.angle(worst('normal')),
      el('span', {class: 'bound'}, worst('depth') === null ? '' : `${Rigor.format(worst('depth'))} m`),
      flicker > 0.01 ? el('span', {class: 'bound'}, `${(100 * flicker).toPrecision(2)} % blink`) : null);
  };
  return Rigor.panel('in-run', 'Contacts acted upon',
    el('p', {class: 'muted'}, 'The contacts that each run itself acted upon, at sampled steps, against the exact oracle at the poses where the step began. ',
      'Shown: the worst angle to the nearest exact normal and the worst depth error; “wrong” counts overlaps that were missed or invented; “blink” is the share of steps in which a touching pair had lost its contact for just that step.'),
    Rigor.scroll(el('table', {}, Rigor.specHead([el('th', {class: 'sticky', scope: 'col'}, 'Scenario')], run.columns, (c) => el('th', {class: 'num', scope: 'col', title: c.spec}, Rigor.specSubtitle(c))),
      el('tbody', {}, rows.map((s) => el('tr', {}, el('th', {class: 'sticky', scope: 'row'}, el('a', {href: Rigor.scenarioLink(s.name)}, s.name)), run.columns.map((c) => cell(s, c))))))));
};

Rigor.ledgerRows = function (rows, withEngine) {
  const {el} = Rigor;
  const mark = {exact: 'pass', approximate: 'known_deviation', unsupported: 'unsupported'};
  return el('table', {class: 'full'},
    el('thead', {}, el('tr', {}, [...(withEngine ? ['Engine'] : ['Spec']), 'Topic', 'Requested', 'Resolved', 'How', 'Why', ...(withEngine ? ['Scenarios'] : [])].map((t) => el('th', {scope: 'col'}, t)))),
    el('tbody', {}, rows.map((l) => el('tr', {}, el('th', {scope: 'row'}, withEngine ? `${l.engine} ${l.preset}` : l.label), el('td', {}, l.topic), el('td', {}, l.requested),
      el('td', {}, l.resolved), el('td', {}, Rigor.chip(mark[l.realisation] || 'no_bound', l.realisation)), el('td', {class: 'small'}, l.reason),
      withEngine ? el('td', {class: 'num', title: l.scenarios.join(', ')}, l.scenarios.length) : null))));
};

Rigor.ledgerSummary = function () {
  const {el, run} = Rigor;
  const holder = el('div');
  let all = false;
  const rows = () => run.ledger.filter((l) => all || l.realisation !== 'exact');
  const button = el('button', {class: 'button', 'aria-pressed': 'false', onclick: () => { all = !all; draw(); }}, 'Show what was matched exactly too');
  const draw = function () {
    button.setAttribute('aria-pressed', String(all));
    holder.replaceChildren(rows().length ? Rigor.scroll(Rigor.ledgerRows(rows(), true)) : el('p', {class: 'empty'}, 'Nothing: every request was met exactly.'));
  };
  draw();
  return Rigor.panel('ledger', 'Parity ledger',
    el('p', {class: 'muted'}, 'What the scenarios asked for and an engine could not give, or gave differently. Read it before comparing two columns. ',
      `${run.ledger.filter((l) => l.realisation === 'exact').length} of ${run.ledger.length} entries are exact.`), button, holder);
};

Rigor.enginesPanel = function () {
  const {el, run} = Rigor;
  return Rigor.panel('engines', 'Engines and environment',
    Rigor.scroll(el('table', {class: 'full'}, el('thead', {}, el('tr', {}, ['Engine', 'Version', 'Precision', 'Build', 'Problem'].map((t) => el('th', {scope: 'col'}, t)))),
      el('tbody', {}, run.engines.map((e) => el('tr', {}, el('th', {scope: 'row'}, e.name, e.title && e.title !== e.name ? el('span', {class: 'bound'}, e.title) : null), el('td', {}, e.version), el('td', {}, e.precision),
        el('td', {class: 'small'}, e.buildNotes), el('td', {}, e.problem ? Rigor.chip('crashed', e.problem) : '')))))),
    el('h3', {}, 'Environment'),
    el('dl', {class: 'facts'}, Object.entries(run.environment).map(([k, v]) => [el('dt', {}, k), el('dd', {}, v)])));
};

Rigor.methodPanel = function () {
  const {el} = Rigor;
  const item = (head, ...text) => el('li', {}, el('b', {}, head), ' ', text);
  return Rigor.panel('method', 'Method',
    el('ul', {},
      item('One scenario, all engines.', 'A scenario is written once, in SI units. Each engine is given the same bodies, masses, pair friction and restitution; after the build, what it says it was given is read back and compared.'),
      item('Two presets.', '“default” is the engine as it ships, with the scenario’s pair values. “matched” turns sleeping, damping, clamps and margins off or down and uses the same friction and restitution law as nearly as the library allows.'),
      item('Exact and scheme-exact.', 'Exact errors are distances from the physics: they measure accuracy. Scheme-exact errors are distances from what a perfect run of the engine’s own time-stepping formula gives at that time step: they find bugs. A simulator may be far from the first and on the second; the two are never mixed.'),
      item('Measured.', 'Errors against a recorded motion of a real body are apart from both: the model, its coefficients and the instrument are in them.'),
      item('Same yardstick.', 'Energy, momentum and all errors are computed from the recorded states by one implementation, in double precision, for all engines.'),
      item('Contacts.', 'At sampled frames all collision engines and an exact oracle are asked about the same poses. Equally good normals count as equal.'),
      item('One process per case.', 'An engine that aborts, hangs or returns NaN costs one cell of the table.'),
      item('Bounds.', 'A pass means that every metric with a bound stayed within it. Where nothing was demanded, the cell says “no bound”. A known deviation is outside, but as recorded beforehand and with its reason.'),
      item('Time.', 'Wall time of a step by the monotonic clock, median with the 10th and 90th percentile; always beside the accuracy of the same run.'),
      item('Every number can be checked.', 'The page holds thinned curves; full trajectories, every metric and every setting are in the run folder (results.sqlite, trajectories, results.csv), and each case shows the command that reproduces it.')),
    el('h3', {}, 'Conflict of interest'),
    el('p', {}, 'The hosts of this comparison are the authors of one of the engines in it, rigor. Read its column with that in mind: scenarios, bounds, adapters and presets are all in the repository, and the other engines’ columns can be rerun and challenged with the commands given.'));
};
