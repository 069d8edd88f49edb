"use strict";
// Bodies as rational Bezier spans that the graphics card evaluates: positions at vertices, the field at every pixel.
const data = JSON.parse(document.getElementById("data").textContent);
const byId = (id) => document.getElementById(id);
const solid = data.dim === 3;
const canvas = byId("space");
const gl = canvas.getContext("webgl2", {antialias: true, stencil: true, alpha: false});
const texelsPerRow = 2048;
const mostCells = 64;            // of a span and direction
const pixelTolerance = 0.25;
const playMilliseconds = 100;
const bandChoices = [5, 8, 10, 12, 16, 20];
const darkness = matchMedia("(prefers-color-scheme: dark)");

// ---- Numbers

const bytes = (text) => Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
const floats = (text) => new Float32Array(bytes(text).buffer);
const integers = (text) => new Int32Array(bytes(text).buffer);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const scaled = (a, s) => a.map((x) => x * s);
const plus = (a, b) => a.map((x, k) => x + b[k]);
const minus = (a, b) => a.map((x, k) => x - b[k]);
const unit = (a) => scaled(a, 1 / Math.hypot(...a));
const clamp = (x, low, high) => Math.min(high, Math.max(low, x));

/** A vector turned about a unit axis. */
function turned(v, axis, angle) {
  const c = Math.cos(angle), s = Math.sin(angle);
  return plus(plus(scaled(v, c), scaled(cross(axis, v), s)), scaled(axis, dot(axis, v) * (1 - c)));
}

const rgb = (hex) => [1, 3, 5].map((k) => parseInt(hex.slice(k, k + 2), 16) / 255);
const theme = () => (darkness.matches ? data.dark : data.light);
const middle = (a, b) => a.map((x, k) => (x + b[k]) / 2);

// ---- What is shown, and from where

const boxMiddle = middle(data.box.slice(0, 3), data.box.slice(3));
const boxSize = Math.hypot(...minus(data.box.slice(3), data.box.slice(0, 3)));
const state = {
  frame: data.frames.length - 1, field: 0, bands: data.show.bands, isolines: data.show.isolines, knots: data.show.knots,
  undeformed: data.show.undeformed, tools: data.show.tools, light: true, cut: "", cutPlace: 0.5, playing: false,
  zoom: 1, center: [0, 0], right: [1, 0, 0], up: [0, 1, 0],
};
const eye = () => cross(state.right, state.up);
const projected = (x) => [dot(state.right, x), dot(state.up, x)];

function resetView() {
  state.right = data.axes.slice(0, 3);
  state.up = data.axes.slice(3);
  const [x0, y0, x1, y1] = data.window;
  state.center = minus([(x0 + x1) / 2, (y0 + y1) / 2], projected(data.origin));
  state.zoom = 1;
}

/** Pixels of the style sheet per length. */
function pixelsPerLength() {
  const [x0, y0, x1, y1] = data.window, room = 0.95;
  return state.zoom * room * Math.min(canvas.clientWidth / (x1 - x0), canvas.clientHeight / (y1 - y0));
}

/** The axis of space about which the body is turned sideways: the one that goes up at first, or nearly. */
const upright = (() => {
  const up = data.axes.slice(3).map(Math.abs), axis = up.indexOf(Math.max(...up));
  return [0, 1, 2].map((k) => (k === axis ? Math.sign(data.axes[3 + k]) : 0));
})();

/** Turns about the middle of the bodies, which stays where it is seen. */
function turn(sideways, over) {
  if (!solid) return;
  const before = projected(boxMiddle);
  for (const [axis, angle] of [[upright, -sideways], [state.right, -over]]) {
    const fixed = unit(axis);
    state.right = unit(turned(state.right, fixed, angle));
    state.up = unit(turned(state.up, fixed, angle));
  }
  state.up = unit(minus(state.up, scaled(state.right, dot(state.up, state.right))));
  state.center = plus(state.center, minus(projected(boxMiddle), before));
}

/** In pixels to the right and down. */
function shift(x, y) {
  const length = 1 / pixelsPerLength();
  state.center = plus(state.center, [-x * length, y * length]);
}

/** About a place in pixels from the middle of the canvas, to the right and down. */
function zoomBy(factor, x = 0, y = 0) {
  const next = clamp(state.zoom * factor, 0.05, 5000);
  shift(-x, -y);
  state.zoom = next;
  shift(x, y);
}

/** What is cut away lies before this plane, {normal, offset}; nothing without a cut. */
function cutPlane() {
  if (!solid || !state.cut) return null;
  const k = "xyz".indexOf(state.cut), side = eye()[k] < 0 ? -1 : 1;
  const inwards = 1e-6 * boxSize * Math.sign(0.5 - state.cutPlace);  // a face of the body is a section, too
  const place = data.box[k] + state.cutPlace * (data.box[k + 3] - data.box[k]) + inwards;
  return {axis: k, place, normal: [0, 1, 2].map((d) => (d === k ? side : 0)), offset: side * place};
}

// ---- Bodies

/** Coefficients of a face or a volume (components x points of its lattice), times their weights, with the weights behind. */
function lattice(part, values, components) {
  let size = components + 1, list = new Float64Array(size * part.nodes.length);
  part.nodes.forEach((node, k) => {
    const weight = part.weights ? part.weights[k] : 1;
    for (let c = 0; c < components; ++c) list[k * size + c] = weight * values[node * components + c];
    list[k * size + components] = weight;
  });
  for (const row of part.rows) {
    const count = row.first.length, outer = list.length / (size * row.functions), next = new Float64Array(outer * count * size);
    for (let o = 0; o < outer; ++o)
      for (let i = 0; i < count; ++i)
        for (let a = 0; a <= row.p; ++a) {
          const factor = row.factors[i * (row.p + 1) + a], from = (o * row.functions + row.first[i] + a) * size;
          const to = (o * count + i) * size;
          for (let k = 0; k < size; ++k) next[to + k] += factor * list[from + k];
        }
    list = next;
    size *= count;
  }
  return list;
}

/** Largest length of vectors of three numbers, of a list of coefficients in rows. */
function largest(rows, columns, at) {
  let most = 0;
  for (let j = 0; j < rows; ++j)
    for (let i = 0; i < columns; ++i) most = Math.max(most, Math.hypot(...at(i, j)));
  return most;
}

/**
 * Middle and radius of a span's coefficients, and M such that n x n cells of it are off by M / (4 n²) at most:
 * from bounds of the second derivatives of the rational span.
 */
function measured(points, first, stride, p, q) {
  const at = (i, j) => (first + j * stride + i) * 4;
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  let least = Infinity;
  for (let j = 0; j <= q; ++j)
    for (let i = 0; i <= p; ++i) {
      const k = at(i, j), w = points[k + 3];
      least = Math.min(least, w);
      for (let c = 0; c < 3; ++c) {
        low[c] = Math.min(low[c], points[k + c] / w);
        high[c] = Math.max(high[c], points[k + c] / w);
      }
    }
  const center = middle(low, high), radius = Math.hypot(...minus(high, low)) / 2;
  const A = (i, j) => [0, 1, 2].map((c) => points[at(i, j) + c] - points[at(i, j) + 3] * center[c]);
  const W = (i, j) => [points[at(i, j) + 3]];
  const u = (f) => (i, j) => minus(f(i + 1, j), f(i, j)), v = (f) => (i, j) => minus(f(i, j + 1), f(i, j));
  const bounds = (f) => ({
    u: p * largest(q + 1, p, u(f)), v: q * largest(q, p + 1, v(f)), uv: p * q * largest(q, p, u(v(f))),
    uu: p * (p - 1) * largest(q + 1, p - 1, u(u(f))), vv: q * (q - 1) * largest(q - 1, p + 1, v(v(f))),
  });
  const a = bounds(A), w = bounds(W);
  const fu = (a.u + w.u * radius) / least, fv = (a.v + w.v * radius) / least;
  const uu = (a.uu + 2 * w.u * fu + w.uu * radius) / least, vv = (a.vv + 2 * w.v * fv + w.vv * radius) / least;
  const uv = (a.uv + w.u * fv + w.v * fu + w.uv * radius) / least;
  return {center, radius, second: Math.max(uu, vv) + uv};
}

for (const mesh of data.meshes)
  for (const part of [...mesh.faces, ...(mesh.volumes || [])]) {
    part.nodes = integers(part.nodes);
    part.weights = part.weights && floats(part.weights);
    for (const row of part.rows) {
      row.first = integers(row.first);
      row.factors = floats(row.factors);
    }
  }

