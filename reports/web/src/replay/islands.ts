// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Islands: union-find over contacts and joints. Static and kinematic bodies connect no islands.

export class UnionFind {
  readonly #parent: Int32Array;

  constructor(count: number) {
    this.#parent = new Int32Array(count);
    this.reset();
  }

  /** Makes every body an island of its own. */
  reset(): void {
    for (let i = 0; i < this.#parent.length; ++i) this.#parent[i] = i;
  }

  find(i: number): number {
    const parent = this.#parent;
    let root = i;
    while (parent[root] !== root) root = parent[root] as number;
    while (parent[i] !== root) {
      const next = parent[i] as number;
      parent[i] = root;
      i = next;
    }
    return root;
  }

  /** The smaller index stays the root, so that colours do not jump. */
  join(a: number, b: number): void {
    const [p, q] = [this.find(a), this.find(b)];
    if (p !== q) this.#parent[Math.max(p, q)] = Math.min(p, q);
  }
}

export interface Link {
  a: number;
  b: number;
}

/** Root of every body's island into `out`; -1 for bodies that do not move by forces. */
export function findIslands(
  moves: ArrayLike<boolean>,
  contacts: { count: number; bodyA: ArrayLike<number>; bodyB: ArrayLike<number> } | null,
  joints: readonly Link[],
  sets: UnionFind,
  out: Int32Array,
): void {
  sets.reset();
  const join = (a: number, b: number) => {
    if (moves[a] && moves[b]) sets.join(a, b);
  };
  if (contacts !== null)
    for (let i = 0; i < contacts.count; ++i) join(contacts.bodyA[i] as number, contacts.bodyB[i] as number);
  for (const { a, b } of joints) join(a, b);
  for (let i = 0; i < out.length; ++i) out[i] = moves[i] ? sets.find(i) : -1;
}
