import type { ReportData } from "./data/types";
import { Camera } from "./scene/camera.svelte";
import { Motion } from "./scene/motion";
import { Clock } from "./time/clock.svelte";

/** What the parts of the page share: the data, and the state that one part changes and all show. */
export class Report {
  readonly clock: Clock;
  readonly motion: Motion;
  readonly camera: Camera;

  constructor(readonly data: ReportData) {
    this.clock = new Clock(data.scene.t);
    this.motion = new Motion(data.scene);
    this.camera = new Camera(data.scene);
  }
}
