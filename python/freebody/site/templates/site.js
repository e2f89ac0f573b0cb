// Pictures move where they are looked at: cards under the pointer, others as long as they are on the screen; none where motion is unwelcome.
const calm = matchMedia("(prefers-reduced-motion: reduce)").matches;
const pointing = matchMedia("(hover: hover)").matches;
const play = (svg, on) => (on && !calm ? svg.unpauseAnimations() : svg.pauseAnimations());
const seen = new IntersectionObserver((found) => found.forEach(({ target, isIntersecting }) => play(target, isIntersecting)), { threshold: 0.6 });
for (const svg of document.querySelectorAll("svg.moving")) {
  svg.setCurrentTime(Number(svg.dataset.still));
  svg.pauseAnimations();
  const card = svg.closest(".card");
  if (!card || !pointing) seen.observe(svg);
  else for (const [event, on] of [["mouseenter", true], ["focus", true], ["mouseleave", false], ["blur", false]]) card.addEventListener(event, () => play(svg, on));
}
const filter = document.getElementById("filter");
filter?.addEventListener("input", () => {
  const words = filter.value.toLowerCase().split(/\s+/);
  for (const card of document.querySelectorAll(".card")) card.hidden = !words.every((word) => card.dataset.words.includes(word));
});
