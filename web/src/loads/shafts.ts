import type { Point } from "../data/types";
import type { Motion } from "../scene/motion";
import type { Clock } from "../time/clock.svelte";
import { arrows, type LoadHistory, outside } from "./loads";

const TIMES = 40; // at which the arrows of a motion are looked at

/** The shaft of an arrow: where it starts, m, and its way on the screen, px. */
export interface Shaft {
  at: Point;
  by: Point;
}

/** Those on the whole mechanism that come during the motion, at so many px for each N. */
export function shaftsOf({ start, lasting }: Pick<Clock, "start" | "lasting">, motion: Motion, loads: LoadHistory, perNewton: number): Shaft[] {
  const moving = new Set(motion.scene.figures.map((_, i) => i).slice(1));
  return Array.from({ length: TIMES }, (_, k) => start + (k / (TIMES - 1)) * lasting).flatMap((t) =>
    arrows(outside(loads.terms(t, motion.poses(motion.place(t))), moving)).map(({ at, force: [fx, fy] }) => ({
      at,
      by: [perNewton * fx, -perNewton * fy] as Point,
    })),
  );
}
