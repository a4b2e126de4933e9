// Curves of histories, drawn by dygraphs.
const charts = [];
const lineColors = () => isDark()
  ? ["#5ab4ec", "#f59a4a", "#3fcf9f", "#e6a3c8", "#9ad6f8", "#f2c14e"]
  : ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00"];
const escaped = (text) => text.replace(/[&<>"']/g, (letter) => "&#" + letter.charCodeAt(0) + ";");

const stageOf = (run, number) => listOf(run.summary.stages)[number - 1] || {};

// Curves of some columns over another one, for all runs. `pick` is called with a run and a row.
class Chart {
  constructor(runs, title, { x, y, xs = [], ys = [] }, pick) {
    Object.assign(this, { runs, title, x, y, pick, shown: new Map() });
    this.box = make("div", { class: "curve", role: "img", "aria-label": title });
    this.says = make("output", { class: "says" });
    this.legend = make("div", { class: "legend" });
    const tools = make("div", { class: "tools" });
    if (ys.length > 1) tools.append(this.choice("vertical", ys, "y"));
    if (xs.length > 1) tools.append(this.choice("horizontal", xs, "x"));
    const button = (text, act) => make("button", { type: "button", onclick: act }, text);
    tools.append(button("Whole curve", () => this.graph.resetZoom()),
      button("PNG", () => this.savePng()), button("SVG", () => this.saveSvg()),
      button("CSV", () => this.runs.forEach((run) =>
        save(run.directory + "_history.csv", run.history.text, "text/csv"))));
    this.element = make("figure", {}, tools, this.legend, this.box, this.says);
    charts.push(this);
  }
  choice(label, names, axis) {
    const select = make("select", { onchange: () => {
      this[axis] = axis === "x" ? select.value : [select.value];
      this.draw();
    } });
    for (const name of names) select.append(make("option", { value: name }, words(name)));
    select.value = axis === "x" ? this.x : this.y[0];
    return make("label", {}, label + " ", select);
  }
  // Whether a column is zero in the undeformed state.
  beginsAtZero(run, name) {
    return run.rows.columns.find((column) => column.name === name).begins_at_zero;
  }
  unit(name) {
    const known = this.runs.flatMap((run) => run.rows.columns).find((c) => c.name === name && c.unit);
    return known ? known.unit : "";
  }
  label(name) {
    const unit = this.unit(name);
    return words(name) + (unit ? " (" + unit + ")" : "");
  }
  // The curves: points are [x, y, row]. Stages of a run are curves of their own.
  series() {
    const list = [], colors = lineColors();
    this.runs.forEach((run, r) => this.y.forEach((name, k) => {
      const x = run.history.column(this.x), y = run.history.column(name);
      if (!x || !y) return;
      const stage = run.history.column("stage");
      const color = (number) => colors[number % colors.length];
      const of = this.runs.length > 1 ? run.name + (this.y.length > 1 ? ": " : "") : "";
      const base = of + (this.y.length > 1 || !of ? words(name) : "");
      const envelope = this.x === "displacement" && name === "load" && run.rows.envelope;
      // Before the first row the body is at rest.
      const isZero = [this.x, name].every((column) => this.beginsAtZero(run, column));
      const origin = isZero ? [[0, 0, -1]] : [];
      let curve = null;
      for (let row = 0; row < x.length; ++row) {
        const number = stage ? stage[row] : 0;
        if (!curve || curve.stage !== number) {
          const facts = stageOf(run, number), goesOn = curve && facts.loads &&
            facts.loads === stageOf(run, curve.stage).loads;
          const own = stage ? `${base}, ${facts.name || "stage " + number}` : base;
          const at = this.y.length > 1 ? k : stage ? r + number - 1 : r;
          curve = { run, label: own, color: color(at), stage: number, points: curve ? [] : origin,
            dash: this.y.length > 1 && r > 0 ? [7, 3 + 2 * r] : null,
            pale: Boolean(envelope), width: envelope ? 0.8 : 1.6 };
          // A stage that changes the loads of the stage before continues its curve.
          if (goesOn) curve.points.push([x[row - 1], y[row - 1], row - 1]);
          list.push(curve);
        }
        curve.points.push([x[row], y[row], row]);
      }
      if (!envelope) return;
      list.push({ run, label: (of ? of + ", " : "") + "smoothed curve of equal energy", color: color(r),
        points: [[0, 0, -1], ...envelope.map(([u, p]) => [u, p, -1])], dash: null, pale: false, width: 2.6 });
    }));
    list.forEach((curve, k) => (curve.key = k + " " + curve.label));
    return list;
  }
  draw() {
    const list = (this.curves = this.series());
    const all = list.flatMap((curve) => curve.points.map((point) => point[0]));
    const low = all.reduce((a, b) => Math.min(a, b), 0), high = all.reduce((a, b) => Math.max(a, b), 0);
    const margin = 0.02 * (high - low || 1), empty = list.map(() => null);
    // The first and the last row give dygraphs the range of curves that run back.
    const data = [[low - (low < 0 ? margin : 0), ...empty]];
    this.owners = [null];
    list.forEach((curve, c) => curve.points.forEach(([x, y, row]) => {
      const line = [x, ...empty];
      line[c + 1] = y;
      data.push(line);
      this.owners.push({ curve, row });
    }));
    data.push([high + margin, ...empty]);
    if (this.graph) this.graph.destroy();
    this.graph = null;  // the new one draws before it is here
    const axis = { axisLabelFormatter: (value) => short(value), axisLabelWidth: 70 };
    this.graph = new Dygraph(this.box, data, {
      labels: ["x", ...list.map((curve) => curve.key)],
      colors: list.map((curve) => curve.color + (curve.pale ? "70" : "")),
      series: Object.fromEntries(list.map((curve) => [curve.key,
        { strokeWidth: curve.width, strokePattern: curve.dash }])),
      xlabel: escaped(this.label(this.x)),
      ylabel: escaped(this.y.length > 1 ? withBrackets("energy", this.unit(this.y[0]))
        : this.label(this.y[0])),
      legend: "never", highlightCircleSize: 4, highlightSeriesBackgroundAlpha: 1,
      highlightSeriesOpts: { strokeBorderWidth: 0 }, includeZero: true, animatedZooms: false,
      gridLineColor: css("--grid"), axisLineColor: css("--line"), labelsKMB: false,
      axes: { x: axis, y: axis },
      highlightCallback: (event, x, points, row) => this.tell(row),
      unhighlightCallback: () => (this.says.textContent = ""),
      clickCallback: () => this.over && this.pick(this.over.curve.run, this.over.row),
      drawCallback: () => this.place(),
    });
    this.legend.replaceChildren(...(list.length > 1 ? list.slice(0, 16) : []).map((curve) =>
      make("span", {}, make("i", { style: `border-color:${curve.color}${curve.pale ? "70" : ""};` +
        `border-style:${curve.dash ? "dashed" : "solid"}` }), curve.label)));
    this.place();
  }
  tell(row) {
    const owner = this.owners[row];
    this.over = owner && owner.row >= 0 ? owner : null;
    if (!owner) return;
    const [x, y] = owner.curve.points.find((point) => point[2] === owner.row) || [];
    if (!this.over) return (this.says.textContent = owner.curve.label);
    const step = owner.curve.run.history.column("step");
    this.says.textContent = `${owner.curve.label}: ${words(this.x)} ` +
      `${withUnit(short(x), this.unit(this.x))}, ${withUnit(short(y), this.unit(this.y[0]))}` +
      (step ? `, row ${step[owner.row]}` : "");
  }
  // Marks a row of a run on its first curve.
  show(run, row) {
    this.shown.set(run, row);
    this.place();
  }
  place() {
    if (!this.graph) return;
    this.box.querySelectorAll(".mark").forEach((mark) => mark.remove());
    const [low, high] = this.graph.xAxisRange(), [least, most] = this.graph.yAxisRange();
    const add = (x, y, kind, title) => {
      if (!(x >= low && x <= high && y >= least && y <= most)) return;
      const [left, top] = this.graph.toDomCoords(x, y);
      this.box.append(make("span", { class: "mark " + kind, title,
        style: `left:${left}px;top:${top}px` }));
    };
    for (const run of this.runs) {
      const x = run.history.column(this.x), y = run.history.column(this.y[0]);
      if (this.x === "displacement" && this.y[0] === "load" && run.rows.peak) {
        add(...run.rows.peak, "peak", "peak of " + run.name);
      }
      const row = this.shown.get(run);
      if (x && y && row !== undefined) add(x[row], y[row], "now", "row of the body shown");
    }
  }
  // The curves in the range that is seen, with axes, as a picture of its own.
  svg() {
    const width = 820, height = 520, box = { left: 92, right: 796, top: 52, bottom: 452 };
    const [low, high] = this.graph.xAxisRange(), [least, most] = this.graph.yAxisRange();
    const px = (x) => box.left + ((x - low) / (high - low)) * (box.right - box.left);
    const py = (y) => box.bottom - ((y - least) / (most - least)) * (box.bottom - box.top);
    const text = (x, y, content, anchor, more = "") =>
      `<text x="${x}" y="${y}" text-anchor="${anchor}" ${more}>${escaped(content)}</text>`;
    const line = (x1, y1, x2, y2) =>
      `<path d="M${x1} ${y1}L${x2} ${y2}" stroke="#ccc" stroke-width="0.7"/>`;
    const parts = [text(box.left, 24, this.title, "start", 'font-size="17" font-weight="bold"')];
    for (const x of ticksOf(low, high, 8)) {
      parts.push(line(px(x), box.top, px(x), box.bottom), text(px(x), 470, short(x), "middle"));
    }
    for (const y of ticksOf(least, most, 8)) {
      parts.push(line(box.left, py(y), box.right, py(y)), text(84, py(y) + 4, short(y), "end"));
    }
    let at = box.left;
    for (const curve of this.curves) {
      const path = curve.points.filter(([x, y]) => Number.isFinite(x) && Number.isFinite(y))
        .map(([x, y]) => px(x).toFixed(2) + " " + py(y).toFixed(2)).join("L");
      parts.push(`<path clip-path="url(#c)" d="M${path}" fill="none" stroke="${curve.color}" ` +
        `stroke-opacity="${curve.pale ? 0.45 : 1}" stroke-width="${curve.width}" ` +
        `stroke-dasharray="${curve.dash || "none"}" stroke-linejoin="round"/>`);
      if (this.curves.length < 2 || at > 700) continue;
      parts.push(`<path d="M${at} 40h18" stroke="${curve.color}" stroke-width="3"/>`,
        text(at + 23, 44, curve.label, "start"));
      at += 40 + 6.4 * curve.label.length;
    }
    const y = this.y.length > 1 ? withBrackets("energy", this.unit(this.y[0])) : this.label(this.y[0]);
    parts.push(`<rect x="${box.left}" y="${box.top}" width="${box.right - box.left}" ` +
      `height="${box.bottom - box.top}" fill="none" stroke="#555"/>`,
      text((box.left + box.right) / 2, 498, this.label(this.x), "middle", 'font-size="14"'),
      text(0, 0, y, "middle", 'font-size="14" transform="translate(20 252) rotate(-90)"'));
    return `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" ` +
      `font-family="sans-serif" font-size="12" fill="#222"><rect width="${width}" ` +
      `height="${height}" fill="#fff"/><clipPath id="c"><rect x="${box.left}" y="${box.top}" ` +
      `width="${box.right - box.left}" height="${box.bottom - box.top}"/></clipPath>` +
      parts.join("\n") + "</svg>";
  }
  fileName(end) {
    return words(this.title).toLowerCase().replaceAll(/[^a-z0-9]+/g, "_") + end;
  }
  saveSvg() {
    save(this.fileName(".svg"), this.svg(), "image/svg+xml");
  }
  async savePng() {
    const picture = new Image();
    picture.src = "data:image/svg+xml;charset=utf-8," + encodeURIComponent(this.svg());
    await picture.decode();
    const canvas = make("canvas", { width: 2 * picture.width, height: 2 * picture.height });
    canvas.getContext("2d").drawImage(picture, 0, 0, canvas.width, canvas.height);
    canvas.toBlob((blob) => save(this.fileName(".png"), blob));
  }
}

const withBrackets = (text, unit) => (unit ? `${text} (${unit})` : text);
