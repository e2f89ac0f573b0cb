import type { Kind } from "../data/types";

/** Loads by what they have in common for a reader. */
export const FAMILIES: Record<string, Kind[]> = {
  weights: ["weight"],
  "given forces": ["force"],
  "joints and drives": ["joint", "motion", "coupling", "lock"],
  "contacts and strings": ["contact", "string", "stop"],
  friction: ["friction"],
};

/** What of the loads is shown, and what is lit up in diagram, balances and plots alike. */
export class Choice {
  /** The body that is cut free; null: the whole mechanism. */
  body = $state<number | null>(null);
  shown = $state(true);
  hidden = $state.raw(new Set<string>());
  /** How much longer than usual arrows are. */
  stretch = $state(1);
  #pointed = $state.raw<string[]>([]);
  #kept = $state.raw<string[]>([]);

  lit(symbols: string[]): boolean {
    return symbols.some((symbol) => this.#pointed.includes(symbol) || this.#kept.includes(symbol));
  }

  point(symbols: string[]): void {
    this.#pointed = symbols;
  }

  /** Keeps them lit until the next click on them. */
  keep(symbols: string[]): void {
    const same = symbols.length === this.#kept.length && symbols.every((symbol) => this.#kept.includes(symbol));
    this.#kept = same ? [] : symbols;
  }

  toggleFamily(family: string): void {
    const hidden = new Set(this.hidden);
    if (!hidden.delete(family)) hidden.add(family);
    this.hidden = hidden;
  }

  shows(kind: Kind | "effective"): boolean {
    return ![...this.hidden].some((family) => (FAMILIES[family] as string[]).includes(kind));
  }

  toggleBody(figure: number): void {
    this.body = this.body === figure || figure === 0 ? null : figure;
  }
}
