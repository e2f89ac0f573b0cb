import { expect, test } from "vitest";
import { figure, rangeOf, tickLabel, ticks } from "../src/plots/scale";
import { pathOf, seriesOf, toneOf, valueAt } from "../src/plots/series";

const series = { name: "N", unit: "N", t: new Float32Array([0, 1, 1, 1, 2]), y: new Float32Array([0, 2, NaN, 6, 8]) };

test("ticks are round and within the range", () => {
  expect(ticks({ low: -1.2, high: 3.4 }, 5)).toEqual([-1, 0, 1, 2, 3]);
  expect(ticks({ low: 2, high: 2 }, 5)).toEqual([2]);
});

test("a curve has a gap where something switched, and the later value there", () => {
  expect(pathOf(series, (t) => t, (y) => y)).toBe("M0.0 0.0L1.0 2.0M1.0 6.0L2.0 8.0");
  expect(valueAt(series, 0.5)).toBe(1);
  expect(valueAt(series, 1)).toBe(6);
});

test("a curve of another run has its own times and the colour of the one that it lies over", () => {
  const packed = (...values: number[]): string => Buffer.from(new Float32Array(values).buffer).toString("base64");
  const own = { name: "x", y: packed(1, 2) };
  const plot = { title: "", unit: "m", note: "", t: packed(0, 1), curves: [own, { name: "x (b)", y: packed(3, 4), t: packed(0, 2), beside: 0 }] };
  const [one, other] = seriesOf(plot);
  expect([Array.from(one.t), Array.from(other.t)]).toEqual([[0, 1], [0, 2]]);
  expect([toneOf(one, 0), toneOf(other, 1)]).toEqual([0, 0]);
});

test("a range leaves room, and leaves out what is no number", () => {
  expect(rangeOf([series.y])).toEqual({ low: expect.closeTo(-0.48), high: expect.closeTo(8.48) });
  expect(rangeOf([new Float32Array([NaN])])).toEqual({ low: -1, high: 1 });
});

test("numbers have a true minus sign, and powers of ten", () => {
  expect(tickLabel(-2e-9, 4e-9)).toBe("−2·10⁻⁹");
  expect(tickLabel(-0.5, 1)).toBe("−0.5");
  expect(figure(-12.3456)).toBe("−12.35");
  expect(figure(7.5261e-11)).toBe("7.526·10⁻¹¹");
  expect(figure(NaN)).toBe("–");
});
