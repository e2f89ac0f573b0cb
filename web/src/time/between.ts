/** A place in a list of times: the entries before and after, and the part of the way from one to the other. */
export interface Place {
  low: number;
  high: number;
  part: number;
}

/** Where t stands in ascending times; at a time that stands twice, as just before and just after a switch, after it. */
export function placeIn(times: ArrayLike<number>, t: number): Place {
  let low = 0;
  let high = times.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] <= t) low = middle;
    else high = middle;
  }
  const gap = times[high] - times[low];
  return { low, high, part: gap > 0 ? Math.min(1, Math.max(0, (t - times[low]) / gap)) : high > low ? 1 : 0 };
}

/** Row after row of numbers, one for each time: the numbers in between. */
export function rowAt(values: Float32Array, width: number, { low, high, part }: Place): number[] {
  const [a, b] = [low * width, high * width];
  return Array.from({ length: width }, (_, i) => values[a + i] + part * (values[b + i] - values[a + i]));
}
