// One worker: the library, and the questions that it is asked one after the other.
// createCore, which em++ has written, stands before this text.
let core, id, points = [];

function flush() {
  if (points.length) postMessage({ id, points });
  points = [];
}

const start = (module) => createCore({
  instantiateWasm(imports, done) {
    WebAssembly.instantiate(module, imports).then((instance) => done(instance, module));
    return {};
  },
  print() {}, printErr() {},
  onPoint(point) {
    if (points.push(point) >= 10) flush();
  },
});

onmessage = async ({ data }) => {
  if (data.module) return core = start(data.module);
  const live = await core, { what, file, toml, f, m, from, to } = data;
  id = data.id;
  try {
    const begin = performance.now();
    const status = live.ccall("live_run", "number",
      ["string", "string", "string", "number", "number", "number", "number"], [what, file, toml, f, m, from, to]);
    const at = live._live_numbers() >> 3, numbers = live.HEAPF64.slice(at, at + live._live_count());
    const text = live.UTF8ToString(live._live_text());
    flush();
    postMessage({ id, status, text, numbers, ms: performance.now() - begin, memory: live.HEAPF64.byteLength });
  } catch (error) {
    postMessage({ id, crash: String(error.message || error).slice(0, 200) });
  }
};
