/** A symbol as one writes it: what stands on the line, and what below. */
export interface Letter {
  stem: string;
  below: string;
}

/** `m_crank g` is m with crank below it, then g. */
export function letters(label: string): Letter[] {
  return label.split(" ").map((word) => {
    const cut = word.indexOf("_", 1);
    return cut < 0 ? { stem: word, below: "" } : { stem: word.slice(0, cut), below: word.slice(cut + 1).replaceAll("_", " ") };
  });
}

/** A component of a vector whose letter ends the label: of m a along x, m a_x. */
export function component(label: string, axis: string): string {
  return `${label}${letters(label).at(-1)!.below ? "," : "_"}${axis}`;
}
