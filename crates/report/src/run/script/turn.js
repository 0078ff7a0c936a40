// How a reader moves about the model: drag turns it, Shift or two fingers move it, wheel or pinch bring it closer; with keys,
// Shift and arrows turn, Ctrl and arrows move.

function turn(stage, tip) {
  const { canvas } = stage, pointers = new Map();
  let spread = null;
  const at = (e) => {
    const r = canvas.getBoundingClientRect();
    return [e.clientX - r.left, e.clientY - r.top];
  };
  const pinch = () => {
    const [a, b] = [...pointers.values()];
    return { size: Math.max(Math.hypot(a[0] - b[0], a[1] - b[1]), 20), middle: [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2] };
  };
  const shift = (dx, dy) => { stage.shift = [stage.shift[0] + dx, stage.shift[1] + dy]; };
  /** Closer by a factor about a pixel. */
  const closer = (factor, [px, py]) => {
    const next = Math.min(Math.max(stage.near * factor, 0.2), 200), by = next / stage.near;
    const about = [px - canvas.clientWidth / 2, py - stage.height / 2];
    stage.shift = stage.shift.map((s, i) => about[i] - by * (about[i] - s));
    stage.near = next;
    stage.draw();
  };
  const reset = () => stage.look(stage.view);
  const around = (right, up) => {
    stage.azimuth -= right;
    stage.elevation = Math.min(Math.max(stage.elevation + up, -1.57), 1.57);
    stage.draw();
  };
  canvas.addEventListener("pointerdown", (e) => {
    pointers.set(e.pointerId, at(e));
    if (pointers.size === 2) spread = pinch();
    if (e.pointerType === "mouse") canvas.setPointerCapture(e.pointerId);
  });
  canvas.addEventListener("pointermove", (e) => {
    const p = at(e), last = pointers.get(e.pointerId);
    if (!last) { say(p); return; }
    pointers.set(e.pointerId, p);
    const [dx, dy] = [p[0] - last[0], p[1] - last[1]];
    if (pointers.size === 2 && spread) {
      const now = pinch();
      shift(now.middle[0] - spread.middle[0], now.middle[1] - spread.middle[1]);
      closer(now.size / spread.size, now.middle);
      spread = now;
    } else if (e.shiftKey || e.buttons === 2 || e.buttons === 4 || stage.view !== "space") {
      shift(dx, dy);
      stage.draw();
    } else {
      around(dx / 150, dy / 150);
    }
    tip.hidden = true;
  });
  for (const end of ["pointerup", "pointercancel"]) {
    canvas.addEventListener(end, (e) => { pointers.delete(e.pointerId); spread = null; });
  }
  const say = (p) => {
    tip.textContent = stage.nearest(p);
    tip.hidden = !tip.textContent;
    tip.style.left = `${Math.max(Math.min(p[0] + 14, canvas.clientWidth - tip.offsetWidth), 0)}px`;
    tip.style.top = `${p[1] + 10}px`;
  };
  canvas.addEventListener("pointerleave", () => { tip.hidden = true; });
  canvas.addEventListener("contextmenu", (e) => e.preventDefault());
  canvas.addEventListener("dblclick", reset);
  canvas.addEventListener("wheel", (e) => {
    if (!e.ctrlKey && !e.metaKey && document.activeElement !== canvas) return;
    e.preventDefault();
    closer(Math.exp(-e.deltaY / 300), at(e));
  }, { passive: false });
  canvas.addEventListener("keydown", (e) => {
    const middle = [canvas.clientWidth / 2, stage.height / 2];
    const [dx, dy] = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[e.key] ?? [0, 0];
    if ((dx || dy) && (e.shiftKey || (dy && !e.ctrlKey))) {
      if (stage.view === "space") around(0.1 * dx, 0.1 * dy);
      e.preventDefault();
    } else if ((dx || dy) && e.ctrlKey) {
      shift(30 * dx, 30 * dy);
      stage.draw();
      e.preventDefault();
    }
    const keys = { "+": () => closer(1.25, middle), "-": () => closer(0.8, middle), 0: reset };
    if (e.key in keys) { keys[e.key](); e.preventDefault(); }
  });
}

/** What is looked for, hidden, and saved; films: a button that saves a video, where there is one. */
function finder(stage, box, films) {
  const search = make("input", { type: "search", "aria-label": "find a name", placeholder: "find a name" });
  const found = make("output", {});
  search.addEventListener("input", () => {
    const n = stage.search(search.value);
    found.textContent = search.value.trim() ? `${n} found` : "";
  });
  const key = (what, words) => {
    const button = make("button", { type: "button", "aria-pressed": "true", title: "show or hide" }, words);
    button.addEventListener("click", () => button.setAttribute("aria-pressed", String(stage.toggle(what))));
    return button;
  };
  const kinds = [...KINDS].map(([kind, count]) => key(kind, `${kind} × ${count}`));
  const groups = GROUPS.map((group) => key(group, `${group.name} (group)`));
  const save = make("button", { type: "button" }, "save picture");
  save.addEventListener("click", () => make("a", { href: stage.canvas.toDataURL(), download: "model.png" }).click());
  box.append(make("span", {}, search, " ", found), make("span", { class: "legend" }, ...kinds, ...groups), save, ...(films ? [films] : []));
}
