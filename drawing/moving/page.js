// The page that moves: what a program has found is drawn again at every place of its driver.
const W = D.words, $ = id => document.getElementById(id), SVG = "http://www.w3.org/2000/svg";
const LETTER = 4.6, READABLE = 9, SEEN = 12; // mm, and pixels that letters have at least

// ---- numbers and words
const plain = new Map(D.quantities.map(q => [q.name, q]));
function asked(spec) {
  const [kind, ...of] = spec, found = here.found, mu = of.length > 1 && views.has(of[1]) ? views.get(of[1]).mu : 1;
  if (kind === "given") return said(given[of[0]], 6);
  if (kind === "mm") return long(Math.abs(size(value(found, of[0]))) / mu);
  const mm = views.get("position").mu;
  if (kind === "x" || kind === "y") return long(spot(found, of[0])[kind === "x" ? 0 : 1] / mm);
  if (kind === "apart") { const [a, b] = of.slice(0, 2).map(name => spot(found, name)); return long(Math.hypot(a[0] - b[0], a[1] - b[1]) / (of[2] ? views.get(of[2]).mu : mm)); }
  if (kind === "place") return shownAt(here.at);
  if (kind === "mu") return said(views.get(of[0]).mu * views.get(of[0]).by, 6);
  const q = plain.get(of[0]), v = value(found, of[0]);
  if (kind === "sense") return v > 0 ? D.senses[0] : v < 0 ? D.senses[1] : "–";
  return said(size(v) * (q ? q.by : 1));
}
const filled = html => html.replace(/[\ue000-\uf8ff]/g, sign => asked(D.asked[sign.charCodeAt(0) - 0xe000]));

// ---- shapes
const element = tag => document.createElement(tag);
function make(tag, attributes, parent) {
  const node = document.createElementNS(SVG, tag);
  for (const [key, text] of Object.entries(attributes)) node.setAttribute(key, text);
  if (parent) parent.appendChild(node);
  return node;
}
const set = (node, attributes) => { for (const key in attributes) node.setAttribute(key, attributes[key]); };
const line = (node, a, b) => set(node, { x1: a[0].toFixed(3), y1: (-a[1]).toFixed(3), x2: b[0].toFixed(3), y2: (-b[1]).toFixed(3) });
const round = points => points.map(([x, y]) => `${x.toFixed(3)},${(-y).toFixed(3)}`).join(" ");
function letters(html, parent, attributes, high = LETTER) { // scripts, slanted letters and bars as runs of one text
  const text = make("text", attributes, parent), holder = element("template");
  holder.innerHTML = html;
  let drop = 0, count = 0;
  text.down = text.up = 0.55; // letters; indices and bars reach farther
  (function walk(node, style) {
    for (const child of node.childNodes) {
      if (child.nodeType === 3) {
        const run = make("tspan", {}, text), by = style.drop - drop;
        run.textContent = child.textContent;
        if (by) run.setAttribute("dy", by.toFixed(2));
        if (style.small) run.setAttribute("font-size", (high * 0.72).toFixed(2));
        if (style.slanted) run.setAttribute("font-style", "italic");
        if (style.over) run.setAttribute("text-decoration", "overline");
        if (style.drop > 0) text.down = 0.75;
        if (style.over || style.drop < 0) text.up = 0.65;
        drop = style.drop;
        count += child.textContent.length * (style.small ? 0.72 : 1);
      } else {
        const tag = child.tagName, script = tag === "SUB" || tag === "SUP";
        walk(child, {
          drop: style.drop + (tag === "SUB" ? high * 0.3 : tag === "SUP" ? -high * 0.4 : 0), small: style.small || script,
          slanted: style.slanted || tag === "I", over: style.over || child.className === "bar",
        });
      }
    }
  })(holder.content, { drop: 0, small: false, slanted: false, over: false });
  text.wide = count * high * 0.63;
  return text;
}
function arrow(node, a, b, head = 3.5) {
  const e = unit(sub(b, a)), n = [-e[1], e[0]], long = Math.min(head, Math.hypot(...sub(b, a)) / 2), foot = add(b, e, -long);
  node.setAttribute("points", round([b, add(foot, n, long / 6), add(foot, n, -long / 6)]));
  return foot;
}
const named = (text, a, b) => { // a vector that is hardly seen has its letter when it is pointed at
  const short = Math.hypot(...sub(b, a)) < READABLE && !text.classList.contains("lit");
  text.classList.toggle("short", short);
  return short ? null : { text, a, b };
};
const joined = (s, n, p) => { const ends = [p(s.a), p(s.b)]; line(n, ...ends); return [ends]; };
const arrowed = (g, s, high) => { const group = make("g", {}, g); make("line", { class: "main" }, group); make("polygon", { class: "solid" }, group); group.letter = letters(s.text, g, {}, high); return group; };
const lettered = (kind, r) => ({ z: 4, make: (g, s, high) => { const c = make("circle", { class: kind, r }, g); c.letter = letters(s.text, g, {}, high); return c; },
  draw: (s, n, p) => { const at = p(s.at); set(n, { cx: at[0], cy: -at[1] }); s.label = { text: n.letter, a: at }; return []; } });
