// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The one camera of all pictures: straight at the plane of a flat scene, else turned and moved by hand. Until the user
// does, it stands so that everything that moves is seen below the label of a picture.
import { type Camera, OrthographicCamera, PerspectiveCamera, Vector3 } from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import type { Framing } from './framing.ts';
import type { Rect } from './picking.ts';
import type { Scene } from './scene.ts';
import type { Vec3 } from './vectors.ts';

export interface CameraState {
  position: Vec3;
  target: Vec3;
  zoom: number;
}

const halfAngle = (15 * Math.PI) / 180; // half of the camera's vertical field of view

/** Motions of the camera while its picture has the focus: to the right, up and nearer. */
const cameraKeys: Record<string, [right: number, up: number, nearer: number]> = {
  ',': [-1, 0, 0],
  '.': [1, 0, 0],
  ArrowUp: [0, 1, 0],
  ArrowDown: [0, -1, 0],
  PageUp: [0, 0, 1],
  PageDown: [0, 0, -1],
};
const turnStep = Math.PI / 24;
const nearStep = 1.15;

/** Part of a picture's height that the scene may take: labels stand above it. */
const clearOf = (rect: Rect) => Math.min(0.88, Math.max(0.6, 1 - 100 / rect.height));

export class CameraRig {
  /** The camera was moved, by the user or by a call; after a drag once it has ended. */
  onChange: (() => void) | null = null;
  onHand: (() => void) | null = null;
  /** Width of the scene over its height, as it is seen. */
  wide = 1.25;
  framing: Framing = { center: [0, 0, 0], radius: 1, low: [-1, -1, -1], high: [1, 1, 1] };

  readonly #camera: PerspectiveCamera | OrthographicCamera;
  readonly #controls: OrbitControls;
  readonly #canvas: HTMLCanvasElement;
  readonly #flat: boolean;
  readonly #up = new Vector3(0, 1, 0);
  #byHand = false; // it stands where the user put it

  constructor(scene: Scene, canvas: HTMLCanvasElement) {
    this.#canvas = canvas;
    this.#flat = scene.dimension === 2;
    this.#camera = this.#flat
      ? new OrthographicCamera()
      : new PerspectiveCamera((360 / Math.PI) * halfAngle, 1, 0.01, 1000);
    const against = new Vector3(...scene.gravity).negate();
    if (!this.#flat && against.lengthSq() > 1e-12) this.#up.copy(against.normalize());
    this.#camera.up.copy(this.#up); // set before the controls are made: they turn about it
    this.#controls = new OrbitControls(this.#camera, canvas);
    this.#controls.enableRotate = !this.#flat;
    this.#controls.screenSpacePanning = true;
    this.#controls.zoomSpeed = 1.4;
    if (this.#flat) this.#controls.mouseButtons = { LEFT: 2, MIDDLE: 1, RIGHT: 2 };
    this.#controls.addEventListener('change', () => this.onChange?.());
    this.#controls.addEventListener('start', () => {
      this.#byHand = true;
    });
    this.#controls.addEventListener('end', () => this.onHand?.());
    canvas.addEventListener('keydown', this.#press);
  }

  readonly #press = (event: KeyboardEvent): void => {
    const step = cameraKeys[event.key];
    if (!step || event.ctrlKey || event.metaKey || event.altKey) return;
    this.steer(...step);
    this.onHand?.();
    event.preventDefault();
    event.stopPropagation();
  };

