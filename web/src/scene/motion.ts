import { floats } from "../data/floats";
import type { Point, Scene } from "../data/types";
import { placeIn, type Place, rowAt } from "../time/between";

/** Where a figure is. */
export interface Pose {
  x: number;
  y: number;
  angle: number;
}

/** A point of a figure in the fixed axes. */
export function moved({ x, y, angle }: Pose, [a, b]: Point): Point {
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  return [x + a * c - b * s, y + a * s + b * c];
}

/** The figures' poses at any time. */
export class Motion {
  readonly #poses: Float32Array;

  constructor(readonly scene: Scene) {
    this.#poses = floats(scene.poses);
  }

  place(t: number): Place {
    return placeIn(this.scene.t, t);
  }

  poses(place: Place): Pose[] {
    const row = rowAt(this.#poses, 3 * this.scene.figures.length, place);
    return this.scene.figures.map((_, i) => ({ x: row[3 * i], y: row[3 * i + 1], angle: row[3 * i + 2] }));
  }

  /** Where a point of a figure is at every time of the scene. */
  path(figure: number, at: Point): Point[] {
    const width = 3 * this.scene.figures.length;
    return this.scene.t.map((_, k) => {
      const [x, y, angle] = this.#poses.subarray(k * width + 3 * figure, k * width + 3 * figure + 3);
      return moved({ x, y, angle }, at);
    });
  }
}
