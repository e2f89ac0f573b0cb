import type { Point } from "../data/types";

export const HEAD = 9; // px
const AROUND = 12; // px, from the head to the middle of a label

/** The head of an arrow from `tail` along `by`, in px: its corners. */
export function headOf([x, y]: Point, [dx, dy]: Point): Point[] {
  const length = Math.hypot(dx, dy) || 1;
  const head = Math.min(HEAD, length);
  const [ux, uy] = [dx / length, dy / length];
  const [bx, by] = [x + dx - head * ux, y + dy - head * uy];
  return [[x + dx, y + dy], [bx - 0.38 * head * uy, by + 0.38 * head * ux], [bx + 0.38 * head * uy, by - 0.38 * head * ux]];
}

/** Where the label of an arrow stands: beyond its head. */
export function labelPlace([x, y]: Point, [dx, dy]: Point): Point {
  const length = Math.hypot(dx, dy) || 1;
  return [x + dx + (AROUND * dx) / length, y + dy + (AROUND * dy) / length];
}

/** An arc about a place, in px, by an angle counter-clockwise as one sees it, as data of a path; and the place and way of its end. */
export function arcOf([x, y]: Point, radius: number, angle: number): { path: string; end: Point; way: Point } {
  const sweep = Math.max(-5.5, Math.min(5.5, angle));
  const from = Math.PI / 2 - sweep / 2;
  const at = (a: number): Point => [x + radius * Math.cos(a), y - radius * Math.sin(a)];
  const end = at(from + sweep);
  const [sx, sy] = at(from);
  const large = Math.abs(sweep) > Math.PI ? 1 : 0;
  const last = from + sweep;
  const way: Point = sweep > 0 ? [-Math.sin(last), -Math.cos(last)] : [Math.sin(last), Math.cos(last)];
  return { path: `M${sx} ${sy}A${radius} ${radius} 0 ${large} ${sweep > 0 ? 0 : 1} ${end[0]} ${end[1]}`, end, way };
}
