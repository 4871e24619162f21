// The state, its fields and sliders, and the address that reproduces it.

// What a person reads of a quantity, in its own unit; the wire's may be a diameter.
const sizeOf = (q, state) => q.key === "R_w" && state.diameters ? 0.5*q.size : q.size;

// The place of a value on its slider, and back: a hundred steps a decade, or evenly spaced.
const toSlider = (q, value) => q.log ? 100*Math.log10(value) : value;
const fromSlider = (q, place) => q.log ? Number((10**(place/100)).toPrecision(4)) : Number(place);

const readNumber = (text) => {
  const plain = text.trim().replace(",", ".").replace("−", "-");
  return /^[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?$/i.test(plain) ? Number(plain) : NaN;
};

function field(q, change) {
  const label = `${q.words}, ${q.symbol}`;
  const make = (name, attributes) => Object.assign(document.createElement(name), attributes);
  const caption = make("label", {htmlFor: `field-${q.key}`});
  caption.append(`${capital(q.words)} `, symbolNode(q.symbol));
  const slider = make("input", {
    type: "range", id: `slider-${q.key}`, min: toSlider(q, q.ends[0]), max: toSlider(q, q.ends[1]),
    step: q.log ? 1 : 0.01,
  });
  slider.setAttribute("aria-label", `${label}, slider`);
  const number = make("input", {type: "text", inputMode: "decimal", id: `field-${q.key}`, autocomplete: "off"});
  const unit = make("span", {className: "unit", textContent: q.unit});
  slider.addEventListener("input", () => change({[q.key]: fromSlider(q, slider.value)}));
  number.addEventListener("input", () => {
    const value = readNumber(number.value);
    change({[q.key]: value*sizeOf(q, current()), typing: q.key});
  });
  number.addEventListener("blur", () => change({}));
  const row = make("div", {className: "quantity"});
  row.append(caption, number, unit, slider);
  return {q, row, caption, slider, number, unit};
}

// A letter with what is lowered after its low line.
function symbolNode(symbol) {
  const node = document.createElement("i");
  const [letter, low] = symbol.split("_");
  node.append(letter);
  if (low) node.append(Object.assign(document.createElement("sub"), {textContent: low}));
  return node;
}

// Show a state in a field, but leave alone what somebody is typing.
function showField({q, caption, slider, number, unit}, state) {
  const value = state[q.key], shown = value/sizeOf(q, state);
  if (q.key === "R_w") {
    caption.replaceChildren(`Wire ${state.diameters ? "diameter" : "radius"} `,
      symbolNode(state.diameters ? "D" : "R_w"));
  }
  if (!(state.typing === q.key && document.activeElement === number)) {
    number.value = Number.isFinite(shown) ? String(Number(shown.toPrecision(6))) : "";
  }
  const [low, high] = q.ends, inside = clamped(Number.isNaN(value) ? low : value, low, high);
  slider.value = toSlider(q, inside);
  slider.setAttribute("aria-valuetext", `${digits(shown, 4)} ${unit.textContent}`);
  const wrong = !(value >= 0 && value < Infinity) || (value === 0 && q.key !== "xi" && q.key !== "tau_w");
  number.setAttribute("aria-invalid", String(wrong));
}

const isCut = (across, force) => across > 0 && across < 1e3 && force >= 0 && force < 1e300;

const KEYS = Object.keys(QUANTITIES);

// The address after the sign #: quantities in SI units, law, diameters and cuts.
function addressOf(state) {
  const parts = KEYS.map((key) => `${key}=${state[key]}`);
  parts.push(`law=${state.law}`);
  if (state.diameters) parts.push("diameters=1");
  if (state.cuts.length) {
    parts.push(`cuts=${state.cuts.map((cut) => cut.filter((x) => x !== null).join(":")).join(";")}`);
  }
  return parts.join("&");
}

// The state of an address, what it does not say being as at the start; unknown words are left out.
function stateOf(address) {
  const state = {...DATA.start};
  for (const piece of decodeURIComponent(address.replace(/^#/, "")).split("&")) {
    const [key, value = ""] = piece.split("=");
    if (KEYS.includes(key)) state[key] = readNumber(value);
    if (key === "law" && LAWS.some((law) => law.name === value)) state.law = value;
    if (key === "diameters") state.diameters = value === "1";
    if (key === "cuts") {
      state.cuts = value.split(";").map((cut) => cut.split(":").map(readNumber))
        .filter(([radius, force]) => isCut(radius, force))
        .map(([radius, force, std]) => [radius, force, std > 0 ? std : null]);
    }
  }
  return state;
}
