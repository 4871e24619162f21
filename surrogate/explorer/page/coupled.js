// The law "coupled": friction and wear act on the solid, and so raise their own force by kappa.

// ln kappa, a polynomial of x = ln(g/g_touch), y = ln alpha, xi and w = ln(1 + tau_w/mu), where it is
// known, and how far it may be off.
const KAPPA = (() => {
  const {touch, terms, axes, reach, loadUnit, edges, errors, growth} = DATA.coupled;
  const {lowest, highest, leastShare} = DATA.coupled;

  // The coefficients by the power of the first variable, and so on; a number where none is left.
  function nested(rows) {
    if (!rows.length) return 0;
    if (rows[0].length === 1) return rows.reduce((sum, [c]) => sum + c, 0);
    const powers = Array.from({length: 1 + Math.max(...rows.map(([power]) => power))}, (_, i) => i);
    return powers.map((i) => nested(rows.filter(([power]) => power === i).map((row) => row.slice(1))));
  }

  function horner(rows, variables) {
    if (typeof rows === "number") return rows;
    const [first, ...others] = variables;
    return rows.reduceRight((sum, row) => sum*first + horner(row, others), 0);
  }

  const value = nested(terms);
  const byX = nested(terms.filter(([power]) => power).map(([power, ...row]) =>
    [power - 1, ...row.slice(0, -1), row[row.length - 1]*power]));

  // The interval of an even axis and the place in it.
  function nodeOf(axis, at) {
    const place = (at - axis[0])/(axis[1] - axis[0]);
    const i = clamped(Math.trunc(place), 0, axis.length - 2);
    return [i, place - i];
  }

  // The reach between its nodes, linear in each of x, y and the direction of the load.
  function reachAt(...places) {
    const [[i, s], [j, t], [k, u]] = places.map((at, n) => nodeOf(axes[n], at));
    const [, columns, depth] = axes.map((axis) => axis.length);
    let total = 0;
    for (const corner of [0, 1, 2, 3, 4, 5, 6, 7]) {
      const [a, b, c] = [corner >> 2, (corner >> 1) & 1, corner & 1];
      const weight = (a ? s : 1 - s)*(b ? t : 1 - t)*(c ? u : 1 - u);
      total += weight*reach.values[reach.places[((i + a)*columns + j + b)*depth + k + c]];
    }
    return total;
  }

  const placeOf = (g, alpha) => [Math.log(g) - polynomialAt(touch, Math.log(alpha)), Math.log(alpha)];

  const inAxes = (place) => place.map((at, n) => clamped(at, axes[n][0], axes[n][axes[n].length - 1]));

  // The size of a load, 1 on the outer edge of the campaign, and its direction, 1 for wear alone.
  function loadOf({mu, xi, tau_w}) {
    const rubbed = xi/loadUnit[0], worn = tau_w/mu/loadUnit[1], size = Math.max(rubbed, worn);
    const lesser = 0.5*Math.min(rubbed, worn)/(size || 1);
    return [size, rubbed > worn ? lesser : 1 - lesser];
  }

  // The variables, of the nearest load that is known, and whether this one is.
  function at(g, s) {
    const place = placeOf(g, s.alpha), near = inAxes(place), [size, direction] = loadOf(s);
    const reached = reachAt(...near, direction), known = size <= reached;
    const xi = known ? s.xi : reached*loadUnit[0]*clamped(2 - 2*direction, 0, 1);
    const wear = known ? s.tau_w/s.mu : reached*loadUnit[1]*clamped(2*direction, 0, 1);
    const inside = near.every((one, n) => one === place[n])
      && g >= lowest*(1 - 1e-9) && g <= highest*(1 + 1e-9);
    const variables = [...near, xi, Math.log1p(wear)];
    return {inside, free: inside && known, unloaded: size === 0, size, reached, variables};
  }

  function ofCell(table, g, s) {
    const [row, column] = placeOf(g, s.alpha).map((one, n) => intervalOf(edges[n], one));
    return table[row][column];
  }

  return {
    factor: (g, s) => Math.exp(horner(value, at(g, s).variables)),
    bend: (g, s) => {
      const {free, variables} = at(g, s);
      return free ? horner(byX, variables) : 0;
    },
    covers: (g, s) => {
      const {free, unloaded} = at(g, s);
      return free || unloaded;
    },
    ownError: (g, s) => {
      const {size, reached} = at(g, s);
      return Math.expm1(ofCell(errors, g, s)*clamped(size/reached, leastShare, 1));
    },
    // A bound of |ln kappa| where it is known: how far the first order may be off in its own force.
    most: (g, s) => ofCell(growth, g, s)*(s.xi + 0.1*Math.log1p(s.tau_w/s.mu)),
    reaches: (g, s) => at(g, s).free,
    inside: (g, s) => at(g, s).inside,
    ends: axes.map((axis) => [axis[0], axis[axis.length - 1]]),
  };
})();

LAWS.push({
  name: "coupled", title: "coupled", equation: "κ times slip",
  beside: "on which the wire rubs",
  arc: "slip_arc", load: "slip_load", ...KAPPA,
  says: "the shear on the wire acts on the solid, which raises its own force; known up to loads that "
    + "solutions with friction and wear reach before the tip touches the wire",
  unknown: "no finite elements tell it there",
  beyond: "no coupled solution is near", solutions: "the coupled solutions",
  // Why a state that the table covers has no force, with the remedy.
  refusal: (state) => {
    const {alpha} = state, [low, high] = KAPPA.ends[1].map(Math.exp), [, right] = KAPPA.ends[0];
    if (Math.log(alpha) < KAPPA.ends[1][0] || Math.log(alpha) > KAPPA.ends[1][1]) {
      return `No coupled solution is near: they cover α from ${digits(low)} to ${digits(high)}. `
        + "Choose another law.";
    }
    if (!KAPPA.inside(gOf(state), state)) {
      const thinnest = state.Gamma_o/(state.mu*touchOf(alpha)*Math.exp(right));
      return state.R_w < thinnest
        ? `No coupled solution is near: they end before the tip touches the wire, at ${wire(state, thinnest)} `
          + "in this solid. Take a thicker wire, or choose another law."
        : "No coupled solution is near a wire as thick as this. Take a thinner one, or choose another law.";
    }
    return "No coupled solution is near: friction and wear are more than the load that they reach before the "
      + "tip touches the wire. Lower ξ or τ_w, or choose another law.";
  },
});
