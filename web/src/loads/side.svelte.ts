import type { Point } from "../data/types";
import type { Camera } from "../scene/camera.svelte";
import type { Motion } from "../scene/motion";
import type { Clock } from "../time/clock.svelte";
import { arrows, type LoadHistory } from "./loads";
import { SCALES } from "./placing";
import type { LoadScale } from "./scale.svelte";

const TIMES = 40; // at which the arrows of a motion are looked at

/** At which side of the foot the scales stand: the left, unless arrows come there more often than to the right. */
export class ScaleSide {
  constructor(
    private readonly clock: Pick<Clock, "start" | "lasting">,
    private readonly motion: Motion,
    private readonly loads: LoadHistory | null,
    private readonly scale: Pick<LoadScale, "force">,
    private readonly camera: Pick<Camera, "home" | "width" | "height">,
  ) {}

  readonly right = $derived.by(() => {
    let [left, right] = [0, 0];
    for (const [x, y] of this.places) {
      if (y < this.camera.height - SCALES.high) continue;
      left += Number(x < SCALES.wide);
      right += Number(x > this.camera.width - SCALES.wide);
    }
    return right < left;
  });

  /** Where shafts are on the screen during the motion. */
  private get places(): Point[] {
    return Array.from({ length: this.loads ? TIMES : 0 }, (_, k) => this.clock.start + (k / (TIMES - 1)) * this.clock.lasting).flatMap((t) =>
      arrows(this.loads!.terms(t, this.motion.poses(this.motion.place(t)))).flatMap(({ at, force: [fx, fy] }) => {
        const [x, y] = this.camera.home(at);
        return [0, 0.25, 0.5, 0.75, 1].map((part): Point => [x + part * this.scale.force * fx, y - part * this.scale.force * fy]);
      }),
    );
  }
}
