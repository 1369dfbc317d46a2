// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The bodies of one source: all faces in one draw call and all edges in another, but for what is seen through and what
// has no faces. Nothing is allocated when the frame changes.
import { type BufferGeometry, type Color, Group, InstancedMesh, LineSegments, Mesh, Sphere, Vector3 } from 'three';
import { type Bounds, boundsOf } from './bounds.ts';
import type { Frame } from './frames.ts';
import { composeInto, stretchInto } from './matrices.ts';
import { Places } from './repeated.ts';
import type { Geometry, Scene } from './scene.ts';
import type { Template, TemplateCache } from './shape_meshes.ts';
import { TintMaterial } from './tint_material.ts';

/** Shapes that are drawn together. */
interface Batch {
  faces: Mesh<BufferGeometry, TintMaterial> | null;
  edges: LineSegments<BufferGeometry, TintMaterial>;
  targets: Target[];
  places: Places;
  glass: boolean; // walls before the scene
  shapes: Int32Array; // places in the layer's list of shapes, those of a template one after the other
}

/** The faces of the shapes of one template, for rays; they are not drawn. */
interface Target {
  mesh: InstancedMesh;
  first: number; // place of its first shape in the batch
}

/** Shapes of one template: places in the layer's list. */
type Alike = [template: Template, shapes: number[]];

export interface ShapeOfLayer {
  body: number;
  index: number; // index among the shapes of its body
  geometry: Geometry;
}

export interface BodyLook {
  faces: boolean;
  outlines: boolean;
  ghost: boolean; // translucent, outlined in its own colour
  behind: boolean; // hidden by what stands at the same place
  ink: string;
  dark: boolean;
}

const everywhere = new Sphere(new Vector3(), Number.POSITIVE_INFINITY);

export class BodyLayer {
  readonly group = new Group();
  readonly shapes: ShapeOfLayer[] = [];
  readonly rigid: Float32Array; // matrix of every shape without its size
  readonly #batches: Batch[] = [];
  readonly #local: Float64Array; // pose of every shape in its body
  readonly #scale: Float32Array;
  readonly #flat: boolean;
  #outlines = false;
  #mayLackEdges = false; // seen by its faces
  #edged = true;

