// Long tables: only the rows whose first cell has a text in it.

for (const box of document.querySelectorAll("[data-filter]")) {
  const section = box.closest("section");
  box.addEventListener("input", () => {
    const wanted = box.value.trim().toLowerCase();
    for (const fold of section.querySelectorAll("details")) fold.open = wanted !== "";
    for (const row of section.querySelectorAll("tbody tr")) {
      row.hidden = !row.cells[0].textContent.toLowerCase().includes(wanted);
    }
  });
}
