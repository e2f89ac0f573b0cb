/** What the page holds as JSON; views/report/data.py writes it. Lengths in m, angles in rad, times in s. */

/** Numbers as Float32, little-endian, in base64. */
export type Floats = string;
export type Point = [number, number];

export interface ReportData {
  scene: Scene;
  /** Null where what acts is not known, as of a run from a file. */
  loads: Loads | null;
  plots: Plot[];
  marks: Mark[];
  /** From when on no digit holds. */
  noneFrom: number | null;
  /** How numbers in SI are shown; those of plots are so already. */
  units: Record<Unit, Shown>;
}

export type Unit = "m" | "rad" | "N" | "N*m" | "N*s";

/** A unit, and how much SI one of it is. */
export interface Shown {
  unit: string;
  size: number;
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
  points: Named[];
  joints: Named[];
  /** Names of the points that are traced unless the reader chooses others. */
  traced: string[];
  flashes: Flash[];
}

/** Something that may come and go: whether it is there, at every time; always where nothing is said. */
export interface Passing {
  shown?: boolean[];
}

export interface Figure {
  name: string;
  /** Of the palette. */
  tone: number;
  /** −1 behind the others, 1 in front of them. */
  layer: number;
  strokes: Stroke[];
}

export type Style = "hatch" | "dash" | "band" | "body" | "rail" | "block" | "mark" | "slot" | "coil" | "mass" | "weld" | "pin";

export interface Stroke extends Passing {
  points: Point[];
  style: Style;
  closed: boolean;
  /** The place of a symbol, whose size is that of the drawing. */
  about: Point | null;
  /** Of the palette, where not its figure's. */
  tone?: number;
}

/** Something stretched between two points (figure, x, y); lines of (along from 0 to 1, across in m). */
export interface Pair extends Passing {
  name: string;
  kind: string;
  ends: [[number, number, number], [number, number, number]];
  lines: Point[][];
}

/** A string: its way at every time, and whether it is taut; or a symbol about its first point, the spring of a contact. */
export interface Cord extends Passing {
  name: string;
  path: Floats;
  taut: boolean[];
  symbol: boolean;
}

/** A place on a figure that has a name. */
export interface Named {
  name: string;
  figure: number;
  at: Point;
}

/** An impact that flashes up. */
export interface Flash {
  t: number;
  rays: Point[][];
}

/** What acts on every body; forces in N along the fixed axes, couples in N·m counter-clockwise. */
export interface Loads {
  /** A time that stands twice is just before and just after a switch. */
  t: number[];
  tracks: Track[];
  bodies: Effective[];
  /** At every time, which of the balances hold. */
  mode: number[];
  /** Of each mode, as far as they are told. */
  balances: Balance[][];
  impulses: Impulse[];
}

/** A number that stays, or one for every time; NaN where there is none. */
export type Column = number | Floats;

export type Kind =
  | "joint" | "motion" | "coupling" | "lock" | "weight" | "force" | "contact" | "string" | "stop" | "friction";

/** What one load does to one body; x and y are in the frame of that. Tracks of one arrow are components of one force. */
export interface Track {
  symbol: string;
  name: string;
  kind: Kind;
  label: string;
  arrow: string;
  figure: number;
  /** The other figures that it touches. */
  others: number[];
  x: Column;
  y: Column;
  fx: Column;
  fy: Column;
  m: Column;
}

/** m a at the mass centre G and I α of a body, with what they are called. */
export interface Effective {
  figure: number;
  G: Point;
  ma: string;
  ia: string;
  fx: Column;
  fy: Column;
  m: Column;
}

/** Σ F along x or y, or Σ M about G. */
export interface Balance {
  figure: number;
  about: "x" | "y" | "G";
  terms: { symbol: string; negative: boolean; math: string }[];
}

/** Of all that something exerts at one point; in N·s and N·m·s, in the fixed axes. */
export interface Impulse {
  t: number;
  name: string;
  figure: number;
  others: number[];
  at: Point;
  /** Fx, Fy, M. */
  wrench: [number, number, number];
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
  /** What the one curve stands over, if not over time; or the angle that it goes around. */
  across?: Curve & { unit: string; around: boolean };
}

/** NaN where there is no value, and between what was before and after a switch. */
export interface Curve {
  name: string;
  y: Floats;
  /** The name of what exerts it, of a force. */
  of?: string;
  /** Of a curve of another run: its own times, and the place of the one that it lies over. */
  t?: Floats;
  beside?: number;
}
