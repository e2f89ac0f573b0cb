/** What the page holds as JSON; views/report/data.py writes it. Lengths in m, angles in rad, times in s. */

/** Numbers as Float32, little-endian, in base64. */
export type Floats = string;
export type Point = [number, number];

export interface ReportData {
  scene: Scene;
  plots: Plot[];
  marks: Mark[];
  /** From when on no digit holds. */
  noneFrom: number | null;
}

export interface Scene {
  /** That of symbols. */
  size: number;
  /** x from, x to, y from, y to of all that is drawn at any time. */
  bounds: [number, number, number, number];
  t: number[];
  /** x, y, angle of every figure at every time. */
  poses: Floats;
  /** Ground first. */
  figures: Figure[];
  pairs: Pair[];
  cords: Cord[];
  traces: Trace[];
  flashes: Flash[];
}

/** Something that may come and go: whether it is there, at every time; always where nothing is said. */
export interface Passing {
  shown?: boolean[];
}

export interface Figure {
  name: string;
  strokes: Stroke[];
}

export type Style = "hatch" | "dash" | "band" | "body" | "rail" | "block" | "mark" | "slot" | "mass" | "weld" | "pin";

export interface Stroke extends Passing {
  points: Point[];
  style: Style;
  closed: boolean;
}

/** Something stretched between two points (figure, x, y); lines of (along from 0 to 1, across in m). */
export interface Pair extends Passing {
  name: string;
  kind: string;
  ends: [[number, number, number], [number, number, number]];
  lines: Point[][];
}

/** A string: its way at every time, and whether it is taut. */
export interface Cord extends Passing {
  name: string;
  path: Floats;
  taut: boolean[];
}

export interface Trace {
  name: string;
  figure: number;
  at: Point;
}

/** An impact that flashes up. */
export interface Flash {
  t: number;
  rays: Point[][];
}

/** A moment worth knowing: on the time bar and in the plots. */
export interface Mark {
  t: number;
  name: string;
  kind: "event" | "impact" | "switch";
}

export interface Plot {
  title: string;
  unit: string;
  t: Floats;
  curves: Curve[];
  note: string;
}

/** NaN where there is no value, and between what was before and after a switch. */
export interface Curve {
  name: string;
  y: Floats;
}
