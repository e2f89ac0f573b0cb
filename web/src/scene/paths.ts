import type { Point } from "../data/types";

/** A polyline as the data of an SVG path. */
export function polyline(points: Point[], closed = false): string {
  return points.length ? `M${points.map(([x, y]) => `${short(x)} ${short(y)}`).join("L")}${closed ? "Z" : ""}` : "";
}

const short = (x: number): number => Number(x.toPrecision(7));
