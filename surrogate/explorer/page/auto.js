// The law "auto", by which Python computes unless told otherwise: at each point the cheapest law whose error
// beside coupled solutions is known to be small enough, and where nobody knows it the paper's.

// The force by that law, with the law's name and its error beside finite elements on which the wire rubs.
function forceOfAuto(s) {
  const [projected, slip, coupled] = ["projected", "slip", "coupled"].map((name) => LAWS.find((law) => law.name === name));
  const unknown = () => {
    const force = forceOf(projected, s);
    return force && {...force, law: "projected", error: rubs(s) ? NaN : 0};
  };
  if (!rubs(s) || !coupled || !coupled.reaches(gOf(s), s)) return unknown();
  const first = forceOf(slip, s);
  if (!first || !Number.isFinite(first.error)) return first && unknown();
  const off = first.error + swingOf(first, Math.expm1(coupled.most(first.g, s)));
  const best = off <= DATA.rtol ? null : amplified(forceOf(coupled, s), first, coupled, s);
  return best && (best.error <= DATA.rtol || !(off <= best.error)) ? best : {...first, law: "slip", error: off};
}

// How far the force may be off by which its own friction and wear are as much larger, or smaller.
function swingOf({cleavage, friction, wear}, swing) {
  const drag = friction + wear;
  return Math.max(drag*swing/(cleavage*(1 + swing) + drag), drag*swing/(cleavage + drag*(1 + swing)));
}

// The coupled force, whose error is that of the slip law's functions and that of kappa.
function amplified(force, first, coupled, s) {
  const share = (force.friction + force.wear)/force.total;
  const error = first.error*Math.max(1, coupled.factor(force.g, s)) + share*coupled.ownError(force.g, s);
  return {...force, law: "coupled", error};
}

LAWS.unshift({
  name: "auto", title: "auto", forceOf: forceOfAuto,
  says: "at each point the cheapest law whose error beside solutions with friction and wear is known to be small "
    + "enough; where no such solution is near, the paper’s, with effective strengths. So Python computes too",
  unknown: "no solution with friction and wear is near. The law is “projected” here, Eq. (S2) of the paper, "
    + "F_d/T = 2 R_w (τ_w A + ξ μ B), and τ_w and ξ are effective strengths",
  covers: () => true,
  // Both parts of the transition are of one law: the coupled one's where its solutions reach to that radius.
  transition: (s) => {
    const coupled = LAWS.find((law) => law.name === "coupled");
    const told = coupled ? transitionOf(coupled, s) : {};
    return told.radius ? told : transitionOf(LAWS.find((law) => law.name === "projected"), s);
  },
});
