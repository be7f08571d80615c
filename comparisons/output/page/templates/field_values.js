
"use strict";
// Values of the fields under the pointer, and sections over x at a depth of the reader's choice.
// Without this script the page is whole: what it shows is also in the pictures.
const NOTHING = -32768;
const MODELS = { "half-plane": "#0072B2", "finite elements": "#D55E00", "whole model": "#009E73" };
const DASHES = { "finite elements": "6 3", "whole model": "9 2 2 2" };
const COINCIDE = 0.01; // of the largest value: what is nearer is one line
const MARGIN = { left: 62, right: 12, top: 24, bottom: 40 };

function numbers(text, scale) {
  const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const view = new DataView(bytes.buffer);
  return Float64Array.from({ length: bytes.length / 2 }, (_, k) => {
    const whole = view.getInt16(2 * k, true);
    return whole === NOTHING ? NaN : whole * scale;
  });
}

function nearest(places, wanted) {
  let best = 0;
  places.forEach((place, k) => {
    if (Math.abs(place - wanted) < Math.abs(places[best] - wanted)) best = k;
  });
  return best;
}

function written(value, digits = 4, all = false) {
  if (Number.isNaN(value)) return "–";
  const text = value.toPrecision(digits);
  return (all ? text : Number(text).toString()).replaceAll("-", "−");
}