  /** Steps of the keyboard: turns about what it looks at, or moves along a flat scene, and comes nearer. */
  steer(right: number, up: number, nearer: number): void {
    this.#byHand = true;
    const away = this.#camera.position.clone().sub(this.#controls.target);
    if (this.#flat) {
      const by = (0.1 * this.framing.radius) / this.#camera.zoom;
      this.#controls.target.add(new Vector3(right * by, up * by, 0));
      this.#camera.zoom *= nearStep ** nearer;
    } else {
      away.applyAxisAngle(this.#up, turnStep * right);
      const tilt = Math.min(Math.PI - 0.05, Math.max(0.05, away.angleTo(this.#up) - turnStep * up));
      const level = new Vector3().crossVectors(this.#up, away).normalize();
      away.applyAxisAngle(level, tilt - away.angleTo(this.#up));
      away.multiplyScalar(nearStep ** -nearer);
    }
    this.#camera.position.copy(this.#controls.target).add(away);
    this.#controls.update();
  }

  get camera(): Camera & (PerspectiveCamera | OrthographicCamera) {
    return this.#camera;
  }
  get position(): Vec3 {
    return this.#camera.position.toArray() as Vec3;
  }
  /** The framing of the camera: everything, or the one chosen by the user. */
  get looking(): Framing {
    if (!this.#byHand) return this.framing;
    const center = this.#controls.target.toArray() as Vec3;
    const away = this.#camera.position.distanceTo(this.#controls.target);
    const radius = Math.min(this.framing.radius, 0.6 * away * Math.tan(halfAngle));
    const beside = (side: number) => center.map((v) => v + side * radius) as Vec3;
    return { center, radius, low: beside(-1), high: beside(1) };
  }
  set enabled(on: boolean) {
    this.#controls.enabled = on;
  }

  /** Gives the camera back: fit() places it again. */
  release(): void {
    this.#byHand = false;
  }

  /** Direction and form of the scene, before the canvas is divided. */
  turn(): void {
    if (this.#byHand) return;
    const target = new Vector3(...this.framing.center);
    const direction = new Vector3(0, 0, 1);
    if (!this.#flat) {
      direction.set(0.42, 0, 1).addScaledVector(this.#up, 0.34).normalize();
      if (Math.abs(direction.dot(this.#up)) > 0.9) direction.set(1, -0.8, 0.5).normalize();
    }
    this.#camera.zoom = 1;
    this.#controls.target.copy(target);
    this.#camera.position.copy(target).addScaledVector(direction, 10 * this.framing.radius);
    this.#controls.update();
    let [wide, high] = [1e-9, 1e-9];
    for (const p of this.#corners()) [wide, high] = [Math.max(wide, Math.abs(p.x)), Math.max(high, Math.abs(p.y))];
    this.wide = Math.min(4, Math.max(0.3, wide / high));
  }

  /** Moves the camera as near as a picture of this form still shows the framed box below its label. */
  fit(rect: Rect): void {
    if (this.#byHand || this.#flat) return;
    const tangent = Math.tan(halfAngle);
    const [wide, high] = [(0.9 * tangent * rect.width) / rect.height, tangent * clearOf(rect)];
    let distance = 1e-6;
    for (const p of this.#corners())
      distance = Math.max(distance, p.z + Math.abs(p.x) / wide, p.z + Math.abs(p.y) / high);
    const away = this.#camera.position.clone().sub(this.#controls.target).setLength(distance);
    this.#camera.position.copy(this.#controls.target).add(away);
    this.#controls.update();
  }

  /** Brings a point to the middle, as near as a sphere of this radius [m] needs. */
  lookAt(point: Vec3, radius: number): void {
    this.#byHand = true;
    const away = this.#camera.position.clone().sub(this.#controls.target);
    this.#controls.target.set(...point);
    if (this.#flat) this.#camera.zoom = Math.min(40, (0.8 * this.framing.radius) / radius);
    else away.setLength(radius / Math.sin(this.#narrowAngle()));
    this.#camera.position.copy(this.#controls.target).add(away);
    this.#controls.update();
  }

  /** The same, seen from a direction [unit] as far as it is not straight from above or below. */
  lookFrom(point: Vec3, radius: number, direction: Vec3): void {
    if (!this.#flat) {
      const from = new Vector3(...direction);
      const steep = from.dot(this.#up);
      if (Math.abs(steep) > 0.95) from.addScaledVector(new Vector3(0.42, 0.3, 1), 0.4).normalize();
      const far = this.#camera.position.distanceTo(this.#controls.target);
      this.#camera.position.copy(this.#controls.target).addScaledVector(from, far);
    }
    this.lookAt(point, radius);
  }

  get state(): CameraState {
    return { position: this.position, target: this.#controls.target.toArray() as Vec3, zoom: this.#camera.zoom };
  }
  set state({ position, target, zoom }: CameraState) {
    this.#byHand = true;
    this.#camera.position.set(...position);
    this.#camera.zoom = zoom;
    this.#controls.target.set(...target);
    this.#controls.update();
  }

  /** Fits the camera to the form of a picture. */
  shape(rect: Rect): void {
    const aspect = rect.width / rect.height;
    const { radius, low, high } = this.framing;
    if (this.#camera instanceof PerspectiveCamera) {
      this.#camera.aspect = aspect;
      const distance = this.#camera.position.distanceTo(this.#controls.target);
      this.#camera.near = Math.max(distance, radius) / 1000;
      this.#camera.far = distance + 40 * radius;
    } else {
      const [w, h] = [(high[0] - low[0]) / 2, (high[1] - low[1]) / 2];
      const half = Math.max(h / clearOf(rect), w / aspect / 0.9, 0.05 * radius);
      this.#camera.left = -half * aspect;
      this.#camera.right = half * aspect;
      this.#camera.top = half;
      this.#camera.bottom = -half;
      this.#camera.near = 0.001;
      this.#camera.far = 100 * radius;
    }
    this.#camera.updateProjectionMatrix();
    this.#camera.updateMatrixWorld();
  }

  dispose(): void {
    this.#canvas.removeEventListener('keydown', this.#press);
    this.#controls.dispose();
  }

  /** Half of the smaller field of view: in a narrow picture the horizontal one. */
  #narrowAngle(): number {
    const aspect = this.#camera instanceof PerspectiveCamera ? this.#camera.aspect : 1;
    return Math.atan(Math.min(1, aspect) * Math.tan(halfAngle));
  }

  /** Corners of the framed box, from its centre, along the axes of the camera. */
  #corners(): Vector3[] {
    const { low, high, center } = this.framing;
    const back = this.#camera.quaternion.clone().invert();
    return [0, 1, 2, 3, 4, 5, 6, 7].map((i) => {
      const at = [0, 1, 2].map(
        (k) => ((i >> k) & 1 ? (high[k] as number) : (low[k] as number)) - (center[k] as number),
      );
      return new Vector3(...(at as Vec3)).applyQuaternion(back);
    });
  }
}
