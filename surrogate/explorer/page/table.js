// A table of cuts, read as `read_measurements` reads simple ones: the same numbers, or words that say what is
// not understood, and then nothing of it is taken.

class NotUnderstood extends Error {}

const refuse = (words) => { throw new NotUnderstood(words); };

const READING = DATA.reading;
const MEANINGS = new Map(READING.words.flatMap(({means, names}) => names.map((name) => [name, means])));
const [AVERAGE, SUMMARY, DEVIATION] = ["average", "summary", "deviation"].map((name) => new RegExp(READING[name]));

const DELIMITERS = ["\t", ";", ",", "|", " "];
const NUMBERISH = String.raw`[+-]?(?:[0-9][0-9.,]*|[.,][0-9]+)(?:[eE][+-]?[0-9]{1,4})?`;
const WITH_UNIT = new RegExp(String.raw`^(${NUMBERISH})(?:\s*(?:±|\+/?-)\s*${NUMBERISH})?(?:\s*[^\W\d]\S{0,7})?$`);
const GROUPED = /^[+-]?[1-9][0-9]{0,2}([.,])[0-9]{3}(?:\1[0-9]{3})*$/;
const PLAIN_NUMBER = /^([+-]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+))(?:[eE]([+-]?[0-9]{1,4}))?$/;

const ELSE = "'wirecut explore --cuts' reads more kinds of tables.";

