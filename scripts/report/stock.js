// A line for each building of a stock: sorts, filters, and draws the lines on view alone.
// The page holds the data as JSON, column by column; every text enters as a text node, never as HTML.
// Leaves out: what needs a request. Without a script the page names the CSV file.
"use strict";
(() => {
  const MARGIN = 8;                       // lines drawn beyond each edge of the view
  const PRINTED = 100;                    // lines on paper
  const WIDTH = 120, HEIGHT = 20;         // of a row's line, in units of its own
  const UNKNOWN = "\u2013";
  const SVG = "http://www.w3.org/2000/svg";
  const at = (id) => document.getElementById(id);
  const data = JSON.parse(at("data").textContent);
  const view = at("lines"), body = view.querySelector("tbody"), heads = [...view.querySelectorAll("th")];
  const keys = heads.map((head) => head.dataset.key);
  const levels = new Map([...data.levels].map((level, k) => [level, k]));
  const every = data.name.map((_, k) => k);
  const searched = every.map((k) => [data.name, data.why, data.drift, data.effects]
    .map((column) => column[k]).join("\n").toLowerCase());
  const isNumber = (key) => heads[keys.indexOf(key)].classList.contains("n");
  const orders = new Map();               // column: all lines, ascending; those without a value apart
  let sorted = every, shown = every, rowHeight = 0, printing = false;

  function orderOf(key) {
    if (!orders.has(key)) {
      const column = data[key], words = new Intl.Collator("en", {numeric: true});
      const isKnown = (k) => column[k] !== null && column[k] !== "";
      const compare = isNumber(key) ? (a, b) => column[a] - column[b] : (a, b) => words.compare(column[a], column[b]);
      orders.set(key, {known: every.filter(isKnown).sort(compare), unknown: every.filter((k) => !isKnown(k))});
    }
    return orders.get(key);
  }

  function sort(head) {
    const key = head.dataset.key, last = head.getAttribute("aria-sort");
    const first = isNumber(key) ? "descending" : "ascending";       // the worst, or A
    const other = first === "ascending" ? "descending" : "ascending";
    const direction = last === first ? other : first;
    for (const each of heads) each.setAttribute("aria-sort", each === head ? direction : "none");
    const {known, unknown} = orderOf(key);
    sorted = [...(direction === "ascending" ? known : known.toReversed()), ...unknown];
    filter();
  }

  function filter() {
    const text = at("text").value.trim().toLowerCase(), status = at("status").value;
    shown = sorted.filter((k) => (!status || data.status[k] === status) && searched[k].includes(text));
    at("count").textContent = `${shown.length} of ${every.length}`;
    view.querySelector("table").setAttribute("aria-rowcount", shown.length + 1);
    view.scrollTop = 0;
    draw();
  }

  function element(name, className, text) {
    const made = document.createElement(name);
    if (className) made.className = className;
    if (text !== undefined) made.textContent = text;
    return made;
  }

  function path(days, className) {
    const step = WIDTH / Math.max(1, days.length - 1), top = data.levels.length - 1;
    let text = "", pen = "M";
    [...days].forEach((day, k) => {
      const level = levels.get(day);
      if (level === undefined) { pen = "M"; return; }
      const x = (k * step).toFixed(1), y = (HEIGHT * (1 - level / top)).toFixed(1);
      text += pen === "M" ? `M${x} ${y}h.1` : `L${x} ${y}`;          // a day alone is a dot
      pen = "L";
    });
    const made = document.createElementNS(SVG, "path");
    made.setAttribute("class", className);
    made.setAttribute("d", text);
    return made;
  }

  const date = (day) => {
    const made = new Date(day * 86400000);
    return isNaN(made) ? UNKNOWN : made.toISOString().slice(0, 10);
  };

  function sparkline(k) {
    const cell = element("td", "n"), days = data.measured[k];
    if (!days) { cell.textContent = UNKNOWN; return cell; }
    const drawn = document.createElementNS(SVG, "svg");
    drawn.setAttribute("viewBox", `0 0 ${WIDTH} ${HEIGHT}`);
    drawn.setAttribute("preserveAspectRatio", "none");
    drawn.setAttribute("aria-hidden", "true");
    drawn.append(path(days, "measured"));
    if (data.foretold[k]) drawn.append(path(data.foretold[k], "foretold"));
    const first = data.first_day[k];
    cell.title = `${date(first)} to ${date(first + days.length - 1)}, ${data.least[k]} to ${data.most[k]} kWh/d`;
    cell.append(drawn, number(data.mean[k], data.mean[k] < 100 ? 1 : 0));
    return cell;
  }

  const number = (value, decimals) => value === null ? UNKNOWN : value.toFixed(decimals).replace("-", "\u2212");

  function textCell(key, k) {
    const cell = element(key === "name" ? "th" : "td", "", data[key][k]);
    if (key === "name") cell.scope = "row";
    if (key === "status" && data.status[k] === "failed") cell.className = "bad";
    cell.title = key === "status" ? data.why[k] : data[key][k];
    return cell;
  }

  function cell(key, k) {
    if (key === "mean") return sparkline(k);
    if (!isNumber(key)) return textCell(key, k);
    return element("td", "n", number(data[key][k], key === "nights" || key === "findings" ? 0 : 1));
  }

  function row(place) {
    const made = element("tr");
    made.setAttribute("aria-rowindex", place + 2);
    made.append(...keys.map((key) => cell(key, shown[place])));
    return made;
  }

  function gap(lines) {
    const made = element("tr", "gap"), inside = element("td");
    made.setAttribute("aria-hidden", "true");
    inside.colSpan = keys.length;
    inside.style.height = `${lines * rowHeight}px`;
    made.append(inside);
    return made;
  }

  function draw() {
    const first = printing ? 0 : Math.max(0, Math.floor(view.scrollTop / (rowHeight || 1)) - MARGIN);
    const onView = Math.ceil(view.clientHeight / (rowHeight || 1)) + 2 * MARGIN;
    const end = Math.min(shown.length, printing ? PRINTED : first + onView);
    const rows = [];
    for (let place = first; place < end; ++place) rows.push(row(place));
    body.replaceChildren(gap(first), ...rows, gap(printing ? 0 : shown.length - end));
  }

  function measure() {                    // a line's height, which follows the reader's font
    const one = body.querySelector("tr:not(.gap)");
    if (one) rowHeight = one.getBoundingClientRect().height;
    draw();
  }

  function print(begins) {
    printing = begins;
    at("printed").hidden = !begins || shown.length <= PRINTED;
    at("printed").textContent = `The first ${PRINTED} of ${shown.length} lines.`;
    draw();
  }

  for (const status of [...new Set(data.status)].sort()) at("status").append(element("option", "", status));
  for (const head of heads) head.querySelector("button").addEventListener("click", () => sort(head));
  at("text").addEventListener("input", filter);
  at("status").addEventListener("input", filter);
  view.addEventListener("scroll", () => draw());
  document.querySelector(".ask").addEventListener("submit", (event) => event.preventDefault());
  addEventListener("resize", measure);
  addEventListener("beforeprint", () => print(true));
  addEventListener("afterprint", () => print(false));
  at("view").hidden = false;
  filter();
  measure();
})();
