import { floats } from "../data/floats";
import type { Plot } from "../data/types";
import { placeIn } from "../time/between";
import { readAt } from "../time/curve";
import { figure, type Range } from "./scale";

/** A curve over time; NaN where it has a gap. */
export interface Series {
  name: string;
  unit: string;
  /** The name of what exerts it, of a force. */
  of?: string;
  /** Of a curve of another run, the place of the one that it lies over. */
  beside?: number;
  t: ArrayLike<number>;
  y: Float32Array;
}

export function seriesOf(plot: Plot): Series[] {
  const t = floats(plot.t);
  return plot.curves.map((curve) => ({ ...curve, unit: plot.unit, t: curve.t ? floats(curve.t) : t, y: floats(curve.y) }));
}

/** By which of the eight colours it is drawn. */
export const toneOf = (series: Series, place: number): number => (series.beside ?? place) % 8;

/** What its curve stands over, or goes around. */
export const acrossOf = (plot: Plot, across: NonNullable<Plot["across"]>): Series => ({ ...across, t: floats(plot.t), y: floats(across.y) });

/** Its value at a time; NaN within a gap. */
export function valueAt({ t: times, y }: Series, t: number): number {
  return readAt(times, y, placeIn(times, t)).value;
}

/** The same as one reads it: no digit of it is what the line between two values makes up. */
export function figureAt(series: Series, t: number): string {
  const { value, miss } = readAt(series.t, series.y, placeIn(series.t, t));
  return figure(value, miss);
}

/** Its values within a stretch of time. */
export function within({ t, y }: Series, { low, high }: Range): Float32Array {
  return y.filter((_, i) => t[i] >= low && t[i] <= high);
}

/** The data of an SVG path over time, with places found by `x` and `y`. */
export function pathOf(series: Series, x: (t: number) => number, y: (value: number) => number): string {
  let path = "";
  let fresh = true;
  series.y.forEach((value, i) => {
    if (!Number.isNaN(value)) path += `${fresh ? "M" : "L"}${x(series.t[i]).toFixed(1)} ${y(value).toFixed(1)}`;
    fresh = Number.isNaN(value);
  });
  return path;
}
