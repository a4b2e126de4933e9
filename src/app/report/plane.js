// A plane body on a canvas: particles, cracks, bars, finite elements.
class Plane {
  constructor(canvas, model, run) {
    Object.assign(this, { canvas, model, run, body: run.body });
    this.zoom = 1;
    this.shift = [0, 0];
    this.ranges = model.places.map(rangeOf);
    const start = { x: 0, y: 0, shift: [0, 0] };
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      Object.assign(start, { x: event.clientX, y: event.clientY, shift: [...this.shift] });
    });
    canvas.addEventListener("pointermove", (event) => {
      if (!event.buttons) return;
      this.shift = [start.shift[0] + event.clientX - start.x, start.shift[1] + event.clientY - start.y];
      this.redraw();
    });
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.magnify(Math.exp(-0.0015 * event.deltaY), event.offsetX, event.offsetY);
    }, { passive: false });
  }
  magnify(by, x = this.canvas.clientWidth / 2, y = this.canvas.clientHeight / 2) {
    const middle = [(this.canvas.clientWidth - legendWidth) / 2, this.canvas.clientHeight / 2 - 14];
    this.shift = this.shift.map((s, a) => by * s + (1 - by) * ([x, y][a] - middle[a]));
    this.zoom *= by;
    this.redraw();
  }
  reset() {
    this.zoom = 1;
    this.shift = [0, 0];
    this.redraw();
  }
  redraw() {
    if (!this.view) return;
    this.draw(this.view);
    if (this.onRedraw) this.onRedraw();
  }
  // The ranges of displaced particles in all rows.
  get seen() {
    return this.ranges.map(([a, b], axis) => {
      const [low, high] = this.body.fields[axis].range.map((u) => u * displacementScale());
      return [a + Math.min(low, 0), b + Math.max(high, 0)];
    });
  }
  get pixels() {  // per length
    const [width, height] = this.seen.map(([a, b]) => b - a + this.body.spacing);
    return this.zoom * Math.min((this.canvas.clientWidth - legendWidth - 24) / width,
      (this.canvas.clientHeight - 70) / height);
  }
  // Fills xs and ys with the places of the displaced particles on the canvas.
  project({ displacement, scale }) {
    const n = this.body.particles, [X, Y] = this.model.places, s = this.pixels;
    const middle = this.seen.map(([a, b]) => (a + b) / 2);
    const left = (this.canvas.clientWidth - legendWidth) / 2 + this.shift[0] - s * middle[0];
    const top = this.canvas.clientHeight / 2 - 14 + this.shift[1] + s * middle[1];
    this.xs = new Float32Array(n);
    this.ys = new Float32Array(n);
    for (let i = 0; i < n; ++i) {
      this.xs[i] = left + s * (X[i] + scale * displacement[0][i]);
      this.ys[i] = top - s * (Y[i] + scale * displacement[1][i]);
    }
    this.place = ([x, y]) => [left + s * x, top - s * y];
  }
  draw(view) {
    this.view = view;
    const ratio = devicePixelRatio, c = this.canvas.getContext("2d");
    this.canvas.width = ratio * this.canvas.clientWidth;
    this.canvas.height = ratio * this.canvas.clientHeight;
    c.scale(ratio, ratio);
    this.project(view);
    this.drawParticles(c, view);
    this.drawElements(c, view);
    this.drawCracks(c, view);
    this.drawBars(c, view);
  }
  drawParticles(c, { shade, colors }) {
    const { kind, sizes } = this.model, s = this.pixels, square = this.body.square;
    const groups = colors.map(() => []), ghosts = [];
    for (let i = 0; i < this.body.particles; ++i) {
      if (kind[i] === 0) groups[shade[i]].push(i);
      if (kind[i] === 1) ghosts.push(i);
    }
    groups.forEach((members, k) => {
      c.fillStyle = rgb(colors[k]);
      c.beginPath();
      for (const i of members) {
        const size = s * sizes[i];
        if (square || size < 3) {
          const half = (square ? 0.5 * size : 0.52 * size) + (size < 8 ? 0.35 : -0.03 * size);
          c.rect(this.xs[i] - half, this.ys[i] - half, 2 * half, 2 * half);
        } else {
          c.moveTo(this.xs[i] + 0.6 * size, this.ys[i]);
          c.arc(this.xs[i], this.ys[i], 0.6 * size, 0, 7);
        }
      }
      c.fill();
    });
    c.fillStyle = css("--faint");
    for (const i of ghosts) c.fillRect(this.xs[i] - 1, this.ys[i] - 1, 2, 2);
  }
  drawElements(c, { elements }) {
    if (!elements) return;
    c.beginPath();
    for (let e = 0; e + 1 < elements.offsets.length; ++e) {
      for (let k = elements.offsets[e]; k < elements.offsets[e + 1]; ++k) {
        const i = elements.corners[k];
        k === elements.offsets[e] ? c.moveTo(this.xs[i], this.ys[i]) : c.lineTo(this.xs[i], this.ys[i]);
      }
      c.closePath();
    }
    c.strokeStyle = css("--faint");
    c.lineWidth = 0.8;
    c.stroke();
  }
  // Broken bonds between neighbours are drawn as the faces between their cells, on both sides; all
  // broken bonds as hairlines where there are few and no gap is seen.
  drawCracks(c, { faces, loose, lines }) {
    const { places: [X, Y], broken: [first, second], sizes } = this.model, s = this.pixels;
    const width = Math.min(Math.max(0.12 * s * this.body.spacing, 0.9), 3);
    if (lines.length < 2000) {
      c.beginPath();
      for (const k of lines) {
        const i = first[k], j = second[k];
        const drawn = Math.hypot(this.xs[j] - this.xs[i], this.ys[j] - this.ys[i]);
        const before = s * Math.hypot(X[j] - X[i], Y[j] - Y[i]);
        if (loose(i) || loose(j) || drawn - before > 0.5 * s * this.body.spacing) continue;
        c.moveTo(this.xs[i], this.ys[i]);
        c.lineTo(this.xs[j], this.ys[j]);
      }
      c.strokeStyle = rgb(faceColor(0));
      c.globalAlpha = Math.min(Math.max(60 / (lines.length + 1), 0.08), 0.4);
      c.lineWidth = 0.8;
      c.stroke();
      c.globalAlpha = 1;
    }
    c.lineCap = "round";
    faces.forEach((members, step) => {
      c.beginPath();
      for (const k of members) {
        const i = first[k], j = second[k], dx = X[j] - X[i], dy = Y[j] - Y[i];
        const length = Math.hypot(dx, dy), size = Math.max(sizes[i], sizes[j]);
        const half = (0.5 * (this.body.square ? 1 : 0.62) * size * s) / length;
        for (const [end, side] of [[i, 0.5], [j, -0.5]]) {
          if (loose(end)) continue;
          const x = this.xs[end] + side * dx * s, y = this.ys[end] - side * dy * s;
          c.moveTo(x - half * dy, y - half * dx);
          c.lineTo(x + half * dy, y + half * dx);
        }
      }
      c.strokeStyle = rgb(faceColor(step));
      c.lineWidth = width * (1 + step / openingSteps);
      c.stroke();
    });
    this.drawPreCracks(c);
  }
  // Points of a pre-crack move with the particles around them.
  drawPreCracks(c) {
    const { places: [X, Y] } = this.model, near = 1.6 * this.body.spacing;
    const { displacement, scale } = this.view;
    c.strokeStyle = css("--text");
    c.lineWidth = 1;
    c.setLineDash([5, 3]);
    for (const crack of this.run.cracks) {
      c.beginPath();
      crack.forEach(([x, y]) => {
        let u = 0, v = 0, count = 0;
        for (let i = 0; i < X.length; ++i) {
          if (Math.hypot(X[i] - x, Y[i] - y) > near) continue;
          u += displacement[0][i];
          v += displacement[1][i];
          ++count;
        }
        c.lineTo(...this.place([x + (scale * u) / (count || 1), y + (scale * v) / (count || 1)]));
      });
      c.stroke();
    }
    c.setLineDash([]);
  }
  drawBars(c, { bars }) {
    const [first, second] = this.model.segments;
    c.lineWidth = Math.min(Math.max(0.3 * this.pixels * this.body.spacing, 2), 6);
    for (let k = 0; k < first.length; ++k) {
      c.strokeStyle = rgb(barColor(bars ? bars[k] : 0));
      c.beginPath();
      c.moveTo(this.xs[first[k]], this.ys[first[k]]);
      c.lineTo(this.xs[second[k]], this.ys[second[k]]);
      c.stroke();
    }
  }
  // The particle under a point of the canvas, or -1.
  pick(x, y) {
    let best = -1, least = (0.8 * this.pixels * this.body.spacing) ** 2 + 16;
    for (let i = 0; this.xs && i < this.xs.length; ++i) {
      const distance = (this.xs[i] - x) ** 2 + (this.ys[i] - y) ** 2;
      if (this.model.kind[i] !== 0 || distance > least) continue;
      least = distance;
      best = i;
    }
    return best;
  }
}
