// The map of what dominates, over R_w/l_e = mu R_w/Gamma_o and R_w/l_w = tau_w R_w/Gamma_o.

const MAP = {x: [1/DATA.domain.g[1], 1/DATA.domain.g[0]], y: [1e-3, 1e2], columns: 140};

// A cut at a place of the map, in units of Gamma_o = R_w = 1.
const atPlace = (x, y, {xi, alpha}) => ({Gamma_o: 1, R_w: 1, mu: x, tau_w: y, xi, alpha});

const LOWEST = MAP.y[0]*1e-3, HIGHEST = MAP.y[1]*1e3;

// The y between which a law has a force at one x: the longest stretch of them, or nan. Gaps that are
// narrower than a sixteenth of a decade may be missed.
function coverAt(law, x, state) {
  const has = (y) => law.covers(1/x, atPlace(x, y, state));
  const ys = spaced(LOWEST, HIGHEST, 16), stretches = [];
  ys.forEach((y, i) => {
    if (!has(y)) return;
    const from = !i ? y : has(ys[i - 1]) ? null : changeBetween(has, ys[i - 1], y);
    if (from !== null) stretches.push([from, y]);
    const last = stretches[stretches.length - 1];
    last[1] = i + 1 === ys.length || has(ys[i + 1]) ? y : changeBetween(has, y, ys[i + 1])*(1 - 1e-9);
  });
  return stretches.sort((a, b) => b[1]/b[0] - a[1]/a[0])[0] ?? [NaN, NaN];
}

// The y at which wear rises above, or a part falls below, the threshold at one x.
function edgeAt(law, part, x, state, [low, high]) {
  if (Number.isNaN(low)) return NaN;
  const dominates = (y) => {
    const force = forceOf(law, atPlace(x, y, state));
    return force !== null && force[part]/force.total >= DATA.threshold;
  };
  if (dominates(low) === dominates(high)) return !dominates(low) ? NaN : part === "wear" ? low : Infinity;
  return changeBetween(dominates, low, high);
}

let regionsKept = {key: ""};

// The edges of the regions, and between which y the law has a force; they depend on the law, xi and alpha alone, and are kept.
function regionsOf(state) {
  const key = [state.law, state.xi, state.alpha].join();
  if (regionsKept.key === key) return regionsKept;
  const law = lawOf(state.law);
  const low = Math.max(MAP.x[0], (1 + 1e-9)/highestG(state.alpha)), touch = 1/touchOf(state.alpha);
  const ratio = Math.log(MAP.x[1]*(1 - 1e-9)/low)/(MAP.columns - 1);
  const across = Array.from({length: MAP.columns}, (_, i) => low*Math.exp(i*ratio));
  across.push(touch*(1 - 1e-9), touch*(1 + 1e-9));
  for (const end of law.ends?.[0] ?? []) across.push(...[1 - 1e-9, 1 + 1e-9].map((near) => near*touch/Math.exp(end)));
  const xs = across.filter((x) => x >= low && x < MAP.x[1]).sort((a, b) => a - b);
  const covers = xs.map((x) => [x, ...coverAt(law, x, state)]);
  const edges = Object.fromEntries(DATA.parts.map((part) =>
    [part, covers.map(([x, ...ends]) => [x, edgeAt(law, part, x, state, ends)])]));
  regionsKept = {key, edges, covers};
  return regionsKept;
}

// The polygons of a region: wear lies above its edge, the others below theirs.
function regionPaths(edge, part, x, y) {
  const bottom = y.start, top = y.end, base = part === "wear" ? top : bottom, runs = [[]];
  edge.forEach(([at, value], i) => {
    if (Number.isNaN(value)) return runs.push([]);
    const run = runs[runs.length - 1];
    if (!run.length && i) run.push([x.to(at), base]);  // a region that begins inside the map
    run.push([x.to(at), Math.min(bottom, Math.max(top, y.to(value)))]);
    if (i + 1 < edge.length && Number.isNaN(edge[i + 1][1])) run.push([x.to(at), base]);
  });
  return runs.filter((run) => run.length > 1).map((run) => {
    const first = [run[0][0], base], last = [run[run.length - 1][0], base];
    return {area: pathOf([first, ...run, last], true), points: run};
  });
}

