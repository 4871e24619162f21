// Pictures in SVG: elements, scales, axes, and a handle that mouse, touch and keys move.

const SVG = "http://www.w3.org/2000/svg";

function svg(name, attributes = {}, ...children) {
  const node = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
  node.append(...children);
  return node;
}

// Text with lowered letters after a low line, as in R_w.
function lettered(text, attributes = {}) {
  const node = svg("text", attributes);
  text.split(/(_[A-Za-z]+)/).forEach((piece) => {
    if (!piece.startsWith("_")) {
      if (piece) node.append(svg("tspan", {}, piece));
      return;
    }
    node.append(svg("tspan", {class: "low", dy: "0.25em"}, piece.slice(1)));
    node.append(svg("tspan", {dy: "-0.25em"}, "\u200a"));
  });
  return node;
}

const pathOf = (points, closed = false) => points.map(([x, y], i) =>
  `${i ? "L" : "M"}${x.toFixed(2)} ${y.toFixed(2)}`).join("") + (closed && points.length ? "Z" : "");

function logScale(low, high, start, end) {
  const span = Math.log(high/low);
  return {
    to: (value) => start + (end - start)*Math.log(value/low)/span,
    from: (place) => low*Math.exp(span*(place - start)/(end - start)),
    low, high, start, end,
    ticks: decades(low, high),
  };
}

function linearScale(high, start, end) {
  const step = niceStep(high/5);
  const count = Math.floor(high/step*(1 + 1e-9));
  return {
    to: (value) => start + (end - start)*value/high,
    from: (place) => high*(place - start)/(end - start),
    low: 0, high, start, end,
    ticks: Array.from({length: count + 1}, (_, i) => [Number((i*step).toPrecision(6)), true]),
  };
}

// 1, 2 or 5 times a power of ten, the first that is not below a number.
function niceStep(value) {
  const power = 10**Math.floor(Math.log10(value));
  return power*[1, 2, 5, 10].find((factor) => factor*power >= value*(1 - 1e-9));
}

// Ticks of a logarithmic axis, decades with their number and what is between without.
function decades(low, high) {
  const ticks = [];
  for (let e = Math.floor(Math.log10(low)); e <= Math.log10(high); ++e) {
    for (let k = 1; k < 10; ++k) {
      const value = k*10**e;
      if (value >= low*(1 - 1e-9) && value <= high*(1 + 1e-9)) ticks.push([value, k === 1]);
    }
  }
  return ticks;
}

function tickText(value) {
  const size = Math.abs(value);
  if (value === 0 || (size >= 1e-3 && size < 1e5)) return [String(Number(value.toPrecision(6))), ""];
  return ["10", String(Math.round(Math.log10(size)))];
}

function tickLabel(value, attributes) {
  const [base, power] = tickText(value);
  const node = svg("text", attributes, base);
  if (power) node.append(svg("tspan", {class: "low", dy: "-0.4em"}, power));
  return node;
}

function axes(x, y, xLabel, yLabel) {
  const group = svg("g", {class: "axes", "aria-hidden": "true"});
  group.append(svg("path", {d: `M${x.start} ${y.end}V${y.start}H${x.end}`}));
  for (const [value, major] of x.ticks) {
    const at = x.to(value);
    group.append(svg("path", {d: `M${at} ${y.start}v${major ? 5 : 3}`}));
    if (major) group.append(tickLabel(value, {x: at, y: y.start + 18, "text-anchor": "middle"}));
  }
  for (const [value, major] of y.ticks) {
    const at = y.to(value);
    group.append(svg("path", {d: `M${x.start} ${at}h${major ? -5 : -3}`}));
    if (major) group.append(tickLabel(value, {x: x.start - 8, y: at + 4, "text-anchor": "end"}));
  }
  const middle = 0.5*(x.start + x.end);
  group.append(lettered(xLabel, {x: middle, y: y.start + 38, "text-anchor": "middle"}));
  group.append(lettered(yLabel, {
    x: 0, y: 0, "text-anchor": "middle",
    transform: `translate(16 ${0.5*(y.start + y.end)}) rotate(-90)`,
  }));
  return group;
}

