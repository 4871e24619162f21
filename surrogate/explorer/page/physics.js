// What the page computes: the functions A, B, A* and B* are the exported table's, see `TABLE`.

// The laws of dissipation; the functions are the table's, by the names that Python uses.
// `factor` multiplies friction and wear, and `bend` is d ln factor/d ln g; `covers` says where the
// factor is known, and `ownError` how far it may be off.
const FIRST_ORDER = {factor: () => 1, bend: () => 0, covers: () => true, ownError: () => 0};

const LAWS = [
  {
    name: "projected", title: "projected", equation: "Eq. (S2)",
    arc: "arc", load: "normal_load", ...FIRST_ORDER,
    says: "the paper’s Eq. (S2): the shear on the wire counts by its part along the cut",
  },
  {
    name: "slip", title: "slip", equation: "balance of energy",
    arc: "slip_arc", load: "slip_load", ...FIRST_ORDER,
    says: "the balance of energy to first order in wear and friction: shear times slip",
    unknown: "the crack tip touches the wire or is close to it, where the force depends on how sharp the tip is",
  },
].filter((law) => law.arc in DATA.bounds);

const lawOf = (name) => LAWS.find((law) => law.name === name) ?? LAWS[0];

const clamped = (value, low, high) => Math.min(Math.max(value, low), high);

// A polynomial of rising powers, by Horner's rule.
const polynomialAt = (coefficients, at) => coefficients.reduceRight((sum, c) => sum*at + c, 0);

// The number of the interval between rising edges, of which the outer ones do not count.
const intervalOf = (edges, value) => edges.slice(1, -1).filter((edge) => value >= edge).length;

const touchOf = (alpha) => Math.exp(TABLE.logTouch(Math.log(alpha)));

// The highest g of the table at an alpha: ln g is straight in ln alpha between the points.
function highestG(alpha) {
  const points = DATA.domain.highest, at = Math.log(alpha);
  if (!points.length) return DATA.domain.g[1];
  let [a, g] = points[0];
  for (const [b, h] of points) {
    if (at <= Math.log(b)) {
      const t = b === a ? 0 : (at - Math.log(a))/(Math.log(b) - Math.log(a));
      return Math.exp(Math.log(g) + Math.max(0, t)*(Math.log(h) - Math.log(g)));
    }
    [a, g] = [b, h];
  }
  return g;
}

const ROUNDING = 1 + 1e-12;

const holdsAlpha = (alpha) => alpha >= DATA.domain.alpha[0] && alpha <= DATA.domain.alpha[1];

const holds = (g, alpha) => holdsAlpha(alpha) && g >= DATA.domain.g[0]
  && g <= highestG(alpha)*ROUNDING;

// The bound of |ln(table/finite elements)| of a function, constant in cells of alpha and of g, or of
// g over that at which the tip touches the wire; infinite where nothing is known.
function boundOf(name, g, alpha) {
  const {touch, errors, ...edges} = DATA.bounds[name];
  const at = touch.length ? Math.exp(Math.log(g) - polynomialAt(touch, Math.log(alpha))) : g;
  if (at < edges.g[0]) return Infinity;
  return errors[intervalOf(edges.g, at)][intervalOf(edges.alpha, alpha)] ?? Infinity;
}

const latest = {};

// A function of the table and its bound; the last one of each is kept, as loads vary more often than the contact.
function contactOf(name, g, alpha) {
  const kept = latest[name];
  if (kept?.g === g && kept.alpha === alpha) return kept;
  return latest[name] = {g, alpha, value: TABLE[name](g, alpha), bound: boundOf(name, g, alpha)};
}

const gOf = (s) => s.Gamma_o/(s.mu*s.R_w);

const rubs = (s) => s.xi !== 0 || s.tau_w !== 0;

// The force and its parts [N/m], and by how much it may be off; null outside the table and the law. That of
// "auto" has the law's name as well.
function forceOf(law, s) {
  if (law.forceOf) return law.forceOf(s);
  const g = gOf(s), {alpha, Gamma_o: cleavage} = s;
  if (!rubs(s)) return {g, cleavage, friction: 0, wear: 0, total: cleavage, error: 0};
  if (!holds(g, alpha) || !law.covers(g, s)) return null;
  const scale = 2*law.factor(g, s);
  const arc = contactOf(law.arc, g, alpha), load = contactOf(law.load, g, alpha);
  const wear = s.tau_w ? scale*(s.tau_w*s.R_w)*arc.value : 0;
  const friction = s.xi ? scale*(s.R_w*(s.xi*s.mu))*load.value : 0;
  const total = cleavage + friction + wear;
  const own = law.ownError(g, s);
  const off = (part, {bound}) => part === 0 ? 0 : part*(Math.expm1(bound) + own);
  const error = (off(friction, load) + off(wear, arc))/total;
  return {g, cleavage, friction, wear, total, error: Number.isFinite(error) ? error : NaN};
}

