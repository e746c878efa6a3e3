// Moves the picture of animation.py: speeds, play and pause, a slider for the instant. It starts by itself unless the reader
// asks for less motion.
(() => {
  const part = (name) => document.getElementById(name), balls = [...document.querySelectorAll("#motion .ball")];
  part("controls").innerHTML = `<label>speed <select id="speed">${FACTS.motions.map((motion, k) =>
    `<option value="${k}"${k === FACTS.first ? " selected" : ""}>${motion.f} Hz</option>`).join("")}</select></label>
    <button id="play" type="button">Play</button>
    <label>turns <input id="instant" type="range" min="0" max="${2 * FACTS.frames - 1}" value="0"></label> <output id="now" style="display: block; min-height: 3.2em"></output>`;
  let motion, span, load, timer;
  const place = (name, x, y) => { part(name).setAttribute("cx", x); part(name).setAttribute("cy", y); };
  function show() {
    const k = +part("instant").value, [xr, yr, xs, ys] = motion.q[k], middle = FACTS.size / 2, scale = FACTS.gap / FACTS.delta;
    place("rotor", middle + scale * (xr - xs), middle - scale * (yr - ys));
    balls.forEach((ball, j) => {
      const angle = 2 * Math.PI * (FACTS.cage * k / FACTS.frames + j / balls.length), r = FACTS.outer - FACTS.ball, Q = motion.Q[k][j];
      ball.setAttribute("cx", middle + r * Math.cos(angle));
      ball.setAttribute("cy", middle - r * Math.sin(angle));
      ball.setAttribute("fill", Q > 0 ? FACTS.colours[Math.min(4, Math.floor(5 * Q / load))] : "#fff");
    });
    place("dot_r", 540 + xr / span, middle - yr / span);
    place("dot_s", 540 + xs / span, middle - ys / span);
    part("now").value = `t/T = ${(k / FACTS.frames).toFixed(2)}, largest load ${Math.max(...motion.Q[k]).toFixed(0)} N, orbits within ${(140 * span).toFixed(0)} µm, ${motion.by}`;
  }
  function choose() {
    motion = FACTS.motions[part("speed").value];
    span = Math.max(...motion.q.flat().map(Math.abs)) / 140;
    load = Math.max(...motion.Q.flat());
    ["r", "s"].forEach((body, i) => part("orbit_" + body).setAttribute("points",
      motion.q.map((q) => `${540 + q[2 * i] / span},${FACTS.size / 2 - q[2 * i + 1] / span}`).join(" ")));
    show();
  }
  function play(on) {
    clearInterval(timer);
    timer = on ? setInterval(() => { part("instant").value = (+part("instant").value + 1) % (2 * FACTS.frames); show(); }, 60) : 0;
    part("play").textContent = on ? "Pause" : "Play";
  }
  part("speed").onchange = choose;
  part("instant").oninput = () => { play(false); show(); };
  part("play").onclick = () => play(!timer);
  choose();
  play(!matchMedia("(prefers-reduced-motion: reduce)").matches);
})();