function look(fields) {
  // of every component and friction: the curves by name, the difference last
  const opened = new Map();
  function curves(component, friction) {
    const key = `${component} ${friction}`;
    if (!opened.has(key)) {
      const kept = fields.components[component].fields[friction];
      const [first, difference] = kept.data.map((text, k) => numbers(text, kept.scale[k]));
      const byName = { [kept.models[0]]: first };
      if (difference) {
        byName[kept.models[1]] = first.map((value, k) => value - difference[k]);
        byName.difference = difference;
      }
      opened.set(key, byName);
    }
    return opened.get(key);
  }

  function said(component, friction, row, column) {
    const at = row * fields.x.length + column;
    const values = Object.entries(curves(component, friction)).map(
      ([name, all]) => `${name} ${written(all[at], name === "difference" ? 2 : 4, true)}\u00a0p₀`,
    );
    const place = `x = ${written(fields.x[column])}\u00a0a, z = ${written(fields.z[row])}\u00a0a`;
    return `${fields.components[component].symbol} at ${place}: ${values.join(", ")}`;
  }

  // The points of a picture down to `deepest` half-widths, as the rows of a CSV file.
  function table(component, friction, deepest) {
    const { symbol } = fields.components[component];
    const all = Object.entries(curves(component, friction));
    const lines = [["x/a", "z/a", ...all.map(([name]) => `"${symbol}/p₀, ${name}"`)].join(",")];
    fields.z.forEach((z, row) => {
      if (z > deepest * (1 + 1e-5)) return;
      fields.x.forEach((x, column) => {
        const at = row * fields.x.length + column;
        const shown = ([, v]) => (Number.isNaN(v[at]) ? "" : Number(v[at].toPrecision(5)));
        lines.push([x, z, ...all.map(shown)].join(","));
      });
    });
    return `${lines.join("\n")}\n`;
  }

  const box = document.querySelector("#look");
  const [component, friction] = box.querySelectorAll("select");
  const [depth, place] = box.querySelectorAll("input");
  const chart = box.querySelector("svg");
  const status = box.querySelector("[role=status]");
  depth.max = fields.z.length - 1;
  place.max = fields.x.length - 1;
  depth.value = nearest(fields.z, fields.start.z);
  place.value = nearest(fields.x, fields.start.x);
  box.hidden = false;

  function add(parent, name, attributes, text) {
    const made = document.createElementNS(chart.namespaceURI, name);
    for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
    if (text !== undefined) made.textContent = text;
    parent.append(made);
    return made;
  }

  // Round steps of an axis, about as many as asked for.
  function ticks(low, high, most) {
    const rough = (high - low) / most || 1;
    const power = 10 ** Math.floor(Math.log10(rough));
    const sizes = [0.5, 1, 2, 5, 10].map((size) => size * power);
    const places = (step) => [Math.ceil(low / step - 1e-9), Math.floor(high / step + 1e-9)];
    const few = sizes.findIndex((size) => size >= rough);
    // one number alone tells no scale
    const step = sizes.slice(0, few + 1).findLast((size) => {
      const [first, last] = places(size);
      return last > first;
    });
    const [first, last] = places(step);
    const count = last - first + 1;
    return Array.from({ length: count }, (_, k) => (first + k) * step);
  }

  function panel(top, height, lines, label, bottomLabel) {
    const width = chart.clientWidth - MARGIN.left - MARGIN.right;
    const low = Math.min(0, ...lines.flatMap(([, v]) => v.filter(Number.isFinite)));
    const high = Math.max(0, ...lines.flatMap(([, v]) => v.filter(Number.isFinite)));
    const room = 0.06 * (high - low) || 1e-12;
    const [least, most] = [low - room, high + room];
    const [left, right] = [fields.x[0], fields.x[fields.x.length - 1]];
    const across = (x) => MARGIN.left + ((x - left) / (right - left)) * width;
    const up = (value) => top + (1 - (value - least) / (most - least)) * height;
    for (const tick of ticks(least, most, height / 24)) {
      const y = up(tick);
      add(chart, "line", { x1: MARGIN.left, x2: MARGIN.left + width, y1: y, y2: y, class: "grid" });
      add(chart, "text", { x: MARGIN.left - 6, y: y + 4, "text-anchor": "end" }, written(tick, 3));
    }
    for (const tick of ticks(left, right, width / 80)) {
      const x = across(tick);
      add(chart, "line", { x1: x, x2: x, y1: top, y2: top + height, class: "grid" });
      if (bottomLabel) {
        add(chart, "text", { x, y: top + height + 16, "text-anchor": "middle" }, written(tick, 3));
      }
    }
    for (const [name, values] of lines) {
      let drawn = "";
      values.forEach((value, k) => {
        if (Number.isNaN(value)) return;
        const pen = drawn === "" || Number.isNaN(values[k - 1]) ? "M" : "L";
        drawn += `${pen}${across(fields.x[k]).toFixed(1)} ${up(value).toFixed(1)}`;
      });
      add(chart, "path", {
        d: drawn,
        fill: "none",
        stroke: MODELS[name] ?? "#222222",
        "stroke-width": 1.5,
        "stroke-dasharray": DASHES[name] ?? "none",
      });
    }
    const x = across(fields.x[Number(place.value)]);
    add(chart, "line", { x1: x, x2: x, y1: top, y2: top + height, class: "cursor" });
    add(chart, "text", { x: 0, y: top - 8 }, label);
    if (bottomLabel) {
      const middle = MARGIN.left + 0.5 * width;
      add(chart, "text", { x: middle, y: top + height + 33, "text-anchor": "middle" }, bottomLabel);
    }
    return across;
  }

  function draw() {
    const row = Number(depth.value);
    const all = curves(Number(component.value), Number(friction.value));
    const cut = ([name, values]) => [
      name,
      Array.from(values.subarray(row * fields.x.length, (row + 1) * fields.x.length)),
    ];
    const lines = Object.entries(all).map(cut);
    let models = lines.filter(([name]) => name !== "difference");
    const difference = lines.filter(([name]) => name === "difference");
    // curves that coincide are one line
    const most = (values) => Math.max(...values.filter(Number.isFinite).map(Math.abs), 0);
    const coincide = difference.length && most(difference[0][1]) <= COINCIDE * most(models[0][1]);
    const legend = coincide ? models.map(([name]) => name).join(" = ") : null;
    if (coincide) models = [models[0]];
    const symbol = fields.components[Number(component.value)].symbol;
    chart.replaceChildren();
    const last = "x/a";
    panel(MARGIN.top, 190, models, `${symbol}/p₀`, difference.length ? "" : last);
    if (difference.length) panel(MARGIN.top + 226, 90, difference, `Δ${symbol}/p₀`, last);
    let x = MARGIN.left + 20;
    for (const [name] of models) {
      const style = { stroke: MODELS[name], "stroke-width": 2 };
      const dashes = DASHES[name] ?? "none";
      add(chart, "line", { x1: x, x2: x + 24, y1: 12, y2: 12, ...style, "stroke-dasharray": dashes });
      add(chart, "text", { x: x + 30, y: 16 }, legend ?? name);
      x += 118;
    }
    depth.nextElementSibling.value = `z = ${written(fields.z[row], 3)} a`;
    place.nextElementSibling.value = `x = ${written(fields.x[Number(place.value)], 3)} a`;
    status.textContent = said(
      Number(component.value), Number(friction.value), row, Number(place.value));
  }

  for (const control of [component, friction, depth, place]) {
    control.addEventListener("input", draw);
  }
  chart.addEventListener("pointermove", (event) => {
    const width = chart.clientWidth - MARGIN.left - MARGIN.right;
    const share = (event.clientX - chart.getBoundingClientRect().left - MARGIN.left) / width;
    const [left, right] = [fields.x[0], fields.x[fields.x.length - 1]];
    place.value = nearest(fields.x, left + share * (right - left));
    draw();
  });
  new ResizeObserver(draw).observe(box);

  const tip = document.createElement("div");
  tip.className = "tip";
  tip.hidden = true;
  document.body.append(tip);
  for (const picture of document.querySelectorAll("img[data-field]")) {
    const drawn = JSON.parse(picture.dataset.field);
    const link = document.createElement("a");
    const rows = fields.z.filter((z) => z <= drawn.z[1] * (1 + 1e-5)).length;
    link.className = "data";
    link.textContent = `CSV, ${fields.x.length} × ${rows} points`;
    link.href = "#look";
    link.download = `${fields.components[drawn.component].symbol}.csv`;
    link.addEventListener("click", () => {
      const content = table(drawn.component, drawn.friction, drawn.z[1]);
      link.href = URL.createObjectURL(new Blob([content], { type: "text/csv;charset=utf-8" }));
    });
    picture.closest("figure").querySelector("figcaption").append(" ", link);
    picture.addEventListener("pointerleave", () => (tip.hidden = true));
    picture.addEventListener("pointermove", (event) => {
      const frame = picture.getBoundingClientRect();
      const across = (event.clientX - frame.left) / frame.width;
      const down = (event.clientY - frame.top) / frame.height;
      const hit = drawn.boxes.find(
        ([x, y, w, h]) => across >= x && across <= x + w && down >= y && down <= y + h);
      tip.hidden = !hit;
      if (!hit) return;
      const [x, y, w, h] = hit;
      const column = nearest(
        fields.x, drawn.x[0] + ((across - x) / w) * (drawn.x[1] - drawn.x[0]));
      const row = nearest(fields.z, drawn.z[0] + ((down - y) / h) * (drawn.z[1] - drawn.z[0]));
      tip.textContent = said(drawn.component, drawn.friction, row, column);
      const beside = Math.min(event.clientX + 14, window.innerWidth - tip.offsetWidth - 8);
      tip.style.left = `${Math.max(8, beside)}px`;
      tip.style.top = `${event.clientY + 18}px`;
    });
  }
}

const kept = document.querySelector("#fields");
if (kept) look(JSON.parse(kept.textContent));