const HANG = 16, DRAW = { // how each kind of shape is made, and how it is drawn again
  bar: { z: 2, make: (g, s) => make("line", { class: s.lit ? "main now" : "main" }, g), draw: joined },
  side: { z: 1, make: (g, s) => make("line", { class: s.main ? "main" : "thin" }, g), draw: joined },
  line: { z: 0, make: g => make("line", { class: "thin" }, g), draw: (s, n, p, v) => {
    const a = p(s.a), b = p(s.b), u = v(s.u), along = dot(sub(b, a), u), e = along < 0 ? -8 : 8;
    const ends = [Math.abs(along) < 1 ? add(b, u, -10) : a, add(b, u, Math.abs(along) < 1 ? 10 : e)]; line(n, ...ends); return [[...ends, THIN]];
  } },
  vector: { z: 2, make: arrowed,
    draw: (s, n, p) => { const a = p(s.a), b = p(s.b); line(n.firstChild, a, arrow(n.lastChild, a, b)); s.label = named(n.letter, a, b); return [[a, b]]; } },
  force: { z: 2, make: arrowed,
    draw: (s, n, p, v) => { const a = p(s.at), f = v(s.v), none = !(size(f) > 1e-12), reach = s.long ? size(f) * s.long / views.get("position").force : HANG, b = add(a, unit(f), reach); n.style.display = n.letter.style.display = none ? "none" : "";
      if (none) { s.label = null; return []; } line(n.firstChild, a, arrow(n.lastChild, a, b)); s.label = { text: n.letter, a: add(a, unit(f), reach * 0.6), b }; return [[a, b]]; } },
  arm: { z: 0, make: g => make("g", {}, g), draw: (s, n, p, v) => {
    if (!n.firstChild) { make("line", { class: "thin" }, n); make("line", { class: "thin" }, n); }
    const at = p(s.at), pole = p(s.pole), e = unit(v(s.v)), foot = add(at, e, dot(sub(pole, at), e));
    line(n.firstChild, pole, foot); line(n.lastChild, at, foot); return [[pole, foot, THIN], [at, foot, THIN]];
  } },
  guide: { z: 0, make: g => make("path", { class: "thin" }, g), draw: (s, n, p, v) => {
    if (s.mu === here.mu && s.drawn === here.samples) return s.sides;
    s.mu = here.mu; s.drawn = here.samples;
    const u = unit(v(s.u)), at = p(s.at), way = here.samples.filter(f => f[0] < FAILED).map(f => dot(sub(spot(f, s.at).map(x => x / here.mu), at), u));
    const low = Math.min(...way) - 9, high = Math.max(...way) + 9, down = u[0] > 1e-9 || (Math.abs(u[0]) <= 1e-9 && u[1] < 0) ? -1 : 1, w = [-u[1] * down, u[0] * down];
    let d = "", base = add(at, w, 3);
    const a = add(base, u, low), b = add(base, u, high);
    d += `M${round([a])}L${round([b])}`;
    for (let x = low + 1; x < high; x += 3) { const c = add(base, u, x); d += `M${round([c])}L${round([add(add(c, w, 2), u, -2)])}`; }
    n.setAttribute("d", d); return s.sides = [[a, b], [add(a, w, 2), add(b, w, 2)]];
  } },
  corner: { z: 3, make: g => make("polygon", { class: "solid" }, g), draw: (s, n, p) => {
    const at = p(s.at), [a, b] = s.ends.map(end => unit(sub(p(end), at)));
    n.setAttribute("points", round([add(at, a, 1.6), add(at, a, 4.5), add(at, b, 4.5), add(at, b, 1.6)])); return [];
  } },
  block: { z: 3, make: g => make("polygon", { class: "paper" }, g), draw: (s, n, p, v) => {
    const at = p(s.at), u = unit(v(s.u)), w = [-u[1], u[0]];
    const corners = [[5, 3], [5, -3], [-5, -3], [-5, 3]].map(([x, y]) => add(add(at, u, x), w, y));
    n.setAttribute("points", round(corners)); return corners.map((end, k) => [end, corners[(k + 1) % 4], CUTS]);
  } },
  body: { z: 0, make: (g, s, high, view) => { // an outline that turns as a whole, so often about its centre
      let d = "";
      const outline = s.of && here.changed ? Array.from({ length: 4 * COUNT }, (_, k) => { const found = stand(place(k / 4)); return s.of.map(name => value(found, name)); }) : s.d;
      for (let k = 0; k < (s.times || 1); k++) {
        const c = Math.cos(TURN * k / (s.times || 1)), e = Math.sin(TURN * k / (s.times || 1));
        d += (d ? "L" : "M") + round(outline.map(([x, y]) => [(x * c - y * e) / view.mu, (x * e + y * c) / view.mu])).replace(/ /g, "L");
      }
      return make("path", { class: s.class, d: d + (s.open ? "" : "Z") }, g);
    },
    draw: (s, n, p, v) => { const [x, y] = p(s.at), [c, e] = v(s.turn), by = s.by || 0;
      n.setAttribute("transform", `translate(${x.toFixed(3)} ${(-y).toFixed(3)}) rotate(${(-(Math.atan2(e, c) + by) * 180 / Math.PI).toFixed(4)})`); return []; } },
  disk: { z: 3, make: (g, s, high, view) => make("circle", { class: (s.class || "paper") + (s.lit ? " now" : ""), r: sized(s.r) / view.mu }, g), draw: (s, n, p) => { const [x, y] = p(s.at); set(n, { cx: x, cy: -y }); return []; } },
  bent: { z: 2, make: g => make("polyline", { class: "main" }, g), draw: (s, n, p, v) => { // a beam as far off as a force bends it
    const w = v(s.v) * given.times; n.setAttribute("points", round(s.d.map(([x, y], k) => [x / here.mu, (y + s.by[k] * w) / here.mu]))); return []; } },
  moment: { z: 5, make: (g, s) => { const group = make("g", { class: "lit" }, g); make("line", { class: "main lit", y1: -s.low, y2: -s.high }, group); for (const name of s.of) make("circle", { class: "spot", r: 1.6 }, group); return group; },
    draw: (s, n, p, v) => { const x = here.at * s.x; set(n.firstChild, { x1: x, x2: x }); s.of.forEach((name, k) => set(n.children[k + 1], { cx: x, cy: -v(name) * s.y })); return []; } },
  box: { z: 3, make: (g, s, high, view) => make("rect", { class: "paper", width: s.wide / view.mu, height: s.high / view.mu }, g), draw: (s, n, p) => { const [x, y] = p(s.at); const w = s.wide / here.mu / 2, h = s.high / here.mu; set(n, { x: x - w, y: -y - h }); return [[[x - w, y], [x - w, y + h]], [[x + w, y], [x + w, y + h]]]; } },
  pin: { z: 4, make: (g, s) => make("circle", { class: s.lit ? "paper now" : "paper", r: s.r || 1.4 }, g), draw: (s, n, p) => { const [x, y] = p(s.at); set(n, { cx: x, cy: -y }); return []; } },
  pivot: { z: 4, make: g => { const group = make("g", {}, g); make("path", { class: "main", d: "M0 0L-3 6H3Z" }, group); make("path", { class: "thin", d: "M-5 6H5M-4 6l-2 2M-1 6l-2 2M2 6l-2 2M5 6l-2 2" }, group); make("circle", { class: "paper", r: 1.4 }, group); return group; },
    draw: (s, n, p) => { const [x, y] = p(s.at); n.setAttribute("transform", `translate(${x.toFixed(3)} ${(-y).toFixed(3)})`); return []; } },
  centre: { z: 4, make: g => make("circle", { class: "solid", r: 1 }, g), draw: (s, n, p) => { const [x, y] = p(s.at); set(n, { cx: x, cy: -y }); return []; } },
  pole: lettered("paper", 0.9),
  mark: lettered("solid", 0.5),
  letter: { z: 5, make: (g, s, high) => letters(s.text, g, {}, high), draw: (s, n, p) => { s.label = { text: n, a: p(s.at) }; return []; } },
  number: { z: 5, make: (g, s, high) => letters(s.text, g, {}, high), draw: (s, n, p) => { s.label = { text: n, a: p(s.ends[0]), b: p(s.ends[1]), off: 3 }; return []; } },
};
function build(view, svg) {
  svg.replaceChildren();
  view.shows = undefined;
  set(svg, { viewBox: view.box.map(x => x.toFixed(2)).join(" "), "aria-label": filled(view.heading).replace(/<[^>]+>/g, "") });
  svg.style.setProperty("--wide", `${view.box[2].toFixed(1)}mm`);
  view.letter = Math.max(LETTER, SEEN * view.box[2] / (svg.clientWidth || 600));
  svg.style.fontSize = `${view.letter.toFixed(2)}px`;
  view.lines = (view.drawn || []).map(([from, kind, ...of]) => {
    if (kind !== "text") return [from, make("path", { class: kind, d: of[0] }, svg)];
    const [html, x, y, angle, high, anchor] = of, text = letters(html, svg, { "text-anchor": anchor, "font-size": high * 1.3 }, high * 1.3);
    set(text, { transform: `translate(${x} ${y}) rotate(${angle})` });
    return [from, text];
  });
  if (view.frame && svg.getBBox) { // letters are wider than those of the sheet
    const { x, y, width, height } = svg.getBBox(), [x0, y0, wide, high] = view.frame, low = [Math.min(x, x0), Math.min(y, y0)];
    view.box = [...low, Math.max(x + width + 2, x0 + wide) - low[0], Math.max(y + height, y0 + high) - low[1]];
    svg.setAttribute("viewBox", view.box.map(x => x.toFixed(2)).join(" "));
  }
  const layers = [0, 1, 2, 3, 4, 5].map(() => make("g", {}, svg));
  for (const shape of view.shapes) {
    shape.node = DRAW[shape.k].make(layers[DRAW[shape.k].z], shape, view.letter, view);
    if (shape.node.letter) layers[5].appendChild(shape.node.letter); // nothing covers a letter
    shape.lights = lights(shape);
    for (const node of [shape.node, shape.node.letter]) if (node) {
      node.addEventListener("pointerenter", () => light(shape.lights));
      node.addEventListener("pointerleave", () => light([]));
    }
  }
  view.points_first = ["letter", "pole", "mark", "number", "force", "vector"].flatMap(kind => view.shapes.filter(shape => shape.k === kind));
  view.svg = svg;
  if (view.name === "position" && drive.crank) grip(view, svg);
}
const bare = name => String(name).replace(/^.*\./, "");
function lights(shape) { // points, links and vectors that belong together
  const found = [];
  if (shape.q) found.push(shape.q);
  if (shape.link !== undefined) found.push(`link ${shape.link}`, `omega_${shape.link}`, `epsilon_${shape.link}`);
  if (typeof shape.at === "string" && ["pin", "pivot", "mark", "letter", "centre", "block"].includes(shape.k)) found.push(`point ${bare(shape.at)}`, `V_${bare(shape.at)}`, `a_${bare(shape.at)}`);
  return found;
}
function light(names) {
  const wanted = new Set(names);
  for (const view of shownViews()) for (const shape of view.shapes) {
    const on = shape.lights.some(name => wanted.has(name));
    for (const node of [shape.node, ...(shape.node.children || []), shape.node.letter]) if (node) node.classList.toggle("lit", on);
  }
  for (const row of $("values").tBodies[0].rows) row.classList.toggle("lit", wanted.has(row.dataset.q));
  if (here.found) for (const view of shownViews()) draw(view);
}
const shownViews = () => [...new Set([views.get("position"), views.get($("which").value)])].filter(view => view && view.svg);

