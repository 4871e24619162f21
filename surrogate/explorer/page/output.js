// Files for the user: the pictures as one SVG, the numbers as CSV.

function download(name, type, text) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([text], {type}));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

const about = (state) => DATA.quantities.map((q) =>
  `${q.symbol} = ${digits(state[q.key]/q.size, 4)}${q.unit ? ` ${q.unit}` : ""}`).join(", ");

// Both pictures side by side, with their style and what they were drawn for.
function pictureOf(plots, state) {
  const boxes = plots.map((plot) => plot.frame.viewBox.baseVal);
  const width = boxes.reduce((sum, box) => sum + box.width, 0);
  const height = Math.max(...boxes.map((box) => box.height)) + 30;
  const whole = svg("svg", {xmlns: SVG, width, height, viewBox: `0 0 ${width} ${height}`, class: "plot"});
  whole.append(svg("style", {}, document.getElementById("plot-style").textContent));
  whole.append(svg("rect", {width, height, class: "paper"}));
  let left = 0;
  plots.forEach((plot, i) => {
    const copy = plot.frame.cloneNode(true);
    copy.setAttribute("x", left);
    copy.querySelectorAll(".grip, .ring").forEach((node) => node.remove());
    left += boxes[i].width;
    whole.append(copy);
  });
  whole.append(lettered(`${about(state)}; law: ${lawOf(state.law).title}; wirecut ${DATA.version}`,
    {x: 14, y: height - 10, class: "caption"}));
  return new XMLSerializer().serializeToString(whole);
}

// The curves of all laws in rows, one for each radius; an error that is unknown is left empty.
function tableOf(state) {
  const lines = [
    `# wirecut ${DATA.version}, table of ${DATA.data_date}`,
    `# ${about(state)}`,
    "# relative_error: bound beside finite elements of the law; empty where unknown",
    "law,wire_radius_m,g,force_N_per_m,cleavage_N_per_m,friction_N_per_m,wear_N_per_m,relative_error",
  ];
  if (refusalOfMaterial(state)) return `${lines.join("\n")}\n`;
  for (const law of LAWS) {
    const rows = curveOf(law, state, rightEnd(state), 100).flat();
    if (!refusalOf(law, state)) rows.push({radius: state.R_w, ...forceOf(law, state)});
    rows.sort((a, b) => a.radius - b.radius);
    lines.push(...rows.map((one) => [law.name, one.radius, one.g, one.total, one.cleavage,
      one.friction, one.wear, Number.isFinite(one.error) ? one.error : ""].join(",")));
  }
  return `${lines.join("\n")}\n`;
}
