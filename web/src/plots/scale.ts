export interface Range {
  low: number;
  high: number;
}

/** Round numbers, about as many as asked for, within a range. */
export function ticks({ low, high }: Range, about: number): number[] {
  const raw = (high - low) / about;
  if (!(raw > 0)) return [low];
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= raw * 0.999)!;
  const made = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k += 1) made.push(k * step);
  return made;
}

/** The range of all numbers among some values, with room above and below. */
export function rangeOf(values: Iterable<number>[]): Range {
  let [low, high] = [Infinity, -Infinity];
  for (const each of values) {
    for (const y of each) {
      if (y < low) low = y;
      if (y > high) high = y;
    }
  }
  if (low > high) return { low: -1, high: 1 };
  const room = high > low ? 0.06 * (high - low) : Math.abs(high) * 0.1 || 1;
  return { low: low - room, high: high + room };
}

const RAISED = "⁻⁰¹²³⁴⁵⁶⁷⁸⁹";
const minus = (text: string): string => text.replaceAll("-", "−");

/** The text of a number, with a power of ten as people write it. */
function written(text: string): string {
  const [mantissa, power] = text.split("e");
  const raised = [...String(Number(power))].map((sign) => RAISED["-0123456789".indexOf(sign)]).join("");
  return minus(power ? `${Number(mantissa)}·10${raised}` : text);
}

/** A number at an axis whose largest is `largest`. */
export function tickLabel(x: number, largest: number): string {
  const exact = Math.abs(x) < 1e-12 * largest ? 0 : x;
  const long = Math.abs(exact) >= 1e5 || (exact !== 0 && largest < 1e-3);
  if (!long) return minus(String(Number(exact.toPrecision(6))));
  return written(exact.toExponential(1));
}

/** A value with as many digits as one reads, none of them below the `error` that it may have. */
export function figure(x: number | null, error = 0): string {
  if (x === null || Number.isNaN(x)) return "–";
  const read = Number(x.toPrecision(4));
  const least = error > 0 ? 10 ** Math.ceil(Math.log10(error)) : 0;
  return written(String(least > 0 ? Number((Math.round(read / least) * least).toPrecision(4)) + 0 : read));
}