// ---- letters beside what they name, away from lines and from one another
const COVERS = 6, CUTS = 1.5, THIN = 0.5, AROUND = Array.from({ length: 12 }, (_, k) => [Math.cos(k * Math.PI / 6), Math.sin(k * Math.PI / 6)]);
function settle(view, segments) { // those without a clear place once more, before all others
  const order = view.points_first.filter(shape => shape.label && !shape.hidden), sum = all => all.reduce((n, one) => n + one.cost, 0);
  const first = placing(view, segments, order), hard = first.flatMap(one => one.cost < CUTS ? [] : one.shape);
  const again = hard.length ? placing(view, segments, new Set([...hard, ...order])) : first;
  for (const { shape, at, k, crowded } of sum(again) < sum(first) ? again : first) {
    const { text } = shape.label;
    shape.tried = k;
    if (text.classList.toggle("crowded", crowded)) continue;
    set(text, { x: (at[0] - text.wide / 2).toFixed(2), y: (-at[1] + view.letter * (0.36 + (text.up - text.down) / 2)).toFixed(2) });
  }
}
function placing(view, segments, order) {
  const taken = [], placed = [];
  if (view.grip) { const [x, y] = spot(here.found, drive.crank[1]).map(z => z / view.mu); taken.push([x - 5, y - 5, x + 5, y + 5]); }
  for (const shape of order) {
    const label = shape.label, wide = label.text.wide, high = view.letter * (label.text.down + label.text.up), tries = [];
    if (label.b) {
      const e = unit(sub(label.b, label.a)), n = [-e[1], e[0]], off = (label.off || 1.4) + Math.abs(n[0]) * wide / 2 + Math.abs(n[1]) * high / 2;
      for (const part of [0.5, 0.35, 0.65, 0.2, 0.8]) for (const way of [1, -1]) for (const more of [0, high]) { const foot = add(label.a, sub(label.b, label.a), part); tries.push([add(foot, n, way * (off + more)), foot]); }
    } else for (const far of [2.4, 4.2, 6.4, 9]) for (const e of AROUND) tries.push([add(label.a, [e[0] * (far + wide / 2), e[1] * (far + high / 2)]), label.a]);
    let best = null;
    const attempt = k => {
      const [at, foot] = tries[k], near = add(foot, sub(at, foot), 0.05), box = [at[0] - wide / 2, at[1] - high / 2, at[0] + wide / 2, at[1] + high / 2];
      let cost = k * 0.02;
      for (const other of taken) if (box[1] < other[3] && other[1] < box[3]) { // two in a row must not read as one word
        const gap = Math.max(box[0] - other[2], other[0] - box[2]);
        cost += gap < 0 ? COVERS : gap < 0.5 * view.letter ? 1 : 0;
      }
      for (const [a, b, by] of segments) cost += crosses(a, b, box) ? by || CUTS : !by && meet(a, b, near, at) ? label.b ? 2 * CUTS : CUTS : 0; // beyond a line it is read as that line's
      if (!best || cost < best.cost) best = { shape, cost, at, box, k };
    };
    if (shape.tried < tries.length) attempt(shape.tried); // where it was it stays as long as it is clear there
    if (!best || best.cost >= THIN) for (let k = 0; k < tries.length && !(best && best.cost < k * 0.02); k++) attempt(k);
    best.crowded = best.cost >= 2 * CUTS && !label.text.classList.contains("lit"); // it is read when it is pointed at
    if (!best.crowded) taken.push(best.box);
    placed.push(best);
  }
  return placed;
}
function draw(view) {
  const mu = here.mu = view.mu, found = here.found, segments = [];
  const p = end => { const [x, y] = spot(found, end); return [x / mu, y / mu]; }, v = name => value(found, name);
  if (view.lines.length && view.shows !== view.until) {
    view.shows = view.until;
    for (const [from, node] of view.lines) node.classList.toggle("gone", view.until !== undefined && from > view.until);
  }
  for (const shape of view.shapes) {
    const [of, low, high] = shape.when || [], away = of && !(v(of) >= low && v(of) <= high);
    const hide = away || (view.until !== undefined && shape.from > view.until);
    for (const node of [shape.node, shape.node.letter]) if (node) node.classList.toggle("gone", hide);
    shape.hidden = hide; shape.label = null;
    for (const segment of DRAW[shape.k].draw(shape, shape.node, p, v)) if (!hide) segments.push(segment);
  }
  settle(view, segments);
}

