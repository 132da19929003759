#!/usr/bin/python3
"""The solver protocol and the check: the starter kits are clean on the whole gallery; seeded bugs are named by their code."""
import copy
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent
KIT = ROOT / "debugger/solver/kits/gjk.py"
PROGRAM = os.path.abspath(sys.argv.pop(1))
SOURCE = KIT.read_text()

STOP = """        if dot(v, v) - dot(v, w.w) <= tolerance * dot(v, v) or any(w.w == x.w for x in simplex):
            return simplex, v, weights
"""
GUARD = """        if dot(nearer, nearer) >= dot(v, v):
            return simplex, v, weights  # rounding: no nearer part can be told
"""
FACES = "    faces = [(list(f),) +"
SUPPORT = "w = support(scaled(-1, v))"
KEPT = "simplex, v, weights = kept, nearer, weights_now"

# name, scene, [(what is replaced in the kit, by what)...], the code that must be the first finding (or among them, after "any:")
BUGS = [
    ("direction not negated", "box-box-apart", [(SUPPORT, "w = support(v)")], "direction-away-from-origin"),
    ("direction not negated, 2D", "2d-corner-to-edge", [(SUPPORT, "w = support(v)")], "direction-away-from-origin"),
    ("touching not accepted", "stacked-cubes", [("if length(v) <= 1e-12 * scale or", "if")], "zero-direction"),
    ("first direction zero", "box-box-apart", [("support([1.0] +", "support([0.0] +")], "zero-direction"),
    ("direction NaN", "box-box-apart", [(SUPPORT, 'w = support(scaled(float("nan"), v))')], "non-finite-direction"),
    ("direction infinite", "box-box-apart", [(SUPPORT, 'w = support([float("inf")] * dimension)')], "non-finite-direction"),
    ("towards a vertex only", "box-box-apart", [(SUPPORT, "w = support(scaled(-1, simplex[0].w))")], "direction-not-perpendicular"),
    ("stale direction", "box-box-deep", [(SUPPORT, "w = support(scaled(-1, simplex[-1].w))")], "any:direction-not-perpendicular"),
    ("numbers count from 1", "box-box-apart", [("vertices=[x.number for x in simplex]", "vertices=[x.number + 1 for x in simplex]")], "unknown-vertex"),
    ("face names an unknown vertex", "box-box-deep", [("vertices=[x.number for x in face]", "vertices=[99 for x in face]")], None),
    ("polytope names an unknown vertex", "box-box-deep", [("faces=[[x.number for x", "faces=[[x.number + 50 for x")], "unknown-vertex"),
    ("vertex twice", "box-box-apart", [("vertices=[x.number for x in simplex]", "vertices=[simplex[0].number] + [x.number for x in simplex]")], "duplicate-vertex"),
    ("simplex not reduced", "dolfinx-3653", [("kept, nearer, weights_now = nearest([w] + simplex)", "_, nearer, weights_now = nearest([w] + simplex); kept = [w] + simplex"),
                                             ("or len(simplex) == dimension + 1", "")], "simplex-too-large"),
    ("newest vertex lost", "2d-corner-to-edge", [(KEPT, "simplex, v, weights = (kept, nearer, weights_now) if len(simplex) < 2 else (simplex, v, weights)")], "any:wrong-region"),
    ("only the newest kept", "box-box-apart", [(KEPT, "simplex, v, weights = [w], w.w, [1.0]"), (GUARD, "")], "wrong-region"),
    ("only the newest kept, round and flat", "2d-ellipses-apart", [(KEPT, "simplex, v, weights = [w], w.w, [1.0]"), (GUARD, "")], "wrong-region"),
    ("oldest vertex dropped", "box-box-deep", [(KEPT, "simplex = kept[:-1] or kept; v = nearest(simplex)[1]; weights = nearest(simplex)[2]"), (GUARD, "")], "any:wrong-region"),
    ("edge kept for the triangle", "obb-shallow", [(KEPT, "simplex = kept[:2]; v = nearest(simplex)[1]; weights = nearest(simplex)[2]"), (GUARD, "")], "any:wrong-region"),
    ("no stopping test", "box-box-apart", [(STOP, ""), (GUARD, "")], "any:no-progress"),
    ("loops for ever", "box-box-apart", [(STOP, ""), (GUARD, "")], "any:cycle"),
    ("loops until the limit", "box-box-apart", [(STOP, ""), (GUARD, "")], "any:support-limit"),
    ("stops at the first edge", "box-box-deep", [("        " + SUPPORT, "        " + SUPPORT + "\n        if len(simplex) == 2: return simplex, v, weights")], "any:unjustified-separation"),
    ("stops too early", "box-box-apart", [("tolerance * dot(v, v) or any", "0.5 * dot(v, v) or any")], "stopped-early"),
    ("overlap claimed of a triangle", "box-box-apart", [("or len(simplex) == dimension + 1", "or len(simplex) == dimension")], "origin-not-enclosed"),
    ("overlap claimed of an edge, 2D", "2d-corner-to-edge", [("or len(simplex) == dimension + 1", "or len(simplex) == dimension")], "origin-not-enclosed"),
    ("a face forgotten", "box-box-deep", [("faces = [f for f in faces if f not in seen] +", "faces = [f for f in faces if f not in seen][1:] +")], "open-polytope"),
    ("an edge forgotten, 2D", "2d-deep", [("faces = [f for f in faces if f not in seen] +", "faces = [f for f in faces if f not in seen][1:] +")], "open-polytope"),
    ("horizon with shared edges", "box-box-deep", [("if ridges.count(r) == 1]", "]")], "open-polytope"),
    ("only the nearest face split", "box-box-deep", [("seen = [f for f in faces if dot(f[1], w.w) > f[2] + rounding]", "seen = [f for f in faces if f[0] is face]")], "visible-face-kept"),
    ("farthest face chosen", "box-box-deep", [("min(faces, key=lambda f: f[2])", "max(faces, key=lambda f: f[2])")], "not-closest-face"),
    ("farthest edge chosen, 2D", "2d-deep", [("min(faces, key=lambda f: f[2])", "max(faces, key=lambda f: f[2])")], "not-closest-face"),
    ("normals inwards", "box-box-deep", [("n = scaled((1 if dot", "n = scaled((-1 if dot")], "flipped-face-normal"),
    ("reported normal flipped", "box-box-deep", [("normal=normal, distance=distance)", "normal=scaled(-1, normal), distance=distance)")], "flipped-face-normal"),
    ("start without the origin", "ellipsoid-sphere-deep", [("    inside = combine(", "    points = [support(d) for d in ([1.0, 0.1, 0.2], [1.0, 1.0, 0.1], [0.2, 1.0, 1.0], [1.0, 0.3, -1.0])]\n    inside = combine(")], "any:origin-outside-polytope"),
    ("EPA stops at once", "obb-shallow", [("if height - distance <= max", "if True or height - distance <= max"), ("return height, normal, combine", "return distance, normal, combine")], "stopped-early"),
    ("depth off by a tenth", "box-box-deep", [("signed_distance=-depth", "signed_distance=-depth * 1.1")], "wrong-depth"),
    ("depth positive", "box-box-deep", [("signed_distance=-depth", "signed_distance=depth")], "any:wrong-depth"),
    ("normal flipped", "box-box-deep", [("signed_distance=-depth, normal=normal", "signed_distance=-depth, normal=scaled(-1, normal)")], "flipped-normal"),
    ("normal along z", "box-box-deep", [("signed_distance=-depth, normal=normal", "signed_distance=-depth, normal=[0.0, 0.0, 1.0]")], "wrong-normal"),
    ("normal not normalised", "box-box-apart", [("normal=scaled(-1 / distance, v)", "normal=scaled(-1, v)")], "wrong-normal"),
    ("normal flipped when apart", "box-box-apart", [("normal=scaled(-1 / distance, v)", "normal=scaled(1 / distance, v)")], "flipped-normal"),
    ("witnesses swapped", "box-box-apart", [("witness_a=a, witness_b=b", "witness_a=b, witness_b=a")], "wrong-witness"),
    ("witness of an old simplex", "box-box-deep", [("witness_a=combine([1, depth / 2], [middle, normal])", "witness_a=simplex[0].a")], "wrong-witness"),
    ("distance squared", "box-box-apart", [("signed_distance=distance, normal", "signed_distance=distance * distance, normal")], "wrong-distance"),
    ("yes for no", "boolean-miss-2d", [("dict(intersecting=distance == 0)", "dict(intersecting=True)")], "any:wrong-answer"),
    ("no for yes", "boolean-hit-3d", [("dict(intersecting=distance == 0)", "dict(intersecting=False)")], "any:wrong-answer"),
    ("crash", "box-box-deep", [(FACES, '    raise RuntimeError("oops")\n' + FACES)], "crash"),
    ("killed", "box-box-deep", [(FACES, "    import os; os.kill(os.getpid(), 11)\n" + FACES)], "crash"),
    ("hang", "box-box-deep", [(FACES, "    while True: pass\n" + FACES)], "timeout"),
    ("garbage", "box-box-deep", [(FACES, '    print("hello", flush=True)\n' + FACES)], "bad-message"),
    ("unknown message", "box-box-deep", [(FACES, '    say(type="simplx")\n' + FACES)], "bad-message"),
    ("half a line", "box-box-deep", [(FACES, '    sys.stdout.write("{"); sys.stdout.flush(); sys.exit(0)\n' + FACES)], "bad-message"),
    ("a line without end", "box-box-deep", [(FACES, '    sys.stdout.write("x" * 3000000); sys.stdout.flush()\n' + FACES)], "bad-message"),
    ("vector of the wrong size", "box-box-deep", [(FACES, "    support([1.0])\n" + FACES)], "bad-message"),
    ("no result", "box-box-deep", [('    say(type="result"', '    dict(type="result"')], "no-result"),
    ("crash after the result", "box-box-deep", [('    say(type="result"', '    import atexit, os; atexit.register(lambda: (sys.stdout.flush(), os.abort()))\n    say(type="result"')], "crash"),
    ("another result", "box-box-deep", [('    say(type="result"', '    import atexit; atexit.register(lambda: say(type="result", intersecting=False))\n    say(type="result"')], "bad-message"),
    ("output closed", "box-box-deep", [(FACES, "    import os; os.close(1); sys.exit(0)\n" + FACES)], "no-result"),
    ("flood of queries", "box-box-deep", [(FACES, "    import random\n    while True: support([random.random() for _ in range(dimension)])\n" + FACES)], "support-limit"),
]

