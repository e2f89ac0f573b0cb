import type { Point } from "../data/types";
import type { Camera } from "./camera.svelte";

const A_CLICK = 4; // px that a pointer may move between down and up

/** Pan by dragging, zoom by pinching and by the wheel with Ctrl. A page that one only reads on is not held up: a single finger and the
 * bare wheel act on what is enlarged already. */
export class Zooming {
  readonly #pointers = new Map<number, Point>();
  #moved = 0;

  constructor(private readonly camera: Camera) {}

  /** To be attached to the stage. */
  readonly attach = (svg: SVGSVGElement): (() => void) => {
    const listening = new AbortController();
    const how = { signal: listening.signal };
    const place = (event: MouseEvent): Point => {
      const { left, top } = svg.getBoundingClientRect();
      return [event.clientX - left, event.clientY - top];
    };
    svg.addEventListener("wheel", (event) => this.#turn(event, place(event)), { ...how, passive: false });
    svg.addEventListener("pointerdown", (event) => this.#down(event, place(event)), how);
    window.addEventListener("pointermove", (event) => this.#move(event, place(event)), how);
    for (const over of ["pointerup", "pointercancel"] as const) {
      window.addEventListener(over, (event) => this.#pointers.delete(event.pointerId), how);
    }
    svg.addEventListener("click", (event) => this.#moved > A_CLICK && event.stopPropagation(), { ...how, capture: true });
    return () => listening.abort();
  };

  /** About a place of the stage, by default its middle. */
  by(factor: number, [x, y]: Point = [this.camera.width / 2, this.camera.height / 2]): void {
    const { zoom } = this.camera;
    const k = Math.min(200, Math.max(0.2, zoom.k * factor));
    const grown = k / zoom.k;
    this.camera.zoom = { k, x: x + grown * (zoom.x - x), y: y + grown * (zoom.y - y) };
  }

  fit(): void {
    this.camera.zoom = { k: 1, x: 0, y: 0 };
  }

  #turn(event: WheelEvent, at: Point): void {
    if (!(event.ctrlKey || event.metaKey || this.camera.zoomed)) return;
    event.preventDefault();
    this.by(2 ** (-event.deltaY / 250), at);
  }

  #down(event: PointerEvent, at: Point): void {
    if (event.button) return;
    this.#pointers.set(event.pointerId, at);
    this.#moved = 0;
  }

  #move(event: PointerEvent, [x, y]: Point): void {
    const last = this.#pointers.get(event.pointerId);
    if (!last) return;
    const other = [...this.#pointers].find(([id]) => id !== event.pointerId)?.[1];
    const [dx, dy] = [x - last[0], y - last[1]];
    this.#moved += Math.hypot(dx, dy);
    if (other) this.by(Math.hypot(x - other[0], y - other[1]) / Math.hypot(last[0] - other[0], last[1] - other[1]), other);
    else if (event.pointerType === "mouse" || this.camera.zoomed) this.#pan(dx, dy);
    this.#pointers.set(event.pointerId, [x, y]);
  }

  #pan(dx: number, dy: number): void {
    const { k, x, y } = this.camera.zoom;
    this.camera.zoom = { k, x: x + dx, y: y + dy };
  }
}
