import { expect, test } from "vitest";
import type { Scene } from "../src/data/types";
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
