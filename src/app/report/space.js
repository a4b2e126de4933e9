// A body in space by WebGL2: instances of a cube or a ball for particles, plates for the faces of
// cracks, rods for bars. An instance is a centre, three axes and a colour.
const instanceFloats = 15;
const vertexShader = `#version 300 es
in vec3 corner, normal, centre, a, b, c, color;
uniform mat4 view;
uniform vec3 light;
out vec3 shine;
void main() {
  vec3 n = normalize(a * normal.x / dot(a, a) + b * normal.y / dot(b, b) + c * normal.z / dot(c, c));
  gl_Position = view * vec4(centre + mat3(a, b, c) * corner, 1.0);
  shine = color * (0.62 + 0.38 * dot(n, light));
}`;
const fragmentShader = `#version 300 es
precision mediump float;
in vec3 shine;
out vec4 pixel;
void main() { pixel = vec4(shine, 1.0); }`;

// Triangles of a cube of edge 1 whose faces have n by n squares, or of the ball in it: corners and
// normals.
function shapeOf(n, isBall) {
  const floats = [];
  const at = (axis, side, u, v) => {
    const p = [0, 0, 0];
    p[axis] = side;
    p[(axis + 1) % 3] = u;
    p[(axis + 2) % 3] = v;
    const length = Math.hypot(...p), flat = [0, 0, 0];
    flat[axis] = 2 * side;
    floats.push(...(isBall ? p.map((x) => (0.5 * x) / length) : p),
      ...(isBall ? p.map((x) => x / length) : flat));
  };
  for (let axis = 0; axis < 3; ++axis) {
    for (const side of [-0.5, 0.5]) {
      for (let k = 0; k < n * n; ++k) {
        const u = (k % n) / n - 0.5, v = Math.floor(k / n) / n - 0.5, d = 1 / n;
        for (const [i, j] of [[0, 0], [1, 0], [1, 1], [0, 0], [1, 1], [0, 1]]) {
          at(axis, side, u + i * d, v + j * d);
        }
      }
    }
  }
  return new Float32Array(floats);
}

class Instances {
  constructor(most) {
    this.floats = new Float32Array(most * instanceFloats);
    this.count = 0;
  }
  add(centre, a, b, c, color) {
    [centre, a, b, c].forEach((v, k) => this.floats.set(v, instanceFloats * this.count + 3 * k));
    this.floats.set(color.map((part) => part / 255), instanceFloats * this.count + 12);
    ++this.count;
  }
}

const cross = (p, q) => [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]];
const times = (p, factor) => p.map((x) => x * factor);
// Two unit vectors normal to a unit vector and to each other.
function normalsOf(d) {
  const smallest = d.map(Math.abs).indexOf(Math.min(...d.map(Math.abs)));
  const t = cross(d, [0, 1, 2].map((axis) => (axis === smallest ? 1 : 0)));
  const unit = times(t, 1 / Math.hypot(...t));
  return [unit, cross(d, unit)];
}

