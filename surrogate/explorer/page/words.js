// Numbers and sentences for people.

const QUANTITIES = Object.fromEntries(DATA.quantities.map((q) => [q.key, q]));

const WORDS = {
  cleavage: "cleavage", friction: "friction", wear: "wear", transition: "no part",
};

// A number with some digits, without a long tail of zeros: 0.00025 and 1.2e-7, never 1.200e+3.
function digits(value, count = 3) {
  if (value === Infinity) return "infinite";
  if (!Number.isFinite(value)) return "unknown";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e-4 && size < 1e6) {
    const rounded = Number(value.toPrecision(count));
    return String(Math.abs(rounded) >= 10**count ? Math.round(value) : rounded);
  }
  return String(Number(value.toPrecision(count)).toExponential()).replace("e+", "e");
}

// A bound of an error in percent, rounded up to two digits; nothing known is said in words.
function percentUp(error) {
  if (!Number.isFinite(error)) return "unknown";
  if (error === 0) return "0 %";
  const step = 10**(Math.floor(Math.log10(100*error)) - 1);
  return `${digits(Math.ceil(100*error/step*(1 - 1e-12))*step, 2)} %`;
}

const percent = (share) => `${digits(100*share, 2)} %`;

const capital = (text) => text[0].toUpperCase() + text.slice(1);

const listed = (items) => items.length < 2 ? items.join("")
  : `${items.slice(0, -1).join(", ")} and ${items[items.length - 1]}`;

// A wire as people name it, by its radius or its diameter.
function wire(state, radius, count = 3) {
  const across = state.diameters ? 2*radius : radius;
  const [unit, size] = across < 0.5e-5 ? ["µm", 1e6] : across < 1 ? ["mm", 1e3] : ["m", 1];
  return `${state.diameters ? "D" : "R_w"}\u00a0=\u00a0${digits(size*across, count)}\u00a0${unit}`;
}

// The size of a wire alone, after another has been named with its letter.
const sizeAlone = (state, radius) => wire(state, radius).split("\u00a0=\u00a0")[1];

const TOO_LARGE = "The force is beyond the range of numbers; none is shown. Check the units.";

// Why a state has no force by a law, in words; an empty text where it has one.
function refusalOf(law, state) {
  const refused = refusal(state);
  if (refused) return refused;
  const force = forceOf(law, state);
  if (!force) return law.refusal(state);
  return Number.isFinite(force.total) ? "" : TOO_LARGE;
}

// Why a state has no force by any law, with the remedy; an empty text where it has one.
function refusal(state) {
  for (const q of DATA.quantities) {
    const value = state[q.key];
    const least = q.key === "xi" || q.key === "tau_w" ? 0 : Number.MIN_VALUE;
    if (!(value >= least && value < Infinity)) {
      return `${capital(q.words)} must be ${least ? "a number above 0" : "0 or a number above it"}; `
        + "no force is shown. Correct it in its field.";
    }
  }
  if (!rubs(state)) return "";
  const {alpha} = state, [first, last] = DATA.domain.alpha, g = gOf(state);
  if (!holdsAlpha(alpha)) {
    return `α = ${digits(alpha, 4)} is outside the table, which covers ${first} to ${last}; no force `
      + "is shown, because the table is not continued beyond its ends.";
  }
  if (holds(g, alpha)) {
    return Number.isFinite(forceOf(LAWS[0], state).total) ? "" : TOO_LARGE;
  }
  const [thinnest, thickest] = radiiOf(state), high = g > highestG(alpha);
  return `g = Γ_o/(μ R_w) = ${digits(g)} is outside the table, which covers `
    + `${DATA.domain.g[0]} to ${digits(highestG(alpha))} at this α; no force is shown, because the `
    + `table is not continued beyond its ends. In this material it covers wires `
    + (high ? `from ${wire(state, thinnest)} on.` : `up to ${wire(state, thickest)}.`);
}

// What can hardly be meant, in words.
function doubts(state) {
  return DATA.quantities.filter((q) => {
    const value = state[q.key];
    return q.plausible && value !== 0 && !(value >= q.plausible[0] && value <= q.plausible[1]);
  }).map((q) => {
    const [low, high] = q.plausible.map((end) => digits(end/q.size));
    return `${capital(q.words)} (${digits(state[q.key]/q.size)} ${q.unit}) is hardly that of a soft `
      + `solid’s cut, which is from ${low} to ${high} ${q.unit}: check the unit.`;
  });
}

