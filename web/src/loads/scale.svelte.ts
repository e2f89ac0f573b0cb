import type { Choice } from "./choice.svelte";

const LENGTH = 70; // px of a force that is usual
const TURN = 3.5; // rad of a couple that is usual

/** How long arrows are: one scale for all forces, one for all couples. */
export class LoadScale {
  constructor(
    private readonly usual: { force: number; couple: number },
    private readonly choice: Choice,
  ) {}

  /** px for each N, before anyone has stretched arrows. */
  get unstretched(): number {
    return this.usual.force ? LENGTH / this.usual.force : 0;
  }

  /** px for each N. */
  get force(): number {
    return this.unstretched * this.choice.stretch;
  }

  /** rad of an arc for each N·m. */
  get couple(): number {
    return this.usual.couple ? (TURN / this.usual.couple) * this.choice.stretch : 0;
  }
}

/** The round number, 1, 2 or 5 times a power of ten, nearest below. */
export function round(size: number): number {
  const power = 10 ** Math.floor(Math.log10(size));
  return [5, 2, 1].map((m) => m * power).find((each) => each <= size * 1.0001)!;
}
