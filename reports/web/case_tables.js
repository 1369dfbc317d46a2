// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Tables of one scenario at one time step: outcomes, metrics, quantities, audit, ledger, read-back, timing,
// commands.
'use strict';
Rigor.columnOf = (c) => Rigor.run.columns.find((x) => x.spec === c.spec);
Rigor.metricKinds = [
  ['exact', 'Against the exact solution', 'accuracy: the distance from the physics'],
  ['scheme_exact', 'Against the engine’s own scheme', 'bugs: the distance from a perfect run of its own time-stepping formula'],
  ['measured', 'Against the recorded motion', 'a real body: the errors of the model and of the instrument are in it'],
  ['invariant', 'Invariants', 'what physics conserves'], ['contact', 'Contacts', 'penetration, normals, contact law'],
  ['joint', 'Joints', 'anchor drift and limits'], ['rest', 'Rest', 'what should stand still'],
  ['outcome', 'What came of it', 'neither right nor wrong for one start: distributions over many are comparable']];

Rigor.outcomesPanel = function (cases, focus) {
  const {el} = Rigor;
  const odd = cases.filter((c) => !['pass', 'no_bound'].includes(c.shown));
  if (!odd.length) return null;
  const why = function (c) {
    const lines = c.metrics.filter((m) => m.verdict !== 'pass').map((m) =>
      `${m.name}${m.subject ? ' of ' + m.subject : ''} ${Rigor.format(m.value)}${m.bound === null ? '' : ` against a bound of ${Rigor.format(m.bound)}`}${m.note ? `: ${m.note}` : ''}`);
    const whole = c.metrics.filter((m) => m.verdict !== 'pass' && !m.subject);
    const shown = (whole.length ? lines.filter((_, i) => !c.metrics.filter((m) => m.verdict !== 'pass')[i].subject) : lines).slice(0, 4);
    return [c.reason ? el('div', {}, c.reason) : null, shown.map((line) => el('div', {}, line))];
  };
  return Rigor.panel('outcomes', 'What did not simply pass',
    Rigor.scroll(el('table', {class: 'full'}, el('tbody', {}, odd.map((c) => el('tr', {class: c.spec === focus ? 'focus' : null},
      el('th', {scope: 'row'}, Rigor.columnOf(c).label), el('td', {}, Rigor.chip(c.shown)), el('td', {}, why(c))))))));
};

/** One table, engines as columns, metrics as rows under a heading per kind. */
Rigor.metricsPanel = function (cases) {
  const {el} = Rigor;
  const columns = Rigor.run.columns.filter((c) => cases.some((x) => x.spec === c.spec && x.metrics.length));
  if (!columns.length) return Rigor.panel('metrics', 'Metrics', el('p', {class: 'empty'}, 'No case at this time step has numbers.'));
  const caseOf = (column) => cases.find((c) => c.spec === column.spec);
  const cell = function (column, name, subject) {
    const m = caseOf(column).metrics.find((x) => x.name === name && x.subject === subject);
    if (!m) return el('td', {class: 'num muted'}, '');
    const judged = m.bound !== null || m.expectation !== null;
    const shown = judged ? Rigor.metricShown(m.verdict) : null;
    const title = `${Rigor.full(m.value)} ${m.unit}${Rigor.number(m.at) >= 0 ? ` at t = ${Rigor.format(m.at)} s` : ''}${m.note ? '\n' + m.note : ''}`;
    return el('td', {class: 'num', title, 'data-value': Rigor.full(m.value)},
      shown ? el('span', {class: `chip v v-${shown}`, style: 'margin:0'}, el('span', {class: 'sym', 'aria-label': Rigor.verdict(shown).word}, Rigor.verdict(shown).symbol), Rigor.format(m.value)) : Rigor.format(m.value),
      m.bound !== null ? el('span', {class: 'bound'}, `≤ ${Rigor.format(m.bound)}`) : null,
      m.expectation !== null ? el('span', {class: 'bound'}, `expected ${Rigor.format(m.expectation)}`) : null);
  };
  const rowsOf = (kind, whole) => [...new Map(cases.flatMap((c) => c.metrics).filter((m) => m.kind === kind && (m.subject === '') === whole)
    .map((m) => [`${m.name}\n${m.subject}`, m])).values()];
  const row = (m) => el('tr', {'data-metric': m.name, 'data-subject': m.subject}, el('th', {class: 'sticky', scope: 'row'}, m.name.replaceAll('_', ' '), m.subject ? el('span', {class: 'muted'}, ` ${m.subject}`) : ''),
    el('td', {class: 'muted'}, m.unit === '1' ? '' : m.unit), columns.map((c) => cell(c, m.name, m.subject)));
  const table = (whole) => {
    const kinds = [...Rigor.metricKinds];
    for (const m of cases.flatMap((c) => c.metrics)) if (!kinds.some(([k]) => k === m.kind)) kinds.push([m.kind, m.kind, '']);
    const parts = kinds.map(([kind, title, text]) => [rowsOf(kind, whole), title, text]).filter(([rows]) => rows.length);
    if (!parts.length) return null;
    return Rigor.scroll(el('table', {}, Rigor.specHead([el('th', {class: 'sticky', scope: 'col'}, 'Metric'), el('th', {scope: 'col'}, 'Unit')], columns,
      (c) => el('th', {class: 'num', scope: 'col', title: c.spec}, Rigor.specSubtitle(c))),
      parts.map(([rows, title, text]) => el('tbody', {}, el('tr', {class: 'sub'}, el('th', {colspan: columns.length + 2}, title, text ? el('span', {class: 'muted small'}, ` — ${text}`) : '')), rows.map(row)))));
  };
  const single = table(false);
  const whole = table(true);
  return Rigor.panel('metrics', 'Metrics', whole, single ? (whole ? el('details', {}, el('summary', {}, 'By body, joint and quantity'), single) : single) : null);
};