// ---- the crank that can be taken
function grip(view, svg) {
  const node = view.grip = make("circle", { class: "grip", r: 5, tabindex: 0, role: "slider", "aria-label": W.crank }, svg);
  const goal = event => {
    const at = new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.getScreenCTM().inverse());
    let best = null;
    const near = k => {
      const found = Number.isInteger(k) ? here.samples[k] : stand(place(k));
      if (found[0] >= FAILED) return;
      const [x, y] = spot(found, drive.crank[1]).map(z => z / view.mu), far = Math.hypot(x - at.x, -y - at.y);
      if (!best || far < best.far) best = { far, k };
    };
    for (let k = 0; k <= COUNT; k++) near(k);
    if (!best) return;
    for (let n = -9, k = best.k; n < 10; n++) if (k + n / 10 >= 0 && k + n / 10 <= COUNT && n) near(k + n / 10);
    go(place(best.k));
  };
  node.addEventListener("pointerdown", event => { pause(); node.setPointerCapture(event.pointerId); event.preventDefault(); node.focus(); });
  node.addEventListener("pointermove", event => { if (node.hasPointerCapture(event.pointerId)) goal(event); });
  node.addEventListener("keydown", event => nudge(event, drive.sense));
}

function nudge(event, sense) { // a degree, or a part of the span; with Shift a tenth of it, for the ends of strokes
  const by = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1, PageUp: 10, PageDown: -10 }[event.key];
  if (!by) return;
  pause(); go(here.at + sense * by * (event.shiftKey ? 0.1 : 1) * (drive.turns ? Math.PI / 180 : span / 360)); event.preventDefault();
}

