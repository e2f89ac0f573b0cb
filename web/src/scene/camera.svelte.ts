import type { Point, Scene } from "../data/types";
import type { Shaft } from "../loads/shafts";

const ROOM = { aside: 40, above: 30, below: 62 }; // px at least, for symbols and the scales
const LONGEST = 160; // px of an arrow that is made room for, and at most a quarter of the width: a longer one is a peak, not worth making all else small
const LABEL = 20; // px beyond its head
const LEAST = 0.35; // of the stage for the mechanism itself, however far arrows reach

const SYMBOL = { least: 6, most: 12 }; // px

/** From metres to pixels of the stage: everything fits, then as one has zoomed. */
export class Camera {
  width = $state(800);
  height = $state(400);
  zoom = $state.raw({ k: 1, x: 0, y: 0 });
  readonly #size: number;
  readonly #box: { middle: Point; wide: number; tall: number };

  /** `followed` is what stays in the middle of the stage, if anything; `shafts` are the arrows that it has room for. */
  constructor(
    scene: Scene,
    private readonly followed: () => Point | null,
    private readonly shafts: Shaft[] = [],
  ) {
    const [x0, x1, y0, y1] = scene.bounds;
    this.#size = scene.size;
    const room = 2 * scene.size;
    this.#box = { middle: [(x0 + x1) / 2, (y0 + y1) / 2], wide: x1 - x0 + room, tall: y1 - y0 + room };
  }

  get zoomed(): boolean {
    return this.zoom.k !== 1;
  }

  /** How tall the stage is at its width. */
  tallness(innerHeight: number): number {
    const fit = (this.width - 2 * ROOM.aside) / this.#box.wide;
    const { above, below } = this.#roomAt(fit);
    return Math.round(Math.min(Math.max(fit * this.#box.tall + above + below, 240), Math.max(300, 0.62 * innerHeight)));
  }

  /** px around the mechanism that arrows reach into, at so many pixels a metre. */
  #roomAt(fit: number): typeof ROOM {
    const { middle, wide, tall } = this.#box;
    return this.shafts.reduce((room, { at: [x, y], by: [dx, dy] }) => {
      const drawn = Math.min(1, Math.min(LONGEST, this.width / 4) / Math.hypot(dx, dy));
      const [right, up] = [drawn * dx + fit * (x - middle[0]), fit * (y - middle[1]) - drawn * dy];
      return {
        aside: Math.max(room.aside, Math.abs(right) - (fit * wide) / 2 + LABEL),
        above: Math.max(room.above, up - (fit * tall) / 2 + LABEL),
        below: Math.max(room.below, -up - (fit * tall) / 2 + LABEL),
      };
    }, ROOM);
  }

  #fitIn({ aside, above, below }: typeof ROOM): number {
    const [wide, tall] = [this.width - 2 * aside, this.height - above - below];
    return Math.min(Math.max(wide, LEAST * this.width) / this.#box.wide, Math.max(tall, LEAST * this.height) / this.#box.tall);
  }

  /** The smaller the mechanism, the farther arrows reach out of it: this settles in a few rounds. */
  readonly #room = $derived.by(() => Array.from({ length: 4 }).reduce<typeof ROOM>((room) => this.#roomAt(this.#fitIn(room)), ROOM));

  /** Pixels a metre when everything fits. */
  readonly fit = $derived.by(() => this.#fitIn(this.#room));

  /** Pixels a metre. */
  readonly scale = $derived.by(() => this.zoom.k * this.fit);

  /** How much larger symbols are than in metres, so that they are neither specks nor hide what they belong to. */
  readonly symbol = $derived.by(() => {
    const usual = Math.min(SYMBOL.most, Math.max(SYMBOL.least, this.#size * this.fit));
    return usual / (this.#size * this.scale);
  });

  /** Where a place is on the screen as long as nobody has zoomed or follows anything. */
  home([x, y]: Point): Point {
    const [mx, my] = this.#box.middle;
    return [this.width / 2 + this.fit * (x - mx), this.#level - this.fit * (y - my)];
  }

  get #level(): number {
    return (this.height + this.#room.above - this.#room.below) / 2;
  }

  readonly #origin: Point = $derived.by(() => {
    const { k, x, y } = this.zoom;
    const [mx, my] = this.followed() ?? this.#box.middle;
    return [k * (this.width / 2 - this.fit * mx) + x, k * (this.#level + this.fit * my) + y];
  });

  /** The transform of what is given in metres, y up. */
  get transform(): string {
    const [x, y] = this.#origin;
    return `matrix(${this.scale} 0 0 ${-this.scale} ${x} ${y})`;
  }

  screen([x, y]: Point): Point {
    const [ox, oy] = this.#origin;
    return [ox + this.scale * x, oy - this.scale * y];
  }
}
