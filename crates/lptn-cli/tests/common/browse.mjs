// Opens pages in Chromium as they are, under their own policies, and prints for each, in a line, what an expression gives
// in it, what the console said, and what was requested beside the page. `node browse.mjs FOLDER EXPRESSION WIDTH:PAGE...`;
// the expression may be a promise.
//
// `--dump-dom` with a budget of virtual time does not wait for a worker; the protocol of developer tools does.
import { spawn } from "node:child_process";
import { pathToFileURL } from "node:url";

const [folder, expression, ...pages] = process.argv.slice(2);
const browser = spawn("chromium", ["--headless=new", "--no-sandbox", "--disable-gpu", "--hide-scrollbars",
  "--disable-background-networking", "--remote-debugging-pipe", `--user-data-dir=${folder}/profile`], { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] });
browser.on("error", () => { console.log(JSON.stringify({ missing: true })); process.exit(0); });
const [input, output] = [browser.stdio[3], browser.stdio[4]];
const waiting = new Map();
let count = 0, session, loaded, left = "", said = [], requested = [];
const ask = (method, params = {}) => new Promise((done, failed) => {
  waiting.set(++count, [done, failed]);
  input.write(JSON.stringify({ id: count, method, params, sessionId: session }) + "\0");
});
const events = {
  "Runtime.consoleAPICalled": event => said.push(event.args.map(arg => arg.value).join(" ")),
  "Runtime.exceptionThrown": event => said.push(event.exceptionDetails.text),
  "Log.entryAdded": event => said.push(event.entry.text),
  "Network.requestWillBeSent": event => requested.push(event.request.url.slice(0, 80)),
  "Page.loadEventFired": () => loaded(),
};
output.on("data", data => {
  const texts = (left + data).split("\0");
  left = texts.pop();
  for (const { id, result, error, method, params } of texts.map(text => JSON.parse(text))) {
    if (id) {
      const [done, failed] = waiting.get(id);
      error ? failed(new Error(error.message)) : done(result);
    } else if (events[method]) events[method](params);
  }
});
const { targetId } = await ask("Target.createTarget", { url: "about:blank" });
session = (await ask("Target.attachToTarget", { targetId, flatten: true })).sessionId;
for (const domain of ["Page", "Runtime", "Log", "Network"]) await ask(domain + ".enable");
for (const of of pages) {
  const [, width, page] = of.match(/^(\d+):(.*)$/);
  const metrics = { width: Number(width), height: 1200, deviceScaleFactor: 1, mobile: false };
  await ask("Emulation.setDeviceMetricsOverride", metrics);
  [said, requested] = [[], []];
  const address = pathToFileURL(`${folder}/${page}`).href;
  const whole = new Promise(done => { loaded = done; });
  await ask("Page.navigate", { url: address });
  await whole;
  const { result, exceptionDetails } = await ask("Runtime.evaluate",
    { expression, awaitPromise: true, returnByValue: true });
  if (exceptionDetails) said.push(exceptionDetails.exception.description);
  const elsewhere = requested.filter(url => url != address.slice(0, 80) && !url.startsWith("blob:"));
  console.log(JSON.stringify({ value: result.value, said, requested: elsewhere }));
}
session = undefined;
await ask("Browser.close");
