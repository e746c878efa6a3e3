"use strict";
// The page: what is asked of the library and what is shown of its answers.
// PRESETS, WORKER, WASM and DRAWING_STYLE stand before this text.

const $ = (id) => document.getElementById(id);
const fmt = (value, digits = 4) => String(Number(Number(value).toPrecision(digits)));
const escaped = (text) => String(text).replace(/[&<>"]/g, (c) => `&#${c.charCodeAt(0)};`);
const clamp = (value, low, high) => Math.min(Math.max(value, low), high);
const NAMES = ["x_s", "y_s", "x_r", "y_r"], MICRO = 1e6;
const LIMITS = { f: [0.1, 1000], m: [1, 64] };

/* The library, in workers: the module is compiled once. A worker that is cancelled or crashes is replaced. */

const packed = new Blob([Uint8Array.from(atob(WASM), (c) => c.charCodeAt(0))]);
const compiled = new Response(packed.stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer()
  .then(WebAssembly.compile);
const workerUrl = URL.createObjectURL(new Blob([WORKER], { type: "text/javascript" }));

class Engine {
  constructor() {
    this.count = 0;
    this.start();
  }

  start() {
    const worker = this.worker = new Worker(workerUrl);
    worker.onmessage = ({ data }) => this.receive(data);
    worker.onerror = (event) => {
      event.preventDefault();
      this.fail(event.message);
    };
    compiled.then((module) => worker.postMessage({ module }));
  }

  // Of the questions that wait, the last one alone is answered; the others get status -1.
  ask(question, onPoints) {
    return new Promise((resolve) => {
      const job = { question, onPoints, resolve };
      if (!this.job) return this.send(job);
      this.waiting?.resolve({ status: -1 });
      this.waiting = job;
    });
  }

  send(job) {
    this.job = job;
    job.id = ++this.count;
    const worker = this.worker;
    compiled.then(() => worker.postMessage({ ...job.question, id: job.id }));
  }

  receive(data) {
    if (data.id !== this.job?.id) return;
    if (data.points) this.job.onPoints?.(data.points);
    else if (data.crash) this.fail(data.crash);
    else this.finish(data);
  }

  finish(result) {
    const { job, waiting } = this;
    this.job = this.waiting = null;
    if (waiting) this.send(waiting);
    job?.resolve(result);
  }

  restart() {
    this.worker.terminate();
    this.start();
  }

  fail(message) {
    this.restart();
    this.finish({ status: 4, text: `the module stopped (${message}); it has been started again` });
  }

  cancel() {
    if (!this.job) return;
    this.waiting?.resolve({ status: -1 });
    this.waiting = null;
    this.restart();
    this.finish({ status: -1 });
  }
}

const engines = { quick: new Engine(), judge: new Engine(), curve: new Engine(), integrator: null };
const state = { name: "", path: "", toml: "", original: "", f: 45, m: 10, from: 1, to: 60 };
const shown = { motion: null, integrated: null, branch: [], scale: null, turns: 0, playing: true };

const question = (what) => {
  const { name, toml, f, m, from, to } = state;
  return { what, file: name, toml, f, m, from, to };
};

/* The controls: one for each value of the TOML text, which holds the machine. */

const KEYS = {
  mass_kg: ["mass", "kg", 0.5, 500, "log"],
  natural_frequency_rad_per_s: ["natural frequency ω₀", "rad/s", 0, 2000],
  damping_ratio: ["damping ratio ξ", "–", 0, 0.3],
  damping_N_s_per_m: ["damping", "N s/m", 0, 2000],
  unbalance_kg_m: ["unbalance", "kg m", 0, 0.2],
  balls: ["balls n", "–", 3, 32, "whole"],
  contact_stiffness_N_per_m1p5: ["contact stiffness K_H", "N/m³ᐟ²", 1e8, 1e12, "log"],
  radial_clearance_m: ["radial clearance δ", "m", 0, 4e-4],
  diametral_clearance_m: ["diametral clearance", "m", 0, 4e-4],
  cage_speed_ratio: ["cage ratio ω_cage/ω", "–", 0.05, 0.5],
  acceleration_m_per_s2: ["gravity", "m/s²", 0, 20],
  poissons_ratio: ["Poisson's ratio", "–", 0, 0.49],
};

function about(key, value) {
  if (KEYS[key]) return KEYS[key];
  const [, name, unit = "–"] = /^(.*?)(?:_(kg_m|kg|m|Pa|N|s_per_m))?$/.exec(key);
  const size = Math.abs(value) || 1;
  return [name.replaceAll("_", " "), unit.replaceAll("_", " "), value < 0 ? -10 * size : 0, 10 * size];
}

// From 0 to 1000 and back.
function sliderScale([, , low, high, kind], value) {
  low = Math.min(low, value);
  high = Math.max(high, value);
  if (kind === "log" && low > 0)
    return { of: (v) => 1000 * Math.log(v / low) / Math.log(high / low),
      at: (s) => Number((low * (high / low) ** (s / 1000)).toPrecision(4)) };
  const at = (s) => low + (high - low) * s / 1000;
  return { of: (v) => 1000 * (v - low) / (high - low),
    at: (s) => kind === "whole" ? Math.round(at(s)) : Number(at(s).toPrecision(4)) };
}

const ASSIGNED = /^(\s*([A-Za-z_]\w*)\s*=\s*)("[^"]*"|[^#]*?)(\s*(?:#.*)?)$/;

function setLine(k, value) {
  const lines = state.toml.split("\n");
  lines[k] = lines[k].replace(ASSIGNED, (_, before, key, old, after) => before + value + after);
  state.toml = lines.join("\n");
  update();
}

function addControl(list, k, section, key, written) {
  const value = Number(written), isNumber = written !== "" && Number.isFinite(value);
  const [name, unit] = isNumber ? about(key, value) : [key.replaceAll("_", " "), ""];
  const row = document.createElement("div"), id = `key-${section}-${key}`;
  row.className = "key";
  row.dataset.key = `${section}.${key}`;
  row.dataset.line = k + 1;
  row.innerHTML = `<label for="${id}">${escaped(name)} ${unit && `<small>[${escaped(unit)}]</small>`}</label>
    <input id="${id}" ${isNumber ? 'type="number" step="any"' : 'type="text"'}>
    <button aria-label="Reset ${section} ${escaped(name)}" title="reset">↺</button>`;
  const [, input, reset] = row.children;
  input.value = written;
  const first = state.original.split("\n")[k]?.match(ASSIGNED)?.[3] ?? written;
  let slide = null;
  if (isNumber) {
    const scale = sliderScale(about(key, value), value);
    slide = document.createElement("input");
    Object.assign(slide, { type: "range", min: 0, max: 1000, step: 1, value: scale.of(value) });
    slide.setAttribute("aria-label", `${section} ${name}`);
    const speak = () => slide.setAttribute("aria-valuetext", `${input.value} ${unit}`);
    slide.oninput = () => {
      input.value = scale.at(Number(slide.value));
      speak();
      setLine(k, input.value);
    };
    input.addEventListener("input", () => {
      slide.value = scale.of(Number(input.value));
      speak();
    });
    speak();
    row.append(slide);
  }
  row.insertAdjacentHTML("beforeend", '<p class="refusal" hidden></p>');
  input.addEventListener("input", () => setLine(k, input.value));
  reset.onclick = () => {
    input.value = first;
    input.dispatchEvent(new Event("input"));
  };
  list.append(row);
}

function buildControls() {
  const list = $("keys");
  list.replaceChildren();
  let section = "";
  state.toml.split("\n").forEach((line, k) => {
    const head = /^\s*\[+\s*([\w.]+)\s*\]+/.exec(line), assigned = ASSIGNED.exec(line);
    if (head) {
      section = head[1];
      list.insertAdjacentHTML("beforeend", `<h3>${section}</h3>`);
    } else if (assigned && section) {
      addControl(list, k, section, assigned[2], assigned[3]);
    }
  });
}

function showSpeed() {
  for (const id of ["f", "m"])
    for (const input of [$(id), $(`${id}-slide`)])
      if (document.activeElement !== input) input.value = state[id];
  $("f-slide").min = $("from").value = state.from;
  $("f-slide").max = $("to").value = state.to;
  drawSpeed();
}

function takeNumber(id, value, after) {
  const number = Number(value), [low, high] = LIMITS[id];
  const good = value !== "" && number >= low && number <= high && (id !== "m" || Number.isInteger(number));
  markRow($(id).parentElement, good ? "" : `must be ${id === "m" ? "a whole number " : ""}in ${low}…${high}`);
  if (!good) return fail(2, `${id === "f" ? "speed" : "harmonics"} out of range`);
  state[id] = number;
  showSpeed();
  update(after);
}

function setSpeed(f) {
  takeNumber("f", Number(clamp(f, Math.max(state.from, LIMITS.f[0]), state.to).toPrecision(5)), { machine: false });
  $("f").value = $("f-slide").value = state.f;
}

function markRow(row, message) {
  const refusal = row.querySelector(".refusal");
  refusal.hidden = !message;
  refusal.textContent = message;
  const input = row.querySelector("input");
  if (message) input.setAttribute("aria-invalid", "true");
  else input.removeAttribute("aria-invalid");
}

function alertOf(message) {
  $("alert").hidden = !message;
  $("alert").textContent = message;
}

// A refused value goes red in its row; what has no row is said above.
function showRefusal(message) {
  for (const row of $("keys").querySelectorAll(".key")) markRow(row, "");
  const at = message.startsWith(state.name + ":") && /^:(\d+): (.*)/s.exec(message.slice(state.name.length));
  const row = at && $("keys").querySelector(`[data-line="${at[1]}"]`);
  if (row) markRow(row, at[2]);
  alertOf(row ? "" : message);
}

/* One answer after the other: the motion at once, then its error, its verdict, the response curve. */

let turn = 0, timers = [];

function later(milliseconds, task) {
  timers.push(setTimeout(task, milliseconds));
}

function notesOf(text) {
  return (key) => text.split("\n").find((line) => line.startsWith(`# ${key}: `))?.slice(key.length + 4);
}

function showVerdict(word, text) {
  $("verdict").dataset.verdict = $("orbit").dataset.verdict = word;
  $("verdict").textContent = text;
  $("orbit").setAttribute("class", word);
}

async function update({ machine = true } = {}) {
  const begin = performance.now(), mine = ++turn;
  timers.forEach(clearTimeout);
  timers = [];
  engines.judge.cancel();
  if (machine) engines.curve.cancel();
  engines.integrator?.cancel();
  shown.integrated = null;
  $("integrate-state").textContent = "";
  showVerdict("computing", "computing…");
  $("error-state").textContent = "computing…";
  showCommand();
  later(250, () => {
    $("motion-state").textContent = "computing…";
    clearMotion("computing…");
    $("cancel").hidden = false;
  });
  const result = await engines.quick.ask(question("orbit"));
  if (mine !== turn) return;
  timers.forEach(clearTimeout);
  $("cancel").hidden = true;
  showRefusal(result.status === 2 ? result.text : "");
  if (result.status !== 0) return fail(result.status, result.text);
  showMotion(result);
  document.body.dataset.ms = performance.now() - begin;
  document.body.dataset.memory = result.memory;
  later(120, () => showError(mine));
  later(250, () => judge(mine));
  if (machine) later(400, followCurve);
}

// No motion: why, and nothing that could be taken for one.
function fail(status, message) {
  turn += status === 2 ? 1 : 0;
  timers.forEach(clearTimeout);
  const why = { "-1": "cancelled", 2: "not computed: a value is refused", 3: `no solution: ${message}`, 4: message }[status];
  $("motion-state").textContent = why;
  $("error-state").textContent = "–";
  showVerdict("none", "–");
  clearMotion(status === 3 ? "no solution" : why);
  if (status === 4) alertOf(message);
  if (status !== 3) return;
  later(400, followCurve);
}

async function showError(mine) {
  const result = await engines.quick.ask(question("error"));
  if (mine !== turn || result.status === -1) return;
  $("error-state").textContent = result.status === 0 ? notesOf(result.text)("error")?.replace("; tolerance inf", "") ?? "–"
    : `not known: ${result.text.replace(/^.* Hz: /, "")}`;
}

async function judge(mine) {
  const result = await engines.judge.ask(question("verdict"));
  if (mine !== turn || result.status === -1) return;
  if (result.status !== 0) return showVerdict("undecided", `undecided; ${result.text}`);
  const note = notesOf(result.text), stability = note("stability");
  const parts = [stability, note("regime") && `regime: ${note("regime")}`, note("distance") && `distance: ${note("distance")}`,
    note("warning")];
  showVerdict(stability.split(";")[0], parts.filter(Boolean).join(". "));
  $("notes").textContent = result.text.replace(/^=.*\n?/gm, "");
}

async function followCurve() {
  const mine = turn;
  shown.branch = [];
  $("curve-state").textContent = "computing…";
  $("curve-cancel").hidden = false;
  const begin = performance.now();
  let drawn = begin;
  const result = await engines.curve.ask(question("response"), (points) => {
    shown.branch.push(...points);
    if (performance.now() - drawn < 200) return;
    drawCurve();
    drawn = performance.now();
  });
  if (result.status === -1 && mine !== turn) return;
  $("curve-cancel").hidden = true;
  const folds = notesOf(result.text ?? "")("folds");
  $("curve-state").textContent = { 0: `${shown.branch.length} points, folds: ${folds}`, "-1": "cancelled" }[result.status] ??
    result.text;
  document.body.dataset.curve = performance.now() - begin;
  drawCurve();
}

async function integrate() {
  const mine = turn;
  $("integrate-state").textContent = "integrating…";
  engines.integrator ??= new Engine();
  const result = await engines.integrator.ask(question("integrate"));
  if (mine !== turn || result.status === -1) return;
  if (result.status !== 0) {
    $("integrate-state").textContent = result.text;
    return;
  }
  shown.integrated = decoded(result);
  $("integrate-state").textContent = `integrated, ${notesOf(result.text)("regime")} (black)`;
  if (shown.motion) drawOrbit();
}

/* Drawing: SVG as text, anew for each answer; what moves is kept at hand. */

function decoded({ numbers, text }) {
  const [rows, perTurn, balls, cage, clearance, first, count] = numbers;
  let at = 8;
  const take = (n) => numbers.subarray(at, at += n);
  const samples = take(6 * rows), loads = take(2 * perTurn * balls), lines = take(5 * count);
  const names = text.split("\n").filter((line) => line.startsWith("=")).map((line) => line.slice(1));
  const column = (i) => Float64Array.from({ length: rows }, (_, k) => samples[6 * k + i]);
  return { rows, perTurn, balls, cage, clearance, first, loads,
    lines: names.map((name, k) => ({ name, f: lines[5 * k], size: Math.max(...lines.subarray(5 * k + 1, 5 * k + 5)) })),
    ...Object.fromEntries([...NAMES, "F_x", "F_y"].map((name, i) => [name, column(i)])) };
}

function ticks(low, high, most = 6) {
  const rough = (high - low) / most, power = 10 ** Math.floor(Math.log10(rough));
  const step = power * [1, 2, 5, 10].find((s) => s * power >= rough);
  const list = [];
  for (let v = Math.ceil(low / step) * step; v <= high + 1e-9 * step; v += step) list.push(Number(v.toPrecision(10)));
  return list;
}

function logTicks(low, high) {
  const list = [];
  const factors = high / low < 50 ? [1, 2, 5] : [1], stride = Math.ceil(Math.log10(high / low) / 7) || 1;
  for (let p = Math.floor(Math.log10(low)); p <= Math.log10(high); p += stride)
    for (const s of factors) if (s * 10 ** p >= low && s * 10 ** p <= high) list.push(s * 10 ** p);
  return list;
}

function frame(svg, [x0, x1], [y0, y1], { x, y = "", log = false, square = false }) {
  const { width, height } = svg.viewBox.baseVal, left = 48, right = width - 12, top = 12, bottom = height - 34;
  const place = log ? (v) => Math.log(v / y0) / Math.log(y1 / y0) : (v) => (v - y0) / (y1 - y0);
  const X = (v) => left + (right - left) * (v - x0) / (x1 - x0);
  const Y = (v) => bottom - (bottom - top) * place(v);
  const text = (at, anchor, label) => `<text ${at} text-anchor="${anchor}">${label}</text>`;
  const axes = `<rect class="axis" x="${left}" y="${top}" width="${right - left}" height="${bottom - top}"/>` +
    ticks(x0, x1, square ? 5 : 7).map((v) => text(`x="${X(v)}" y="${bottom + 14}"`, "middle", fmt(v))).join("") +
    (log ? logTicks(y0, y1) : ticks(y0, y1, 5)).map((v) => `<path class="axis" d="M${left} ${Y(v)}H${right}"/>` +
      text(`x="${left - 5}" y="${Y(v) + 4}"`, "end", fmt(v))).join("") +
    text(`x="${(left + right) / 2}" y="${height - 5}"`, "middle", x) + text(`x="4" y="${top - 2}"`, "start", y);
  return { X, Y, axes, left, right, top, bottom, x0, x1 };
}

const path = (name, points) => `<path class="${name}" d="M${points.join("L")}"/>`;

function clearMotion(why) {
  shown.motion = shown.view = null;
  for (const id of ["orbit", "time", "contact", "spectrum"]) {
    const { width, height } = $(id).viewBox.baseVal;
    $(id).innerHTML = `<text class="none" x="${width / 2}" y="${height / 2}" text-anchor="middle">${escaped(why)}</text>`;
    $(id).setAttribute("aria-label", why);
  }
}

function showMotion(result) {
  const note = notesOf(result.text);
  shown.motion = decoded(result);
  shown.motion.chosen = note("method").includes("two frequencies");
  showCommand();
  $("motion-state").textContent = `${note("method")}; ${fmt(result.ms, 3)} ms`;
  $("notes").textContent = result.text.replace(/^=.*\n?/gm, "");
  drawOrbit();
  drawTime();
  drawContact();
  drawSpectrum();
}

function span(columns) {
  let low = Infinity, high = -Infinity;
  for (const column of columns)
    for (const v of column) {
      low = Math.min(low, v);
      high = Math.max(high, v);
    }
  return [low * MICRO, high * MICRO];
}

// What is drawn as orbits: both bodies, or the rotor as seen from the stator.
function view(q) {
  if (!q || !$("relative").checked) return q;
  const zero = q.x_s.map(() => 0);
  return { ...q, x_r: q.x_r.map((v, k) => v - q.x_s[k]), y_r: q.y_r.map((v, k) => v - q.y_s[k]), x_s: zero, y_s: zero };
}

function drawOrbit() {
  const motion = shown.view = view(shown.motion), integrated = view(shown.integrated), all = integrated ? [motion, integrated] : [motion];
  const delta = motion.clearance * MICRO;
  const range = (axis) => {
    const r = span(all.map((q) => q[`${axis}_r`])), s = span(all.map((q) => q[`${axis}_s`]));
    return [Math.min(r[0], s[0] - delta), Math.max(r[1], s[1] + delta)];
  };
  const [xs, ys] = [range("x"), range("y")], size = Math.max(xs[1] - xs[0], ys[1] - ys[0], 1e-9);
  const centre = [(xs[0] + xs[1]) / 2, (ys[0] + ys[1]) / 2], half = 0.86 * size;
  const svg = $("orbit"), at = frame(svg, [centre[0] - half * 0.948, centre[0] + half * 0.948].map((v) => v + 0),
    [centre[1] - half * 0.932, centre[1] + half * 0.932], { x: "x [µm]", y: "y", square: true });
  const line = (q, name, body) => path(name, Array.from(q[`x_${body}`], (x, k) =>
    `${at.X(x * MICRO).toFixed(1)} ${at.Y(q[`y_${body}`][k] * MICRO).toFixed(1)}`)) ;
  const closed = (q, name, body) => line(q, name, body).replace('"/>', q.rows === q.perTurn || q === motion && q.rows < 8 * q.perTurn ? 'Z"/>' : '"/>');
  svg.innerHTML = at.axes + (integrated ? line(integrated, "integrated", "r") + line(integrated, "integrated", "s") : "") +
    closed(motion, "x_s", "s") + closed(motion, "x_r", "r") +
    `<circle class="clearance" r="${at.X(delta) - at.X(0)}"/><circle class="dot x_s" r="4"/><circle class="dot x_r" r="4"/>` +
    '<circle class="ball"/>'.repeat(motion.balls);
  svg.setAttribute("aria-label", "Orbits of rotor and stator; half peak-to-peak " + NAMES.map((name) => {
    const [low, high] = span([motion[name]]);
    return `${name} ${fmt((high - low) / 2, 3)} µm`;
  }).join(", "));
  const [circle, stator, rotor, ...balls] = svg.querySelectorAll("circle");
  const ring = [(at.left + at.right) / 2, (at.top + at.bottom) / 2], radius = (at.right - at.left) / 2 - 14;
  motion.moving = { at, circle, stator, rotor, balls, ring, radius,
    small: Math.min(11, 0.85 * radius * Math.sin(Math.PI / Math.max(motion.balls, 2))) };
  let deepest = 1e-12;
  for (let k = 0; k < motion.rows; ++k)
    deepest = Math.max(deepest, Math.hypot(motion.x_r[k] - motion.x_s[k], motion.y_r[k] - motion.y_s[k]) - motion.clearance);
  motion.deepest = deepest;
  move();
}

// The instant of the animation: `turns` of the rotor, from phase 0.
function move() {
  const { view: motion, turns } = shown;
  if (!motion?.moving) return;
  const { at, circle, stator, rotor, balls, ring, radius, small } = motion.moving;
  const k = Math.floor(turns * motion.perTurn) % motion.rows;
  const put = (element, x, y) => {
    element.setAttribute("cx", x.toFixed(1));
    element.setAttribute("cy", y.toFixed(1));
  };
  const s = [motion.x_s[k], motion.y_s[k]], r = [motion.x_r[k], motion.y_r[k]];
  put(circle, at.X(s[0] * MICRO), at.Y(s[1] * MICRO));
  put(stator, at.X(s[0] * MICRO), at.Y(s[1] * MICRO));
  put(rotor, at.X(r[0] * MICRO), at.Y(r[1] * MICRO));
  balls.forEach((ball, j) => {
    const whole = motion.rows < 8 * motion.perTurn ? turns : k / motion.perTurn;
    const angle = 2 * Math.PI * (motion.cage * (motion.first + whole) + j / motion.balls);
    const deep = Math.cos(angle) * (r[0] - s[0]) + Math.sin(angle) * (r[1] - s[1]) - motion.clearance;
    const load = deep > 0 ? 20 + 80 * Math.min(1, deep / motion.deepest) ** 1.5 : 0;
    put(ball, ring[0] + radius * Math.cos(angle), ring[1] - radius * Math.sin(angle));
    ball.setAttribute("r", small);
    ball.style.fill = `color-mix(in srgb, var(--load) ${load.toFixed(0)}%, var(--idle))`;
  });
  const t = shown.motion.cursors, where = turns % (motion.rows / motion.perTurn);
  t?.time?.setAttribute("transform", `translate(${t.timeX(where)})`);
  t?.contact?.setAttribute("transform", `translate(${t.contactX(turns % 2)})`);
}

const cursor = (at) => `<path class="cursor" d="M0 ${at.top}V${at.bottom}"/>`;

function drawTime() {
  const { motion } = shown, svg = $("time"), [low, high] = span(NAMES.map((name) => motion[name]));
  const pad = 0.05 * (high - low) || 1;
  const at = frame(svg, [0, motion.rows / motion.perTurn], [low - pad, high + pad], { x: "turns", y: "µm" });
  svg.innerHTML = at.axes + NAMES.map((name, i) => path(name, Array.from({ length: motion.rows + 1 }, (_, k) =>
    `${at.X(k / motion.perTurn).toFixed(1)} ${at.Y(motion[name][k % motion.rows] * MICRO).toFixed(1)}`)) +
    `<text class="${name}" x="${at.left + 60 + 45 * i}" y="${at.top + 14}">${name}</text>`).join("") + cursor(at);
  motion.cursors = { ...motion.cursors, time: svg.lastElementChild, timeX: at.X };
}

function drawContact() {
  const { motion } = shown, { loads, balls, perTurn } = motion, svg = $("contact"), levels = 5;
  const at = frame(svg, [0, 2], [0.5, balls + 0.5], { x: "turns", y: "ball" });
  let largest = 0;
  for (const load of loads) largest = Math.max(largest, load);
  const runs = Array.from({ length: levels }, () => []);
  const level = (k, j) => Math.ceil(levels * loads[k * balls + j] / largest) - 1;
  for (let j = 0; j < balls && largest > 0; ++j)
    for (let k = 0, end; k < 2 * perTurn; k = end) {
      const now = level(k, j);
      for (end = k + 1; end < 2 * perTurn && level(end, j) === now;) ++end;
      if (now >= 0) runs[now].push(`M${at.X(k / perTurn).toFixed(1)} ${at.Y(j + 1).toFixed(1)}H${at.X(end / perTurn).toFixed(1)}`);
    }
  svg.innerHTML = at.axes + runs.map((run, k) => `<path class="load" stroke-width="${0.8 * (at.Y(1) - at.Y(2))}"
    opacity="${(k + 1) / levels}" d="${run.join("") || "M0 0"}"/>`).join("") + cursor(at) +
    (largest > 0 ? "" : `<text class="name" x="${(at.left + at.right) / 2}" y="${(at.top + at.bottom) / 2}"
      text-anchor="middle">no ball touches its race</text>`);
  svg.setAttribute("aria-label", `Contact map; largest force of a ball ${fmt(largest, 3)} N`);
  svg.insertAdjacentHTML("beforeend",
    `<text x="${at.right}" y="${at.top - 2}" text-anchor="end">largest ${fmt(largest, 3)} N</text>`);
  motion.cursors = { ...motion.cursors, contact: svg.querySelector(".cursor"), contactX: at.X };
}

function drawSpectrum() {
  const { motion } = shown, svg = $("spectrum");
  const lines = [...motion.lines].filter((line) => line.f > 0 && line.size > 0).sort((a, b) => b.size - a.size);
  const top = (lines[0]?.size ?? 1e-6) * MICRO, least = top * 1e-5;
  const seen = lines.filter((line) => line.size * MICRO > least);
  const at = frame(svg, [0, 1.08 * Math.max(state.f, ...seen.map((line) => line.f))], [least, 2.5 * top],
    { x: "f [Hz]", y: "µm", log: true });
  const free = [];
  const label = (line) => {
    const x = at.X(line.f), y = at.Y(line.size * MICRO) - 5, wide = 7 * line.name.length;
    if (!line.name || free.length > 9 || free.some(([u, v, w]) => Math.abs(u - x) < (w + wide) / 2 && Math.abs(v - y) < 12)) return "";
    free.push([x, y, wide]);
    return `<text class="name" x="${x}" y="${y}" text-anchor="middle">${escaped(line.name)}</text>`;
  };
  svg.innerHTML = at.axes + seen.map((line) =>
    `<path class="stem" d="M${at.X(line.f).toFixed(1)} ${at.bottom}V${at.Y(line.size * MICRO).toFixed(1)}"/>`).join("") +
    seen.map(label).join("");
  svg.setAttribute("aria-label", "Spectrum; largest lines " + seen.slice(0, 5).map((line) =>
    `${line.name || "unnamed"} ${fmt(line.f)} Hz ${fmt(line.size * MICRO, 3)} µm`).join(", "));
}

function drawCurve() {
  const svg = $("curve"), { branch } = shown;
  const seen = branch.flatMap((point) => point.slice(1)).filter((v) => v > 1e-12).map((v) => v * MICRO);
  const low = seen.reduce((a, b) => Math.min(a, b), Infinity), high = seen.reduce((a, b) => Math.max(a, b), 0);
  const at = shown.scale = frame(svg, [state.from, state.to], high > 0 ? [low / 1.5, high * 1.5] : [0.1, 100],
    { x: "f [Hz]", y: "µm", log: true });
  const curve = (name, i) => {
    const points = branch.filter((point) => point[i + 1] > 1e-12);
    return points.length < 2 ? "" : path(name, points.map((point) =>
      `${at.X(point[0]).toFixed(1)} ${at.Y(point[i + 1] * MICRO).toFixed(1)}`)) ;
  };
  const isFold = (k) => k > 0 && k < branch.length - 1 &&
    (branch[k][0] - branch[k - 1][0]) * (branch[k + 1][0] - branch[k][0]) < 0;
  svg.innerHTML = at.axes + NAMES.map((name, i) => curve(name, i) +
    `<text class="${name}" x="${at.left + 12 + 30 * i}" y="${at.top + 14}">${name}</text>`).join("") +
    branch.map((point, k) => isFold(k) && point[3] > 0 ? `<circle class="fold" r="3.5" cx="${at.X(point[0])}"
      cy="${at.Y(point[3] * MICRO)}"/>` : "").join("") +
    `<g id="speed"><path class="speed" d="M0 ${at.top}V${at.bottom}"/><circle class="grip" r="5" cy="${at.bottom}"/></g>`;
  drawSpeed();
}

function drawSpeed() {
  if (!shown.scale) return;
  const x = shown.scale.X(clamp(state.f, state.from, state.to));
  $("speed").setAttribute("transform", `translate(${x})`);
  for (const [name, value] of [["now", state.f], ["min", state.from], ["max", state.to]])
    $("curve").setAttribute(`aria-value${name}`, value);
  $("curve").setAttribute("aria-valuetext", `${fmt(state.f)} Hz`);
}

/* Machines in, results out. */

function stem() {
  return state.name.replace(/\.toml$/, "");
}

function showMachine({ name, path = name, toml }, { keep = {} } = {}) {
  Object.assign(state, { name, path, toml, original: toml }, keep);
  alertOf("");
  buildControls();
  showSpeed();
  drawCurve();
  update();
}

async function loadFile(file) {
  const toml = await file.text();
  const result = await engines.quick.ask({ ...question("orbit"), file: file.name, toml });
  if (result.status === 2) return alertOf(result.text);
  $("preset").value = "";
  showMachine({ name: file.name, toml });
}

function save(name, text, type) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([text], { type }));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

async function saveTable() {
  const result = await engines.quick.ask(question("table"));
  if (result.status === 0) save(`${stem()}-orbit.tsv`, result.text, "text/tab-separated-values");
  else if (result.status > 0) alertOf(result.text);
}

function pictureText() {
  const colours = getComputedStyle(document.documentElement);
  const values = ["ink", "ground", "quiet", "line", "panel", "link", "bad", "rotor", "stator", "rotor2", "stator2", "load",
    "idle"].map((name) => `--${name}: ${colours.getPropertyValue(`--${name}`)};`).join("");
  const panels = ["orbit", "curve", "time", "contact", "spectrum"].map((id, k) => {
    const { width, height } = $(id).viewBox.baseVal, [x, y] = [[0, 20], [430, 20], [430, 330], [0, 430], [430, 600]][k];
    const content = new XMLSerializer().serializeToString($(id)).replace(/^<svg[^>]*>|<\/svg>$/g, "");
    return `<svg class="${$(id).getAttribute("class") ?? ""}" x="${x}" y="${y}" width="${id === "contact" ? 420 : width}"
      height="${height}" viewBox="0 0 ${width} ${height}">${content}</svg>`;
  });
  const title = `${stem()}, ${fmt(state.f)} Hz, m = ${state.m}; ${$("verdict").textContent.split(";")[0]}`;
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 950 870"><style>svg { ${values} } ${DRAWING_STYLE}</style>
    <rect width="950" height="870" fill="var(--ground)"/><text x="6" y="14">${escaped(title)}</text>${panels.join("")}</svg>`;
}

function makeLink() {
  const { f, m, from, to, name, path, toml } = state;
  const fragment = new URLSearchParams({ f, m, from, to, name, path, toml }).toString();
  history.replaceState(null, "", `#${fragment}`);
  $("link").value = location.href;
  $("link").select();
  navigator.clipboard?.writeText(location.href).catch(() => {});
}

function openLink() {
  const given = Object.fromEntries(new URLSearchParams(location.hash.slice(1)));
  if (!given.toml) return false;
  const keep = {};
  for (const key of ["f", "m", "from", "to"]) if (Number(given[key]) > 0) keep[key] = Number(given[key]);
  keep.f = clamp(keep.f ?? state.f, ...LIMITS.f);
  keep.m = clamp(Math.round(keep.m ?? state.m), ...LIMITS.m);
  if (!((keep.from ?? state.from) < (keep.to ?? state.to))) Object.assign(keep, { from: 1, to: 60 });
  const name = (given.name || "machine.toml").replace(/[^\w.-]/g, "_");
  $("preset").value = PRESETS.some((preset) => preset.path === given.path) ? given.path : "";
  showMachine({ name, path: given.path || name, toml: given.toml }, { keep });
  return true;
}

function showCommand() {
  const changed = state.toml !== state.original;
  const how = shown.motion?.chosen ? "--periods 8" : `--harmonics ${state.m}`;
  $("command").textContent = `build/explore orbit ${changed ? state.name : state.path} --frequency ${state.f} ${how}`;
  $("command").title = changed ? "save the TOML first" : "";
}

/* What the reader does. */

function setRange() {
  const from = Number($("from").value), to = Number($("to").value), good = from >= 0.1 && to > from && to <= 1000;
  for (const id of ["from", "to"]) $(id).setAttribute("aria-invalid", String(!good));
  if (!good) return alertOf("The range of the response must have 0.1 ≤ from < to ≤ 1000 Hz.");
  alertOf("");
  Object.assign(state, { from, to });
  $("f-slide").min = from;
  $("f-slide").max = to;
  engines.curve.cancel();
  followCurve();
}

function dragSpeed(event) {
  const box = $("curve").getBoundingClientRect(), at = shown.scale;
  const x = (event.clientX - box.left) / box.width * $("curve").viewBox.baseVal.width;
  setSpeed(at.x0 + (at.x1 - at.x0) * (x - at.left) / (at.right - at.left));
}

function keyOnCurve(event) {
  const step = event.shiftKey ? 1 : 0.1;
  const to = { ArrowLeft: state.f - step, ArrowDown: state.f - step, ArrowRight: state.f + step, ArrowUp: state.f + step,
    PageUp: state.f + 5, PageDown: state.f - 5, Home: state.from, End: state.to }[event.key];
  if (to === undefined) return;
  event.preventDefault();
  setSpeed(to);
}

function play(on) {
  shown.playing = on;
  $("play").textContent = on ? "Pause" : "Play";
  $("play").setAttribute("aria-pressed", String(on));
}

let last = 0;
function animate(now) {
  const seconds = Math.min(0.1, (now - last) / 1000);
  last = now;
  if (shown.playing && shown.motion) {
    shown.turns += seconds * ($("slow").checked ? 0.06 : 0.3);
    move();
  }
  requestAnimationFrame(animate);
}

function connect() {
  $("preset").innerHTML = '<option value="" hidden>own machine</option>' +
    PRESETS.map(({ path, title }) => `<option value="${path}">${escaped(title)}</option>`).join("");
  const openPreset = () => {
    const preset = PRESETS.find(({ path }) => path === $("preset").value);
    if (preset) showMachine(preset, { keep: preset.start });
  };
  $("preset").onchange = openPreset;
  $("reset-all").onclick = () => showMachine({ ...state, toml: state.original });
  $("file").onchange = ({ target }) => {
    if (target.files[0]) loadFile(target.files[0]);
    target.value = "";
  };
  for (const id of ["f", "m"])
    for (const input of [$(id), $(`${id}-slide`)])
      input.oninput = () => takeNumber(id, input.value, { machine: id === "m" });
  for (const id of ["from", "to"]) $(id).onchange = setRange;
  $("curve").onpointerdown = (event) => {
    $("curve").setPointerCapture(event.pointerId);
    dragSpeed(event);
  };
  $("curve").onpointermove = (event) => event.buttons && dragSpeed(event);
  $("curve").onkeydown = keyOnCurve;
  $("cancel").onclick = () => engines.quick.cancel();
  $("curve-cancel").onclick = () => engines.curve.cancel();
  $("play").onclick = () => play(!shown.playing);
  $("integrate").onclick = integrate;
  $("relative").onchange = () => shown.motion && drawOrbit();
  $("save-toml").onclick = () => save(state.name, state.toml, "application/toml");
  $("save-tsv").onclick = saveTable;
  $("save-svg").onclick = () => save(`${stem()}.svg`, pictureText(), "image/svg+xml");
  $("make-link").onclick = makeLink;
  $("help-open").onclick = () => $("help").showModal();
  document.onkeydown = (event) => {
    if (event.target.closest("input, select, button, summary, svg, dialog")) return;
    if (event.key === "?") $("help").showModal();
    if (event.key !== " ") return;
    event.preventDefault();
    play(!shown.playing);
  };
  window.onhashchange = openLink;
  document.head.insertAdjacentHTML("beforeend", `<style>${DRAWING_STYLE}</style>`);
  play(!matchMedia("(prefers-reduced-motion: reduce)").matches);
  $("preset").value = PRESETS[0].path;
  if (!openLink()) openPreset();
  requestAnimationFrame(animate);
}

connect();
