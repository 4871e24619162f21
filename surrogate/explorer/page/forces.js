// The force over the radius of the wire: its parts on one another, and the other laws beside.

const CURVE = 160;

// A round end of the axis that shows the wire and the cuts, and does not tremble as they move.
function rightEnd(state) {
  const largest = Math.max(1.6*state.R_w, ...state.cuts.map(([radius]) => 1.08*radius));
  return niceStep(largest);
}

// The forces of a law at radii that the table covers, in as many runs as the law covers.
function curveOf(law, state, right, count = CURVE) {
  const [thinnest, thickest] = rubs(state) ? radiiOf(state) : [0, Infinity];
  const low = Math.max(thinnest*(1 + 1e-9), 1e-6*right), high = Math.min(thickest*(1 - 1e-9), right);
  if (!(low < high) || (rubs(state) && !holdsAlpha(state.alpha))) return [];
  const radii = Array.from({length: count}, (_, i) => low + (high - low)*i/(count - 1));
  const touch = state.Gamma_o/(state.mu*touchOf(state.alpha));
  radii.push(touch*(1 - 1e-9), touch*(1 + 1e-9));  // A* jumps there
  const inside = radii.filter((r) => r >= low && r <= high).sort((a, b) => a - b);
  const at = (radius) => ({radius, ...forceOf(law, withRadius(state, radius))});
  return runsOf(withEnds(inside, (radius) => at(radius).total !== undefined && (at(radius).law ?? true)).map(at));
}

// Radii, and beside them those at which a condition changes.
function withEnds(radii, condition) {
  const ends = radii.slice(1).flatMap((radius, i) => {
    if (condition(radii[i]) === condition(radius)) return [];
    const end = changeBetween(condition, radii[i], radius);
    return [end*(1 - 1e-9), end*(1 + 1e-9)];
  });
  return [...radii, ...ends].sort((a, b) => a - b);
}

// Points in a row that have a force which a scale can be made for.
function runsOf(points) {
  const runs = [[]];
  for (const one of points) {
    const latest = runs[runs.length - 1];
    if (one.law !== latest[latest.length - 1]?.law && latest.length) runs.push([]);  // where "auto" takes another law
    if (one.total < 1e300) runs[runs.length - 1].push(one);
    else if (runs[runs.length - 1].length) runs.push([]);
  }
  return runs.filter((run) => run.length > 1);
}

// A law that is as many times higher leaves the picture, so that the parts stay to be seen.
const HIGHEST_OTHER = 2.5;

function topOf(main, curves, state) {
  const most = (forces) => Math.max(1e-12, ...forces.filter(Number.isFinite));
  const own = most([...main.flat().map((one) => one.total), ...state.cuts.map(([, force, std]) => force + (std ?? 0))]);
  const all = most(curves.flat(2).map((one) => one.total));
  return niceTop(1.05*(all <= HIGHEST_OTHER*own || !main.length ? Math.max(all, own) : 1.2*own));
}

function niceTop(value) {
  const step = niceStep(value/5);
  return step*Math.ceil(value/step*(1 - 1e-9));
}

function drawParts(frame, curve, x, y) {
  let below = curve.map(() => 0);
  const names = [];
  for (const part of DATA.parts) {
    const above = curve.map((one, i) => below[i] + one[part]);
    const up = curve.map((one, i) => [x.to(one.radius), y.to(above[i])]);
    const down = curve.map((one, i) => [x.to(one.radius), y.to(below[i])]).reverse();
    if (curve.some((one) => one[part] > 0)) {
      frame.append(svg("path", {d: pathOf([...up, ...down], true), class: `fill-${part}`}));
      const i = Math.floor(0.8*(curve.length - 1)), middle = y.to(0.5*(above[i] + below[i]));
      const wide = x.to(curve[curve.length - 1].radius) - x.to(curve[0].radius) > 60;
      if (wide && y.to(below[i]) - y.to(above[i]) > 15) {
        names.push(note(part, {x: x.to(curve[i].radius), y: middle + 4, "text-anchor": "middle"}));
      }
    }
    below = above;
  }
  return names;
}

// The band of the known error, and the line of the force.
function drawTotal(frame, curve, x, y) {
  const known = curve.filter((one) => one.error > 0);
  const side = (sign) => known.map((one) => [x.to(one.radius), y.to(one.total*(1 + sign*one.error))]);
  if (known.length > 1) {
    frame.append(svg("path", {d: pathOf([...side(1), ...side(-1).reverse()], true), class: "band"}));
  }
  drawLine(frame, curve, x, y, "total");
}

// The line of a force, dashed where it is unknown how far it may be off.
function drawLine(frame, curve, x, y, kind) {
  const runs = [];
  curve.forEach((one, i) => {
    const known = Number.isFinite(one.error);
    if (!i || known !== runs[runs.length - 1].known) runs.push({known, points: []});
    runs[runs.length - 1].points.push([x.to(one.radius), y.to(one.total)]);
  });
  for (const {known, points} of runs) {
    frame.append(svg("path", {d: pathOf(points), class: `${kind}${known ? "" : " unsure"}`}));
  }
}

// The other laws as lines, each with its name at its end.
function drawOthers(frame, others, x, y, taken) {
  others.forEach(({law, curve}, i) => {
    if (!curve.length) return;
    curve.forEach((run) => drawLine(frame, run, x, y, `other other-${i}`));
    const end = y.to(endOf(curve).total);
    taken.push([Math.max(y.end + 2, end), end < y.end ? `${law.title} ▴` : law.title, `other-${i}`]);
  });
}

