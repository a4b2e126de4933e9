// The page: texts, tables, curves and bodies of all runs.
const runs = report.runs;
const sizeKeys = ["particles", "bonds", "cells", "unknowns", "unknowns_at_end", "elements",
  "elements_at_end", "boxes", "spacing", "horizon"];
const isEnergy = (key) => /_(energy|work)$/.test(key) || key === "energy_error";
const isTime = (key) => key.startsWith("seconds.") || ["peak_memory_bytes", "factor_bytes", "threads",
  "ranks", "version", "commit", "factorizations", "iterations", "particle_steps_per_second"].includes(key);
const inSentences = ["title", "units", "analysis", "model", "status", "reason"];

const section = (title, ...content) => make("section", {}, make("h2", {}, title),
  ...content.filter(Boolean));
const list = (kind, texts) => (texts && texts.length
  ? make("ul", { class: kind }, ...texts.map((text) => make("li", {}, text))) : null);
const beside = (...items) => make("div", { class: "beside" }, ...items.filter(Boolean));

function tableOf(head, rows, caption = "") {
  const line = (cells, name) => make("tr", {}, ...cells.map((cell) =>
    make(name, typeof cell === "number" ? { class: "number" } : {},
      typeof cell === "number" ? short(cell) : cell)));
  return make("div", { class: "table" }, make("table", {},
    caption ? make("caption", {}, caption) : null,
    head.length ? make("thead", {}, line(head, "th")) : null,
    make("tbody", {}, ...rows.map((row) => line(row, "td")))));
}

// Single values of a summary by their keys, those of tables as "seconds.analysis".
function valuesOf(summary) {
  const values = new Map();
  for (const [key, value] of Object.entries(summary)) {
    if (typeof value === "number" || typeof value === "string") values.set(key, value);
    if (value === null || typeof value !== "object" || Array.isArray(value)) continue;
    for (const [inner, number] of Object.entries(value)) {
      if (typeof number === "number") values.set(key + "." + inner, number);
    }
  }
  return values;
}

// A table of the summaries' values whose keys fit, with a column for each run.
function numbers(title, fits) {
  const all = runs.map((run) => valuesOf(run.summary));
  const keys = [...new Set(all.flatMap((values) => [...values.keys()]))].filter(fits);
  if (!keys.length) return null;
  const unit = (key) => (key.startsWith("seconds.") ? "s" : key.endsWith("_bytes") ? "bytes"
    : runs.map((run) => run.units[key]).find(Boolean) || "");
  return tableOf([title, ...runs.map((run) => (runs.length > 1 ? run.name : "value")), "unit"],
    keys.map((key) => [words(key).replace(".", ": "), ...all.map((values) => values.get(key) ?? "–"),
      unit(key)]));
}

// Components of a vector, with the decimals of the largest one.
function vectorText(parts) {
  const largest = Math.max(...parts.map(Math.abs));
  const decimals = largest > 0 ? Math.min(20, Math.max(0, 3 - Math.floor(Math.log10(largest)))) : 0;
  return parts.map((part) => short(Number(part.toFixed(decimals)) || 0)).join(", ");
}

// Lists of a summary, as cracks and stages, with a column for each key.
function listTables(key, title) {
  const entriesOf = (run) => listOf(run.summary[key]).filter((entry) => entry instanceof Object);
  return runs.filter((run) => entriesOf(run).length).map((run) => {
    const names = [...new Set(entriesOf(run).flatMap((entry) => Object.keys(entry)))];
    const text = (value) => (typeof value === "number" ? value : Array.isArray(value)
      ? vectorText(value) : String(value ?? "–"));
    const heading = (name) => (key === "cracks" && name === "bonds" ? "damaged bonds" : words(name));
    return tableOf(names.map((name) => withBrackets(heading(name), run.units[name])),
      entriesOf(run).map((entry) => names.map((name) => text(entry[name]))),
      runs.length > 1 ? title + ": " + run.name : "");
  });
}

