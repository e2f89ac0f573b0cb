import type { Clock } from "../time/clock.svelte";
import type { Range } from "./scale";

/** The stretch of time that all plots show, and the time that is pointed at in one of them. */
export class TimeWindow {
  pointed = $state<number | null>(null);
  #chosen = $state.raw<Range | null>(null);

  constructor(private readonly clock: Clock) {}

  get range(): Range {
    return this.#chosen ?? { low: this.clock.start, high: this.clock.end };
  }

  get narrowed(): boolean {
    return this.#chosen !== null;
  }

  /** At which values are told: where one points, else where the mechanism is. */
  get t(): number {
    return this.pointed ?? this.clock.t;
  }

  narrow(a: number, b: number): void {
    const [low, high] = [Math.max(this.clock.start, Math.min(a, b)), Math.min(this.clock.end, Math.max(a, b))];
    if (high - low > 1e-6 * this.clock.lasting) this.#chosen = { low, high };
  }

  widen(): void {
    this.#chosen = null;
  }
}
