#!/usr/bin/env node
// GJK and EPA to read as a lesson, in 1D, 2D and 3D, and the few lines that put your own under gjkdbg:
//
//   gjkdbg run SCENE --exec "node gjk.js"
//
// Replace `solve` by yours. All it needs is support(d): the farthest point w of A - B along d, with a and b, w = a - b. Reports
// by `say` ("simplex", "polytope", "face") are optional; the more you report, the earlier gjkdbg can tell where it went wrong.
"use strict";
const fs = require("fs");

// --- The protocol: one JSON message a line -------------------------------------------------------------------------
const say = (message) => fs.writeSync(1, JSON.stringify(message) + "\n");

let buffered = "";
function readLine() {
  const chunk = Buffer.alloc(65536);
  while (!buffered.includes("\n")) {
    let n = 0;
    try {
      n = fs.readSync(0, chunk);
    } catch (e) {
      if (e.code !== "EAGAIN") throw e;
      continue;
    }
    if (n === 0) process.exit(1);
    buffered += chunk.toString("utf8", 0, n);
  }
  const end = buffered.indexOf("\n"), line = buffered.slice(0, end);
  buffered = buffered.slice(end + 1);
  return JSON.parse(line);
}

/** A support point: { vertex, w, a, b }; `vertex` is its name in messages. */
function support(direction) {
  say({ type: "support", direction });
  return readLine();
}

// --- Vectors ----------------------------------------------------------------------------------------------------------
const dot = (x, y) => x.reduce((sum, p, i) => sum + p * y[i], 0);
const minus = (x, y) => x.map((p, i) => p - y[i]);
const scaled = (s, x) => x.map((p) => s * p);
const length = (x) => Math.sqrt(dot(x, x));
const combine = (weights, points) => points[0].map((_, i) => weights.reduce((sum, t, k) => sum + t * points[k][i], 0));
/** `like` without its part along the unit vector e. */
const across = (e, like) => minus(like, scaled(dot(e, like), e));
const same = (x, y) => x.every((p, i) => p === y[i]);

/** All ways to pick `size` of a list. */
function combinations(list, size) {
  if (size === 0) return [[]];
  return list.flatMap((x, i) => combinations(list.slice(i + 1), size - 1).map((rest) => [x, ...rest]));
}

// --- GJK: the nearest part of a simplex ---------------------------------------------------------------------------------
/** Weights of the point nearest the origin in the flat through the points, or null when they do not span it.
 *  With p0 + sum t_i e_i, e_i = p_i - p0, the nearest has e_j . (p0 + sum t_i e_i) = 0 for all j: solved by elimination. p0 is the point that is
 *  nearest to the others: of a sliver's two long sides the products would lose what sets them apart. */
function affineWeights(points) {
  const spread = points.map((p) => points.reduce((sum, q) => sum + dot(minus(q, p), minus(q, p)), 0)), k = spread.indexOf(Math.min(...spread));
  const e = points.filter((_, i) => i !== k).map((p) => minus(p, points[k])), n = e.length;
  const rows = e.map((x) => [...e.map((y) => dot(x, y)), -dot(x, points[k])]);
  for (let c = 0; c < n; ++c) {
    let best = c;
    for (let r = c; r < n; ++r) if (Math.abs(rows[r][c]) > Math.abs(rows[best][c])) best = r;
    [rows[c], rows[best]] = [rows[best], rows[c]];
    if (Math.abs(rows[c][c]) <= 1e-14 * dot(e[c], e[c])) return null;
    for (let r = 0; r < n; ++r)
      if (r !== c) rows[r] = minus(rows[r], scaled(rows[r][c] / rows[c][c], rows[c]));
  }
  const t = rows.map((row, i) => row[n] / row[i]);
  return [...t.slice(0, k), 1 - t.reduce((x, y) => x + y, 0), ...t.slice(k)];
}

/** The part of the simplex nearest the origin. Tries every part; slow, and never wrong. */
function nearest(simplex) {
  let best = null;
  for (let size = 1; size <= simplex.length; ++size)
    for (const part of combinations(simplex, size)) {
      const weights = affineWeights(part.map((x) => x.w));
      if (!weights || Math.min(...weights) < 0) continue;
      const v = combine(weights, part.map((x) => x.w));
      if (!best || dot(v, v) < dot(best.v, best.v)) best = { part, v, weights };
    }
  return best;
}