// ---- one place
const TURN = 2 * Math.PI;
function go(at) {
  if (drive.turns) { at = at % TURN; if (at < 0) at += TURN; } else at = Math.min(Math.max(at, drive.low), drive.high);
  const found = stand(at);
  here.at = at;
  $("place").value = shownPlace(at);
  $("at").textContent = `= ${shownAt(at)}`;
  const failed = found[0] >= FAILED;
  $("status").textContent = failed ? found[0] === 3 ? W.apart : W.singular : performance.now() < here.told_until ? here.passed : found[0] === 1 ? W.flat : "";
  for (const view of shownViews()) view.svg.classList.toggle("faded", failed);
  if (failed && here.found) { numbers(true); now(); return; }
  here.found = found;
  for (const view of shownViews()) draw(view);
  const view = views.get("position");
  if (view.grip) { const [x, y] = spot(found, drive.crank[1]); set(view.grip, { cx: x / view.mu, cy: -y / view.mu, "aria-valuenow": shownPlace(at).toFixed(drive.digits), "aria-valuetext": shownAt(at), "aria-valuemin": drive.turns ? 0 : shownPlace(drive.low).toFixed(drive.digits), "aria-valuemax": drive.turns ? 360 : shownPlace(drive.high).toFixed(drive.digits) }); }
  numbers(); now();
}
function numbers(none) { // where a position has no plan nothing has a value
  $("told").classList.toggle("faded", Boolean(none));
  for (const row of $("values").tBodies[0].rows) {
    const q = plain.get(row.dataset.q), v = size(value(here.found, q.name)), view = views.get(q.plan);
    row.cells[1].textContent = none ? "–" : said(v * q.by);
    row.cells[3].textContent = none || !view ? "" : long(Math.abs(v) / view.mu);
  }
  if (here.told && !none) for (const [item, html] of here.told) item.innerHTML = filled(html);
}

