import type { Point, ReportData } from "./data/types";
import { Choice } from "./loads/choice.svelte";
import { LoadHistory } from "./loads/loads";
import { LoadScale } from "./loads/scale.svelte";
import { shaftsOf } from "./loads/shafts";
import { ScaleSide } from "./loads/side.svelte";
import { TimeWindow } from "./plots/window.svelte";
import { Camera } from "./scene/camera.svelte";
import { Motion } from "./scene/motion";
import { Options } from "./scene/options.svelte";
import { Zooming } from "./scene/zooming";
import { Clock } from "./time/clock.svelte";
import { Moment } from "./time/moment.svelte";

/** What the parts of the page share: the data, and the state that one part changes and all show. */
export class Report {
  readonly clock: Clock;
  readonly motion: Motion;
  readonly options: Options;
  readonly camera: Camera;
  readonly zooming: Zooming;
  readonly loads: LoadHistory | null;
  readonly choice = new Choice();
  readonly scale: LoadScale;
  readonly moment: Moment;
  readonly window: TimeWindow;
  readonly scaleSide: ScaleSide;

  constructor(readonly data: ReportData) {
    this.clock = new Clock(data.scene.t);
    this.motion = new Motion(data.scene);
    this.options = new Options(data.scene);
    this.loads = data.loads && new LoadHistory(data.loads);
    this.scale = new LoadScale(this.loads?.usual() ?? { force: 0, couple: 0 }, this.choice);
    this.moment = new Moment(data, this.clock, this.motion, this.loads, this.choice);
    this.window = new TimeWindow(this.clock);
    const shafts = this.loads ? shaftsOf(this.clock, this.motion, this.loads, this.scale.unstretched) : [];
    this.camera = new Camera(data.scene, () => this.followed(), shafts);
    this.zooming = new Zooming(this.camera);
    this.scaleSide = new ScaleSide(shafts, this.camera);
  }

  /** Of the loads that something exerts, by its name. */
  symbolsOf(name: string | undefined): string[] {
    return name && this.loads ? this.loads.symbolsOf(name) : [];
  }

  private followed(): Point | null {
    const pose = this.options.follow === null ? null : this.moment.poses[this.options.follow];
    return pose && [pose.x, pose.y];
  }
}