const withRadius = (s, R_w) => ({...s, R_w});

// Which part dominates: the one that has at least the threshold's share of the force.
function dominantOf(force) {
  return DATA.parts.find((part) => force[part]/force.total >= DATA.threshold) ?? DATA.transition;
}

// The ends of the radii [m] that the table covers for a material.
function radiiOf(s) {
  const length = s.Gamma_o/s.mu;
  return [length/highestG(s.alpha), length/DATA.domain.g[0]];
}

function spaced(low, high, perDecade) {
  const count = 2 + Math.ceil(perDecade*Math.log10(high/low));
  const step = Math.log(high/low)/(count - 1);
  const values = Array.from({length: count}, (_, i) => low*Math.exp(i*step));
  values[count - 1] = high;
  return values;
}

// Where a condition changes between two positive numbers, to the last digits if there are as many steps.
function changeBetween(condition, low, high, steps = 200) {
  const first = condition(low);
  for (let i = 0; i < steps; ++i) {
    const middle = Math.sqrt(low*high);
    if (middle <= low || middle >= high) break;
    if (condition(middle) === first) low = middle;
    else high = middle;
  }
  return high;
}

// The stretches of radius [m] in which one part dominates or none does, thin wires first; the part
// is null where the law has no force.
function stretchesOf(law, s) {
  const [low, high] = radiiOf(s);
  const at = (radius) => {
    const inside = Math.min(Math.max(radius, low), high);
    const force = forceOf(law, withRadius(s, inside));
    return force && dominantOf(force);
  };
  const stretches = [{from: low, part: at(low*(1 + 1e-9))}];
  let before = low;
  const [first, last] = [low*(1 + 1e-9), high*(1 - 1e-9)];
  const own = s.R_w > first && s.R_w < last ? [s.R_w] : [];
  for (const radius of [...spaced(first, last, 24), ...own].sort((a, b) => a - b)) {
    const latest = stretches[stretches.length - 1];
    const part = at(radius);
    if (part !== latest.part) {
      stretches.push({from: changeBetween((r) => at(r) === latest.part, before, radius), part});
    }
    before = radius;
  }
  return stretches.map((one, i) => ({...one, to: stretches[i + 1]?.from ?? high}));
}

// h(g), whose zero is the transition: what the radius does not change less what changes with it.
function transitionBalance(law, s, g) {
  const {alpha} = s, relative = s.tau_w/s.mu;
  const drag = 2*((relative ? relative*TABLE[law.arc](g, alpha) : 0)
    + (s.xi ? s.xi*TABLE[law.load](g, alpha) : 0));
  const slope = (relative ? relative*TABLE.byLogG(TABLE[law.arc], g, alpha) : 0)
    + (s.xi ? s.xi*TABLE.byLogG(TABLE[law.load], g, alpha) : 0);
  return g + law.factor(g, s)*(2*(law.bend(g, s)*drag + 2*slope) - drag);
}

// The transition radius [m], or why there is none: "never" where nothing rubs, "below" or "above"
// where it is at a g beyond the table, "beyond" where the law does not cover it.
function transitionOf(law, s) {
  if (!rubs(s)) return {why: "never"};
  if (law.transition) return law.transition(s);
  const ends = [DATA.domain.g[0], highestG(s.alpha)];
  const grid = spaced(...ends, 24);
  const dominated = (g) => transitionBalance(law, s, g) <= 0;
  let last = grid.length - 1;
  while (last >= 0 && !dominated(grid[last])) --last;
  if (last < 0) return {why: "below"};
  if (last === grid.length - 1) return {why: "above"};
  const g = changeBetween(dominated, grid[last], grid[last + 1]);
  return law.covers(g, s) ? {radius: s.Gamma_o/(s.mu*g)} : {why: "beyond"};
}
