import { expect, test } from "vitest";
import { placeIn, rowAt } from "../src/time/between";

test("halfway between two times a number is the mean of theirs", () => {
  const place = placeIn([0, 1, 2], 1.5);
  expect(rowAt(new Float32Array([0, 0, 2, 4, 6, 8]), 2, place)).toEqual([4, 6]);
});

test("at a time that stands twice, what was just after it holds", () => {
  const times = [0, 1, 1, 2];
  expect(rowAt(new Float32Array([0, 1, 5, 6]), 1, placeIn(times, 1))).toEqual([5]);
  expect(rowAt(new Float32Array([0, 1, 5, 6]), 1, placeIn(times, 0.5))).toEqual([0.5]);
});

test("a run of one instant has it at every time", () => {
  expect(rowAt(new Float32Array([3]), 1, placeIn([0], 0))).toEqual([3]);
});

test("the end of a run is its last row", () => {
  expect(rowAt(new Float32Array([0, 7]), 1, placeIn([0, 2], 2))).toEqual([7]);
});
