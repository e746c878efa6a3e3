// One worker: the library, and the questions that it is asked one after the other.
// createCore, which em++ has written, stands before this text.
let points = [], current = 0;

function send(message) {
  postMessage({ id: current, ...message });
}

function flush() {
  if (points.length) send({ points });
  points = [];
}

function start(module) {
  return createCore({
    instantiateWasm(imports, done) {
      WebAssembly.instantiate(module, imports).then((instance) => done(instance, module));
      return {};
    },
    print() {},
    printErr() {},
    onPoint(point) {
      points.push(point);
      if (points.length >= 10) flush();
    },
  });
}

let core;
onmessage = async ({ data }) => {
  if (data.module) {
    core = start(data.module);
    return;
  }
  const { id, what, file, toml, f, m, from, to } = data;
  const live = await core;
  current = id;
  try {
    const begin = performance.now();
    const status = live.ccall("live_run", "number",
      ["string", "string", "string", "number", "number", "number", "number"], [what, file, toml, f, m, from, to]);
    const text = live.UTF8ToString(live._live_text());
    const at = live._live_numbers() >> 3;
    const numbers = live.HEAPF64.slice(at, at + live._live_count());
    flush();
    send({ status, text, numbers, ms: performance.now() - begin, memory: live.HEAPF64.byteLength });
  } catch (error) {
    send({ crash: String(error.message || error).slice(0, 200) });
  }
};
