import type { Place } from "./between";

const SWITCH = 1e-6; // of a gap between two times: what lies so close is just before and just after a switch
const ALIKE = 4; // how much more a curve may bend on one side than on the other where it is smooth
const SURE = 0.3; // of what the two sides differ by, what a cubic through both leaves at most where it is smooth

/** A number read between two times at which it is known, and about how far it may be from what it is. */
export interface Reading {
  value: number;
  miss: number;
}

/** The value at a place: on the cubic through the two neighbours on either side; where one side bends otherwise than the other, as at a
 * kink, no more than both bend. */
export function readAt(times: ArrayLike<number>, y: ArrayLike<number>, { low, high, part }: Place): Reading {
  if (part === 0 || part === 1) return { value: y[part === 0 ? low : high], miss: 0 };
  const gap = times[high] - times[low];
  const slope = (y[high] - y[low]) / gap;
  /** The second divided difference with one more neighbour; nothing over a switch. */
  const bend = (inner: number, outer: number): number => {
    const far = times[outer] - times[inner];
    if (!(Math.abs(far) > SWITCH * gap)) return NaN;
    return (slope - (y[outer] - y[inner]) / far) / (times[inner === low ? high : low] - times[outer]);
  };
  const within = part * (1 - part) * gap ** 2;
  const reading = (bent: number, miss: number): Reading => ({
    value: y[low] + part * (y[high] - y[low]) - bent * within,
    miss: Math.abs(miss) * within,
  });

  const [before, after] = [bend(low, low - 1), bend(high, high + 1)];
  if (Number.isNaN(before + after)) {
    const one = (Number.isNaN(before) ? after : before) || 0;
    return reading(one, one);
  }
  const [less, more] = Math.abs(before) < Math.abs(after) ? [before, after] : [after, before];
  if (less * more <= 0) return reading(0, more - less);
  if (more / less > ALIKE) return reading(less, more - less);
  const [first, last] = [times[low - 1], times[high + 1]];
  return reading(before + ((after - before) * (times[low] + part * gap - first)) / (last - first), SURE * (after - before));
}
