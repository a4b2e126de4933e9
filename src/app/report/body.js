// The body of a run with a slider through its rows, and the choices that all bodies share.
const panels = [];
const choices = { field: null, scale: null, range: "all", hide: 0, cut: "none", cutAt: 0.5, together: true };
const mostPositions = 300, legendWidth = 90;

class Panel {
  constructor(run) {
    Object.assign(this, { run, body: run.body, frames: new Map(), position: 0 });
    this.canvas = make("canvas", { tabindex: "0", role: "img", "aria-label": "Body of " + run.title });
    this.over = make("canvas", { class: "over", "aria-hidden": "true" });
    this.slider = make("input", { type: "range", min: "0", step: "1", "aria-label": "Row of " + run.name,
      oninput: () => this.move(Number(this.slider.value)) });
    this.says = make("output", { class: "says" });
    this.value = make("output", { class: "says" });
    const button = (text, act) => make("button", { type: "button", onclick: act }, text);
    this.player = button("Play", () => this.play());
    this.stage = make("div", { class: "stage" }, this.canvas, this.over);
    this.element = make("figure", {}, runs.length > 1 ? make("figcaption", {}, run.title) : null,
      this.stage,
      make("div", { class: "slide" }, this.player, this.slider), this.says, this.value,
      make("div", { class: "tools" }, button("Whole body", () => this.drawing.reset()),
        button("PNG", () => this.savePng()), button("CSV", () => this.saveCsv())));
    panels.push(this);
  }
  async open() {
    this.model = await readBody(this.body);
    this.drawing = new (this.body.dimension === 3 ? Space : Plane)(this.canvas, this.model, this.run);
    const [width, height] = this.drawing.ranges.map(([a, b]) => b - a);
    const shape = this.body.dimension === 3 ? 0.45 : height / (width || height || 1);
    this.stage.style.aspectRatio = String(1 / Math.min(Math.max(0.85 * shape, 0.28), 0.52));
    this.setPositions();
    this.setFaces();
    this.canvas.addEventListener("pointermove", (event) => this.tell(event));
    this.canvas.addEventListener("dblclick", () => this.drawing.reset());
    this.canvas.addEventListener("keydown", (event) => this.key(event));
    this.drawing.onRedraw = () => this.drawOver();
    new ResizeObserver(() => this.frame && this.draw()).observe(this.canvas);
  }
  // Positions of the slider are rows: of field files and, where broken bonds have numbers, between
  // them.
  setPositions() {
    const step = this.run.history.column("step"), rows = this.run.history.rows;
    this.rowOfFrame = this.body.frames.map((frame) => {
      let row = 0;
      while (step && row + 1 < rows && step[row] < frame.step) ++row;
      return row;
    });
    const chosen = new Set(this.rowOfFrame);
    if (this.body.broken > 0 && this.run.history.column("broken_bonds")) {
      const every = Math.max(1, rows / mostPositions);
      for (let k = 0; k * every < rows; ++k) chosen.add(Math.floor(k * every));
    }
    this.positions = [...chosen].sort((a, b) => a - b);
    this.slider.max = String(this.positions.length - 1);
    this.slider.disabled = this.player.disabled = this.positions.length < 2;
    this.position = this.positions.length - 1;
    this.row = this.positions[this.position];
  }
  // Broken bonds between nearest neighbours, of which the faces of cracks are drawn.
  setFaces() {
    const { places, broken: [first, second], sizes, kind } = this.model;
    const nearest = this.body.square ? 1.2 : 1.5;
    this.faces = [];
    this.lines = [];
    for (let k = 0; k < first.length; ++k) {
      const i = first[k], j = second[k];
      if (kind[i] !== 0 || kind[j] !== 0) continue;
      this.lines.push(k);
      const length = Math.hypot(...places.map((x) => x[j] - x[i]));
      if (length > 0 && length <= nearest * Math.max(sizes[i], sizes[j])) this.faces.push({ k, length });
    }
  }
  // Shows a position, or a row near it; other bodies follow to the row of the nearest displacement.
  move(position, follow = true, row = null) {
    this.position = Math.min(Math.max(position, 0), this.positions.length - 1);
    this.row = row ?? this.positions[this.position];
    this.slider.value = String(this.position);
    this.show();
    if (!follow || !choices.together) return;
    const u = this.run.history.column("displacement")[this.row];
    const share = this.position / Math.max(this.positions.length - 1, 1);
    for (const other of panels) {
      if (other === this || !other.positions) continue;
      const their = other.run.history.column("displacement");
      const distance = (k) => Math.abs(their[other.positions[k]] - u);
      let best = Math.round(share * (other.positions.length - 1));
      if (other.run.analysis === this.run.analysis) {
        other.positions.forEach((row, k) => (best = distance(k) < distance(best) ? k : best));
      }
      other.move(best, false);
    }
  }
  goTo(row, follow = true) {
    const at = this.positions.findIndex((known) => known >= row);
    this.move(at < 0 ? this.positions.length - 1 : at, follow, row);
  }
  play() {
    if (this.timer) {
      clearInterval(this.timer);
      this.timer = null;
    } else {
      const stride = Math.max(1, Math.round(this.positions.length / 120));
      if (this.position >= this.positions.length - 1) this.move(0);
      this.timer = setInterval(() => {
        this.move(this.position + stride);
        if (this.position >= this.positions.length - 1) this.play();
      }, 80);
    }
    this.player.textContent = this.timer ? "Pause" : "Play";
  }
  key(event) {
    const turns = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1] };
    if (event.key === "+" || event.key === "-") this.drawing.magnify(event.key === "+" ? 1.25 : 0.8);
    else if (event.key === "0") this.drawing.reset();
    else if (turns[event.key] && this.drawing.rotate) this.drawing.rotate(...turns[event.key]);
    else return;
    event.preventDefault();
    event.stopPropagation();
    this.drawing.redraw();
  }
  async show() {
    let number = 0;
    this.rowOfFrame.forEach((row, f) => (number = row <= this.row ? f : number));
    for (const chart of charts) chart.show(this.run, this.row);
    if (!this.frames.has(number)) {
      this.frames.set(number, readFrame(this.body, this.body.frames[number]));
    }
    const frame = await this.frames.get(number);
    const isNew = this.number !== number;
    Object.assign(this, { frame, number });
    if (isNew && this.onFrame) this.onFrame(this.body.frames[number]);
    this.draw();
  }
  valuesOf(name) {
    const field = this.body.fields.findIndex((known) => known.name === name);
    if (field >= 0) return this.frame.values[field];
    if (name !== "displacement") return null;
    const parts = this.frame.values.slice(0, this.body.dimension);
    return parts[0].map((x, i) => Math.hypot(...parts.map((part) => part[i])));
  }
  draw() {
    const n = this.body.particles, values = this.valuesOf(choices.field);
    const damage = this.valuesOf("damage"), { kind } = this.model;
    const loose = (i) => damage !== null && damage[i] > 0.999;
    const known = (i) => kind[i] === 0 && !loose(i);
    this.scale = choices.range === "all" || !values ? scaleOfAll(choices.field)
      : scaleOfRow(this, values, known);
    const shade = new Uint8Array(n);
    for (let i = 0; values && i < n; ++i) shade[i] = this.scale.shade(values[i]);
    const axis = "xyz".indexOf(choices.cut), range = axis < 0 ? null : this.drawing.ranges[axis];
    const limit = range ? range[0] + choices.cutAt * (range[1] - range[0]) + 0.01 * this.body.spacing : 0;
    const isCut = (i) => range && this.model.places[axis][i] > limit;
    const largest = Math.max(...this.body.bar_range.map(Math.abs)) || 1;
    this.drawing.draw({
      shade, loose, colors: this.scale.colors, scale: displacementScale(),
      displacement: this.frame.values.slice(0, this.body.dimension),
      ...this.cracks(), hiddenFace: isCut,
      hidden: (i) => isCut(i) || (choices.hide > 0 && damage && damage[i] < choices.hide),
      bars: this.frame.bars ? this.frame.bars.map((stress) => stress / largest) : null,
      elements: this.frame.offsets ? this.frame : null,
    });
    this.drawOver();
    this.caption();
  }
  // Faces of the bonds broken before this row, by the opening of each, and all of these bonds.
  cracks() {
    const { places, broken: [first, second], brokenAt } = this.model;
    const count = this.run.history.column("broken_bonds");
    const isBroken = (k) => !count || brokenAt[k] <= count[this.row];
    const u = this.frame.values.slice(0, this.body.dimension);
    const open = this.faces.filter(({ k }) => isBroken(k)).map(({ k, length }) => {
      const i = first[k], j = second[k];
      return [k, u.reduce((sum, x, a) => sum + (x[j] - x[i]) * (places[a][j] - places[a][i]), 0) / length];
    });
    const widest = open.reduce((most, [, opening]) => Math.max(most, opening), 0) || 1;
    const faces = Array.from({ length: openingSteps + 1 }, () => []);
    for (const [k, opening] of open) {
      faces[Math.max(Math.round((openingSteps * opening) / widest), 0)].push(k);
    }
    return { faces, lines: this.lines.filter(isBroken) };
  }
  caption() {
    const at = (name) => {
      const column = this.run.history.column(name);
      const known = this.run.rows.columns.find((c) => c.name === name);
      return column ? [withUnit(`${words(name)} ${short(column[this.row])}`, known.unit)] : [];
    };
    const file = this.body.frames[this.number], step = this.run.history.column("step");
    const parts = [...at("step").map((text) => text.replace("step", "row")), ...at("time"),
      ...at("broken_bonds"), ...at("cracked_particles"), ...at("load"), ...at("displacement")];
    if (step && step[this.row] !== file.step) parts.push(`fields of row ${file.step}`);
    this.says.textContent = parts.join(" · ");
  }
  // The legend: colours of the field, a length, the scale of displacements.
  drawOver() {
    const canvas = this.over, width = canvas.clientWidth, height = canvas.clientHeight;
    canvas.width = devicePixelRatio * width;
    canvas.height = devicePixelRatio * height;
    const c = canvas.getContext("2d"), { scale } = this;
    c.scale(devicePixelRatio, devicePixelRatio);
    c.font = "12px sans-serif";
    c.fillStyle = css("--text");
    const left = width - 78, bottom = height - 24, high = Math.min(150, height - 60), rows = shades;
    for (let k = 0; k < rows; ++k) {
      c.fillStyle = rgb(scale.color((k + 0.5) / rows));
      c.fillRect(left, bottom - (high * (k + 1)) / rows, 14, high / rows + 0.5);
    }
    c.fillStyle = css("--text");
    for (const value of ticksOf(scale.low, scale.high, 5)) {
      const y = bottom - ((value - scale.low) / (scale.high - scale.low)) * high;
      c.fillRect(left + 14, y - 0.5, 4, 1);
      c.fillText(short(value), left + 21, y + 4);
    }
    c.textAlign = "right";
    c.fillText(withBrackets(scale.name, scale.unit), width - 8, bottom - high - 10);
    c.textAlign = "left";
    const length = niceBelow(130 / this.drawing.pixels), px = length * this.drawing.pixels;
    c.fillRect(12, height - 14, px, 2);
    c.fillText(`${withUnit(short(length), this.run.length_unit)}, displacements × ` +
      short(displacementScale()), 12, height - 20);
  }
  tell(event) {
    if (event.buttons || !this.frame) return;
    const i = this.drawing.pick(event.offsetX, event.offsetY), values = this.valuesOf(choices.field);
    if (i < 0 || !values) return (this.value.textContent = "");
    const place = this.model.places.map((x) => short(x[i])).join(", ");
    this.value.textContent = `particle ${i} at (${place}): ` +
      withUnit(`${choices.field} ${short(values[i])}`, this.scale.unit);
  }
  savePng() {
    const picture = make("canvas", { width: this.over.width, height: this.over.height });
    const c = picture.getContext("2d");
    c.fillStyle = css("--back");
    c.fillRect(0, 0, picture.width, picture.height);
    c.drawImage(this.canvas, 0, 0, picture.width, picture.height);
    c.drawImage(this.over, 0, 0);
    picture.toBlob((blob) => save(`${this.run.directory}_body.png`, blob));
  }
  // Places and all fields of the particles, in the steps of the report.
  saveCsv() {
    const names = ["x", "y", "z"].slice(0, this.body.dimension)
      .concat(this.body.fields.map((field) => field.name.replaceAll(" ", "_")));
    const columns = [...this.model.places, ...this.frame.values], lines = [names.join(",")];
    for (let i = 0; i < this.body.particles; ++i) {
      lines.push(columns.map((column) => Number(column[i].toPrecision(7))).join(","));
    }
    save(`${this.run.directory}_fields_${this.body.frames[this.number].step}.csv`, lines.join("\n") + "\n",
      "text/csv");
  }
}

