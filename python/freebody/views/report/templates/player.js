"use strict";
// The moving mechanism, and the time that it shares with the plots. Model text is shown as text only.

const data = JSON.parse(document.getElementById("data").textContent);
const byId = (id) => document.getElementById(id);
const scene = data.scene;
const start = scene.t[0];
const end = scene.t[scene.t.length - 1];
const followers = []; // called with the time whenever it changes

const player = { t: start, playing: false, speed: 1 };

function seek(t) {
  player.t = Math.min(Math.max(t, start), end);
  byId("scrub").value = end > start ? (player.t - start) / (end - start) : 0;
  byId("clock").textContent = `t = ${player.t.toFixed(digitsOfTime)} s`;
  paintMechanism();
  followers.forEach((follow) => follow(player.t));
}

// Enough digits for a thousandth of the run.
const digitsOfTime = Math.min(9, Math.max(2, Math.ceil(3 - Math.log10(Math.max(end - start, 1e-9)))));

function play(on) {
  if (on && player.t >= end) player.t = start;
  player.playing = on;
  byId("play").textContent = on ? "❚❚" : "▶";
  let last = null;
  const step = (now) => {
    if (!player.playing) return;
    const elapsed = last === null ? 0 : (now - last) / 1000;
    last = now;
    seek(player.t + elapsed * player.speed);
    if (player.t >= end) play(false);
    else requestAnimationFrame(step);
  };
  if (on) requestAnimationFrame(step);
}

// Colours follow the theme.

let tones = {};

function readTones() {
  const style = getComputedStyle(document.documentElement);
  const read = (name) => style.getPropertyValue(name).trim();
  tones = { paper: read("--paper"), ink: read("--ink"), ground: read("--quiet"), impact: read("--bad"), bodies: [0, 1, 2, 3, 4, 5, 6, 7].map((i) => read(`--c${i}`)) };
}

function mixed(tint, paper, part) {
  const channels = (hex) => [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16));
  const [a, b] = [channels(tint), channels(paper)];
  return `rgb(${a.map((x, i) => Math.round(part * x + (1 - part) * b[i])).join(" ")})`;
}

const tint = (figure) => (figure === 0 ? tones.ground : tones.bodies[(figure - 1) % tones.bodies.length]);

function look(style, figure) {
  const tone = tint(figure);
  return {
    hatch: { line: tones.ground, width: 0.8 },
    dash: { line: tone, width: 1.2, dash: [6, 4] },
    band: { line: tone, width: 5 },
    body: { fill: mixed(tone, tones.paper, 0.22), line: tone, width: 1.6 },
    rail: { line: tones.ground, width: 1.7 },
    block: { fill: mixed(tone, tones.paper, 0.22), line: tone, width: 1.6 },
    mark: { line: tone, width: 1.6 },
    slot: { fill: tones.paper, line: tone, width: 1.1 },
    mass: { fill: tone, line: tone, width: 1 },
    weld: { fill: tones.ink, line: tones.ink, width: 1 },
    pin: { fill: tones.paper, line: tones.ink, width: 1.5 },
  }[style];
}

// Later styles lie on top of earlier ones; what is stretched between points lies below the pins.
const below = ["hatch", "dash", "band", "body", "rail", "block", "mark", "slot"];
const above = ["mass", "weld", "pin"];

// From metres to pixels.

const canvas = byId("mechanism");
const pen = canvas.getContext("2d");
const view = { scale: 1, x: 0, y: 0, width: 0, height: 0 };

function fit() {
  const [x0, x1, y0, y1] = scene.bounds;
  const room = 2 * scene.size;
  const [wide, tall] = [x1 - x0 + 2 * room, y1 - y0 + 2 * room];
  view.width = canvas.clientWidth;
  view.height = Math.round(Math.min(Math.max((view.width * tall) / wide, 220), Math.max(300, 0.62 * window.innerHeight)));
  const dense = window.devicePixelRatio || 1;
  canvas.style.height = `${view.height}px`;
  canvas.width = Math.round(view.width * dense);
  canvas.height = Math.round(view.height * dense);
  pen.setTransform(dense, 0, 0, dense, 0, 0);
  view.scale = Math.min(view.width / wide, view.height / tall);
  view.x = view.width / 2 - (view.scale * (x0 + x1)) / 2;
  view.y = view.height / 2 + (view.scale * (y0 + y1)) / 2;
}

const toScreen = ([x, y]) => [view.x + view.scale * x, view.y - view.scale * y];

// The frame before a time, and how far the time is on the way to the next.
function frameAt(t) {
  let low = 0;
  let high = scene.t.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (scene.t[middle] <= t) low = middle;
    else high = middle;
  }
  const gap = scene.t[high] - scene.t[low];
  const part = gap > 0 ? Math.min(1, (t - scene.t[low]) / gap) : 0;
  return { low, high, part };
}

// Numbers of each frame, between two frames in proportion.
const between = (frames, { low, high, part }) => frames[low].map((value, i) => value + part * (frames[high][i] - value));