  /** `skip`: bodies that another layer draws; `glass`: those that are seen through. */
  constructor(
    scene: Scene,
    templates: TemplateCache,
    skip: (body: number) => boolean = () => false,
    glass: (body: number) => boolean = () => false,
  ) {
    const flat = scene.dimension === 2;
    this.#flat = flat;
    const members = [new Map<Template, number[]>(), new Map<Template, number[]>()] as const;
    const local: number[] = [];
    const scale: number[] = [];
    scene.bodies.forEach((body, b) => {
      if (skip(b)) return;
      body.shapes.forEach(({ geometry, pose }, index) => {
        const sized = templates.of(geometry, scene.dimension);
        if (sized === null) return;
        const shape = this.shapes.push({ body: b, index, geometry }) - 1;
        local.push(...pose.position, ...pose.orientation);
        scale.push(...sized.scale);
        const alike = members[glass(b) ? 1 : 0];
        const list = alike.get(sized.template);
        if (list) list.push(shape);
        else alike.set(sized.template, [shape]);
      });
    });
    this.#local = Float64Array.from(local);
    this.#scale = Float32Array.from(scale);
    this.rigid = new Float32Array(16 * this.shapes.length);
    members.forEach((alike, glass) => {
      const all = [...alike];
      this.#addBatch(
        templates,
        all.filter(([template]) => template.faces),
        glass === 1,
      );
      this.#addBatch(
        templates,
        all.filter(([template]) => !template.faces),
        glass === 1,
      );
    });
  }

  #addBatch(templates: TemplateCache, alike: Alike[], glass: boolean): void {
    if (alike.length === 0) return;
    const copiesOf = (part: 'faces' | 'edges') =>
      templates.repeated(
        alike.map(([template, list]) => ({ geometry: template[part] as BufferGeometry, count: list.length })),
      );
    const shapes = Int32Array.from(alike.flatMap(([, list]) => list));
    const places = new Places(shapes.length);
    const edges = new LineSegments(copiesOf('edges'), new TintMaterial(false, places));
    edges.frustumCulled = false;
    edges.material.transparent = true;
    edges.renderOrder = this.#flat ? 2 : 1;
    this.group.add(edges);
    const batch: Batch = { faces: null, edges, targets: [], places, glass, shapes };
    if (alike.every(([template]) => template.faces)) this.#addFaces(batch, copiesOf('faces'), alike);
    this.#batches.push(batch);
  }

  #addFaces(batch: Batch, copies: BufferGeometry, alike: Alike[]): void {
    const material = new TintMaterial(!this.#flat, batch.places);
    if (batch.glass) {
      material.transparent = true;
      material.depthWrite = false;
      material.cover = 0.16;
    } else {
      material.polygonOffset = true;
      material.polygonOffsetFactor = 1;
      material.polygonOffsetUnits = 1;
    }
    batch.faces = new Mesh(copies, material);
    batch.faces.frustumCulled = false;
    batch.faces.renderOrder = this.#flat ? 1 : batch.glass ? 3 : 0;
    this.group.add(batch.faces);
    if (batch.glass) return; // a ray passes through it
    let first = 0;
    for (const [template, list] of alike) {
      const mesh = new InstancedMesh(template.faces as BufferGeometry, material, 0);
      mesh.instanceMatrix = batch.places.attribute(first);
      mesh.count = list.length;
      mesh.boundingSphere = everywhere; // a stale one would hide shapes from the pointer
      batch.targets.push({ mesh, first });
      first += list.length;
    }
  }

  /** Matrices of all shapes as they stand in the buffers that are drawn: the axes stretched to the shape's size. */
  get drawn(): { body: number; shape: number; matrix: number[] }[] {
    return this.#batches.flatMap(({ places, shapes }) =>
      [...shapes].map((s, i) => {
        const { body, index } = this.shapes[s] as ShapeOfLayer;
        return { body, shape: index, matrix: [...places.matrices.slice(16 * i, 16 * i + 16)] };
      }),
    );
  }

  /** Poses of a frame. */
  place(frame: Frame): void {
    for (let s = 0; s < this.shapes.length; ++s) {
      const body = (this.shapes[s] as ShapeOfLayer).body;
      composeInto(this.rigid, 16 * s, frame.position, frame.orientation, body, this.#local, 7 * s);
    }
    for (const batch of this.#batches) {
      const out = batch.places.matrices;
      for (let i = 0; i < batch.shapes.length; ++i) {
        const s = batch.shapes[i] as number;
        stretchInto(out, 16 * i, this.rigid, 16 * s, this.#scale, 3 * s);
      }
      batch.places.matrixTexture.needsUpdate = true;
    }
  }

  /** `colours`: three numbers a body, linear. */
  paint(colours: Float32Array): void {
    for (const batch of this.#batches) {
      const out = batch.places.colours;
      let changed = false;
      for (let i = 0; i < batch.shapes.length; ++i) {
        const b = 3 * (this.shapes[batch.shapes[i] as number] as ShapeOfLayer).body;
        for (let k = 0; k < 3; ++k) {
          const value = colours[b + k] as number;
          changed ||= out[4 * i + k] !== value;
          out[4 * i + k] = value;
        }
      }
      if (changed) batch.places.colourTexture.needsUpdate = true;
    }
  }

  look(look: BodyLook, inkColour: Color): void {
    const { ghost, faces, behind } = look;
    const coloured = ghost || !faces;
    inkColour.set(coloured ? '#ffffff' : look.ink);
    this.#outlines = look.outlines;
    this.#mayLackEdges = !coloured;
    for (const batch of this.#batches) {
      const line = batch.edges.material;
      line.color.copy(inkColour);
      line.own = coloured;
      line.cover = behind ? 0.9 : coloured ? 0.95 : look.dark ? 0.75 : 0.6;
      line.depthTest = !this.#flat && !behind; // a reference inside of its body is still seen
      if (!batch.faces) continue;
      batch.faces.visible = faces;
      batch.faces.material.sky = look.dark ? 1 : 1.35;
      if (!batch.glass) this.#lookOf(batch.faces.material, look);
    }
    this.#showEdges();
  }

  /** False: bodies that are seen by their faces have no edges, which in software take longer to draw than the faces. */
  set edged(on: boolean) {
    if (on === this.#edged) return;
    this.#edged = on;
    this.#showEdges();
  }

  #showEdges(): void {
    const shown = this.#outlines && (this.#edged || !this.#mayLackEdges);
    for (const { edges, faces } of this.#batches) edges.visible = shown || faces === null; // chains have nothing else
  }

  #lookOf(surface: TintMaterial, { ghost, behind }: BodyLook): void {
    surface.transparent = ghost || this.#flat;
    surface.cover = behind ? 0.1 : ghost ? 0.25 : this.#flat ? 0.85 : 1;
    surface.depthWrite = !ghost && !this.#flat;
    surface.depthTest = !this.#flat;
    surface.polygonOffsetFactor = surface.polygonOffsetUnits = behind ? 4 : 1;
  }

  /** Box of a shape where it was last placed. */
  bounds(shape: number, out: Bounds): boolean {
    const { geometry } = this.shapes[shape] as ShapeOfLayer;
    return this.rigid[16 * shape + 15] === 1 && boundsOf(geometry, this.rigid, 16 * shape, out);
  }

  /** Meshes to aim at, and the shape behind an instance of one. */
  get targets(): InstancedMesh[] {
    return this.#batches.flatMap(({ targets }) => targets.map(({ mesh }) => mesh));
  }
  shapeOf(mesh: unknown, instance: number): ShapeOfLayer | null {
    for (const { targets, shapes } of this.#batches) {
      const target = targets.find((t) => t.mesh === mesh);
      const shape = target && shapes[target.first + instance];
      if (shape !== undefined) return this.shapes[shape] as ShapeOfLayer;
    }
    return null;
  }

  dispose(): void {
    for (const { faces, edges, targets, places } of this.#batches) {
      faces?.material.dispose();
      edges.material.dispose();
      for (const { mesh } of targets) mesh.dispose();
      places.dispose();
    }
  }
}
