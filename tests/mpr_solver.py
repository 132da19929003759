#!/usr/bin/env python3
"""MPR in 3D after Snethen's description (Game Programming Gems 7), as a student would write it, each portal told as a simplex. A portal moves outwards along the origin's ray: by
GJK's rules its regions and directions would be wrong. With --method mpr gjkdbg must have nothing to say against it."""
import json, sys


def say(**message):
    print(json.dumps(message), flush=True)


def dot(a, b): return sum(x * y for x, y in zip(a, b))
def sub(a, b): return [x - y for x, y in zip(a, b)]
def scaled(t, a): return [t * x for x in a]
def cross(a, b): return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
def length(a): return dot(a, a) ** 0.5


class Apart(Exception):
    pass


class Vertex:
    def __init__(self, d, proves=True):
        say(type="support", direction=d)
        reply = json.loads(sys.stdin.readline())
        self.number, self.w = reply["vertex"], reply["w"]
        if proves and dot(self.w, d) < 0:
            raise Apart


def first_portal(inner):
    """Three vertices that the ray from the inner point through the origin passes between; None where one lies on the ray."""
    p = Vertex(scaled(-1, inner))
    d = cross(p.w, inner)
    if length(d) <= 1e-12 * length(p.w) * length(inner):
        return None
    q = Vertex(d)
    while True:
        d = cross(sub(p.w, inner), sub(q.w, inner))
        if dot(d, inner) > 0:
            p, q, d = q, p, scaled(-1, d)
        r = Vertex(d)
        if dot(cross(p.w, r.w), inner) < 0:
            q = r
        elif dot(cross(r.w, q.w), inner) < 0:
            p = r
        else:
            return [p, q, r]


def solve():
    around = [Vertex([sign * (k == axis) for k in range(3)], False).w for axis in range(3) for sign in (1.0, -1.0)]
    inner = [sum(w[k] for w in around) / 6 for k in range(3)]
    if length(inner) < 1e-9:
        inner = [1e-6, 2e-6, 3e-6]
    portal = first_portal(inner)
    if portal is None:
        return None
    for _ in range(300):
        p, q, r = portal
        n = cross(sub(q.w, p.w), sub(r.w, p.w))
        n = scaled((1 if dot(n, sub(p.w, inner)) >= 0 else -1) / length(n), n)
        say(type="simplex", vertices=[x.number for x in portal], direction=n)
        w = Vertex(n)
        if dot(n, sub(w.w, p.w)) <= 1e-9 * (1 + length(w.w)):
            return n, dot(n, w.w)
        plane = cross(w.w, inner)
        if dot(p.w, plane) > 0:
            portal = [w, q, r] if dot(q.w, plane) > 0 else [p, q, w]
        else:
            portal = [p, w, r] if dot(r.w, plane) > 0 else [w, q, r]
    return None


json.loads(sys.stdin.readline())
try:
    way_out = solve()
    say(type="result", intersecting=True, **({"normal": way_out[0], "signed_distance": -way_out[1]} if way_out else {}))
except Apart:
    say(type="result", intersecting=False)
