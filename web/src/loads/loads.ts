import { floats } from "../data/floats";
import type { Balance, Column, Effective, Kind, Loads, Point, Track } from "../data/types";
import { moved, type Pose } from "../scene/motion";
import { placeIn, type Place } from "../time/between";
import { readAt, type Reading } from "../time/curve";

/** What acts on a body, or m a and I α of it, at one time: in N and N·m, in the fixed axes. */
export interface Action {
  key: string;
  label: string;
  kind: Kind | "effective";
  name: string;
  figure: number;
  others: number[];
  /** Of the loads that it stands for. */
  symbols: string[];
  at: Point;
  force: Point;
  couple: number;
  /** About how far force and couple may be from what they are, since they are known at some times and read between them. */
  miss: { force: number; couple: number };
}

type Decoded<T> = Omit<T, "x" | "y" | "fx" | "fy" | "m"> & { columns: (number | Float32Array)[] };

const decode = (column: Column): number | Float32Array => (typeof column === "number" ? column : floats(column));

const read = (times: number[], column: number | Float32Array, place: Place): Reading =>
  typeof column === "number" ? { value: column, miss: 0 } : readAt(times, column, place);

/** What the columns fx, fy, m say. */
function wrenchOf([x, y, m]: Reading[]): Pick<Action, "force" | "couple" | "miss"> {
  return { force: [x.value, y.value], couple: m.value, miss: { force: Math.max(x.miss, y.miss), couple: m.miss } };
}

/** By which m a and I α of a figure are lit. */
export const effectiveSymbol = (figure: number): string => `m a of ${figure}`;

/** All loads of the run, read at any time. */
export class LoadHistory {
  readonly #tracks: Decoded<Track>[];
  readonly #bodies: Decoded<Effective>[];

  constructor(readonly data: Loads) {
    this.#tracks = data.tracks.map((track) => ({ ...track, columns: [track.x, track.y, track.fx, track.fy, track.m].map(decode) }));
    this.#bodies = data.bodies.map((body) => ({ ...body, columns: [body.fx, body.fy, body.m].map(decode) }));
  }

  /** Every load by itself, as it stands in the balances. */
  terms(t: number, poses: Pose[]): Action[] {
    const place = placeIn(this.data.t, t);
    return this.#tracks.flatMap((track) => {
      const [x, y, ...wrench] = track.columns.map((column) => read(this.data.t, column, place));
      const known = wrench.every(({ value }) => !Number.isNaN(value));
      const at = moved(poses[track.figure], [x.value, y.value]);
      return known ? [{ ...track, key: track.arrow, symbols: [track.symbol], at, ...wrenchOf(wrench) }] : [];
    });
  }

  effective(t: number, poses: Pose[]): Action[] {
    const place = placeIn(this.data.t, t);
    return this.#bodies.map(({ figure, G, ma, columns }) => {
      const symbols = [effectiveSymbol(figure)];
      const at = moved(poses[figure], G);
      const wrench = wrenchOf(columns.map((column) => read(this.data.t, column, place)));
      return { key: symbols[0], label: ma, kind: "effective", name: ma, figure, others: [], symbols, at, ...wrench };
    });
  }

  /** What I α of a figure is called; nothing for a particle. */
  turning(figure: number): string {
    return this.#bodies.find((body) => body.figure === figure)?.ia ?? "";
  }

  /** Of all loads that something exerts. */
  symbolsOf(name: string): string[] {
    return [...new Set(this.#tracks.filter((track) => track.name === name).map(({ symbol }) => symbol))];
  }

  /** The balances of a figure, as far as they are told at that time. */
  balances(t: number, figure: number): Balance[] {
    const { low, part } = placeIn(this.data.t, t);
    const mode = this.data.mode[part === 1 ? low + 1 : low];
    return (this.data.balances[mode] ?? []).filter((balance) => balance.figure === figure);
  }

  /** The size that forces do not exceed in nine tenths of the time, and the same of couples. */
  usual(): { force: number; couple: number } {
    const still: Pose[] = Array.from({ length: 1 + this.#bodies.length }, () => ({ x: 0, y: 0, angle: 0 }));
    const forces: Lasting[] = [];
    const couples: Lasting[] = [];
    const times = this.data.t;
    times.forEach((t, k) => {
      const lasts = (times[k + 1] ?? t) - (times[k - 1] ?? t) || 1;
      for (const { force, couple } of [...arrows(this.terms(t, still)), ...this.effective(t, still)]) {
        forces.push({ size: Math.hypot(...force), lasts });
        couples.push({ size: Math.abs(couple), lasts });
      }
    });
    return { force: ninth(forces), couple: ninth(couples) };
  }
}

interface Lasting {
  size: number;
  lasts: number;
}

function ninth(all: Lasting[]): number {
  const sorted = all.filter(({ size }) => size > 0).sort((one, other) => one.size - other.size);
  let left = 0.9 * sorted.reduce((sum, { lasts }) => sum + lasts, 0);
  return sorted.find(({ lasts }) => (left -= lasts) < 0)?.size ?? 0;
}

/** Components of one force together, as one arrow. */
export function arrows(terms: Action[]): Action[] {
  const made = new Map<string, Action>();
  for (const term of terms) {
    const first = made.get(term.key);
    if (!first) made.set(term.key, term);
    else {
      const force: Point = [first.force[0] + term.force[0], first.force[1] + term.force[1]];
      made.set(term.key, { ...first, force, couple: first.couple + term.couple, symbols: [...first.symbols, ...term.symbols] });
    }
  }
  return [...made.values()];
}

/** Those on a group of figures that come from outside of it. */
export function outside<T extends { figure: number; others: number[] }>(actions: T[], group: Set<number>): T[] {
  return actions.filter(({ figure, others }) => group.has(figure) && !(others.length && others.every((other) => group.has(other))));
}

/** How far the part of a load in a balance may be from what it is. */
export function contributionMiss({ at, miss }: Action, about: "x" | "y" | "G", [x, y]: Point): number {
  return about === "G" ? miss.couple + (Math.abs(at[0] - x) + Math.abs(at[1] - y)) * miss.force : miss.force;
}

/** The part of a load in a balance: a force along an axis, or a moment about a place. */
export function contribution({ at, force, couple }: Action, about: "x" | "y" | "G", [x, y]: Point): number {
  if (about === "x") return force[0];
  if (about === "y") return force[1];
  return couple + (at[0] - x) * force[1] - (at[1] - y) * force[0];
}
