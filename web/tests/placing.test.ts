import { expect, test } from "vitest";
import { type Labelled, LabelPlaces, SCALES, widthOf } from "../src/loads/placing";

const arrow = (key: string, x: number, dx: number, dy: number): Labelled => ({ key, label: `m_${key} g`, at: [x, 100], by: [dx, dy] });

test("labels of arrows that end side by side do not overlap", () => {
  const all = [arrow("thigh", 100, 0, 50), arrow("shank", 108, 0, 48), arrow("foot", 104, 0, -50)];
  const places = [...new LabelPlaces().of(all, 400, 300)];
  expect(places).toHaveLength(3);
  for (const [key, [x, y]] of places) {
    for (const [other, [u, v]] of places) {
      const apart = Math.abs(x - u) >= (widthOf(`m_${key} g`) + widthOf(`m_${other} g`)) / 2 || Math.abs(y - v) >= 16;
      expect(key === other || apart).toBe(true);
    }
  }
});

test("a label stays on its side while its arrow turns a little", () => {
  const labels = new LabelPlaces();
  const side = (angle: number): number => {
    const [x] = labels.of([arrow("a", 100, 60 * Math.cos(angle), -60 * Math.sin(angle))], 400, 300).get("a")!;
    return x;
  };
  expect(Math.abs(side(1.57) - side(1.58))).toBeLessThan(3);
});

test("what is hardly seen has no label", () => {
  expect(new LabelPlaces().of([arrow("a", 100, 3, 0)], 400, 300).size).toBe(0);
});

test("no label lies on the scales in the corner", () => {
  const down = arrow("block", 60, 0, 190);
  const [x, y] = new LabelPlaces().of([down], 400, 300, SCALES).get("block")!;
  expect(x - widthOf("m_block g") / 2 >= SCALES.wide || y <= 300 - SCALES.high).toBe(true);
});
