// Colours of fields. "Rising" is magma of matplotlib (S. van der Walt and N. Smith, CC0), light to
// dark as in the pictures of perilink plot; signed fields are blue, grey and red.
const shades = 64;
const risingStops = [[252, 253, 191], [254, 207, 146], [254, 159, 109], [247, 112, 92],
  [222, 73, 104], [183, 55, 121], [140, 41, 129], [100, 26, 128], [59, 15, 112], [20, 14, 54],
  [0, 0, 4]];
const signedStops = [[33, 84, 190], [120, 160, 222], [222, 222, 222], [229, 140, 110], [184, 32, 40]];

function mixed(stops, part) {
  const place = Math.min(Math.max(part, 0), 1) * (stops.length - 1);
  const below = Math.min(Math.floor(place), stops.length - 2);
  return stops[below].map((low, c) =>
    Math.round(low + (place - below) * (stops[below + 1][c] - low)));
}

const rgb = ([r, g, b]) => `rgb(${r},${g},${b})`;
const bodyColor = () => (isDark() ? [112, 118, 128] : [216, 218, 222]);

// Colours of a range of values. Number 0 is that of particles without damage.
class Scale {
  constructor(name, unit, low, high) {
    Object.assign(this, { name, unit, low, high, isDamage: name === "damage" });
    this.isSigned = low < 0 && high > 0;
    if (this.isSigned) this.high = -(this.low = -Math.max(-low, high));
    if (!(this.high > this.low)) this.high = this.low + (Math.abs(this.low) || 1);
    this.colors = [bodyColor()];
    for (let k = 0; k < shades; ++k) this.colors.push(this.color((k + 0.5) / shades));
  }
  color(part) {
    if (this.isSigned) return mixed(signedStops, part);
    return mixed(risingStops, isDark() ? 0.72 - 0.72 * part : part);
  }
  shade(value) {
    if (this.isDamage && !(value > 0)) return 0;
    const place = Math.floor(((value - this.low) / (this.high - this.low)) * shades);
    return 1 + Math.min(Math.max(place, 0), shades - 1);
  }
}

// Faces of cracks, from closed to the widest opening, in seven steps.
const openingSteps = 6;
const faceColor = (step) => mixed(isDark() ? [[255, 92, 72], [120, 205, 255]]
  : [[90, 10, 18], [18, 140, 255]], step / openingSteps);
// Bars: blue in compression, red in tension.
const barColor = (part) => mixed([[20, 60, 214], [96, 96, 96], [214, 20, 20]], 0.5 + 0.5 * part);