// Stresses along bars at the field file that the body shows.
class BarChart {
  constructor(panel) {
    this.run = panel.run;
    this.box = make("div", { class: "curve", role: "img", "aria-label": "Bars of " + this.run.name });
    this.select = make("select", { onchange: () => this.draw() });
    this.head = make("figcaption");
    this.element = make("figure", {}, this.head, make("div", { class: "tools" },
      make("label", {}, "vertical ", this.select),
      make("button", { type: "button", onclick: () =>
        save(`${this.run.directory}_bars_${this.file.step}.csv`, this.text, "text/csv") }, "CSV")), this.box);
    panel.onFrame = (file) => this.load(file);
    charts.push(this);
  }
  show() {}
  async load(file) {
    if (file.bars === undefined) return;
    const text = await textOf(file.bars);
    Object.assign(this, { file, text, table: columnsOf(text) });
    if (!this.select.options.length) {
      for (const name of ["axial_stress", "bond_stress", "slip", "axial_force", "axial_strain"]) {
        if (this.table.names.includes(name)) this.select.append(make("option", { value: name }, words(name)));
      }
    }
    this.draw();
  }
  draw() {
    if (!this.table) return;
    const column = (name) => this.table.columns[this.table.names.indexOf(name)];
    const bar = column("bar"), x = column("distance"), y = column(this.select.value);
    const bars = [...new Set(bar)], unit = this.run.units[this.select.value] || "";
    const low = Math.min(0, ...x), high = Math.max(...x), empty = bars.map(() => null);
    const data = [[low, ...empty]];
    bar.forEach((number, k) => data.push([x[k], ...bars.map((b) => (b === number ? y[k] : null))]));
    data.push([high, ...empty]);
    this.head.textContent = `Bars at row ${this.file.step}` + (runs.length > 1 ? ": " + this.run.name : "");
    if (this.graph) this.graph.destroy();
    const axis = { axisLabelFormatter: (value) => short(value), axisLabelWidth: 70 };
    this.graph = new Dygraph(this.box, data, {
      labels: ["distance", ...bars.map((b) => "bar " + b)], legend: bars.length > 1 ? "follow" : "never",
      colors: bars.map((b, k) => lineColors()[k % 6]), strokeWidth: 1.6, includeZero: true,
      xlabel: escaped(withBrackets("distance along the bar", this.run.length_unit)),
      ylabel: escaped(withBrackets(words(this.select.value), unit)), axes: { x: axis, y: axis },
      gridLineColor: css("--grid"), axisLineColor: css("--line"),
    });
  }
}

function wordsOf(run) {
  const tables = make("details", {}, make("summary", {}, "The case"),
    ...run.tables.map((table) => tableOf([table.heading, ""], table.entries)));
  return make("article", {}, runs.length > 1 ? make("h3", {}, run.title) : null,
    make("p", {}, run.sentences.join(" ")), list("notes", run.notes),
    list("warnings", listOf(run.summary.warnings).map((text) => "Warning: " + text)),
    list("notes", listOf(run.summary.notes).map((text) => "Note: " + text)), tables);
}

function addCurves(page, pick) {
  const columns = [...new Set(runs.flatMap((run) => run.rows.columns.map((column) => column.name)))];
  const gauges = [...new Set(runs.flatMap((run) => run.rows.columns.filter((c) => c.is_gauge)
    .map((column) => column.name)))];
  const energies = columns.filter((name) => isEnergy(name));
  const progress = ["displacement", "step", "time"].filter((name) => columns.includes(name));
  const load = new Chart(runs, "Load and displacement",
    { x: "displacement", y: ["load"], xs: columns, ys: columns }, pick);
  page.append(section("Load and displacement", load.element));
  if (gauges.length) {
    const chart = new Chart(runs, "Gauges", { x: gauges[0], y: ["load"],
      xs: [...gauges, ...progress], ys: ["load", ...gauges] }, pick);
    page.append(section("Gauges", chart.element));
  }
  const thinned = runs.filter((run) => run.rows.shown < run.rows.all).map((run) =>
    `${run.name}: ${run.rows.shown} of ${run.rows.all} rows are in this report, more than a screen ` +
    "shows: of equal parts the first, the last, the smallest and the largest load.");
  page.append(...[list("notes", thinned)].filter(Boolean));
  return () => energies.length && page.append(section("Energies", new Chart(runs, "Energies",
    { x: columns.includes("time") ? "time" : "step", y: energies, xs: progress }, pick).element,
  numbers("energies of the last row", isEnergy)));
}

async function addBodies(page) {
  const withBody = runs.filter((run) => run.body);
  if (!withBody.length) return;
  for (const run of withBody) await new Panel(run).open();
  const few = withBody.filter((run) => run.body.frames.length < run.body.files).map((run) =>
    `${run.name}: ${run.body.frames.length} of ${run.body.files} field files are in this report, for its size.`);
  page.append(section("Body", bodyControls(), noField, beside(...panels.map((panel) => panel.element)),
    make("p", { class: "hint" }, "Colours are rounded to 1/16000 of the range. Drag to move" +
      (panels.some(({ body }) => body.dimension === 3) ? " or turn (shift: move)" : "") +
      ", wheel or + and − to zoom, 0 or double click for the whole body; arrow keys move the slider. " +
      "Cracks are drawn for each row, other fields for the field file before it."),
    list("notes", few)));
  const bars = panels.filter(({ body }) => body.frames.some((frame) => frame.bars !== undefined));
  if (bars.length) page.append(section("Bars", beside(...bars.map((panel) => new BarChart(panel).element))));
}