// The place with most room for words among spans [x, top, bottom], clear of what is taken.
function roomFor(words, spans, taken) {
  const half = 3.6*words.length + 4;
  let best = {room: 18};
  for (const [x] of spans) {
    const beside = spans.filter(([at]) => Math.abs(at - x) <= half);
    if (!spans.length || x - half < spans[0][0] || x + half > spans[spans.length - 1][0]) continue;
    const top = Math.max(...beside.map((one) => one[1])), bottom = Math.min(...beside.map((one) => one[2]));
    const y = 0.5*(top + bottom);
    const free = taken.every((one) => Math.abs(one.x - x) > half + one.half || Math.abs(one.y - y) > 18);
    if (free && bottom - top > 1.02*best.room) best = {room: bottom - top, x, y, half};
  }
  return best.x === undefined ? null : best;
}

// A place of y inside the picture.
const insideOf = (y) => (value) => clamped(y.to(value), y.end, y.start);

// What the law does not cover: above the highest and below the lowest y of each x.
function drawUncovered(frame, covers, x, y, fill) {
  const inside = insideOf(y), known = (end, other) => Number.isNaN(end) ? other : inside(end);
  const line = (of) => covers.map((one) => [x.to(one[0]), of(one)]);
  const sides = [
    [line(([, , high]) => known(high, y.start)), y.end], [line(([, low]) => known(low, y.start)), y.start],
  ];
  for (const [points, base] of sides) {
    if (points.every(([, at]) => at === base)) continue;
    const ends = [points[0], points[points.length - 1]].map(([at]) => [at, base]);
    frame.append(svg("path", {d: pathOf([ends[0], ...points, ends[1]], true), fill}));
  }
}

// The spans that a part fills, and those that none does.
function spansOf({edges, covers}, x, y) {
  const inside = insideOf(y);
  const [tops, bottoms] = [2, 1].map((n) => covers.map((one) => Number.isNaN(one[n]) ? y.start : inside(one[n])));
  const spans = {none: []};
  for (const part of DATA.parts) {
    spans[part] = edges[part].map(([at, edge], i) => part === "wear"
      ? [x.to(at), tops[i], inside(edge)] : [x.to(at), Math.max(tops[i], inside(edge)), bottoms[i]])
      .filter((_, i) => !Number.isNaN(edges[part][i][1]));
  }
  edges.wear.forEach(([at, edge], i) => {
    const others = DATA.parts.filter((part) => part !== "wear").map((part) => edges[part][i][1]);
    const below = others.filter((value) => !Number.isNaN(value)).map(inside);
    spans.none.push([x.to(at), Number.isNaN(edge) ? tops[i] : inside(edge), Math.min(bottoms[i], ...below)]);
  });
  return spans;
}

// The names of the regions, each where it has most room.
function regionNames(regions, x, y, taken) {
  const spans = spansOf(regions, x, y), names = [];
  for (const part of [...DATA.parts, "none"]) {
    const words = part === "none" ? "no part dominates" : part;
    const place = roomFor(words, spans[part], taken);
    if (!place) continue;
    taken.push(place);
    names.push(note(words, {
      x: place.x, y: place.y + 4, "text-anchor": "middle", class: part === "none" ? "small" : "",
    }));
  }
  return names;
}

