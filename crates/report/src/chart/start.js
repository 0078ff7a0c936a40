// Puts the charts in the place of the still figures, and the switches of shared scales.

/** What is wider than its place is scrolled with keys as well. */
const wide = new ResizeObserver((all) => {
  for (const { target: e } of all) {
    if (e.scrollWidth <= e.clientWidth + 1) { for (const name of ["tabindex", "role", "aria-label"]) e.removeAttribute(name); continue; }
    const head = e.closest("section")?.querySelector("h2")?.textContent ?? document.title;
    for (const [name, value] of [["tabindex", "0"], ["role", "group"], ["aria-label", `${head}, scrolls sideways`]]) e.setAttribute(name, value);
  }
});

/** A page, or a part that comes later. */
function begin(part) {
  for (const script of part.querySelectorAll("script.drawing")) new Chart(script.parentElement, JSON.parse(script.textContent));
  for (const box of part.querySelectorAll("input[data-scales]")) {
    const all = () => [...scales.entries()].filter(([name]) => name.startsWith(box.dataset.scales));
    box.closest("label").hidden = !all().some(([, s]) => s.charts.size > 1);
    box.addEventListener("change", () => {
      for (const [, s] of all()) {
        s.on = box.checked;
        for (const chart of s.charts) chart.dirty();
      }
    });
  }
  for (const e of part.querySelectorAll(".wide, pre")) wide.observe(e);
}

begin(document);
root.dataset.ready = "true";
