// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The page of one scenario. `sections` is the order of its parts: a part is a function of the context
// {scenario, data, cases, dt, focus} that returns a node or null; the replay takes its place after the head.
'use strict';
Rigor.scenarioHead = function ({scenario, data, steps, dt, focus}) {
  const {el} = Rigor;
  const index = Rigor.run.scenarios.indexOf(scenario);
  const neighbour = (offset, text) => { const s = Rigor.run.scenarios[index + offset]; return s ? el('a', {href: Rigor.scenarioLink(s.name), title: s.name}, text) : null; };
  const facts = [
    ['Isolates', scenario.isolates.map((t) => el('span', {class: 'tag'}, t))], ['Reference', scenario.reference ? [scenario.referenceTitle || scenario.reference, el('span', {class: 'muted'}, ` (${scenario.reference})`)] : 'none: engines are compared with each other'],
    ['Source', [scenario.source, scenario.referenceSource && scenario.referenceSource !== scenario.source ? [scenario.source ? '; ' : '', scenario.referenceSource] : '']],
    ['Observed', scenario.observed.join(', ')], ['Scene', `${scenario.dimension}D, ${Rigor.format(scenario.duration)} s`], ['Tags', scenario.tags.map((t) => el('span', {class: 'tag'}, t))]];
  let pretty = data.text;
  try { pretty = JSON.stringify(JSON.parse(data.text), null, 2); } catch { /* shown as it is stored */ }
  return Rigor.panel('scenario', null,
    el('p', {class: 'small noprint'}, el('a', {href: '#scoreboard'}, '← scoreboard'), '  ·  ', neighbour(-1, 'previous'), index > 0 && index + 1 < Rigor.run.scenarios.length ? '  ·  ' : '', neighbour(1, 'next')),
    el('h1', {}, scenario.title || scenario.name), el('p', {class: 'muted'}, el('code', {}, scenario.name)), scenario.description ? el('p', {}, scenario.description) : null,
    el('div', {class: scenario.referenceFormula ? 'split' : null}, el('dl', {class: 'facts'}, facts.filter(([, v]) => v && v.length !== 0 && v !== '').map(([k, v]) => [el('dt', {}, k), el('dd', {}, v)])),
      scenario.referenceFormula ? el('div', {}, el('div', {class: 'muted small'}, 'Exact solution'), el('pre', {class: 'formula'}, scenario.referenceFormula)) : null),
    scenario.referenceProblem ? el('p', {class: 'notice'}, `The reference does not hold for these values: ${scenario.referenceProblem}`) : null,
    el('div', {class: 'controls noprint'}, el('span', {class: 'muted small'}, 'Time step'), el('span', {class: 'seg', role: 'group', 'aria-label': 'Time step'}, steps.map((step) =>
      el('a', {class: 'button', role: 'button', 'aria-pressed': String(step === dt), href: Rigor.scenarioLink(scenario.name, {dt: step, spec: focus})}, Rigor.timeStep(step))))),
    el('div', {class: 'stats'}, data.cases.filter((c) => c.dt === dt).map((c) => el('span', {class: `stat v v-${c.shown}`, title: c.reason, style: c.spec === focus ? 'box-shadow: inset 0 0 0 2px currentColor' : null}, Rigor.verdict(c.shown).symbol, ' ', Rigor.columnOf(c).label))),
    el('details', {}, el('summary', {}, 'Scenario file as run'), el('pre', {}, pretty)));
};

Rigor.sections = [
  (context) => Rigor.scenarioHead(context),
  // The replay's place: between the statement and the curves, which share its time cursor.
  ({cases, focus}) => Rigor.outcomesPanel(cases, focus),
  ({scenario, cases, focus}) => Rigor.curvesPanel(scenario, cases, focus),
  ({cases}) => Rigor.metricsPanel(cases),
  ({scenario, data}) => Rigor.ladderPanel(scenario, data),
  ({cases}) => Rigor.quantitiesPanel(cases),
  ({cases}) => Rigor.auditPanel(cases),
  ({cases}) => Rigor.parityPanel(cases),
  ({scenario, cases}) => Rigor.caseTimingPanel(scenario, cases),
  ({cases, focus}) => Rigor.commandsPanel(cases, focus)];

Rigor.scenarioPage = function (name, query) {
  const index = Rigor.run.scenarios.findIndex((s) => s.name === name);
  if (index < 0) return [Rigor.panel('missing', 'No such scenario', Rigor.el('p', {}, `This run has no scenario “${name}”.`))];
  const scenario = Rigor.run.scenarios[index];
  const data = Rigor.scenarioData(index);
  const steps = [...new Set(data.cases.map((c) => c.dt))].sort((a, b) => b - a);
  const asked = Number(query.get('dt'));
  const dt = steps.includes(asked) ? asked : steps[steps.length - 1];
  const context = {scenario, data, steps, dt, focus: query.get('spec'), cases: data.cases.filter((c) => c.dt === dt)};
  return Rigor.sections.map((section) => section(context)).filter(Boolean);
};
