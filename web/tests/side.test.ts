import { expect, test } from "vitest";
import type { Loads, Scene } from "../src/data/types";
import { LoadHistory } from "../src/loads/loads";
import { ScaleSide } from "../src/loads/side.svelte";
import { Camera } from "../src/scene/camera.svelte";
import { Motion } from "../src/scene/motion";

const weight = { symbol: "W", name: "W", kind: "weight", label: "m g", arrow: "W", figure: 0, others: [], y: 0, fx: 0, fy: -1, m: 0 };

test.each([[[0], true], [[10], false], [[0, 10], false], [[5], false]])("weights at the foot, %j m from the left: scales at the right is %s", (xs, right) => {
  const tracks = xs.map((x, i) => ({ ...weight, arrow: `W${i}`, x }));
  const loads = new LoadHistory({ t: [0, 1], tracks, bodies: [], mode: [], balances: [], impulses: [] } as unknown as Loads);
  const poses = btoa(String.fromCharCode(...new Uint8Array(6 * 4)));
  const scene = { bounds: [0, 10, 0, 2], size: 0.1, t: [0, 1], poses, figures: [{}] } as unknown as Scene;
  const camera = new Camera(scene, () => null);
  Object.assign(camera, { width: 390, height: 240 });
  expect(new ScaleSide({ start: 0, lasting: 1 }, new Motion(scene), loads, { force: 80 }, camera).right).toBe(right);
});
