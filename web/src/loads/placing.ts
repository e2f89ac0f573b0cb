import type { Point } from "../data/types";
import { letters } from "./label";

/** An arrow on the screen, px; a couple has no length but a radius. */
export interface Labelled {
  key: string;
  label: string;
  at: Point;
  by: Point;
}

const AWAY = 12; // px from an arrow to the middle of its label
const HIGH = 16;
const SHORT = 8; // px: an arrow that is hardly seen needs no label
const CROWDED = 10; // what it costs to lie on a label, beside lying on a shaft
const RESTLESS = 0.6; // and not to stay where it was

/** A corner at the foot of a stage, at its left unless at its right, px. */
export interface Corner {
  wide: number;
  high: number;
  right?: boolean;
}

/** What the scales take. */
export const SCALES: Corner = { wide: 122, high: 44 };

interface Box {
  x: number;
  y: number;
  wide: number;
}

/** About how wide a label is, px. */
export const widthOf = (label: string): number =>
  letters(label).reduce((sum, { stem, below }) => sum + 8.5 * [...stem].length + 5.4 * [...below].length + 3, 0);

/** Places that a label may have: beyond the head, beside it, beside the shaft, farther out; the best first. */
function candidates({ at: [x, y], by: [dx, dy], label }: Labelled): Point[] {
  const length = Math.hypot(dx, dy);
  const half = widthOf(label) / 2;
  if (!length) return [[x, y - 32], [x, y + 32], [x + 26 + half, y], [x - 26 - half, y]];
  const [ux, uy] = [dx / length, dy / length];
  const beside = AWAY + half * Math.abs(uy) + 2;
  const beyond = AWAY + half * Math.abs(ux);
  const place = (along: number, across: number): Point => [x + along * ux - across * uy, y + along * uy + across * ux];
  return [
    place(length + beyond, 0), place(length, beside), place(length, -beside), place(length / 2, beside), place(length / 2, -beside),
    place(length + beyond + HIGH, 0), place(length + 14, beside + 8), place(length + 14, -beside - 8), place(0, beside), place(0, -beside),
  ];
}

const overlap = (one: Box, other: Box): boolean =>
  Math.abs(one.x - other.x) < (one.wide + other.wide) / 2 && Math.abs(one.y - other.y) < HIGH;

/** Whether a shaft passes through a box. */
function crosses({ at: [x, y], by: [dx, dy] }: Labelled, box: Box): boolean {
  let [from, to] = [0, 1];
  for (const [start, way, middle, half] of [[x, dx, box.x, box.wide / 2 - 2], [y, dy, box.y, HIGH / 2 - 2]]) {
    if (Math.abs(way) < 1e-9) {
      if (Math.abs(start - middle) > half) return false;
      continue;
    }
    const [a, b] = [(middle - half - start) / way, (middle + half - start) / way];
    [from, to] = [Math.max(from, Math.min(a, b)), Math.min(to, Math.max(a, b))];
  }
  return from < to;
}

/** Puts labels where they lie on no other and on no shaft, as far as they can; they stay on their side while the arrows move. */
export class LabelPlaces {
  readonly #last = new Map<string, number>();

  /** The middle of each label by the key of its arrow; none for what is hardly seen. The corner at the foot is taken. */
  of(arrows: Labelled[], wide: number, high: number, corner: Corner = { wide: 0, high: 0 }): Map<string, Point> {
    const found = new Map<string, Point>();
    const taken: Box[] = [];
    const longest = [...arrows].sort((one, other) => Math.hypot(...other.by) - Math.hypot(...one.by));
    for (const arrow of longest) {
      const length = Math.hypot(...arrow.by);
      if (length > 0 && length < SHORT) continue;
      const boxes = candidates(arrow).map(([x, y]): Box => ({ x, y, wide: widthOf(arrow.label) }));
      const cost = boxes.map((box, i) => {
        const out = box.x - box.wide / 2 < 0 || box.x + box.wide / 2 > wide || box.y < HIGH / 2 || box.y > high - HIGH / 2;
        const inward = (corner.right ? wide - box.x : box.x) - box.wide / 2;
        const onScales = inward < corner.wide && box.y > high - corner.high - HIGH / 2;
        const onLabels = taken.filter((other) => overlap(box, other)).length;
        const onShafts = arrows.filter((other) => crosses(other, box)).length;
        const moves = (this.#last.get(arrow.key) ?? i) === i ? 0 : RESTLESS;
        return CROWDED * (onLabels + Number(out || onScales)) + 3 * onShafts + 0.2 * i + moves;
      });
      const best = cost.indexOf(Math.min(...cost));
      this.#last.set(arrow.key, best);
      taken.push(boxes[best]);
      found.set(arrow.key, [boxes[best].x, boxes[best].y]);
    }
    return found;
  }
}
