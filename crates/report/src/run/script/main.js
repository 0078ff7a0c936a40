// Puts the live figures in the place of the still ones.

root.classList.add("js");
const canvas = document.getElementById("stage");
if (canvas) player(canvas, document.getElementById("player"), canvas.parentElement.querySelector(".tip"));
for (const host of document.querySelectorAll("[data-plot]")) {
  const [what, ...which] = host.dataset.plot.split(" ");
  plots[what](host, ...which);
}
for (const shape of document.querySelectorAll("canvas[data-mode]")) mode(shape);
root.dataset.ready = "true";