/** The exact number beside what each engine measured and what its own scheme should have given. */
Rigor.quantitiesPanel = function (cases) {
  const {el} = Rigor;
  const names = [...new Set(cases.flatMap((c) => c.quantities.map((q) => q.name)))];
  if (!names.length) return null;
  const difference = (a, b) => (a === null || b === null ? null : Rigor.number(a) - Rigor.number(b));
  const group = function (name) {
    const rows = cases.map((c) => ({c, q: c.quantities.find((x) => x.name === name)})).filter((r) => r.q);
    const q0 = rows[0].q;
    return el('tbody', {}, el('tr', {class: 'sub'}, el('th', {colspan: 6}, name.replaceAll('_', ' '), q0.unit && q0.unit !== '1' ? ` [${q0.unit}]` : '')),
      rows.map(({c, q}) => el('tr', {}, el('th', {class: 'sticky', scope: 'row'}, Rigor.columnOf(c).label), Rigor.numberCell(q.exact, q.unit),
        q.measured === null ? el('td', {class: 'num muted', title: 'did not happen in this run'}, 'never') : Rigor.numberCell(q.measured, q.unit), Rigor.numberCell(difference(q.measured, q.exact), q.unit),
        Rigor.numberCell(q.schemeExact, q.unit), Rigor.numberCell(difference(q.measured, q.schemeExact), q.unit))));
  };
  return Rigor.panel('quantities', 'Quantities: exact, scheme-exact, measured',
    el('p', {class: 'muted'}, 'Exact is the physics. Scheme-exact is what a perfect run of the engine’s own time-stepping formula gives at this time step, where that has a closed form.'),
    Rigor.scroll(el('table', {}, el('thead', {}, el('tr', {}, ['Engine', 'Exact', 'Measured', 'Measured − exact', 'Scheme-exact', 'Measured − scheme-exact'].map((t, i) => el('th', {class: i ? 'num' : 'sticky', scope: 'col'}, t)))), names.map(group))));
};

