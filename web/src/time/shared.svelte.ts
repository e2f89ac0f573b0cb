import type { Clock } from "./clock.svelte";

/** The page around this one, if there is one, as a notebook's, sets the time by `{t}` and is told it. */
export function shareTime(clock: Clock): void {
  if (window.parent === window) return;
  window.addEventListener("message", ({ source, data }) => {
    if (source === window.parent && Number.isFinite(data?.t) && data.t !== clock.t) clock.stopAt(data.t);
  });
  $effect.root(() => {
    $effect(() => window.parent.postMessage({ t: clock.t }, "*"));
  });
}
