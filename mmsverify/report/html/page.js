"use strict";
// Filters the findings, zooms the timelines, unfolds what a link leads to. The page can be read without it.

const found = Array.from(document.querySelectorAll(".finding[id]"));
const form = document.querySelector("form.filters");
const texts = new Map();

// What a finding says, in small letters; worked out when it is first asked for.
function wordsOf(each) {
  if (!texts.has(each)) {
    const group = each.closest(".group");
    const head = group ? group.querySelector("h3").textContent : "";
    texts.set(each, (head + " " + each.textContent).toLowerCase());
  }
  return texts.get(each);
}

function filter() {
  const severities = new Set(Array.from(form.querySelectorAll("[name=severity]:checked"), (box) => box.value));
  const device = form.elements.device.value;
  const rule = form.elements.rule.value;
  const wanted = form.elements.text.value.toLowerCase().split(/\s+/).filter(Boolean);
  let shown = 0;
  for (const each of found) {
    const data = each.dataset;
    const fits = severities.has(data.severity) && (!device || data.device === device) &&
      (!rule || data.rule === rule) && (!wanted.length || wanted.every((word) => wordsOf(each).includes(word)));
    each.classList.toggle("away", !fits);
    shown += fits ? 1 : 0;
  }
  for (const group of document.querySelectorAll(".group")) {
    group.classList.toggle("away", !group.querySelector(".finding[id]:not(.away)"));
    const lines = group.querySelector("ol.lines");
    if (lines) lines.parentElement.classList.toggle("away", !lines.querySelector("li:not(.away)"));
  }
  for (const section of document.querySelectorAll(".device")) {
    section.classList.toggle("away", Boolean(device) && section.dataset.device !== device);
  }
  document.querySelector(".nothing").hidden = shown > 0;
  form.querySelector("output").value = `${shown} of ${found.length} findings`;
}

if (form) {
  form.hidden = false;
  let waiting = 0;
  form.addEventListener("input", () => { clearTimeout(waiting); waiting = setTimeout(filter, 80); });
  form.addEventListener("reset", () => setTimeout(filter, 0));
  form.addEventListener("submit", (event) => { event.preventDefault(); filter(); });
}

// Timelines: from which share of the time to which is shown.

const shownOf = new Map();
const LETTER = 6.2; // pixels

function draw(timeline) {
  const [begin, end] = shownOf.get(timeline) || [0, 1];
  const wide = end - begin;
  const pixels = timeline.querySelector(".lanes-window").clientWidth;
  for (const part of timeline.querySelectorAll("[data-at]")) {
    const at = (Number(part.dataset.at) - begin) / wide;
    const width = Number(part.dataset.wide) / wide;
    const gone = at > 1 || at + width < 0;
    part.style.display = gone ? "none" : "";
    if (gone) continue;
    // What began before the window begins at its edge, so that its words can be read.
    const left = Math.max(at, part.classList.contains("part") ? 0 : at);
    part.setAttribute("x", `${100 * left}%`);
    const seen = Math.max(Math.min(at + width, 1) - left, 0.0005);
    part.setAttribute("width", `${100 * seen}%`);
    const words = part.classList.contains("part") && part.querySelector("text");
    if (words) part.classList.toggle("tight", LETTER * words.textContent.length > seen * pixels);
  }
  const zoom = document.querySelector(".zoom output");
  if (zoom) zoom.value = wide < 1 ? `${Math.round(1 / wide)}\u00d7` : "";
  const first = Number(timeline.dataset.begin), last = Number(timeline.dataset.end);
  const ends = timeline.querySelectorAll(".ends time");
  ends.forEach((time, quarter) => {
    time.textContent = instant(first + (last - first) * (begin + (wide * quarter) / (ends.length - 1)));
  });
}

