import { expect, test } from "vitest";
import { beside, coils, dashpot } from "../src/scene/springs";

test.each([20, 60, 400])("a spring of %i px goes from end to end, and its coils stand between", (length) => {
  const [line] = coils(length);
  expect(line[0]).toEqual([0, 0]);
  expect(line.at(-1)).toEqual([length, 0]);
  expect(line.filter(([, across]) => across !== 0).length).toBeGreaterThanOrEqual(7);
  expect(line.every(([along], i) => !i || along >= line[i - 1][0])).toBe(true);
});

test("the piston of a damper stays within its cup", () => {
  const [, cup, piston] = dashpot(50);
  expect(piston[0][0]).toBeGreaterThan(cup[1][0]);
  expect(piston[0][0]).toBeLessThan(cup[0][0]);
});

test("a spring beside a damper still ends where they end", () => {
  const ends = beside(coils(100), 100, 1).slice(1);
  expect(ends).toEqual([[[0, 0], [0, 10]], [[100, 0], [100, 10]]]);
});
