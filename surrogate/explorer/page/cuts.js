// Own cuts: typed or pasted as lines or as a table, or out of a file that is chosen or dropped on the page.

// The cuts of bare lines: a wire in mm and a force in N/m in each, and its standard error.
function cutsOfLines(text, diameters) {
  const cuts = [], wrong = [];
  for (const line of text.split(/\r\n|\r|\n/)) {
    if (!line.trim() || line.trim().startsWith("#")) continue;
    const between = /[\s;]/.test(line.trim()) ? /[\s;]+/ : ",";  // where a comma may be decimal
    const [across, force, std] = line.trim().split(between).map(readNumber);
    if (isCut(across, force) && !(std < 0)) cuts.push([1e-3*across/(diameters ? 2 : 1), force, std || null]);
    else wrong.push(line.trim());
  }
  const said = wrong.length
    ? `Not understood, and left out: ${wrong.slice(0, 3).join(" | ")}. Write a wire in mm and a force in N/m.` : "";
  return {cuts, said};
}

const cutsText = (cuts, diameters) => cuts.map(([radius, force, std]) =>
  [Number((1e3*radius*(diameters ? 2 : 1)).toPrecision(6)), force, ...(std ? [std] : [])].join("  ")).join("\n");

const MOST_CUTS = 2000, LARGEST_TABLE = 1e6;

// The cuts of a table and what is said of them; without cuts where it is not understood.
function cutsOfNames(text) {
  try {
    const table = cutsOfTable(text);
    if (table.cuts.length > MOST_CUTS) {
      refuse(`there are ${table.cuts.length} cuts, and ${MOST_CUTS} at most are drawn; give a mean for each wire.`);
    }
    return {cuts: table.cuts, said: saysTable(table)};
  } catch (error) {
    if (!(error instanceof NotUnderstood)) throw error;
    return {cuts: null, said: `Not understood: ${error.message}`};
  }
}

const cutsOf = (text, diameters) => isTable(text) ? cutsOfNames(text) : cutsOfLines(text, diameters);

// The text of a file, in UTF-8 or UTF-16 or else as Windows writes it in the West.
function decoded(bytes) {
  const [first, second] = bytes;
  if (first === 0xff && second === 0xfe) return new TextDecoder("utf-16le").decode(bytes);
  if (first === 0xfe && second === 0xff) return new TextDecoder("utf-16be").decode(bytes);
  try {
    return new TextDecoder("utf-8", {fatal: true}).decode(bytes);
  } catch {
    return new TextDecoder("windows-1252").decode(bytes);
  }
}

// The cuts of a file, which must be a table with names of columns.
async function cutsOfFile(file) {
  const no = (words) => ({cuts: null, said: `${file.name}: ${words}`});
  if (file.size > LARGEST_TABLE) {
    return no("too large for a table of cuts. Of records of a testing machine 'wirecut steady' makes such a table.");
  }
  const bytes = new Uint8Array(await file.arrayBuffer());
  if (bytes[0] === 0x50 && bytes[1] === 0x4b) {
    return no("a spreadsheet, which this page does not read. Save it as CSV, or use 'wirecut explore --cuts'.");
  }
  const text = decoded(bytes);
  if (/[\0]/.test(text)) return no("no text, and so no table. Save it as CSV.");
  const {cuts, said} = cutsOfNames(text);
  return {cuts, said: `${file.name}: ${said}`};
}

// Have what is typed, chosen or dropped become the cuts of the page; what is not understood stays to be mended.
function listenForCuts(change) {
  const typed = byId("cuts"), chooser = byId("cuts-file"), section = byId("own");
  const take = ({cuts, said}) => {
    byId("cuts-wrong").textContent = said;
    typed.setAttribute("aria-invalid", String(cuts === null));
    if (cuts) change({cuts});
  };
  const takeFile = async (file) => {
    const read = await cutsOfFile(file);
    take(read);
    typed.setAttribute("aria-invalid", "false");  // which it did not come from
    if (read.cuts) typed.value = cutsText(read.cuts, current().diameters);
  };
  typed.addEventListener("input", () => take(cutsOf(typed.value, current().diameters)));
  chooser.addEventListener("change", () => {
    if (chooser.files.length) takeFile(chooser.files[0]);
    chooser.value = "";  // so that the same file, mended, can be chosen again
  });
  for (const kind of ["dragenter", "dragover", "dragleave", "drop"]) {
    document.addEventListener(kind, (event) => {
      if (!event.dataTransfer?.types.includes("Files")) return;
      event.preventDefault();
      section.classList.toggle("dropping", kind === "dragover" || kind === "dragenter");
      if (kind === "drop" && event.dataTransfer.files.length) takeFile(event.dataTransfer.files[0]);
    });
  }
}

// Show the cuts of a state where nobody types, and nothing waits to be mended.
function showCuts(state) {
  const typed = byId("cuts");
  byId("cuts-unit").textContent = state.diameters ? "diameter in mm" : "radius in mm";
  if (document.activeElement === typed || typed.getAttribute("aria-invalid") === "true") return;
  typed.value = cutsText(state.cuts, state.diameters);
}
