// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Actions of the buttons and keys of a replay. The stage implements ReplayActions and the controls ControlActions;
// buttons and keys know these interfaces alone.
import type { FrameSource } from './frames.ts';
import type { LayerName } from './layers.ts';
import type { Choosable } from './pinned.ts';
import type { Player } from './player.ts';
import type { ReplayView } from './view.ts';

export type JumpTarget = 'divergence' | 'largest' | 'next' | 'previous' | 'normal';

/** Files of what is seen. */
export type Saved = 'png' | 'webm' | 'csv';

export interface ReplayActions {
  readonly view: ReplayView;
  readonly player: Player;
  readonly engines: FrameSource[];
  readonly shown: FrameSource[];
  readonly time: number;
  readonly hasReference: boolean;
  /** True if frames of a shown engine are stored that are not loaded yet. */
  readonly canLoadMore: boolean;
  /** True while the camera goes along with the chosen body, and while clicks are points to measure. */
  readonly following: boolean;
  readonly measuring: boolean;
  /** Chooses the next body or contact, or the one before it. */
  choose(what: Choosable, forward: boolean): void;
  toggleFollow(): void;
  toggleMeasure(): void;
  /** Takes what is chosen as the next point to measure. */
  measureChosen(): void;
  save(what: Saved): Promise<void>;
  isShown(source: FrameSource): boolean;
  toggleEngine(source: FrameSource): void;
  loadAll(): Promise<void>;
  setTime(seconds: number): void;
  step(forward: boolean, count?: number): void;
  jump(to: JumpTarget): void;
  setOptions(change: Parameters<ReplayView['setOptions']>[0]): void;
}

export interface ControlActions {
  toggle(name: LayerName): void;
  overlay(on: boolean): void;
  toggleHelp(): void;
}
