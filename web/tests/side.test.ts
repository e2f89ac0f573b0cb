import { expect, test } from "vitest";
import type { Scene } from "../src/data/types";
import { ScaleSide } from "../src/loads/side.svelte";
import { Camera } from "../src/scene/camera.svelte";

test.each([[[0], true], [[10], false], [[0, 10], false], [[5], false]])("weights at the foot, %j m from the left: scales at the right is %s", (xs, right) => {
  const shafts = xs.map((x) => ({ at: [x, 0] as [number, number], by: [0, 80] as [number, number] }));
  const camera = new Camera({ bounds: [0, 10, 0, 2], size: 0.1 } as Scene, () => null);
  Object.assign(camera, { width: 390, height: 240 });
  expect(new ScaleSide(shafts, camera).right).toBe(right);
});