function drawMap(plot, state, size, change) {
  const {width, height} = size, frame = svg("g");
  resize(plot, size);
  const x = logScale(...MAP.x, 58, width - 14), y = logScale(...MAP.y, height - 48, 12);
  const plane = {x: x.start, y: y.end, width: x.end - x.start, height: y.start - y.end};
  frame.append(svg("rect", {...plane, class: "paper"}));
  const names = [];
  if (holdsAlpha(state.alpha) && state.xi >= 0 && state.xi < Infinity) {
    const regions = regionsOf(state), {edges} = regions;
    for (const part of DATA.parts) {
      const paths = regionPaths(edges[part], part, x, y);
      for (const {area, points} of paths) {
        frame.append(svg("path", {d: area, class: `fill-${part}`}));
        frame.append(svg("path", {d: pathOf(points), class: "edge"}));
      }
    }
    drawUncovered(frame, regions.covers, x, y, plot.beyond);
    const end = x.to(Math.max(MAP.x[0], 1/highestG(state.alpha)));
    if (end > x.start + 1) {
      frame.append(svg("rect", {...plane, width: end - x.start, fill: plot.beyond}));
    }
    const touch = x.to(1/touchOf(state.alpha));
    frame.append(svg("path", {d: `M${touch} ${y.start}V${y.end}`, class: "touch"}));
    const left = touch - x.start > 145;  // whether there is room on the side that is meant
    const [px, py] = pointOf(state, x, y).place;
    const taken = [{x: touch + (left ? -72 : 72), y: y.end + 10, half: 66}, {x: px, y: py, half: 14}];
    names.push(...regionNames(regions, x, y, taken));
    names.push(note("◂ wire touches the tip", {
      x: touch + (left ? -6 : 6), y: y.end + 14, "text-anchor": left ? "end" : "start", class: "small",
    }));
  }
  frame.append(axes(x, y, "R_w/l_e = μ R_w/Γ_o", "R_w/l_w = τ_w R_w/Γ_o"), ...names);
  drawWires(frame, state, x, y);
  placeOnMap(plot, state, x, y);
  plot.move = (px, py) => change(placed(state, x, y, px, py));
  plot.step = (right, up, by) => change(stepped(state, right, up, by));
  plot.content.replaceChildren(frame);
}

// The line on which other wires in the same material are, and the cuts on it.
function drawWires(frame, state, x, y) {
  const slope = state.tau_w/state.mu;  // y over x
  if (!(slope > 0 && slope < Infinity)) return;
  const from = Math.max(MAP.x[0], MAP.y[0]/slope), to = Math.min(MAP.x[1], MAP.y[1]/slope);
  if (!(from < to)) return;
  frame.append(svg("path", {
    d: pathOf([[x.to(from), y.to(from*slope)], [x.to(to), y.to(to*slope)]]), class: "wires",
  }));
  for (const [radius] of state.cuts) {
    const at = state.mu*radius/state.Gamma_o;
    if (at > from && at < to) {
      frame.append(svg("rect", {x: x.to(at) - 4, y: y.to(at*slope) - 4, width: 8, height: 8, class: "cut"}));
    }
  }
}

// Where the operating point is, or the nearest place of the map if it is beyond.
function pointOf(state, x, y) {
  const at = [1/gOf(state), state.tau_w*state.R_w/state.Gamma_o];
  const inside = at.map((value, i) => {
    const [low, high] = [MAP.x, MAP.y][i];
    return Number.isNaN(value) ? low : clamped(value, low, high);
  });
  return {
    place: [x.to(inside[0]), y.to(inside[1])],
    beyond: inside.some((value, i) => value !== at[i]),
  };
}

function placeOnMap(plot, state, x, y) {
  const {place, beyond} = pointOf(state, x, y);
  const words = `${wire(state, state.R_w)}, τ_w = ${digits(1e-3*state.tau_w)} kPa`;
  placeHandle(plot, place, state, words + (beyond ? ", beyond the map" : ""), beyond);
}

const round4 = (value) => Number(value.toPrecision(4));

// The wire and the wear strength at a place of the picture.
function placed(state, x, y, px, py) {
  const over = clamped(x.from(px), 1.0001*Math.max(MAP.x[0], 1/highestG(state.alpha)), 0.9999*MAP.x[1]);
  const up = clamped(y.from(py), ...MAP.y);
  const R_w = round4(over*state.Gamma_o/state.mu);
  return {R_w, tau_w: round4(up*state.Gamma_o/R_w)};
}

// A wire thicker by 2 % for each step to the right, a wear strength higher by 2 % for each up.
function stepped(state, right, up, size) {
  const factor = 1.02**size;
  const tau_w = up && state.tau_w === 0 ? MAP.y[0]*state.Gamma_o/state.R_w : state.tau_w*factor**up;
  return {R_w: round4(state.R_w*factor**right), tau_w: round4(tau_w)};
}
