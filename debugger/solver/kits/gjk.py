#!/usr/bin/env python3
"""GJK and EPA to read as a lesson, in 1D, 2D and 3D, and the few lines that put your own under gjkdbg:

    gjkdbg run SCENE --exec "python3 gjk.py"

Replace `solve` by yours. All it needs is `support(d)`: the farthest point w of A - B along d, with a and b, w = a - b. Reports by
`say` ("simplex", "polytope", "face") are optional; the more you report, the earlier gjkdbg can tell where it went wrong.
"""
import json
import sys
from itertools import combinations
from math import frexp

# --- The protocol: one JSON message a line ---------------------------------------------------------------------

def say(**message):
    print(json.dumps(message), flush=True)

class Vertex:
    """A support point: `number` is its name in messages."""

    def __init__(self, reply):
        self.number, self.w, self.a, self.b = reply["vertex"], reply["w"], reply["a"], reply["b"]

def support(d):
    say(type="support", direction=d)
    return Vertex(json.loads(sys.stdin.readline()))

# --- Vectors ------------------------------------------------------------------------------------------------------

def dot(x, y):
    return sum(p * q for p, q in zip(x, y))

def minus(x, y):
    return [p - q for p, q in zip(x, y)]

def scaled(s, x):
    return [s * p for p in x]

def length(x):
    return dot(x, x) ** 0.5

def combine(weights, points):
    return [sum(t * p[i] for t, p in zip(weights, points)) for i in range(len(points[0]))]

def across(e, like):
    """`like` without its part along the unit vector e."""
    return minus(like, scaled(dot(e, like), e))

# --- GJK: the nearest part of a simplex --------------------------------------------------------------------------

def affine_weights(points):
    """Weights of the point nearest the origin in the flat through the points, or None when they do not span it.
    With p0 + sum t_i e_i, e_i = p_i - p0, the nearest has e_j . (p0 + sum t_i e_i) = 0 for all j: solved by elimination. p0 is the point that is
    nearest to the others: of a sliver's two long sides the products would lose what sets them apart."""
    k = min(range(len(points)), key=lambda i: sum(dot(e, e) for e in (minus(p, points[i]) for p in points)))
    e = [minus(p, points[k]) for p in points[:k] + points[k + 1:]]
    rows = [[dot(x, y) for y in e] + [-dot(x, points[k])] for x in e]
    n = len(rows)
    for c in range(n):
        best = max(range(c, n), key=lambda r: abs(rows[r][c]))
        rows[c], rows[best] = rows[best], rows[c]
        if abs(rows[c][c]) <= 1e-14 * dot(e[c], e[c]):
            return None
        for r in range(n):
            if r != c:
                f = rows[r][c] / rows[c][c]
                rows[r] = [x - f * y for x, y in zip(rows[r], rows[c])]
    t = [rows[i][n] / rows[i][i] for i in range(n)]
    return t[:k] + [1 - sum(t)] + t[k:]

def nearest(simplex):
    """The part of the simplex nearest the origin: (its vertices, its nearest point). Tries every part; slow, and never wrong."""
    best = None
    for size in range(1, len(simplex) + 1):
        for part in combinations(simplex, size):
            weights = affine_weights([x.w for x in part])
            if weights is None or min(weights) < 0:
                continue
            v = combine(weights, [x.w for x in part])
            if best is None or dot(v, v) < best[2]:
                best = (list(part), v, dot(v, v), weights)
    return best[0], best[1], best[3]

def gjk(dimension, tolerance):
    """(vertices, v, weights): |v| is the distance; v = 0 when they overlap."""
    simplex = [support([1.0] + [0.0] * (dimension - 1))]
    v, weights = simplex[0].w, [1.0]
    scale = length(v)
    while True:
        say(type="simplex", vertices=[x.number for x in simplex], closest=v)
        if length(v) <= 1e-12 * scale or len(simplex) == dimension + 1:
            return simplex, [0.0] * dimension, weights
        w = support(scaled(-1, v))
        scale = max(scale, length(w.w))
        if dot(v, v) - dot(v, w.w) <= tolerance * dot(v, v) or any(w.w == x.w for x in simplex):
            return simplex, v, weights
        kept, nearer, weights_now = nearest([w] + simplex)
        if dot(nearer, nearer) >= dot(v, v):
            return simplex, v, weights  # rounding: no nearer part can be told
        simplex, v, weights = kept, nearer, weights_now

# --- EPA -----------------------------------------------------------------------------------------------------------

def complete(simplex, dimension):
    """Vertices until they span the space; (vertices, None), or (vertices, normal) when A - B is flat across `normal`."""
    points, basis = [simplex[0]], []
    scale = 1e-300 + max(length(x.w) for x in simplex)

    def off(x):
        y = minus(x.w, points[0].w)
        for e in basis:
            y = across(e, y)
        return y

    while len(points) <= dimension:
        candidates = [x for x in simplex if length(off(x)) > 1e-7 * scale]
        if not candidates:
            axes = [[float(i == k) for i in range(dimension)] for k in range(dimension)]
            for e in basis:
                axes = [across(e, x) for x in axes]
            axis = max(axes, key=length)
            axis = scaled(1 / length(axis), axis)
            candidates = [support(axis), support(scaled(-1, axis))]
        best = max(candidates, key=lambda x: length(off(x)))
        y = off(best)
        scale = max(scale, length(best.w))
        if length(y) <= 1e-10 * scale:
            return points, axis
        basis.append(scaled(1 / length(y), y))
        points.append(best)
    return points, None