Rigor.auditPanel = function (cases) {
  const {el} = Rigor;
  const audited = cases.filter((c) => c.audit.length);
  if (!audited.length) return null;
  const count = (n, bad) => el('td', {class: 'num'}, bad && n ? Rigor.chip('fail', n) : n);
  const row = (a) => el('tr', {}, el('th', {class: 'sticky', scope: 'row'}, a.auditor === 'in_run' ? 'the run itself' : a.auditor, a.outcome === 'completed' ? '' : el('span', {class: 'bound'}, a.outcome, a.note ? `: ${a.note}` : '')), count(a.frames), count(a.queries), count(a.overlapping), count(a.missed, true), count(a.spurious, true), count(a.undecided),
    el('td', {class: 'num', title: Rigor.full(a.normalErrorMax) + ' rad'}, Rigor.angle(a.normalErrorMax)), el('td', {class: 'num', title: Rigor.full(a.normalErrorMedian) + ' rad'}, Rigor.angle(a.normalErrorMedian)),
    Rigor.numberCell(a.depthErrorMax, 'm'), Rigor.numberCell(a.depthErrorMedian, 'm'), Rigor.numberCell(a.pointErrorMax, 'm'), el('td', {class: 'small'}, a.worst));
  const heads = ['Asked', 'Frames', 'Pairs', 'Overlap', 'Missed', 'Spurious', 'Undecided', 'Normal, worst', 'median', 'Depth, worst [m]', 'median [m]', 'Point, worst [m]', 'Worst at'];
  const pairs = audited.flatMap((c) => c.audit.filter((a) => a.auditor.includes('|')).map((a) => ({...a, poses: Rigor.columnOf(c).label})));
  const pairRow = (a) => el('tr', {}, el('th', {class: 'sticky', scope: 'row'}, a.auditor.replace('|', ' and ')), el('td', {}, a.poses), count(a.queries), count(a.overlapping), count(a.spurious), count(a.missed),
    el('td', {class: 'num', title: Rigor.full(a.normalErrorMax) + ' rad'}, Rigor.angle(a.normalErrorMax)), el('td', {class: 'num', title: Rigor.full(a.normalErrorMedian) + ' rad'}, Rigor.angle(a.normalErrorMedian)), Rigor.numberCell(a.depthErrorMax, 'm'), Rigor.numberCell(a.depthErrorMedian, 'm'));
  const pairHeads = ['Asked', 'Poses of', 'Pairs', 'Overlap for both', 'For the first alone', 'For the second alone', 'Normals apart, worst', 'median', 'Depths apart, worst [m]', 'median [m]'];
  return Rigor.panel('case-audit', 'Contact audit',
    el('p', {class: 'muted'}, 'Sampled poses of the run named in the grey rows: the contacts that the run itself acted upon, and every collision engine asked about the same poses, against the exact oracle.'),
    Rigor.scroll(el('table', {class: 'full'}, el('thead', {}, el('tr', {}, heads.map((t, i) => el('th', {class: i === 0 ? 'sticky' : i === heads.length - 1 ? null : 'num', scope: 'col'}, t)))),
      audited.map((c) => el('tbody', {}, el('tr', {class: 'sub'}, el('th', {colspan: heads.length}, `Poses of ${Rigor.columnOf(c).label}`)), c.audit.filter((a) => !a.auditor.includes('|')).map(row))))),
    pairs.length ? el('details', {id: 'audit-pairs'}, el('summary', {}, 'Collision engines against each other'), el('p', {class: 'muted'}, 'Normals that are both among the exact ones count as the same.'),
      Rigor.scroll(el('table', {class: 'full'}, el('thead', {}, el('tr', {}, pairHeads.map((t, i) => el('th', {class: i === 0 ? 'sticky' : i === 1 ? null : 'num', scope: 'col'}, t)))), el('tbody', {}, pairs.map(pairRow))))) : null);
};

