import type { Camera } from "../scene/camera.svelte";
import { SCALES } from "./placing";
import type { Shaft } from "./shafts";

/** At which side of the foot the scales stand: the left, unless arrows come there more often than to the right. */
export class ScaleSide {
  constructor(
    private readonly shafts: Shaft[],
    private readonly camera: Pick<Camera, "home" | "width" | "height">,
  ) {}

  readonly right = $derived.by(() => {
    let [left, right] = [0, 0];
    for (const { at, by } of this.shafts) {
      const [x0, y0] = this.camera.home(at);
      for (const part of [0, 0.25, 0.5, 0.75, 1]) {
        if (y0 + part * by[1] < this.camera.height - SCALES.high) continue;
        const x = x0 + part * by[0];
        left += Number(x < SCALES.wide);
        right += Number(x > this.camera.width - SCALES.wide);
      }
    }
    return right < left;
  });
}
