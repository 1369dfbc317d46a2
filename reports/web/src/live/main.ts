// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The live view: picture, transport, instances, branches, what a step is made of. The server runs the simulation; this
// page requests the newest frames and sends the user's requests.
import { el } from '../common/elements.ts';
import { timeStep } from '../common/format.ts';
import { drawnKinds, type LayerName } from '../replay/layers.ts';
import { decodeLink, encodeLink, viewOfHash, withView } from '../replay/link.ts';
import { readScene, type Scene } from '../replay/scene.ts';
import { NoWebGL } from '../replay/view.ts';
import * as api from './api.ts';
import { BranchForm, type Settings } from './branch_form.ts';
import type { Held } from './drag.ts';
import { InstancesPanel } from './instances_panel.ts';
import { bindKeys, helpDialog } from './keys.ts';
import { Picture } from './picture.ts';
import { SessionView } from './session_view.ts';
import { StagesPanel } from './stages_panel.ts';
import { Arrangement, Transport } from './transport.ts';
import '../common/theme.css';
import '../replay/style.css';
import './style.css';

const session = new SessionView();
const said = el('p', { class: 'said', role: 'alert' });
const help = helpDialog();
const branch = new BranchForm(session);
const instances = new InstancesPanel(
  session,
  (instance) => void openBranch(instance),
  (instance) => void save(instance),
);
const stages = new StagesPanel((on) => void session.send({ command: 'stages', on }));
const transport = new Transport(session, switchLayer, () => help.showModal());
const arrangement = new Arrangement(
  (options) => {
    picture?.view.setOptions(options);
    changed();
  },
  () => picture?.frame(),
);
const title = el('h1');
const about = el('p', { class: 'about' });
const open = el('select', { 'aria-label': 'Another scenario' }, el('option', { value: '' }, 'another scenario …'));
const stage = el('div', { class: 'replay live-picture' });
let picture: Picture | null = null;
let scenario = '';
let remembering: ReturnType<typeof setTimeout> | undefined;

function changed(): void {
  if (picture) {
    const { layers } = picture.view.options;
    const on = (Object.keys(drawnKinds) as LayerName[]).filter((name) => layers[name]);
    session.lines = on.map((name) => drawnKinds[name] as string);
  }
  transport.refresh(picture?.view ?? null);
  if (picture) arrangement.refresh(picture.view);
  clearTimeout(remembering);
  remembering = setTimeout(() => {
    if (!picture) return;
    const camera = picture.byHand ? { camera: picture.view.camera } : {};
    const state = encodeLink({ options: picture.view.options, ...camera });
    history.replaceState(null, '', withView(location.hash, state));
  }, 300);
}

function switchLayer(name: LayerName): void {
  if (!picture) return;
  const { layers } = picture.view.options;
  picture.view.setOptions({ layers: { ...layers, [name]: !layers[name] } });
  changed();
}

const drag = (held: Held | null) =>
  held ? session.send({ command: 'drag', ...held }) : session.send({ command: 'release' });

async function openBranch(instance: api.InstanceState): Promise<void> {
  const { description } = await api.scene(instance.id);
  branch.open(instance, { ...(description.settings as Settings) });
}

/** Saves to the folder that was passed to `rigor view`, or as a download if the name exists there. */
async function save(instance: api.InstanceState): Promise<void> {
  const answer = await session.send({ command: 'save', instance: instance.id, write: true });
  if (!answer) return;
  const notes = (answer.notes as string[]).length > 0 ? ` Not kept: ${(answer.notes as string[]).join('; ')}.` : '';
  said.textContent = `Saved as ${answer.file}.${notes}`;
}

/** The picture of another scenario. */
async function show(first: number): Promise<void> {
  let scene: Scene;
  try {
    scene = readScene((await api.scene(first)).scenario);
    picture?.dispose();
    picture = new Picture(stage, scene, drag);
    Object.assign(stage, { picture }); // tests and the browser's tools find it there
  } catch (error) {
    stage.replaceChildren(
      el(
        'p',
        { class: 'replay-note' },
        error instanceof NoWebGL
          ? 'This browser shows no WebGL, which the live view needs.'
          : `The scene cannot be shown: ${error instanceof Error ? error.message : String(error)}.`,
      ),
    );
    return;
  }
  stages.scene = scene;
  picture.setInstances(session.instances.filter((instance) => instance.times.length > 0));
  const link = decodeLink(viewOfHash(location.hash));
  if (link.options) picture.view.setOptions(link.options);
  if (link.camera) picture.setCamera(link.camera);
  picture.onChange = changed;
  changed();
}

session.onSay = (text) => {
  said.textContent = text;
};
session.onEnd = (text) => {
  document.body.prepend(el('p', { class: 'ended', role: 'alert' }, text));
};
session.onNews = (others) => {
  const state = session.state as api.SessionState;
  const first = state.instances[0];
  title.textContent = state.title;
  about.textContent = `${state.scenario} · ${state.dimension}D · step ${timeStep(state.dt)}`;
  document.title = `${state.scenario} · Rigor live`;
  if (state.scenario !== scenario && first) {
    scenario = state.scenario;
    void show(first.id);
  } else if (others) {
    picture?.setInstances(session.instances.filter((instance) => instance.times.length > 0));
  } else {
    picture?.update();
  }
  if (others) stages.setInstances(session.instances.filter((_, i) => state.instances[i]?.has_stages));
  transport.refresh(picture?.view ?? null);
  instances.refresh();
  stages.refresh();
};

bindKeys({
  send: (command, steps) => void session.send(steps === undefined ? { command } : { command, steps }),
  toggle: () => transport.toggle(),
  shiftSpeed: (by) => transport.shiftSpeed(by),
  layer: switchLayer,
  overlay: () => {
    if (picture) picture.view.setOptions({ overlaid: !picture.view.options.overlaid });
    changed();
  },
  frame: () => picture?.frame(),
  help: () => (help.open ? help.close() : help.showModal()),
});

open.addEventListener('change', () => {
  if (open.value !== '') void session.send({ command: 'open', scenario: open.value });
  open.value = '';
});

document.body.append(
  el('header', {}, el('div', {}, title, about), el('span', { class: 'spring' }), open),
  el(
    'main',
    {},
    el(
      'div',
      { class: 'left replay' },
      stage,
      transport.element,
      el('div', { class: 'switches' }, arrangement.element),
      said,
    ),
    el('aside', {}, instances.element, stages.element),
  ),
  branch.element,
  help,
);
void session.follow();
void api.engines().then((list) => {
  branch.setEngines(list);
  instances.setEngines(list);
});
void api.scenarios().then((list) => {
  open.append(...list.map(({ name, title: text }) => el('option', { value: name, title: text }, name)));
});