/** Positions of a mesh as rows of a texture, its spans, and those of its edges. */
function body(mesh, positionsText) {
  const values = floats(positionsText), lattices = mesh.faces.map((face) => lattice(face, values, data.dim));
  const count = lattices.reduce((sum, each) => sum + each.length / (data.dim + 1), 0);
  const points = new Float32Array(4 * texelsPerRow * Math.ceil(count / texelsPerRow));
  const spans = [], edges = [];
  let first = 0;
  mesh.faces.forEach((face, f) => {
    const from = lattices[f], size = data.dim + 1, [u, v] = face.rows, stride = u.first.length;
    for (let k = 0; k < from.length / size; ++k) {
      for (let c = 0; c < data.dim; ++c) points[4 * (first + k) + c] = from[k * size + c];
      points[4 * (first + k) + 3] = from[k * size + data.dim];
    }
    const columns = (stride - 1) / u.p, rows = (v.first.length - 1) / v.p, sides = [];
    for (let k = 0; k + 1 < mesh.edges.length; k += 2) if (mesh.edges[k] === f) sides.push(mesh.edges[k + 1]);
    for (let j = 0; j < rows; ++j)
      for (let i = 0; i < columns; ++i) {
        const place = first + j * v.p * stride + i * u.p;
        const span = {place, stride, p: u.p, q: v.p, body: face.body, ...measured(points, place, stride, u.p, v.p)};
        spans.push(span);
        for (const side of sides)
          if ([i === 0, i === columns - 1, j === 0, j === rows - 1][side]) edges.push({span, side});
      }
    first += from.length / size;
  });
  return {mesh, points, spans, edges};
}

/** Values of a field on a body as rows of a texture. */
function fieldTexels(mesh, valuesText, components) {
  const values = floats(valuesText), lattices = mesh.faces.map((face) => lattice(face, values, components));
  const count = lattices.reduce((sum, each) => sum + each.length / (components + 1), 0);
  const texels = new Float32Array(4 * texelsPerRow * Math.ceil(count / texelsPerRow));
  let texel = 0;
  for (const from of lattices)
    for (let k = 0; k < from.length; k += components + 1, ++texel) {
      for (let c = 0; c < components; ++c) texels[4 * texel + c] = from[k + c];
      texels[4 * texel + 3] = from[k + components];
    }
  return texels;
}

// ---- Sections

const mostCellsOfSection = 16;    // of a span and direction
const mostCellsOfAll = 40000;     // that lie in the plane
const colorTolerance = 0.5 / 256; // of the scale
const sectionNumbers = 7;         // place, value and parameters of a vertex

/** Values of the p+1 Bernstein polynomials at t, into b behind `first`. */
function bernstein(p, t, b, first) {
  b[first] = 1;
  for (let k = 1; k <= p; ++k) {
    let last = 0;
    for (let i = 0; i < k; ++i) {
      const x = b[first + i];
      b[first + i] = last + (1 - t) * x;
      last = t * x;
    }
    b[first + k] = last;
  }
}

/**
 * Spans of the volumes of a frame with their control coefficients: X (x, y, z, weight), and F (components, weight) of a field;
 * first direction fastest.
 */
function volumeSpans(mesh, positionsText) {
  const positions = floats(positionsText), spans = [];
  for (const volume of mesh.volumes) {
    const points = lattice(volume, positions, 3), degrees = volume.rows.map(({p}) => p), counts = volume.rows.map(({first}) => first.length);
    const [p, q, r] = degrees, [m, n] = counts;
    const [columns, rows, layers] = counts.map((count, d) => (count - 1) / degrees[d]);
    for (let l = 0; l < layers; ++l)
      for (let j = 0; j < rows; ++j)
        for (let i = 0; i < columns; ++i) {
          const places = new Int32Array((p + 1) * (q + 1) * (r + 1));
          let at = 0;
          for (let c = 0; c <= r; ++c)
            for (let b = 0; b <= q; ++b)
              for (let a = 0; a <= p; ++a) places[at++] = i * p + a + m * (j * q + b + n * (l * r + c));
          spans.push({volume, body: volume.body, degrees, places, points});
        }
  }
  return spans;
}

/** Bezier coefficients of a polynomial of the span that vanishes on a plane across an axis; null if the plane does not cut the span. */
function planePolynomial({places, points}, axis, place) {
  const at = (k) => points[4 * places[k] + axis] - place * points[4 * places[k] + 3];
  const isAbove = at(0) >= 0;
  let k = 1;
  while (k < places.length && at(k) >= 0 === isAbove) ++k;
  return k === places.length ? null : Float64Array.from(places, (_, i) => at(i));
}

/** Middle and radius of a span's coefficients, and a bound of its second differences along any diagonal: of its place, once. */
function measureSpan(span) {
  const {places, points} = span, count = places.length, list = new Float64Array(3 * count);
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (let k = 0; k < count; ++k)
    for (let c = 0; c < 3; ++c) {
      const x = points[4 * places[k] + c] / points[4 * places[k] + 3];
      list[3 * k + c] = x;
      low[c] = Math.min(low[c], x);
      high[c] = Math.max(high[c], x);
    }
  span.center = middle(low, high);
  span.radius = Math.hypot(...minus(high, low)) / 2;
  span.second = secondDifference(list, 3, span.degrees);
}

/** Of Bezier coefficients (components x points): the largest second derivative along a diagonal of the span, nearly. */
function secondDifference(list, components, degrees) {
  const counts = degrees.map((p) => p + 1), strides = [1, counts[0], counts[0] * counts[1]];
  let sum = 0;
  for (let d = 0; d < 3; ++d)
    for (let e = d; e < 3; ++e) {
      const ends = counts.map((count, k) => count - (k === d) - (k === e)), a = strides[d], b = strides[e];
      let most = 0;
      for (let z = 0; z < ends[2]; ++z)
        for (let y = 0; y < ends[1]; ++y)
          for (let x = 0; x < ends[0]; ++x) {
            const k = x + y * strides[1] + z * strides[2];
            let square = 0;
            for (let c = 0; c < components; ++c) {
              const at = (place) => list[place * components + c], off = at(k) - at(k + a) - at(k + b) + at(k + a + b);
              square += off * off;
            }
            most = Math.max(most, square);
          }
      sum += (d === e ? degrees[d] * (degrees[d] - 1) : 2 * degrees[d] * degrees[e]) * Math.sqrt(most);
    }
  return sum;
}

/** The same of the field, whose coefficients are those of the volume that has the span. */
function secondOfField({places, degrees}, values, components) {
  const list = new Float64Array(components * places.length);
  for (let k = 0; k < places.length; ++k) {
    const from = places[k] * (components + 1);
    for (let c = 0; c < components; ++c) list[k * components + c] = values[from + c] / values[from + components];
  }
  return secondDifference(list, components, degrees);
}

/**
 * The six tetrahedra of a cell about its diagonal, along ways from one corner (0) to the opposite one (7), whose bits are directions;
 * so neighbours cut their common face alike. Of each, by the corners above a plane as bits: three by three the edges that triangles
 * have as corners, each with the corner where it begins and its directions.
 */
const tetrahedra = [[0, 1, 3, 7], [0, 1, 5, 7], [0, 2, 3, 7], [0, 2, 6, 7], [0, 4, 5, 7], [0, 4, 6, 7]].map((way) => {
  const edge = (a, b) => [Math.min(a, b), a ^ b];
  const triangles = Array.from({length: 16}, (_, mask) => {
    const [below, above] = [0, 1].map((side) => way.filter((_, k) => (mask >> k & 1) === side));
    if (below.length === 0 || above.length === 0) return [];
    const [few, many] = below.length < above.length ? [below, above] : [above, below];
    if (few.length === 1) return many.map((bits) => edge(few[0], bits));
    const [a, b, c, d] = [[0, 0], [0, 1], [1, 1], [1, 0]].map(([i, j]) => edge(few[i], many[j]));
    return [a, b, c, a, c, d];
  });
  return {way, triangles};
});

/** Triangles on a plane, span by span: their points lie where the plane cuts edges of tetrahedra, exactly, with the exact field. */
class Section {
  constructor(axis, place, cells) {
    Object.assign(this, {axis, place, cells, count: 0, triangles: []});
    this.vertices = new Float32Array(1 << 12);
    const corners = (cells + 1) ** 3;
    this.values = new Float64Array(corners);
    this.known = new Int32Array(8 * corners);
    this.steps = [0, 1, 2, 3, 4, 5, 6, 7].map((bits) => (bits & 1) + (bits & 2 ? cells + 1 : 0) + (bits & 4 ? (cells + 1) ** 2 : 0));
    this.bases = new Map();
  }

  /** Bernstein polynomials of a degree at the corners. */
  basis(p) {
    if (!this.bases.has(p)) {
      const b = new Float64Array((p + 1) * (this.cells + 1));
      for (let i = 0; i <= this.cells; ++i) bernstein(p, i / this.cells, b, i * (p + 1));
      this.bases.set(p, b);
    }
    return this.bases.get(p);
  }

  /** Values of a polynomial at all corners of the cells. */
  tabulate(g, degrees) {
    let list = g, inner = 1;
    const n = this.cells + 1;
    degrees.forEach((p, d) => {
      const b = this.basis(p), outer = list.length / (inner * (p + 1));
      const next = d === 2 ? this.values : new Float64Array(outer * n * inner);
      for (let o = 0; o < outer; ++o)
        for (let i = 0; i < n; ++i)
          for (let k = 0; k < inner; ++k) {
            let sum = 0;
            for (let a = 0; a <= p; ++a) sum += b[i * (p + 1) + a] * list[(o * (p + 1) + a) * inner + k];
            next[(o * n + i) * inner + k] = sum;
          }
      list = next;
      inner *= n;
    });
  }

