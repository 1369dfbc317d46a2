// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Everything of one source in a three.js scene of its own: bodies, overlays and ground.
import { Color, Scene as ThreeScene } from 'three';
import type { ContactFinding } from '../common/finding.ts';
import { BodyLayer } from './body_layer.ts';
import { distinctColour, type Theme } from './colours.ts';
import { FindingOverlay } from './finding_overlay.ts';
import { type Frame, type FrameSource, indexAt } from './frames.ts';
import type { Framing } from './framing.ts';
import { Ground } from './ground.ts';
import { findIslands, UnionFind } from './islands.ts';
import type { ViewOptions } from './layers.ts';
import { type ArrowScales, Overlays } from './overlays.ts';
import type { Scene } from './scene.ts';
import type { TemplateCache } from './shape_meshes.ts';
import { drawsInSoftware } from './software.ts';

export interface Drawn {
  bodies: BodyLayer['drawn'];
  arrows: Overlays['arrows'];
  lines: Overlays['lines'];
  dots: Overlays['dots'];
  witnesses: FindingOverlay['points'];
}

export class SourceLayer {
  readonly three = new ThreeScene();
  readonly source: FrameSource;
  readonly bodies: BodyLayer;
  readonly #scene: Scene;
  readonly #overlays: Overlays;
  readonly #findings = new FindingOverlay();
  #finding: { finding: ContactFinding; length: number } | null = null;
  readonly #ground: Ground;
  readonly #colours: Float32Array;
  readonly #islands: Int32Array;
  readonly #sets: UnionFind;
  readonly #moves: boolean[];
  readonly #c = new Color();
  #shown = -1;
  #frame: Frame | null = null;

  /** `withStatics`: false where another layer of the same picture draws them; `glass`: bodies seen through. */
  constructor(
    scene: Scene,
    source: FrameSource,
    templates: TemplateCache,
    withStatics: boolean,
    glass: ReadonlySet<number>,
  ) {
    this.#scene = scene;
    this.source = source;
    const skip = (b: number) => !withStatics && scene.bodies[b]?.type === 'static';
    this.bodies = new BodyLayer(scene, templates, skip, (b) => glass.has(b));
    this.#overlays = new Overlays(scene);
    this.#ground = new Ground(scene);
    if (!withStatics) this.#ground.group.visible = false;
    this.#colours = new Float32Array(3 * scene.bodies.length);
    this.#islands = new Int32Array(scene.bodies.length);
    this.#sets = new UnionFind(scene.bodies.length);
    this.#moves = scene.bodies.map((body) => body.type === 'dynamic');
    this.three.matrixAutoUpdate = false;
    this.three.add(this.bodies.group, this.#overlays.group, this.#findings.group, this.#ground.group);
  }

  get frame(): Frame | null {
    return this.#frame;
  }
  get index(): number {
    return this.#shown;
  }

  /** Content of the picture as numbers, read from the buffers that are drawn. */
  get drawn(): Drawn {
    return {
      bodies: this.bodies.drawn,
      arrows: [...this.#overlays.arrows, ...this.#findings.arrows],
      lines: this.#overlays.lines,
      dots: this.#overlays.dots,
      witnesses: this.#findings.points,
    };
  }

  build(framing: Framing, theme: Theme, pixelRatio: number): void {
    this.#ground.build(framing.center, framing.radius, theme);
    this.pixelRatio = pixelRatio;
  }

  /** Pixels of the canvas in one of the page: dots keep their size. */
  set pixelRatio(ratio: number) {
    this.#findings.pixels = 11 * ratio;
    this.#overlays.pixels = (this.#scene.bodies.length > 60 ? 5 : 8) * ratio;
  }

  /** The ground as lines alone, which costs little, or shaded. */
  set groundInLines(on: boolean) {
    this.#ground.inLines = on;
  }

  /** False: bodies without their edges, where they are seen by their faces. */
  set edged(on: boolean) {
    this.bodies.edged = on;
  }

  /** Whether the frame of a time is the one that is shown. */
  isAt(time: number): boolean {
    const { times } = this.source;
    return times.length === 0 || (this.#frame !== null && indexAt(times, time) === this.#shown);
  }

  /** The frame at a time; true when that is another one than before. */
  seek(time: number): boolean {
    const { times } = this.source;
    if (this.isAt(time)) return false;
    const index = indexAt(times, time);
    this.#shown = index;
    this.#frame = this.source.frame(index);
    this.bodies.place(this.#frame);
    return true;
  }

  /** Reads the shown frame again: the source has changed it. */
  forget(): void {
    this.#shown = -1;
  }

  /** A finding to draw in its frame, with arrows of this length [m]. */
  set finding(found: { finding: ContactFinding; length: number } | null) {
    this.#finding = found;
  }

  /** Colours and overlays of the shown frame. */
  paint(options: ViewOptions, theme: Theme, scales: ArrowScales, marked: number): void {
    if (!this.#frame) return;
    this.#colour(options, theme, marked);
    this.bodies.paint(this.#colours);
    const ghost = this.source.ghost !== options.overlaid; // overlaid engines are ghosts on the reference
    const behind = this.source.ghost && ghost;
    this.bodies.look(
      {
        // In software the faces of a ghost, a tenth as strong as its outlines, would cost as much as those of an engine.
        faces: options.layers.faces && !(behind && drawsInSoftware()),
        outlines: options.layers.outlines || ghost,
        ghost,
        behind,
        ink: theme.ink,
        dark: theme.dark,
      },
      this.#c,
    );
    const found = this.#finding?.finding.step === this.#frame.step ? this.#finding : null;
    // other contacts would hide the one that is shown
    const layers = found ? { ...options.layers, contacts: false, normals: false } : options.layers;
    this.#overlays.draw(this.source, this.#frame, this.bodies, { ...options, layers }, theme, scales, this.#colours);
    this.#findings.draw(found?.finding ?? null, theme, found?.length ?? 0);
  }

  /** Island of a body at this frame; -1: it belongs to none. */
  islandOf(body: number): number {
    return this.#islands[body] ?? -1;
  }

  #colour(options: ViewOptions, theme: Theme, marked: number): void {
    const light = theme.dark ? 0.58 : 0.56;
    findIslands(this.#moves, this.#frame?.contacts ?? null, this.#scene.joints, this.#sets, this.#islands);
    const byEngine = options.colouring === 'engine' || this.source.ghost;
    for (let b = 0; b < this.#scene.bodies.length; ++b) {
      if (this.#scene.bodies[b]?.type === 'static') this.#c.set(theme.still);
      else if (byEngine) this.#c.set(this.source.ghost ? theme.ghost : this.source.colour);
      else if (options.colouring === 'island') distinctColour(this.#islands[b] as number, light, this.#c);
      else distinctColour(b, light, this.#c);
      if (b === marked) this.#c.lerp(white, theme.dark ? 0.45 : 0.5);
      this.#colours[3 * b] = this.#c.r;
      this.#colours[3 * b + 1] = this.#c.g;
      this.#colours[3 * b + 2] = this.#c.b;
    }
  }

  dispose(): void {
    this.bodies.dispose();
    this.#overlays.dispose();
    this.#findings.dispose();
    this.#ground.dispose();
  }
}
const white = new Color('#ffffff');
