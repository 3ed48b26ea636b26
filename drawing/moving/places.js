// What the program finds at a place of the driver, and how large its plans are over the cycle; D is the page's data.
const drive = D.drive;
const index = new Map(D.names.map((name, k) => [name, k + 1]));
const given = { ...D.board }, COUNT = 360, FAILED = 2, views = new Map(D.views.map(view => [view.name, view]));
const here = { at: drive.start, found: null, samples: [] };
let span = drive.high - drive.low;
const NEARLY = 1e-9, SIZES = { position: 170, lever: 120 }, USUAL = 0.9; // mm; part of the positions that a plan is sized by

function near(place) {
  if (!D.near) return;
  let part = (place - drive.low) / span;
  if (drive.turns) part -= Math.floor(part);
  for (const [name, row] of Object.entries(D.near)) {
    const at = Math.min(Math.max(part, 0), 1) * (row.length - 1), k = Math.min(Math.floor(at), row.length - 2);
    given[name] = row[k] + (row[k + 1] - row[k]) * (at - k);
  }
  for (const [cosine, sine] of D.turned) { // a direction has the length of one
    const long = Math.hypot(given[cosine], given[sine]);
    given[cosine] /= long; given[sine] /= long;
  }
}
function piece(place) { // the numbers of the piece of formulas that a place is in
  const { starts, names, rows } = D.pieces, turn = drive.turns ? 2 * Math.PI : Infinity;
  const at = given._at = drive.turns ? place - turn * Math.floor((place + NEARLY) / turn) : place;
  let k = starts.length - 1;
  while (k > 0 && !(starts[k] < at + NEARLY)) k--;
  names.forEach((name, n) => { given[name] = rows[k][n]; });
}
function stand(place) { given[drive.name] = place; near(place); if (D.pieces) piece(place); return solve(given); }
const value = (found, name) => index.has(name) ? found[index.get(name)] : given[name];
const size = v => Array.isArray(v) ? Math.hypot(v[0], v[1]) : v;
function spot(found, end) {
  if (typeof end === "string") return value(found, end);
  if (end[0] === "i") { const [x, y] = value(found, end[1]); return [-y, x]; }
  const [x, y] = value(found, end[0]), [c, s] = value(found, end[1]), along = sized(end[2]), across = sized(end[3]);
  return [x + c * along - s * across, y + s * along + c * across];
}
const sized = of => typeof of === "number" ? of : typeof of === "string" ? given[of] : of[0] * given[of[1]]; // a size, or a part of one
const place = k => drive.turns ? drive.start + drive.sense * 2 * Math.PI * k / COUNT : drive.low + span * k / COUNT;
function taken() { // the numbers of a course for other data; which of its limits they are beyond
  if (typeof zeros === "function") ZEROS.forEach((name, n) => { // where a rising function is zero, by halving
    let [low, high] = zeros(given).slice(3 * n + 2);
    for (let k = 0; k < 200; k++) {
      given[name] = (low + high) / 2;
      if (zeros(given)[3 * n + 1] < 0) low = given[name]; else high = given[name];
    }
  });
  if (drive.end) { drive.high = drive.again = value(stand(drive.low), drive.end); span = drive.high - drive.low; }
  if (drive.rate) drive.speed = given[drive.rate];
  const all = D.measured ? Array.from({ length: COUNT + 1 }, (_, k) => stand(place(k))) : [];
  for (const [name, { of, round }] of Object.entries(D.measured || {})) if (of.length) {
    const most = Math.max(...all.flatMap(found => of.map(column => size(value(found, column)))));
    given[name] = round ? nice(round / most) : most;
  }
  const columns = D.names.filter(name => name.startsWith("limit."));
  if (all.some(found => found.some(x => x !== x || x === null))) return ".";
  return columns.find(name => {
    const values = all.map(found => value(found, name)), large = Math.max(...values.map(Math.abs));
    return !values.every(x => x >= -NEARLY * large);
  });
}
function sample() {
  if (D.stroke && here.changed) strokes();
  here.samples = Array.from({ length: COUNT + 1 }, (_, k) => stand(place(k)));
  for (const view of D.views) frame(view);
}
function strokes() { // the ends of the working stroke, between which its loads act, for other data
  const measure = at => {
    const v = value(stand(at), D.stroke.place);
    return D.stroke.slides ? v : Math.atan2(v[1], v[0]);
  };
  const all = []; let last = null;
  for (let k = 0; k <= COUNT; k++) {
    if (stand(place(k))[0] === 3) continue;
    let v = measure(place(k));
    if (!D.stroke.slides && last !== null) v += 2 * Math.PI * Math.round((last - v) / (2 * Math.PI));
    all.push([v, place(k)]); last = v;
  }
  const ends = [1, -1].map(way => {
    let best = all.reduce((a, b) => way * b[0] > way * a[0] ? b : a), step = Math.abs(place(1) - place(0));
    for (let n = 0; n < 60; n++, step *= 0.7) for (const at of [best[1] - step, best[1] + step]) {
      let v = measure(at);
      if (!D.stroke.slides) v += 2 * Math.PI * Math.round((best[0] - v) / (2 * Math.PI));
      if (way * v > way * best[0]) best = [v, at];
    }
    return best[0];
  });
  const forward = D.board[D.stroke.end] > D.board[D.stroke.begin];
  given[D.stroke.end] = ends[forward ? 0 : 1]; given[D.stroke.begin] = ends[forward ? 1 : 0];
}