  /** Products of Bernstein polynomials at a place of a span. */
  weigh(degrees, u, v, w) {
    const [p, q, r] = degrees;
    if (!this.products || this.products.length !== (p + 1) * (q + 1) * (r + 1) || this.rows.length !== p + q + r + 3) {
      this.products = new Float64Array((p + 1) * (q + 1) * (r + 1));
      this.rows = new Float64Array(p + q + r + 3);
    }
    const b = this.rows, products = this.products;
    bernstein(p, u, b, 0);
    bernstein(q, v, b, p + 1);
    bernstein(r, w, b, p + q + 2);
    let at = 0;
    for (let k = 0; k <= r; ++k)
      for (let j = 0; j <= q; ++j) {
        const both = b[p + q + 2 + k] * b[p + 1 + j];
        for (let i = 0; i <= p; ++i) products[at++] = both * b[i];
      }
    return products;
  }

  /** Where the polynomial vanishes on the edge that leaves a corner in these directions. */
  vertex(corner, bits) {
    const key = 8 * corner + bits;
    if (this.known[key] >= 0) return this.known[key];
    const {span, g} = this, n = this.cells + 1, h = 1 / this.cells;
    const u = (corner % n) * h, v = (Math.floor(corner / n) % n) * h, w = Math.floor(corner / (n * n)) * h;
    const du = bits & 1 ? h : 0, dv = bits & 2 ? h : 0, dw = bits & 4 ? h : 0;
    let a = 0, b = 1, fa = this.values[corner], fb = this.values[corner + this.steps[bits]], t = 0, last = 0, products;
    const small = 1e-9 * Math.max(Math.abs(fa), Math.abs(fb));
    for (let k = 0; k < 12; ++k) {  // regula falsi; the value at an end that stays twice is halved (Illinois)
      t = fa === fb ? a : (a * fb - b * fa) / (fb - fa);
      products = this.weigh(span.degrees, u + t * du, v + t * dv, w + t * dw);
      let f = 0;
      for (let i = 0; i < g.length; ++i) f += products[i] * g[i];
      if (Math.abs(f) <= small) break;
      const side = f < 0 === fa < 0 ? 1 : -1;
      if (side > 0) [a, fa] = [t, f];
      else [b, fb] = [t, f];
      if (side === last && side > 0) fb *= 0.5;
      if (side === last && side < 0) fa *= 0.5;
      last = side;
    }
    return (this.known[key] = this.add(products, u + t * du, v + t * dv, w + t * dw));
  }

  /** A vertex of the span with its place, value and parameters. */
  add(products, u, v, w) {
    const {span: {places, points}, field, components} = this;
    let x = 0, y = 0, z = 0, weight = 0, square = 0;
    for (let i = 0; i < places.length; ++i) {
      const factor = products[i], from = 4 * places[i];
      x += factor * points[from];
      y += factor * points[from + 1];
      z += factor * points[from + 2];
      weight += factor * points[from + 3];
    }
    let value = 0;
    for (let c = 0; c < components; ++c) {
      value = 0;
      for (let i = 0; i < places.length; ++i) value += products[i] * field[places[i] * (components + 1) + c];
      square += value * value;
    }
    if (components > 1) value = Math.sqrt(square);
    const first = sectionNumbers * this.count;
    if (first + sectionNumbers > this.vertices.length) {
      const longer = new Float32Array(2 * this.vertices.length);
      longer.set(this.vertices);
      this.vertices = longer;
    }
    const into = this.vertices;
    into[first] = x / weight;
    into[first + 1] = y / weight;
    into[first + 2] = z / weight;
    into[first + 3] = value / weight;
    into[first + 4] = u;
    into[first + 5] = v;
    into[first + 6] = w;
    return this.count++;
  }

  /** Of the span whose polynomial of the plane is g, with the coefficients of a field on its volume. */
  cut(span, g, field, components) {
    Object.assign(this, {span, g, field, components});
    this.tabulate(g, span.degrees);
    this.known.fill(-1);
    const {cells, values, steps} = this, n = cells + 1;
    for (let z = 0; z < cells; ++z)
      for (let y = 0; y < cells; ++y)
        for (let x = 0; x < cells; ++x) {
          const corner = x + n * (y + n * z);
          let above = 0;
          for (let k = 0; k < 8; ++k) above |= values[corner + steps[k]] >= 0 ? 1 << k : 0;
          if (above === 0 || above === 255) continue;
          for (const {way, triangles} of tetrahedra) {
            let mask = 0;
            for (let k = 0; k < 4; ++k) mask |= (above >> way[k] & 1) << k;
            for (const [begin, bits] of triangles[mask]) this.triangles.push(this.vertex(corner + steps[begin], bits));
          }
        }
  }
}

/** The section of what is visible, for so many pixels per length; made anew when it changes. */
function shownSection({axis, place}, visible, scale) {
  const record = data.frames[state.frame], {mesh} = loaded.body, field = data.fields[state.field];
  if (!loaded.volumes) loaded.volumes = {spans: volumeSpans(mesh, record.positions)};
  if (loaded.volumes.field !== state.field) {
    const values = floats(record.fields[state.field].values);
    loaded.volumes.field = state.field;
    loaded.volumes.values = new Map(field.isOfContact ? [] : mesh.volumes.map((volume) => [volume, lattice(volume, values, field.components)]));
    for (const span of loaded.volumes.spans) span.secondOfField = null;
    loaded.section = null;
  }
  const {values} = loaded.volumes, range = field.range[1] - field.range[0], found = [];
  let cells = 1;
  for (const span of loaded.volumes.spans) {
    if (isPlain(span.body)) continue;
    const g = planePolynomial(span, axis, place);
    if (!g) continue;
    if (!span.center) measureSpan(span);
    if (!visible(span)) continue;
    span.secondOfField ??= secondOfField(span, values.get(span.volume), field.components);
    found.push({span, g});
    cells = Math.max(cells, Math.sqrt(span.second * scale / (8 * pixelTolerance)),
                     Math.sqrt(span.secondOfField / range / (8 * colorTolerance)));
  }
  cells = clamp(Math.ceil(cells), 1, Math.max(1, Math.min(mostCellsOfSection, Math.floor(Math.sqrt(mostCellsOfAll / Math.max(1, found.length))))));
  const last = loaded.section;
  if (last && last.axis === axis && last.place === place && last.cells === cells && last.spans.length === found.length &&
      found.every(({span}, k) => span === last.spans[k])) return last;
  const section = new Section(axis, place, cells);
  for (const {span, g} of found) section.cut(span, g, values.get(span.volume), field.components);
  loaded.section = {axis, place, cells, spans: found.map(({span}) => span), triangles: new Uint32Array(section.triangles),
                    vertices: section.vertices.subarray(0, sectionNumbers * section.count)};
  return loaded.section;
}

// ---- The graphics card

const header = "#version 300 es\nprecision highp float; precision highp int; precision highp sampler2D;\n";

/** Sums over the (p+1) x (q+1) coefficients of a span. */
const evaluation = (p, q) => `
#define P ${p}
#define Q ${q}
vec4 texel(sampler2D map, float place) {
  int k = int(place + 0.5);
  return texelFetch(map, ivec2(k % ${texelsPerRow}, k / ${texelsPerRow}), 0);
}
${["P", "Q"].map((d) => `
void bernstein${d}(float t, out float b[${d} + 1]) {
  b[0] = 1.0;
  for (int k = 1; k <= ${d}; ++k) {
    float last = 0.0;
    for (int i = 0; i < k; ++i) { float x = b[i]; b[i] = last + (1.0 - t) * x; last = t * x; }
    b[k] = last;
  }
}
void slope${d}(float t, out float d[${d} + 1]) {
  float b[${d} + 1];
  b[0] = 1.0;
  for (int k = 1; k < ${d}; ++k) {
    float last = 0.0;
    for (int i = 0; i < k; ++i) { float x = b[i]; b[i] = last + (1.0 - t) * x; last = t * x; }
    b[k] = last;
  }
  for (int i = 0; i <= ${d}; ++i) d[i] = float(${d}) * ((i > 0 ? b[i - 1] : 0.0) - (i < ${d} ? b[i] : 0.0));
}`).join("")}
vec4 sum(sampler2D map, vec2 place, float a[P + 1], float b[Q + 1]) {
  vec4 r = vec4(0);
  for (int j = 0; j <= Q; ++j) {
    vec4 row = vec4(0);
    for (int i = 0; i <= P; ++i) row += a[i] * texel(map, place.x + float(j) * place.y + float(i));
    r += b[j] * row;
  }
  return r;
}
vec4 at(sampler2D map, vec2 place, vec2 uv) {
  float a[P + 1], b[Q + 1];
  bernsteinP(uv.x, a);
  bernsteinQ(uv.y, b);
  return sum(map, place, a, b);
}`;