def exact(x):
    """Without rounding: every double is an integer times 2^-1126 (m 2^e, m of 53 bits, e at least -1073), and integers are as long as they have to be."""
    return [int(m * 2**53) << e + 1073 for m, e in map(frexp, x)]

def plane(vertices, inside):
    """Unit normal away from `inside`, distance from the origin, and the normal of any length without rounding. Of the slivers that thin shapes lead
    to a normal from rounded differences may be any."""
    p = [exact(x.w) for x in vertices]
    if len(p) == 3:
        x, y = minus(p[1], p[0]), minus(p[2], p[0])
        n = [x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]]
    else:
        n = [1] if len(p) == 1 else [p[1][1] - p[0][1], p[0][0] - p[1][0]]
    if dot(n, minus(p[0], exact(inside))) < 0:
        n = scaled(-1, n)
    largest = max(abs(t) for t in n)
    unit = [t / largest for t in n]
    unit = scaled(1 / length(unit), unit)
    return unit, dot(unit, vertices[0].w), n

def in_line(w, edge):
    """Whether w lies on an edge's line, but for 1e-14 of the lengths: with |x|^2 |y|^2 - (x . y)^2 the square of the triangle's area, twice."""
    x, y = (minus(exact(w.w), exact(p.w)) for p in edge)
    return (dot(x, x) * dot(y, y) - dot(x, y) ** 2) * 10**28 <= max(dot(x, x), dot(y, y)) ** 2

def sees(w, face, rounding):
    """Whether w lies beyond the face, or in its plane: told without rounding where that might decide. So the faces seen are always one disc with one
    rim, and no new face is without area: w on the line of an edge takes away the faces on both sides of it."""
    corners, unit, distance, normal = face
    height = dot(unit, w.w) - distance
    if abs(height) > rounding:
        return height > 0
    above = dot(normal, minus(exact(w.w), exact(corners[0].w)))
    return above >= 0 or len(corners) == 3 and any(in_line(w, edge) for edge in combinations(corners, 2))

def epa(simplex, dimension, tolerance):
    """(depth, normal, point a, point b)."""
    points, flat = complete(simplex, dimension)
    if flat:
        kept, _, weights = nearest(simplex)
        return 0.0, flat, combine(weights, [x.a for x in kept]), combine(weights, [x.b for x in kept])
    rounding = 1e-14 * max(length(x.w) for x in points)  # of a point's height above a plane: its normal's numbers are right to the last bits
    inside = combine([1 / len(points)] * len(points), [x.w for x in points])
    faces = [(list(f),) + plane(f, inside) for f in combinations(points, dimension)]
    while True:
        say(type="polytope", faces=[[x.number for x in f[0]] for f in faces])
        face, normal, distance, _ = min(faces, key=lambda f: f[2])
        say(type="face", vertices=[x.number for x in face], normal=normal, distance=distance)
        w = support(normal)
        height = dot(normal, w.w)
        rounding = max(rounding, 1e-14 * length(w.w))
        if height - distance <= max(tolerance * height, rounding) or len(faces) > 600:
            break
        seen = [f for f in faces if sees(w, f, rounding)]
        # The horizon: what belongs to one removed face only.
        ridges = [tuple(sorted(r, key=lambda x: x.number)) for f in seen for r in combinations(f[0], dimension - 1)]
        horizon = [r for r in ridges if ridges.count(r) == 1]
        new = [list(r) + [w] for r in horizon]
        planes = [plane(f, inside) for f in new]
        faces = [f for f in faces if f not in seen] + [(f,) + p for f, p in zip(new, planes)]
    # The origin's projection on the plane, as a combination of the corners of the face that holds it.
    candidates = [foot(f[0], normal, distance) for f in faces if f[2] <= distance + 1e-9 * height]
    _, kept, weights = min(candidates, key=lambda c: c[0])
    return height, normal, combine(weights, [x.a for x in kept]), combine(weights, [x.b for x in kept])

def foot(face, normal, distance):
    """How far the face is from the projection of the origin on its plane, and the corners and weights of its nearest point."""
    moved = [Vertex(dict(vertex=i, w=minus(x.w, scaled(distance, normal)), a=x.a, b=x.b)) for i, x in enumerate(face)]
    kept, v, weights = nearest(moved)
    return length(v), kept, weights

def solve(dimension, query, tolerance):
    simplex, v, weights = gjk(dimension, max(tolerance, 1e-12))
    distance = length(v)
    if query == "intersect":
        return dict(intersecting=distance == 0)
    if distance > 0:
        a, b = combine(weights, [x.a for x in simplex]), combine(weights, [x.b for x in simplex])
        return dict(intersecting=False, signed_distance=distance, normal=scaled(-1 / distance, v), witness_a=a, witness_b=b)
    if query == "distance":
        return dict(intersecting=True, signed_distance=0.0)
    depth, normal, a, b = epa(simplex, dimension, max(tolerance, 1e-6))
    middle = combine([0.5, 0.5], [a, b])
    return dict(intersecting=True, signed_distance=-depth, normal=normal, witness_a=combine([1, depth / 2], [middle, normal]),
                witness_b=combine([1, -depth / 2], [middle, normal]))
if __name__ == "__main__":
    scene = json.loads(sys.stdin.readline())
    say(type="result", **solve(scene["dimension"], scene["query"], scene["tolerance"]))
