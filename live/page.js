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
const unpacked = new Response(packed.stream().pipeThrough(new DecompressionStream("gzip")));
const compiled = unpacked.arrayBuffer().then(WebAssembly.compile);
const workerUrl = URL.createObjectURL(new Blob([WORKER], { type: "text/javascript" }));

class Engine {
  constructor() {
    this.start();
  }
  start() {
    const worker = this.worker = new Worker(workerUrl);
    worker.onmessage = ({ data }) => this.receive(data);
    worker.onerror = (event) => (event.preventDefault(), this.fail(event.message));
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
    const worker = this.worker, id = job.id = Math.random();
    this.job = job;
    compiled.then(() => worker.postMessage({ ...job.question, id }));
  }
  receive(data) {
    if (data.id !== this.job?.id) return;
    if (data.points) return this.job.onPoints?.(data.points);
    data.crash ? this.fail(data.crash) : this.finish(data);
  }
  finish(result) {
    const { job, waiting } = this;
    this.job = this.waiting = null;
    if (waiting) this.send(waiting);
    job?.resolve(result);
  }
  replace(result) {
    this.worker.terminate();
    this.start();
    this.finish(result);
  }
  fail(message) {
    this.replace({ status: 4, text: `the module stopped (${message}); it has been started again` });
  }
  cancel() {
    this.waiting?.resolve({ status: -1 });
    this.waiting = null;
    if (this.job) this.replace({ status: -1 });
  }
}

const engines = { quick: new Engine(), judge: new Engine(), curve: new Engine(), steady: new Engine() };
// `path`: where explore finds the machine.
const state = { name: "", path: "", toml: "", original: "", f: 45, m: 10, from: 1, to: 60 };
const shown = { motion: null, view: null, steady: null, branch: [], scale: null, turns: 0, playing: true };
const question = (what) => ({ ...state, what, file: state.name });

/* The controls: one for each value of the TOML text, which holds the machine. */

const KEYS = {
  mass_kg: ["mass", "kg", 0.5, 500, "log"], natural_frequency_rad_per_s: ["natural frequency ω₀", "rad/s", 0, 2000],
  damping_ratio: ["damping ratio ξ", "–", 0, 0.3], damping_N_s_per_m: ["damping", "N s/m", 0, 2000],
  unbalance_kg_m: ["unbalance", "kg m", 0, 0.2], balls: ["balls n", "–", 3, 32, "whole"],
  contact_stiffness_N_per_m1p5: ["contact stiffness K_H", "N/m^1.5", 1e8, 1e12, "log"],
  radial_clearance_m: ["radial clearance δ", "m", 0, 4e-4], diametral_clearance_m: ["diametral clearance", "m", 0, 4e-4],
  cage_speed_ratio: ["cage ratio ω_cage/ω", "–", 0.05, 0.5], acceleration_m_per_s2: ["gravity", "m/s²", 0, 20],
};

// Name, unit and range of a value; of an unknown key from the key itself.
function about(key, value) {
  const [, name, unit = "–"] = /^(.*?)(?:_(kg_m|kg|m|Pa|N))?$/.exec(key), size = 10 * Math.abs(value) || 1;
  return KEYS[key] ?? [name.replaceAll("_", " "), unit.replace("_", " "), value < 0 ? -size : 0, size];
}