const surfaceVertex = (p, q) => header + evaluation(p, q) + `
uniform sampler2D points;
uniform mat4 view;
layout(location = 0) in vec2 uv;
layout(location = 1) in vec2 place;
out vec2 UV;
out vec3 X;
out vec3 N;
flat out vec2 PLACE;
void main() {
  vec4 h = at(points, place, uv);
  X = h.xyz / h.w;
  UV = uv;
  PLACE = place;
  ${solid ? `vec2 inside = clamp(uv, 0.001, 0.999);  // a face may have collapsed to a point at its side
  float a[P + 1], b[Q + 1], du[P + 1], dv[Q + 1];
  bernsteinP(inside.x, a);
  bernsteinQ(inside.y, b);
  slopeP(inside.x, du);
  slopeQ(inside.y, dv);
  vec4 f = sum(points, place, a, b), fu = sum(points, place, du, b), fv = sum(points, place, a, dv);
  vec3 n = cross(fu.xyz * f.w - f.xyz * fu.w, fv.xyz * f.w - f.xyz * fv.w);
  float size = length(n);
  N = size > 0.0 ? n / size : vec3(0);` : "N = vec3(0, 0, 1);"}
  gl_Position = view * vec4(X, 1);
}`;

const clipping = `
uniform vec4 cut;  // normal and offset
void clip(vec3 x) { if (dot(cut.xyz, x) > cut.w) discard; }`;

/** Lamps that go with the eye, as `burnish render` has them; nothing is darker or brighter than the limits. */
const lighting = `
uniform vec3 right, up, eye;
float lightOn(vec3 normal, float least, float most) {
  vec3 n = vec3(dot(normal, right), dot(normal, up), dot(normal, eye));
  if (n.z < 0.0) n = -n;
  float lamps = 0.9 * max(0.0, dot(n, vec3(0.0, 0.7741, 0.6330))) +
    0.3 * max(0.0, dot(n, vec3(0.0, -0.9659, 0.2588))) + 0.3 * n.z +
    0.26 * (max(0.0, dot(n, vec3(0.9397, 0.0, -0.3420))) + max(0.0, dot(n, vec3(-0.9397, 0.0, -0.3420))));
  return clamp((0.45 + 0.6 * lamps) / 1.018, least, most);
}`;

/** Colours of values with isolines, which are of the paper's colour where the outline's would hardly be seen; knot lines. */
const coloring = `
uniform sampler2D colors;
uniform vec2 range;
uniform int count;
uniform float lines, isolines;
uniform vec3 knotColor, outlineColor, paperColor;
float luminance(vec3 c) {
  return dot(mix(pow((c + 0.055) / 1.055, vec3(2.4)), c / 12.92, lessThanEqual(c, vec3(0.04045))), vec3(0.2126, 0.7152, 0.0722));
}
vec3 colorAt(float place) {
  return texelFetch(colors, ivec2(clamp(int(floor(place * float(count))), 0, count - 1), 0), 0).rgb;
}
vec3 colored(float value) {
  float place = (value - range.x) / (range.y - range.x);
  vec3 c = colorAt(place);
  if (isolines <= 0.0) return c;
  float g = place * (isolines + 1.0), line = round(g), share = clamp(abs(g - line) / max(fwidth(g), 1e-9) - 0.35 * lines + 0.5, 0.0, 1.0);
  if (line < 1.0 || line > isolines) return c;
  float a = luminance(outlineColor), b = luminance(colorAt(line / (isolines + 1.0)));
  return mix((max(a, b) + 0.05) / (min(a, b) + 0.05) < 1.3 ? paperColor : outlineColor, c, share);
}
vec3 withKnots(vec3 c, float pixels) {  // from the border of the span
  return knotColor.r < 0.0 ? c : mix(c, knotColor, 0.5 * clamp(0.25 * lines + 0.5 - pixels, 0.0, 1.0));
}`;

const surfaceFragment = (p, q) => header + evaluation(p, q) + clipping + lighting + coloring + `
uniform sampler2D values;
uniform int components, light, plain;
uniform float nonNegative;
uniform vec3 plainColor;
in vec2 UV;
in vec3 X;
in vec3 N;
flat in vec2 PLACE;
out vec4 color;
void main() {
  clip(X);
  vec4 h = at(values, PLACE, UV);
  vec3 f = h.xyz / h.w;
  float value = components == 1 ? f.x : components == 2 ? length(f.xy) : length(f);
  if (nonNegative > 0.0) value = max(value, 0.0);
  vec2 d = min(UV, 1.0 - UV) / fwidth(UV);
  vec3 c = withKnots(plain == 1 ? plainColor : colored(value), min(d.x, d.y));
  if (light == 1) {
    float facing = abs(dot(normalize(N), eye));
    c *= plain == 1 ? lightOn(normalize(N), 0.0, 1.15) : lightOn(normalize(N), 0.6, 1.0);
    c = mix(outlineColor, c, smoothstep(0.4 * lines, 1.4 * lines, facing / max(fwidth(facing), 1e-4)));
  }
  float depth = gl_FragCoord.z, steep = fwidth(depth);
  if (cut.xyz != vec3(0)) {
    float before = cut.w - dot(cut.xyz, X);
    float behind = clamp(before / max(fwidth(before), 1e-9) - lines + 0.5, 0.0, 1.0);
    c = mix(outlineColor, c, behind);
    if (behind < 1.0) depth -= 2.0 * lines * steep;  // over the section also where the face looks away
  }
  gl_FragDepth = depth;
  color = vec4(c, 1);
}`;

/** A point moved across a line in pixels; `nearer` lifts lines off the surface that they lie on. */
const widening = `
uniform mat4 view;
uniform vec2 pixels;
uniform float width, nearer;
vec4 widened(vec4 at, vec4 before, vec4 after, float side) {
  vec2 along = (after.xy - before.xy) * pixels;
  float size = length(along);
  along = size > 0.0 ? along / size : vec2(1, 0);
  at.xy += side * 0.5 * width * vec2(-along.y, along.x) / pixels * 2.0;
  at.z -= nearer;
  return at;
}`;

const edgeVertex = (p, q) => header + evaluation(p, q) + widening + `
uniform sampler2D points;
uniform float cell;
layout(location = 0) in vec2 along;  // place on the edge, side of the line
layout(location = 1) in vec3 edge;   // first coefficient, row length, side of the span
out vec3 X;
vec3 point(float t) {
  vec2 uv = edge.z < 1.5 ? vec2(edge.z, t) : vec2(t, edge.z - 2.0);
  vec4 h = at(points, edge.xy, uv);
  return h.xyz / h.w;
}
void main() {
  X = point(along.x);
  vec4 before = view * vec4(point(max(along.x - cell, 0.0)), 1), after = view * vec4(point(min(along.x + cell, 1.0)), 1);
  gl_Position = widened(view * vec4(X, 1), before, after, along.y);
}`;

const segmentVertex = header + widening + `
uniform mat4 motion;
layout(location = 0) in vec2 along;
layout(location = 1) in vec3 begin;
layout(location = 2) in vec3 end;
out vec3 X;
void main() {
  vec4 a = motion * vec4(begin, 1), b = motion * vec4(end, 1);
  X = mix(a, b, along.x).xyz;
  gl_Position = widened(view * vec4(X, 1), view * a, view * b, along.y);
}`;

const plainVertex = header + `
uniform mat4 view, motion;
uniform float farther;  // a surface behind what it touches
layout(location = 0) in vec3 point;
layout(location = 1) in vec3 normal;
out vec3 X;
out vec3 N;
void main() {
  vec4 x = motion * vec4(point, 1);
  X = x.xyz;
  N = mat3(motion) * normal;
  gl_Position = view * x;
  gl_Position.z += farther;
}`;

const plainFragment = header + clipping + lighting + `
uniform vec4 paint;
uniform int light;
in vec3 X;
in vec3 N;
out vec4 color;
void main() {
  clip(X);
  float shade = light == 1 ? lightOn(normalize(N), 0.0, 1.15) : 1.0;
  color = vec4(paint.rgb * shade, paint.a);
}`;

const lineFragment = header + clipping + `
uniform vec4 paint;
in vec3 X;
out vec4 color;
void main() { clip(X); color = paint; }`;

/** Hatched, as sections are. */
const capFragment = header + `
uniform vec4 paint;
uniform vec3 hatch;
uniform float lines;
out vec4 color;
void main() {
  float d = abs(mod(gl_FragCoord.x + gl_FragCoord.y, 12.0 * lines) - 6.0 * lines);
  color = vec4(mix(hatch, paint.rgb, clamp(d - 0.5 * lines + 0.5, 0.55, 1.0)), 1);
}`;

const sectionVertex = header + `
uniform mat4 view;
layout(location = 0) in vec4 point;  // with the value
layout(location = 1) in vec3 uvw;
out vec3 UVW;
out float VALUE;
void main() {
  UVW = uvw;
  VALUE = point.w;
  gl_Position = view * vec4(point.xyz, 1);
}`;

const sectionFragment = header + coloring + `
uniform float nonNegative;
in vec3 UVW;
in float VALUE;
out vec4 color;
void main() {
  vec3 steps = fwidth(UVW), d = min(UVW, 1.0 - UVW) / max(steps, 1e-9);
  float most = max(steps.x, max(steps.y, steps.z));
  for (int k = 0; k < 3; ++k) if (steps[k] < 1e-3 * most) d[k] = 1e9;  // the plane goes along these knots
  color = vec4(withKnots(colored(nonNegative > 0.0 ? max(VALUE, 0.0) : VALUE), min(d.x, min(d.y, d.z))), 1);
}`;

