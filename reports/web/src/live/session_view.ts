// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The session as the page knows it: the last report of the server, the instances' frames, and commands to it.
import type { Json } from '../replay/json.ts';
import { command, type News, news, Refused, type SessionState } from './api.ts';
import { InstanceSource } from './instance_source.ts';

/** Colours of instances, those of engines in reports. */
const palette = ['#0072b2', '#d55e00', '#009e73', '#cc79a7', '#e69f00', '#56b4e9', '#8a6fd1', '#a0791a'];

export class SessionView {
  state: SessionState | null = null;
  readonly sources = new Map<number, InstanceSource>();
  /** Called after every report of the server; `instances`: the set of instances has changed. */
  onNews: ((instances: boolean) => void) | null = null;
  /** Something to be read by the person; "" takes it away. */
  onSay: ((text: string) => void) | null = null;
  /** There is no server any more, and why. */
  onEnd: ((text: string) => void) | null = null;
  #after = 0;
  #lines: readonly string[] = [];
  #request = new AbortController();
  #scenario = '';
  #ended = false;

  /** Sends a command to the server; what it refuses is said by `say`, by default under the picture. */
  async send(
    request: { command: string } & Record<string, unknown>,
    say: (text: string) => void = (text) => this.onSay?.(text),
  ): Promise<Json | null> {
    try {
      const answer = await command(request);
      say('');
      return answer;
    } catch (error) {
      say(error instanceof Refused ? error.message : 'The server does not respond.');
      return null;
    }
  }

  /** Follows the server until it ends. */
  async follow(): Promise<void> {
    for (let failures = 0; !this.#ended; ) {
      const { signal } = this.#request;
      try {
        const found = await news(this.#after, this.#lines, signal);
        failures = 0;
        if (!signal.aborted) this.take(found); // else it has the lines of before
      } catch (error) {
        if (signal.aborted) continue;
        if (error instanceof Refused || ++failures > 5) {
          this.onEnd?.(
            error instanceof Refused ? error.message : 'rigor view has ended. Start it again and open its new link.',
          );
          return;
        }
        await new Promise((resolve) => setTimeout(resolve, 400));
      }
    }
  }

  /** Kinds of lines that are drawn of all frames from now on, and of the last ones again. */
  set lines(kinds: readonly string[]) {
    if (kinds.join() === this.#lines.join()) return;
    this.#lines = kinds;
    this.#after = 0;
    this.#request.abort();
    this.#request = new AbortController();
  }

  take({ sequence, session, frames, line_kinds, arrays }: News): void {
    this.#after = sequence;
    const other = session.scenario !== this.#scenario;
    this.#scenario = session.scenario;
    const ids = session.instances.map((instance) => instance.id).join();
    const before = this.state?.instances.map((instance) => instance.id).join();
    this.state = session;
    for (const id of [...this.sources.keys()])
      if (!session.instances.some((instance) => instance.id === id)) this.sources.delete(id);
    session.instances.forEach((instance) => {
      let source = this.sources.get(instance.id);
      if (!source) {
        const colour = palette[instance.id % palette.length] as string;
        source = new InstanceSource(instance.id, `instance ${instance.id}`, instance.title, colour);
        this.sources.set(instance.id, source);
      }
      source.note = instance.state === 'ready' ? '' : `${instance.state.replaceAll('_', '-')}: ${instance.message}`;
    });
    const empty = [...this.sources.values()].filter((source) => source.times.length === 0).length;
    for (const head of frames) this.sources.get(head.instance)?.push(head, arrays, line_kinds);
    const filled = [...this.sources.values()].filter((source) => source.times.length === 0).length !== empty;
    this.onNews?.(other || filled || ids !== before);
  }

  get instances(): InstanceSource[] {
    return (this.state?.instances ?? []).map((instance) => this.sources.get(instance.id) as InstanceSource);
  }

  end(): void {
    this.#ended = true;
  }
}
