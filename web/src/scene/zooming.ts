import { select } from "d3-selection";
import { zoom, type ZoomBehavior, zoomIdentity } from "d3-zoom";
import type { Camera } from "./camera.svelte";

/** Pan by dragging, zoom by pinching and by the wheel with Ctrl; a page that is read on is not held up, but for what is enlarged already. */
export class Zooming {
  readonly #behaviour: ZoomBehavior<SVGSVGElement, unknown>;
  #svg: SVGSVGElement | null = null;

  constructor(private readonly camera: Camera) {
    this.#behaviour = zoom<SVGSVGElement, unknown>()
      .scaleExtent([0.2, 200])
      .filter((event: Event) => this.#wanted(event))
      .on("zoom", ({ transform }) => (camera.zoom = transform));
  }

  /** To be attached to the stage. */
  readonly attach = (svg: SVGSVGElement): void => {
    this.#svg = svg;
    select(svg).call(this.#behaviour).on("dblclick.zoom", null);
  };

  by(factor: number): void {
    if (this.#svg) this.#behaviour.scaleBy(select(this.#svg), factor);
  }

  fit(): void {
    if (this.#svg) this.#behaviour.transform(select(this.#svg), zoomIdentity);
  }

  #wanted(event: Event): boolean {
    if (event instanceof WheelEvent) return event.ctrlKey || event.metaKey || this.camera.zoomed;
    if (typeof TouchEvent !== "undefined" && event instanceof TouchEvent) return event.touches.length > 1 || this.camera.zoomed;
    return event instanceof MouseEvent && event.button === 0;
  }
}
