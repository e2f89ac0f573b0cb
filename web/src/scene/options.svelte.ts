import type { Scene } from "../data/types";

export const NAMED = ["bodies", "joints", "points"] as const;
export type NamedKind = (typeof NAMED)[number];

/** What the reader wants to see of the moving mechanism. */
export class Options {
  /** The figure that stays in the middle. */
  follow = $state<number | null>(null);
  named = $state.raw<NamedKind[]>([]);
  traced = $state.raw<string[]>([]);
  ghosts = $state(false);

  constructor(scene: Scene) {
    this.traced = scene.traced;
  }

  toggleNames(kind: NamedKind): void {
    this.named = toggled(this.named, kind);
  }

  toggleTrace(point: string): void {
    this.traced = toggled(this.traced, point);
  }
}

const toggled = <T>(all: T[], one: T): T[] => (all.includes(one) ? all.filter((each) => each !== one) : [...all, one]);
