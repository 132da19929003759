"""Bugs planted in the Python kit and in Muratori's form, with what `check` must say of their cause: for solver_test.py."""
from solver_bugs import GUARD, NO_POINTS, SUPPORT

SAID = "    print(json.dumps(message), flush=True)"
SILENT = (SAID, '    if message["type"] in ("support", "result"): print(json.dumps(message), flush=True)')
COMBINE = "    return [sum(t * p[i] for t, p in zip(weights, points)) for i in range(len(points[0]))]"
SINGLE = [  # counts in single precision, a and b too
    ("import json\n", "import json, struct\ndef single(x): return struct.unpack('f', struct.pack('f', x))[0]\n"),
    ('        self.number, self.w, self.a, self.b = reply["vertex"], reply["w"], reply["a"], reply["b"]',
     '        self.number, self.a, self.b = reply["vertex"], [single(x) for x in reply["a"]], [single(x) for x in reply["b"]]\n        self.w = [single(x - y) for x, y in zip(self.a, self.b)]'),
    (COMBINE, "    return [single(sum(single(single(t) * p[i]) for t, p in zip(weights, points))) for i in range(len(points[0]))]"),
    ("1e-12 * scale", "1e-6 * scale"), ("tolerance * dot(v, v)", "1e-6 * dot(v, v)"),
]
WITNESSES = "witness_a=a, witness_b=b"
APART = "a, b = combine(weights, [x.a for x in simplex]), combine(weights, [x.b for x in simplex])"
DEEP = "witness_a=combine([1, depth / 2], [middle, normal])"
NEGATED = ("s=[w]; d=neg(w[0])", 's=[w]; say(type="simplex",vertices=[w[1]]); d=[-1,0,0]')

