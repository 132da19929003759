#!/usr/bin/python3
"""The solver protocol and the check: the starter kits are clean on the whole gallery; seeded bugs are named by their code."""
import copy
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

from solver_bugs import BUGS, EDITS, FACES, LATER, SUPPORT, at
from solver_causes import CAUSES, NEGATED, SINGLE
from solver_runs import RUNS

ROOT = pathlib.Path(__file__).resolve().parent.parent
KIT = ROOT / "debugger/solver/kits/gjk.py"
MURATORI = ROOT / "tests/muratori_solver.py"
MPR = ROOT / "tests/mpr_solver.py"
PROGRAM = os.path.abspath(sys.argv.pop(1))
SOURCE = KIT.read_text()

# Leaks are looked for in every sweep and with every seeded bug; in the check of hundreds of edited recordings they would take half of the time.
NO_LEAKS = {"ASAN_OPTIONS": "detect_leaks=0", **os.environ}


def check_file(recording):
    with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
        json.dump(recording, file)
        file.flush()
        result = subprocess.run([PROGRAM, "check", file.name, "--json"], capture_output=True, text=True, env=NO_LEAKS)
    return result.returncode, json.loads(result.stdout)["findings"] if result.stdout else result.stderr


def moves(scene):
    """A solver answers scenes that do not move."""
    return any(f'"query": "{query}"' in scene.read_text() for query in ("cast", "simulate"))


