import type { Figure, Point } from "../data/types";
import { moved, type Pose } from "../scene/motion";

/** Of what a body is made, without what it is held by. */
export const SOLID = ["band", "body", "mark", "slot", "mass", "block"];

export interface Frame {
  /** px for each m. */
  scale: number;
  centreAt(pose: Pose): Point;
}

/** How a figure is shown by itself, at most so many px long however it turns. */
export function frameOf(figure: Figure, longest: number): Frame {
  const corners = figure.strokes.filter(({ style }) => SOLID.includes(style)).flatMap(({ points }) => points);
  const [xs, ys] = [corners.map(([x]) => x), corners.map(([, y]) => y)];
  const middle: Point = corners.length
    ? [(Math.min(...xs) + Math.max(...xs)) / 2, (Math.min(...ys) + Math.max(...ys)) / 2]
    : [0, 0];
  const across = 2 * Math.max(1e-12, ...corners.map(([x, y]) => Math.hypot(x - middle[0], y - middle[1])));
  return { scale: longest / across, centreAt: (pose) => moved(pose, middle) };
}