# name, "kit" or "muratori", scene, [(what is replaced, by what)...], the first finding's code, what its message says, and (after "not ") does not; further arguments
CAUSES = [
    ("first direction negated, and wrong", "muratori", "box-box-apart", [NEGATED, ("if dot(w[0],d)<0: return False", "return True")], "direction-away-from-origin", ["It is the first direction, negated", "d . w < 0 for the first support"], []),
    ("every simplex thrown away", "muratori", "boolean-miss-3d", [("s=[w]; d=neg(w[0])", 's=[w]; say(type="simplex",vertices=[w[1]]); d=neg(w[0])'), ("if dot(ab,ao)>0", "if dot(ab,ao)<0")], "wrong-region", ["no search begins anew so often", "not taken to begin again"], []),
    ("touching taken too coarsely", "kit", "3d-touch-sphere-face", [("length(v) <= 1e-12 * scale", "length(v) <= 1e-1 * scale")], "origin-not-enclosed", ["too coarse for this scene", "not face whose normal"], []),
    ("touching by an absolute tolerance, one vertex", "kit", "tiny-cubes", [("length(v) <= 1e-12 * scale", "length(v) <= 1e-6")], "origin-not-enclosed", ["A vertex encloses nothing in 3D", "too coarse for this scene, of lengths up to"], []),
    ("overlap claimed of a triangle", "kit", "box-box-apart", [("or len(simplex) == dimension + 1", "or len(simplex) == dimension")], "origin-not-enclosed", ["A triangle encloses nothing in 3D", "right in fewer dimensions", "not face whose normal"], []),
    ("a flat tetrahedron", "kit", "jolt-671", [("dot(v, v) - dot(v, w.w) <= tolerance * dot(v, v) or any", "any"), (GUARD, '        if dot(nearer, nearer) >= dot(v, v):\n            say(type="simplex", vertices=[x.number for x in [w] + simplex])\n            return simplex, [0.0] * dimension, weights\n')],
     "origin-not-enclosed", ["lie in one plane to rounding", "is no farther along its direction", "Stop there, before it is added", "not face whose normal"], []),
    ("a tolerance too coarse", "kit", "pair-sphere-sphere", [("tolerance * dot(v, v) or any", "0.01 * dot(v, v) or any")], "stopped-early", ["% of the distance: the usual cause is a stopping tolerance that is too coarse", "not how the simplex was reduced"], []),
    ("an absolute tolerance", "kit", "box3d-thin-gap", [("tolerance * dot(v, v) or any", "1e-4 or any")], "stopped-early", ["The usual cause is an absolute tolerance"], []),
    ("lengths compared", "kit", "box-box-apart", [("dot(v, v) - dot(v, w.w) <= tolerance * dot(v, v) or any", "dot(w.w, w.w) >= dot(v, v) or any")], "stopped-early", ["that is no reason to stop", "such as the length of w, "], []),
    ("the wrong sign in the test for a gap", "kit", "boolean-hit-3d", [(SUPPORT, SUPPORT + "\n        if dot(v, w.w) < 0: return simplex, v, weights")], "unjustified-separation", ["beyond the origin along its direction", "the wrong sign in the test whether the support passed the origin"], []),
    ("single precision, not said", "kit", "pair-sphere-sphere", SINGLE, "few-digits", ["run with --scalar float"], []),
    ("single precision, far out", "kit", "far-from-origin", SINGLE, "wrong-closest", ["from the world's origin, where single precision", "not weights that are not clamped"], ["--scalar", "float"]),
    ("the point of one vertex is another", "kit", "box-box-apart", [("closest=v)", "closest=v if len(simplex) > 1 else scaled(0.5, v))")], "wrong-closest", ["One vertex has no weights", "not weights that are not clamped"], []),
    ("a face test turned, where the whole holds the origin", "muratori", "box-box-deep", [("if dot(n,sub(s[k][0],a))>0: n=neg(n)", "if dot(n,sub(s[k][0],a))<0: n=neg(n)")], "any:wrong-region", ["The whole of it holds the origin: the bodies overlap, and the search is over", "not comes as near as"], []),
    ("towards a vertex only, and wrong", "kit", "box-box-apart", [(SUPPORT, "w = support(scaled(-1, simplex[0].w))")], "direction-not-perpendicular", ["The run goes wrong at step ", "not costs iterations"], []),
    ("a wrong distance, and nothing else", "kit", "box-box-apart", [SILENT, ("tolerance * dot(v, v) or any", "0.5 * dot(v, v) or any")], "wrong-distance", ["report the simplex after every step"], []),
    ("a squared distance, which names itself", "kit", "box-box-apart", [SILENT, ("signed_distance=distance, normal", "signed_distance=distance * distance, normal")], "wrong-distance", ["That is its square", "not report the simplex"], []),
    ("a wrong depth, and nothing of EPA", "kit", "box-box-deep", [('say(type="polytope", ', "dict("), ('say(type="face", ', "dict("), ("signed_distance=-depth", "signed_distance=-depth * 1.1")], "wrong-depth", ["report EPA's polytope and the faces chosen"], []),
    ("round and round, and nothing else", "muratori", "box-box-deep", [("def say(**m): print(json.dumps(m),flush=True)", "def say(**m):\n    if m['type'] != 'simplex': print(json.dumps(m),flush=True)"), ("if dot(ab,ao)>0", "if dot(ab,ao)<0")], "cycle",
     ["no stopping test would have been right to end it", "report the simplex after every step", "not Stop when"], []),
    ("v for a witness", "kit", "box-box-apart", [(WITNESSES, "witness_a=v, witness_b=[0.0] * dimension")], "wrong-witness", ["witness_a is v = ", "a point of A - B, and none of A"], []),
    ("one witness for both", "kit", "box-box-apart", [(WITNESSES, "witness_a=a, witness_b=a")], "wrong-witness", ["Both are the same point"], []),
    ("a vertex for a witness", "kit", "box-box-apart", [(WITNESSES, "witness_a=simplex[-1].a, witness_b=b")], "wrong-witness", ["witness_a is the point of A of vertex "], []),
    ("a vertex for both witnesses", "kit", "box-box-apart", [(WITNESSES, "witness_a=simplex[-1].a, witness_b=simplex[-1].b")], "wrong-witness", ["They are the two points of vertex "], []),
    ("weights in another order", "kit", "box-box-apart", [(APART, APART.replace("weights", "weights[1:] + weights[:1]"))], "wrong-witness", ["each belongs to another vertex"], []),
    ("no weights", "kit", "box-box-apart", [(APART, APART.replace("weights", "[1 / len(simplex)] * len(simplex)"))], "wrong-witness", ["They are the mean of the points of"], []),
    ("v for a witness when deep", "kit", "box-box-deep", [(DEEP, "witness_a=scaled(depth, normal)")], "wrong-witness", ["witness_a is v = "], []),
    ("horizon with shared edges", "kit", "box-box-deep", [("if ridges.count(r) == 1]", "]")], "open-polytope", ["cancelled by their opposite direction", "wound alike"], []),
    ("a long normal without a polytope", "kit", "box-box-deep", [('say(type="polytope", ', "dict("), ("normal=normal, distance=distance)", "normal=scaled(3, normal), distance=3 * distance)")], "wrong-face", ["with a normal of length 3: divide the normal by its length first", "not 000000"], []),
    ("the depth as a length", "kit", "box-box-deep", [("signed_distance=-depth", "signed_distance=depth")], "wrong-depth", ["signed_distance is given as 0.399317, above zero", "the right length with its sign turned", "not What is returned"], []),
    ("a simplex of vertices that are none, after the polytope", "kit", "box-box-deep", [('say(type="result", **solve(scene["dimension"], scene["query"], scene["tolerance"]))', 'answer = solve(scene["dimension"], scene["query"], scene["tolerance"])\n    say(type="simplex", vertices=[55])\n    say(type="result", **answer)')], "unknown-vertex", ["The simplex names vertex 55"], []),
    ("d . w <= 0 where < is due, of flat bodies", "muratori", "coplanar-triangles", [("if dot(w[0],d)<0: return False", "if dot(w[0],d)<=0: return False")], "unjustified-separation", ["they touch, which counts as overlapping", "d . w < 0 is due"], []),
    ("d . w <= 0 where < is due", "muratori", "3d-touch-edge-edge", [("if dot(w[0],d)<0: return False", "if dot(w[0],d)<=0: return False")], "unjustified-separation", ["they touch, which counts as overlapping", "d . w < 0 is due"], []),
    ("EPA goes on at the boundary, and ends", "kit", "2d-deep", [("if height - distance <= max(tolerance * height, rounding) or len(faces) > 600:", "if len(faces) > 9:"), ("if sees(w, f, rounding)]", "if dot(f[1], w.w) > f[2] + rounding] or [next(f for f in faces if f[0] is face)]"), NO_POINTS],
     "no-progress", ["It ended all the same, and with the right answer: here it merely costs", "not never end"], []),
    ("only the nearest face split", "kit", "box-box-deep", [("seen = [f for f in faces if sees(w, f, rounding)]", "seen = [f for f in faces if f[0] is face]")], "visible-face-kept", ["Only the face chosen was removed: look at all the others, too."], []),
    ("a polytope that never grows", "kit", "box-box-deep", [("faces = [f for f in faces if f not in seen] + [(f,) + p for f, p in zip(new, planes)]", "pass")], "cycle", ["beyond face ", "so there is more to come", "None was removed", "not Stop when"], []),
    ("the normal turned, deep", "kit", "box-box-deep", [("signed_distance=-depth, normal=normal", "signed_distance=-depth, normal=scaled(-1, normal)")], "flipped-normal", ["The usual cause is the normal of B - A"], []),
    ("v for the normal, apart", "kit", "box-box-apart", [("normal=scaled(-1 / distance, v)", "normal=scaled(1 / distance, v)")], "flipped-normal", ["v = a - b leads from body 1 to body 0; the normal is -v / |v|."], []),
    ("EPA's limit, and what follows", "kit", "spheres-concentric", [("or len(faces) > 600", "or len(faces) > 40"), (DEEP, "witness_a=combine([1, depth / 2.2], [middle, normal])")], "stopped-early", ["the face is not on the boundary"], []),
]