// ---- scale factors and frames of the views: the same all over the cycle
function nice(x) {
  const power = Math.pow(10, Math.floor(Math.log10(x)));
  const step = [1, 2, 2.5, 4, 5, 10].find(m => m * power >= x * (1 - 1e-12));
  return Number((step * power).toPrecision(6));
}
const ends = shape => [shape.a, shape.b, shape.at, ...(shape.ends || [])].filter(end => end !== undefined);
function frame(view) {
  const forces = view.shapes.filter(shape => shape.k === "force" && shape.long); // the largest of them is as long as is said
  view.force = Math.max(0, ...forces.flatMap(shape => here.samples.map(found => size(value(found, shape.v)))));
  if (view.frame) { view.box = view.frame; return; }
  if (view.extent) {
    const by = view.by ? given[view.by] / D.board[view.by] : 1, [x0, y0, x1, y1] = view.extent.map(x => x * by), mu = view.mu = Math.max(x1 - x0, y1 - y0) / SIZES.position;
    view.box = [x0 / mu - 4, -y1 / mu - 4, (x1 - x0) / mu + 8, (y1 - y0) / mu + 8];
    return;
  }
  const boxes = [], used = view.shapes.flatMap(ends);
  for (let k = 0; k < COUNT; k += 5) {
    if (here.samples[k][0] >= FAILED) continue;
    const box = [0, 0, 0, 0];
    if (view.name === "position") box.splice(0, 4, Infinity, Infinity, -Infinity, -Infinity);
    for (const end of used) {
      const [x, y] = spot(here.samples[k], end);
      if (x !== x) continue;
      box[0] = Math.min(box[0], x); box[1] = Math.min(box[1], y); box[2] = Math.max(box[2], x); box[3] = Math.max(box[3], y);
    }
    boxes.push(box);
  }
  if (!boxes.length) return;
  boxes.sort((a, b) => Math.max(a[2] - a[0], a[3] - a[1]) - Math.max(b[2] - b[0], b[3] - b[1]));
  const kept = boxes.slice(0, Math.max(1, Math.ceil(boxes.length * (view.name === "position" ? 1 : USUAL))));
  const whole = [0, 1, 2, 3].map(i => kept.map(box => box[i]).reduce((a, b) => i < 2 ? Math.min(a, b) : Math.max(a, b)));
  const wide = Math.max(whole[2] - whole[0], whole[3] - whole[1]);
  view.mu = nice(wide / (SIZES[view.name] || 150));
  const margin = 14 + (view.name === "lever" ? 10 : 0), mm = whole.map(x => x / view.mu);
  view.box = [mm[0] - margin, -mm[3] - margin, mm[2] - mm[0] + 2 * margin, mm[3] - mm[1] + 2 * margin];
}

// ---- vectors and boxes
const sub = (a, b) => [a[0] - b[0], a[1] - b[1]], add = (a, b, k = 1) => [a[0] + b[0] * k, a[1] + b[1] * k];
const unit = v => { const l = Math.hypot(v[0], v[1]); return l > 1e-9 ? [v[0] / l, v[1] / l] : [0, 0]; };
const cross = (a, b) => a[0] * b[1] - a[1] * b[0], dot = (a, b) => a[0] * b[0] + a[1] * b[1];
const meet = (a, b, c, d) => { // two segments
  const side = (p, q, r) => (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
  return side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
};
function crosses(a, b, box) { // a segment and a box (Liang and Barsky)
  let low = 0, high = 1;
  for (const i of [0, 1]) {
    const d = b[i] - a[i];
    if (Math.abs(d) < 1e-9) { if (a[i] < box[i] || a[i] > box[i + 2]) return false; continue; }
    const one = (box[i] - a[i]) / d, other = (box[i + 2] - a[i]) / d;
    low = Math.max(low, Math.min(one, other)); high = Math.min(high, Math.max(one, other));
  }
  return low < high;
}

// ---- numbers as they are read
const RAISED = Object.fromEntries([..."-0123456789"].map((sign, k) => [sign, "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"[k]]));
const locale = text => (D.lang === "en" ? text : text.replace(".", ",")).replace("-", "\u2212");
function said(x, digits = 4) {
  if (x === undefined || x !== x || x === null) return "–";
  if (Math.abs(x) < 1e-11) return "0";
  const text = Math.abs(x) >= 1e6 || Math.abs(x) < 1e-3 ? x.toExponential(digits - 1).replace(/\.?0+e/, "e") : String(Number(x.toPrecision(digits)));
  return locale(text.replace(/e\+?(-?\d+)/, (_, power) => "·10" + [...power].map(sign => RAISED[sign]).join("")));
}
const long = mm => locale(mm.toFixed(mm < 100 ? 2 : 1));
const written = x => locale(Math.abs(x) < 1e7 ? String(x) : x.toExponential().replace("+", "")); // as it can be typed
const shownPlace = at => drive.turns ? ((at * 180 / Math.PI) % 360 + 360) % 360 : at * drive.by;
const shownAt = at => locale(shownPlace(at).toFixed(drive.digits)) + (drive.turns ? "°" : " " + drive.unit);
