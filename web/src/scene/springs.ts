import type { Point } from "../data/types";

const LEAD = 10; // px, straight at both ends
const WIDTH = 7; // px to both sides
const ASIDE = 10; // px between the middles of a spring and a damper beside it
const COILS = { least: 4, most: 8, each: 10 }; // and px a coil

/** Lines of a spring from 0 to its length along, in px. */
export function coils(length: number): Point[][] {
  const lead = Math.min(LEAD, 0.2 * length);
  const count = Math.round(Math.min(COILS.most, Math.max(COILS.least, length / COILS.each)));
  const width = Math.min(WIDTH, 0.25 * length);
  const step = (length - 2 * lead) / (2 * count);
  const teeth = Array.from({ length: 2 * count - 1 }, (_, i): Point => [lead + (i + 1) * step, i % 2 ? -width : width]);
  return [[[0, 0], [lead, 0], ...teeth, [length - lead, 0], [length, 0]]];
}

/** Lines of a damper: a cup of a fixed size, and a piston that goes to and fro. */
export function dashpot(length: number): Point[][] {
  const [from, to] = [0.3 * length, Math.min(0.7 * length, 0.3 * length + 26)];
  const piston = (from + to) / 2;
  return [
    [[0, 0], [from, 0]],
    [[to, WIDTH], [from, WIDTH], [from, -WIDTH], [to, -WIDTH]],
    [[piston, 0.75 * WIDTH], [piston, -0.75 * WIDTH]],
    [[piston, 0], [length, 0]],
  ];
}

/** Lines moved aside, still from end to end. */
export function beside(lines: Point[][], length: number, way: number): Point[][] {
  if (!way) return lines;
  const moved = lines.map((line) => line.map(([along, across]): Point => [along, across + way * ASIDE]));
  return [...moved, [[0, 0], [0, way * ASIDE]], [[length, 0], [length, way * ASIDE]]];
}
