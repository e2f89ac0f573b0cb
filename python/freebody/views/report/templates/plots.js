// Time series in SVG, each with the cursor of the shared time; a click or a drag moves the mechanism there.

const SVG = "http://www.w3.org/2000/svg";
const margin = { left: 58, right: 12, top: 8, bottom: 24 };

function element(name, attributes, parent, text) {
  const made = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  if (text !== undefined) made.textContent = text;
  parent.append(made);
  return made;
}

function html(name, className, parent, text) {
  const made = document.createElement(name);
  if (className) made.className = className;
  if (text !== undefined) made.textContent = text;
  parent.append(made);
  return made;
}

// Round numbers, about as many as asked for, within a range.
function ticks(low, high, about) {
  const raw = (high - low) / about;
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= raw * 0.999);
  const made = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k += 1) made.push(k * step);
  return made;
}

const minus = (text) => text.replaceAll("-", "−");

function figure(x, scale) {
  const small = Math.abs(x) < 1e-12 * scale ? 0 : x;
  return minus(Math.abs(small) >= 1e5 || (small !== 0 && scale < 1e-3) ? small.toExponential(1) : String(Number(small.toPrecision(6))));
}

// Where a list of times passes t: the index before it.
function before(times, t) {
  let low = 0;
  let high = times.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] <= t) low = middle;
    else high = middle;
  }
  return low;
}

function valueAt(plot, curve, t) {
  if (plot.t.length === 1) return curve.y[0];
  const i = before(plot.t, t);
  const [a, b] = [curve.y[i], curve.y[i + 1]];
  if (plot.t[i] === plot.t[i + 1]) return b;
  if (a === null || b === null) return null;
  return a + ((b - a) * (t - plot.t[i])) / (plot.t[i + 1] - plot.t[i]);
}

function rangeOf(plot) {
  const all = plot.curves.flatMap((curve) => curve.y).filter((y) => y !== null);
  if (all.length === 0) return [-1, 1];
  const low = all.reduce((a, b) => Math.min(a, b));
  const high = all.reduce((a, b) => Math.max(a, b));
  const room = high > low ? 0.06 * (high - low) : Math.abs(high) * 0.1 || 1;
  return [low - room, high + room];
}

function pathOf(plot, curve, x, y) {
  let path = "";
  let fresh = true;
  curve.y.forEach((value, i) => {
    if (value !== null) path += `${fresh ? "M" : "L"}${x(plot.t[i]).toFixed(1)} ${y(value).toFixed(1)}`;
    fresh = value === null;
  });
  return path;
}

function drawPlot(plot, svg) {
  const [width, height] = [svg.clientWidth, svg.clientHeight];
  const [low, high] = rangeOf(plot);
  const scale = Math.max(Math.abs(low), Math.abs(high));
  const x = (t) => margin.left + ((t - start) / (end - start || 1)) * (width - margin.left - margin.right);
  const y = (value) => margin.top + ((high - value) / (high - low)) * (height - margin.top - margin.bottom);
  svg.replaceChildren();
  for (const value of ticks(low, high, 6)) {
    element("line", { class: "grid", x1: margin.left, x2: width - margin.right, y1: y(value), y2: y(value) }, svg);
    element("text", { x: margin.left - 7, y: y(value) + 4, "text-anchor": "end" }, svg, figure(value, scale));
  }
  for (const t of ticks(start, end, Math.max(2, Math.min(8, width / 80)))) {
    element("line", { class: "grid", x1: x(t), x2: x(t), y1: margin.top, y2: height - margin.bottom }, svg);
    element("text", { x: x(t), y: height - 7, "text-anchor": "middle" }, svg, figure(t, end));
  }
  element("text", { x: margin.left - 22, y: height - 7, "text-anchor": "end" }, svg, "t / s");
  if (data.none_from !== null) {
    const room = { x: x(data.none_from), width: width - margin.right - x(data.none_from) };
    const gone = element("rect", { class: "gone", ...room, y: margin.top, height: height - margin.top - margin.bottom }, svg);
    element("title", {}, gone, "no digit holds");
  }
  for (const event of data.events.slice(0, 60)) {
    const line = element("line", { class: event.kind, x1: x(event.t), x2: x(event.t), y1: margin.top, y2: height - margin.bottom }, svg);
    element("title", {}, line, event.name);
  }
  for (const tick of data.ticks.slice(0, 200)) {
    const foot = height - margin.bottom;
    const line = element("line", { class: "tick", x1: x(tick.t), x2: x(tick.t), y1: foot - 6, y2: foot }, svg);
    element("title", {}, line, tick.name);
  }
  plot.curves.forEach((curve, i) => element("path", { class: `curve s${i % 8}`, d: pathOf(plot, curve, x, y) }, svg));
  plot.cursor = element("line", { class: "cursor", y1: margin.top, y2: height - margin.bottom }, svg);
  plot.place = (t) => {
    plot.cursor.setAttribute("x1", x(t));
    plot.cursor.setAttribute("x2", x(t));
  };
  plot.timeAt = (pixel) => start + ((pixel - margin.left) / (width - margin.left - margin.right)) * (end - start);
  plot.place(player.t);
}

function addPlot(plot) {
  const card = html("section", "card plot", byId("plots"));
  html("h2", "", card, plot.unit ? `${plot.title} [${plot.unit}]` : plot.title);
  const legend = html("div", "legend", card);
  const values = plot.curves.map((curve, i) => {
    const item = html("span", "", legend);
    html("i", `swatch f${i % 8}`, item);
    item.append(`${curve.name} `);
    return html("span", "value", item);
  });
  const svg = element("svg", { role: "img", "aria-label": plot.title }, card);
  if (plot.note) html("p", "remark", card, plot.note);
  const drag = (event) => {
    if (event.type !== "pointerdown" && event.buttons !== 1) return;
    play(false);
    seek(plot.timeAt(event.clientX - svg.getBoundingClientRect().left));
  };
  svg.addEventListener("pointerdown", drag);
  svg.addEventListener("pointermove", drag);
  followers.push((t) => {
    plot.place(t);
    plot.curves.forEach((curve, i) => {
      const value = valueAt(plot, curve, t);
      values[i].textContent = value === null ? "–" : minus(String(Number(value.toPrecision(4))));
    });
  });
  return () => drawPlot(plot, svg);
}

const redraw = data.plots.map(addPlot);

function layOut() {
  redraw.forEach((draw) => draw());
  refresh();
}

window.addEventListener("resize", layOut);
layOut();
