// Questions to the engine. One goes at a time; of those that wait, the last one of its kind counts.
"use strict";
const data = JSON.parse(document.getElementById("model").textContent);
// A page for any model is told which by its address.
if (data.any) {
  try {
    const { title, path, text } = JSON.parse(decodeURIComponent(location.hash.slice(1)));
    Object.assign(data, { path: String(path), text: String(text) });
    document.title = document.getElementById("title").textContent = String(title);
  } catch {
    document.getElementById("title").textContent = "The address of this page names no model";
  }
}

const engine = (() => {
  const source = URL.createObjectURL(new Blob([data.worker], { type: "text/javascript" }));
  let worker, module, busy = null, waiting = [], count = 0;
  // Four bytes stand in five digits of 85; the last ones in one digit more than they are.
  const packed = () => {
    const text = document.getElementById("engine").textContent, value = new Uint8Array(128);
    [...data.digits].forEach((c, i) => { value[c.charCodeAt(0)] = i; });
    const out = new Uint8Array(Math.floor((text.length * 4) / 5));
    for (let i = 0, at = 0; i < text.length; i += 5) {
      let word = 0;
      for (let k = i; k < i + 5; k++) word = 85 * word + (k < text.length ? value[text.charCodeAt(k)] : 84);
      for (let power = 24; power >= 0 && at < out.length; power -= 8) out[at++] = (word / 2 ** power) & 255;
    }
    return out;
  };

  const next = () => {
    if (busy || !waiting.length) return;
    busy = { ...waiting.shift(), id: ++count, since: performance.now() };
    worker.postMessage({ id: busy.id, start: busy.start, question: busy.question });
  };
  /** Forgets what waits of such kinds. */
  const drop = (...kinds) => { waiting = waiting.filter((w) => !kinds.includes(w.kind)); };
  const ask = (kind, question, done) => {
    drop(kind);
    waiting.push({ kind, question, done });
    next();
  };
  const files = () => ({ kind: "files", question: { ask: "files", files: data.files } });
  const start = () => {
    worker = new Worker(source);
    worker.onmessage = ({ data: { id, answer } }) => {
      if (!busy || busy.id !== id) return;
      const { done } = busy;
      busy = null;
      if (answer.module) module = answer.module;
      if (answer.ended) stop();
      done?.(answer);
      next();
    };
    const begun = (answer) => { if (answer.told) tell(answer.told); };
    waiting.unshift({ kind: "start", start: module ?? packed(), done: begun }, files());
    next();
  };
  // Ends what goes on and begins anew: a run that nobody waits for any more, or an engine that has ended.
  const stop = () => {
    worker.terminate();
    busy = null;
    start();
  };
  start();
  return { ask, drop, stop, files: () => ask("files", files().question), goes: () => busy && { kind: busy.kind, ms: performance.now() - busy.since } };
})();
