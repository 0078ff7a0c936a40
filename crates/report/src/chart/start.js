// Puts the charts in the place of the still figures, and the switches of shared scales.

for (const script of document.querySelectorAll("script.drawing")) {
  new Chart(script.parentElement, JSON.parse(script.textContent));
}
for (const box of document.querySelectorAll("input[data-scales]")) {
  const all = () => [...scales.entries()].filter(([name]) => name.startsWith(box.dataset.scales));
  box.closest("label").hidden = !all().some(([, s]) => s.charts.size > 1);
  box.addEventListener("change", () => {
    for (const [, s] of all()) {
      s.on = box.checked;
      for (const chart of s.charts) chart.dirty();
    }
  });
}
root.dataset.ready = "true";
