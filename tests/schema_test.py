#!/usr/bin/python3
"""Every shipped scene and recording, and what the program writes today, validates against its schema; damaged ones do not."""
import collections
import copy
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

from jsonschema import Draft7Validator

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRAM = sys.argv.pop(1)
SCHEMAS = {p.name.split(".")[0]: Draft7Validator(json.loads(p.read_text())) for p in (ROOT / "recordings/schema").glob("*.json")}


def load(path):
    return json.loads(path.read_text())


def thinned(recording, of_a_kind=8):
    """With the first events of each kind, set of members and words: the others are the same but for their numbers."""
    seen = {}
    def kept(event):
        form = tuple((key, value if isinstance(value, str) else type(value)) for key, value in event.items())
        seen[form] = seen.get(form, 0) + 1
        return seen[form] <= of_a_kind
    return {**recording, "events": [event for event in recording["events"] if kept(event)]}


class Schemas(unittest.TestCase):
    def check(self, kind, value, name):
        errors = [e.message[:200] for e in SCHEMAS[kind].iter_errors(value)]
        self.assertEqual(errors, [], name)

    def test_schemas_are_schemas(self):
        for schema in SCHEMAS.values():
            Draft7Validator.check_schema(schema.schema)

    def test_every_scene(self):
        scenes = sorted((ROOT / "recordings/gallery").glob("*.scene.json"))
        self.assertGreaterEqual(len(scenes), 60)
        for path in scenes:
            self.check("scene", load(path), path.name)
        self.check("lessons", load(ROOT / "recordings/gallery/lessons.json"), "lessons.json")

    def test_every_golden_recording(self):
        recordings = sorted((ROOT / "recordings/golden").glob("*.json"))
        self.assertGreaterEqual(len(recordings), 20)
        for path in recordings:
            self.check("recording", load(path), path.name)

    def test_what_is_written_today(self):
        for path in sorted((ROOT / "recordings/gallery").glob("*.scene.json"))[:: 5 if "GJKDBG_PAIRS" in os.environ else 1]:
            run = subprocess.run([PROGRAM, "dump", str(path)], capture_output=True, text=True, check=True)
            self.check("recording", thinned(json.loads(run.stdout)), path.name)

    def test_what_every_method_writes(self):
        written = collections.Counter()
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "asked.scene.json")
            for scene in ("box-box-deep", "spheres-deep", "2d-deep", "pair-cylinder-cone", "cylinder-box-deep"):
                for method in ("gjk", "gjk-boolean", "gjk-accelerated", "mpr", "sat", "closed-form", "projections", "fastest"):
                    for query in ("intersect",) if method == "gjk-boolean" else ("distance", "penetration", "contact"):
                        asked = load(ROOT / f"recordings/gallery/{scene}.scene.json")
                        asked["query"] = query
                        asked.pop("method", None), asked.pop("expect", None)
                        path.write_text(json.dumps(asked))
                        run = subprocess.run([PROGRAM, "dump", str(path), "--method", method], capture_output=True, text=True)
                        if run.returncode == 2:
                            self.assertIn("--method", run.stderr)
                            continue  # no method for these bodies
                        recording = json.loads(run.stdout)
                        self.check("recording", recording, f"{scene} by {method}")
                        self.check("scene", recording["scene"], f"{scene} by {method}")
                        written[method] += 1
        self.assertTrue(all(written[m] >= 3 for m in ("gjk", "gjk-boolean", "gjk-accelerated", "mpr", "sat", "closed-form", "projections", "fastest")), written)

    def test_findings_and_solver_messages(self):
        for scene in ("box-box-deep", "box-box-apart"):
            kit = ROOT / "debugger/solver/kits/gjk.py"
            # A solver that says everything twice: to us, and to a file.
            with tempfile.TemporaryDirectory() as folder:
                source = kit.read_text().replace("    print(json.dumps(message), flush=True)",
                                                 f"    print(json.dumps(message), flush=True)\n    print(json.dumps(message), file=open('{folder}/said', 'a'))")
                pathlib.Path(folder, "kit.py").write_text(source.replace("support(scaled(-1, v))", "support(v)") if scene == "box-box-apart" else source)
                run = subprocess.run([PROGRAM, "run", scene, "--exec", f"/usr/bin/python3 {folder}/kit.py", "--json"], capture_output=True, text=True)
                findings = json.loads(run.stdout)
                self.check("findings", findings, scene)
                self.assertEqual(bool(findings["findings"]), scene == "box-box-apart")
                for line in pathlib.Path(folder, "said").read_text().splitlines():
                    self.check("solver-message", json.loads(line), line)

    def test_what_is_no_number_is_written_and_read_back(self):
        """A solver's nearest point of which a part is NaN, and a field that is not known."""
        script = "read l; echo '{\"type\":\"support\",\"direction\":[1,0]}'; read l; echo '{\"type\":\"simplex\",\"vertices\":[0],\"closest\":[NaN,0],\"speed\":1}'; echo '{\"type\":\"result\",\"intersecting\":true}'"
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "nan.recording.json")
            run = subprocess.run([PROGRAM, "run", "2d-deep", "--exec", script, "--json", "-o", str(path)], capture_output=True, text=True)
            findings = json.loads(run.stdout)
            self.check("findings", findings, "nan")
            self.assertLessEqual({"wrong-closest", "unknown-field"}, {f["code"] for f in findings["findings"]})
            self.check("recording", load(path), "nan")
            self.assertEqual(json.loads(subprocess.run([PROGRAM, "check", str(path), "--json"], capture_output=True, text=True).stdout), findings)

    def test_every_finding_code(self):
        """What check and a solver's run can say, what the page lists, and what the schema takes are the same codes."""
        schema = set(SCHEMAS["findings"].schema["properties"]["findings"]["items"]["properties"]["code"]["enum"])
        table = (ROOT / "recordings/README.md").read_text().split("## Findings")[1]
        listed = {code for row in re.findall(r"^\| (`[^|]*) \|", table, re.MULTILINE) for code in re.findall(r"`([a-z-]+)`", row)}
        self.assertEqual(listed, schema)
        sources = [*(ROOT / "recordings").glob("check*.cpp"), *(ROOT / "debugger/solver").glob("*.cpp")]
        said = {code for source in sources for code in re.findall(r'(?<!json.)\b(?:find\w*|suspect|abort|warn|Warning)[({]"([a-z-]+)"', source.read_text())}
        self.assertGreater(len(said), 40)
        self.assertLessEqual(said, schema)

    def test_the_example_of_another_engine(self):
        text = (ROOT / "recordings/README.md").read_text()
        example = json.loads(text[text.index('{"format": "gjk-recording"'):].split("```")[0])
        self.check("recording", example, "my engine")

    def test_wrong_files_do_not_validate(self):
        good = load(ROOT / "recordings/golden/2d-deep.recording.json")
        for break_it in (
            lambda r: r.pop("events"),
            lambda r: r["events"][1].pop("w"),
            lambda r: r["events"][1].update(colour=1),
            lambda r: r["events"][0].update(kind="gjk_begun"),
            lambda r: r["scene"]["bodies"][0]["shape"].update(half_extents="big"),
            lambda r: r.update(version=2),
        ):
            bad = copy.deepcopy(good)
            break_it(bad)
            self.assertFalse(SCHEMAS["recording"].is_valid(bad))


unittest.main()