// A name in small letters without accents, its marks as blanks.
const plainName = (name) => name.normalize("NFKD").replace(/\p{M}/gu, "").toLowerCase().replaceAll("ß", "ss")
  .replace(/[_\-.:;,\s#|]+/g, " ").trim().replaceAll(" / ", "/");

// What a name may mean, the likeliest first, and whether it is one of several trials by its number.
function meaningOf(name) {
  const key = plainName(name);
  for (const known of [key, key.replace(AVERAGE, "")]) {
    if (MEANINGS.has(known)) return {means: MEANINGS.get(known), trial: false};
  }
  const base = /^(.*?) ?[0-9]{1,3}$/.exec(key)?.[1];
  for (const one of base ? [base, `${base} n`] : []) {
    if (MEANINGS.has(one)) return {means: MEANINGS.get(one), trial: true};
  }
  return {means: [], trial: false};
}

const SUPERSCRIPTS = {"²": "2", "³": "3", "¹": "1", "⁻": "-", "−": "-", "µ": "u", "μ": "u"};

// A unit as a power of ten of the SI unit and a factor; null where its kind has none of this spelling.
function unitOf(text, kind) {
  const spelled = text.trim().replace(/[²³¹⁻−µμ]/g, (one) => SUPERSCRIPTS[one])
    .replace(/[_\s]*\bper\b[_\s]*|_per_/g, "/").replaceAll("^", "").replaceAll("**", "")
    .replace(/[\s·*.]*\b([a-zA-Z]+)-([123])$/, (_, unit, power) => `/${unit}${power === "1" ? "" : power}`)
    .replaceAll(" ", "");
  const units = READING.units[kind], other = READING.synonyms[spelled.toLowerCase()];
  return units[spelled] ?? units[other] ?? null;
}

const bareUnit = (cell) => cell.trim().replace(/^[[({<]\s*|\s*[\])}>]$/g, "");

// A heading's name and the unit behind it, in brackets or after a mark.
function splitUnit(text) {
  const name = text.replace(/^[ :]+|[ :]+$/g, "");
  const bracketed = /^([^]*?)[\s_]*[[({<]\s*([^[\](){}<>]*?)\s*[\])}>]$/.exec(name);
  if (bracketed) return [bracketed[1], bracketed[2]];
  const inside = /^([^]*?)[\s_]*[[(]\s*([^[\]()]*?)\s*[\])]\s*(\w[\w .]*)$/.exec(name);
  if (inside && meaningOf(`${inside[1]} ${inside[3]}`).means.length) return [`${inside[1]} ${inside[3]}`, inside[2]];
  if (meaningOf(name).means.length) return [name, ""];
  for (const mark of [...name.matchAll(/[_\s,/]+(?:in\s+)?/g)].reverse()) {
    const [left, right] = [name.slice(0, mark.index), name.slice(mark.index + mark[0].length)];
    if (right && meaningOf(left).means.some(([, kind]) => unitOf(right, kind))) return [left, right];
  }
  return [name, ""];
}

// Cells of a line, without quotes and blanks around; a quote alone is an inch and opens nothing.
function cellsOf(line, mark) {
  const quotes = line.split('"').length % 2 === 1, cells = [""];
  let inside = false;
  for (const letter of mark === " " ? line.replace(/\s+/g, " ") : line) {
    if (letter === '"' && quotes) inside = !inside;
    else if (letter === mark && !inside) cells.push("");
    else cells[cells.length - 1] += letter;
  }
  return cells.map((cell) => cell.trim());
}

// Whether a line is a row of numbers, with words beside them or not.
function holdsNumbers(cells) {
  const numbers = cells.filter((cell) => WITH_UNIT.test(cell)).length;
  return cells.length > 1 && numbers > 0 && 2*numbers >= Math.min(cells.filter(Boolean).length, 3);
}

// What separates the numbers in most lines; a comma may be within one, and so comes after tab and semicolon.
function delimiterOf(lines) {
  let [best, most] = [",", 0];
  for (const mark of DELIMITERS) {
    const count = lines.filter((line) => line.includes(mark) && holdsNumbers(cellsOf(line, mark))).length;
    if (count > 1.5*most) [best, most] = [mark, count];
  }
  return best;
}

// A number's decimal sign; with ? where it may mark thousands; nothing where it has none.
function signOf(cell) {
  const number = WITH_UNIT.exec(cell)?.[1] ?? "", marks = number.match(/[.,]/g) ?? [];
  if (new Set(marks).size === 2) return marks.filter((one) => one === marks.at(-1)).length === 1 ? marks.at(-1) : "";
  if (marks.length > 1) return GROUPED.test(number) ? {".": ",", ",": "."}[marks[0]] : "";
  return marks.length && GROUPED.test(number) ? `${marks[0]}?` : marks[0] ?? "";
}

// The decimal sign that every number bears out.
function decimalOf(rows, mark) {
  const numeric = rows.filter(({cells}) => holdsNumbers(cells));
  const several = numeric.filter(({cells}) => cells.filter((cell) => WITH_UNIT.test(cell)).length > 1);
  const seen = {};
  for (const {line, cells} of several.length ? several : numeric) {
    for (const cell of cells) seen[signOf(cell)] ??= {line, cell};
  }
  if (seen["."] && seen[","]) {
    refuse(`there are two decimal signs, a point in line ${seen["."].line} and a comma in line ${seen[","].line}; `
      + "correct one of them.");
  }
  if (seen["."] || seen[","]) return seen["."] ? "." : ",";
  const open = seen[",?"] ?? (mark === ";" ? seen[".?"] : null);
  if (open) refuse(`line ${open.line}: ${open.cell} may be thousands or a decimal fraction; write one more digit.`);
  return ".";
}

// A cell's number times a unit, the power of ten rounded once; NaN where it is none.
function cellNumber(cell, decimal, [power, factor]) {
  let text = cell.replaceAll("−", "-").replace(/[\u202f\u00a0]/g, "");
  if (/^[+-]?[1-9][0-9]{0,2}(?:['’ ][0-9]{3})+(?![0-9])/.test(text)) text = text.replace(/['’ ]/g, "");
  const other = decimal === "." ? "," : ".";
  if (text.includes(other)) {
    const whole = text.split(decimal)[0];
    if (GROUPED.exec(whole)?.[1] !== other) return NaN;
    text = whole.replaceAll(other, "") + text.slice(whole.length);
  }
  const digits = PLAIN_NUMBER.exec(text.replace(",", "."));
  return digits ? Number(`${digits[1]}e${Number(digits[2] ?? 0) + power}`)*factor : NaN;
}

// The lines of a text that are not empty and no remark, with their numbers, in cells.
function rowsOf(text) {
  let lines = text.replace(/^\ufeff/, "").split(/\r\n|\r|\n/)
    .map((line, i) => ({line: i + 1, text: line.replace(/^[ \r\v\f]+|[ \r\v\f]+$/g, "")}))
    .filter(({text}) => text.trim() && !/^\s*"*#(?!"?\s*[,;\t])/.test(text));
  const stated = /^\s*"?sep=(.)"?\s*$/i.exec(lines[0]?.text ?? "")?.[1];
  if (stated) lines = lines.slice(1);
  const mark = stated ?? delimiterOf(lines.map((one) => one.text));
  return {mark, rows: lines.map(({line, text}) => ({line, cells: cellsOf(text, mark)}))};
}

const namesWire = (cell) => {
  const [first] = meaningOf(splitUnit(cell)[0]).means;
  return Boolean(first) && first[0].startsWith("wire_");
};

// Whether a text is a table with names of columns, rather than lines of bare numbers.
const isTable = (text) => rowsOf(text).rows.some(({cells}) => cells.some((cell) => meaningOf(splitUnit(cell)[0]).means.length))
  || (/\p{L}{2}/u.test(text.split(/\r\n|\r|\n/).find((line) => line.trim() && !line.trim().startsWith("#")) ?? ""));

// What each column of a header holds, if its name is known.
function headingsOf({line, cells}, below) {
  return cells.map((name, i) => {
    const [base, stated] = splitUnit(name), {means, trial} = meaningOf(base);
    const text = stated || bareUnit(below?.cells[i] ?? "");
    const known = text && means.find(([, kind]) => unitOf(text, kind));
    const place = `line ${line}, column ${i + 1} (${name})`;
    return {
      i, name, place, trial, text, quantity: known ? known[0] : "",
      unit: known ? unitOf(text, known[1]) : null,
      without: !known && means.length ? means[0][0] : "",
    };
  });
}

const isUnits = (row) => {
  const filled = row.cells.filter(Boolean).map(bareUnit), kinds = Object.keys(READING.units);
  const known = filled.filter((text) => kinds.some((kind) => unitOf(text, kind))).length;
  return known > 0 && 2*known >= filled.length && !filled.some((text) => WITH_UNIT.test(text));
};

const sumsUp = ({cells}) => SUMMARY.test(plainName(cells.find(Boolean) ?? ""));

// The columns by their quantity; refused where one is missing, twice there or without a unit.
function columnsOf(headings) {
  const kindOf = (quantity) => quantity.startsWith("wire_") ? "wire" : quantity.replace("_per_thickness", "");
  const kinds = new Set(headings.map((one) => kindOf(one.quantity)));
  for (const one of headings) {
    if (!one.without || kinds.has(kindOf(one.without))) continue;
    refuse(one.text ? `${one.place} has the unit ${one.text}, which is not known for it; ${ELSE}`
      : `${one.place} has no unit; write it behind the name, such as d_mm or "force [N/m]".`);
  }
  const columns = {};
  for (const one of headings.filter(({quantity}) => quantity)) {
    const earlier = columns[one.quantity] ??= [];
    if (earlier.length && !(one.trial && earlier[0].trial)) {
      refuse(`${one.place} gives the same again as column ${earlier[0].i + 1} (${earlier[0].name}); keep one of them.`);
    }
    earlier.push(one);
  }
  if (!columns.wire_radius === !columns.wire_diameter) {
    refuse(columns.wire_radius ? "the table has both a radius and a diameter of the wires; keep one of them."
      : "no column names a wire; write its header as wire_diameter_mm,force_per_thickness_N_per_m. If it is a "
        + "record of a testing machine, 'wirecut steady' makes a table of cuts out of such records.");
  }
  if (!columns.force_per_thickness && !columns.force) {
    refuse(`no column names a force with a unit that is known, such as force_per_thickness_N_per_m. ${ELSE}`);
  }
  if (!columns.force_per_thickness && !columns.thickness) {
    refuse("forces are not divided by the sample’s thickness, and no column has it; add a column thickness_mm, "
      + "or use 'wirecut explore --cuts FILE --thickness 20mm'.");
  }
  return columns;
}

// What reads one line: a number above 0 of a column, or null where its cell is empty.
function cellReader(decimal) {
  return (row, one) => {
    const cell = row.cells[one.i] ?? "";
    if (READING.empty.includes(cell.toLowerCase())) return null;
    const value = cellNumber(cell, decimal, one.unit);
    if (!(value > 0 && value < Infinity)) {
      refuse(`line ${row.line}, column ${one.i + 1} (${one.name}): “${cell.slice(0, 40)}” is no number above 0; `
        + `write digits with a decimal ${decimal === "." ? "point" : "comma"}.`);
    }
    return value;
  };
}

// The number of cuts that a standard deviation is of, where a column has it.
function countColumn(headings, std) {
  if (!std || !DEVIATION.test(plainName(std.name))) return null;
  return headings.find((one) => READING.counts.includes(plainName(one.name))) ?? null;
}

// The cuts of a table, as radii [m], forces [N/m] and standard errors, and what of it is not used.
function cutsOfTable(text) {
  const {mark, rows} = rowsOf(text), decimal = decimalOf(rows, mark);
  const start = rows.findIndex(({cells}) => cells.length > 1 && cells.some(namesWire));
  const header = rows[Math.max(0, start)] ?? refuse("the table is empty.");
  if (start >= 0 && header.cells.slice(1).some((cell) => WITH_UNIT.test(cell))
    && !header.cells.slice(1).some((cell) => meaningOf(splitUnit(cell)[0]).means.length)) {
    refuse(`the table lies on its side: one line a wire is read here. ${ELSE}`);
  }
  let body = rows.slice(Math.max(0, start) + 1);
  const below = body.length && isUnits(body[0]) ? body[0] : null;
  body = body.slice(below ? 1 : 0);
  const headings = headingsOf(header, below), columns = columnsOf(headings);
  return {...linesOf(body, headings, columns, decimal), unused: headings.filter((one) => one.name && !one.quantity)};
}

function linesOf(body, headings, columns, decimal) {
  const positive = cellReader(decimal), cuts = [], skipped = [];
  const wire = (columns.wire_radius ?? columns.wire_diameter)[0];
  const forces = columns.force_per_thickness ?? columns.force;
  const std = forces.length > 1 ? null : (columns.force_std ?? columns.total_std)?.[0] ?? null;
  const count = countColumn(headings, std), thickness = columns.thickness?.[0];
  const last = Math.max(...Object.values(columns).flat().map((one) => one.i));
  const beside = columns.force_per_thickness && thickness && columns.force?.length === 1 ? columns.force[0] : null;
  const over = (row, one) => {
    const value = positive(row, one);
    if (value === null || ["force_per_thickness", "force_std"].includes(one.quantity)) return value;
    return value/(thickness && positive(row, thickness)
      || refuse(`line ${row.line} has no thickness, by which its force is to be divided.`));
  };
  for (const row of body) {
    if (sumsUp(row)) {
      skipped.push(row.line);
      continue;
    }
    if (row.cells.slice(headings.length).some(Boolean) || row.cells.length <= last) {
      refuse(`line ${row.line} has ${row.cells.length} cells under ${headings.length} names; give one a column, and `
        + "where commas separate columns no decimal comma.");
    }
    const across = positive(row, wire), radius = across && across/(wire.quantity === "wire_diameter" ? 2 : 1);
    const error = std && over(row, std), repeats = count ? cellNumber(row.cells[count.i] ?? "", decimal, [0, 1]) : 1;
    if (count && !(repeats >= 1)) refuse(`line ${row.line} has no number of cuts in column ${count.name}.`);
    for (const one of forces) {
      const force = over(row, one);
      if (radius === null || force === null || (std && error === null)) skipped.push(row.line);
      else {
        const other = beside && forces.length === 1 ? over(row, beside) : null;
        if (other !== null && Math.abs(other - force) > 0.02*force) {
          refuse(`line ${row.line} gives ${digits(force)} N/m, but its force over its thickness is ${digits(other)} N/m; `
            + "correct one of them.");
        }
        cuts.push([radius, force, error === null ? null : error/Math.sqrt(repeats)]);
      }
    }
  }
  if (!cuts.length) refuse("no line has both a wire and a force.");
  return {cuts, skipped: [...new Set(skipped)], std, count};
}

// What is said of a table that was read.
function saysTable({cuts, skipped, unused, std, count}) {
  const few = (items) => items.slice(0, 6).join(", ") + (items.length > 6 ? " and others" : "");
  return [
    `${cuts.length} ${cuts.length === 1 ? "cut is" : "cuts are"} read.`,
    ...(skipped.length ? [`Left out as empty or a summary: line ${few(skipped)}.`] : []),
    ...(std && count ? [`${std.name} is divided by the square root of ${count.name}.`] : []),
    ...(std && !count ? [`${std.name} is taken for the standard error of each force.`] : []),
    ...(unused.some((one) => one !== count) ? [`Not used: ${few(unused.filter((one) => one !== count).map((one) => one.name))}.`] : []),
  ].join(" ");
}
