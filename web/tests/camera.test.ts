import { expect, test } from "vitest";
import type { Point, Scene } from "../src/data/types";
import { Camera } from "../src/scene/camera.svelte";

test.each([0.01, 1, 1000, 1e7])("a mechanism of %d m stands on its stage, on a phone too", (size) => {
  const camera = new Camera({ bounds: [0, size, -size, 0], size: 0.02 * size } as Scene, () => null);
  for (const [width, height] of [[1000, 450], [340, 300]]) {
    Object.assign(camera, { width, height });
    for (const [x, y] of [camera.screen([0, 0]), camera.screen([size, -size])]) {
      expect(x > 0 && x < width && y > 0 && y < height).toBe(true);
    }
  }
});

test.each([[0, -100], [0, 100], [100, 0], [-100, 0], [60, -80]])("an arrow of %d, %d px is seen whole, wherever it starts", (dx, dy) => {
  for (const at of [[0, 0], [3, 0], [0, -2], [3, -2]] as Point[]) {
    const camera = new Camera({ bounds: [0, 3, -2, 0], size: 0.05 } as Scene, () => null, [{ at, by: [dx, dy] }]);
    for (const width of [1060, 350]) {
      camera.width = width;
      camera.height = camera.tallness(844);
      const [x, y] = camera.screen(at);
      expect(x + dx > 0 && x + dx < width && y + dy > 0 && y + dy < camera.height).toBe(true);
    }
  }
});

test.each([350, 1060])("arrows as long as a phone leave a third of a stage %d px wide to the mechanism", (width) => {
  const by: Point[] = [[500, 0], [-500, 0], [0, -500], [0, 500]];
  const camera = new Camera({ bounds: [0, 3, -2, 0], size: 0.05 } as Scene, () => null, by.map((each) => ({ at: [1.5, -1] as Point, by: each })));
  camera.width = width;
  camera.height = camera.tallness(844);
  const [[left, top], [right, bottom]] = [camera.screen([0, 0]), camera.screen([3, -2])];
  expect(Math.max((right - left) / width, (bottom - top) / camera.height)).toBeGreaterThan(0.3);
});