// Where to zoom to: the finding that was last gone to, else the first one in the window, else the middle.
function middle(timeline) {
  const [begin, end] = shownOf.get(timeline) || [0, 1];
  const marks = Array.from(timeline.querySelectorAll("a.mark"));
  const chosen = marks.filter((mark) => mark.hash === location.hash);
  for (const mark of chosen.concat(marks)) {
    const at = (Number(mark.querySelector("[data-at]").dataset.at) - begin) / (end - begin);
    if (at >= 0 && at <= 1) return at;
  }
  return 0.5;
}

// Nanoseconds do not fit into a number; the ends of a window are told to the microsecond.
function instant(nanoseconds) {
  const milliseconds = Math.floor(nanoseconds / 1e6);
  const rest = String(Math.floor(nanoseconds / 1e3) % 1000).padStart(3, "0");
  return new Date(milliseconds).toISOString().replace("T", " ").replace("Z", rest);
}

function move(timeline, what, at = middle(timeline)) {
  let [begin, end] = shownOf.get(timeline) || [0, 1];
  const wide = end - begin;
  const factor = { in: 0.5, out: 2 }[what];
  if (factor) {
    const now = Math.min(Math.max(wide * factor, 1e-6), 1);
    begin = begin + (wide - now) * at;
    end = begin + now;
  } else if (what === "left" || what === "right") {
    const step = (what === "left" ? -0.25 : 0.25) * wide;
    begin += step;
    end += step;
  } else {
    [begin, end] = [0, 1];
  }
  if (begin < 0) [begin, end] = [0, end - begin];
  if (end > 1) [begin, end] = [Math.max(begin - (end - 1), 0), 1];
  shownOf.set(timeline, [begin, end]);
  draw(timeline);
}

const KEYS = { "+": "in", "=": "in", "-": "out", ArrowLeft: "left", ArrowRight: "right", "0": "all", Home: "all" };

for (const timeline of document.querySelectorAll(".timeline")) {
  const window_ = timeline.querySelector(".lanes-window");
  window_.addEventListener("keydown", (event) => {
    const what = KEYS[event.key];
    if (!what || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    move(timeline, what);
  });
  window_.addEventListener("wheel", (event) => {
    if (!event.ctrlKey && !event.shiftKey) return;
    event.preventDefault();
    const box = window_.getBoundingClientRect();
    const turned = event.deltaY || event.deltaX;
    move(timeline, turned < 0 ? "in" : "out", (event.clientX - box.left) / box.width);
  }, { passive: false });
}

const zoom = document.querySelector(".zoom");
if (zoom) {
  zoom.hidden = false;
  zoom.addEventListener("click", (event) => {
    const what = event.target.dataset.zoom;
    if (what) document.querySelectorAll(".timeline").forEach((timeline) => move(timeline, what));
  });
}

// A link to a finding shows it, whatever is folded or filtered away.

function reveal() {
  const target = location.hash && document.getElementById(location.hash.slice(1));
  if (!target) return;
  if (target.classList.contains("away")) form.reset();
  for (let fold = target.closest("details"); fold; fold = fold.parentElement.closest("details")) fold.open = true;
  if (target.classList.contains("finding")) {
    target.tabIndex = -1;
    target.focus({ preventScroll: true });
  }
  setTimeout(() => target.scrollIntoView({ block: "center" }), 0);
}

window.addEventListener("hashchange", reveal);
reveal();

// Keys: j and k go from finding to finding, / searches.

function step(by) {
  const list = found.filter((each) => !each.classList.contains("away") && each.tagName === "ARTICLE");
  if (!list.length) return;
  const at = list.findIndex((each) => each.id === location.hash.slice(1));
  const next = list[Math.min(Math.max(at + by, 0), list.length - 1)];
  location.hash = next.id;
}

document.addEventListener("keydown", (event) => {
  if (event.ctrlKey || event.metaKey || event.altKey || event.target.closest("input, select, textarea")) return;
  if (event.key === "j") step(1);
  else if (event.key === "k") step(-1);
  else if (event.key === "/" && form) { event.preventDefault(); form.elements.text.focus(); }
});
