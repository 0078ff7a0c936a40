// Parameters as fields and sliders, cases, solvers, the text of the files, and what is said of them.
"use strict";
const by = (id) => document.getElementById(id);
const state = { path: data.path, text: data.text, set: { ...data.set }, case: data.case, solver: data.solver };

const tell = (told) => {
  by("told").textContent = told ?? "";
  by("told").hidden = !told;
};
const say = (words) => { by("state").textContent = words; };

const quoted = (word) => (/^[\w.,=:/+-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`);
const command = () => {
  const parts = ["trilith", "run", quoted(state.path)];
  for (const [name, value] of Object.entries(state.set)) parts.push("--set", quoted(`${name}=${value}`));
  if (state.case) parts.push("--case", quoted(state.case));
  if (state.solver) parts.push("--solver", quoted(state.solver));
  by("command").textContent = parts.join(" ") + (state.text === data.text ? "" : "   # with the text as it is here");
};

// A value between a fifth of the file's and five times it, by powers: x = x0 5^s.
const RANGE = 5;
const number = /^\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(.*)$/;
const split = (text) => {
  const found = number.exec(text ?? "");
  return found ? { x: Number(found[1]), unit: found[2].trim() } : null;
};
const short = (x) => String(Number(x.toPrecision(3)));

const field = (parameter) => {
  const own = split(parameter.text);
  const row = document.createElement("label");
  const name = document.createElement("span");
  name.textContent = parameter.name;
  const input = document.createElement("input");
  input.value = state.set[parameter.name] ?? parameter.text;
  row.append(name);
  const take = (text) => {
    if (text.trim() === parameter.text) delete state.set[parameter.name];
    else state.set[parameter.name] = text.trim();
    row.classList.toggle("changed", parameter.name in state.set);
    changed();
  };
  row.classList.toggle("changed", parameter.name in state.set);
  let slider;
  // What is computed from others, a text or zero has no range.
  if (own && own.x !== 0 && parameter.value !== null && /^[^a-z]*$|^[\w*/^ %°·-]+$/i.test(own.unit)) {
    slider = document.createElement("input");
    Object.assign(slider, { type: "range", min: -1, max: 1, step: 0.01 });
    slider.setAttribute("aria-label", `${parameter.name}, slider`);
    const at = (text) => {
      const now = split(text);
      return now && now.unit === own.unit && now.x / own.x > 0 ? Math.log(now.x / own.x) / Math.log(RANGE) : 0;
    };
    slider.value = at(input.value);
    slider.addEventListener("input", () => {
      const s = Number(slider.value);
      input.value = s === 0 ? parameter.text : `${short(own.x * RANGE ** s)} ${own.unit}`.trim();
      take(input.value);
    });
    input.addEventListener("input", () => { slider.value = at(input.value); });
    row.append(slider);
  }
  row.append(input);
  input.addEventListener("input", () => take(input.value));
  return row;
};

const options = (id, names, chosen, first) => {
  const all = first === undefined ? names : ["", ...names];
  by(id).replaceChildren(...all.map((name) => {
    const option = document.createElement("option");
    option.value = name;
    option.textContent = name || first;
    option.selected = name === (chosen ?? "");
    return option;
  }));
};

// What the model is made of, from its text.
const looked = (answer) => {
  if (answer.told) return tell(answer.told);
  const names = answer.parameters.map((p) => p.name);
  for (const name of Object.keys(state.set)) if (!names.includes(name)) delete state.set[name];
  const last = answer.cases.at(-1);
  if (!answer.cases.includes(state.case)) state.case = null;
  options("case", answer.cases, state.case ?? last);
  by("version").textContent = `trilith ${answer.version}, as WebAssembly`;
  options("solver", answer.solvers, state.solver, "as the file says");
  const values = by("values");
  // The field that is being written in stays.
  const active = values.contains(document.activeElement);
  const same = values.dataset.of === JSON.stringify(answer.parameters);
  if (!same && !active) {
    values.dataset.of = JSON.stringify(answer.parameters);
    state.parameters = answer.parameters;
    values.replaceChildren(...answer.parameters.map(field));
    if (!names.length) values.textContent = "The model has no parameters: edit its file.";
  }
  return undefined;
};

// What a chart's cursor asks for.
const settle = ({ set }) => {
  state.set = set;
  if (state.parameters) by("values").replaceChildren(...state.parameters.map(field));
};

// Peaks, beside those of the file as it was.
const peaks = (all) => {
  by("peaks").classList.toggle("alone", Boolean(by("charts")));
  const plain = !Object.keys(state.set).length && state.text === data.text && (state.case ?? null) === (data.case ?? null) && state.solver === data.solver;
  if (plain) state.first = Object.fromEntries(all.map((p) => [p.name, p.value]));
  by("peaks").hidden = !all.length;
  by("peaks").tBodies[0].replaceChildren(...all.map(({ name, unit, value }) => {
    const row = document.createElement("tr");
    const first = state.first?.[name];
    const change = first ? 100 * (Math.abs(value / first) - 1) : NaN;
    const cells = [name, `${Number(value.toPrecision(4))} ${unit}`.trim(),
      Number.isFinite(change) && !plain ? `${change > 0 ? "+" : ""}${change.toFixed(Math.abs(change) < 10 ? 1 : 0)} %` : ""];
    row.append(...cells.map((text) => Object.assign(document.createElement("td"), { textContent: text })));
    row.dataset.value = value;
    return row;
  }));
};
