// Models of the guide run in its pages: a key below one opens a live page of it there, a link opens the same beside.
"use strict";
for (const code of document.querySelectorAll("pre > code.language-ron")) {
  const file = [...code.classList].find((name) => name.startsWith("file="))?.slice(5), text = code.textContent;
  // A study or a part of a model is none.
  if (!file || !/^ {4}cases\s*:/m.test(text)) continue;
  const title = /^ {4}title\s*:\s*"([^"]*)"/m.exec(text)?.[1] ?? file;
  const address = `run.html#${encodeURIComponent(JSON.stringify({ title, path: file, text }))}`;
  const key = Object.assign(document.createElement("button"), { type: "button", textContent: "Run it here" });
  const link = Object.assign(document.createElement("a"), { href: address, target: "_blank", rel: "noopener", textContent: "in a window of its own" });
  const row = Object.assign(document.createElement("p"), { className: "runs" });
  row.append(key, " ", link);
  let page = null;
  key.setAttribute("aria-expanded", "false");
  key.addEventListener("click", () => {
    if (page) { page.remove(); page = null; } else {
      page = Object.assign(document.createElement("iframe"), { className: "runs", title: `${file}, running`, src: address });
      row.after(page);
    }
    key.textContent = page ? "Close" : "Run it here";
    key.setAttribute("aria-expanded", String(Boolean(page)));
  });
  code.parentElement.after(row);
}