// Values of contact stand at points of faces, between which they are interpolated.
const contactVertex = header + `
uniform mat4 view;
uniform float nearer;
layout(location = 0) in vec3 point;
layout(location = 1) in float value;
out vec3 X;
out float VALUE;
void main() {
  X = point;
  VALUE = value;
  gl_Position = view * vec4(point, 1);
  gl_Position.z -= nearer;
}`;

const contactLineVertex = header + widening + `
layout(location = 0) in vec2 along;
layout(location = 1) in vec3 begin;
layout(location = 2) in vec3 end;
layout(location = 3) in vec2 ends;
out vec3 X;
out float VALUE;
void main() {
  X = mix(begin, end, along.x);
  VALUE = mix(ends.x, ends.y, along.x);
  gl_Position = widened(view * vec4(X, 1), view * vec4(begin, 1), view * vec4(end, 1), along.y);
}`;

const contactFragment = header + clipping + lighting + coloring + `
uniform int light;
in vec3 X;
in float VALUE;
out vec4 color;
void main() {
  clip(X);
  vec3 c = colored(VALUE);
  if (light == 1) c *= lightOn(normalize(cross(dFdx(X), dFdy(X))), 0.6, 1.0);
  color = vec4(c, 1);
}`;

const programs = new Map();

/** The program of two shaders with the places of its uniforms, made once. */
function program(name, vertex, fragment) {
  if (programs.has(name)) return programs.get(name);
  const handle = gl.createProgram();
  for (const [kind, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(handle, shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS) && !gl.isContextLost())
      throw new Error(`${name}: ${gl.getShaderInfoLog(shader)}`);
  }
  gl.linkProgram(handle);
  if (!gl.getProgramParameter(handle, gl.LINK_STATUS) && !gl.isContextLost())
    throw new Error(`${name}: ${gl.getProgramInfoLog(handle)}`);
  const places = new Map();
  const place = (key) => {
    if (!places.has(key)) places.set(key, gl.getUniformLocation(handle, key));
    return places.get(key);
  };
  const made = {
    /** Sets uniforms: matrices, vectors and numbers as floats, `{integer}` as one. */
    use(values) {
      gl.useProgram(handle);
      for (const [key, value] of Object.entries(values))
        if (typeof value === "number") gl.uniform1f(place(key), value);
        else if ("integer" in value) gl.uniform1i(place(key), value.integer);
        else if (value.length === 16) gl.uniformMatrix4fv(place(key), false, value);
        else gl[`uniform${value.length}fv`](place(key), value);
    },
  };
  programs.set(name, made);
  return made;
}

function buffer(values, kind = gl.ARRAY_BUFFER) {
  const made = gl.createBuffer();
  gl.bindBuffer(kind, made);
  gl.bufferData(kind, values, gl.STATIC_DRAW);
  return made;
}

/** Points an attribute of each vertex to a buffer; in rows of so many numbers, behind the first of these. */
function attribute(location, values, size, first = 0, numbers = size) {
  gl.bindBuffer(gl.ARRAY_BUFFER, values);
  gl.enableVertexAttribArray(location);
  gl.vertexAttribPointer(location, size, gl.FLOAT, false, 4 * numbers, 4 * first);
  gl.vertexAttribDivisor(location, 0);
}

const grids = new Map();

/** n x m cells of the unit square as triangles; a line has m = 1 and its sides at -1 and 1. */
function grid(n, m, isLine) {
  const key = `${n} ${m} ${isLine}`;
  if (grids.has(key)) return grids.get(key);
  const points = [], triangles = [];
  for (let j = 0; j <= m; ++j)
    for (let i = 0; i <= n; ++i) points.push(i / n, isLine ? 2 * j - 1 : j / m);
  for (let j = 0; j < m; ++j)
    for (let i = 0; i < n; ++i) {
      const a = j * (n + 1) + i, b = a + n + 1;
      triangles.push(a, a + 1, b + 1, a, b + 1, b);
    }
  const made = {points: buffer(new Float32Array(points)), count: triangles.length, triangles: gl.createBuffer()};
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, made.triangles);
  gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, new Uint16Array(triangles), gl.STATIC_DRAW);
  grids.set(key, made);
  return made;
}

let instances;

/** Draws a grid once for each entry of `list`, of so many numbers. */
function drawInstances(shape, list, sizes) {
  const size = sizes.reduce((sum, each) => sum + each, 0), count = list.length / size;
  if (count === 0) return;
  gl.bindBuffer(gl.ARRAY_BUFFER, instances);
  gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(list), gl.DYNAMIC_DRAW);
  let offset = 0;
  sizes.forEach((each, k) => {
    gl.enableVertexAttribArray(k + 1);
    gl.vertexAttribPointer(k + 1, each, gl.FLOAT, false, 4 * size, 4 * offset);
    gl.vertexAttribDivisor(k + 1, 1);
    offset += each;
  });
  attribute(0, shape.points, 2);
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, shape.triangles);
  gl.drawElementsInstanced(gl.TRIANGLES, shape.count, gl.UNSIGNED_SHORT, 0, count);
  for (let k = 0; k < sizes.length; ++k) gl.disableVertexAttribArray(k + 1);
}

/** A texture that is read texel by texel, in a unit of its own. */
function texture(number, format, width, height, kind, layout, values) {
  const made = gl.createTexture();
  gl.activeTexture(gl.TEXTURE0 + number);
  gl.bindTexture(gl.TEXTURE_2D, made);
  gl.texImage2D(gl.TEXTURE_2D, 0, format, width, height, 0, layout, kind, values);
  for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, filter, gl.NEAREST);
  return made;
}

const texelTexture = (number, texels) =>
  texture(number, gl.RGBA32F, texelsPerRow, texels.length / 4 / texelsPerRow, gl.FLOAT, gl.RGBA, texels);

const units = {points: 0, values: 1, colors: 2, undeformed: 3};

/** What the card has of the frame, the field and the colours that are shown. */
const loaded = {};

function load() {
  const record = data.frames[state.frame];
  if (loaded.frame !== state.frame) {
    gl.deleteTexture(loaded.points);
    loaded.body = body(data.meshes[record.mesh], record.positions);
    loaded.points = texelTexture(units.points, loaded.body.points);
    loaded.volumes = loaded.section = null;
  }
  if ((loaded.frame !== state.frame || loaded.field !== state.field) && !data.fields[state.field].isOfContact) {
    gl.deleteTexture(loaded.values);
    const texels = fieldTexels(loaded.body.mesh, record.fields[state.field].values, data.fields[state.field].components);
    loaded.values = texelTexture(units.values, texels);
  }
  if (loaded.field !== state.field || loaded.bands !== state.bands) {
    gl.deleteTexture(loaded.colors);
    const colors = fieldColors();
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    loaded.colors = texture(units.colors, gl.RGB8, colors.length / 3, 1, gl.UNSIGNED_BYTE, gl.RGB, colors);
    loaded.colorCount = colors.length / 3;
  }
  Object.assign(loaded, {frame: state.frame, field: state.field, bands: state.bands});
  if (!loaded.undeformed) {
    loaded.undeformed = body(data.meshes[data.undeformed.mesh], data.undeformed.positions);
    texelTexture(units.undeformed, loaded.undeformed.points);
  }
}

/** The colours of the field from the lowest to the highest value: smooth, or the bands' own. */
function fieldColors() {
  const smooth = bytes(data.fields[state.field].colors), count = smooth.length / 3;
  if (!state.bands || data.fields[state.field].hasStates) return smooth;
  const colors = new Uint8Array(3 * state.bands);
  for (let k = 0; k < state.bands; ++k) {
    const place = (state.bands === 1 ? 0.5 : k / (state.bands - 1)) * (count - 1);
    const from = Math.min(Math.floor(place), count - 2), share = place - from;
    for (let c = 0; c < 3; ++c)
      colors[3 * k + c] = Math.round((1 - share) * smooth[3 * from + c] + share * smooth[3 * from + 3 + c]);
  }
  return colors;
}

// ---- Tools

/** What moves a tool from its reference position to where it stands in the frame, a matrix by columns. */
function toolMatrix(tool, motion) {
  const columns = [0, 1, 2].map((k) => turned([0, 1, 2].map((d) => (d === k ? 1 : 0)), tool.axis, motion[3]));
  const center = [0, 1, 2].map((d) => columns.reduce((sum, column, k) => sum + column[d] * tool.pivot[k], 0));
  const way = minus(plus(tool.pivot, motion.slice(0, 3)), center);
  return new Float32Array([...columns.flatMap((column) => [...column, 0]), ...way, 1]);
}

const identity = new Float32Array([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]);

function loadTools() {
  for (const tools of data.tools)
    for (const tool of tools) {
      for (const part of [tool.area, tool.lines].filter((each) => each && each.triangles)) {
        part.pointBuffer = buffer(floats(part.points));
        part.normalBuffer = part.normals && buffer(floats(part.normals));
        const triangles = integers(part.triangles);
        part.corners = triangles;
        part.count = triangles.length;
        part.triangleBuffer = gl.createBuffer();
        gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, part.triangleBuffer);
        gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, new Uint32Array(triangles), gl.STATIC_DRAW);
      }
      if (!tool.lines || !tool.lines.segments) continue;
      const points = floats(tool.lines.points);
      tool.segments = [...integers(tool.lines.segments)].flatMap((k) => [...points.subarray(3 * k, 3 * k + 3)]);
    }
}

