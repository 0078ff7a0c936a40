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

/** A page of a browser without network: its protocol, the value of an expression there, and waiting until one is true. Whatever its console
 *  says, and whatever it asks of a network, is complained of. */
export async function session({ send, listeners }, complain, patience = 120000) {
  const { targetId } = await send("Target.createTarget", { url: "about:blank" });
  const { sessionId } = await send("Target.attachToTarget", { targetId, flatten: true });
  const on = (method, params) => send(method, params, sessionId);
  const thrown = (details) => complain(`exception: ${details.exception?.description ?? details.text}`);
  listeners.add(({ method, params, sessionId: of }) => {
    if (of !== sessionId) return;
    if (method === "Runtime.consoleAPICalled") complain(`console: ${params.args.map((a) => a.value ?? a.description).join(" ")}`);
    if (method === "Runtime.exceptionThrown") thrown(params.exceptionDetails);
    if (method === "Log.entryAdded") complain(`log: ${params.entry.text}`);
    if (method === "Network.requestWillBeSent" && !/^(file|data|blob):/.test(params.request.url)) complain(`asks for ${params.request.url}`);
  });
  for (const domain of ["Page", "Runtime", "Log", "Network"]) await on(`${domain}.enable`);
  await on("Network.emulateNetworkConditions", { offline: true, latency: 0, downloadThroughput: 0, uploadThroughput: 0 });
  const value = async (expression) => {
    try {
      const { result, exceptionDetails } = await on("Runtime.evaluate", { expression, awaitPromise: true, returnByValue: true });
      if (exceptionDetails) thrown(exceptionDetails);
      return result.value;
    } catch (error) {
      // A page that is just loading another one has no answer.
      if (/navigated|destroyed|context/.test(error.message)) return undefined;
      throw error;
    }
  };
  /** Milliseconds until an expression is true; what else is told where that is in vain comes from `told`. */
  const until = async (what, expression, told = "''") => {
    const begin = Date.now();
    while (!(await value(expression))) {
      if (Date.now() - begin > patience) throw new Error(`waited in vain for ${what} ${await value(told)}`);
      await pause(20);
    }
    return Date.now() - begin;
  };
  return { on, value, until };
}
