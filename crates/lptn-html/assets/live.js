(() => {
"use strict";
// The worker: the core as WebAssembly, which is asked by texts. A fault of it ends its instance, not the page.
const work = () => {
  let compiled, core, contents;
  const call = (name, text) => {
    const bytes = new TextEncoder().encode(text), at = core.lptn_room(bytes.length);
    new Uint8Array(core.memory.buffer, at, bytes.length).set(bytes);
    const length = core[name]();
    return new TextDecoder().decode(new Uint8Array(core.memory.buffer, core.lptn_answer(), length));
  };
  // the core calls nothing; libraries in it name functions of a host that it does not reach
  const imports = () => {
    const all = {};
    for (const { module, name } of WebAssembly.Module.imports(compiled)) {
      (all[module] = all[module] || {})[name] = () => { throw new Error(name); };
    }
    return all;
  };
  const start = () => {
    core = new WebAssembly.Instance(compiled, imports()).exports;
    return call("lptn_open", contents);
  };
  const begin = async data => {
    compiled = await WebAssembly.compile(unlzma(bytesOf(data.core)));
    contents = data.contents;
    return start();
  };
  onmessage = async ({ data }) => {
    const begun = performance.now();
    try {
      const text = data.core ? await begin(data) : call("lptn_ask", data.question);
      postMessage({ answer: JSON.parse(text), took: performance.now() - begun });
    } catch (fault) {
      postMessage({ fault: String(fault) });
      if (compiled) try { start(); } catch (again) { compiled = null; }
    }
  };
};

const STEPS = 1000;
const all = (selector, within) => Array.from((within || document).querySelectorAll(selector));
const made = (tag, kind, text) => {
  const element = document.createElement(tag);
  if (kind) element.className = kind;
  if (text) element.textContent = text;
  return element;
};
const panel = document.querySelector(".tune");
const given = JSON.parse(document.getElementById("contents").textContent);
const [state, problems, steady, rows] = [".said", ".problems", ".steady", ".rows"].map(part => panel.querySelector(part));

// the sections that are not solved again say so, and so do the others if no run could be
const marks = [], charts = all("figure.chart");
const heading = part => part.querySelector("h2, summary");
const results = all("section").find(part => heading(part) && heading(part).textContent == "Results");
const mark = (before, again) => {
  const note = made("p", "made", "As the page was made, not with the values above.");
  note.hidden = true;
  before.before(note);
  marks.push({ note, again });
};
const begin = () => {
  all("body > section, body > details").filter(part => part != panel).forEach(part => {
    const again = part == results || charts.includes(part.querySelector("figure.chart"));
    mark(again ? part : heading(part).nextElementSibling || part, again);
  });
  mark(document.querySelector(".claims") || panel, true);
};

// ---- parameters
const between = (low, value, high) => Math.max(low, Math.min(high, value));
const toSlider = ({ range: [low, high], log }, value) => STEPS * between(0, log
  ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low), 1);
const ofSlider = ({ range: [low, high], log }, step) => log
  ? low * (high / low) ** (step / STEPS) : low + (high - low) * step / STEPS;
const parameters = given.parameters.map((parameter, i) => {
  const row = made("div", "row"), label = made("label", "", parameter.name);
  const slider = made("input"), field = made("input"), unit = made("span", "unit", parameter.unit);
  Object.assign(slider, { type: "range", min: 0, max: STEPS, step: 1, id: "slider" + i });
  slider.setAttribute("aria-label", parameter.name);
  Object.assign(field, { type: "text", id: "field" + i, autocomplete: "off", spellcheck: false });
  label.htmlFor = field.id;
  row.append(label, slider, field, unit);
  rows.append(row);
  const own = { ...parameter, row, slider, field, set: null };
  own.show = ({ text, value }) => {
    field.value = text;
    slider.value = toSlider(parameter, value);
    slider.setAttribute("aria-valuetext", text + " " + parameter.unit);
  };
  own.show(parameter);
  const change = text => {
    own.set = text.trim() ? text.trim() : null;
    field.removeAttribute("aria-invalid");
    ask();
  };
  slider.addEventListener("input", () => {
    const value = Number(ofSlider(parameter, Number(slider.value)).toPrecision(4));
    field.value = String(value);
    slider.setAttribute("aria-valuetext", field.value + " " + parameter.unit);
    change(field.value);
  });
  field.addEventListener("change", () => change(field.value));
  return own;
});
// a number has the unit that is shown; a text may have its own
const assignment = ({ name, set, unit }) =>
  name + "=" + set + (unit && !isNaN(Number(set)) ? " " + unit : "");
const assignments = () => parameters.filter(own => own.set != null).map(assignment);
const quoted = word => /^[\w./+,:@%=-]+$/.test(word) ? word : "'" + word.replaceAll("'", "'\\''") + "'";

// ---- answers
function redraw(found) {
  let zoomed = 0;
  found.forEach(({ values, picture, notes }, i) => {
    const element = charts[i];
    if (!element) return;
    element.querySelector(".still").innerHTML = picture;
    all("figcaption", element).forEach(note => note.remove());
    const still = element.querySelector(".still");
    notes.slice().reverse().forEach(note => {
      still.after(made("figcaption", ""));
      still.nextSibling.innerHTML = note;
    });
    if (!values || !element.querySelector(".live")) return;
    const figure = lptn.figures[zoomed++];
    const seen = figure.charts.map(chart => ({
      x: chart.scales.x.min > figure.values.panels[0].x.range[0] || chart.scales.x.max < figure.values.panels[0].x.range[1]
        ? { min: chart.scales.x.min, max: chart.scales.x.max } : null,
      hidden: chart.series.map((series, k) => k && !series.show && series.label).filter(label => label),
    }));
    Object.assign(figure.values, values);
    figure.redraw();
    figure.charts.forEach((chart, k) => {
      if (!seen[k]) return;
      chart.series.forEach((series, n) => { if (seen[k].hidden.includes(series.label)) chart.setSeries(n, { show: false }); });
      if (seen[k].x) chart.setScale("x", seen[k].x);
    });
  });
}

function tell(list) {
  problems.replaceChildren(...list.map(({ code, message, help }) =>
    made("p", code ? "" : "fails", (code ? code + ": " : "") + message + (help ? "\nhelp: " + help : ""))));
}

// how far the first answer is from the page that the program wrote
function compare(answer) {
  if (!answer.figures) return "";
  let most = 0, alike = true;
  const figures = answer.figures.filter(figure => figure.values);
  figures.forEach((figure, i) => figure.values.panels.forEach((found, k) => {
    const own = lptn.figures[i] && lptn.figures[i].values.panels[k];
    if (!own || own.curves.length != found.curves.length) { alike = false; return; }
    own.curves.forEach((curve, n) => {
      const other = found.curves[n].y;
      if (other.length != curve.y.length) { alike = false; return; }
      curve.y.forEach((value, m) => { if (value != other[m]) most = Math.max(most, Math.abs(value - other[m])); });
    });
  }));
  if (!alike) return "The rows of this browser are not those of the page: compare with the program.";
  if (most == 0) return "Same values as the program, to the last digit.";
  return "Curves differ from those of the program by up to " + Number(most.toPrecision(2)) + ".";
}

let same = "";
function show(answer, took) {
  if (answer.refused) {
    parameters.filter(own => own.set != null).forEach(own => own.field.setAttribute("aria-invalid", "true"));
    tell(answer.refused);
    state.textContent = "Refused: the page shows the values before.";
    return;
  }
  const changed = assignments();
  parameters.forEach((own, i) => {
    own.row.classList.toggle("set", own.set != null);
    own.field.removeAttribute("aria-invalid");
    if (own.set == null) own.show(answer.parameters[i]);
    else if (isNaN(Number(own.set))) own.slider.value = toSlider(own, answer.parameters[i].value);
  });
  marks.forEach(({ note, again }) => { note.hidden = !changed.length || (again && Boolean(answer.figures)); });
  tell(answer.problems);
  steady.innerHTML = answer.steady || "";
  if (answer.no_steady) steady.replaceChildren(...answer.no_steady.map(problem => made("p", "", problem.message)));
  if (answer.figures) {
    const claims = document.querySelector(".claims");
    if (claims) claims.outerHTML = answer.claims;
    redraw(answer.figures);
    all(".part", results).forEach(part => part.remove());
    heading(results).insertAdjacentHTML("afterend", answer.results);
  }
  const by = answer.integrator ? " by " + answer.integrator : "";
  state.textContent = "Solved" + by + " in " + Number(took.toPrecision(2)) + " ms. " + (changed.length ? "" : same);
  panel.querySelector("code").textContent =
    ["lptn run", quoted(given.file), ...given.words.map(quoted), ...changed.map(text => "--set " + quoted(text))].join(" ");
  panel.dataset.answers = Number(panel.dataset.answers || 0) + 1;
}

// ---- questions: one at a time, the last one wins
let busy = true, waiting = false, asked = 0;
function ask() {
  waiting = true;
  if (busy) return;
  [busy, waiting, asked] = [true, false, performance.now()];
  state.textContent = "Solving.";
  worker.postMessage({ question: JSON.stringify({ set: assignments() }) });
}

panel.querySelector("button").addEventListener("click", () => {
  parameters.forEach(own => { own.set = null; });
  ask();
});

const source = new Blob(["const unlzma = " + unlzma + ", bytesOf = " + bytesOf + ";\n(" + work + ")()"], { type: "text/javascript" });
const worker = new Worker(URL.createObjectURL(source));
worker.addEventListener("error", event => { state.textContent = "The solver did not start: " + event.message; });
worker.addEventListener("message", ({ data: { answer, took, fault } }) => {
  busy = false;
  if (fault) {
    state.textContent = "The solver failed; the page shows the values before. " + fault;
  } else {
    if (!same && !asked) same = compare(answer);
    show(answer, took);
    // from the question to the page, drawn
    if (asked) panel.dataset.took = performance.now() - asked;
  }
  if (waiting) ask();
});
begin();
worker.postMessage({ core: document.getElementById("core").textContent.trim(), contents: JSON.stringify(given.contents) });
})();