// From a value to a slider's 0…1000 and back.
function sliderScale([, , low, high, kind], value) {
  [low, high] = [Math.min(low, value), Math.max(high, value)];
  const isLog = kind === "log" && low > 0;
  const at = (s) => isLog ? low * (high / low) ** (s / 1000) : low + (high - low) * s / 1000;
  return { of: (v) => 1000 * (isLog ? Math.log(v / low) / Math.log(high / low) : (v - low) / (high - low)),
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
  const id = `key-${section}-${key}`, slide = isNumber && `<input type="range" min="0" max="1000"
    aria-label="${section} ${escaped(name)}">`;
  list.insertAdjacentHTML("beforeend", `<div class="key" data-key="${section}.${key}" data-line="${k + 1}">
    <label for="${id}">${escaped(name)} ${unit && `<small>[${escaped(unit)}]</small>`}</label>
    <input id="${id}" ${isNumber ? 'type="number" step="any"' : 'type="text"'}>
    <button aria-label="Reset ${section} ${escaped(name)}" title="reset">↺</button>${slide || ""}
    <p class="refusal" hidden></p></div>`);
  const [, input, reset, range] = list.lastElementChild.children;
  const scale = isNumber && sliderScale(about(key, value), value);
  const follow = (text) => {
    if (!scale) return;
    if (document.activeElement !== range) range.value = scale.of(Number(text));
    range.setAttribute("aria-valuetext", `${text} ${unit}`);
  };
  const take = (text) => (follow(text), setLine(k, text));
  const put = (text) => take(input.value = text);
  follow(input.value = written);
  input.oninput = () => take(input.value);
  reset.onclick = () => put(state.original.split("\n")[k].match(ASSIGNED)[3]);
  if (scale) range.oninput = () => put(scale.at(Number(range.value)));
}

function buildControls() {
  const list = $("keys");
  list.replaceChildren();
  let section = "";
  state.toml.split("\n").forEach((line, k) => {
    const head = /^\s*\[+\s*([\w.]+)\s*\]+/.exec(line), assigned = ASSIGNED.exec(line);
    if (head) list.insertAdjacentHTML("beforeend", `<h3>${section = head[1]}</h3>`);
    else if (assigned && section) addControl(list, k, section, assigned[2], assigned[3]);
  });
}

function showSpeed() {
  $("f-slide").min = $("from").value = state.from;
  $("f-slide").max = $("to").value = state.to;
  for (const id of ["f", "m"])
    for (const input of [$(id), $(`${id}-slide`)]) if (document.activeElement !== input) input.value = state[id];
  drawSpeed();
}

function takeNumber(id, value) {
  const number = Number(value), [low, high] = LIMITS[id];
  const good = value !== "" && number >= low && number <= high && (id !== "m" || Number.isInteger(number));
  markRow($(id).parentElement, good ? "" : `must be ${id === "m" ? "a whole number " : ""}in ${low}…${high}`);
  if (!good) return begin(false), $("cancel").hidden = true, showNothing({ status: 2 });
  state[id] = number;
  showSpeed();
  update({ machine: id === "m" });
}

const setSpeed = (f) => takeNumber("f", Number(clamp(f, Math.max(state.from, LIMITS.f[0]), state.to).toPrecision(5)));

function markRow(row, message) {
  Object.assign(row.querySelector(".refusal"), { hidden: !message, textContent: message });
  row.querySelector("input").setAttribute("aria-invalid", String(message !== ""));
}

const alertOf = (message) => Object.assign($("alert"), { hidden: !message, textContent: message });

// A refused value goes red in its row; what has no row is said above.
function showRefusal(message) {
  for (const row of $("keys").querySelectorAll(".key")) markRow(row, "");
  const at = message.startsWith(`${state.name}:`) && /^:(\d+): (.*)/s.exec(message.slice(state.name.length));
  const row = at && $("keys").querySelector(`[data-line="${at[1]}"]`);
  if (row) markRow(row, at[2]);
  alertOf(row ? "" : message);
}

/* One answer after the other: the motion at once, then its error, its verdict and the response curve. */

let turn = 0, timers = [];
const later = (milliseconds, task) => timers.push(setTimeout(task, milliseconds));

// The next question makes everything old that is still under way.
function begin(machine) {
  timers.forEach(clearTimeout);
  engines.judge.cancel();
  engines.steady.cancel();
  if (machine) engines.curve.cancel();
  shown.steady = null;
  $("steady").textContent = "–";
  return ++turn;
}

// The values of a table's keys, as text; undefined without one.
const keysOf = (text) => (key) => text.split("\n").find((line) => line.startsWith(`# ${key}: `))?.slice(key.length + 4);

// Two errors or distances in words, where the table has them.
const errorsOf = (value, name) => value(`${name}_rms`) &&
  `${value(`${name}_largest`)} of the largest displacement, ${value(`${name}_rms`)} rms about the mean`;

function showVerdict(word, text) {
  $("verdict").className = word;
  $("verdict").textContent = text;
  $("orbit").setAttribute("class", word);
}

async function update({ machine = true } = {}) {
  const start = performance.now(), mine = begin(machine);
  showVerdict("computing", "computing…");
  $("error-state").textContent = "computing…";
  showCommand();
  later(250, () => {
    clearMotion($("motion-state").textContent = "computing…");
    $("cancel").hidden = false;
  });
  const result = await engines.quick.ask(question("orbit"));
  if (mine !== turn) return;
  timers.forEach(clearTimeout);
  $("cancel").hidden = true;
  showRefusal(result.status === 2 ? result.text : "");
  if (machine && result.status !== 2) later(400, followCurve);
  const isFound = result.status === 0, isBalance = isFound && keysOf(result.text)("method") === "aft";
  isFound ? showMotion(result) : showNothing(result);
  if (isFound) Object.assign(document.body.dataset, { ms: performance.now() - start, memory: result.memory });
  if (isBalance) later(120, () => judge(mine));
  if (isFound || result.status === 3) later(300, () => showSteady(mine, isBalance));
}

// No motion: why, and nothing that could be taken for one.
function showNothing({ status, text }) {
  const why = { "-1": "cancelled", 2: "not computed: a value is refused", 3: `no solution: ${text}`, 4: text }[status];
  $("motion-state").textContent = why;
  $("error-state").textContent = "–";
  showVerdict("none", "–");
  clearMotion(status === 3 ? "no solution" : why);
  if (status === 4) alertOf(text);
}

async function judge(mine) {
  const { status, text } = await engines.judge.ask(question("verdict"));
  if (mine !== turn || status === -1) return;
  $("error-state").textContent = status === 0 ? errorsOf(keysOf(text), "distance") ?? "not known"
    : `not known: ${text.replace(/^.* Hz: /, "")}`;
  status === 0 ? showVerdictOf(text) : showVerdict("undecided", `undecided; ${text}`);
}

const regimeOf = (value) => value("regime") + (value("period") > 1 ? ` with ${value("period")} base periods` : "");

function showVerdictOf(text) {
  const value = keysOf(text), distance = errorsOf(value, "distance"), word = value("stability");
  const parts = [word,
    value("multiplier") && `largest multiplier ${value("multiplier")} ± ${value("multiplier_uncertainty")}`,
    value("lyapunov") && `Lyapunov exponent ${value("lyapunov")} ± ${value("lyapunov_uncertainty")} 1/s`,
    `regime: ${regimeOf(value)}`, distance && `distance: ${distance}`,
    value("contact") === "no" && "no ball touches its race"];
  showVerdict(word, parts.filter(Boolean).join("; "));
  $("notes").textContent = text.replace(/^=.*\n?/gm, "");
}

// What the machine does from rest: drawn beside the motion that harmonic balance has found, or in its place.
async function showSteady(mine, isBeside) {
  $("steady").textContent = "computing…";
  const result = await engines.steady.ask({ ...question("verdict"), m: 0 });
  if (mine !== turn || result.status === -1) return;
  const value = keysOf(result.text);
  $("steady").textContent = result.status === 0 ? regimeOf(value) + (isBeside ? " (black)" : "") : result.text;
  if (result.status !== 0) return;
  if (isBeside && shown.motion) return shown.steady = decoded(result), drawOrbit();
  showMotion(result, shown.motion ? "" : $("motion-state").textContent);
  showVerdictOf(result.text);
  $("error-state").textContent = errorsOf(value, "error") ?? "–";
}

// The branch of harmonic balance; what the machine does, at 41 speeds, where the branch does not reach the end.
async function followCurve() {
  shown.branch = [];
  $("curve-state").textContent = "computing…";
  $("curve-cancel").hidden = false;
  const start = performance.now();
  let drawn = start;
  const ask = (m) => engines.curve.ask({ ...question("response"), m }, (points) => {
    shown.branch.push(...points);
    if (performance.now() - drawn < 200) return;
    drawCurve();
    drawn = performance.now();
  });
  let { status, text = "" } = await ask(state.m), why = "";
  if (status === 3 && !engines.curve.job) {
    why = ` of what the machine does; ${text}`;
    shown.branch = [];
    ({ status, text = "" } = await ask(0));
  }
  if (engines.curve.job) return;
  $("curve-cancel").hidden = true;
  const folds = keysOf(text)("folds"), said = `${shown.branch.length} points${folds ? `, folds: ${folds}` : ""}${why}`;
  $("curve-state").textContent = { 0: said, "-1": "cancelled" }[status] ?? text;
  document.body.dataset.curve = performance.now() - start;
  drawCurve();
}

/* Drawing: SVG as text, anew for each answer; what moves is kept at hand. */

function decoded({ numbers, text }) {
  const [rows, perTurn, periods, balls, cage, clearance, first, closes, instants, count] = numbers;
  let at = 10;
  const take = (n) => numbers.subarray(at, at += n);
  const samples = take(6 * rows), loads = take(instants * balls), lines = take(5 * count);
  const named = text.split("\n").filter((line) => line.startsWith("="));
  const column = (i) => Float64Array.from({ length: rows }, (_, k) => samples[6 * k + i]);
  const size = (k) => Math.max(...lines.subarray(5 * k + 1, 5 * k + 5)) * MICRO;
  return { rows, perTurn, periods, balls, cage, clearance, first, loads, instants, repeats: closes === 1,
    largest: loads.reduce((a, b) => Math.max(a, b), 0),
    lines: named.map((line, k) => ({ name: line.slice(1), f: lines[5 * k], size: size(k) })),
    ...Object.fromEntries(NAMES.map((name, i) => [name, column(i)])) };
}

function ticks(low, high, most = 6) {
  const power = 10 ** Math.floor(Math.log10((high - low) / most));
  const step = power * [1, 2, 5, 10].find((s) => s * power * most >= high - low);
  const first = Math.ceil(low / step), count = Math.floor(high / step + 1e-9) - first + 1;
  return Array.from({ length: count }, (_, k) => Number(((first + k) * step).toPrecision(10)));
}

function logTicks(low, high) {
  const decades = Math.log10(high / low), stride = Math.ceil(decades / 7), list = [];
  for (let p = Math.floor(Math.log10(low)); p <= Math.log10(high); p += stride)
    list.push(...(decades < 1.7 ? [1, 2, 5] : [1]).map((s) => s * 10 ** p).filter((v) => v >= low && v <= high));
  return list;
}

// The axes of a panel, and where a value stands.
function frame(svg, [x0, x1], [y0, y1], { x, y, log = false, most = 7 }) {
  const { width, height } = svg.viewBox.baseVal, left = 54, right = width - 12, top = 20, bottom = height - 34;
  const X = (v) => left + (right - left) * (v - x0) / (x1 - x0);
  const Y = (v) => bottom - (bottom - top) * (log ? Math.log(v / y0) / Math.log(y1 / y0) : (v - y0) / (y1 - y0));
  const text = (at, place, anchor, label) => `<text x="${at}" y="${place}" text-anchor="${anchor}">${label}</text>`;
  const axes = `<rect class="axis" x="${left}" y="${top}" width="${right - left}" height="${bottom - top}"/>` +
    ticks(x0, x1, most).map((v) => text(X(v), bottom + 14, "middle", fmt(v))).join("") +
    (log ? logTicks(y0, y1) : ticks(y0, y1, 5)).map((v) => `<path class="axis" d="M${left} ${Y(v)}H${right}"/>` +
      text(left - 5, Y(v) + 4, "end", fmt(v))).join("") +
    text((left + right) / 2, height - 5, "middle", x) + text(4, top - 4, "start", y);
  return { X, Y, axes, left, right, top, bottom, x0, x1, text };
}

const path = (name, points, end = "") => points.length < 2 ? "" : `<path class="${name}" d="M${points.join("L")}${end}"/>`;
const legend = (at) => NAMES.map((name, i) =>
  `<text class="${name}" x="${at.left + 60 + 36 * i}" y="${at.top - 4}">${name}</text>`).join("");
const cursor = (at) => `<path class="cursor" d="M0 ${at.top}V${at.bottom}"/>`;

function clearMotion(why) {
  shown.motion = shown.view = null;
  for (const id of ["orbit", "time", "contact", "spectrum"]) {
    const { width, height } = $(id).viewBox.baseVal;
    $(id).innerHTML = `<text class="none" x="${width / 2}" y="${height / 2}" text-anchor="middle">${escaped(why)}</text>`;
    $(id).setAttribute("aria-label", why);
  }
}

// `why`: what was asked for and not found.
function showMotion(result, why = "") {
  const method = keysOf(result.text)("method");
  shown.motion = { ...decoded(result), isSteady: method !== "aft" };
  const how = { aft: "harmonic balance", shooting: "steady motion, closed by shooting" }[method] ?? "steady motion, integrated";
  $("motion-state").textContent = `${why && `${why}. Shown: `}${how}; ${fmt(result.ms, 3)} ms`;
  $("notes").textContent = result.text.replace(/^=.*\n?/gm, "");
  showCommand();
  for (const draw of [drawOrbit, drawTime, drawContact, drawSpectrum]) draw();
}

function span(columns) {
  const extreme = (pick) => MICRO * pick(...columns.map((column) => column.reduce((a, b) => pick(a, b))));
  return [extreme(Math.min), extreme(Math.max)];
}

// What is drawn as orbits: both bodies, or the rotor as seen from the stator.
function view(q) {
  if (!q || !$("relative").checked) return q;
  const zero = q.x_s.map(() => 0);
  return { ...q, x_r: q.x_r.map((v, k) => v - q.x_s[k]), y_r: q.y_r.map((v, k) => v - q.y_s[k]), x_s: zero, y_s: zero };
}

function drawOrbit() {
  const motion = shown.view = view(shown.motion), steady = view(shown.steady);
  const all = steady ? [motion, steady] : [motion], delta = motion.clearance * MICRO, svg = $("orbit");
  const ends = ["x", "y"].map((axis) => {
    const rotor = span(all.map((q) => q[`${axis}_r`])), stator = span(all.map((q) => q[`${axis}_s`]));
    return [Math.min(rotor[0], stator[0] - delta), Math.max(rotor[1], stator[1] + delta)];
  });
  const half = 0.8 * Math.max(...ends.map(([a, b]) => b - a), 1e-9);
  const range = ends.map(([a, b]) => [(a + b) / 2 - half, (a + b) / 2 + half]);
  const at = frame(svg, range[0], range[1], { x: "x [µm]", y: "y [µm]", most: 5 });
  const orbit = (q, name, body) => path(name, Array.from(q[`x_${body}`], (x, k) =>
    `${at.X(x * MICRO).toFixed(1)} ${at.Y(q[`y_${body}`][k] * MICRO).toFixed(1)}`), q.repeats ? "Z" : "");
  svg.innerHTML = at.axes + (steady ? orbit(steady, "steady", "r") + orbit(steady, "steady", "s") : "") +
    orbit(motion, "x_s", "s") + orbit(motion, "x_r", "r") +
    `<circle class="clearance" r="${at.X(delta) - at.X(0)}"/><circle class="x_s" r="4"/><circle class="x_r" r="4"/>` +
    '<circle class="ball"/>'.repeat(motion.balls);
  svg.setAttribute("aria-label", "Orbits of rotor and stator; half peak-to-peak " + NAMES.map((name) => {
    const [low, high] = span([shown.motion[name]]);
    return `${name} ${fmt((high - low) / 2, 3)} µm`;
  }).join(", "));
  const [circle, stator, rotor, ...balls] = svg.querySelectorAll("circle"), radius = (at.bottom - at.top) / 2 - 13;
  const size = Math.min(11, 0.85 * radius * Math.sin(Math.PI / Math.max(motion.balls, 2)));
  balls.forEach((ball) => ball.setAttribute("r", size));
  motion.moving = { at, circle, stator, rotor, balls, radius };
  motion.deepest = Math.max(1e-12, ...motion.x_r.map((x, k) =>
    Math.hypot(x - motion.x_s[k], motion.y_r[k] - motion.y_s[k]) - motion.clearance));
  move();
}

// The instant of the animation: `turns` of the rotor, from phase 0.
function move() {
  const { view: motion, turns } = shown;
  if (!motion?.moving) return;
  const { at, circle, stator, rotor, balls, radius } = motion.moving, length = motion.rows / motion.perTurn;
  const k = Math.floor(turns * motion.perTurn) % motion.rows;
  const put = (element, x, y) => (element.setAttribute("cx", x.toFixed(1)), element.setAttribute("cy", y.toFixed(1)));
  const [x_s, y_s, x_r, y_r] = NAMES.map((name) => motion[name][k]);
  for (const [element, x, y] of [[circle, x_s, y_s], [stator, x_s, y_s], [rotor, x_r, y_r]])
    put(element, at.X(x * MICRO), at.Y(y * MICRO));
  balls.forEach((ball, j) => {
    const cage = motion.cage * (motion.first + (motion.repeats ? turns : turns % length));
    const angle = 2 * Math.PI * (cage + j / motion.balls);
    const deep = Math.cos(angle) * (x_r - x_s) + Math.sin(angle) * (y_r - y_s) - motion.clearance;
    const load = deep > 0 ? 20 + 80 * Math.min(1, deep / motion.deepest) ** 1.5 : 0;
    put(ball, (at.left + at.right) / 2 + radius * Math.cos(angle), (at.top + at.bottom) / 2 - radius * Math.sin(angle));
    ball.style.fill = `color-mix(in srgb, var(--load) ${load.toFixed(0)}%, var(--idle))`;
  });
  // The contact map has the first two turns.
  for (const [id, where, end] of [["time", turns % length, length], ["contact", turns % Math.max(2, length), 2]]) {
    const cursor = shown.motion[id]?.cursor;
    cursor?.setAttribute("transform", `translate(${shown.motion[id].X(Math.min(where, end))})`);
    cursor?.setAttribute("visibility", where <= end ? "visible" : "hidden");
  }
}

// Draws a panel over the turns, with the cursor that `move` moves.
function fill(id, at, content, label) {
  const svg = $(id);
  svg.innerHTML = at.axes + content + cursor(at);
  svg.setAttribute("aria-label", label);
  shown.motion[id] = { X: at.X, cursor: svg.lastElementChild };
}

function drawTime() {
  const { motion } = shown, [low, high] = span(NAMES.map((name) => motion[name])), pad = 0.05 * (high - low) || 1;
  const at = frame($("time"), [0, motion.rows / motion.perTurn], [low - pad, high + pad], { x: "turns", y: "µm" });
  fill("time", at, NAMES.map((name) => path(name, Array.from({ length: motion.rows + motion.repeats }, (_, k) =>
    `${at.X(k / motion.perTurn).toFixed(1)} ${at.Y(motion[name][k % motion.rows] * MICRO).toFixed(1)}`))).join("") + legend(at),
  `Displacements over the turn, from ${fmt(low)} to ${fmt(high)} µm`);
}

function drawContact() {
  const { loads, balls, perTurn, instants, largest } = shown.motion, levels = 5, runs = Array.from({ length: levels }, () => []);
  const at = frame($("contact"), [0, 2], [0.5, balls + 0.5], { x: "turns", y: "ball" });
  const level = (k, j) => Math.ceil(levels * loads[k * balls + j] / largest) - 1;
  for (let j = 0; j < balls && largest > 0; ++j)
    for (let k = 0, end; k < instants; k = end) {
      for (end = k + 1; end < instants && level(end, j) === level(k, j);) ++end;
      runs[level(k, j)]?.push(`M${at.X(k / perTurn).toFixed(1)} ${at.Y(j + 1).toFixed(1)}H${at.X(end / perTurn).toFixed(1)}`);
    }
  const rows = runs.map((run, k) => run.length === 0 ? "" : `<path class="load" stroke-width="${0.8 * (at.Y(1) - at.Y(2))}"
    opacity="${(k + 1) / levels}" d="${run.join("")}"/>`).join("");
  const label = largest > 0 ? `largest ${fmt(largest, 3)} N` : "no ball touches its race";
  fill("contact", at, rows + at.text(at.right, at.top - 4, "end", label), `Contact map: ${label}`);
}

function drawSpectrum() {
  const lines = shown.motion.lines.filter((line) => line.f > 0 && line.size > 0).sort((a, b) => b.size - a.size);
  const top = lines[0]?.size ?? 1, seen = lines.filter((line) => line.size > 1e-5 * top), taken = [], svg = $("spectrum");
  const at = frame(svg, [0, 1.08 * Math.max(state.f, ...seen.map((line) => line.f))], [1e-5 * top, 2.5 * top],
    { x: "f [Hz]", y: "µm", log: true });
  const label = ({ name, f, size }) => {
    const x = at.X(f), y = at.Y(size) - 5, wide = (innerWidth < 760 ? 11 : 8) * name.length;
    const isTaken = taken.some(([u, v, w]) => Math.abs(u - x) < (w + wide) / 2 && Math.abs(v - y) < 12);
    return !name || isTaken || taken.push([x, y, wide]) > 10 ? "" : at.text(x, y, "middle", escaped(name));
  };
  svg.innerHTML = at.axes + seen.map(({ f, size }) => `<path class="stem" d="M${at.X(f)} ${at.bottom}V${at.Y(size)}"/>`).join("") +
    seen.map(label).join("");
  svg.setAttribute("aria-label", "Spectrum; largest lines " + seen.slice(0, 5).map(({ name, f, size }) =>
    `${name || "unnamed"} ${fmt(f)} Hz ${fmt(size, 3)} µm`).join(", "));
}

function drawCurve() {
  const { branch } = shown, least = 1e-12, sizes = branch.flatMap((point) => point.slice(1)).filter((v) => v > least);
  const [low, high] = span([sizes.length ? sizes : [1e-7, 1e-4]]), range = [low / 1.5, high * 1.5];
  const at = shown.scale = frame($("curve"), [state.from, state.to], range, { x: "f [Hz]", y: "µm", log: true });
  const curve = (name, i) => path(name, branch.filter((point) => point[i + 1] > least).map((point) =>
    `${at.X(point[0]).toFixed(1)} ${at.Y(point[i + 1] * MICRO).toFixed(1)}`));
  const isFold = (point, k) => k > 0 && k < branch.length - 1 && point[3] > least &&
    (point[0] - branch[k - 1][0]) * (branch[k + 1][0] - point[0]) < 0;
  $("curve").innerHTML = at.axes + NAMES.map(curve).join("") + legend(at) + branch.filter(isFold).map((point) =>
    `<circle class="fold" r="3.5" cx="${at.X(point[0])}" cy="${at.Y(point[3] * MICRO)}"/>`).join("") +
    `<g id="speed"><path class="speed" d="M0 ${at.top}V${at.bottom}"/><circle class="grip" r="6" cy="${at.bottom}"/></g>`;
  drawSpeed();
}

function drawSpeed() {
  if (!shown.scale) return;
  $("speed").setAttribute("transform", `translate(${shown.scale.X(clamp(state.f, state.from, state.to))})`);
  for (const [name, value] of [["now", state.f], ["min", state.from], ["max", state.to], ["text", `${fmt(state.f)} Hz`]])
    $("curve").setAttribute(`aria-value${name}`, value);
}

/* Machines in, results out. */

const stem = () => state.name.replace(/\.toml$/, "");

function showMachine({ name, path: place = name, toml, start = {} }) {
  Object.assign(state, { name, path: place, toml, original: toml }, start);
  for (const id of ["f", "m"]) markRow($(id).parentElement, "");
  buildControls();
  showSpeed();
  drawCurve();
  update();
}

async function loadFile(file) {
  const toml = await file.text(), { status, text } = await engines.quick.ask({ ...question("orbit"), file: file.name, toml });
  if (status === 2) return alertOf(text);
  $("preset").value = "";
  showMachine({ name: file.name, toml });
}

function save(name, text, type) {
  const href = URL.createObjectURL(new Blob([text], { type }));
  Object.assign(document.createElement("a"), { href, download: name }).click();
  setTimeout(URL.revokeObjectURL, 1000, href);
}

async function saveTable() {
  const { status, text } = await engines.quick.ask({ ...question("table"), m: shown.motion?.isSteady ? 0 : state.m });
  if (status === 0) save(`${stem()}-orbit.tsv`, text, "text/tab-separated-values");
  else if (status > 0) alertOf(text);
}

// All panels in one SVG, with the colours of the page as it is.
function pictureText() {
  const colours = getComputedStyle(document.documentElement);
  const used = new Set(`${DRAWING_STYLE} --ground --idle`.match(/--\w+/g));
  const values = Array.from(used, (name) => `${name}: ${colours.getPropertyValue(name)};`);
  const places = { orbit: [0, 20], curve: [430, 20], time: [430, 290], contact: [0, 500], spectrum: [430, 560] };
  const panels = Object.entries(places).map(([id, [x, y]]) => {
    const { width, height } = $(id).viewBox.baseVal, content = new XMLSerializer().serializeToString($(id));
    return `<svg class="${$(id).getAttribute("class") ?? ""}" x="${x}" y="${y}" width="${x ? width : 420}" height="${height}"
      viewBox="0 0 ${width} ${height}">${content.replace(/^<svg[^>]*>|<\/svg>$/g, "")}</svg>`;
  });
  const title = `${stem()}, ${fmt(state.f)} Hz, m = ${state.m}; ${$("verdict").className}`;
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 950 830"><style>svg { ${values.join("")} } ${DRAWING_STYLE}</style>
    <rect width="950" height="830" fill="var(--ground)"/><text x="6" y="14">${escaped(title)}</text>${panels.join("")}</svg>`;
}

function makeLink() {
  const { f, m, from, to, name, toml } = state;
  history.replaceState(null, "", `#${new URLSearchParams({ f, m, from, to, name, toml })}`);
  $("link").value = location.href;
  $("link").select();
}

// The machine of the address; false where it names none.
function openLink() {
  const given = Object.fromEntries(new URLSearchParams(location.hash.slice(1)));
  if (!given.toml) return false;
  const number = (key, low, high) => clamp(Number(given[key]) || state[key], low, high);
  const start = { f: number("f", ...LIMITS.f), m: Math.round(number("m", ...LIMITS.m)),
    from: number("from", 0.1, 900), to: number("to", 0.2, 1000) };
  start.to = Math.max(start.to, start.from + 1);
  const name = (given.name || "machine.toml").replace(/[^\w.-]/g, "_");
  const known = PRESETS.find(({ toml }) => toml === given.toml);
  $("preset").value = known?.path ?? "";
  showMachine({ name, path: known?.path ?? name, toml: given.toml, start });
  return true;
}

function showCommand() {
  const isChanged = state.toml !== state.original, periods = shown.motion?.periods ?? 1;
  const how = (shown.motion?.isSteady ? "" : ` --harmonics ${state.m}`) + (periods > 1 ? ` --periods ${periods}` : "");
  $("command").textContent = `build/explore orbit ${isChanged ? state.name : state.path} --frequency ${state.f}${how}`;
  $("command-note").hidden = !isChanged;
}

/* What the reader does. */

function setRange() {
  const from = Number($("from").value), to = Number($("to").value), good = from >= 0.1 && to > from && to <= 1000;
  for (const id of ["from", "to"]) $(id).setAttribute("aria-invalid", !good);
  alertOf(good ? "" : "The range of the response must have 0.1 ≤ from < to ≤ 1000 Hz.");
  if (!good) return;
  Object.assign(state, { from, to });
  showSpeed();
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
  const by = { ArrowLeft: -step, ArrowDown: -step, ArrowRight: step, ArrowUp: step, PageUp: 5, PageDown: -5, Home: -1e3, End: 1e3 };
  if (!by[event.key]) return;
  event.preventDefault();
  setSpeed(state.f + by[event.key]);
}

function play(on) {
  shown.playing = on;
  $("play").textContent = on ? "Pause" : "Play";
}

let last = 0;
function animate(now) {
  if (shown.playing) shown.turns += Math.min(0.1, (now - last) / 1000) * ($("slow").checked ? 0.06 : 0.3);
  last = now;
  if (shown.playing) move();
  requestAnimationFrame(animate);
}

function connect() {
  const openPreset = () => showMachine(PRESETS.find(({ path: place }) => place === $("preset").value));
  const clicks = { cancel: () => engines.quick.cancel(), "curve-cancel": () => engines.curve.cancel(), play: () => play(!shown.playing),
    relative: () => shown.motion && drawOrbit(), "reset-all": () => showMachine({ ...state, toml: state.original }),
    "save-toml": () => save(state.name, state.toml, "application/toml"), "save-tsv": saveTable,
    "save-svg": () => save(`${stem()}.svg`, pictureText(), "image/svg+xml"), "make-link": makeLink,
    "help-open": () => $("help").showModal() };
  for (const [id, task] of Object.entries(clicks)) $(id).onclick = () => task();
  $("preset").innerHTML = '<option value="" hidden>own machine</option>' +
    PRESETS.map(({ path: place, title }) => `<option value="${place}">${escaped(title)}</option>`).join("");
  $("preset").onchange = openPreset;
  $("file").onchange = ({ target }) => loadFile(target.files[0]).finally(() => (target.value = ""));
  for (const id of ["f", "m"]) for (const input of [$(id), $(`${id}-slide`)]) input.oninput = () => takeNumber(id, input.value);
  for (const id of ["from", "to"]) $(id).onchange = setRange;
  $("curve").onpointerdown = (event) => ($("curve").setPointerCapture(event.pointerId), dragSpeed(event));
  $("curve").onpointermove = (event) => event.buttons && dragSpeed(event);
  $("curve").onkeydown = keyOnCurve;
  document.onkeydown = (event) => {
    if (event.target.closest("input, select, button, summary, svg, dialog")) return;
    if (event.key === "?") $("help").showModal();
    if (event.key === " ") event.preventDefault(), play(!shown.playing);
  };
  window.onhashchange = openLink;
  document.head.insertAdjacentHTML("beforeend", `<style>${DRAWING_STYLE}</style>`);
  play(!matchMedia("(prefers-reduced-motion: reduce)").matches);
  $("preset").value = PRESETS[0].path;
  if (!openLink()) openPreset();
  requestAnimationFrame(animate);
}

connect();
