// The data of the page: texts and numbers as the program wrote them.
"use strict";

const report = JSON.parse(document.getElementById("report").textContent);

async function bytesOf(stream) {
  const text = atob(document.getElementById("stream-" + stream).textContent);
  const packed = Uint8Array.from(text, (letter) => letter.charCodeAt(0));
  const open = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(open).arrayBuffer());
}

const textOf = async (stream) => new TextDecoder().decode(await bytesOf(stream));

// Columns of a table with a header; cells that hold no number become NaN.
function columnsOf(text) {
  const lines = text.trimEnd().split("\n");
  const names = lines[0].split(",");
  const columns = names.map(() => new Float64Array(lines.length - 1));
  for (let row = 1; row < lines.length; ++row) {
    const cells = lines[row].split(",");
    columns.forEach((column, c) => (column[row - 1] = Number(cells[c])));
  }
  return { names, columns, rows: lines.length - 1 };
}

// Numbers in steps of a range, as append_steps() of the program writes them.
function stepsOf(bytes, begin, count, [low, high]) {
  const values = new Float32Array(count);
  let step = 0;
  for (let k = 0; k < count; ++k) {
    const folded = bytes[begin + k] | (bytes[begin + count + k] << 8);
    step += folded & 1 ? -(folded + 1) / 2 : folded / 2;
    values[k] = low + (step * (high - low)) / 16383;
  }
  return values;
}

// Reads one array after the other from bytes.
class Reader {
  constructor(bytes) {
    this.bytes = bytes;
    this.at = 0;
  }
  steps(count, range) {
    const values = stepsOf(this.bytes, this.at, count, range);
    this.at += 2 * count;
    return values;
  }
  numbers(Type, count) {
    this.at = Math.ceil(this.at / 4) * 4;
    const values = new Type(this.bytes.buffer, this.at, count);
    this.at += 4 * count;
    return values;
  }
}

async function readHistory(run) {
  const text = await textOf(run.rows.stream);
  const table = columnsOf(text);
  const column = (name) => {
    const place = run.rows.columns.findIndex((known) => known.name === name);
    return place < 0 ? null : table.columns[place];
  };
  return { text, column, rows: table.rows };
}

async function readBody(body) {
  const from = new Reader(await bytesOf(body.stream));
  const n = body.particles, int = (count) => from.numbers(Int32Array, count);
  const places = [];
  for (let axis = 0; axis < body.dimension; ++axis) places.push(from.numbers(Float32Array, n));
  return {
    places, sizes: from.numbers(Float32Array, n), kind: int(n),
    broken: [int(body.broken), int(body.broken)],
    segments: [int(body.segments), int(body.segments)],
    brokenAt: int(body.broken),
  };
}

async function readFrame(body, frame) {
  const from = new Reader(await bytesOf(frame.stream));
  const values = body.fields.map((field) => from.steps(body.particles, field.range));
  const bars = body.has_bar_stress ? from.steps(body.segments, body.bar_range) : null;
  const offsets = frame.elements ? from.numbers(Int32Array, frame.elements + 1) : null;
  const corners = frame.elements ? from.numbers(Int32Array, frame.corners) : null;
  return { values, bars, offsets, corners };
}

// Makes an element; texts are never read as HTML.
function make(name, attributes = {}, ...children) {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (key in element && typeof value !== "string") element[key] = value;
    else element.setAttribute(key, value);
  }
  element.append(...children.filter((child) => child !== null && child !== undefined));
  return element;
}

function save(name, content, type) {
  const url = URL.createObjectURL(content instanceof Blob ? content : new Blob([content], { type }));
  make("a", { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 10000);
}

const rangeOf = (values) => values.reduce(([a, b], v) => [Math.min(a, v), Math.max(b, v)],
  [Infinity, -Infinity]);

const listOf = (value) => (Array.isArray(value) ? value : []);

const words = (name) => name.replaceAll("_", " ");

// A number with five digits.
function short(value) {
  if (!Number.isFinite(value)) return "–";
  if (Number.isInteger(value) && Math.abs(value) < 1e15) return String(value);
  const rounded = Number(value.toPrecision(5));
  const size = Math.abs(rounded);
  return size >= 1e6 || size < 1e-4 ? rounded.toExponential() : String(rounded);
}

// The largest of 1, 2, 5 times a power of ten up to a positive value.
function niceBelow(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  return [5, 2, 1].map((m) => m * power).find((nice) => nice <= value) || power;
}

const withUnit = (text, unit) => (unit ? text + " " + unit : text);

// At most about `most` round numbers in a range.
function ticksOf(low, high, most) {
  const raw = (high - low) / most, power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= raw) || raw;
  const ticks = [];
  for (let k = Math.ceil(low / step); k * step <= high && ticks.length < 100; ++k) {
    ticks.push(Number((k * step).toPrecision(12)));
  }
  return ticks;
}

const darkTheme = matchMedia("(prefers-color-scheme: dark)");
let printing = false;
const isDark = () => darkTheme.matches && !printing;
const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
