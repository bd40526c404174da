// Looks at a page from inside: what is drawn, what zoom and legend do, how readable it is, what keys reach.
(async () => {
// the charts draw when a script has come to rest
const rest = () => new Promise(done => setTimeout(done, 0));
const found = { ready: document.documentElement.dataset.ready, charts: [], contrast: {}, wide: [] };

const channel = value => {
  value /= 255;
  return value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4;
};
const luminance = ([r, g, b]) => 0.2126 * channel(r) + 0.7152 * channel(g) + 0.0722 * channel(b);
const rgb = text => (text.match(/[\d.]+/g) || []).map(Number);
const contrast = (a, b) => {
  const [x, y] = [luminance(a) + 0.05, luminance(b) + 0.05];
  return Math.max(x, y) / Math.min(x, y);
};
const paper = element => {
  for (let at = element; at; at = at.parentElement) {
    const colour = rgb(getComputedStyle(at).backgroundColor);
    if (colour.length == 3) return colour;
  }
  return [255, 255, 255];
};
const texts = () => Array.from(document.body.querySelectorAll("*")).filter(element =>
  !["SCRIPT", "STYLE"].includes(element.tagName) && element.getClientRects().length &&
  Array.from(element.childNodes).some(node => node.nodeType == 3 && node.textContent.trim()));

for (const theme of ["light", "dark"]) {
  document.documentElement.dataset.theme = theme;
  let least = [21, ""];
  for (const element of texts()) {
    const style = getComputedStyle(element);
    const colour = rgb(element.namespaceURI.endsWith("svg") ? style.fill : style.color);
    const value = contrast(colour.slice(0, 3), paper(element.closest("svg") ? document.body : element));
    if (value < least[0]) least = [value, element.textContent.trim().slice(0, 40)];
  }
  found.contrast[theme] = least;
}
found.wide = texts()
  .filter(element => !element.closest(".table, .drawing, pre, .live") &&
    element.getBoundingClientRect().right > document.documentElement.clientWidth + 1)
  .map(element => element.textContent.trim().slice(0, 40));

// what a mouse can use, keys can: it has a name, is in the order of the tab key, and shows that it has the focus
const spoken = part => part.getAttribute("aria-label") || part.textContent.trim() ||
  (part.id && (document.querySelector("label[for=" + part.id + "]") || {}).textContent) ||
  (part.closest("label") || {}).textContent;
const used = "button, input, summary, a, [tabindex], .u-legend .u-series:not(:first-child) th, .drawing > div";
found.used = 0;
found.unreached = [];
for (const part of document.querySelectorAll(used)) {
  if (!part.checkVisibility()) continue;
  const before = [getComputedStyle(part).outlineStyle, getComputedStyle(part).borderColor].join();
  part.focus({ focusVisible: true });
  const after = [getComputedStyle(part).outlineStyle, getComputedStyle(part).borderColor].join();
  const named = part.matches(".drawing > div") || spoken(part);
  found.used += 1;
  if (part.tabIndex < 0 || document.activeElement != part || !named || before == after) {
    found.unreached.push(part.outerHTML.slice(0, 80));
  }
  part.blur();
}

// which drawing a slider shows, at its end and at its beginning
found.frames = Array.from(document.querySelectorAll("figure.frames")).map(figure => {
  const slider = figure.querySelector("input"), frames = Array.from(figure.querySelectorAll("div"));
  const seen = () => frames.filter(frame => frame.getClientRects().length).map(frame => frame.dataset.time);
  if (!slider) return { count: frames.length, last: seen() };
  const last = seen(), label = figure.querySelector("label").getClientRects().length > 0;
  slider.value = 0;
  slider.dispatchEvent(new Event("input"));
  return { count: frames.length, label, last, first: seen(), told: figure.querySelector("output").textContent };
});

for (const figure of lptn.figures) {
  for (const chart of figure.charts) {
    const x = chart.data[0], of = chart.series.length - 1;
    const seen = { rows: x.length, data: chart.data.map(column => Array.from(column)) };
    seen.before = [chart.scales.x.min, chart.scales.x.max, chart.scales.y.min, chart.scales.y.max];
    const middle = x[Math.floor(x.length / 2)], end = x[x.length - 1];
    chart.setScale("x", { min: middle, max: end });
    await rest();
    seen.zoomed = [chart.scales.x.min, chart.scales.x.max, chart.scales.y.min, chart.scales.y.max];
    chart.setScale("x", { min: x[0], max: end });
    await rest();
    seen.again = [chart.scales.x.min, chart.scales.x.max, chart.scales.y.min, chart.scales.y.max];
    const label = chart.root.querySelectorAll(".u-legend .u-series")[of].querySelector("th");
    label.click();
    seen.hidden = chart.series.map(series => series.show);
    label.click();
    seen.shown = chart.series.map(series => series.show);
    const press = (part, key) => part.dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true }));
    press(label, "Enter");
    seen.pressed = [chart.series[of].show, label.getAttribute("aria-pressed")];
    press(label, " ");
    const range = () => [chart.scales.x.min, chart.scales.x.max];
    press(chart.root, "+");
    await rest();
    seen.nearer = range();
    press(chart.root, "ArrowLeft");
    await rest();
    seen.moved = range();
    press(chart.root, "0");
    await rest();
    seen.all = range();
    const begun = performance.now();
    for (let i = 0; i < 20; i++) {
      chart.setScale("x", { min: x[0], max: i % 2 ? end : middle });
      await rest();
    }
    seen.took = (performance.now() - begun) / 20;
    found.charts.push(seen);
  }
}
// drawings: all of one is in the page; buttons and keys zoom, and show all again
found.drawings = [];
for (const { svg, frame } of lptn.drawings) {
  const folded = svg.closest("details");
  if (folded) folded.open = true;
  await new Promise(done => setTimeout(done, 50));
  const view = () => svg.getAttribute("viewBox").split(" ").map(Number);
  const press = key => frame.dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true }));
  const buttons = frame.parentElement.querySelectorAll(".tools button");
  const seen = { before: view(), right: svg.getBoundingClientRect().right, page: document.documentElement.clientWidth };
  buttons[0].click();
  seen.nearer = view();
  const beside = Array.from(frame.parentElement.querySelectorAll("svg"), other => other.getAttribute("viewBox"));
  seen.together = beside.every(other => other == seen.nearer.join(" "));
  press("ArrowRight");
  seen.moved = view();
  buttons[2].click();
  seen.all = view();
  press("+");
  seen.key = view();
  press("0");
  seen.again = view();
  if (folded) folded.open = false;
  found.drawings.push(seen);
}
return found;
})();
