// The map of what dominates, over R_w/l_e = mu R_w/Gamma_o and R_w/l_w = tau_w R_w/Gamma_o.

const MAP = {x: [1/DATA.domain.g[1], 1/DATA.domain.g[0]], y: [1e-3, 1e2], columns: 140};

// A cut at a place of the map, in units of Gamma_o = R_w = 1.
const atPlace = (x, y, {xi, alpha}) => ({Gamma_o: 1, R_w: 1, mu: x, tau_w: y, xi, alpha});

// What a law says of a place: the part that dominates, null without a force, and whether its error is known.
function saidOf(law, x, y, state) {
  const force = forceOf(law, atPlace(x, y, state));
  return force ? {part: dominantOf(force), known: !law.forceOf || Number.isFinite(force.error)} : {part: null, known: false};
}

// The stretches of y at one x in which a law says the same, to 8 digits. One that begins and ends within a tenth of
// a decade may be missed.
function columnOf(law, x, state) {
  const at = (y) => {
    const said = saidOf(law, x, y, state);
    return {...said, key: Object.values(said).join(), from: y};
  };
  const stretches = [at(MAP.y[0])];
  for (const y of spaced(...MAP.y, 10)) {
    const {key} = at(y);
    for (let latest = stretches.at(-1), tries = 0; latest.key !== key && tries < 6; ++tries) {
      const next = at(changeBetween((one) => at(one).key === latest.key, latest.seen ?? latest.from, y, 26));
      stretches.push(next);
      latest = next;
    }
    stretches.at(-1).seen = y;
  }
  stretches.forEach((one, i) => { one.to = stretches[i + 1]?.from ?? MAP.y[1]; });
  return {x, stretches};
}

let regionsKept = {key: ""};

// The columns of the map, each with its stretches; they depend on the law, xi and alpha alone, and are kept.
function regionsOf(state) {
  const key = [state.law, state.xi, state.alpha].join();
  if (regionsKept.key === key) return regionsKept;
  const law = lawOf(state.law);
  const low = Math.max(MAP.x[0], (1 + 1e-9)/highestG(state.alpha)), touch = 1/touchOf(state.alpha);
  const ratio = Math.log(MAP.x[1]*(1 - 1e-9)/low)/(MAP.columns - 1);
  const across = Array.from({length: MAP.columns}, (_, i) => low*Math.exp(i*ratio));
  for (const edge of [touch, ...(law.ends?.[0] ?? []).map((end) => touch/Math.exp(end))]) {
    across.push(edge*(1 - 1e-9), edge*(1 + 1e-9));
  }
  const xs = across.filter((x) => x >= low && x < MAP.x[1]).sort((a, b) => a - b);
  regionsKept = {key, columns: xs.map((x) => columnOf(law, x, state))};
  return regionsKept;
}

// The columns side by side that have the same stretches, one above the other.
function runsOfColumns(columns) {
  const keyOf = ({stretches}) => stretches.map((one) => one.key).join(" "), runs = [];
  columns.forEach((column, i) => {
    if (!i || keyOf(column) !== keyOf(columns[i - 1])) runs.push([]);
    runs[runs.length - 1].push(column);
  });
  return runs;
}

// By how much runs lie on each other, so that no seam shows between them [px].
const OVERLAP = 0.4;

// What fills each stretch of a run, and the lines between those that differ, half a column beyond its ends.
function drawRun(frame, run, beside, x, y, beyond) {
  const [first, last] = [run[0], run[run.length - 1]];
  const ends = [Math.sqrt(first.x*(beside[0] ?? first).x), Math.sqrt(last.x*(beside[1] ?? last).x)];
  const line = (j, end) => [
    [x.to(ends[0]) - OVERLAP, y.to(first.stretches[j][end])],
    ...run.map((one) => [x.to(one.x), y.to(one.stretches[j][end])]),
    [x.to(ends[1]) + OVERLAP, y.to(last.stretches[j][end])],
  ];
  run[0].stretches.forEach(({part, known}, j) => {
    const area = pathOf([...line(j, "to"), ...line(j, "from").reverse()], true);
    frame.append(svg("path", part ? {d: area, class: `fill-${part}`} : {d: area, fill: beyond}));
    const above = run[0].stretches[j + 1];
    if (!above) return;
    frame.append(svg("path", {d: pathOf(line(j, "to")), class: above.part !== part ? "edge" : "reach"}));
    if (above.part !== part && above.known !== known) frame.append(svg("path", {d: pathOf(line(j, "to")), class: "reach"}));
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

// The longest of the stretches that fit, in each column that has one, in places of the picture.
function spansOf(columns, fits, x, y) {
  return columns.flatMap((column) => {
    const spans = [];
    column.stretches.forEach((one, j) => {
      if (!fits(one)) return;
      const joined = j && fits(column.stretches[j - 1]) ? spans.pop() : null;
      spans.push([x.to(column.x), y.to(one.to), joined ? joined[2] : y.to(one.from)]);
    });
    return spans.sort((a, b) => (b[2] - b[1]) - (a[2] - a[1])).slice(0, 1);
  });
}

// The names of the regions, each where it has most room.
function regionNames({columns}, x, y, taken) {
  const names = [], unknown = columns.some((one) => one.stretches.some(({part, known}) => part && !known));
  const kinds = DATA.parts.map((part) => [part, (one) => one.part === part]);
  kinds.push(["no part dominates", (one) => one.part === DATA.transition, "small"]);
  if (unknown) kinds.push(["error known", (one) => one.known, "small"]);
  for (const [words, fits, kind = ""] of kinds) {
    const place = roomFor(words, spansOf(columns, fits, x, y), taken);
    if (!place) continue;
    taken.push(place);
    names.push(note(words, {x: place.x, y: place.y + 4, "text-anchor": "middle", class: kind}));
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
    const regions = regionsOf(state), runs = runsOfColumns(regions.columns);
    runs.forEach((run, i) => {
      const beside = [runs[i - 1]?.at(-1), runs[i + 1]?.[0]];
      drawRun(frame, run, beside, x, y, plot.beyond);
    });
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
