// A headless Chromium that speaks its protocol over two pipes: messages of JSON, each ended by a zero.
import { spawn } from "node:child_process";
import { accessSync, constants, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

export const pause = (ms) => new Promise((done) => setTimeout(done, ms));

/** A browser, or null where there is none; CHROMIUM names one. */
export function open() {
  const chromium = [process.env.CHROMIUM, "/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"]
    .filter(Boolean).find((path) => { try { accessSync(path, constants.X_OK); return true; } catch { return false; } });
  if (!chromium) {
    console.log("not run: no Chromium found (CHROMIUM names one)");
    return null;
  }
  const home = mkdtempSync(join(tmpdir(), "pages-"));
  const browser = spawn(chromium, [
    "--headless", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-quic", "--no-first-run", "--hide-scrollbars",
    "--disable-background-networking", "--disable-component-update", "--disable-sync", "--remote-debugging-pipe",
    `--user-data-dir=${home}`, "about:blank",
  ], { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] });
  const waiting = new Map(), listeners = new Set();
  let count = 0, rest = "";
  browser.stdio[4].on("data", (chunk) => {
    const parts = (rest + chunk).split("\0");
    rest = parts.pop();
    for (const part of parts) {
      const message = JSON.parse(part);
      if (message.id) {
        const { done, fail } = waiting.get(message.id);
        waiting.delete(message.id);
        if (message.error) fail(new Error(message.error.message)); else done(message.result);
      } else for (const tell of listeners) tell(message);
    }
  });
  const send = (method, params = {}, sessionId) => new Promise((done, fail) => {
    waiting.set(++count, { done, fail });
    browser.stdio[3].write(`${JSON.stringify({ id: count, method, params, sessionId })}\0`);
  });
  const close = async () => {
    browser.kill();
    await new Promise((done) => { browser.on("exit", done); setTimeout(done, 3000); });
    // Processes of the browser may still write there; what is left in the end goes with the folder of the system.
    for (let i = 0; i < 20; i++) {
      try { return rmSync(home, { recursive: true, force: true }); } catch { await pause(100); }
    }
  };
  return { send, listeners, close };
}