const endOf = (runs) => runs[runs.length - 1][runs[runs.length - 1].length - 1];

// Names at the right ends of lines, a line's height apart and none below the axis.
function endLabels(frame, labels, x, y) {
  let least = -Infinity;
  const placed = [...labels].sort((a, b) => a[0] - b[0]).map(([at, words, kind]) => {
    least = Math.max(at, least + 15);
    return {at: least, words, kind};
  });
  let most = y.start - 4;
  for (const one of placed.reverse()) {
    one.at = Math.min(one.at, most);
    most = one.at - 15;
    frame.append(lettered(one.words, {x: x.end + 5, y: one.at + 4, class: `name ${one.kind}`}));
  }
}

function drawTransition(frame, radius, x, y) {
  if (!(x.to(radius) < x.end)) return;
  frame.append(svg("path", {d: `M${x.to(radius)} ${y.start}V${y.end}`, class: "touch"}));
  frame.append(note("transition radius", {x: x.to(radius) + 5, y: y.end + 14, class: "small"}));
}

function drawCuts(frame, state, x, y) {
  for (const [radius, force, std] of state.cuts) {
    const [px, py] = [x.to(radius), y.to(force)];
    if (std) frame.append(svg("path", {d: `M${px} ${y.to(force - std)}V${y.to(force + std)}`, class: "bar"}));
    frame.append(svg("rect", {x: px - 4, y: py - 4, width: 8, height: 8, class: "cut"}));
  }
}

function drawForces(plot, state, size, change) {
  const {width, height} = size, frame = svg("g"), across = (state.diameters ? 2e3 : 1e3);
  resize(plot, size);
  const right = rightEnd(state), law = lawOf(state.law);
  const valid = !refusalOfMaterial(state);
  const curves = valid ? LAWS.map((one) => curveOf(one, state, right)) : [];
  const main = curves[LAWS.indexOf(law)] ?? [];
  const top = topOf(main, curves, state);
  const inner = linearScale(across*(Number.isFinite(right) && right > 0 ? right : 1e-3), 58, width - 80);
  const x = {...inner, to: (radius) => inner.to(across*radius), from: (px) => inner.from(px)/across};
  const y = linearScale(top, height - 48, 12);
  const box = {x: x.start, y: y.end, width: x.end - x.start, height: y.start - y.end};
  frame.append(svg("rect", {...box, class: "paper"}));
  if (valid && rubs(state)) drawBeyond(frame, main, x, y, plot.beyond);
  const lines = svg("g", {"clip-path": plot.inside}), labels = [];
  frame.append(svg("clipPath", {id: plot.inside.slice(5, -1)}, svg("rect", {...box})), lines);
  const names = main.flatMap((run) => drawParts(lines, run, x, y));
  main.forEach((run) => drawTotal(lines, run, x, y));
  const others = LAWS.map((one, i) => ({law: one, curve: curves[i] ?? []}))
    .filter((one) => one.law !== law && !one.law.forceOf);
  drawOthers(lines, others, x, y, labels);
  if (main.length) labels.push([y.to(endOf(main).total), law.title, "main"]);
  const tick = axes({...inner}, y, state.diameters ? "wire diameter D [mm]" : "wire radius R_w [mm]",
    "F_ss/T [N/m]");
  frame.append(tick, ...names);
  if (main.length) drawTransition(frame, transitionOf(law, state).radius, x, y);
  endLabels(frame, labels, x, y);
  drawCuts(frame, state, x, y);
  placeOnCurve(plot, state, law, x, y);
  plot.move = (px) => change({R_w: round4(clamped(x.from(px), right/500, right))});
  plot.step = (over, up, by) => change({R_w: round4(state.R_w*1.02**(by*(over || up)))});
  plot.content.replaceChildren(frame);
}

// Why there is no curve at all, whatever the wire; an empty text where there is one.
const refusalOfMaterial = (state) => {
  const wireInside = rubs(state) ? radiiOf(state)[0]*(1 + 1e-9) : 1;
  return Number.isFinite(wireInside) && wireInside > 0 ? refusal(withRadius(state, wireInside)) : refusal(state);
};

// What the table and the law do not cover: thin wires, thick ones, and what is between runs.
function drawBeyond(frame, runs, x, y, fill) {
  const place = (from, to) => frame.append(svg("rect", {
    x: from, y: y.end, width: to - from, height: y.start - y.end, fill,
  }));
  let covered = x.start;
  for (const run of runs) {
    const first = x.to(run[0].radius);
    if (first > covered + 1) place(covered, first);
    covered = x.to(run[run.length - 1].radius);
  }
  if (covered < x.end - 1) place(covered, x.end);
}

function placeOnCurve(plot, state, law, x, y) {
  const force = refusalOf(law, state) ? null : forceOf(law, state);
  const radius = clamped(Number.isNaN(state.R_w) ? 0 : state.R_w, 0, x.from(x.end));
  const height = force ? clamped(y.to(force.total), y.end, y.start) : y.start;
  placeHandle(plot, [x.to(radius), height], state,
    `${wire(state, state.R_w)}, ${force ? `${digits(force.total)} N/m` : "no force"}`, !force);
}