// Reads choices from the address: #row=120&field=damage&scale=50&cut=x&cutAt=0.5&hide=0.3
function applyAddress() {
  const hash = new URLSearchParams(location.hash.slice(1));
  chooseField(hash.get("field"));
  for (const key of ["range", "cut"]) choices[key] = hash.get(key) || choices[key];
  for (const key of ["scale", "cutAt", "hide"]) {
    if (hash.has(key)) choices[key] = Number(hash.get(key));
  }
  return hash;
}

async function showPage() {
  const page = make("main");
  document.title = [...new Set(runs.map((run) => run.title))].join(" · ");
  document.body.append(make("header", {}, make("h1", {}, document.title),
    make("p", {}, ...runs.map((run) => make("span", { class: "status " + run.status },
      (runs.length > 1 ? run.name + ": " : "") + run.status)))), page);
  const hash = applyAddress();
  for (const run of runs) run.history = await readHistory(run);
  const pick = (run, row) => panels.filter((panel) => panel.run === run).forEach((panel) => panel.goTo(row));
  const unitsOf = (run) => run.unit_names.split(",").slice(0, 2).join().replaceAll(" ", "");
  const differ = runs.some((run) => unitsOf(run) !== unitsOf(runs[0]));
  page.append(section("Summary", beside(...runs.map(wordsOf)), list("warnings", differ
    ? ["Warning: the runs have different units; curves are drawn as numbers"] : [])));
  const addEnergies = addCurves(page, pick);
  await addBodies(page);
  const cracks = listTables("cracks", "Cracks");
  if (cracks.length) page.append(section("Crack widths", ...cracks));
  const stages = listTables("stages", "Stages");
  if (stages.length) page.append(section("Stages", ...stages));
  addEnergies();
  const others = (key) => !sizeKeys.includes(key) && !isEnergy(key) && !isTime(key) &&
    !inSentences.includes(key) && !key.startsWith("calibration.") && !key.startsWith("constants.");
  page.append(section("Result, sizes and times", beside(numbers("result", others),
    numbers("size", (key) => sizeKeys.includes(key)), numbers("time and memory", isTime))));
  for (const run of runs.filter((known) => known.case !== undefined)) {
    const text = make("pre");
    page.append(make("details", { ontoggle: async () => (text.textContent ||= await textOf(run.case)) },
      make("summary", {}, "case.toml of " + run.name), text));
  }
  page.append(make("details", {}, make("summary", {}, "Licence of dygraphs, which draws the curves"),
    make("pre", {}, report.licence)), make("footer", {}, "Perilink " + report.version));
  charts.forEach((chart) => chart.draw());
  const moveTo = (address) => panels.forEach((panel) => {
    const step = panel.run.history.column("step"), row = Number(address.get("row"));
    const at = step ? step.findIndex((number) => number >= row) : row;
    address.has("row") && at >= 0 ? panel.goTo(at, false) : panel.move(panel.position, false);
    if (panel.drawing.rotate && address.has("turn")) panel.drawing.rotate(Number(address.get("turn")),
      Number(address.get("tilt")));
  });
  moveTo(hash);
  addEventListener("hashchange", () => moveTo(applyAddress()));
  document.documentElement.dataset.ready = String(Math.round(performance.now()));
}

function redraw() {
  charts.forEach((chart) => chart.draw());
  redrawAll();
}

darkTheme.addEventListener("change", redraw);
for (const [event, value] of [["beforeprint", true], ["afterprint", false]]) {
  addEventListener(event, () => {
    printing = value;
    document.documentElement.classList.toggle("printing", value);
    redraw();
  });
}
addEventListener("keydown", (event) => {
  const by = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
  if (!by || !panels.length || event.target.closest("input, select, canvas")) return;
  event.preventDefault();
  panels[0].move(panels[0].position + by);
});
const complain = (text) =>
  document.body.append(make("p", { role: "alert", class: "alert" }, text));
if (typeof DecompressionStream === "undefined") {
  complain("This browser cannot open the data: it has no DecompressionStream, as browsers since 2023.");
} else {
  showPage().catch((error) => complain("The report cannot be shown: " + error.message));
}
