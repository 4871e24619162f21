// The page: what it shows of a state, and what changes the state.

const byId = (id) => document.getElementById(id);

let state = stateOf(location.hash);
const current = () => state;

const fields = DATA.quantities.map((q) => field(q, change));
const plots = {
  map: plotIn(byId("map"), "point", "Map of what dominates the force",
    "Operating point: left and right change the wire, up and down the wear strength"),
  forces: plotIn(byId("forces"), "wire", "Force over the radius of the wire",
    "Wire: left and right change its radius"),
};

function change(changes) {
  state = {...state, typing: null, ...changes};
  show();
  keepAddress();
}

// Keep the height of the words while a point is dragged, so that the picture stays under the finger.
function holdWords(held) {
  const {style, offsetHeight} = byId("says");
  style.height = held ? `${offsetHeight}px` : "";
  style.overflow = held ? "hidden" : "";
}

function later(wait, act) {
  let timer = 0;
  return () => {
    clearTimeout(timer);
    timer = setTimeout(act, wait);
  };
}

// Browsers refuse an address that changes at every movement of a finger.
const keepAddress = later(250, () => {
  history.replaceState(null, "", `#${addressOf(state)}`);
});

const announce = later(600, () => { byId("spoken").textContent = byId("says").textContent; });

// A number whose last digits a machine can read.
function datum(name, value, text) {
  const node = document.createElement("data");
  node.value = String(value);
  node.dataset.name = name;
  node.textContent = text;
  return node;
}

function cells(law, force) {
  const number = (name) => force ? datum(`${law.name}.${name}`, force[name], digits(force[name])) : "–";
  const error = force ? datum(`${law.name}.error`, force.error, percentUp(force.error)) : "–";
  return [number("total"), number("cleavage"), number("friction"), number("wear"), error];
}

// What is not known of a law at the state, if anything.
function saysUnknown(law) {
  const force = forceOf(law, state), title = capital(law.title);
  if (!force) return `${title}: ${law.beyond}, and no force is shown.`;
  return Number.isFinite(force.error) ? ""
    : `${title}: how far the number may be off is unknown, because ${law.unknown}.`;
}

// The laws beside each other: a line for each, and the choice of what the pictures show.
function showLaws(refused) {
  const rows = LAWS.map((law) => {
    const force = refused ? null : forceOf(law, state), row = document.createElement("tr");
    row.className = law.name === state.law ? "shown" : "";
    const head = document.createElement("th");
    head.scope = "row";
    head.textContent = capital(law.title) + (force?.law ? `: ${force.law}` : "");
    head.title = law.says;
    row.append(head, ...cells(law, force).map((content) => {
      const cell = document.createElement("td");
      cell.append(content);
      return cell;
    }));
    return row;
  });
  byId("laws").replaceChildren(...rows);
  byId("laws-unknown").replaceChildren(...htmlOf(refused ? "" : LAWS.filter((law) => !law.forceOf).map(saysUnknown).filter(Boolean).join(" ")));
}

function showAnswer(refused) {
  const law = lawOf(state.law), force = refused ? null : forceOf(law, state);
  const answer = byId("answer");
  answer.classList.toggle("refused", Boolean(refused));
  byId("number").replaceChildren(force ? datum("total", force.total, digits(force.total)) : "no force");
  byId("number-unit").textContent = force ? "N/m" : "";
  const error = force && (Number.isFinite(force.error) ? `error up to ${percentUp(force.error)}` : "error unknown");
  byId("may-be-off").textContent = !force ? "" : force.law ? `${error}, by the law “${force.law}”` : error;
  byId("bar").textContent = force ? `${byId("number").textContent} N/m, ${byId("may-be-off").textContent}` : "no force";
  const sentences = sentencesOf(state);
  byId("says").replaceChildren(...sentences.map((text) => {
    const line = document.createElement("p");
    line.append(...htmlOf(text));
    return line;
  }));
}

// Letters with what is lowered after a low line, as in a picture.
function htmlOf(text) {
  return text.split(/(_[A-Za-z]+)/).map((piece) => piece.startsWith("_")
    ? Object.assign(document.createElement("sub"), {textContent: piece.slice(1)}) : piece);
}

// Numbers that the sentences speak of, for machines.
function showNumbers(refused) {
  const shown = [datum("g", gOf(state), digits(gOf(state)))];
  if (!refused) {
    const law = lawOf(state.law), force = forceOf(law, state);
    for (const part of DATA.parts) {
      shown.push(datum(`${part}-share`, force[part]/force.total, percent(force[part]/force.total)));
    }
    shown.push(datum("dominant", dominantOf(force), WORDS[dominantOf(force)]));
    shown.push(datum("transition", transitionOf(law, state).radius ?? transitionOf(law, state).why, ""));
    shown.push(datum("touch", state.Gamma_o/(state.mu*touchOf(state.alpha)), ""));
  }
  byId("numbers").replaceChildren(...shown);
}

const sizeOfPlot = (figure) => {
  const width = Math.max(280, figure.clientWidth);
  return {width, height: Math.round(Math.min(440, Math.max(290, 0.78*width)))};
};

function show() {
  const refused = refusalOf(lawOf(state.law), state);
  fields.forEach((one) => showField(one, state));
  showAnswer(refused);
  showLaws(refusal(state));
  showNumbers(refused);
  drawMap(plots.map, state, sizeOfPlot(byId("map")), change);
  drawForces(plots.forces, state, sizeOfPlot(byId("forces")), change);
  document.querySelectorAll("[name=law]").forEach((one) => { one.checked = one.value === state.law; });
  byId("diameters").checked = state.diameters;
  byId("law-says").replaceChildren(...htmlOf(`${capital(lawOf(state.law).says)}.`));
  showCuts(state);
  announce();
  if (parent !== window) parent.postMessage({wirecutHeight: document.body.scrollHeight + 32}, "*");
}

function lawChoice(law) {
  const label = document.createElement("label"), radio = document.createElement("input");
  Object.assign(radio, {type: "radio", name: "law", value: law.name});
  radio.addEventListener("change", () => change({law: law.name}));
  label.append(radio, ` ${law.title}`);
  return label;
}

function begin() {
  byId("quantities").append(...fields.map((one) => one.row));
  byId("law-choice").append(...LAWS.map(lawChoice));
  byId("diameters").addEventListener("change", (event) => change({diameters: event.target.checked}));
  listenForCuts(change);
  Object.values(plots).forEach((plot) => { plot.held = holdWords; });
  byId("reset").addEventListener("click", () => change({...DATA.start}));
  byId("save-picture").addEventListener("click", () =>
    download("wirecut.svg", "image/svg+xml", pictureOf([plots.map, plots.forces], state)));
  byId("save-numbers").addEventListener("click", () => download("wirecut.csv", "text/csv", tableOf(state)));
  byId("copy-link").addEventListener("click", copyLink);
  window.addEventListener("hashchange", () => { state = stateOf(location.hash); show(); });
  new ResizeObserver(() => show()).observe(byId("map"));
  show();
}

// Copy the address; where the browser forbids that, show it to be copied by hand.
async function copyLink() {
  const address = `${location.href.split("#")[0]}#${addressOf(state)}`;
  const said = byId("copied");
  try {
    await navigator.clipboard.writeText(address);
    said.textContent = "The link is copied.";
  } catch {
    history.replaceState(null, "", `#${addressOf(state)}`);
    said.textContent = "Copy the link from the address bar.";
  }
}

begin();
