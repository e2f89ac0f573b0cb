import { expect, test } from "vitest";
import type { Point, Track } from "../src/data/types";
import { arrows, contribution, LoadHistory, outside } from "../src/loads/loads";
import { component, letters } from "../src/loads/label";
import { round } from "../src/loads/scale.svelte";

const base64 = (values: number[]): string => btoa(String.fromCharCode(...new Uint8Array(new Float32Array(values).buffer)));

/** A rod of 2 m that hangs from a pin at its upper end, its frame in its middle. */
const pin: Omit<Track, "symbol" | "fx" | "fy"> = { name: "A", kind: "joint", label: "A", arrow: "A", figure: 1, others: [0], x: 1, y: 0, m: 0 };
const tracks: Track[] = [
  { ...pin, symbol: "A.Fx", fx: base64([0, 4]), fy: 0 },
  { ...pin, symbol: "A.Fy", fx: 0, fy: 9 },
];
const history = new LoadHistory({ t: [0, 1], tracks, bodies: [], mode: [0, 0], balances: [], impulses: [] });
const poses = [{ x: 0, y: 0, angle: 0 }, { x: 0, y: -1, angle: Math.PI / 2 }];

test("the components of a pin's force are one arrow, at the pin", () => {
  const [arrow, ...others] = arrows(history.terms(0.5, poses));
  expect(others).toEqual([]);
  expect(arrow.force).toEqual([2, 9]);
  expect(arrow.symbols).toEqual(["A.Fx", "A.Fy"]);
  expect(arrow.at[0]).toBeCloseTo(0, 12);
  expect(arrow.at[1]).toBeCloseTo(0, 12);
});

test("the moment of a force about the mass centre is x Fy − y Fx", () => {
  const centre: Point = [0, -1];
  const [alongX, alongY] = history.terms(1, poses);
  expect(contribution(alongX, "G", centre)).toBeCloseTo(-4, 12);
  expect(contribution(alongY, "G", centre)).toBeCloseTo(0, 12);
});

test("a load within a group is not on its diagram", () => {
  const between = [{ figure: 1, others: [2] }, { figure: 1, others: [0] }, { figure: 3, others: [1] }];
  expect(outside(between, new Set([1]))).toHaveLength(2);
  expect(outside(between, new Set([1, 2]))).toEqual([{ figure: 1, others: [0] }]);
});

test("a label is read as one writes it", () => {
  expect(letters("m_crank g")).toEqual([{ stem: "m", below: "crank" }, { stem: "g", below: "" }]);
  expect(component("m a", "x")).toBe("m a_x");
  expect(component("m_rod a_rod", "y")).toBe("m_rod a_rod,y");
});

test("a scale bar has a round length", () => {
  expect([7.3, 0.04, 199, 1].map(round)).toEqual([5, expect.closeTo(0.02, 12), 100, 1]);
});