/** Calls `act` with every tool that has not been taken away and its matrix in the frame. */
function forTools(act) {
  if (!state.tools) return;
  const record = data.frames[state.frame];
  data.tools[record.tools].forEach((tool, k) => {
    if (record.gone && record.gone.includes(k)) return;
    act(tool, toolMatrix(tool, record.motion.slice(4 * k, 4 * k + 4)));
  });
}

function drawToolArea(tool, motion, common, paint) {
  if (!tool.area || !tool.area.triangles) return;
  program("plain", plainVertex, plainFragment).use({
    ...common, motion, paint, light: {integer: solid && tool.area.normalBuffer ? 1 : 0}});
  attribute(0, tool.area.pointBuffer, 3);
  if (tool.area.normalBuffer) attribute(1, tool.area.normalBuffer, 3);
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, tool.area.triangleBuffer);
  gl.drawElements(gl.TRIANGLES, tool.area.count, gl.UNSIGNED_INT, 0);
  gl.disableVertexAttribArray(1);
}

function drawToolAreas(common, paint) {
  forTools((tool, motion) => drawToolArea(tool, motion, common, paint));
}

/** Segments in the triangles of a part where a function of its points, by their numbers, is 0. */
function zeroSegments(part, valueAt) {
  part.places ??= floats(part.points);
  const values = Float64Array.from({length: part.places.length / 3}, (_, k) => valueAt(k));
  const segments = [];
  for (let first = 0; first < part.corners.length; first += 3) {
    const ends = [];
    for (let side = 0; side < 3; ++side) {
      const a = part.corners[first + side], b = part.corners[first + (side + 1) % 3];
      if ((values[a] < 0) === (values[b] < 0)) continue;
      const share = values[a] / (values[a] - values[b]);
      for (let d = 0; d < 3; ++d) ends.push(part.places[3 * a + d] * (1 - share) + part.places[3 * b + d] * share);
    }
    if (ends.length === 6) segments.push(...ends);
  }
  return segments;
}

/** Numbers of three at a place of a list, times a vector. */
const dotAt = (list, k, v) => list[3 * k] * v[0] + list[3 * k + 1] * v[1] + list[3 * k + 2] * v[2];

/** A direction of space as a tool has it that has moved. */
const turnedBack = (motion, v) => [0, 4, 8].map((k) => dot(motion.subarray(k, k + 3), v));

/** Where the surface of a tool turns away from the eye. */
function silhouette(part, motion) {
  if (!part || !part.normals || !part.corners) return [];
  part.directions ??= floats(part.normals);
  const towards = turnedBack(motion, eye());
  return zeroSegments(part, (k) => dotAt(part.directions, k, towards));
}

/** Where a plane cuts the surface of a tool. */
function cutLine(part, motion, plane) {
  if (!part || !part.corners) return [];
  const normal = turnedBack(motion, plane.normal), offset = plane.offset - dot(plane.normal, motion.subarray(12, 15));
  return zeroSegments(part, (k) => dotAt(part.places, k, normal) - offset);
}

function drawToolLines(common, plane) {
  forTools((tool, motion) => {
    const look = {motion, paint: [...rgb(theme().outline), 1], width: 1.2 * common.lines};
    const drawSegments = (segments, more) => {
      if (segments.length === 0) return;
      program("segments", segmentVertex, lineFragment).use({...common, ...look, ...more});
      drawInstances(grid(1, 1, true), segments, [3, 3]);
    };
    drawSegments(tool.segments ?? [], {});
    if (!solid) return;
    drawSegments(silhouette(tool.area, motion), {});
    if (plane) drawSegments(cutLine(tool.area, motion, plane), {cut: [0, 0, 0, 1]});
  });
}

/** Closes the tools that a plane has opened. */
function drawToolCaps(plane, common) {
  forTools((tool, motion) => {
    if (!tool.isClosed || !tool.area || !tool.area.corners) return;
    drawCap(plane, common, () => drawToolArea(tool, motion, common, [0, 0, 0, 1]), {
      name: "plain", fragment: plainFragment, farther: common.farther, paint: [...rgb(theme().tool), 1]});
  });
}

// ---- Drawing

/** Lists of entries of the same degrees. */
function byDegrees(list, spanOf) {
  const groups = new Map();
  for (const each of list) {
    const span = spanOf(each), key = `${span.p} ${span.q}`;
    if (!groups.has(key)) groups.set(key, {p: span.p, q: span.q, list: []});
    groups.get(key).list.push(each);
  }
  return [...groups.values()];
}

function drawEdges(shape, unit, visible, cells, common, paint, width) {
  for (const {p, q, list} of byDegrees(shape.edges.filter(({span}) => visible(span)), ({span}) => span)) {
    program(`edges ${p} ${q}`, edgeVertex(p, q), lineFragment).use({
      ...common, points: {integer: unit}, paint, width, cell: 1 / cells});
    drawInstances(grid(cells, 1, true), list.flatMap(({span, side}) => [span.place, span.stride, side]), [2 + 1]);
  }
}

/** How values of the field are coloured. */
function fieldLook() {
  const field = data.fields[state.field];
  return {
    colors: {integer: units.colors}, range: field.range, count: {integer: loaded.colorCount}, isolines: state.isolines,
    nonNegative: field.nonNegative ? 1 : 0, knotColor: state.knots ? rgb(theme().knots) : [-1, -1, -1],
    outlineColor: rgb(theme().outline), paperColor: rgb(theme().paper)};
}

/** The faces of a contact field, over bodies without colours. */
function drawContact(common) {
  const field = data.fields[state.field], faces = data.frames[state.frame].fields[state.field].faces;
  if (!faces) return;
  const points = floats(faces.points), values = floats(faces.values);
  const look = {...common, ...fieldLook(), knotColor: [-1, -1, -1]};
  if (faces.segments) {
    const ends = integers(faces.segments), list = [];
    for (let k = 0; k + 1 < ends.length; k += 2) {
      for (const end of [ends[k], ends[k + 1]]) list.push(...points.subarray(3 * end, 3 * end + 3));
      list.push(values[ends[k]], values[ends[k + 1]]);
    }
    program("contact line", contactLineVertex, contactFragment).use({...look, light: {integer: 0}, width: 6 * common.lines});
    drawInstances(grid(1, 1, true), list, [3, 3, 2]);
  }
  if (!faces.triangles) return;
  program("contact", contactVertex, contactFragment).use({...look, light: {integer: state.light ? 1 : 0}});
  const made = [buffer(points), buffer(values), buffer(new Uint32Array(integers(faces.triangles)), gl.ELEMENT_ARRAY_BUFFER)];
  attribute(0, made[0], 3);
  attribute(1, made[1], 1);
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, made[2]);
  gl.drawElements(gl.TRIANGLES, integers(faces.triangles).length, gl.UNSIGNED_INT, 0);
  gl.disableVertexAttribArray(1);
  for (const each of made) gl.deleteBuffer(each);
}

/** Whether a body has no values of the field. */
const isPlain = (body) => data.fields[state.field].isOfContact || data.frames[state.frame].fields[state.field].without.includes(body);

/** All of the surface that is visible, in colours. */
function drawSurface(spans, cells, common) {
  const field = data.fields[state.field];
  const plainColor = middle(rgb(theme().tool), rgb(theme().paper));
  for (const plain of [0, 1])
    for (const {p, q, list} of byDegrees(spans.filter(({body}) => isPlain(body) === Boolean(plain)), (s) => s)) {
      program(`surface ${p} ${q}`, surfaceVertex(p, q), surfaceFragment(p, q)).use({
        ...common, ...fieldLook(), points: {integer: units.points}, values: {integer: units.values},
        components: {integer: field.components}, light: {integer: solid && state.light ? 1 : 0}, plain: {integer: plain}, plainColor});
      drawInstances(grid(cells, cells, false), list.flatMap((span) => [span.place, span.stride]), [2]);
    }
}

/** Closes what a plane has opened: inside, a ray meets the surface behind the plane an odd number of times. */
function drawCap(plane, common, drawOpened, {name, fragment, ...look}) {
  gl.enable(gl.STENCIL_TEST);
  gl.disable(gl.DEPTH_TEST);
  gl.colorMask(false, false, false, false);
  gl.stencilFunc(gl.ALWAYS, 0, 1);
  gl.stencilOp(gl.KEEP, gl.KEEP, gl.INVERT);
  drawOpened();
  gl.colorMask(true, true, true, true);
  gl.enable(gl.DEPTH_TEST);
  gl.stencilFunc(gl.EQUAL, 1, 1);
  gl.stencilOp(gl.KEEP, gl.KEEP, gl.KEEP);
  const a = plane.normal.map((x, k) => (plane.normal[(k + 1) % 3] !== 0 ? boxSize : 0)), b = cross(plane.normal, a);
  const middleOfCut = plus(boxMiddle, scaled(plane.normal, plane.offset - dot(plane.normal, boxMiddle)));
  const corners = [[-1, -1], [1, -1], [1, 1], [-1, 1]].flatMap(([s, t]) => plus(middleOfCut, plus(scaled(a, s), scaled(b, t))));
  program(name, plainVertex, fragment).use({...common, farther: 0, motion: identity, light: {integer: 0}, cut: [0, 0, 0, 1], ...look});
  const points = buffer(new Float32Array(corners));
  attribute(0, points, 3);
  gl.drawArrays(gl.TRIANGLE_FAN, 0, 4);
  gl.deleteBuffer(points);
  gl.clear(gl.STENCIL_BUFFER_BIT);
  gl.disable(gl.STENCIL_TEST);
}

