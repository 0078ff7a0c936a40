// Questions to the engine. One goes at a time; of those that wait, the last one of its kind counts.
"use strict";
const data = JSON.parse(document.getElementById("model").textContent);

const engine = (() => {
  const source = URL.createObjectURL(new Blob([data.worker], { type: "text/javascript" }));
  let worker, module, busy = null, waiting = [], count = 0;
  const packed = () => Uint8Array.from(atob(document.getElementById("engine").textContent), (c) => c.charCodeAt(0));

  const next = () => {
    if (busy || !waiting.length) return;
    busy = { ...waiting.shift(), id: ++count, since: performance.now() };
    worker.postMessage({ id: busy.id, start: busy.start, question: busy.question });
  };
  const ask = (kind, question, done) => {
    waiting = waiting.filter((w) => w.kind !== kind);
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
  return { ask, stop, files: () => ask("files", files().question), goes: () => busy && { kind: busy.kind, ms: performance.now() - busy.since } };
})();
