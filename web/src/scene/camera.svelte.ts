import type { Point, Scene } from "../data/types";

const ROOM = { aside: 40, above: 30, below: 62 }; // px, for arrows and the scales
const LEAST = 40; // px, however narrow the stage

const SYMBOL = { least: 6, most: 12 }; // px

/** From metres to pixels of the stage: everything fits, then as one has zoomed. */
export class Camera {
  width = $state(800);
  height = $state(400);
  zoom = $state.raw({ k: 1, x: 0, y: 0 });
  readonly #size: number;
  readonly #box: { middle: Point; wide: number; tall: number };

  /** `followed` is what stays in the middle of the stage, if anything. */
  constructor(
    scene: Scene,
    private readonly followed: () => Point | null,
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
    const wanted = ((this.width - 2 * ROOM.aside) * this.#box.tall) / this.#box.wide + ROOM.above + ROOM.below;
    return Math.round(Math.min(Math.max(wanted, 240), Math.max(300, 0.62 * innerHeight)));
  }

  /** Pixels a metre when everything fits. */
  get fit(): number {
    const [wide, tall] = [this.width - 2 * ROOM.aside, this.height - ROOM.above - ROOM.below];
    return Math.min(Math.max(wide, LEAST) / this.#box.wide, Math.max(tall, LEAST) / this.#box.tall);
  }

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
    return (this.height + ROOM.above - ROOM.below) / 2;
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