/** The field on the faces that a plane makes. */
function drawSection(plane, visible, scale, common) {
  const {vertices, triangles} = shownSection(plane, visible, scale);
  if (triangles.length === 0) return;
  program("section", sectionVertex, sectionFragment).use({...common, ...fieldLook()});
  const made = [buffer(vertices), buffer(triangles, gl.ELEMENT_ARRAY_BUFFER)];
  attribute(0, made[0], 4, 0, sectionNumbers);
  attribute(1, made[0], 3, 4, sectionNumbers);
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, made[1]);
  gl.drawElements(gl.TRIANGLES, triangles.length, gl.UNSIGNED_INT, 0);
  gl.disableVertexAttribArray(1);
  for (const each of made) gl.deleteBuffer(each);
}

function draw() {
  load();
  const ratio = devicePixelRatio, width = Math.round(canvas.clientWidth * ratio), height = Math.round(canvas.clientHeight * ratio);
  if (canvas.width !== width) canvas.width = width;
  if (canvas.height !== height) canvas.height = height;
  const scale = pixelsPerLength() * ratio, towards = eye(), depth = 6 * boxSize;
  const view = new Float32Array(16);
  [[state.right, 2 * scale / width, state.center[0]], [state.up, 2 * scale / height, state.center[1]],
    [towards, -1 / depth, dot(towards, boxMiddle)]].forEach(([axis, factor, center], row) => {
    for (let k = 0; k < 3; ++k) view[4 * k + row] = factor * axis[k];
    view[12 + row] = -factor * center;
  });
  view[15] = 1;
  const plane = cutPlane(), lines = ratio * 1.25;
  const visible = ({center, radius}) => {
    const [x, y] = minus(projected(center), state.center), reach = radius + 4 / scale;
    if (plane && dot(plane.normal, center) - radius > plane.offset) return false;
    return Math.abs(x) <= width / 2 / scale + reach && Math.abs(y) <= height / 2 / scale + reach;
  };
  const cellsOf = (spans) => {
    const second = spans.reduce((most, span) => Math.max(most, span.second), 0);
    return clamp(Math.ceil(Math.sqrt(second * scale / (4 * pixelTolerance))), solid ? 4 : 1, mostCells);
  };
  const spans = loaded.body.spans.filter(visible), cells = cellsOf(spans);
  const common = {view, lines, pixels: [width, height], right: state.right, up: state.up, eye: towards, nearer: solid ? 3 / scale / depth : 0,
    farther: solid ? 0.003 * boxSize / depth : 0,
    cut: plane ? [...plane.normal, plane.offset] : [0, 0, 0, 1]};
  const outline = [...rgb(theme().outline), 1];
  const drawUndeformed = () => {
    if (state.undeformed)
      drawEdges(loaded.undeformed, units.undeformed, visible, cellsOf(loaded.undeformed.spans.filter(visible)),
        {...common, nearer: -common.nearer}, [...rgb(theme().undeformed), 1], 0.8 * lines);
  };
  gl.viewport(0, 0, width, height);
  gl.clearColor(...rgb(theme().paper), 1);
  gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT | gl.STENCIL_BUFFER_BIT);
  gl[solid ? "enable" : "disable"](gl.DEPTH_TEST);
  gl.depthFunc(gl.LEQUAL);
  if (!solid) drawToolAreas(common, [...rgb(theme().tool), 1]);
  drawSurface(spans, cells, common);
  if (plane) {
    const hatched = spans.filter(({body}) => !loaded.body.mesh.volumes || isPlain(body));
    if (hatched.length > 0)
      drawCap(plane, common, () => drawSurface(hatched, cells, common), {name: "cap", fragment: capFragment,
        paint: [...middle(rgb(theme().tool), rgb(theme().paper)), 1], hatch: rgb(theme().soft)});
    if (loaded.body.mesh.volumes) drawSection(plane, visible, scale, common);
  }
  drawUndeformed();
  drawEdges(loaded.body, units.points, visible, cells, common, outline, lines);
  if (plane) drawToolCaps(plane, common);
  drawToolLines(common, plane);
  drawContact({...common, nearer: solid ? common.nearer + 0.002 * boxSize / depth : 0});
  if (solid) {
    drawToolGlass(common);
    showAxes();
  }
  return {cells, spans: spans.length};
}

/** The axes of space as they are seen, those that point to the eye before the others. */
function showAxes() {
  const length = 32, head = 9, letter = 11;
  const axes = [...byId("axes").children].map((node) => {
    const k = "xyz".indexOf(node.lastElementChild.textContent), axis = [0, 1, 2].map((d) => (d === k ? 1 : 0));
    const [right, up] = projected(axis), size = Math.hypot(right, up), along = size > 0 ? [right / size, -up / size] : [0, 0];
    const tip = along.map((x) => length * size * x), neck = along.map((x) => (length - head) * size * x);
    const aside = [-along[1], along[0]].map((x) => 0.3 * head * Math.min(1, 2 * size) * x);
    const [line, arrow, name] = node.children, set = (item, values) => Object.entries(values).forEach(([key, value]) => item.setAttribute(key, value));
    set(line, {x2: neck[0], y2: neck[1]});
    set(arrow, {points: [tip, plus(neck, aside), minus(neck, aside)].map((place) => place.join()).join(" ")});
    set(name, {x: tip[0] + letter * along[0], y: tip[1] + letter * along[1]});
    return {node, depth: dot(eye(), axis)};
  });
  byId("axes").append(...axes.sort((a, b) => a.depth - b.depth).map(({node}) => node));
}

/** Tools in space: what is behind them shows through, their far sides first. */
function drawToolGlass(common) {
  const paint = [...rgb(theme().tool), data.toolOpacity];
  if (data.toolOpacity >= 1) return drawToolAreas(common, paint);
  gl.enable(gl.BLEND);
  gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
  gl.depthMask(false);
  gl.enable(gl.CULL_FACE);
  for (const side of [gl.FRONT, gl.BACK]) {
    gl.cullFace(side);
    drawToolAreas(common, paint);
  }
  gl.disable(gl.CULL_FACE);
  gl.depthMask(true);
  gl.disable(gl.BLEND);
}

// ---- The page around it

function element(tag, properties = {}, ...children) {
  const node = Object.assign(document.createElement(tag), properties);
  node.append(...children);
  return node;
}

const rich = (pieces) => pieces.map(([text, script]) => (script ? element(script === 1 ? "sub" : "sup", {}, text) : text));

/** Marks of the scale: [value, label] at round values, or at borders of bands with as many decimals as tell them. */
function ticksOf(field) {
  if (!state.bands || field.hasStates) return field.ticks.map((value, k) => [value, field.labels[k]]);
  const most = 11, visible = 0.005;
  const every = Math.ceil(state.bands / (most - 1)), unit = 10 ** field.exponent;
  const [low, high] = field.range, step = every * (high - low) / state.bands;
  const values = [];
  for (let k = 0; k <= state.bands; k += every) values.push(low + (high - low) * k / state.bands);
  let decimals = 0;
  while (values.some((value) => Math.abs((value / unit).toFixed(decimals) - value / unit) > visible * step / unit)) ++decimals;
  return values.map((value) => {
    const text = (value / unit).toFixed(decimals);
    return [value, (Number(text) ? text : (0).toFixed(decimals)).replace("-", "\u2212")];
  });
}

function showScale() {
  const field = data.fields[state.field], record = data.frames[state.frame].fields[state.field];
  const colors = fieldColors(), count = colors.length / 3, ramp = byId("colors");
  ramp.height = count;
  const painter = ramp.getContext("2d"), rows = painter.createImageData(1, count);
  for (let k = 0; k < count; ++k) rows.data.set([...colors.subarray(3 * k, 3 * k + 3), 255], 4 * (count - 1 - k));
  painter.putImageData(rows, 0, 0);
  byId("largest").replaceChildren(...rich(record.largest));
  byId("smallest").replaceChildren(...rich(record.smallest));
  byId("field-title").replaceChildren(...rich(field.title));
  byId("ticks").replaceChildren(...ticksOf(field).map(([value, label]) => {
    const tick = element("span", {}, label);
    tick.style.bottom = `${100 * (value - field.range[0]) / (field.range[1] - field.range[0])}%`;
    return tick;
  }));
}