const redrawAll = () => panels.forEach((panel) => panel.frame && panel.draw());
const displacementScale = () => choices.scale ?? Math.min(...panels.map((panel) => panel.body.scale));

// The range of a field over all rows and runs, without the half per cent of outliers at either end.
function scaleOfAll(name) {
  const ranges = [], units = [];
  for (const { body } of panels) {
    const field = body.fields.find((known) => known.name === name);
    if (field) {
      ranges.push(field.shown);
      units.push(field.unit);
    } else {
      const parts = body.fields.slice(0, body.dimension);
      ranges.push([0, Math.hypot(...parts.map(({ shown }) => Math.max(...shown.map(Math.abs))))]);
      units.push(parts[0].unit);
    }
  }
  return new Scale(name, units.every((unit) => unit === units[0]) ? units[0] : "",
    Math.min(...ranges.map(([low]) => low)), Math.max(...ranges.map(([, high]) => high)));
}

function scaleOfRow(panel, values, known) {
  let low = Infinity, high = -Infinity;
  values.forEach((value, i) => {
    if (!known(i)) return;
    low = Math.min(low, value);
    high = Math.max(high, value);
  });
  return new Scale(choices.field, scaleOfAll(choices.field).unit, low, high);
}

// Names of the length of displacements and of the fields of all bodies.
const fieldNames = () => ["displacement", ...new Set(runs.flatMap(({ body }) =>
  (body ? body.fields.map((field) => field.name) : [])))];

