// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The bodies and joints that generators of a scenario make, in their order and with their names
// (scenarios/generators/). A pile's jitter and turns are left out: frames bring the true poses.
import type { Json } from './json.ts';

interface Made {
  bodies: Json[];
  joints: Json[];
}

const point = (json: Json, fallback = 0): number[] => [0, 1, 2].map((k) => Number(json?.[k] ?? fallback));
const placed = (body: Json, name: string, position: number[]): Json => ({ ...body, name, position });

function grid(json: Json, dimension: number): Made {
  const [n, step, origin] = [point(json.counts, 1), point(json.spacing), point(json.origin)] as [
    number[],
    number[],
    number[],
  ];
  const bodies: Json[] = [];
  const at = (axis: number, index: number) => (origin[axis] as number) + index * (step[axis] as number);
  for (let k = 0; k < (dimension === 3 ? (n[2] as number) : 1); ++k)
    for (let j = 0; j < (n[1] as number); ++j)
      for (let i = 0; i < (n[0] as number); ++i)
        bodies.push(
          placed(json.body, [json.name, i, j, ...(dimension === 3 ? [k] : [])].join('_'), [
            at(0, i),
            at(1, j),
            at(2, k),
          ]),
        );
  return { bodies, joints: [] };
}

function pyramid(json: Json, dimension: number): Made {
  const [step, origin] = [point(json.spacing), point(json.origin)] as [number[], number[]];
  const bodies: Json[] = [];
  const at = (axis: number, index: number) => (origin[axis] as number) + index * (step[axis] as number);
  for (let row = 0; row < json.rows; ++row) {
    const n = json.rows - row;
    const half = (n - 1) / 2;
    for (let k = 0; k < (dimension === 3 ? n : 1); ++k)
      for (let i = 0; i < n; ++i)
        bodies.push(
          placed(json.body, [json.name, row, i, ...(dimension === 3 ? [k] : [])].join('_'), [
            at(0, i - half),
            at(1, row),
            dimension === 3 ? at(2, k - half) : 0,
          ]),
        );
  }
  return { bodies, joints: [] };
}

function pile(json: Json, dimension: number): Made {
  const [step, origin] = [point(json.spacing), point(json.origin)] as [number[], number[]];
  const across = json.columns;
  const deep = dimension === 3 ? across : 1;
  const half = (across - 1) / 2;
  const bodies: Json[] = [];
  for (let n = 0; n < json.count; ++n) {
    const place = n % (across * deep);
    const [i, k] = [place % across, Math.floor(place / across)];
    bodies.push(
      placed(json.bodies[n % json.bodies.length], `${json.name}_${n}`, [
        (origin[0] as number) + (i - half) * (step[0] as number),
        (origin[1] as number) + Math.floor(n / (across * deep)) * (step[1] as number),
        dimension === 3 ? (origin[2] as number) + (k - half) * (step[2] as number) : 0,
      ]),
    );
  }
  return { bodies, joints: [] };
}

function chain(json: Json): Made {
  const direction = point(json.direction);
  const length = Math.hypot(...direction) || 1;
  const origin = point(json.origin);
  const along = (links: number) =>
    origin.map((x, k) => x + ((links * json.link_length) / length) * (direction[k] as number));
  const made: Made = { bodies: [], joints: [] };
  let before = 'world';
  for (let i = 0; i < json.links; ++i) {
    const name = `${json.name}_${i}`;
    const last = i === json.links - 1 && json.end_body !== undefined;
    made.bodies.push(placed(last ? json.end_body : json.body, name, along(i + 0.5)));
    if (i > 0 || json.anchored !== false)
      made.joints.push({
        name: `${json.name}_joint_${i}`,
        type: json.joint,
        a: before,
        b: name,
        anchor: along(i),
        ...(json.axis === undefined ? {} : { axis: json.axis }),
      });
    before = name;
  }
  return made;
}

export function expandGenerators(list: Json[], dimension: number): Made {
  const all: Made = { bodies: [], joints: [] };
  for (const json of list) {
    const made = json.grid
      ? grid(json.grid, dimension)
      : json.pyramid
        ? pyramid(json.pyramid, dimension)
        : json.pile
          ? pile(json.pile, dimension)
          : json.chain
            ? chain(json.chain)
            : { bodies: [], joints: [] };
    all.bodies.push(...made.bodies);
    all.joints.push(...made.joints);
  }
  return all;
}