/** { part, v, weights }: |v| is the distance; v = 0 when they overlap. */
function gjk(dimension, tolerance) {
  let now = nearest([support([1, ...Array(dimension - 1).fill(0)])]);
  let scale = length(now.v);
  for (;;) {
    say({ type: "simplex", vertices: now.part.map((x) => x.vertex), closest: now.v });
    if (length(now.v) <= 1e-12 * scale || now.part.length === dimension + 1) return { ...now, v: now.v.map(() => 0) };
    const w = support(scaled(-1, now.v));
    scale = Math.max(scale, length(w.w));
    const known = now.part.some((x) => same(x.w, w.w));
    if (dot(now.v, now.v) - dot(now.v, w.w) <= tolerance * dot(now.v, now.v) || known) return now;
    const next = nearest([w, ...now.part]);
    if (dot(next.v, next.v) >= dot(now.v, now.v)) return now; // rounding: no nearer part can be told
    now = next;
  }
}

// --- EPA ------------------------------------------------------------------------------------------------------------------
/** Vertices until they span the space: { points }, or { flat } when A - B is flat across that direction. */
function complete(simplex, dimension) {
  const points = [simplex[0]], basis = [];
  let scale = Math.max(1e-300, ...simplex.map((x) => length(x.w)));
  const off = (x) => basis.reduce((y, e) => across(e, y), minus(x.w, points[0].w));
  while (points.length <= dimension) {
    let axis = null, candidates = simplex.filter((x) => length(off(x)) > 1e-7 * scale);
    if (candidates.length === 0) {
      const axes = points[0].w.map((_, k) => basis.reduce((x, e) => across(e, x), points[0].w.map((__, i) => (i === k ? 1 : 0))));
      axis = axes.reduce((x, y) => (length(x) >= length(y) ? x : y));
      axis = scaled(1 / length(axis), axis);
      candidates = [support(axis), support(scaled(-1, axis))];
    }
    const best = candidates.reduce((x, y) => (length(off(x)) >= length(off(y)) ? x : y)), y = off(best);
    scale = Math.max(scale, length(best.w));
    if (length(y) <= 1e-10 * scale) return { flat: axis };
    basis.push(scaled(1 / length(y), y));
    points.push(best);
  }
  return { points };
}

/** Without rounding: every double is an integer times 2^-1074. */
const view = new DataView(new ArrayBuffer(8));
function exact(x) {
  return x.map((number) => {
    view.setFloat64(0, number);
    const bits = view.getBigUint64(0), exponent = (bits >> 52n) & 2047n, fraction = bits & (2n ** 52n - 1n);
    const size = exponent === 0n ? fraction : (fraction + 2n ** 52n) << (exponent - 1n);
    return bits >> 63n ? -size : size;
  });
}
const exactDot = (x, y) => x.reduce((sum, p, i) => sum + p * y[i], 0n);
const magnitude = (x) => (x < 0n ? -x : x);

/** A face with its unit normal away from `inside`, its distance from the origin, and the normal of any length without rounding. Of the slivers
 *  that thin shapes lead to a normal from rounded differences may be any. */
function makeFace(corners, inside) {
  const p = corners.map((x) => exact(x.w));
  let n = p.length === 1 ? [1n] : p.length === 2 ? [p[1][1] - p[0][1], p[0][0] - p[1][0]] : null;
  if (!n) {
    const x = minus(p[1], p[0]), y = minus(p[2], p[0]);
    n = [x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]];
  }
  if (exactDot(n, minus(p[0], exact(inside))) < 0n) n = n.map((x) => -x);
  const digits = Math.max(...n.map((x) => magnitude(x).toString(16).length)); // the first 30 are enough
  const long = n.map((x) => Number(x >> BigInt(4 * Math.max(0, digits - 30)))), normal = scaled(1 / length(long), long);
  return { corners, normal, distance: dot(normal, corners[0].w), exactNormal: n };
}

