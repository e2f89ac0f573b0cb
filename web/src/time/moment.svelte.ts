import type { ReportData } from "../data/types";
import { type Action, arrows, type LoadHistory, outside } from "../loads/loads";
import type { Choice } from "../loads/choice.svelte";
import type { Motion } from "../scene/motion";
import type { Clock } from "./clock.svelte";

/** How long an impact glows, in s of the film. */
const GLOW = 0.3;

/** What is at the present time: where everything is, and all that acts. */
export class Moment {
  constructor(
    private readonly data: ReportData,
    private readonly clock: Clock,
    private readonly motion: Motion,
    private readonly loads: LoadHistory | null,
    private readonly choice: Choice,
  ) {}

  readonly place = $derived.by(() => this.motion.place(this.clock.t));
  readonly poses = $derived.by(() => this.motion.poses(this.place));

  /** Every load on every body by itself. */
  readonly terms: Action[] = $derived.by(() => this.loads?.terms(this.clock.t, this.poses) ?? []);
  readonly effective: Action[] = $derived.by(() => this.loads?.effective(this.clock.t, this.poses) ?? []);

  /** The figures that are cut free together. */
  readonly group = $derived.by(() =>
    this.choice.body === null ? new Set(this.data.scene.figures.map((_, i) => i).slice(1)) : new Set([this.choice.body]),
  );

  /** What acts on these from outside, as arrows. */
  readonly arrows: Action[] = $derived.by(() =>
    arrows(outside(this.terms, this.group)).filter(({ kind }) => this.choice.shows(kind)),
  );

  /** How long impacts glow, in s of the motion. */
  readonly glow = $derived.by(() => GLOW * this.clock.speed);

  /** How bright something is that flashed up at a time: 1 then, 0 when it is over. */
  brightness(t: number): number {
    return t <= this.clock.t && this.clock.t < t + this.glow ? 1 - (this.clock.t - t) / this.glow : 0;
  }

  /** Impulses on the group that still glow. */
  readonly impulses = $derived.by(() => outside(this.loads?.data.impulses ?? [], this.group).filter(({ t }) => this.brightness(t) > 0));
}