// ---- play at the speed of the task, slowed by a stated factor
let playing = null, way = 1, slow = 1;
function slowed() {
  const period = (drive.turns ? TURN : drive.again || 2 * span) / drive.speed;
  slow = period < 6 ? nice(6 / period) : 1;
  $("slow").textContent = slow > 1 ? W.slow.replace("{n}", said(slow)) : "";
}
function pause() { if (playing) cancelAnimationFrame(playing); playing = null; $("play").setAttribute("aria-pressed", "false"); $("play").textContent = W.play; }
function play() {
  let before = performance.now();
  $("play").setAttribute("aria-pressed", "true"); $("play").textContent = W.pause;
  const tick = time => {
    let at = here.at + (drive.turns ? drive.sense : way) * drive.speed * Math.min(time - before, 100) / 1000 / slow;
    before = time;
    if (drive.again && at > drive.high) at -= drive.again; // the next one takes its place
    if (!drive.turns && !drive.again && (at >= drive.high || at <= drive.low)) way = at >= drive.high ? -1 : 1;
    const gap = stand(at)[0], from = at;
    for (let n = 0; n < COUNT && stand(at)[0] >= FAILED; n++) { // positions without a plan are passed by
      at += (drive.turns ? drive.sense * TURN : way * span) / COUNT;
      if (!drive.turns && (at > drive.high || at < drive.low)) { way = -way; at = Math.min(Math.max(at, drive.low), drive.high); }
    }
    if (gap >= FAILED) { // and told
      here.passed = W.passed.replace("{from}", shownAt(from)).replace("{to}", shownAt(at)) + " " + (gap === 3 ? W.apart : W.singular);
      here.told_until = performance.now() + 2500;
    }
    go(at);
    playing = requestAnimationFrame(tick);
  };
  playing = requestAnimationFrame(tick);
}

// ---- diagrams over the cycle
const shown = new Set(D.shown);
function curves() {
  $("diagrams").replaceChildren();
  here.marks = [];
  const wide = 240, high = 46, from = drive.turns ? 0 : drive.low;
  const order = here.samples.map((found, k) => [drive.turns ? ((place(k) % TURN) + TURN) % TURN : place(k), found]).sort((a, b) => a[0] - b[0]);
  for (const name of shown) {
    const q = plain.get(name);
    if (!q) continue;
    const points = order.map(([at, found]) => [at, found[0] < FAILED ? size(value(found, name)) * q.by : NaN]).filter(([, y]) => y === y);
    const ys = points.map(point => point[1]).sort((a, b) => a - b);
    let low = Math.min(0, ys[0]), top = Math.max(0, ys[ys.length - 1]);
    const usual = Math.max(Math.abs(ys[Math.floor(ys.length * 0.05)]), Math.abs(ys[Math.floor(ys.length * 0.95)])) * 3;
    if (usual > 0) { low = Math.max(low, -usual); top = Math.min(top, usual); }
    if (!(top > low)) top = low + 1;
    const X = at => 22 + (wide - 30) * (at - from) / (drive.turns ? TURN : span), Y = y => 6 + (high - 12) * (top - Math.min(Math.max(y, low), top)) / (top - low);
    const svg = make("svg", { viewBox: `0 0 ${wide} ${high}`, role: "img", "aria-label": name }, $("diagrams"));
    make("path", { class: "thin", d: `M20 ${Y(0)}H${wide - 4}M22 3V${high - 3}` }, svg);
    for (let k = 0; k <= 12 && drive.turns; k++) { make("path", { class: "thin", d: `M${X(k * TURN / 12)} ${Y(0) - 1}v2` }, svg); if (k && k % 3 === 0) letters(String(k * 30) + "°", svg, { x: X(k * TURN / 12) - 4, y: Math.min(Y(0) + 5, high - 1) }); }
    if (!drive.turns) for (const [at, x] of [[drive.low, 22], [drive.high, wide - 8]]) letters(shownAt(at), svg, { x, y: Math.min(Y(0) + 5, high - 1), "text-anchor": at === drive.low ? "start" : "end" });
    letters(q.symbol + (q.unit && ", " + q.unit), svg, { x: 24, y: 5 });
    for (const [y, at] of [[top, 0], [low, 0]]) if (y) letters(said(y, 3), svg, { x: 0, y: Y(y) + 1.5 });
    let d = "", last = null;
    for (const [at, y] of points) { d += `${last !== null && at - last < (drive.turns ? TURN : span) / COUNT * 2.5 ? "L" : "M"}${X(at).toFixed(2)} ${Y(y).toFixed(2)}`; last = at; }
    make("path", { class: drive.grows ? "thin" : "curve", d }, svg);
    const grown = drive.grows ? make("rect", { x: 22, y: 0, width: 0, height: high }, make("clipPath", { id: `grown-${name}` }, svg)) : null;
    if (grown) make("path", { class: "curve", d, "clip-path": `url(#grown-${name})` }, svg); // the curve until now
    const mark = make("line", { class: "main lit", y1: 3, y2: high - 3 }, svg), dotted = make("circle", { class: "spot", r: 1.6 }, svg);
    here.marks.push({ name, q, X, Y, mark, dotted, grown });
  }
}
function now() {
  for (const { name, q, X, Y, mark, dotted, grown } of here.marks || []) {
    const x = X(here.at);
    if (grown) grown.setAttribute("width", Math.max(x - 22, 0));
    set(mark, { x1: x, x2: x });
    set(dotted, { cx: x, cy: Y(size(value(here.found, name)) * q.by) });
  }
}