function showState() {
  const record = data.frames[state.frame], field = data.fields[state.field];
  byId("when").textContent = `t = ${record.time}, frame ${state.frame + 1} of ${data.frames.length}` +
    (data.doubt ? `; ${data.doubt}` : "");
  byId("frame").value = state.frame;
  byId("frame").setAttribute("aria-valuetext", `t = ${record.time}`);
  byId("field").value = state.field;
  if (state.bands && !bandChoices.includes(state.bands)) {
    bandChoices.push(state.bands);
    byId("bands").append(element("option", {value: state.bands}, state.bands));
  }
  byId("bands").value = state.bands;
  byId("cut").value = state.cut;
  byId("cut-place").value = state.cutPlace;
  byId("cut-place").disabled = !state.cut;
  for (const key of ["knots", "undeformed", "tools", "light"]) byId(key).checked = state[key];
  byId("play").textContent = state.playing ? "Pause" : "Play";
  byId("play").setAttribute("aria-pressed", state.playing);
  canvas.setAttribute("aria-label", `${data.title}: ${field.words}, t = ${record.time}`);
  showScale();
}

let drawing = 0;

function update() {
  showState();
  if (!drawing) drawing = requestAnimationFrame(() => { drawing = 0; draw(); });
}

const change = (values) => { Object.assign(state, values); update(); };
const toFrame = (frame) => change({frame: clamp(frame, 0, data.frames.length - 1)});

let player = 0;

function play() {
  state.playing = !state.playing && data.frames.length > 1;
  clearInterval(player);
  if (state.playing)
    player = setInterval(() => change({frame: (state.frame + 1) % data.frames.length}), playMilliseconds);
  update();
}

const nextOf = (list, value) => list[(list.indexOf(value) + 1) % list.length];
const step = 0.1, way = 40;  // radians; pixels
const arrow = (x, y) => (event) => (solid && !event.shiftKey ? turn(step * x, -step * y) : shift(-way * x, way * y));

/** Keys with what they do and, for help, their words. */
const keys = [
  [["ArrowLeft"], arrow(-1, 0), ""],
  [["ArrowRight"], arrow(1, 0), ""],
  [["ArrowUp"], arrow(0, 1), ""],
  [["ArrowDown"], arrow(0, -1), solid ? "arrows turn, with Shift they move" : "arrows move"],
  [["+", "="], () => zoomBy(1.2), ""],
  [["-"], () => zoomBy(1 / 1.2), "+ − zoom"],
  [["0"], resetView, "0 shows everything"],
  [[" "], play, "space plays"],
  [[","], () => toFrame(state.frame - 1), ""],
  [["."], () => toFrame(state.frame + 1), ", . go from frame to frame"],
  [["f"], () => change({field: (state.field + 1) % data.fields.length}), "f field"],
  [["b"], () => change({bands: nextOf([0, ...bandChoices], state.bands)}), "b bands"],
  [["k"], () => change({knots: !state.knots}), "k knot lines"],
  [["u"], () => change({undeformed: !state.undeformed}), "u undeformed body"],
  [["t"], () => change({tools: !state.tools}), "t tools"],
  ...(solid ? [
    [["l"], () => change({light: !state.light}), "l light"],
    ...["x", "y", "z"].map((axis) => [[axis], () => change({cut: state.cut === axis ? "" : axis}), axis === "z" ? "x y z cut" : ""]),
    [["["], () => change({cutPlace: clamp(state.cutPlace - 0.02, 0, 1)}), ""],
    [["]"], () => change({cutPlace: clamp(state.cutPlace + 0.02, 0, 1)}), "[ ] move the cut"],
  ] : []),
];

function onKey(event) {
  if (event.ctrlKey || event.altKey || event.metaKey || event.target.closest("input, select, button, summary")) return;
  const found = keys.find(([names]) => names.includes(event.key));
  if (!found) return;
  event.preventDefault();
  found[1](event);
  update();
}

// Pointers that are down, by their number: where they were last.
const pointers = new Map();

function onMove(event) {
  const last = pointers.get(event.pointerId);
  if (!last) return;
  const now = [event.clientX, event.clientY], [x, y] = minus(now, last);
  const other = [...pointers].find(([id]) => id !== event.pointerId);
  if (other) {
    const apart = (point) => Math.max(1, Math.hypot(...minus(point, other[1])));
    const [cx, cy] = fromMiddle(middle(now, other[1]));
    shift(x / 2, y / 2);
    zoomBy(apart(now) / apart(last), cx, cy);
  } else if (solid && !event.shiftKey && event.buttons === 1) {
    turn(0.01 * x, 0.01 * y);
  } else {
    shift(x, y);
  }
  pointers.set(event.pointerId, now);
  update();
}

function fromMiddle([x, y]) {
  const box = canvas.getBoundingClientRect();
  return [x - box.left - box.width / 2, y - box.top - box.height / 2];
}

function onWheel(event) {
  event.preventDefault();
  zoomBy(Math.exp(-0.001 * event.deltaY * (event.deltaMode === 1 ? 30 : 1)), ...fromMiddle([event.clientX, event.clientY]));
  update();
}

function listen() {
  const on = (id, kind, act) => byId(id).addEventListener(kind, act);
  on("frame", "input", () => toFrame(Number(byId("frame").value)));
  on("play", "click", play);
  on("field", "change", () => change({field: Number(byId("field").value)}));
  on("bands", "change", () => change({bands: Number(byId("bands").value)}));
  on("cut", "change", () => change({cut: byId("cut").value}));
  on("cut-place", "input", () => change({cutPlace: Number(byId("cut-place").value)}));
  for (const key of ["knots", "undeformed", "tools", "light"]) on(key, "change", () => change({[key]: byId(key).checked}));
  on("home", "click", () => { resetView(); update(); });
  on("controls", "submit", (event) => event.preventDefault());
  document.addEventListener("keydown", onKey);
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, [event.clientX, event.clientY]);
  });
  for (const kind of ["pointerup", "pointercancel"]) canvas.addEventListener(kind, (event) => pointers.delete(event.pointerId));
  canvas.addEventListener("pointermove", onMove);
  canvas.addEventListener("wheel", onWheel, {passive: false});
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("webglcontextlost", showFallback);
  darkness.addEventListener("change", update);
  new ResizeObserver(update).observe(canvas);
}

/** What the address asks for behind its #, such as frame=3&field=von_mises&cut=z. */
function readAddress() {
  const asked = new URLSearchParams(location.hash.slice(1));
  const field = data.fields.findIndex(({name}) => name === asked.get("field"));
  if (field >= 0) state.field = field;
  if (asked.has("frame")) state.frame = clamp(Math.round(Number(asked.get("frame"))) - 1 || 0, 0, data.frames.length - 1);
  for (const key of ["knots", "undeformed", "tools", "light"]) if (asked.has(key)) state[key] = asked.get(key) !== "off";
  for (const [key, most] of [["bands", 256], ["isolines", 100]])
    if (asked.has(key)) state[key] = clamp(Math.round(Number(asked.get(key))) || 0, 0, most);
  if (solid && ["x", "y", "z"].includes(asked.get("cut"))) state.cut = asked.get("cut");
  if (asked.has("place")) state.cutPlace = clamp(Number(asked.get("place")) || 0, 0, 1);
  const [sideways, over] = (asked.get("turn") || "").split(",").map((degrees) => Number(degrees) * Math.PI / 180);
  if (Number.isFinite(sideways) && Number.isFinite(over)) turn(sideways, over);
  zoomBy(Number(asked.get("zoom")) || 1);
}

/** A picture instead of all that needs a graphics card. */
function showFallback() {
  byId("fallback").hidden = false;
  for (const id of ["space", "scale", "controls"]) byId(id).hidden = true;
  clearInterval(player);
}

/** Colours of the page that go with a theme of its own. */
function dressPage() {
  const {paper, ink, soft} = theme();
  const between = (part) => `color-mix(in srgb, ${ink} ${part}%, ${paper})`;
  const colors = {"--paper": paper, "--ink": ink, "--soft": soft, "--line": between(18), "--panel": between(4)};
  for (const [name, color] of Object.entries(colors)) document.documentElement.style.setProperty(name, color);
  document.documentElement.style.colorScheme = dot(rgb(paper), [1, 1, 1]) < 1.5 ? "dark" : "light";
}

function start() {
  if (data.isThemed) dressPage();
  document.body.classList.toggle("flat", !solid);
  byId("title").textContent = data.title;
  byId("picture").alt = `${data.title}: ${data.fields[0].words}`;
  byId("frame").max = data.frames.length - 1;
  for (const id of ["frame", "play"]) byId(id).hidden = data.frames.length < 2;
  data.fields.forEach((field, k) => byId("field").append(element("option", {value: k}, field.words)));
  for (const count of bandChoices) byId("bands").append(element("option", {value: count}, count));
  byId("keys").textContent = `${keys.map((key) => key[2]).filter(Boolean).join("; ")}. Mouse and fingers: ` +
    `${solid ? "drag to turn, with Shift, the right button or two fingers to move" : "drag to move"}; wheel or two fingers to zoom.`;
  resetView();
  if (!gl) return showFallback();
  instances = gl.createBuffer();
  loadTools();
  listen();
  readAddress();
  showState();
  draw();
}

start();
