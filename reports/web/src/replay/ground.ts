// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Half-spaces: a grid on the surface that fades away, or in 2D a filled half with a line.
import {
  Color,
  DoubleSide,
  Group,
  type LineSegments,
  Mesh,
  PlaneGeometry,
  Quaternion,
  ShaderMaterial,
  Vector3,
} from 'three';
import type { Theme } from './colours.ts';
import { gridLines, groundLines } from './ground_lines.ts';
import type { Scene } from './scene.ts';
import { add, rotate, scaled, type Vec3 } from './vectors.ts';

const vertexShader =
  'varying vec2 at; void main() { at = position.xy; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }';
const gridShader =
  'uniform vec3 colour; uniform float cell; uniform float reach; uniform vec2 shift; varying vec2 at;' +
  'float lines(float size) { vec2 c = (at + shift) / size; vec2 w = max(fwidth(c), 1e-6);' +
  ' vec2 d = abs(fract(c - 0.5) - 0.5) / w; return (1.0 - min(min(d.x, d.y), 1.0)) * clamp(0.7 / max(w.x, w.y) - 1.0, 0.0, 1.0); }' +
  'void main() { float fade = 1.0 - smoothstep(0.25, 1.0, length(at) / reach);' +
  ' float a = max(0.35 * lines(cell), 0.7 * lines(5.0 * cell)); gl_FragColor = vec4(colour, (0.07 + a) * fade);' +
  ' \n#include <colorspace_fragment>\n }';
const halfShader =
  'uniform vec3 colour; uniform float cell; varying vec2 at; void main() {' +
  ' float c = (at.x + at.y) / (0.6 * cell); float w = max(fwidth(c), 1e-6); float d = abs(fract(c - 0.5) - 0.5) / w;' +
  ' float hatch = (1.0 - min(d, 1.0)) * 0.35 * clamp(0.4 / w, 0.0, 1.0); float y = -at.y / max(fwidth(at.y), 1e-9);' +
  ' float edge = 1.0 - smoothstep(1.2, 2.2, y); gl_FragColor = vec4(colour, max(max(0.12, hatch), edge));' +
  ' \n#include <colorspace_fragment>\n }';

/** A round number near x: 1, 2 or 5 times a power of ten. */
export function roundNumber(x: number): number {
  const power = 10 ** Math.floor(Math.log10(x));
  const m = x / power;
  return (m < 1.5 ? 1 : m < 3.5 ? 2 : m < 7.5 ? 5 : 10) * power;
}

export class Ground {
  readonly group = new Group();
  readonly #scene: Scene;
  readonly #materials: ShaderMaterial[] = [];
  readonly #plane = new PlaneGeometry(2, 2);
  #inLines = false;

  constructor(scene: Scene) {
    this.#scene = scene;
  }

  /** Builds the ground around the box that the camera frames. */
  build(center: Vec3, radius: number, theme: Theme): void {
    this.#clear();
    const flat = this.#scene.dimension === 2;
    const cell = roundNumber(radius / 4);
    const reach = radius * (flat ? 60 : 9);
    for (const body of this.#scene.bodies)
      for (const { geometry, pose } of body.shapes) {
        if (geometry.kind !== 'half_space') continue;
        const q = body.first.orientation;
        const n = rotate(q, rotate(pose.orientation, geometry.normal));
        const origin = add(body.first.position, rotate(q, pose.position));
        const height = geometry.offset + n[0] * origin[0] + n[1] * origin[1] + n[2] * origin[2];
        const away = n[0] * center[0] + n[1] * center[1] + n[2] * center[2] - height;
        const foot = add(center, scaled(n, -away));
        this.#add(flat, foot, n, cell, reach, theme);
      }
  }

  /** Drawn as lines alone, or shaded. In 2D it is always shaded. */
  set inLines(on: boolean) {
    this.#inLines = on && this.#scene.dimension === 3;
    for (const child of this.group.children) child.visible = (child.type === 'LineSegments') === this.#inLines;
  }

  #add(flat: boolean, foot: Vec3, n: Vec3, cell: number, reach: number, theme: Theme): void {
    const normal = new Vector3(...n);
    const rotation = new Quaternion();
    const shift: [number, number] = [0, 0];
    if (flat) rotation.setFromUnitVectors(new Vector3(0, 1, 0), normal);
    else {
      rotation.setFromUnitVectors(new Vector3(0, 0, 1), normal);
      const [u, v] = [new Vector3(1, 0, 0), new Vector3(0, 1, 0)].map((e) => e.applyQuaternion(rotation));
      shift[0] = new Vector3(...foot).dot(u as Vector3) % (5 * cell);
      shift[1] = new Vector3(...foot).dot(v as Vector3) % (5 * cell);
    }
    const material = new ShaderMaterial({
      transparent: true,
      depthWrite: false,
      side: DoubleSide,
      uniforms: {
        colour: { value: new Color(theme.ground) },
        cell: { value: cell },
        reach: { value: reach },
        shift: { value: shift },
      },
      vertexShader,
      fragmentShader: flat ? halfShader : gridShader,
    });
    // the shader reads lengths: the plane's corners are in metres
    const geometry = this.#plane.clone().scale(reach, reach, 1);
    if (flat) geometry.translate(0, -reach, 0);
    this.#materials.push(material);
    const drawn: (Mesh | LineSegments)[] = [new Mesh(geometry, material)];
    if (!flat) {
      const lines = groundLines(gridLines(cell, 0.25 * reach, reach, shift), theme.ground);
      this.#materials.push(lines.material);
      drawn.push(lines);
    }
    for (const object of drawn) {
      object.matrixAutoUpdate = false;
      object.matrix.compose(new Vector3(...foot), rotation, new Vector3(1, 1, 1));
      object.renderOrder = -1;
      this.group.add(object);
    }
    this.inLines = this.#inLines;
  }

  #clear(): void {
    for (const child of [...this.group.children]) {
      (child as Mesh).geometry.dispose();
      this.group.remove(child);
    }
    for (const material of this.#materials) material.dispose();
    this.#materials.length = 0;
  }

  dispose(): void {
    this.#clear();
    this.#plane.dispose();
  }
}