// The pattern of what is outside the table.
function hatch(id) {
  return svg("defs", {}, svg("pattern", {
    id, width: 7, height: 7, patternUnits: "userSpaceOnUse", patternTransform: "rotate(45)",
  }, svg("rect", {class: "paper", width: 7, height: 7}), svg("path", {class: "hatch", d: "M0 0V7"})));
}

// Words on a picture with a rim in the paper's colour, so that lines do not cross them.
const note = (text, attributes) => lettered(text, {...attributes, class: `note ${attributes.class ?? ""}`});

// A picture with a point that can be moved: what is drawn anew, and a handle that stays.
function plotIn(figure, id, title, label) {
  const content = svg("g"), handle = svg("g", {
    class: "handle", id, tabindex: 0, role: "slider", "aria-label": label,
    "aria-valuemin": 0, "aria-valuemax": 10,
  }, svg("circle", {r: 22, class: "grip"}), svg("circle", {r: 11, class: "ring"}),
  svg("circle", {r: 6.5, class: "dot"}));
  const frame = svg("svg", {class: "plot"}, svg("title", {}, title), hatch(`beyond-${id}`), content, handle);
  figure.append(frame);
  const plot = {
    frame, content, handle, beyond: `url(#beyond-${id})`, inside: `url(#inside-${id})`,
    move: () => {}, step: () => {}, held: () => {},
  };
  movable(plot);
  return plot;
}

function resize(plot, {width, height}) {
  for (const [name, value] of Object.entries({width, height, viewBox: `0 0 ${width} ${height}`})) {
    plot.frame.setAttribute(name, value);
  }
}

// Put the handle to a place, with what it stands for in words.
function placeHandle(plot, [x, y], state, words, beyond) {
  const {handle} = plot;
  handle.setAttribute("transform", `translate(${x.toFixed(2)} ${y.toFixed(2)})`);
  handle.classList.toggle("beyond", beyond);
  handle.setAttribute("aria-valuenow", Number.isFinite(state.R_w) ? 1e3*state.R_w : 0);
  handle.setAttribute("aria-valuetext", words);
}

const DIRECTIONS = {
  ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowDown: [0, -1], ArrowUp: [0, 1],
};

// Mouse, touch and keys call `plot.move` with a place [px], or `plot.step` with a direction.
function movable(plot) {
  const {frame, handle} = plot;
  const move = (event) => {
    const box = frame.getBoundingClientRect();
    plot.move(event.clientX - box.left, event.clientY - box.top);
  };
  let dragged = null;
  const hold = (pointer) => {
    dragged = pointer;
    plot.held(pointer !== null);
  };
  frame.addEventListener("pointerdown", (event) => {
    const onHandle = handle.contains(event.target);
    if (event.button || (event.pointerType === "touch" && !onHandle)) return;
    event.preventDefault();
    hold(event.pointerId);
    frame.setPointerCapture(dragged);
    handle.focus({preventScroll: true});
    if (!onHandle) move(event);
  });
  frame.addEventListener("pointermove", (event) => {
    if (event.pointerId === dragged) move(event);
  });
  for (const end of ["pointerup", "pointercancel"]) {
    frame.addEventListener(end, () => hold(null));
  }
  handle.addEventListener("touchstart", (event) => event.preventDefault(), {passive: false});
  frame.addEventListener("click", (event) => {  // of a finger, which may also want to scroll
    if (event.pointerType === "touch" && !handle.contains(event.target)) move(event);
  });
  handle.addEventListener("keydown", (event) => {
    const direction = DIRECTIONS[event.key];
    if (!direction || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    plot.step(...direction, event.shiftKey ? 10 : 1);
  });
}
