import type { Clock } from "../time/clock.svelte";

/** Space and the arrows to the sides belong to the player, wherever the focus is, but for a field that is written in. */
export function pressed(event: KeyboardEvent, clock: Clock, moments: number[]): void {
  if (event.ctrlKey || event.metaKey || event.altKey || (event.target as HTMLInputElement).type === "text") return;
  if (event.code === "Space") clock.toggle();
  else if (event.code === "ArrowLeft" || event.code === "ArrowRight") {
    const way = event.code === "ArrowRight" ? 1 : -1;
    if (event.shiftKey) clock.stepTo(moments, way);
    else clock.stepFrame(way);
  } else return;
  event.preventDefault();
}