class Space {
  constructor(canvas, model, run) {
    Object.assign(this, { canvas, model, run, body: run.body, turn: Math.PI / 6, tilt: Math.PI / 8 });
    this.zoom = 1;
    this.shift = [0, 0];
    this.gl = canvas.getContext("webgl2", { antialias: true, preserveDrawingBuffer: true });
    this.ranges = model.places.map(rangeOf);
    this.middle = this.ranges.map(([a, b]) => (a + b) / 2);
    this.radius = 0.5 * Math.hypot(...this.ranges.map(([a, b]) => b - a)) + this.body.spacing;
    if (!this.gl) return;
    this.prepare();
    this.listen();
  }
  prepare() {
    const gl = this.gl, program = (this.program = gl.createProgram());
    for (const [type, text] of [[gl.VERTEX_SHADER, vertexShader], [gl.FRAGMENT_SHADER, fragmentShader]]) {
      const shader = gl.createShader(type);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    this.shapes = [[1, false], [this.body.particles > 20000 ? 1 : 3, true]].map(([n, isBall]) => {
      const floats = shapeOf(n, isBall), layout = gl.createVertexArray(), instances = gl.createBuffer();
      gl.bindVertexArray(layout);
      gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
      gl.bufferData(gl.ARRAY_BUFFER, floats, gl.STATIC_DRAW);
      const attribute = (name, stride, offset, divisor) => {
        const place = gl.getAttribLocation(program, name);
        gl.enableVertexAttribArray(place);
        gl.vertexAttribPointer(place, 3, gl.FLOAT, false, 4 * stride, 4 * offset);
        gl.vertexAttribDivisor(place, divisor);
      };
      attribute("corner", 6, 0, 0);
      attribute("normal", 6, 3, 0);
      gl.bindBuffer(gl.ARRAY_BUFFER, instances);
      ["centre", "a", "b", "c", "color"].forEach((name, k) => attribute(name, instanceFloats, 3 * k, 1));
      return { layout, instances, vertices: floats.length / 6, count: 0 };
    });
  }
  listen() {
    const canvas = this.canvas;
    let last = null;
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      last = [event.clientX, event.clientY];
    });
    canvas.addEventListener("pointermove", (event) => {
      if (!event.buttons || !last) return;
      const dx = event.clientX - last[0], dy = event.clientY - last[1];
      last = [event.clientX, event.clientY];
      if (event.shiftKey || event.buttons === 2) this.shift = [this.shift[0] + dx, this.shift[1] + dy];
      else this.rotate(0.01 * dx, 0.01 * dy);
      this.redraw();
    });
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.magnify(Math.exp(-0.0015 * event.deltaY));
    }, { passive: false });
  }
  rotate(turn, tilt) {
    this.turn += turn;
    this.tilt = Math.min(Math.max(this.tilt + tilt, -Math.PI / 2), Math.PI / 2);
  }
  magnify(by) {
    this.zoom *= by;
    this.redraw();
  }
  reset() {
    Object.assign(this, { turn: Math.PI / 6, tilt: Math.PI / 8, zoom: 1, shift: [0, 0] });
    this.redraw();
  }
  // Unit vectors to the right, up and towards the viewer.
  axes() {
    const [ct, st, cf, sf] = [Math.cos(this.turn), Math.sin(this.turn), Math.cos(this.tilt),
      Math.sin(this.tilt)];
    return [[ct, -st, 0], [st * sf, ct * sf, cf], [-st * cf, -ct * cf, sf]];
  }
  get pixels() {  // per length; the seen size of the box fits the canvas
    const sizes = this.axes().map((axis) => axis.reduce(
      (sum, x, a) => sum + Math.abs(x) * (this.ranges[a][1] - this.ranges[a][0] + this.body.spacing), 0));
    return this.zoom * 0.9 * Math.min((this.canvas.clientWidth - legendWidth) / sizes[0],
      (this.canvas.clientHeight - 40) / sizes[1]);
  }
  draw(view) {
    this.view = view;
    if (!this.gl) return;
    const at = this.model.places.map((places, axis) => places.map(
      (x, i) => x + view.scale * view.displacement[axis][i]));
    this.at = at;
    const others = new Instances(2 * this.model.broken[0].length + this.model.segments[0].length +
      (this.body.square ? this.body.particles : 0));
    const particles = this.body.square ? others : new Instances(this.body.particles);
    const where = (i) => [at[0][i], at[1][i], at[2][i]];
    const wide = this.body.square ? 0.97 : 1.25;
    for (let i = 0; i < this.body.particles; ++i) {
      if (this.model.kind[i] !== 0 || view.hidden(i)) continue;
      const size = wide * this.model.sizes[i];
      particles.add(where(i), [size, 0, 0], [0, size, 0], [0, 0, size], view.colors[view.shade[i]]);
    }
    this.addFaces(view, where, others);
    this.addBars(view, where, others);
    this.fill(this.shapes[0], others);
    if (!this.body.square) this.fill(this.shapes[1], particles);
    this.redraw();
  }
  addFaces({ faces, loose, hiddenFace }, where, list) {
    const { places, broken: [first, second], sizes } = this.model;
    faces.forEach((members, step) => members.forEach((k) => {
      const i = first[k], j = second[k], d = places.map((x) => x[j] - x[i]), length = Math.hypot(...d);
      const size = (this.body.square ? 0.99 : 0.8) * Math.max(sizes[i], sizes[j]);
      const [t, v] = normalsOf(times(d, 1 / length));
      for (const [end, side] of [[i, 0.5], [j, -0.5]]) {
        if (loose(end) || hiddenFace(end)) continue;
        list.add(where(end).map((x, a) => x + side * d[a]), times(d, (0.07 * size) / length), times(t, size),
          times(v, size), faceColor(step));
      }
    }));
  }
  addBars({ bars }, where, list) {
    const [first, second] = this.model.segments;
    for (let k = 0; k < first.length; ++k) {
      const p = where(first[k]), q = where(second[k]), d = q.map((x, a) => x - p[a]);
      const length = Math.hypot(...d);
      if (!(length > 0)) continue;
      const [t, v] = normalsOf(times(d, 1 / length)), wide = 0.25 * this.body.spacing;
      list.add(p.map((x, a) => (x + q[a]) / 2), d, times(t, wide), times(v, wide), barColor(bars ? bars[k] : 0));
    }
  }
  fill(shape, { floats, count }) {
    this.gl.bindBuffer(this.gl.ARRAY_BUFFER, shape.instances);
    this.gl.bufferData(this.gl.ARRAY_BUFFER, floats.subarray(0, count * instanceFloats),
      this.gl.DYNAMIC_DRAW);
    shape.count = count;
  }
  redraw() {
    const gl = this.gl, canvas = this.canvas;
    if (!gl || !this.view) return;
    canvas.width = devicePixelRatio * canvas.clientWidth;
    canvas.height = devicePixelRatio * canvas.clientHeight;
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.useProgram(this.program);
    const axes = this.axes(), s = this.pixels;
    const factors = [(2 * s) / canvas.clientWidth, (2 * s) / canvas.clientHeight, -0.25 / this.radius];
    const shifts = [(2 * this.shift[0] - legendWidth) / canvas.clientWidth,
      (-2 * this.shift[1]) / canvas.clientHeight, 0];
    const matrix = new Float32Array(16);
    axes.forEach((axis, row) => {
      for (let a = 0; a < 3; ++a) matrix[4 * a + row] = factors[row] * axis[a];
      matrix[12 + row] = shifts[row] - factors[row] * axis.reduce((sum, x, a) => sum + x * this.middle[a], 0);
    });
    matrix[15] = 1;
    gl.uniformMatrix4fv(gl.getUniformLocation(this.program, "view"), false, matrix);
    gl.uniform3fv(gl.getUniformLocation(this.program, "light"),
      [0, 1, 2].map((a) => 0.35 * axes[0][a] + 0.5 * axes[1][a] + 0.79 * axes[2][a]));
    for (const shape of this.shapes) {
      gl.bindVertexArray(shape.layout);
      gl.drawArraysInstanced(gl.TRIANGLES, 0, shape.vertices, shape.count);
    }
    gl.bindVertexArray(null);
    if (this.onRedraw) this.onRedraw();
  }
  // The foremost particle under a point of the canvas, or -1.
  pick(x, y) {
    const [right, up, toward] = this.axes(), s = this.pixels;
    const left = (this.canvas.clientWidth - legendWidth) / 2 + this.shift[0];
    const top = this.canvas.clientHeight / 2 + this.shift[1];
    let best = -1, front = -Infinity;
    for (let i = 0; this.at && i < this.body.particles; ++i) {
      if (this.model.kind[i] !== 0 || this.view.hidden(i)) continue;
      const d = this.at.map((values, a) => values[i] - this.middle[a]);
      const dot = (axis) => d[0] * axis[0] + d[1] * axis[1] + d[2] * axis[2];
      const away = Math.hypot(left + s * dot(right) - x, top - s * dot(up) - y);
      if (away > 0.6 * s * this.model.sizes[i] || dot(toward) <= front) continue;
      front = dot(toward);
      best = i;
    }
    return best;
  }
}