// ---- the construction told and drawn again, step by step
function tell() {
  const view = views.get($("replayed").value), list = $("told");
  if (!view) { $("told").closest("section").classList.add("gone"); return; }
  list.replaceChildren();
  here.told = view.steps.map((html, k) => {
    const item = element("li");
    item.addEventListener("click", () => replay(k + 1));
    list.appendChild(item);
    return [item, html];
  });
  if (view.name !== "position" && $("which").value !== view.name) { $("which").value = view.name; right(); }
  replay(view.until);
}
function replay(count) {
  const view = views.get($("replayed").value), most = view.steps.length;
  for (const other of D.views) if (other !== view) other.until = undefined;
  for (const side of ["left", "right"]) $(side).closest("figure").classList.toggle("replayed", (view.name === "position") === (side === "left"));
  view.until = count === undefined ? undefined : Math.min(Math.max(count, 0), most);
  if (view.until !== undefined && view.name !== "position" && $("which").value !== view.name) { $("which").value = view.name; right(); }
  here.told.forEach(([item], k) => {
    item.classList.toggle("now", view.until === k + 1);
    item.classList.toggle("later", view.until !== undefined && k >= view.until);
    if (view.until === k + 1) { item.setAttribute("aria-current", "step"); $("told").scrollTop = item.offsetTop - $("told").offsetTop - 40; } else item.removeAttribute("aria-current");
  });
  go(here.at);
}

