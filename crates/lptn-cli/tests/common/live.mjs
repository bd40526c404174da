// Runs the core that a live page contains as the page does, and prints its answers with their rows: one line a page.
// With `--times N`, each is asked N times more and `took` is the least time of an answer in ms.
import { readFileSync } from "node:fs";

const words = process.argv.slice(2), times = words[0] == "--times" ? Number(words.splice(0, 2)[1]) : 0;
const script = (page, id) => page.split(`id="${id}">`)[1].split("</script>")[0];
// the page's own functions that unpack its core
const own = (page, name) => new Function("return " + page.split(`const ${name} = `)[1].split("\n};\n")[0] + "\n}")();
const unpacked = (page, core) => own(page, "unlzma")(own(page, "bytesOf")(core));
let packed = "", compiled;
for (const name of words) {
  const page = readFileSync(name, "utf8"), letters = script(page, "core");
  if (letters != packed) [packed, compiled] = [letters, new WebAssembly.Module(unpacked(page, letters))];
  const contents = JSON.stringify(JSON.parse(script(page, "contents")).contents);
  const imports = {};
  for (const { module, name } of WebAssembly.Module.imports(compiled)) {
    (imports[module] ||= {})[name] = () => { throw new Error(name); };
  }
  const core = new WebAssembly.Instance(compiled, imports).exports;
  const call = (name, text) => {
    const bytes = new TextEncoder().encode(text), at = core.lptn_room(bytes.length);
    new Uint8Array(core.memory.buffer, at, bytes.length).set(bytes);
    const length = core[name]();
    return new TextDecoder().decode(new Uint8Array(core.memory.buffer, core.lptn_answer(), length));
  };
  try {
    call("lptn_open", contents);
    const answer = JSON.parse(call("lptn_ask", JSON.stringify({ rows: true })));
    const { rows, integrator, problems, refused } = answer;
    let took = Infinity;
    for (let i = 0; i < times; i++) {
      const begun = performance.now();
      call("lptn_ask", "{}");
      took = Math.min(took, performance.now() - begun);
    }
    console.log(JSON.stringify({ name, rows, integrator, problems, refused, took }));
  } catch (fault) {
    console.log(JSON.stringify({ name, fault: String(fault) }));
  }
}
