// The page of a run, beside the controls. A new one is written out of sight, takes over where the reader was, and comes
// forward; the old one goes with all that its scripts hold.
"use strict";
const frames = (() => {
  const holder = document.getElementById("results");
  const make = () => {
    const frame = document.createElement("iframe");
    frame.title = "Results";
    holder.append(frame);
    return frame;
  };
  let front = null;

  // Where the reader is: how far down, at which time of the motion, which parts are open.
  const place = (of) => ({
    y: of.scrollingElement?.scrollTop ?? 0,
    sliders: [...of.querySelectorAll("input[type=range]")].map((s) => s.value),
    open: [...of.querySelectorAll("details")].map((d) => d.open),
  });
  const go = (of, { y, sliders, open }) => {
    const details = [...of.querySelectorAll("details")];
    if (details.length === open.length) details.forEach((d, i) => { d.open = open[i]; });
    const all = [...of.querySelectorAll("input[type=range]")];
    if (all.length === sliders.length) all.forEach((s, i) => {
      if (s.value === sliders[i]) return;
      s.value = sliders[i];
      s.dispatchEvent(new Event("input", { bubbles: true }));
    });
    if (of.scrollingElement) of.scrollingElement.scrollTop = y;
  };
  const show = (html) => {
    const was = front && place(front.contentDocument);
    const next = make();
    const of = next.contentDocument;
    of.open();
    of.write(html);
    of.close();
    if (was) go(of, was);
    next.className = "front";
    front?.remove();
    front = next;
    if (was) go(of, was);
  };
  /** Another run, or some sections of one, in the page that is there; false where there is none, or its parts are others. */
  const renew = (html) => Boolean(front?.contentWindow.renew?.(html));
  /** Sections of the page that are on the screen. */
  const seen = () => front?.contentWindow.onScreen?.() ?? [];
  return { show, renew, seen, there: () => Boolean(front) };
})();
