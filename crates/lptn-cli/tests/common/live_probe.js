// Moves the slider of `R` in a live page, types a wrong value, resets; gives what the page shows after each.
(async () => {
const panel = document.querySelector(".tune"), state = panel.querySelector(".said");
const rest = ms => new Promise(done => setTimeout(done, ms));
const until = async seen => { for (let i = 0; i < 6000 && !seen(); i++) await rest(10); };
const answers = n => until(() => Number(panel.dataset.answers || 0) >= n);
const cells = part => Array.from(part.querySelectorAll("tr")).map(row =>
  Array.from(row.querySelectorAll("td")).map(cell => cell.textContent)).filter(row => row.length);
const results = () => Array.from(document.querySelectorAll("section")).find(part => {
  const heading = part.querySelector("h2");
  return heading && heading.textContent == "Results";
});
const shown = () => ({
  state: state.textContent,
  took: panel.dataset.took,
  command: panel.querySelector("code").textContent,
  steady: cells(panel.querySelector(".steady")),
  results: cells(results()),
  claims: document.querySelector(".claims").textContent,
  curves: lptn.figures[0].charts[0].data.map(column => column[column.length - 1]),
  picture: document.querySelector(".still").innerHTML.length,
  problems: panel.querySelector(".problems").textContent,
  marked: Array.from(document.querySelectorAll(".made")).filter(note => !note.hidden).length,
  fields: Array.from(panel.querySelectorAll("input[type=text]")).map(field => field.value),
});
const row = Array.from(panel.querySelectorAll(".row")).find(part => part.querySelector("label").textContent == "R");
const [slider, field] = [row.querySelector("input[type=range]"), row.querySelector("input[type=text]")];
const found = { before: cells(results()) };
await answers(1);
found.first = shown();
slider.value = 700;
slider.dispatchEvent(new Event("input"));
await answers(2);
found.moved = shown();
field.value = "1 W";
field.dispatchEvent(new Event("change"));
await until(() => state.textContent.startsWith("Refused"));
found.wrong = { ...shown(), invalid: field.getAttribute("aria-invalid") };
panel.querySelector("button").click();
await answers(3);
found.reset = shown();
found.named = Array.from(panel.querySelectorAll("input")).every(input =>
  input.getAttribute("aria-label") || panel.querySelector("label[for=" + input.id + "]"));
found.reached = Array.from(panel.querySelectorAll("input, button")).every(part => part.tabIndex == 0);
return found;
})()