function saysDominant(force) {
  const shares = DATA.parts.map((part) => [force[part]/force.total, part]).sort((a, b) => b[0] - a[0]);
  const part = dominantOf(force);
  if (part !== DATA.transition) return `${capital(part)} dominates: it is ${percent(shares[0][0])} of the force.`;
  const told = shares.filter(([share]) => share > 0).map(([share, name]) => `${name} is ${percent(share)}`);
  return `No part dominates: ${listed(told)} of the force, and a part dominates from two thirds on.`;
}

function saysStretches(law, state) {
  const {run, thinner, thicker} = runAround(stretchesOf(law, state), state.R_w);
  const does = (part) => part === DATA.transition ? "no part" : part;
  const told = run.map(({part, to}, i) => {
    const end = i === 0 ? wire(state, to) : sizeAlone(state, to);
    const reach = i < run.length - 1 || thicker ? `up to ${end}` : "with thicker wires";
    return i === 0 ? `${does(part)} dominates ${reach}` : `${does(part)} ${reach}`;
  });
  const parts = run.length > 1 ? `In this solid ${listed(told)}` : "So it is with every wire that the table covers";
  const covered = saysCovered(state);
  if (!thinner && !thicker) return `${parts}${covered}.`;
  const [first, last] = [run[0].from, run[run.length - 1].to];
  const reach = !thinner ? `up to ${wire(state, last)}`
    : `from ${wire(state, first)} ${thicker ? `to ${sizeAlone(state, last)}` : "on"}`;
  return `${run.length > 1 ? `${parts}. ` : ""}${capital(law.solutions)} around this wire reach ${reach}${covered}.`;
}

// The stretches around a radius between which the law has a force, and whether it has none beside.
function runAround(stretches, radius) {
  const at = stretches.findIndex((one) => radius < one.to), own = at < 0 ? stretches.length - 1 : at;
  let [low, high] = [own, own];
  while (low > 0 && stretches[low - 1].part !== null) --low;
  while (high + 1 < stretches.length && stretches[high + 1].part !== null) ++high;
  return {run: stretches.slice(low, high + 1), thinner: low > 0, thicker: high + 1 < stretches.length};
}

// Where the table begins, and where it ends if there are wires as thick.
function saysCovered(state) {
  const [thinnest, thickest] = radiiOf(state), most = QUANTITIES.R_w.plausible[1];
  const end = thickest > most ? "" : ` and ends at ${sizeAlone(state, thickest)}`;
  return ` (the table begins at ${wire(state, thinnest)}${end})`;
}

function saysTransition(law, state) {
  const transition = transitionOf(law, state);
  const words = {
    never: "Without wear and friction the radius does not matter.",
    below: "The transition radius is beyond the thickest wire that the table covers.",
    above: "The transition radius is below the thinnest wire that the table covers.",
    beyond: "The transition radius is beyond the solutions: where it would be, none with as much friction and "
      + "wear is near.",
  };
  if (transition.why) return words[transition.why];
  return `Transition radius: at ${wire(state, transition.radius)} what the radius changes becomes as large `
    + "as what it does not.";
}

function saysContact(state) {
  const touch = state.Gamma_o/(state.mu*touchOf(state.alpha));
  return gOf(state) > touchOf(state.alpha)
    ? `The wire touches the crack tip, as all do that are thinner than ${wire(state, touch)}.`
    : `The crack runs ahead of the wire, as it does with all from ${wire(state, touch)} on.`;
}

function saysError(law, force) {
  if (!Number.isFinite(force.error)) {
    return `How far the number may be off is unknown: ${law.unknown}.`;
  }
  if (force.error === 0) return "The number is exact: without wear and friction the force is Γ_o.";
  if (force.law) {
    const why = force.error <= DATA.rtol ? `the cheapest whose error is known to be ${percent(DATA.rtol)} or less`
      : "the best of those whose error is known";
    return `The law is “${force.law}” here, ${why}: the number may be off by up to ${percentUp(force.error)} `
      + "beside finite elements on which the wire rubs.";
  }
  const beside = law.beside || "of this law; how far the law itself is off is another matter";
  return `The number may be off by up to ${percentUp(force.error)} beside finite elements ${beside}.`;
}

// Everything that is said about a state, sentence by sentence.
function sentencesOf(state) {
  const law = lawOf(state.law), refused = refusalOf(law, state);
  if (refused) return [refused];
  const force = forceOf(law, state), inside = holds(force.g, state.alpha);
  return [
    saysDominant(force),
    ...(rubs(state) ? [saysStretches(law, state)] : []),
    saysTransition(law, state),
    ...(inside ? [saysContact(state)] : []),
    saysError(law, force),
    ...doubts(state),
  ];
}