class Solver(unittest.TestCase):
    def run_kit(self, scene, command, *more):
        result = subprocess.run([PROGRAM, "run", str(scene), *(() if "--method" in more else ("--name", "gjk")), "--exec", command, "--json", *more], capture_output=True, text=True)
        self.assertIn(result.returncode, (0, 1), result.stderr)
        findings = json.loads(result.stdout)["findings"]
        self.assertEqual(result.returncode, 1 if findings else 0)
        return findings

    def recorded(self, scene, lines):
        """The supports that gjkdbg gives to these messages."""
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "recording.json")
            subprocess.run([PROGRAM, "run", scene, "--exec", f"cat >/dev/null & printf '%s\\n' {lines}", "-o", str(path)], capture_output=True)
            return [e for e in json.loads(path.read_text())["events"] if e["kind"] == "support_queried"]

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

    def clean_on_the_gallery(self, command, stride=1, space_only=False, more=(), without=(), first=0):
        scenes = [s for s in sorted((ROOT / "recordings/gallery").glob("*.scene.json")) if '"mesh"' not in s.read_text() and not moves(s)]
        if space_only:
            scenes = [s for s in scenes if '"dimension": 3' in s.read_text()]
        self.assertGreater(len(scenes), 80 if space_only else 100)
        if "LONG" in os.environ:
            stride, first = 1, 0
        chosen = [s for s in scenes[first :: stride * (5 if "GJKDBG_PAIRS" in os.environ else 1)] if s.name.split(".")[0] not in without]
        result = subprocess.run([PROGRAM, "sweep", *chosen, "--exec", command, *more], capture_output=True, text=True)
        self.assertEqual((result.returncode, result.stdout, result.stderr), (0, f"\n{len(chosen)} scenes clean, 0 not\n", ""))

    def test_python_kit_is_clean_on_the_gallery(self):
        self.clean_on_the_gallery(f"/usr/bin/python3 {KIT}")

    def test_python_kit_does_the_same_every_time(self):
        """Where many faces meet, the order of a set's members would tell, and that is another in every run."""
        with tempfile.TemporaryDirectory() as folder:
            runs = []
            for i in range(3):
                path = pathlib.Path(folder, f"{i}.json")
                subprocess.run([PROGRAM, "run", "spheres-deep", "--exec", f"/usr/bin/python3 {KIT}", "-o", str(path)], capture_output=True)
                runs.append(path.read_text())
            self.assertEqual(runs[1:], runs[:1] * 2)

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
        """Newest vertex last, directions normalised, nothing reported but the answer: each on its third of the gallery."""
        variants = [("vertices=[x.number for x in simplex]", "vertices=[x.number for x in reversed(simplex)]"),
                    (SUPPORT, "w = support(scaled(-1 / length(v), v))"),
                    ("    print(json.dumps(message), flush=True)", '    if message["type"] in ("support", "result"): print(json.dumps(message), flush=True)')]
        with tempfile.TemporaryDirectory() as folder:
            for i, (old, new) in enumerate(variants):
                self.assertIn(old, SOURCE)
                path = pathlib.Path(folder, f"variant{i}.py")
                path.write_text(SOURCE.replace(old, new, 1))
                with self.subTest(new):
                    self.clean_on_the_gallery(f"/usr/bin/python3 {path}", stride=len(variants), first=i)

    def test_what_a_search_begins_with_is_its_own_affair(self):
        """Supports along all axes are tried, and the nearest one is the start."""
        first = "    simplex = [support([1.0] + [0.0] * (dimension - 1))]\n"
        tried = "    tried = [support([sign * float(i == k) for i in range(dimension)]) for k in range(dimension) for sign in (1, -1)]\n    simplex = [min(tried, key=lambda x: dot(x.w, x.w))]\n"
        self.assertIn(first, SOURCE)
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "tries.py")
            path.write_text(SOURCE.replace(first, tried, 1))
            self.clean_on_the_gallery(f"/usr/bin/python3 {path}", stride=2)

    def test_who_searches_twice_or_asks_ahead_is_judged_by_what_comes_of_it(self):
        """Yes or no first, then anew for the distance; and EPA that asks every plane's support as the plane is made. Of collinear segments the second search
        begins where the first one ended, and asks the same once more: that is no progress."""
        planes = "        planes = [plane(f, inside) for f in new]\n"
        anew = next(line for line in SOURCE.splitlines(True) if "= gjk(dimension" in line)
        self.assertIn(planes, SOURCE)
        for old, new in ((anew, "    gjk(dimension, max(tolerance, 1e-12))\n" + anew), (planes, planes + "        for n in dict.fromkeys(tuple(p[0]) for p in planes):\n            support(n)\n")):
            with self.subTest(new), tempfile.TemporaryDirectory() as folder:
                path = pathlib.Path(folder, "twice.py")
                path.write_text(SOURCE.replace(old, new, 1))
                self.clean_on_the_gallery(f"/usr/bin/python3 {path}", stride=3, more=("--max-supports", "5000"), without=("collinear-segments",))

    def test_numbers_of_six_digits_are_called_that(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "short.py")
            path.write_text(SOURCE.replace("print(json.dumps(message), flush=True)", "print(json.dumps(json.loads(json.dumps(message), parse_float=lambda x: float('%.6g' % float(x)))), flush=True)", 1))
            self.assertEqual([f["code"] for f in self.run_kit("box-box-apart", f"/usr/bin/python3 {path}")][:1], ["few-digits"])
            self.assertEqual(self.run_kit("box-box-apart", f"/usr/bin/python3 {path}", "--scalar", "float"), [])

    def test_what_is_returned_is_what_was_found(self):
        """A little off, where bounds of round bodies may be farther apart."""
        said = "    print(json.dumps(message), flush=True)"
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "off.py")
            path.write_text(SOURCE.replace(said, "    if message.get('signed_distance'):\n        message['signed_distance'] *= 1.0005\n" + said, 1))
            for scene, code in (("cylinder-cuboid", "wrong-depth"), ("cone-box-apex", "wrong-depth"), ("pair-capsule-cone", "wrong-distance"), ("2d-ellipses-apart", "wrong-distance")):
                self.assertEqual([f["code"] for f in self.run_kit(scene, f"/usr/bin/python3 {path}")][:1], [code], scene)

    def test_no_more_supports_than_allowed(self):
        with tempfile.TemporaryDirectory() as folder:
            recording = pathlib.Path(folder, "r.json")
            subprocess.run([PROGRAM, "run", "box-box-deep", "--exec", f"/usr/bin/python3 {KIT}", "--max-supports", "3", "-o", str(recording)], capture_output=True)
            self.assertEqual(json.loads(recording.read_text())["result"]["support_calls"], 3)

    def test_who_is_ended_does_not_complain_of_it(self):
        """The end of its input would be a Python program's exception, and its traceback what is read first."""
        endless = "import json\nwhile True:\n    print(json.dumps(dict(type='support', direction=[1, 0, 0])), flush=True)\n    json.loads(input())\n"
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "endless.py")
            path.write_text(endless)
            for _ in range(5):
                result = subprocess.run([PROGRAM, "run", "box-box-deep", "--exec", f"/usr/bin/python3 {path}", "--max-supports", "20"], capture_output=True, text=True)
                self.assertEqual(result.returncode, 1)
                self.assertEqual(result.stderr, "")

    def test_momentum_is_what_it_is_said_to_be(self):
        """Directions off -v cost steps, of which a plain GJK is warned; not one that says it leads them. A scene's own method says nothing of the program."""
        led = "w = support([-x - (0.1 * y if len(simplex) < 3 and k % 2 == 0 else 0) for k, (x, y) in enumerate(zip(v, reversed(v)))])"
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "led.py")
            path.write_text(SOURCE.replace(SUPPORT, led, 1))
            scene = pathlib.Path(folder, "accelerated.scene.json")
            file = json.loads((ROOT / "recordings/gallery/box-box-deep.scene.json").read_text())
            file["method"] = {"name": "gjk-accelerated"}
            scene.write_text(json.dumps(file))
            command = f"/usr/bin/python3 {path}"
            for arguments, found in ((["run", scene], True), (["run", scene, "--method", "gjk-accelerated"], False), (["sweep", scene], True), (["sweep", scene, "--method", "gjk-accelerated"], False)):
                result = subprocess.run([PROGRAM, *map(str, arguments), "--exec", command], capture_output=True, text=True)
                self.assertEqual((result.returncode, "direction-not-perpendicular" in result.stdout), (1 if found else 0, found), (arguments, result.stdout, result.stderr))

    def test_a_depth_left_out_is_told_by_its_normal(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "silent.py")
            said = "    print(json.dumps(message), flush=True)"
            self.assertIn(said, SOURCE)
            path.write_text(SOURCE.replace(said, '    message.pop("signed_distance", None)\n    print(json.dumps(message), flush=True)', 1))
            for scene in ("spheres-deep", "spheres-concentric", "box-box-deep"):
                self.assertEqual([f["code"] for f in self.run_kit(scene, f"/usr/bin/python3 {path}")], [], scene)

    def test_muratoris_form_is_clean_on_the_gallery(self):
        self.clean_on_the_gallery(f"/usr/bin/python3 {ROOT / 'tests/muratori_solver.py'}", space_only=True)

    def test_portals_are_judged_as_portals(self):
        """Said to be MPR's, simplices lead outwards, and a depth is a way out. What it claims is judged all the same."""
        scenes = ("mpr-box-box", "box-box-deep", "obb-shallow", "box-box-apart", "pair-sphere-box", "pair-cone-ellipsoid", "boolean-hit-3d", "boolean-miss-3d", "hull-tetrahedra", "cylinder-box-deep")
        command, ways = f"/usr/bin/python3 {MPR}", []
        for scene in scenes:
            with self.subTest(scene):
                self.assertEqual(self.run_kit(scene, command, "--method", "mpr"), [])
            ways += [finding["code"] for finding in self.run_kit(scene, command)]
        self.assertTrue(ways, "by GJK's rules there is something to say")
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "wrong.py")
            for old, new, scene, code in (("if proves and dot(self.w, d) < 0", "if proves and dot(self.w, d) > 0", "box-box-deep", "unjustified-separation"), ("raise Apart", "pass", "boolean-miss-3d", "wrong-answer"),
                                          ('"signed_distance": -way_out[1]', '"signed_distance": -1.2 * way_out[1]', "box-box-deep", "wrong-depth"),
                                          ('"signed_distance": -way_out[1]', '"signed_distance": -0.5 * way_out[1]', "box-box-deep", "wrong-depth"),
                                          ("x.number for x in portal", "x.number + 40 for x in portal", "box-box-deep", "unknown-vertex")):
                self.assertIn(old, MPR.read_text())
                path.write_text(MPR.read_text().replace(old, new, 1))
                with self.subTest(new):
                    self.expect(self.run_kit(scene, f"/usr/bin/python3 {path}", "--method", "mpr"), code, new)

    def clean_on_thin_bodies(self, command):
        """Faces of their differences are slivers: a normal from rounded differences may be any, and the faces a point sees by it no disc. A cone of
        length 16 and radius 1e-4, beside itself; cylinders in one place, one of them far out for its size."""
        far, turned = [-2.6366518825923, -2.610435114410157, 0], {"quaternion": [-0.8263515906195918, 0.3569605275328709, 0.15136790423818047, -0.4084237848491028]}
        pairs = [("cone", 0.00012960248516948373, 8.224931920305364, [0, 0, 0], [-3.8e-05, 3.7e-06, 2e-06], turned), ("cylinder", 0.0010842056375900547, 0.002764408396975192, far, far, None),
                 ("cylinder", 0.00017136860697621544, 0.0005677640133699148, [0, 0, 0], [0, 0, 0], turned), ("cone", 0.5469401166806287, 2.1214566549071896, [-2.399998373423237, 0, 0], [-2.399998373423237, 0, 0], turned)]
        with tempfile.TemporaryDirectory() as folder:
            scenes = []
            for kind, radius, half_height, a, b, rotation in pairs:
                scenes.append(str(pathlib.Path(folder, f"{len(scenes)}.scene.json")))
                bodies = [{"shape": {"type": kind, "radius": radius, "half_height": half_height}, "pose": {"position": p, **({"rotation": rotation} if rotation else {})}} for p in (a, b)]
                pathlib.Path(scenes[-1]).write_text(json.dumps({"format": "gjk-scene", "version": 1, "dimension": 3, "bodies": bodies}))
            result = subprocess.run([PROGRAM, "sweep", *scenes, "--exec", command, "--timeout", "60"], capture_output=True, text=True)
            self.assertEqual((result.returncode, result.stdout, result.stderr), (0, f"\n{len(pairs)} scenes clean, 0 not\n", ""))

    def test_python_kit_is_clean_on_thin_bodies(self):
        self.clean_on_thin_bodies(f"/usr/bin/python3 {KIT}")

    def test_cpp_kit_is_clean_on_the_gallery(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run(["c++", "-std=c++17", "-O1", "-Wall", "-Wextra", "-Werror", str(KIT.parent / "gjk.cpp"), "-o", folder + "/gjk"], check=True)
            self.clean_on_the_gallery(folder + "/gjk")
            self.clean_on_thin_bodies(folder + "/gjk")

    @unittest.skipUnless(shutil.which("node"), "no node here")
    def test_javascript_kit_is_clean_on_the_gallery(self):
        self.clean_on_the_gallery(f"node {KIT.parent / 'gjk.js'}", stride=3)
        self.clean_on_thin_bodies(f"node {KIT.parent / 'gjk.js'}")

    @unittest.skipUnless(shutil.which("javac"), "no JDK here")
    def test_java_kit_is_clean_on_the_gallery(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run(["javac", "-d", folder, str(KIT.parent / "Gjk.java")], check=True)
            self.clean_on_the_gallery(f"java -XX:TieredStopAtLevel=1 -cp {folder} Gjk", stride=5)
            self.clean_on_thin_bodies(f"java -XX:TieredStopAtLevel=1 -cp {folder} Gjk")

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

    def test_causes_are_named(self):
        """Not the code alone: what the message says of the cause, and what it must not say."""
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "bug.py")
            for name, which, scene, replacements, code, phrases, more in CAUSES:
                source = SOURCE if which == "kit" else MURATORI.read_text()
                for old, new in replacements:
                    self.assertIn(old, source, name)
                    source = source.replace(old, new, 1)
                path.write_text(source)
                with self.subTest(name):
                    findings = self.run_kit(scene, f"/usr/bin/python3 {path}", *more)
                    self.expect(findings, code, name)
                    for phrase in phrases:
                        if phrase.startswith("not "):
                            self.assertNotIn(phrase[4:], findings[0]["message"])
                        else:
                            self.assertIn(phrase, findings[0]["message"])

    def test_what_programs_said_is_judged_rightly(self):
        for name, scene, more, lines, expected, phrases in RUNS:
            with self.subTest(name):
                findings = self.run_kit(scene, "cat >/dev/null & printf '%s\\n' " + " ".join(f"'{line}'" for line in lines), *more)
                found = [(f["code"], f["severity"]) for f in findings]
                open_end = expected[-1:] == [...]
                self.assertEqual(found[: len(expected) - 1] if open_end else found, expected[:-1] if open_end else expected)
                for phrase in phrases:
                    self.assertIn(phrase, findings[0]["message"])

    def test_yes_or_no_is_judged_to_rounding(self):
        """Two cubes that overlap by little, or touch, or are as little apart: a distance may be off by that, yes or no is told as a warning."""
        asks, simplex = '{"type":"support","direction":[1,0,0]}', '{"type":"simplex","vertices":[0]}'
        with tempfile.TemporaryDirectory() as folder:
            scene = pathlib.Path(folder, "nearly.scene.json")
            for place, answer, single, code in ((2, False, False, "unjustified-separation"), (2 - 1e-10, False, False, "unjustified-separation"), (2 - 1e-6, False, False, "unjustified-separation"), (2 - 1e-6, False, True, "unjustified-separation"),
                                                (2 - 1e-8, False, True, None), (2 - 1e-8, True, False, None), (2, True, False, None), (2 + 1e-8, True, False, "wrong-answer"), (2 + 1e-8, True, True, None), (2 + 1e-8, False, False, None)):
                box = {"type": "box", "half_extents": [1, 1, 1]}
                scene.write_text(json.dumps({"format": "gjk-scene", "version": 1, "dimension": 3, "query": "intersect", "bodies": [{"shape": box}, {"shape": box, "pose": {"position": [place, 0, 0]}}]}))
                lines = (asks, *((simplex,) if answer and place > 2 else ()), '{"type":"result","intersecting":%s}' % json.dumps(answer))
                findings = self.run_kit(scene, "cat >/dev/null & printf '%s\\n' " + " ".join(f"'{line}'" for line in lines), *(("--scalar", "float") if single else ()))
                with self.subTest((place, answer, single)):
                    self.assertEqual([(f["code"], f["severity"]) for f in findings], [(code, "warning")] if code else [])

    def test_who_goes_by_a_short_v_is_not_told_what_rounding_turned_it_by(self):
        """A slab of 1e-9 across an edge: where v is as short, rounding turns it by a millionth. Asked for yes or no, no distance tells of it, the simplex does."""
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "slab.scene.json")
            scene = json.loads((ROOT / "recordings/gallery/flat-slab.scene.json").read_text())
            for query in ("intersect", "distance", "penetration"):
                path.write_text(json.dumps({**{key: value for key, value in scene.items() if key != "expect"}, "query": query}))
                self.assertEqual(self.run_kit(path, f"/usr/bin/python3 {KIT}"), [], query)
            # Two boxes that touch, 100 from the origin: v is 4e-14, which is nothing in single precision, and asked along all the same.
            turned = {"axis": [1.5366415855542466, -1.0761693667043486, 0.98538156739061], "angle": 149.890158502102}
            boxes = [([0.7631860451273211, 0.8801146296637452, 0.9281193174657787], [100, -50, 30]), ([0.8701306054386404, 0.5204061377165653, 0.6867197444579896],
                     [99.90369977569668, -50.8598843547517, 31.41955924295843])]
            bodies = [{"shape": {"type": "box", "half_extents": sizes}, "pose": {"position": place, "rotation": turned}} for sizes, place in boxes]
            path.write_text(json.dumps({"format": "gjk-scene", "version": 1, "dimension": 3, "query": "intersect", "bodies": bodies}))
            strict = pathlib.Path(folder, "strict.py")
            strict.write_text(SOURCE.replace("1e-12 * scale", "1e-15 * scale"))
            self.assertEqual(self.run_kit(path, f"/usr/bin/python3 {strict}", "--scalar", "float"), [])

    def test_the_first_direction_negated_does_no_harm(self):
        """As dyn4j searches. Where the first two points are the same, or the first is nearer than the edge, Muratori's form needs the other direction."""
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "negated.py")
            path.write_text(MURATORI.read_text().replace(*NEGATED, 1))
            self.clean_on_the_gallery(f"/usr/bin/python3 {path}", space_only=True, stride=2, without=("crossing-segments", "margin-boxes", "sat-needles"))

    def test_single_precision_is_warned_of_once(self):
        source = SOURCE
        for old, new in SINGLE:
            source = source.replace(old, new, 1)
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "single.py")
            path.write_text(source)
            findings = self.run_kit("pair-sphere-sphere", f"/usr/bin/python3 {path}")
            self.assertEqual([(f["code"], f["severity"]) for f in findings], [("few-digits", "warning")])
            self.assertEqual(self.run_kit("pair-sphere-sphere", f"/usr/bin/python3 {path}", "--scalar", "float"), [])

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
        # A face before any polytope: its distance is along its normal, its normal leads out, and it has an area.
        asked = " ".join(f"'{line}'" for line in ('{"type":"support","direction":[1,0]}', '{"type":"support","direction":[0,1]}', '{"type":"support","direction":[-1,0]}'))
        supports = [[float(x) for x in e["w"]] for e in self.recorded("2d-deep", asked)]
        p, q = supports[0], supports[1]
        across = [q[1] - p[1], p[0] - q[0]]
        n = [x / (across[0] ** 2 + across[1] ** 2) ** 0.5 for x in across]
        if n[0] * p[0] + n[1] * p[1] < 0:
            n = [-x for x in n]
        d = n[0] * p[0] + n[1] * p[1]
        for vertices, normal, distance, code in (([0, 1], n, d, None), ([0, 1], n, -d, "wrong-face"), ([0, 1], [-x for x in n], d, "wrong-face"), ([0, 1], [-x for x in n], -d, "wrong-face"), ([0, 0], n, d, "zero-area-face"),
                                                 ([0, 1], [0, 0], d, "wrong-face"), ([0, 1], None, d, None)):
            message = json.dumps({"type": "face", "vertices": vertices, "normal": normal, "distance": distance})
            findings = self.run_kit("2d-deep", f"cat >/dev/null & printf '%s\\n' {asked} '{message}' '{result}'")
            with self.subTest(message):
                self.assertEqual([f["code"] for f in findings if f["code"] in ("wrong-face", "zero-area-face")], [code] if code else [])
        # What a message has in the wrong place is told as that.
        for message, said in (('{"type":1}', "/type: must be a string, one of support, simplex, polytope, face, result, not number"), ("{}", "/type: is missing; it is one of support"), ("[]", "is no JSON object")):
            findings = self.run_kit(box, f"cat >/dev/null & printf '%s\\n' '{message}'")
            self.assertIn(said, findings[0]["message"])
        # A normal that is no number does not hide what the rest says.
        findings = self.run_kit(box, f"cat >/dev/null & printf '%s\\n' '{far}' '" + '{"type":"result","intersecting":false,"normal":[NaN,0,0]}' + "'")
        self.assertEqual([f["code"] for f in findings], ["bad-message", "unjustified-separation", "wrong-answer"])

    def test_a_right_guess_is_no_proof(self):
        support, apart = '{"type":"support","direction":[0,0,1]}', '{"type":"result","intersecting":false}'
        findings = self.run_kit("box-box-apart", f"cat >/dev/null & printf '%s\\n' '{support}' '{apart}'")
        self.assertEqual([f["code"] for f in findings], ["unjustified-separation"])
        self.assertEqual(self.run_kit("box-box-apart", f"cat >/dev/null & printf '%s\\n' '{apart}'"), [])

    def test_the_example_of_an_own_recording(self):
        text = (ROOT / "recordings/README.md").read_text()
        example = json.loads(text[text.index('{"format": "gjk-recording"'):].split("```")[0])
        self.assertEqual([f["code"] for f in check_file(example)[1]], ["wrong-support"])
        vertex = at(example, "support_queried")
        vertex.update(b=[2, 1], w=[-1, 0])
        self.assertEqual(check_file(example)[1], [])

    def test_edited_recordings_are_named(self):
        dumps = {}
        for scene in {edited[0] for edited in (*LATER, *EDITS)}:
            dumps[scene] = json.loads(subprocess.run([PROGRAM, "dump", scene], capture_output=True, text=True).stdout)
            self.assertEqual(check_file(dumps[scene]), (0, []), scene)
        for scene, edit, step in LATER:
            recording = copy.deepcopy(dumps[scene])
            edit(recording)
            self.assertEqual([(f["code"], f["step"], f["severity"]) for f in check_file(recording)[1]], [("inconsistent", step, "warning")])
        for scene, edit, code in EDITS:
            recording = dumps[scene]
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

    def test_whoever_ends_us_ends_the_solver(self):
        for command in (["run", "box-box-deep", "--timeout", "60"], ["sweep", "--dimension", "1", "--timeout", "60"]):
            for end in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
                with tempfile.TemporaryDirectory() as folder:
                    number = pathlib.Path(folder, "pid")
                    extra = ["-o", f"{folder}/out.json"] if command[0] == "run" else []
                    program = subprocess.Popen([PROGRAM, *command, *extra, "--exec", f"echo $$ > {number}.part; mv {number}.part {number}; exec sleep 60"],
                                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, preexec_fn=lambda: signal.signal(end, signal.SIG_DFL))
                    for _ in range(500):
                        if number.exists():
                            break
                        time.sleep(0.02)
                    solver = int(number.read_text())
                    program.send_signal(end)
                    self.assertEqual(program.wait(20), -end)
                    self.assertEqual(os.listdir(folder), ["pid"])  # and half a recording is none
                    for _ in range(100):  # until whoever is its parent now has seen it end
                        if not pathlib.Path(f"/proc/{solver}/stat").exists() or pathlib.Path(f"/proc/{solver}/stat").read_text().split()[2] == "Z":
                            break
                        time.sleep(0.02)
                    else:
                        os.kill(solver, signal.SIGKILL)
                        self.fail(f"{command[0]} was ended by {end}, and its solver goes on")

    def test_where_nothing_can_be_written_nothing_is_run(self):
        with tempfile.TemporaryDirectory() as folder:
            mark = pathlib.Path(folder, "ran")
            result = subprocess.run([PROGRAM, "run", "box-box-deep", "--exec", f"touch {mark}", "-o", f"{folder}/no/out.json"], capture_output=True, text=True)
            self.assertEqual((result.returncode, result.stdout, result.stderr.count("\n")), (2, "", 1))
            self.assertIn("cannot be written: ", result.stderr)
            self.assertFalse(mark.exists())

    def test_closed_standard_streams(self):
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder, "out.json")
            for closed, status in (("<&-", 0), ("2>&-", 0), ("<&- 2>&-", 0), (">&-", 2)):
                command = f"echo noise >&2; exec /usr/bin/python3 {KIT}"
                result = subprocess.run(["sh", "-c", f'"$0" run box-box-deep --exec "$1" -o "$2" {closed}', PROGRAM, command, out], capture_output=True, text=True)
                self.assertEqual((result.returncode, result.stdout), (status, "" if status else "no findings: every step holds\n"), closed)
                self.assertEqual(check_file(json.loads(out.read_text())), (0, []), closed)

    def test_a_scene_of_any_name_is_saved_in_the_folder(self):
        scene = json.loads((ROOT / "recordings/gallery/2d-deep.scene.json").read_text())
        with tempfile.TemporaryDirectory() as folder:
            names = ["../up", f"{folder}/absolute", "a/b", "a\nb", "\u00e9" * 150, ".hidden", ".."]
            files = [pathlib.Path(folder, f"{i}.scene.json") for i in range(len(names))]
            for file, name in zip(files, names):
                file.write_text(json.dumps({**scene, "name": name}))
            result = subprocess.run([PROGRAM, "sweep", *files, "--exec", "true", "-o", f"{folder}/failing/all"], capture_output=True, text=True)
            self.assertEqual((result.returncode, result.stderr), (1, ""))
            saved = sorted(os.listdir(f"{folder}/failing/all"))
            self.assertEqual(saved, sorted(f"{name}.scene.json" for name in ("-.-up", folder.replace("/", "-") + "-absolute", "a-b", "a-b-2", "\u00e9" * 100, "-hidden", "-.")))
            self.assertEqual((len(os.listdir(f"{folder}/failing")), len(os.listdir(folder))), (1, len(names) + 1))

    def test_started_by_one_who_ignores_its_children(self):
        for command, codes in ((f"/usr/bin/python3 {KIT}", []), ("exit 3", ["crash"])):
            result = subprocess.run([PROGRAM, "run", "box-box-deep", "--exec", command, "--json"], capture_output=True, text=True, preexec_fn=lambda: signal.signal(signal.SIGCHLD, signal.SIG_IGN))
            self.assertEqual([f["code"] for f in json.loads(result.stdout)["findings"]], codes)

    def test_control_characters_do_not_reach_the_terminal(self):
        result = subprocess.run([PROGRAM, "run", "box-box-deep", "--exec", """printf '%s\\n' '{"type":"support","direction":[1,0,0],"a\\u001b[31m\\nb":1}'"""], capture_output=True, text=True)
        self.assertIn('"a\\x1b[31m\\x0ab"', result.stdout)
        self.assertNotIn("\x1b", result.stdout)

    def test_numbers_that_are_none(self):
        for word in ("NaN", "-nan", "inf", "-Infinity", "null", '"NaN"', '"Infinity"', '"-Infinity"'):
            lines = "".join(f" '{line}'" for line in ('{"type":"support","direction":[%s,0,0],"note":"C:\\\\"}' % word, '{"type":"result","intersecting":true,"signed_distance":%s,"normal":[%s,0,0]}' % (word.replace("null", "NaN"), word)))
            codes = [f["code"] for f in self.run_kit("box-box-deep", f"cat >/dev/null & printf '%s\\n'{lines}")]
            self.assertEqual(codes[:3], ["unknown-field", "non-finite-direction", "bad-message"], word)

    def test_sweep_shows_the_same_error_output_once(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "crashes.py")
            path.write_text('raise ValueError("boom")\n')
            result = subprocess.run([PROGRAM, "sweep", "--exec", f"/usr/bin/python3 {path}", "--dimension", "1", "--random", "3"], capture_output=True, text=True)
        self.assertEqual((result.returncode, result.stderr), (1, ""))
        self.assertEqual((result.stdout.count("ValueError: boom"), result.stdout.count("Traceback"), result.stdout.count(" crash\n")), (1, 1, 8))

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

    def test_sweep_of_scenes_by_name(self):
        def sweep(*arguments):
            return subprocess.run([PROGRAM, "sweep", "--exec", f"/usr/bin/python3 {KIT}", *arguments], capture_output=True, text=True)
        some = sweep("2d-deep", ROOT / "recordings/gallery/box-box-apart.scene.json", "sim-falling-box", "level-mesh", "--dimension", "2")
        self.assertEqual((some.returncode, some.stdout), (0, "\n1 scene clean, 0 not\n3 not asked: a program is not asked of bodies that move and of meshes, nor here of other dimensions\n"))
        self.assertIn("\n3 scenes clean, 0 not\n", sweep("2d-deep", "--random", "2").stdout)
        with tempfile.TemporaryDirectory() as folder:
            # A scene that is wrong is told before the first is asked of, and of two scenes of one name both are kept.
            wrong = pathlib.Path(folder, "wrong.scene.json")
            wrong.write_text('{"format": "gjk-scene", "version": 1, "dimension": 2, "bodies": []}')
            result = sweep("2d-deep", wrong)
            self.assertEqual((result.returncode, result.stdout, result.stderr.count("\n")), (2, "", 1))
            self.assertIn(f"{wrong}: /bodies", result.stderr)
            broken = subprocess.run([PROGRAM, "sweep", "2d-deep", "2d-deep", "--exec", "exit 3", "-o", folder], capture_output=True, text=True)
            self.assertEqual((broken.returncode, broken.stderr), (1, ""))
            self.assertEqual(sorted(f.name for f in pathlib.Path(folder).glob("2d-*")), ["2d-deep-2.scene.json", "2d-deep.scene.json"])
            # A scene without a name goes by its file's.
            nameless = pathlib.Path(folder, "nameless.scene.json")
            scene = json.loads((ROOT / "recordings/gallery/2d-deep.scene.json").read_text())
            del scene["name"]
            nameless.write_text(json.dumps(scene))
            self.assertRegex(subprocess.run([PROGRAM, "sweep", nameless, "--exec", "exit 3"], capture_output=True, text=True).stdout, "^nameless +crash")

    def test_a_program_that_is_not_there(self):
        findings = self.run_kit("box-box-deep", "/nonexistent/program 2>/dev/null")
        self.assertEqual([f["code"] for f in findings], ["crash"])
        self.assertIn("exit status 127 (what a shell says that finds no such program)", findings[0]["message"])


unittest.main()