const noField = make("p", { class: "alert", role: "alert", hidden: true });

// Chooses a field by its name here or in the field files; an unknown name changes nothing.
function chooseField(name) {
  const known = fieldNames(), text = words(name || "");
  const others = new Map([["stress", "von Mises stress"], ["region", "material"]]);
  const field = [text, others.get(text), "largest " + text].find((one) => known.includes(one));
  choices.field = field || choices.field;
  noField.hidden = Boolean(!name || field);
  noField.textContent = noField.hidden ? "" : `no field ${name}; known: ${known.join(", ")}`;
}

// The controls of all bodies.
function bodyControls() {
  const names = fieldNames();
  const hasDamage = panels.some(({ body }) => body.fields.some(
    (field) => field.name === "damage" && field.range[1] > 0));
  const hasStress = names.includes("von Mises stress");
  choices.field ??= hasDamage ? "damage" : hasStress ? "von Mises stress" : "displacement";
  const set = (key, convert = String) => (event) => {
    choices[key] = convert(event.target.value);
    redrawAll();
  };
  const select = (key, options) => {
    const box = make("select", { onchange: set(key) });
    for (const [value, text] of options) box.append(make("option", { value }, text));
    box.value = choices[key];
    return box;
  };
  const number = (value) => (value > 0 ? Number(value) : null);
  const label = (text, input) => make("label", {}, text + " ", input);
  const tools = make("div", { class: "tools" },
    label("Field", select("field", names.map((name) => [name, name]))),
    label("colour range:", select("range", [["all", "all rows"], ["row", "this row"]])),
    label("displacements ×", make("input", { type: "number", min: "0", step: "any",
      value: short(displacementScale()), oninput: set("scale", number) })));
  if (panels.some(({ body }) => body.dimension === 3)) {
    tools.append(label("hide damage below", make("input", { type: "range", min: "0", max: "1",
      step: "0.01", value: String(choices.hide), oninput: set("hide", Number) })),
      label("cut along", select("cut", ["none", "x", "y", "z"].map((axis) => [axis, axis]))),
      label("at", make("input", { type: "range", min: "0", max: "1", step: "0.01",
        value: String(choices.cutAt), oninput: set("cutAt", Number) })));
  }
  if (panels.length > 1) {
    tools.append(label("move together", make("input", { type: "checkbox", checked: choices.together,
      onchange: (event) => (choices.together = event.target.checked) })));
  }
  return tools;
}