# Recordings changed by hand: (scene, what is changed, the code)
def at(recording, kind, nth=0):
    return [e for e in recording["events"] if e["kind"] == kind][nth]


def negated(v):
    return [-x for x in v]


EDITS = [
    ("box-box-deep", lambda r: at(r, "support_queried", 1).update(direction=[0, 0, 0]), "zero-direction"),
    ("box-box-deep", lambda r: at(r, "support_queried", 1).update(direction=[None, 0, 0]), "non-finite-direction"),
    ("box-box-deep", lambda r: at(r, "support_queried", 1).update(direction=negated(at(r, "support_queried", 1)["direction"])), "direction-away-from-origin"),
    ("box-box-deep", lambda r: at(r, "simplex_reduced", 1).update(region=[77]), "unknown-vertex"),
    ("box-box-deep", lambda r: at(r, "face_chosen").update(face=at(r, "polytope_seeded")["faces"][-1]["face"] if at(r, "face_chosen")["face"] == 0 else 0), "not-closest-face"),
    ("box-box-deep", lambda r: at(r, "polytope_seeded")["faces"][0].update(normal=negated(at(r, "polytope_seeded")["faces"][0]["normal"])), "flipped-face-normal"),
    ("box-box-deep", lambda r: at(r, "polytope_seeded")["faces"].pop(), "open-polytope"),
    ("box-box-deep", lambda r: at(r, "polytope_grown")["removed"].pop(), "any:visible-face-kept"),
    ("box-box-deep", lambda r: at(r, "polytope_grown")["added"].pop(), "open-polytope"),
    # A face stays that an older vertex sees, not the one that came.
    ("box-box-deep", lambda r: (at(r, "polytope_grown")["removed"].pop(), at(r, "polytope_grown").update(vertex=0)), "any:non-convex-polytope"),
    ("box-box-deep", lambda r: r["result"].update(normal=negated(r["result"]["normal"])), "any:flipped-normal"),
    ("box-box-deep", lambda r: r["result"].update(signed_distance=-1.0), "any:wrong-depth"),
    ("box-box-deep", lambda r: r["result"].update(intersecting=False), "any:wrong-answer"),
    ("box-box-apart", lambda r: r["result"].update(signed_distance=0.1), "any:wrong-distance"),
    ("box-box-apart", lambda r: r["result"].update(witness_a=[0, 0, 9]), "wrong-witness"),
    ("pair-hull-hull", lambda r: r["events"].__delitem__(slice(3, len(r["events"]) - 1)), "stopped-early"),
    ("2d-deep", lambda r: at(r, "simplex_reduced").update(region=[], barycentric=[]), "wrong-region"),
    # Numbers no scene has must not make everything else look small.
    ("two-unit-cubes", lambda r: at(r, "support_queried", 1)["w"].__setitem__(0, 1e155), "wrong-support"),
    ("two-unit-cubes", lambda r: at(r, "support_queried", 1)["b"].__setitem__(2, 1e155), "wrong-support"),
    ("box-box-apart", lambda r: r["result"].update(witness_a=[0, 0, 9], witness_b=None), "wrong-witness"),
    ("box-box-deep", lambda r: at(r, "polytope_seeded")["faces"][0].update(normal=[2 * x for x in at(r, "polytope_seeded")["faces"][0]["normal"]]), "wrong-face"),
    ("box-box-deep", lambda r: at(r, "polytope_grown")["added"][0].update(normal=[0, 0, 0]), "wrong-face"),
    ("stacked-cubes", lambda r: at(r, "polytope_seeded")["faces"][1].update(vertices=[at(r, "polytope_seeded")["faces"][1]["vertices"][0]] * 3), "zero-area-face"),
    # Lists and counts that contradict the rest.
    ("box-box-deep", lambda r: at(r, "simplex_reduced", 2)["before"].reverse(), "inconsistent"),
    ("box-box-deep", lambda r: at(r, "polytope_seeded")["vertices"].pop(), "inconsistent"),
    ("box-box-deep", lambda r: at(r, "polytope_seeded")["faces"][0]["vertices"].reverse(), "inconsistent"),
    ("box-box-deep", lambda r: at(r, "polytope_grown")["horizon"].reverse(), "inconsistent"),
    ("box-box-deep", lambda r: at(r, "polytope_grown").update(vertex=1), "any:inconsistent"),
    ("box-box-deep", lambda r: at(r, "epa_ended").update(face=max(f["face"] for f in at(r, "polytope_grown")["added"])), "inconsistent"),
    ("box-box-deep", lambda r: r["result"].update(status="iteration_limit"), "inconsistent"),
    ("box-box-deep", lambda r: r["result"].update(iterations=3), "inconsistent"),
    ("box-box-deep", lambda r: r["result"].update(support_calls=3), "inconsistent"),
    ("box-box-deep", lambda r: r["result"].update(support_calls=99), "inconsistent"),
    ("box-box-deep", lambda r: at(r, "support_queried", 3).update(iteration=9), "inconsistent"),
    ("box-box-deep", lambda r: at(r, "support_queried", 7).update(vertex=99), "inconsistent"),
    ("box-box-apart", lambda r: at(r, "simplex_reduced", 1).update(iteration=2), "any:inconsistent"),
    ("box-box-apart", lambda r: at(r, "support_queried", 1)["direction"].__setitem__(0, at(r, "support_queried", 1)["direction"][0] * 1.0001), "inconsistent"),
    ("3d-touch-edge-edge", lambda r: r["result"].update(intersecting=False), "inconsistent"),
    ("size-ratio-1e4", lambda r: r["result"]["witness_a"].__setitem__(2, r["result"]["witness_a"][2] + 1e-6), "inconsistent"),
    ("cast-many-bodies", lambda r: at(r, "cast_began")["pairs"].pop(), "any:inconsistent"),
    ("cast-many-bodies", lambda r: r["result"].update(iterations=9), "inconsistent"),
    ("box-box-deep", lambda r: at(r, "gjk_ended").update(status="stalled"), "inconsistent"),
    ("box-box-apart", lambda r: at(r, "gjk_ended").update(status="iteration_limit"), "inconsistent"),
    ("box-box-apart", lambda r: at(r, "gjk_ended").update(upper_bound=9.0), "inconsistent"),
    ("box-box-apart", lambda r: at(r, "simplex_reduced", 1).update(lower_bound=-5.0), "inconsistent"),
    ("box-box-apart", lambda r: r["result"].update(upper_bound=9.0), "inconsistent"),
    ("box-box-deep", lambda r: r["result"].update(lower_bound=-9.0), "inconsistent"),
    ("box-box-deep", lambda r: at(r, "polytope_grown").update(upper_bound=9.0), "inconsistent"),
    ("box-box-deep", lambda r: at(r, "epa_ended").update(face=999), "wrong-face"),
    ("coplanar-triangles", lambda r: at(r, "epa_ended").update(face=0), "inconsistent"),
    ("2d-deep", lambda r: at(r, "polytope_grown")["added"][1].update(face=9), "inconsistent"),
    ("2d-deep", lambda r: at(r, "polytope_grown")["horizon"].clear(), "inconsistent"),
    ("1d-overlap", lambda r: at(r, "polytope_seeded")["faces"][0]["vertices"].clear(), "inconsistent"),
    ("mpr-2d-deep", lambda r: at(r, "portal_found")["vertices"].pop(), "inconsistent"),
    ("closed-form-capsules", lambda r: at(r, "closed_form_began")["edge_b"].__setitem__(0, 1.0), "inconsistent"),
    ("closed-form-capsules", lambda r: at(r, "lines_solved").update(s=0.5), "inconsistent"),
    ("projections-cylinders", lambda r: at(r, "points_projected").update(upper_bound=2.0), "wrong-bounds"),
    ("projections-cylinders", lambda r: at(r, "projections_ended").update(lower_bound=0.01), "wrong-bounds"),
    ("projections-cylinders", lambda r: [p.__setitem__(2, p[2] + 0.1) for p in (at(r, "points_projected")["a"], at(r, "points_projected")["closest"])], "inconsistent"),
    ("box-contact-edge", lambda r: r["result"]["contacts"][0]["point_a"].__setitem__(0, 0.3), "wrong-contact"),
    ("box-contact-edge", lambda r: r["result"]["contacts"][0].update(depth=0.5), "wrong-contact"),
    ("box-contact-edge", lambda r: r["result"]["contacts"].clear(), "wrong-contact"),
    ("box-contact-patch", lambda r: [p.__setitem__(0, p[0] + 9) for c in r["result"]["contacts"][:1] for p in (c["point_a"], c["point_b"])], "wrong-contact"),
    ("level-mesh", lambda r: r["result"].update(witness_a=[0, 0, 9]), "wrong-witness"),
    ("level-mesh", lambda r: r["result"].update(witness_a=[0, 0, 9], witness_b=[0, -0.1, 9]), "wrong-witness"),
    ("level-mesh", lambda r: r["result"].update(normal=[0, 1, 0]), "any:flipped-normal"),
    ("level-mesh", lambda r: r["result"].update(normal=[1, 0, 0]), "any:wrong-normal"),
    ("sim-falling-box", lambda r: at(r, "impulse_applied").update(normal=negated(at(r, "impulse_applied")["normal"])), "any:flipped-normal"),
    ("sim-falling-box", lambda r: at(r, "contact_found").update(point=[99, 0]), "any:wrong-contact"),
    ("sim-falling-box", lambda r: at(r, "contact_found").update(time=99), "any:wrong-time"),
    ("box-box-apart", lambda r: r["events"].append({"kind": "cast_ended", "iteration": 0, "status": "miss", "time": 1, "pair": []}), "any:incomplete-trace"),
    ("box-box-apart", lambda r: r["events"].append({"kind": "state", "time": 0, "bodies": [], "energy": 0, "momentum": [0, 0, 0]}), "any:wrong-state"),
    # More or less than was asked for.
    ("two-unit-cubes", lambda r: r["scene"].update(query="intersect"), "any:inconsistent"),
    ("two-unit-cubes", lambda r: r["result"].pop("signed_distance"), "any:inconsistent"),
    ("two-unit-cubes", lambda r: r["result"].pop("witness_b"), "inconsistent"),
    ("two-unit-cubes", lambda r: r["result"].pop("normal"), "inconsistent"),
    ("two-unit-cubes", lambda r: r["result"].pop("lower_bound"), "inconsistent"),
    ("box-contact-edge", lambda r: r["result"].pop("contacts"), "inconsistent"),
    # Between and at the responses of a cast.
    ("cast-bounce", lambda r: at(r, "state", 1)["bodies"][0]["position"].__setitem__(0, 1.0), "wrong-state"),
    ("cast-bounce", lambda r: at(r, "state")["bodies"][0]["velocity"].__setitem__(1, 3.0), "wrong-state"),
    ("cast-bounce", lambda r: at(r, "state")["bodies"][1].update(orientation=[0, 1, 0, 0]), "wrong-state"),
    ("cast-bounce", lambda r: at(r, "state")["bodies"][1].update(orientation=[2, 0, 0, 0]), "wrong-state"),
    ("cast-bounce", lambda r: at(r, "state")["bodies"][0].update(angular_velocity=[1]), "wrong-state"),
    ("cast-bounce", lambda r: at(r, "impulse_applied", 1)["velocities_before"][0].__setitem__(1, 4.0), "wrong-state"),
    ("cast-bounce", lambda r: at(r, "impulse_applied", 1)["impulse"].__setitem__(0, 1.0), "wrong-state"),
    ("cast-bounce", lambda r: r["result"]["bodies"][2].update(orientation=[0, 0, 0, 1]), "wrong-state"),
]