function placer(poses, figure) {
  const [x, y, angle] = poses.slice(3 * figure, 3 * figure + 3);
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  return ([a, b]) => [x + a * c - b * s, y + a * s + b * c];
}

function polyline(points, closed, { fill, line, width, dash }) {
  pen.beginPath();
  points.map(toScreen).forEach(([x, y]) => pen.lineTo(x, y));
  if (closed) pen.closePath();
  if (fill) {
    pen.fillStyle = fill;
    pen.fill();
  }
  pen.setLineDash(dash || []);
  pen.lineWidth = width;
  pen.strokeStyle = line;
  pen.stroke();
}

// Whether something is in place then.
const isThere = (item, frame) => !item.shown || item.shown[frame.low];

function paintFigures(poses, styles, frame) {
  for (const style of styles) {
    scene.figures.forEach((figure, i) => {
      const place = placer(poses, i);
      for (const stroke of figure.strokes) {
        if (stroke.style === style && isThere(stroke, frame)) polyline(stroke.points.map(place), stroke.closed, look(style, i));
      }
    });
  }
}

function paintCord(frame, cord) {
  const flat = between(cord.path, frame);
  const points = flat.filter((_, i) => i % 2 === 0).map((x, i) => [x, flat[2 * i + 1]]);
  const taut = cord.taut[frame.low];
  polyline(points, false, { line: taut ? tones.ink : tones.ground, width: taut ? 1.3 : 1 });
}

function paintPair(poses, pair) {
  const [a, b] = pair.ends.map(([figure, x, y]) => placer(poses, figure)([x, y]));
  const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
  const length = Math.hypot(dx, dy) || 1;
  const at = ([along, across]) => [a[0] + along * dx - (across * dy) / length, a[1] + along * dy + (across * dx) / length];
  for (const line of pair.lines) polyline(line.map(at), false, { line: tones.ink, width: 1.4 });
}

const tracePaths = scene.traces.map(({ figure, at }) => scene.poses.map((poses) => placer(poses, figure)(at)));

// The whole path faintly, what is done of it clearly.
function paintTraces(poses) {
  scene.traces.forEach(({ figure, at }, i) => {
    const done = tracePaths[i].filter((_, k) => scene.t[k] < player.t);
    polyline(tracePaths[i], false, { line: mixed(tint(figure), tones.paper, 0.35), width: 1.2 });
    polyline([...done, placer(poses, figure)(at)], false, { line: mixed(tint(figure), tones.paper, 0.7), width: 1.4 });
  });
}

// An impact glows for a moment of the film.
function paintFlashes() {
  const lasting = scene.lasting * player.speed;
  for (const flash of scene.flashes.filter(({ t }) => t <= player.t && player.t < t + lasting)) {
    pen.globalAlpha = 1 - (player.t - flash.t) / lasting;
    flash.rays.forEach((ray) => polyline(ray, false, { line: tones.impact, width: 1.8 }));
  }
  pen.globalAlpha = 1;
}

function paintMechanism() {
  pen.clearRect(0, 0, view.width, view.height);
  pen.lineJoin = pen.lineCap = "round";
  const frame = frameAt(player.t);
  const poses = between(scene.poses, frame);
  if (byId("trace").checked) paintTraces(poses);
  paintFigures(poses, below, frame);
  scene.pairs.filter((pair) => isThere(pair, frame)).forEach((pair) => paintPair(poses, pair));
  scene.cords.filter((cord) => isThere(cord, frame)).forEach((cord) => paintCord(frame, cord));
  paintFigures(poses, above, frame);
  paintFlashes();
}

// Speeds about the one at which the run lasts some eight seconds, unless life's own does.

function offerSpeeds() {
  const lasting = end - start;
  const ideal = lasting >= 2 && lasting <= 30 ? 1 : 10 ** Math.round(Math.log10(Math.max(lasting, 1e-9) / 8));
  for (const factor of [0.1, 0.25, 0.5, 1, 2, 4]) {
    const option = document.createElement("option");
    option.value = String(ideal * factor);
    option.textContent = `${Number((ideal * factor).toPrecision(3))}×`;
    option.selected = factor === 1;
    byId("speed").append(option);
  }
  player.speed = ideal;
}

function refresh() {
  readTones();
  fit();
  seek(player.t);
}

byId("play").addEventListener("click", () => play(!player.playing));
byId("scrub").addEventListener("input", (event) => {
  play(false);
  seek(start + event.target.value * (end - start));
});
byId("speed").addEventListener("change", (event) => {
  player.speed = Number(event.target.value);
});
byId("trace").addEventListener("change", paintMechanism);
byId("tracing").hidden = scene.traces.length === 0;
byId("theme").addEventListener("click", () => {
  const root = document.documentElement;
  root.dataset.theme = root.dataset.theme === "dark" ? "light" : "dark";
  refresh();
});
document.addEventListener("keydown", (event) => {
  if (event.code !== "Space" || ["BUTTON", "SELECT", "INPUT"].includes(event.target.tagName)) return;
  event.preventDefault();
  play(!player.playing);
});
document.documentElement.dataset.theme = matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light";
offerSpeeds();
