// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The bodies of one source: faces and edges, one draw call each for every kind of shape. Nothing is allocated when the
// frame changes.
import {
  type BufferGeometry,
  type Color,
  DynamicDrawUsage,
  Group,
  InstancedBufferAttribute,
  InstancedMesh,
  LineBasicMaterial,
  LineSegments,
  type Material,
  MeshBasicMaterial,
  MeshLambertMaterial,
  Sphere,
  Vector3,
} from 'three';
import { type Bounds, boundsOf } from './bounds.ts';
import type { Frame } from './frames.ts';
import { composeInto, stretchInto } from './matrices.ts';
import type { Geometry, Scene } from './scene.ts';
import type { Template, TemplateCache } from './shape_meshes.ts';

/** Line segments drawn once for each matrix; three.js draws whatever says isInstancedMesh that way. */
class InstancedLines extends LineSegments<BufferGeometry, LineBasicMaterial> {
  readonly isInstancedMesh = true;
  readonly instanceMatrix: InstancedBufferAttribute;
  instanceColor: InstancedBufferAttribute | null = null;
  readonly morphTexture = null;
  override count: number;

  constructor(geometry: BufferGeometry, material: LineBasicMaterial, matrices: InstancedBufferAttribute) {
    super(geometry, material);
    this.instanceMatrix = matrices;
    this.count = matrices.count;
    this.frustumCulled = false;
  }
}

/** All shapes that are drawn from one template. */
interface Batch {
  faces: InstancedMesh | null;
  edges: InstancedLines;
  matrices: InstancedBufferAttribute;
  colours: InstancedBufferAttribute;
  bodies: Int32Array;
  shapes: Int32Array; // place in the layer's list of shapes
}

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
  readonly #surface: Material;
  readonly #glass: Material; // material of walls before the scene
  readonly #line: LineBasicMaterial;

  /** `skip`: bodies that another layer draws; `glass`: those that are seen through. */
  constructor(
    scene: Scene,
    templates: TemplateCache,
    skip: (body: number) => boolean = () => false,
    glass: (body: number) => boolean = () => false,
  ) {
    const flat = scene.dimension === 2;
    this.#surface = flat ? new MeshBasicMaterial() : new MeshLambertMaterial();
    this.#surface.polygonOffset = true;
    this.#surface.polygonOffsetFactor = 1;
    this.#surface.polygonOffsetUnits = 1;
    this.#glass = new MeshLambertMaterial({ transparent: true, opacity: 0.16, depthWrite: false });
    this.#line = new LineBasicMaterial();
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
    for (const [template, list] of members[0]) this.#addBatch(template, list, flat, this.#surface);
    for (const [template, list] of members[1]) this.#addBatch(template, list, flat, this.#glass);
  }

  #addBatch(template: Template, shapes: number[], flat: boolean, material: Material): void {
    const n = shapes.length;
    const matrices = new InstancedBufferAttribute(new Float32Array(16 * n), 16);
    const colours = new InstancedBufferAttribute(new Float32Array(3 * n), 3);
    matrices.setUsage(DynamicDrawUsage);
    let faces: InstancedMesh | null = null;
    if (template.faces) {
      faces = new InstancedMesh(template.faces, material, 0);
      faces.instanceMatrix = matrices;
      faces.instanceColor = colours;
      faces.count = n;
      faces.frustumCulled = false;
      faces.boundingSphere = everywhere; // a stale one would hide shapes from the pointer
      faces.renderOrder = flat ? 1 : material === this.#glass ? 3 : 0;
      this.group.add(faces);
    }
    const edges = new InstancedLines(template.edges, this.#line, matrices);
    edges.renderOrder = flat ? 2 : 1;
    this.group.add(edges);
    const bodies = Int32Array.from(shapes, (s) => this.shapes[s]?.body ?? 0);
    this.#batches.push({ faces, edges, matrices, colours, bodies, shapes: Int32Array.from(shapes) });
  }

  /** Matrices of all shapes as they stand in the buffers that are drawn: the axes stretched to the shape's size. */
  get drawn(): { body: number; shape: number; matrix: number[] }[] {
    return this.#batches.flatMap(({ edges, shapes }) =>
      [...shapes].map((s, i) => {
        const { body, index } = this.shapes[s] as ShapeOfLayer;
        return { body, shape: index, matrix: [...edges.instanceMatrix.array.slice(16 * i, 16 * i + 16)] };
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
      const out = batch.matrices.array as Float32Array;
      for (let i = 0; i < batch.shapes.length; ++i) {
        const s = batch.shapes[i] as number;
        stretchInto(out, 16 * i, this.rigid, 16 * s, this.#scale, 3 * s);
      }
      batch.matrices.needsUpdate = true;
    }
  }

  /** `colours`: three numbers a body, linear. */
  paint(colours: Float32Array): void {
    for (const batch of this.#batches) {
      const out = batch.colours.array as Float32Array;
      for (let i = 0; i < batch.bodies.length; ++i) {
        const b = 3 * (batch.bodies[i] as number);
        out[3 * i] = colours[b] as number;
        out[3 * i + 1] = colours[b + 1] as number;
        out[3 * i + 2] = colours[b + 2] as number;
      }
      batch.colours.needsUpdate = true;
    }
  }

  look({ faces, outlines, ghost, behind, ink, dark }: BodyLook, inkColour: Color): void {
    const flat = this.#surface instanceof MeshBasicMaterial;
    const surface = this.#surface;
    surface.transparent = ghost || flat;
    surface.opacity = behind ? 0.1 : ghost ? 0.25 : flat ? 0.85 : 1;
    surface.depthWrite = !ghost && !flat;
    surface.depthTest = !flat;
    surface.polygonOffsetFactor = surface.polygonOffsetUnits = behind ? 4 : 1;
    const coloured = ghost || !faces;
    this.#line.color.copy(coloured ? inkColour.set('#ffffff') : inkColour.set(ink));
    this.#line.transparent = true;
    this.#line.opacity = behind ? 0.9 : coloured ? 0.95 : dark ? 0.75 : 0.6;
    this.#line.depthTest = !flat && !behind; // a reference inside of its body is still seen
    for (const batch of this.#batches) {
      if (batch.faces) batch.faces.visible = faces;
      const alone = batch.faces === null; // chains have nothing else
      batch.edges.visible = outlines || alone;
      batch.edges.instanceColor = coloured ? batch.colours : null;
    }
  }

  /** Box of a shape where it was last placed. */
  bounds(shape: number, out: Bounds): boolean {
    const { geometry } = this.shapes[shape] as ShapeOfLayer;
    return this.rigid[16 * shape + 15] === 1 && boundsOf(geometry, this.rigid, 16 * shape, out);
  }

  /** Meshes to aim at, and the shape behind an instance of one. */
  get targets(): InstancedMesh[] {
    return this.#batches.flatMap(({ faces }) => (faces && faces.material !== this.#glass ? [faces] : []));
  }
  shapeOf(mesh: unknown, instance: number): ShapeOfLayer | null {
    const batch = this.#batches.find((b) => b.faces === mesh);
    const shape = batch?.shapes[instance];
    return shape === undefined ? null : (this.shapes[shape] as ShapeOfLayer);
  }

  dispose(): void {
    for (const batch of this.#batches) batch.faces?.dispose();
    this.#surface.dispose();
    this.#glass.dispose();
    this.#line.dispose();
  }
}