# What only a later step contradicts.
LATER = [
    ("projections-cylinders", lambda r: at(r, "projections_began")["point"].__setitem__(2, 0.5), 1),
    ("projections-cylinders", lambda r: at(r, "point_predicted")["point"].__setitem__(2, 0.5), 3),
    ("box-box-deep", lambda r: at(r, "gjk_began").update(direction=[1, 2, 3]), 1),
    ("sat-box-box", lambda r: at(r, "sat_began").update(faces_a=2), 6),
    ("sat-box-box", lambda r: at(r, "sat_began").update(faces_b=9), 29),
]


def check_file(recording):
    with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
        json.dump(recording, file)
        file.flush()
        result = subprocess.run([PROGRAM, "check", file.name, "--json"], capture_output=True, text=True)
    return result.returncode, json.loads(result.stdout)["findings"] if result.stdout else result.stderr


def moves(scene):
    """A solver answers scenes that do not move."""
    return any(f'"query": "{query}"' in scene.read_text() for query in ("cast", "simulate"))


class Solver(unittest.TestCase):
    def run_kit(self, scene, command, *more):
        result = subprocess.run([PROGRAM, "run", str(scene), "--name", "gjk", "--exec", command, "--json", *more], capture_output=True, text=True)
        self.assertIn(result.returncode, (0, 1), result.stderr)
        findings = json.loads(result.stdout)["findings"]
        self.assertEqual(result.returncode, 1 if findings else 0)
        return findings

    def expect(self, findings, code, name):
        codes = [f["code"] for f in findings]
        if code is None:
            return
        self.assertTrue(findings, f"{name}: not found")
        if code.startswith("any:"):
            self.assertIn(code[4:], codes, name)
        else:
            self.assertEqual(codes[0], code, f"{name}: {codes}")
        self.assertEqual([f["step"] for f in findings], sorted(f["step"] for f in findings))
        for f in findings:
            self.assertGreater(len(f["message"]), 20)

    def clean_on_the_gallery(self, command, stride=1):
        scenes = [s for s in sorted((ROOT / "recordings/gallery").glob("*.scene.json")) if '"mesh"' not in s.read_text() and not moves(s)]
        self.assertGreater(len(scenes), 100)
        for scene in scenes[:: stride * (10 if "GJKDBG_PAIRS" in os.environ else 1)]:
            self.assertEqual(self.run_kit(scene, command), [], scene.name)

    def test_python_kit_is_clean_on_the_gallery(self):
        self.clean_on_the_gallery(f"/usr/bin/python3 {KIT}")

    def test_directions_of_any_length(self):
        """Squares of these overflow or vanish."""
        with tempfile.TemporaryDirectory() as folder:
            for factor in ("1e-200", "1e200"):
                path = pathlib.Path(folder, "long.py")
                path.write_text(SOURCE.replace(SUPPORT, f"w = support(scaled(-{factor} / length(v), v))", 1))
                with self.subTest(factor):
                    self.clean_on_the_gallery(f"/usr/bin/python3 {path}", stride=4)

    def test_the_last_line_needs_no_end(self):
        scene = ROOT / "recordings/gallery/2d-intersect-only.scene.json"
        answer = json.loads(subprocess.run([PROGRAM, "dump", str(scene)], capture_output=True, text=True).stdout)["result"]["intersecting"]
        script = "read line; echo '{\"type\":\"support\",\"direction\":[1,0]}'; read line; printf '{\"type\":\"result\",\"intersecting\":%s}'" % json.dumps(answer)
        codes = [f["code"] for f in self.run_kit(scene, script)]
        self.assertNotIn("bad-message", codes)
        self.assertNotIn("no-result", codes)

    def test_variants_of_a_right_solver_are_clean(self):
        """Newest vertex last, directions normalised, nothing reported but the answer."""
        variants = [("vertices=[x.number for x in simplex]", "vertices=[x.number for x in reversed(simplex)]"),
                    (SUPPORT, "w = support(scaled(-1 / length(v), v))"),
                    ("    print(json.dumps(message), flush=True)", '    if message["type"] in ("support", "result"): print(json.dumps(message), flush=True)')]
        with tempfile.TemporaryDirectory() as folder:
            for i, (old, new) in enumerate(variants):
                self.assertIn(old, SOURCE)
                path = pathlib.Path(folder, f"variant{i}.py")
                path.write_text(SOURCE.replace(old, new, 1))
                with self.subTest(new):
                    self.clean_on_the_gallery(f"/usr/bin/python3 {path}")

    def test_muratoris_form_is_clean_on_the_gallery(self):
        scenes = [s for s in sorted((ROOT / "recordings/gallery").glob("*.scene.json")) if '"dimension": 3' in s.read_text() and '"mesh"' not in s.read_text() and not moves(s)]
        self.assertGreater(len(scenes), 80)
        for scene in scenes[:: 10 if "GJKDBG_PAIRS" in os.environ else 1]:
            self.assertEqual(self.run_kit(scene, f"/usr/bin/python3 {ROOT / 'tests/muratori_solver.py'}"), [], scene.name)

    def test_cpp_kit_is_clean_on_the_gallery(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run(["c++", "-std=c++17", "-O1", "-Wall", "-Wextra", "-Werror", str(KIT.parent / "gjk.cpp"), "-o", folder + "/gjk"], check=True)
            self.clean_on_the_gallery(folder + "/gjk")

    @unittest.skipUnless(shutil.which("node"), "no node here")
    def test_javascript_kit_is_clean_on_the_gallery(self):
        self.clean_on_the_gallery(f"node {KIT.parent / 'gjk.js'}")

    @unittest.skipUnless(shutil.which("javac"), "no JDK here")
    def test_java_kit_is_clean_on_the_gallery(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run(["javac", "-d", folder, str(KIT.parent / "Gjk.java")], check=True)
            self.clean_on_the_gallery(f"java -XX:TieredStopAtLevel=1 -cp {folder} Gjk", stride=4)

    def test_seeded_bugs_are_named(self):
        self.assertGreaterEqual(len(BUGS), 40)
        with tempfile.TemporaryDirectory() as folder:
            for name, scene, replacements, code in BUGS:
                source = SOURCE
                for old, new in replacements:
                    self.assertIn(old, source, name)
                    source = source.replace(old, new, 1)
                path = pathlib.Path(folder, "bug.py")
                path.write_text(source)
                with self.subTest(name):
                    self.expect(self.run_kit(scene, f"/usr/bin/python3 {path} 2>/dev/null", "--timeout", "1.5"), code, name)

    def test_what_is_said_without_a_support(self):
        """A right answer at once has no findings; vertices nobody gave out are named."""
        result = '{"type":"result","intersecting":true}'
        simplex, support, box = '{"type":"simplex","vertices":[7]}', '{"type":"support","direction":[1,0,0]}', "box-box-deep"
        far, apart = '{"type":"support","direction":[0,0,1]}', '{"type":"result","intersecting":false}'
        known, no_point = '{"type":"simplex","vertices":[0],"closest":[NaN,0,0]}', '{"type":"face","vertices":[0,0,0],"distance":"x"}'
        for lines, code in [((result,), None), ((simplex, result), "unknown-vertex"),
                            ((support, simplex, support, simplex, support, result), "unknown-vertex"),
                            ((support, known, result), "wrong-closest"), ((support, no_point, result), "bad-message"),
                            ((support, '{"type":"result","intersecting":true,"signed_distance":NaN}'), "bad-message"),
                            ((support, '{"type":"result","intersecting":true,"normal":[NaN,0,0]}'), "bad-message"),
                            ((far, apart), "unjustified-separation"),
                            ((support, '{"type":"face","vertices":[0,1,2],"normal":[1,0,0],"distance":1}', result), "unknown-vertex"),
                            ((support, '{"type":"face","vertices":[0],"normal":[1,0,0],"distance":1}', result), "bad-message"),
                            ((support, '{"type":"polytope","faces":[[0,0]]}', result), "bad-message")]:
            findings = self.run_kit(box, "cat >/dev/null & printf '%s\\n' " + " ".join(f"'{line}'" for line in lines))
            with self.subTest(lines):
                self.assertEqual([f["code"] for f in findings][:1], [code] if code else [])

    def test_a_right_guess_is_no_proof(self):
        support, apart = '{"type":"support","direction":[0,0,1]}', '{"type":"result","intersecting":false}'
        findings = self.run_kit("box-box-apart", f"cat >/dev/null & printf '%s\\n' '{support}' '{apart}'")
        self.assertEqual([f["code"] for f in findings], ["unjustified-separation"])
        self.assertEqual(self.run_kit("box-box-apart", f"cat >/dev/null & printf '%s\\n' '{apart}'"), [])

    def test_edited_recordings_are_named(self):
        for scene, edit, step in LATER:
            recording = json.loads(subprocess.run([PROGRAM, "dump", scene], capture_output=True, text=True).stdout)
            edit(recording)
            self.assertEqual([(f["code"], f["step"], f["severity"]) for f in check_file(recording)[1]], [("inconsistent", step, "warning")])
        for scene, edit, code in EDITS:
            recording = json.loads(subprocess.run([PROGRAM, "dump", scene], capture_output=True, text=True).stdout)
            self.assertEqual(check_file(recording), (0, []), scene)
            changed = copy.deepcopy(recording)
            edit(changed)
            status, findings = check_file(changed)
            with self.subTest(code):
                self.assertEqual(status, 1, findings)
                self.expect(findings, code, code)
                # Named at its step: the event that was changed.
                same_length = len(changed["events"]) == len(recording["events"])
                steps = [i for i, (x, y) in enumerate(zip(changed["events"], recording["events"])) if x != y]
                found = next(f for f in findings if f["code"] == code.removeprefix("any:"))
                if steps and same_length:
                    self.assertEqual(found["step"], steps[0])

    def test_what_was_recorded_before_a_crash_is_kept(self):
        with tempfile.TemporaryDirectory() as folder:
            path, out = pathlib.Path(folder, "bug.py"), pathlib.Path(folder, "out.json")
            path.write_text(SOURCE.replace(FACES, "    raise SystemExit(3)\n" + FACES))
            self.run_kit("box-box-deep", f"/usr/bin/python3 {path}", "-o", str(out))
            recording = json.loads(out.read_text())
            self.assertGreater(len(recording["events"]), 5)
            self.assertEqual((recording["result"]["status"], recording["result"]["intersecting"]), ("aborted", None))
            status, findings = check_file(recording)
            self.assertEqual([f["code"] for f in findings], ["crash"])
            self.assertIn("exit status 3", findings[0]["message"])

    def test_the_whole_process_group_is_killed(self):
        with tempfile.TemporaryDirectory() as folder:
            mark = pathlib.Path(folder, "alive")
            # A child that would outlive the solver.
            findings = self.run_kit("box-box-deep", f"(sleep 3; touch {mark}) & sleep 60", "--timeout", "0.5")
            self.assertEqual([f["code"] for f in findings], ["timeout"])
            time.sleep(3.5)
            self.assertFalse(mark.exists())

    def test_sweep(self):
        clean = subprocess.run([PROGRAM, "sweep", "--exec", f"/usr/bin/python3 {KIT}", "--dimension", "2", "--random", "20"], capture_output=True, text=True)
        self.assertEqual(clean.returncode, 0, clean.stdout)
        self.assertRegex(clean.stdout, r"\d+ scenes clean, 0 not")
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "bug.py")
            path.write_text(SOURCE.replace(SUPPORT, "w = support(v)"))
            failing = pathlib.Path(folder, "failing")
            result = subprocess.run([PROGRAM, "sweep", "--exec", f"/usr/bin/python3 {path}", "--dimension", "2", "--random", "3", "-o", str(failing)], capture_output=True, text=True)
            self.assertEqual(result.returncode, 1)
            saved = sorted(failing.glob("*.scene.json"))
            self.assertGreater(len(saved), 3)
            self.assertTrue(self.run_kit(saved[0], f"/usr/bin/python3 {path}"))

    def test_a_program_that_is_not_there(self):
        findings = self.run_kit("box-box-deep", "/nonexistent/program 2>/dev/null")
        self.assertEqual([f["code"] for f in findings], ["crash"])


unittest.main()
