(() => {
"use strict";
const root = document.documentElement;
const FONT = "12px Arimo, Arial, Helvetica, 'Liberation Sans', sans-serif";
const HEIGHT = 300;
const TIMES = [["s", 1], ["min", 60], ["h", 3600], ["d", 86400]];
const STEPS = [1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 900, 1800, 3600, 7200, 10800, 14400, 21600, 43200, 86400];

// a colour of the theme that is on
const colour = key => getComputedStyle(root).getPropertyValue("--" + key).trim();
const all = (selector, within) => Array.from((within || document).querySelectorAll(selector));

function number(value, digits) {
  if (value == null || !isFinite(value)) return "";
  return String(+value.toPrecision(digits)).replace("-", "\u2212");
}

// the unit in which a time of this length is told: one of which there are at least three
function timeUnit(length) {
  let found = TIMES[0];
  for (const unit of TIMES) if (Math.abs(length) >= 3 * unit[1]) found = unit;
  return found;
}

function time(value, length) {
  const [name, scale] = timeUnit(length == null ? value : length);
  return number(value / scale, 6) + " " + name;
}

const titled = axis => axis.name + (axis.unit && axis.scale != "time" ? " [" + axis.unit + "]" : "");

// the curves over the places of all of them
function aligned(panel, places) {
  const first = panel.curves.length ? panel.curves[0].x : 0;
  if (panel.curves.every(curve => curve.x == first)) {
    return [places[first] || [], ...panel.curves.map(curve => curve.y)];
  }
  return uPlot.join(panel.curves.map(curve => [places[curve.x], curve.y]));
}

const dotted = curve => curve.look == "dots" || curve.look == "stems";

// what was measured and what was computed may have one name
function named(panel, curve, i) {
  const name = curve.name || panel.y.name || "curve " + (i + 1);
  const same = panel.curves.filter(other => other.name == curve.name);
  return dotted(curve) && same.some(other => !dotted(other)) ? name + " (dots)" : name;
}

// whether there is more than this curve, so that a legend can leave it out
const others = (panel, curve) => panel.curves.some(other => other != curve && other.name);

// what a curve looks like, told by its sign in the legend
const signs = {
  width: 2,
  dash: (u, k) => u.series[k].dash ? "dashed" : "solid",
  fill: (u, k) => u.series[k].class == "line" ? "transparent" : u.series[k].stroke(u, k),
};

function series(panel) {
  const across = panel.x;
  const x = {
    label: across.name || "x",
    value: (u, v) => across.scale == "time" ? (v == null ? "" : time(v)) : number(v, 6),
  };
  return [x, ...panel.curves.map((curve, i) => ({
    label: named(panel, curve, i),
    class: !curve.name && others(panel, curve) ? "unnamed" : dotted(curve) ? "dots" : "line",
    stroke: () => colour(curve.ink),
    width: 1.8,
    pxAlign: 0,
    dash: curve.look == "dashed" || curve.again ? [7, 4] : undefined,
    paths: dotted(curve) ? () => null : undefined,
    points: dotted(curve)
      ? { show: true, size: curve.y.length > 80 ? 3 : 6, fill: () => colour(curve.ink), width: 0 }
      : { show: false },
    value: (u, v) => v == null ? "" : number(v, 6) + (panel.y.unit ? " " + panel.y.unit : ""),
  }))];
}

// the range upwards: as in the picture where everything is shown, else what fits the part
function upward(u, panel, places) {
  const { min, max } = u.scales.x, [from, to] = panel.x.range, log = panel.y.scale == "log";
  if (min <= from && max >= to) return panel.y.range;
  let low = Infinity, high = -Infinity;
  panel.curves.forEach((curve, k) => {
    if (!u.series[k + 1].show || curve.far) return;
    places[curve.x].forEach((at, i) => {
      if (at < min || at > max) return;
      for (const values of [curve.y, curve.low, curve.high]) {
        const value = values && values[i];
        if (value == null || (log && value <= 0)) continue;
        low = Math.min(low, value);
        high = Math.max(high, value);
      }
    });
  });
  if (low > high) return panel.y.range;
  return log ? uPlot.rangeLog(low, high, 10, false) : uPlot.rangeNum(low, high, 0.06, false);
}

function fit(u, panel, places) {
  const [min, max] = upward(u, panel, places);
  u.setScale("y", { min, max });
}

function across(panel) {
  const [from, to] = panel.x.range;
  return (u, low, high) => {
    const data = u.data[0];
    if (low == null || !data.length) return [from, to];
    return low <= data[0] && high >= data[data.length - 1] ? [from, to] : [low, high];
  };
}

// room for the numbers of every panel of a figure, so that they stand below each other
function room(panels) {
  const letters = panels.flatMap(panel => panel.y.range.map(v => number(v, 3).length));
  return 26 + 7 * Math.max(3, ...letters);
}

function axes(panel, width, last) {
  const line = { stroke: () => colour("grid"), width: 1 };
  const common = { stroke: () => colour("faint"), font: FONT, labelFont: FONT, grid: line, ticks: line };
  const x = { ...common, size: 30 };
  if (last && panel.x.scale != "time") Object.assign(x, { label: titled(panel.x), labelSize: 20 });
  if (panel.x.scale == "time") {
    x.incrs = [1e-6, 1e-5, 1e-4, 1e-3, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, ...STEPS,
      ...[2, 5, 7, 10, 20, 30, 60, 90, 180, 365].map(days => days * 86400)];
    x.values = (u, marks) => marks.map(mark => time(mark, u.scales.x.max - u.scales.x.min));
    x.space = 70;
  }
  const own = texts => 26 + 7 * Math.max(0, ...(texts || []).map(text => (text || "").length));
  const y = { ...common, label: titled(panel.y), labelSize: 20, size: (u, texts) => Math.max(width, own(texts)) };
  if (panel.y.scale != "log") y.values = (u, marks) => marks.map(mark => number(mark, 10));
  return [x, y];
}

// what is around curves, below them
function spreads(u, panel, places) {
  const { ctx } = u, { left, top, width, height } = u.bbox;
  ctx.save();
  ctx.beginPath();
  ctx.rect(left, top, width, height);
  ctx.clip();
  panel.curves.forEach((curve, k) => {
    if (!u.series[k + 1].show) return;
    const at = (i, of) => [u.valToPos(places[curve.x][i], "x", true), u.valToPos(of[i], "y", true)];
    ctx.fillStyle = ctx.strokeStyle = colour(curve.ink);
    ctx.lineWidth = 1.2 * devicePixelRatio;
    if (curve.low && !dotted(curve)) {
      ctx.globalAlpha = 0.18;
      ctx.beginPath();
      const known = [...curve.low.keys()].filter(i => curve.low[i] != null && curve.high[i] != null);
      known.forEach(i => ctx.lineTo(...at(i, curve.high)));
      known.reverse().forEach(i => ctx.lineTo(...at(i, curve.low)));
      ctx.fill();
      ctx.globalAlpha = 1;
    }
    if (!dotted(curve) || (!curve.low && curve.look != "stems")) return;
    ctx.beginPath();
    curve.y.forEach((value, i) => {
      if (value == null) return;
      const foot = curve.low ? at(i, curve.low) : [0, u.valToPos(0, "y", true)];
      const head = at(i, curve.low ? curve.high : curve.y);
      ctx.moveTo(head[0], foot[1]);
      ctx.lineTo(...head);
    });
    ctx.stroke();
  });
  ctx.restore();
}

// limits across and moments upwards, with their names
function marks(u, panel, first) {
  const { ctx } = u, { left, top, width, height } = u.bbox, one = devicePixelRatio;
  ctx.save();
  ctx.font = FONT.replace("12px", 11 * one + "px");
  ctx.lineWidth = one;
  ctx.strokeStyle = ctx.fillStyle = colour("limit");
  ctx.setLineDash([6 * one, 4 * one]);
  const line = (a, b) => { ctx.beginPath(); ctx.moveTo(...a); ctx.lineTo(...b); ctx.stroke(); };
  const named = [];
  panel.limits.forEach(limit => {
    const y = u.valToPos(limit.at, "y", true);
    if (!(y >= top && y <= top + height)) return;
    line([left, y], [left + width, y]);
    const near = named.find(other => Math.abs(other.y - y) < 12 * one);
    if (near) near.names.push(limit.name);
    else named.push({ y, names: [limit.name] });
  });
  ctx.textAlign = "left";
  named.forEach(({ y, names }) => {
    const text = names.length > 2 ? names[0] + "; " + (names.length - 1) + " more" : names.join("; ");
    ctx.fillText(text, left + 4 * one, y - 4 * one);
  });
  ctx.strokeStyle = colour("frame");
  ctx.fillStyle = colour("faint");
  ctx.setLineDash([one, 3 * one]);
  let last = -Infinity;
  panel.moments.forEach(moment => {
    const x = u.valToPos(moment.at, "x", true);
    if (!(x >= left && x <= left + width)) return;
    line([x, top], [x, top + height]);
    if (!first || x - last < 14 * one) return;
    last = x;
    ctx.save();
    ctx.translate(x + 11 * one, top + height - 4 * one);
    ctx.rotate(-Math.PI / 2);
    ctx.textAlign = "left";
    ctx.fillText(moment.name, 0, 0);
    ctx.restore();
  });
  ctx.restore();
}

const heightOf = panel => Math.max(150, HEIGHT * panel.share) + 40;

// what is too far away to be shown, in words
function tellBeyond(chart, panel) {
  panel.beyond.forEach(text => {
    const line = document.createElement("p");
    line.className = "beyond";
    line.textContent = text;
    chart.root.append(line);
  });
  return chart;
}

function plot(panel, places, host, key, [width, first, last]) {
  return tellBeyond(new uPlot({
    width: Math.max(200, host.clientWidth),
    height: heightOf(panel),
    series: series(panel),
    axes: axes(panel, width, last),
    scales: {
      x: { time: false, distr: panel.x.scale == "log" ? 3 : 1, range: across(panel) },
      y: { distr: panel.y.scale == "log" ? 3 : 1, auto: false, range: panel.y.range },
    },
    legend: { markers: signs },
    cursor: { sync: { key }, drag: { x: true, y: false }, points: { size: 6 } },
    hooks: {
      drawAxes: [u => spreads(u, panel, places)],
      draw: [u => marks(u, panel, first)],
      setScale: [(u, key) => key == "x" && fit(u, panel, places)],
      setSeries: [(u, k) => k != null && u.status && fit(u, panel, places)],
    },
  }, aligned(panel, places), host), panel);
}

const figures = [];

// a figure whose curves can be zoomed into, in the place of its picture
function enliven(element, index) {
  const values = JSON.parse(element.querySelector("script").textContent);
  const host = element.querySelector(".live");
  const width = room(values.panels), end = values.panels.length - 1;
  // before it is drawn, so that it has its width
  element.classList.add("zooms");
  const figure = { values };
  const draw = () => values.panels.map((panel, i) =>
    keyed(plot(panel, values.places, host, "figure" + index, [width, i == 0, i == end]), panel, figure));
  figure.charts = draw();
  figure.redraw = () => {
    figure.charts.forEach(chart => chart.destroy());
    figure.charts = draw();
  };
  const hint = document.createElement("p");
  hint.className = "hint";
  hint.textContent = "Drag or + to zoom, double-click or 0 to see all, click a name to hide its curve.";
  element.append(hint);
  const resize = () => figure.charts.forEach((chart, i) => {
    const width = Math.max(200, host.clientWidth);
    if (width != chart.width) chart.setSize({ width, height: heightOf(values.panels[i]) });
  });
  new ResizeObserver(() => requestAnimationFrame(resize)).observe(host);
  figures.push(figure);
}

// keys zoom a figure along, move it and show all of it; names of curves are buttons
function keyed(chart, panel, figure) {
  const { root, scales } = chart, log = panel.x.scale == "log";
  const [to, from] = log ? [Math.log, Math.exp] : [x => x, x => x];
  const [first, last] = panel.x.range.map(to);
  root.tabIndex = 0;
  root.setAttribute("role", "group");
  root.setAttribute("aria-label", titled(panel.y) + ": plus and minus zoom, arrows move, 0 shows all");
  root.addEventListener("keydown", event => {
    if (event.target != root || event.ctrlKey || event.metaKey || event.altKey) return;
    const factor = KEYS[event.key], [step] = ARROWS[event.key] || [0];
    if (factor == null && !step) return;
    event.preventDefault();
    const [min, max] = [to(scales.x.min), to(scales.x.max)];
    const half = factor == 0 ? (last - first) / 2 : Math.min(last - first, (max - min) * (factor || 1)) / 2;
    const middle = between(first + half, (min + max) / 2 + 0.2 * step * half, last - half);
    const seen = { min: from(middle - half), max: from(middle + half) };
    figure.charts.forEach(other => other.setScale("x", seen));
  });
  all(".u-legend .u-series", root).forEach((row, k) => {
    const name = row.querySelector("th");
    if (!k) return;
    const say = () => name.setAttribute("aria-pressed", chart.series[k].show);
    name.tabIndex = 0;
    name.setAttribute("role", "button");
    name.addEventListener("click", say);
    name.addEventListener("keydown", event => {
      if (event.key != "Enter" && event.key != " ") return;
      event.preventDefault();
      name.click();
    });
    say();
  });
  return chart;
}

const SIGNS = [["+", "zoom in", 1 / 1.4], ["\u2212", "zoom out", 1.4], ["all", "show all", 0]];
const KEYS = { "+": 1 / 1.4, "=": 1 / 1.4, "-": 1.4, "0": 0 };
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
const between = (low, value, high) => Math.max(low, Math.min(high, value));

const drawings = [];

// a drawing as wide as the page, which can be moved and zoomed into; of several times, all together
function fitted(figure) {
  const views = all("svg", figure).map(svg => viewed(svg));
  views.forEach(view => view.join(views));
  const tools = document.createElement("p");
  tools.className = "tools";
  SIGNS.forEach(([text, label, factor]) => {
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = text;
    button.setAttribute("aria-label", label);
    button.addEventListener("click", () => views[0].zoom(factor));
    tools.append(button);
  });
  const hint = document.createElement("span");
  hint.className = "hint";
  hint.textContent = "Drag to move, double-click or + to zoom.";
  tools.append(hint);
  figure.prepend(tools);
  figure.classList.add("fits");
}

function viewed(svg) {
  const frame = svg.parentElement, { width, height } = svg.viewBox.baseVal;
  const drawing = { svg, frame, width, height, x: 0, y: 0, share: 1 };
  let together = [drawing];
  drawing.join = others => { together = others; };
  drawing.show = ({ x, y, share }) => {
    Object.assign(drawing, { x, y, share });
    svg.setAttribute("viewBox", [x, y, width * share, height * share].join(" "));
    frame.classList.toggle("inside", share < 1);
  };
  const move = (dx, dy) => {
    const x = between(0, drawing.x + dx, width * (1 - drawing.share));
    const y = between(0, drawing.y + dy, height * (1 - drawing.share));
    together.forEach(other => other.show({ x, y, share: drawing.share }));
  };
  // a factor of 0 shows all; the point, in shares of the frame, keeps its place
  drawing.zoom = (factor, [right, down] = [0.5, 0.5]) => {
    const share = factor ? between(1 / 40, drawing.share * factor, 1) : 1;
    const lost = drawing.share - share;
    drawing.share = share;
    move(right * lost * width, down * lost * height);
  };
  const size = () => {
    const scale = Math.min(1, frame.clientWidth / width) || 1;
    svg.style.width = width * scale + "px";
    svg.style.height = height * scale + "px";
  };
  const at = event => {
    const box = svg.getBoundingClientRect();
    return [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height];
  };
  let held = null;
  svg.addEventListener("pointerdown", event => {
    if (drawing.share == 1) return;
    held = at(event);
    svg.setPointerCapture(event.pointerId);
  });
  svg.addEventListener("pointermove", event => {
    if (!held) return;
    const now = at(event);
    move((held[0] - now[0]) * width * drawing.share, (held[1] - now[1]) * height * drawing.share);
    held = now;
  });
  for (const end of ["pointerup", "pointercancel"]) svg.addEventListener(end, () => { held = null; });
  svg.addEventListener("dblclick", event => drawing.zoom(drawing.share < 1 ? 0 : 0.5, at(event)));
  svg.addEventListener("wheel", event => {
    if (!event.ctrlKey && !event.metaKey) return;
    event.preventDefault();
    drawing.zoom(event.deltaY > 0 ? 1.2 : 1 / 1.2, at(event));
  }, { passive: false });
  frame.tabIndex = 0;
  frame.addEventListener("keydown", event => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const step = ARROWS[event.key], factor = KEYS[event.key];
    if (factor != null) drawing.zoom(factor);
    else if (step && drawing.share < 1) move(...step.map(s => 0.1 * s * width * drawing.share));
    else return;
    event.preventDefault();
  });
  size();
  new ResizeObserver(() => requestAnimationFrame(size)).observe(frame);
  drawings.push(drawing);
  return drawing;
}

const themes = window.matchMedia("(prefers-color-scheme: dark)");
const redraw = () => figures.forEach(figure => figure.redraw());
const button = document.getElementById("theme");
button.hidden = false;
button.addEventListener("click", () => {
  const dark = root.dataset.theme ? root.dataset.theme == "dark" : themes.matches;
  root.dataset.theme = dark ? "light" : "dark";
  redraw();
});
themes.addEventListener("change", redraw);

// paper shows everything
const folded = [];
window.addEventListener("beforeprint", () => drawings.forEach(drawing => drawing.zoom(0)));
window.addEventListener("beforeprint", () => all("details:not([open])").forEach(part => {
  part.open = true;
  folded.push(part);
}));
window.addEventListener("afterprint", () => folded.splice(0).forEach(part => { part.open = false; }));

// drawings of several times, one of which is shown
all("figure.frames").filter(figure => figure.querySelector("input")).forEach(figure => {
  const frames = all("div", figure), slider = figure.querySelector("input");
  const show = () => {
    frames.forEach((frame, i) => { frame.hidden = i != slider.value; });
    const time = frames[slider.value].dataset.time;
    slider.setAttribute("aria-valuetext", time);
    figure.querySelector("output").textContent = time;
  };
  figure.querySelector("label").hidden = false;
  slider.addEventListener("input", show);
  show();
});

all("figure.chart").filter(figure => figure.querySelector(".live")).forEach(enliven);
all("figure.drawing").forEach(fitted);
window.lptn = { figures, drawings };
root.dataset.ready = figures.length;
})();