// ---- givens
function givens() {
  for (const item of D.givens) {
    const label = element("label"), input = element("input"), text = element("span");
    label.innerHTML = item.symbol; label.htmlFor = input.id = `given-${item.name}`; text.innerHTML = item.unit;
    Object.assign(input, { type: "text", inputMode: "decimal", autocomplete: "off", value: item.fixed ? said(item.value, 6) : written(item.value), disabled: item.fixed });
    input.addEventListener("change", () => change(item, input));
    $("givens").append(label, input, text);
  }
  const fixed = D.givens.filter(item => item.fixed).length;
  if (fixed) $("givens").append(Object.assign(element("p"), { textContent: D.pieces === undefined ? W.fixed : fixed < D.givens.length ? W.some : W.given }));
  $("again").classList.toggle("gone", fixed === D.givens.length);
  $("givens").addEventListener("submit", event => event.preventDefault());
  $("again").addEventListener("click", () => {
    Object.assign(given, D.board);
    here.changed = false;
    taken();
    for (const item of D.givens) $(`given-${item.name}`).value = written(item.value);
    here.at = drive.start;
    remade();
  });
}
const LIMITS = { undercut: W.undercut, slack: W.slack, returns: W.returns };
const BOUNDS = { "not-positive-or-inf": [x => x > 0, "positive"], "not-positive": [x => x > 0, "positive"], negative: [x => x >= 0, "not_negative"], "is-zero": [x => x !== 0, "not_zero"] };
function change(item, input) {
  const before = { ...given }, text = input.value.trim().replace(",", ".").replace("\u2212", "-");
  const wanted = text === "" ? NaN : Number(text), [admits, said] = BOUNDS[item.bound] || [() => true, ""];
  const fault = !Number.isFinite(wanted) ? W.number : !admits(wanted) ? W[said] : "";
  if (!fault) for (const name of item.board) given[name] = wanted * item.si;
  const was = here.changed, beyond = fault ? "" : taken();
  here.changed = true;
  if (fault || beyond || !Array.from({ length: 60 }, (_, k) => stand(place(k * COUNT / 60))).some(found => found[0] < FAILED)) {
    Object.assign(given, before);
    here.changed = was;
    taken();
    input.value = written(Number((given[item.board[0]] / item.si).toPrecision(12)));
    $("status").textContent = fault || (beyond && LIMITS[beyond.split(/[._]/)[1]]) || W.refused;
    return;
  }
  remade();
}
function remade() {
  sample(); reach(); figures();
  here.found = null;
  let at = here.at;
  if (stand(at)[0] >= FAILED) {
    const far = k => Math.abs(Math.sin((place(k) - at) / (drive.turns ? 2 : 2 * span)));
    const good = here.samples.map((found, k) => [found[0], k]).filter(([code]) => code < FAILED).map(([, k]) => k);
    at = place(good.reduce((a, b) => far(b) < far(a) ? b : a));
  }
  left(); right(); curves(); go(at);
}
function reach() {
  set($("place"), drive.turns ? { min: 0, max: 360, step: "any" } : { min: shownPlace(drive.low), max: shownPlace(drive.high), step: "any" });
  slowed();
}
const stale = name => Boolean(here.changed && views.get(name).drawn);
function figures() { // those of the sheet, and what tells them, are of its data
  for (const id of ["which", "replayed"]) {
    const list = $(id), options = [...list.options];
    for (const option of options) option.hidden = option.disabled = stale(option.value);
    const now = options.find(option => option.selected && !option.disabled) || options.find(option => !option.disabled);
    if (now) list.value = now.value;
    (id === "which" ? $("right").closest("figure") : $("told").closest("section")).classList.toggle("gone", !now);
  }
  for (const view of D.views) if (stale(view.name)) { view.svg = null; view.until = undefined; }
}
function left() { build(views.get("position"), $("left")); heading(views.get("position"), $("left-head")); }
function right() {
  const view = views.get($("which").value);
  if (!view || stale(view.name)) return;
  for (const other of D.views) if (other.name !== "position") other.svg = null;
  build(view, $("right")); heading(view, $("right-head"), true);
}
function heading(view, node, alone) {
  const scale = view.symbol ? `${view.symbol} = ${said(view.mu * view.by, 6)} ${view.per}` : (view.under || []).join("; ");
  node.innerHTML = [alone ? "" : filled(view.heading), scale].filter(Boolean).join(", ");
}

// ---- begin
function begin() {
  $("symbol").innerHTML = drive.symbol;
  $("place").addEventListener("input", () => { pause(); go($("place").value * (drive.turns ? Math.PI / 180 : 1 / drive.by)); });
  $("place").addEventListener("keydown", event => nudge(event, 1));
  $("play").addEventListener("click", () => playing ? pause() : play());
  for (const view of D.views) for (const list of [$("which"), $("replayed")]) {
    if (list.id === "which" ? view.name === "position" : !view.steps.length) continue;
    const option = element("option");
    option.value = view.name; option.textContent = view.heading.replace(/<[^>]+>/g, "");
    list.appendChild(option);
  }
  if (!$("which").options.length) $("right").closest("figure").classList.add("gone");
  $("which").addEventListener("change", () => { right(); go(here.at); });
  $("replayed").addEventListener("change", tell);
  const until = () => views.get($("replayed").value).until;
  $("values").classList.toggle("no-mm", !D.quantities.some(q => q.plan));
  $("first").addEventListener("click", () => replay(0));
  $("back").addEventListener("click", () => replay((until() === undefined ? Infinity : until()) - 1));
  $("next").addEventListener("click", () => replay(until() === undefined ? 1 : until() + 1));
  $("all").addEventListener("click", () => replay(undefined));
  for (const q of D.quantities) {
    const row = $("values").tBodies[0].insertRow(), box = element("input");
    row.dataset.q = q.name;
    row.insertCell().innerHTML = q.symbol; row.insertCell(); row.insertCell().innerHTML = q.unit; row.insertCell();
    Object.assign(box, { type: "checkbox", checked: shown.has(q.name) });
    box.setAttribute("aria-label", `${W.diagram} ${q.name}`);
    box.addEventListener("change", () => { shown[box.checked ? "add" : "delete"](q.name); curves(); now(); });
    row.insertCell().appendChild(box);
    row.addEventListener("pointerenter", () => light([q.name]));
    row.addEventListener("pointerleave", () => light([]));
  }
  if (D.opens) $("which").value = $("replayed").value = D.opens;
  givens(); sample(); reach();
  here.found = here.samples.find(found => found[0] < FAILED);
  left(); right(); curves(); tell(); go(drive.start);
}
begin();