Rigor.parityPanel = function (cases) {
  const {el} = Rigor;
  const rows = cases.flatMap((c) => c.ledger.map((l) => ({...l, label: Rigor.columnOf(c).label})));
  const read = cases.filter((c) => c.readBack.compared);
  if (!rows.length && !read.length) return null;
  const notExact = rows.filter((l) => l.realisation !== 'exact');
  const differing = read.flatMap((c) => c.readBack.differing.map((r) => ({...r, label: Rigor.columnOf(c).label})));
  const compared = read.reduce((sum, c) => sum + c.readBack.compared, 0), bad = read.reduce((sum, c) => sum + c.readBack.bad, 0);
  return Rigor.panel('parity', 'Parity: asked for and given',
    rows.length ? (notExact.length ? Rigor.scroll(Rigor.ledgerRows(notExact, false)) : el('p', {}, 'Every request was met exactly.')) : null,
    rows.length > notExact.length ? el('details', {}, el('summary', {}, `${rows.length - notExact.length} requests met exactly`), Rigor.scroll(Rigor.ledgerRows(rows.filter((l) => l.realisation === 'exact'), false))) : null,
    read.length ? [el('h3', {}, 'Read back from the engines'), el('p', {}, `${compared} values compared (mass, inertia, pose, velocity, gravity, pair coefficients), `, bad ? Rigor.chip('fail', `${bad} differ`) : Rigor.chip('pass', 'all as the scenario says'))] : null,
    differing.length ? Rigor.scroll(el('table', {}, el('thead', {}, el('tr', {}, ['Spec', 'Quantity', 'Of', 'Expected', 'Found', 'Error'].map((t, i) => el('th', {class: i > 2 ? 'num' : null, scope: 'col'}, t)))),
      el('tbody', {}, differing.map((r) => el('tr', {}, el('th', {scope: 'row'}, r.label), el('td', {}, r.quantity), el('td', {}, r.subject), Rigor.numberCell(r.expected), Rigor.numberCell(r.found), Rigor.numberCell(r.error)))))) : null);
};

Rigor.caseTimingPanel = function (scenario, cases) {
  const {el} = Rigor;
  const timed = cases.filter((c) => c.timings.length);
  if (!timed.length) return null;
  const main = (c) => c.metrics.find((m) => m.name === scenario.main.name && m.subject === '') || c.metrics.find((m) => m.name === scenario.main.name);
  const time = (v) => el('td', {class: 'num', title: Rigor.full(v) + ' s'}, Rigor.duration(v));
  const rows = timed.flatMap((c) => c.timings.map((t, i) => el('tr', {}, el('th', {class: 'sticky', scope: 'row'}, i ? '' : Rigor.columnOf(c).label), el('td', {}, t.phase), time(t.median), time(t.p10), time(t.p90), time(t.total),
    el('td', {class: 'num'}, t.samples), Rigor.numberCell(t.meanContacts), i ? el('td') : Rigor.numberCell(main(c)?.value ?? null, scenario.main.unit), el('td', {}, i ? '' : Rigor.chip(c.shown)))));
  return Rigor.panel('case-timing', 'Cost, beside accuracy', Rigor.scroll(el('table', {class: 'full'}, el('thead', {}, el('tr', {}, ['Engine', 'Phase', 'Median', '10 %', '90 %', 'Total', 'Samples', 'Contacts', `${scenario.main.name || 'Main metric'}`, 'Verdict'].map((t, i) => el('th', {class: i > 1 && i < 9 ? 'num' : i ? null : 'sticky', scope: 'col'}, t)))), el('tbody', {}, rows))));
};

Rigor.commandsPanel = function (cases, focus) {
  const {el} = Rigor;
  const copy = (text) => el('button', {class: 'button noprint', onclick: (e) => { navigator.clipboard?.writeText(text).then(() => { e.target.textContent = 'copied'; }, () => {}); }}, 'copy');
  const item = (c) => el('div', {class: 'case', 'data-spec': c.spec}, el('h3', {}, Rigor.columnOf(c).label, ' ', Rigor.chip(c.shown)),
    c.command ? el('div', {class: 'command'}, el('code', {}, c.command), copy(c.command)) : el('p', {class: 'empty'}, 'No command was stored.'),
    el('details', {open: c.spec === focus}, el('summary', {}, 'Settings and process'),
      el('dl', {class: 'facts'}, [['Spec', c.spec], ['Outcome', c.outcome + (c.reason ? `: ${c.reason}` : '')], ['Steps', c.steps], ['Wall, CPU time', `${Rigor.duration(c.wallSeconds)}, ${Rigor.duration(c.cpuSeconds)}`],
        ['Peak memory', `${(c.peakMemoryKiB / 1024).toFixed(1)} MiB`], ['Final state hash', c.stateHash || '—'], ['Trajectory', c.trajectoryFile || 'none'],
        ...Object.entries(c.settings)].map(([k, v]) => [el('dt', {}, k), el('dd', {}, String(v))]))));
  return Rigor.panel('commands', 'Reproduce each number', cases.map(item));
};
