"use strict";
const data = JSON.parse(document.getElementById("data").textContent);
const byId = (id) => document.getElementById(id);
const blinkMilliseconds = 600;

function element(tag, properties = {}, ...children) {
  const node = Object.assign(document.createElement(tag), properties);
  node.append(...children);
  return node;
}

function picture(pair, kind) {
  if (!pair[kind]) return element("div", {className: "absent", textContent: "no picture"});
  return element("img", {src: pair[kind], alt: `${kind} of ${pair.name}`, className: kind});
}

function sideBySide(pair) {
  const sides = element("div", {className: "sides"});
  const kinds = ["baseline", "actual", "difference"];
  for (const kind of kinds.filter((kind) => kind !== "difference" || pair.difference || !pair.comparable))
    sides.append(element("figure", {}, element("figcaption", {textContent: kind}), picture(pair, kind)));
  return [sides];
}

/** The actual picture above the baseline, to the right of a line that the slider moves. */
function slider(pair) {
  const above = picture(pair, "actual");
  const divider = element("div", {className: "divider"});
  const range = element("input", {type: "range", min: 0, max: 100, value: 50, className: "position"});
  range.setAttribute("aria-label", "Share of the baseline");
  const move = () => {
    above.style.clipPath = `inset(0 0 0 ${range.value}%)`;
    divider.style.left = `${range.value}%`;
  };
  range.addEventListener("input", move);
  move();
  const control = element("div", {className: "control"}, "baseline", range, "actual");
  return [control, element("div", {className: "stack"}, picture(pair, "baseline"), above, divider)];
}

/** Shows the baseline and the actual picture in turn, as long as the view is in the page. */
function blink(pair) {
  const above = picture(pair, "actual");
  const label = element("p", {className: "showing"});
  const stack = element("div", {className: "stack"}, picture(pair, "baseline"), above);
  let actual = false;
  const swap = () => {
    actual = !actual;
    above.style.visibility = actual ? "visible" : "hidden";
    label.textContent = actual ? "actual" : "baseline";
  };
  swap();
  const timer = setInterval(() => (stack.isConnected ? swap() : clearInterval(timer)), blinkMilliseconds);
  return [label, stack];
}

const modes = {
  "Side by side": sideBySide,
  "Slider": slider,
  "Blink": blink,
  "Difference": (pair) => [picture(pair, "difference")],
};

function addModes(article, pair) {
  const buttons = article.querySelector(".modes");
  const show = (name) => {
    article.querySelector(".view").replaceChildren(...modes[name](pair));
    for (const button of buttons.children) button.setAttribute("aria-pressed", button.textContent === name);
  };
  if (pair.baseline && pair.actual && pair.comparable)
    for (const name of Object.keys(modes).filter((name) => name !== "Difference" || pair.difference))
      buttons.append(element("button", {type: "button", textContent: name, onclick: () => show(name)}));
  show("Side by side");
}

function outcome(pair) {
  if (pair.verdict === "equal") return "equal";
  return pair.updated ? "updated" : "failed";
}

function card(pair) {
  const article = byId("pair").content.firstElementChild.cloneNode(true);
  article.classList.add({equal: "good", updated: "updated", failed: "bad"}[outcome(pair)]);
  article.querySelector("h2").textContent = pair.name;
  article.querySelector(".verdict").textContent = pair.verdict.replaceAll("-", " ") + (pair.updated ? ", updated" : "");
  article.querySelector(".message").textContent = pair.message;
  article.querySelector(".choose").hidden = !pair.acceptable;
  article.querySelector(".chosen").addEventListener("change", showCommand);
  if (pair.baseline || pair.actual) addModes(article, pair);
  return article;
}

/** A word for the shell that matches this name only. */
function quoted(name) {
  return "'" + name.replace(/[\\*?[\]]/g, "\\$&").replaceAll("'", "'\\''") + "'";
}

function showCommand() {
  const names = data.pairs.filter((pair, k) => cards[k].querySelector(".chosen").checked).map((pair) => pair.name);
  byId("accept").hidden = names.length === 0;
  byId("command").value = data.command + names.map((name) => " --accept " + quoted(name)).join("");
}

function applyFilter() {
  const part = byId("name").value.toLowerCase();
  const wanted = byId("verdict").value;
  let shown = 0;
  data.pairs.forEach((pair, k) => {
    const visible = pair.name.toLowerCase().includes(part) && (wanted === "all" || wanted === outcome(pair));
    cards[k].hidden = !visible;
    shown += visible;
  });
  byId("shown").textContent = `${shown} of ${data.pairs.length} shown`;
}

const cards = data.pairs.map(card);
const count = (wanted) => data.pairs.filter((pair) => outcome(pair) === wanted).length;
const failures = count("failed"), updates = count("updated");
const updated = updates > 0 ? ` ${updates} differed and ${updates === 1 ? "was" : "were"} updated; this page shows what was before.` : "";
byId("pairs").replaceChildren(...cards);
byId("summary").textContent =
  `${failures === 0 ? "No" : failures} of ${data.pairs.length} ${data.what} failed.${updated} ${data.rule} ` +
  `Written by ${data.program}.`;
byId("title").textContent = data.title;
byId("verdict").querySelector("[value=updated]").hidden = updates === 0;
const outcomes = [...(failures > 0 ? [`${failures} failed`] : []), ...(updates > 0 ? [`${updates} updated`] : [])];
document.title = `${outcomes.join(", ") || "Passed"}: ${data.title.toLowerCase()}`;
byId("filter").addEventListener("submit", (event) => event.preventDefault());
byId("name").addEventListener("input", applyFilter);
byId("verdict").addEventListener("input", applyFilter);
applyFilter();