/** Whether w lies on an edge's line, but for 1e-14 of the lengths: with |x|^2 |y|^2 - (x . y)^2 the square of the triangle's area, twice. */
function inLine(w, edge) {
  const [x, y] = edge.map((p) => minus(exact(w.w), exact(p.w))), xx = exactDot(x, x), yy = exactDot(y, y), xy = exactDot(x, y);
  const longest = xx > yy ? xx : yy;
  return (xx * yy - xy * xy) * 10n ** 28n <= longest * longest;
}

/** Whether w lies beyond the face, or in its plane: told without rounding where that might decide. So the faces seen are always one disc with one
 *  rim, and no new face is without area: w on the line of an edge takes away the faces on both sides of it. */
function sees(w, face, rounding) {
  const height = dot(face.normal, w.w) - face.distance;
  if (Math.abs(height) > rounding) return height > 0;
  if (exactDot(face.exactNormal, minus(exact(w.w), exact(face.corners[0].w))) >= 0n) return true;
  return face.corners.length === 3 && combinations(face.corners, 2).some((edge) => inLine(w, edge));
}

function epa(simplex, dimension, tolerance) {
  const { points, flat } = complete(simplex, dimension);
  if (flat) return { depth: 0, normal: flat, foot: nearest(simplex) };
  let rounding = 1e-14 * Math.max(...points.map((x) => length(x.w))); // of a point's height above a plane: its normal's numbers are right to the last bits
  const inside = combine(points.map(() => 1 / points.length), points.map((x) => x.w));
  let faces = combinations(points, dimension).map((f) => makeFace(f, inside)), face, height;
  for (;;) {
    say({ type: "polytope", faces: faces.map((f) => f.corners.map((x) => x.vertex)) });
    face = faces.reduce((x, y) => (y.distance < x.distance ? y : x));
    say({ type: "face", vertices: face.corners.map((x) => x.vertex), normal: face.normal, distance: face.distance });
    const w = support(face.normal);
    height = dot(face.normal, w.w);
    rounding = Math.max(rounding, 1e-14 * length(w.w));
    if (height - face.distance <= Math.max(tolerance * height, rounding) || faces.length > 600) break;
    const seen = new Set(faces.filter((f) => sees(w, f, rounding))), horizon = new Map();
    // The horizon: what belongs to one removed face only.
    for (const f of seen)
      for (const ridge of combinations(f.corners, dimension - 1)) {
        const key = ridge.map((x) => x.vertex).sort().join();
        if (!horizon.delete(key)) horizon.set(key, ridge);
      }
    const added = [...horizon.values()].map((ridge) => makeFace([...ridge, w], inside));
    faces = [...faces.filter((f) => !seen.has(f)), ...added];
  }
  // The origin's projection on the plane, as a combination of the corners of the face that holds it.
  const feet = faces.filter((f) => f.distance <= face.distance + 1e-9 * height).map((f) =>
    nearest(f.corners.map((x) => ({ ...x, w: minus(x.w, scaled(face.distance, face.normal)) }))));
  return { depth: height, normal: face.normal, foot: feet.reduce((x, y) => (length(x.v) <= length(y.v) ? x : y)) };
}

function solve({ dimension, query, tolerance }) {
  const { part, v, weights } = gjk(dimension, Math.max(tolerance, 1e-12)), distance = length(v);
  if (query === "intersect") return { intersecting: distance === 0 };
  const at = (foot, which) => combine(foot.weights, foot.part.map((x) => x[which]));
  if (distance > 0) {
    const foot = { part, weights };
    return { intersecting: false, signed_distance: distance, normal: scaled(-1 / distance, v), witness_a: at(foot, "a"), witness_b: at(foot, "b") };
  }
  if (query === "distance") return { intersecting: true, signed_distance: 0 };
  const { depth, normal, foot } = epa(part, dimension, Math.max(tolerance, 1e-6));
  const middle = combine([0.5, 0.5], [at(foot, "a"), at(foot, "b")]);
  return { intersecting: true, signed_distance: -depth, normal, witness_a: combine([1, depth / 2], [middle, normal]), witness_b: combine([1, -depth / 2], [middle, normal]) };
}

say({ type: "result", ...solve(readLine()) });
