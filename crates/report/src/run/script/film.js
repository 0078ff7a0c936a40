// The motion as a video: what the canvas shows while the model moves from its beginning to its end.

/** What a browser may write, what most programs open first. */
const FILMS = ["video/mp4;codecs=avc1.640028", "video/webm;codecs=vp9", "video/webm"];

/** A button that saves a video, whether one is being made, and its end; null where the browser writes none.
 *  begin() plays from the beginning, end() pauses. */
function film(canvas, begin, end) {
  const kind = window.MediaRecorder && canvas.captureStream && FILMS.find((one) => MediaRecorder.isTypeSupported(one));
  if (!kind) return null;
  const button = make("button", { type: "button", title: "from the beginning to the end, at the chosen speed" }, "save video");
  let recorder = null;
  const over = () => {
    end();
    if (recorder.state !== "inactive") recorder.stop();
    recorder = null;
    button.textContent = "save video";
  };
  button.addEventListener("click", () => {
    if (recorder) { over(); return; }
    const parts = [];
    recorder = new MediaRecorder(canvas.captureStream(30), { mimeType: kind, videoBitsPerSecond: 8e6 });
    recorder.addEventListener("dataavailable", ({ data }) => parts.push(data));
    recorder.addEventListener("stop", () => {
      const href = URL.createObjectURL(new Blob(parts, { type: kind }));
      make("a", { href, download: `model.${kind.startsWith("video/mp4") ? "mp4" : "webm"}` }).click();
      setTimeout(() => URL.revokeObjectURL(href), 60000);
    });
    // What cannot go on, after the canvas has become another size for instance, is saved as far as it came.
    recorder.addEventListener("error", () => { if (recorder) over(); });
    button.textContent = "stop and save";
    recorder.start();
    begin();
  });
  return { button, over, goes: () => Boolean(recorder) };
}
