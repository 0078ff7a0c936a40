// The model in the place of its still pictures.

const canvas = document.getElementById("stage");
if (canvas) player(canvas, document.getElementById("player"), canvas.parentElement.querySelector(".tip"));
for (const shape of document.querySelectorAll("canvas[data-mode]")) mode(shape);
