// The engine in a thread of its own: it takes questions one by one and sends the answers back.
"use strict";
let engine;

const compiled = async (packed) => {
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  return WebAssembly.compile(await new Response(stream).arrayBuffer());
};

const start = async (from) => {
  const module = from instanceof WebAssembly.Module ? from : await compiled(from);
  // What libraries of it would ask a page for, and never do.
  const none = () => { throw new Error("the engine asks for what a page has not"); };
  const imports = {};
  for (const { module: from, name } of WebAssembly.Module.imports(module)) (imports[from] ??= {})[name] = none;
  engine = (await WebAssembly.instantiate(module, imports)).exports;
  return { module };
};

const text = () => new TextDecoder().decode(new Uint8Array(engine.memory.buffer, engine.answer_at(), engine.answer_bytes()));

const ask = (question) => {
  const bytes = new TextEncoder().encode(JSON.stringify(question));
  const at = engine.room(bytes.length);
  new Uint8Array(engine.memory.buffer, at, bytes.length).set(bytes);
  try {
    engine.ask();
  } catch (trap) {
    // What it said before it ended; it cannot be asked again.
    return { told: `the engine has ended: ${text() || trap}`, ended: true };
  }
  return JSON.parse(text());
};

onmessage = async ({ data: { id, start: from, question } }) => {
  try {
    const begin = performance.now();
    const answer = from ? await start(from) : ask(question);
    postMessage({ id, answer: { ...answer, ms: performance.now() - begin } });
  } catch (error) {
    postMessage({ id, answer: { told: `the engine does not start: ${error}`, ended: true } });
  }
};
