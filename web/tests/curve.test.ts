import { expect, test } from "vitest";
import { figure } from "../src/plots/scale";
import { placeIn } from "../src/time/between";
import { readAt } from "../src/time/curve";

const read = (times: number[], y: number[], t: number) => readAt(times, y, placeIn(times, t));

test("a parabola is read as it is", () => {
  const times = [0, 1, 3, 4];
  const y = times.map((t) => t * t);
  for (const t of [1.5, 2, 2.7]) {
    expect(read(times, y, t).value).toBeCloseTo(t * t, 12);
    expect(read(times, y, t).miss).toBeCloseTo(0, 12);
  }
});

// The longest gap is 0.61, and a cubic through four values misses a fourth derivative of 1 by at most 3/128 h⁴.
test("a sine is no farther away than is said, and what is known is read as it is", () => {
  const times = Array.from({ length: 12 }, (_, i) => 0.4 * i + 0.01 * i ** 2);
  const y = times.map(Math.sin);
  for (let t = times[1]; t < times[10]; t += 0.07) {
    const { value, miss } = read(times, y, t);
    expect(Math.abs(value - Math.sin(t))).toBeLessThan(miss + (3 / 128) * 0.61 ** 4);
  }
  expect(read(times, y, times[4])).toEqual({ value: y[4], miss: 0 });
});

test("no value lies beyond its neighbours at a kink", () => {
  const [times, y] = [[0, 1, 2, 3, 4], [0, 0, 0, 1, 2]];
  for (const t of [1.5, 2.5]) expect(read(times, y, t).value).toBeCloseTo(Math.max(0, t - 2), 12);
});

test("what was before a switch says nothing of what is after it", () => {
  const [times, y] = [[0, 1, 1 + 1e-12, 2, 3], [0, 0, 5, 6, 7]];
  expect(read(times, y, 1.5).value).toBeCloseTo(5.5, 9);
  expect(read(times, y, 1.5).miss).toBeCloseTo(0, 9);
});

test("no figure stands below what may be missed", () => {
  expect([figure(12.3456, 0.02), figure(12.3456, 3), figure(0.4, 3), figure(-0.012, 0)]).toEqual(["12.3", "10", "0", "−0.012"]);
});
