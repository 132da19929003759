#!/usr/bin/python3
"""The program from outside: exit statuses, one-line errors, files written whole or not at all."""
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
import xml.etree.ElementTree

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRAM = os.path.abspath(sys.argv.pop(1))
SANITIZED = "GJKDBG_PAIRS" in os.environ  # fewer of everything: see tests/run

CUBES = {
    "format": "gjk-scene", "version": 1, "dimension": 3,
    "bodies": [
        {"shape": {"type": "box", "half_extents": [0.5, 0.5, 0.5]}},
        {"shape": {"type": "box", "half_extents": [0.5, 0.5, 0.5]}, "pose": {"position": [0.9, 0, 0]}},
    ],
}


def run(*arguments, **options):
    environment = {**os.environ, **options.pop("environment", {})}
    if arguments[0] == "render":
        environment["ASAN_OPTIONS"] = "detect_leaks=0"  # LeakSanitizer crashes when Mesa's threads end under it
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, env=environment, **options)


class Program(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.path = pathlib.Path(self.folder.name)
        self.scene = self.write("cubes.scene.json", CUBES)

    def tearDown(self):
        self.folder.cleanup()

    def write(self, name, value):
        path = self.path / name
        path.write_text(value if isinstance(value, str) else json.dumps(value))
        return path

    def refused(self, result, *parts):
        """Status 2 and one line that names file, place and reason."""
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
        for part in parts:
            self.assertIn(part, result.stderr)

    def test_dump_answers(self):
        result = run("dump", self.scene)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        recording = json.loads(result.stdout)
        self.assertEqual(recording["format"], "gjk-recording")
        self.assertAlmostEqual(recording["result"]["signed_distance"], -0.1, 12)
        self.assertEqual(recording["result"]["normal"], [1, 0, 0])

    def test_the_examples_of_the_readme(self):
        examples = (ROOT / "README.md").read_text().split("Without a display:")[1].split("```")[1]
        commands = [c.split("#")[0].split()[1:] for line in examples.splitlines() for c in line.split(";") if c.strip().startswith("./gjkdbg")]
        self.assertGreater(len(commands), 8)
        for command in commands:
            if command[0] in ("scenes", "dump", "verify", "diff"):
                result = run(*command, cwd=self.path)
                self.assertEqual((result.returncode, result.stderr), (1 if command[0] == "diff" else 0, ""), command)

    def test_where_nothing_can_be_installed_the_build_told_of_needs_no_more_than_is_named(self):
        for tool in ("awk", "bash", "dirname", "readlink", "tr"):
            (self.path / tool).symlink_to(shutil.which(tool))
        for parts, flags in (("build view tests", ""), ("build view", "-DGJKDBG_TESTS=OFF "), ("build", "-DGJKDBG_VIEW=OFF -DGJKDBG_TESTS=OFF ")):
            told = subprocess.run(["bash", ROOT / "debugger/install_packages", *parts.split()], capture_output=True, text=True, env={"PATH": str(self.path)})
            self.assertEqual(told.returncode, 1)
            self.assertEqual("googletest" in told.stderr, "tests" in parts)
            self.assertTrue(told.stderr.endswith(f"Then: cmake --preset release {flags}&& cmake --build build/release\n"), told.stderr)

    @unittest.skipUnless("render" in run("--help").stdout, "built without the view")
    def test_start_without_a_display(self):
        """What it writes is named after the scene, whatever kind of file it was given."""
        root, work = self.path / "root", self.path / "work"
        (root / "debugger").mkdir(parents=True), (root / "build/release/debugger").mkdir(parents=True), work.mkdir()
        shutil.copy(ROOT / "debugger/start", root / "debugger/start")
        for stub in ("debugger/install_packages", "cmake"):
            (root / stub).write_text("#!/bin/sh\n"), (root / stub).chmod(0o755)
        (root / "build/release/build.ninja").touch()
        (root / "build/release/debugger/gjkdbg").symlink_to(PROGRAM)
        recording = self.path / "kept.recording.json"
        run("dump", self.scene, "-o", recording)
        environment = {**{k: v for k, v in os.environ.items() if "DISPLAY" not in k}, "PATH": f"{root}:{os.environ['PATH']}", "ASAN_OPTIONS": "detect_leaks=0"}
        for given, name in ((self.scene, "cubes"), (recording, "kept"), ("2d-deep", "2d-deep")):
            self.assertEqual(subprocess.run([root / "debugger/start", given], cwd=work, env=environment, capture_output=True, text=True).stdout,
                             f"No display here. Written instead: {name}.recording.json and {name}.png\n")
        self.assertEqual(sorted(p.name for p in work.iterdir()), sorted(f"{name}.{kind}" for name in ("cubes", "kept", "2d-deep") for kind in ("recording.json", "png")))

    def test_the_standard_input_as_a_file(self):
        recording = run("dump", "-", input=self.scene.read_text()).stdout
        self.assertEqual(recording, run("dump", self.scene).stdout)
        path = self.write("cubes.recording.json", recording)
        for arguments in (("check", "-"), ("verify", "-"), ("diff", path, "-"), ("diff", "-", path)):
            result = run(*arguments, input=recording)
            self.assertEqual((result.returncode, result.stderr), (0, ""), arguments)
        self.refused(run("check", "-", input="{"), "/dev/stdin: line 1, column 2: ")

    def test_dump_by_gallery_name(self):
        self.assertEqual(run("dump", "two-unit-cubes", cwd=self.path).returncode, 0)
        self.assertEqual(run("dump", "xyzzy", cwd=self.path).stderr, "gjkdbg: xyzzy: is neither a file nor a scene of the gallery, which gjkdbg scenes lists\n")
        for word, scene in (("three-unit-cubes", "two-unit-cubes"), ("sphere-sphere", "pair-sphere-sphere"), ("newtons-cradle", "sim-newtons-cradle"), ("box-box-depe", "box-box-deep")):
            self.refused(run("dump", word, cwd=self.path), f"which gjkdbg scenes lists; did you mean {scene}?")

    def test_flags_override_the_scene(self):
        method = json.loads(run("dump", self.scene, "--scalar", "float", "--tolerance", "1e-3", "--max_iterations", "7", "--penetration", "none",
                                "--initial_direction", "0,1,0").stdout)["method"]
        self.assertEqual((method["scalar"], method["tolerance"], method["max_iterations"]), ("float", 1e-3, 7))
        self.assertEqual((method["penetration"], method["initial_direction"]), ("none", [0, 1, 0]))
        self.assertEqual(run("dump", "--initial-direction=1,0,0", self.scene, "-o", self.path / "led.json").returncode, 0)

    def test_starts_where_another_run_ended(self):
        first = str(self.path / "first.recording.json")
        self.assertEqual(run("dump", "box-box-apart", "-o", first).returncode, 0)
        warm = json.loads(run("dump", "box-box-apart", "--start-from", first).stdout)
        self.assertEqual(warm["method"]["start"], "previous")
        self.assertEqual([e["kind"] for e in warm["events"]][:4], ["gjk_began", "vertex_kept", "vertex_kept", "vertex_kept"])
        self.assertEqual(warm["result"]["support_calls"], 1)
        again = str(self.path / "again.recording.json")
        run("dump", "box-box-apart", "--start-from", first, "-o", again)
        self.assertEqual(run("verify", again).returncode, 0)
        self.assertEqual(run("check", again).returncode, 0)
        other = run("dump", "pair-sphere-capsule", "--start-from", first)
        self.assertEqual((other.returncode, other.stdout), (2, ""))
        self.assertIn("--start-from", other.stderr)
        self.assertEqual(run("dump", "box-box-apart", "--start", "given").returncode, 2)
        # Another algorithm leaves the warm start behind; asked for by name, it is refused.
        self.assertEqual(run("dump", "warm-start", "--method", "sat").returncode, 0)
        self.assertEqual(run("dump", "warm-start", "--method", "sat", "--start", "previous").returncode, 2)
        still, moved = (json.loads(run("dump", "sim-slope-slides", *flags).stdout)["result"]["support_calls"] for flags in ((), ("--start", "previous")))
        self.assertLess(moved, still)

    def test_the_fastest_methods_recordings_go_through_every_command(self):
        files = {}
        scenes = sorted((ROOT / "recordings/gallery").glob("*.scene.json"))
        for path in [p for i, p in enumerate(scenes) if not SANITIZED or i % 5 == 0 or p.name.startswith("closed-form")]:
            name = path.name.removesuffix(".scene.json")
            out = self.path / f"{name}.recording.json"
            if run("dump", name, "--name", "fastest", "-o", out).returncode != 2:  # 2: the scene asks for what only GJK has
                files[out] = json.loads(out.read_text())["method"]["name"]
        self.assertGreater(len(files), 20 if SANITIZED else 100)
        self.assertEqual(run("verify", *files).returncode, 0)
        closed = [file for file, method in files.items() if method == "closed-form"]
        self.assertGreater(len(closed), 2 if SANITIZED else 10)
        for file in closed:
            self.assertEqual(run("check", file).stdout, "no findings: every step holds\n", file)
            self.assertEqual(run("diff", file, file).returncode, 0, file)
            if "render" in run("--help").stdout:
                self.assertEqual(run("render", file, "-o", self.path / "step.svg").returncode, 0, file)

    def test_query_takes_a_scene_file(self):
        result = run("query", str(ROOT / "recordings/gallery/closed-form-crossing.scene.json"))
        self.assertEqual(result.returncode, 0)
        self.assertAlmostEqual(json.loads(result.stdout)["signed_distance"], -1.2, 12)

    def test_no_more_than_was_asked(self):
        for query, fields in (("intersect", []), ("distance", ["signed_distance", "witness_a"]), ("contact", ["contacts", "normal"])):
            result = json.loads(run("dump", self.write("q.json", {**CUBES, "query": query})).stdout)["result"]
            for field in ("signed_distance", "normal", "witness_a", "contacts"):
                if field in fields:
                    self.assertIn(field, result)
                elif query == "intersect":
                    self.assertNotIn(field, result)

    def test_distance_never_runs_epa(self):
        text = run("dump", self.write("q.json", {**CUBES, "query": "distance"})).stdout
        self.assertNotIn("epa", "".join(text.split('"events"')[1]))

    def test_one_line_whatever_a_file_is_called(self):
        scene = self.write("a\nb.scene.json", {**CUBES, "expect": {"intersecting": False}})
        lines = self.write("a\nb.jsonl", json.dumps({**CUBES, "expect": {"intersecting": False}}))
        for arguments in (("dump", scene, "-o", self.path / "a\nb.json"), ("query", lines)):
            result = run(*arguments)
            self.assertEqual((result.returncode, result.stderr.count("\n")), (1, 1), result.stderr)
            self.assertIn("a\\x0ab", result.stderr)
        self.assertEqual(run("verify", self.path / "a\nb.json").stdout.count("\n"), 1)

    def test_wrong_expectations_exit_1(self):
        for expect in ({"intersecting": False}, {"signed_distance": -0.2}, {"normal": [0, 1, 0]}, {"time": 0.5}):
            result = run("dump", self.write("e.json", {**CUBES, "expect": expect}))
            self.assertEqual(result.returncode, 1)
            self.assertIn("/expect", result.stderr)
        # What the query does not answer is no match either.
        for query in ("intersect", "cast"):
            for expect in ({"signed_distance": -0.1}, {"normal": [1, 0, 0]}) if query == "intersect" else ({"signed_distance": -0.1},):
                result = run("dump", self.write("e.json", {**CUBES, "query": query, "expect": expect}))
                self.assertEqual(result.returncode, 1, (query, expect))
                self.assertIn("is not known, expected", result.stderr)
        self.assertEqual(run("dump", self.write("e.json", {**CUBES, "expect": {"signed_distance": -0.1, "tolerance": 1e-9}})).returncode, 0)

    def test_bad_input_is_one_line(self):
        self.refused(run("dump", self.path / "nowhere.json"), "nowhere.json")
        self.refused(run("dump", self.path), str(self.path))
        self.refused(run("dump", self.write("bad.json", "{")), "bad.json", "line 1, column 2")
        self.refused(run("dump", self.write("bad.json", {**CUBES, "dimension": 4})), "bad.json", "/dimension")
        self.refused(run("dump", self.write("bad.json", {**CUBES, "querry": "distance"})), "/querry", "query")
        self.refused(run("dump", self.write("bad.json", {**CUBES, "query": "cast", "gravity": [0, 0, 1]})), "/gravity", "not a known field")
        self.refused(run("dump", self.write("bad.json", "\xff\x00")), "bad.json")
        self.refused(run("dump", self.scene, "--tolerance", "-1"), "--tolerance")
        self.refused(run("dump", self.scene, "--scalar", "half"), "--scalar")
        self.refused(run("dump", self.scene, "--name", "gjk-boolean"), "--method")
        self.refused(run("dump"), "SCENE")
        self.refused(run("frobnicate"), '"frobnicate" is no command', "--help")
        self.refused(run("dupm", self.scene), "did you mean", "dump")
        self.refused(run("--frobnicate"), "--help")
        self.refused(run("--vesion"), '"--vesion" is no option; did you mean "--version"? (see gjkdbg --help)')
        self.refused(run("dump", self.scene, "--scaler", "float"), '"--scaler" is no option of dump; did you mean "--scalar"? (see gjkdbg dump --help)')
        self.refused(run("query", "--job=2"), '"--job" is no option of query; did you mean "--jobs"?')
        self.refused(run("atlas", "--gate"), "gjkdbg atlas --help")
        self.refused(run("dump", self.scene, "--method", "gjkk"), "--method: must be one of gjk,gjk-boolean", "not gjkk; did you mean gjk?")
        self.refused(run("dump", self.scene, "--name", "gjkk"), "gjkdbg: --name: must be one of ")
        self.refused(run("dump", self.scene, "--max-iterations=0"), "gjkdbg: --max-iterations: must be a whole number")
        self.refused(run("sweep", "--exec", "true", "--scalar", "half"), "--scalar: must be one of double,float, not half (see gjkdbg sweep --help)")
        self.refused(subprocess.run([PROGRAM], capture_output=True, text=True), "--help")
        for command in ("dump", "check", "query", "verify"):
            self.refused(run(command, self.path), "is a directory")
            self.refused(run(command, ""), "must name something")
        self.refused(run("dump", self.scene, "-o", ""), "--output", "must name something")
        self.refused(run("query", self.scene, "-o", ""), "--output", "must name something")
        self.refused(run("run", "cast-ray", "--exec", "true"), "cast-ray.scene.json: /query")
        self.refused(run("run", self.scene, "--exec", ""), "--exec")
        self.refused(run("verify", self.scene), "/format")

    def test_numbers_that_json_cannot_hold_and_deep_nesting_have_a_place(self):
        text = json.dumps(CUBES)
        self.refused(run("dump", self.write("bad.json", text.replace("0.9", "1e999"))), "bad.json: /bodies/1/pose/position/0: ", "1e999")
        self.refused(run("dump", self.write("bad.json", text.replace('"dimension": 3', '"dimension": 1e999'))), "bad.json: /dimension: ")
        self.refused(run("dump", self.write("bad.json", "\n 1e999")), "bad.json: line 2, column ")
        self.refused(run("dump", self.write("bad.json", '{"a]":"\\"[",\n"b":' + "[" * 100)), "bad.json: line 2, column 68: is nested too deeply")
        lines = [text, text.replace("0.9", "1e999"), "[" * 100, text, "{nonsense"]
        answers = [json.loads(line) for line in run("query", self.write("pairs.jsonl", "\n".join(lines))).stdout.splitlines()]
        self.assertEqual([a["error"]["where"] for a in answers if "error" in a], ["/bodies/1/pose/position/0", "line 3, column 65", "line 5, column 3"])

    def test_options_take_numbers_in_range(self):
        recording = self.path / "cubes.recording.json"
        run("dump", self.scene, "-o", recording)
        png = ("-o", self.path / "r.png")
        options = [(("dump", self.scene), "--tolerance"), (("dump", self.scene), "--max_iterations"), (("dump", self.scene), "--initial_direction"),
                   (("query", self.scene), "--jobs"), (("run", self.scene, "--exec", "true"), "--timeout"), (("run", self.scene, "--exec", "true"), "--max-supports"),
                   (("sweep", "--exec", "true"), "--timeout"), (("sweep", "--exec", "true"), "--max-supports"), (("sweep", "--exec", "true"), "--random"),
                   (("sweep", "--exec", "true"), "--dimension"), (("sweep", "--exec", "true"), "--seed")]
        if "render" in run("--help").stdout:
            options += [(("render", recording, *png), option) for option in ("--scale", "--width", "--height", "--step")]
            options += [(("view", recording), option) for option in ("--scale", "--width", "--height")]
        for command, option in options:
            for value in ("nan", "inf", "-inf", "1e999", "-1e300", "two", ""):
                result = run(*command, f"{option}={value}")
                self.refused(result, option)

    def test_help_and_version(self):
        self.assertEqual(run("--help").returncode, 0)
        self.assertIn("dump", run("--help").stdout)
        self.assertRegex(run("--version").stdout, r"^gjkdbg \d+\.\d+\.\d+")

    def test_output_whole_or_not_at_all(self):
        target = self.write("out.json", "before")
        self.refused(run("dump", self.write("bad.json", "{"), "-o", target))
        self.assertEqual(target.read_text(), "before")
        self.refused(run("dump", self.scene, "-o", self.path / "no/such/folder/out.json"), "cannot be written")
        hours = self.write("hours.json", {**CUBES, "query": "simulate", "steps": 1000000})
        self.refused(run("dump", hours, "-o", self.path / "no/out.json", timeout=60), "cannot be written")  # before the run
        self.assertEqual(run("dump", self.scene, "-o", target).returncode, 0)
        self.assertEqual(json.loads(target.read_text())["version"], 1)
        self.assertEqual([p.name for p in self.path.iterdir() if ".part" in p.name], [])

    def test_interrupted_writing_leaves_nothing(self):
        line = json.dumps(json.loads((ROOT / "recordings/gallery/pair-hull-hull.scene.json").read_text()))
        with tempfile.TemporaryDirectory() as folder:
            for end in (signal.SIGTERM, signal.SIGINT):
                program = subprocess.Popen([PROGRAM, "query", "-", "-o", f"{folder}/out.jsonl"], stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, text=True)
                program.stdin.write((line + "\n") * 100)
                program.stdin.flush()
                for _ in range(500):  # until it writes
                    if os.listdir(folder):
                        break
                    time.sleep(0.02)
                self.assertTrue(os.listdir(folder))
                program.send_signal(end)
                self.assertEqual(program.wait(20), -end)
                self.assertEqual(os.listdir(folder), [])
                program.stdin.close()

    @unittest.skipIf(SANITIZED or sys.platform != "linux", "takes all addresses there are")
    def test_out_of_memory(self):
        points = [[x % 89, x % 97, x % 101] for x in range(60000)]
        line = json.dumps({**CUBES, "bodies": [{"shape": {"type": "hull", "points": points}}, CUBES["bodies"][1]]})
        scene, lines = self.write("hull.json", line), self.write("hulls.jsonl", (line + "\n") * 4)
        with tempfile.TemporaryDirectory() as folder:
            ended = set()
            for kilobytes in range(40000, 360000, 40000):
                for arguments in (("dump", scene), ("query", lines), ("query", lines, "--jobs", 4)):
                    result = subprocess.run(["sh", "-c", f'ulimit -v {kilobytes}; exec "$0" "$@"', PROGRAM, *map(str, arguments), "-o", f"{folder}/out"], capture_output=True, text=True)
                    ended.add(result.returncode)
                    if result.returncode == 0:
                        os.remove(f"{folder}/out")
                    elif result.returncode != 127:  # 127: the program itself has no room
                        self.assertEqual((result.returncode, result.stderr), (2, "gjkdbg: out of memory\n"))
                    self.assertEqual(os.listdir(folder), [])
            self.assertEqual(ended - {127}, {0, 2})

    @unittest.skipUnless(os.path.exists("/dev/full"), "no /dev/full")
    def test_full_disk(self):
        recording = self.path / "cubes.recording.json"
        run("dump", self.scene, "-o", recording)
        for arguments in (("dump", self.scene), ("query", self.scene), ("scenes",), ("--help",), ("--version",), ("verify", recording), ("check", recording), ("check", recording, "--json"),
                          ("diff", recording, recording), ("run", self.scene, "--exec", "true"), ("sweep", "--exec", "true", "--random", 1, "--dimension", 1)):
            with open("/dev/full", "w") as full:
                result = subprocess.run([PROGRAM, *map(str, arguments)], stdout=full, stderr=subprocess.PIPE, text=True)
            self.refused(result, "standard output", "cannot be written")

    def test_output_goes_where_a_link_points_and_stays_as_readable(self):
        target, link = self.path / "target.json", self.path / "link.json"
        target.write_text("old")
        target.chmod(0o600)
        link.symlink_to(target)
        self.assertEqual(run("dump", self.scene, "-o", link).returncode, 0)
        self.assertTrue(link.is_symlink())
        dangling = self.path / "dangling.json"
        dangling.symlink_to("made.json")
        self.assertEqual(run("dump", self.scene, "-o", dangling).returncode, 0)
        self.assertTrue(dangling.is_symlink() and (self.path / "made.json").is_file())
        self.assertEqual((json.loads(target.read_text())["format"], target.stat().st_mode & 0o777), ("gjk-recording", 0o600))
        self.assertEqual(json.loads(run("dump", self.scene, "-o", "/dev/stdout").stdout)["format"], "gjk-recording")  # a link to a pipe

    def test_verify_and_diff(self):
        a, b = self.path / "a.json", self.path / "b.json"
        run("dump", self.scene, "-o", a)
        run("dump", self.scene, "--scalar", "float", "-o", b)
        self.assertEqual(run("verify", a, b).returncode, 0)
        missing = run("verify", a, self.path / "missing", b)
        self.assertEqual((missing.returncode, missing.stdout.count("same")), (2, 2))
        self.assertIn("missing", missing.stderr)
        cut = subprocess.run(f"{PROGRAM} dump {self.scene} | head -c 10", shell=True, capture_output=True, text=True)
        self.assertEqual((len(cut.stdout), cut.stderr), (10, ""))
        self.assertEqual(run("diff", a, a).returncode, 0)
        result = run("diff", a, b)
        self.assertEqual(result.returncode, 1)
        self.assertIn("event 0: direction", result.stdout)
        self.assertIn("The methods are not the same", result.stdout)
        recording = json.loads(a.read_text())
        recording["events"][1]["w"][0] += 1
        result = run("verify", self.write("altered.json", recording))
        self.assertEqual(result.returncode, 1)
        self.assertIn("event 1: w", result.stdout)

    def test_whole_numbers_are_decimal_however_written(self):
        for text, number in ("010", 10), ("0512", 512), ("08", 8), ("1e2", 100), ("7.0", 7):
            recording = json.loads(run("dump", self.scene, "--max-iterations", text).stdout)
            self.assertEqual(recording["method"]["max_iterations"], number, text)
        self.refused(run("dump", self.scene, "--max-iterations", "2.5"), "--max-iterations", "whole number from 1", "2.5")
        self.refused(run("dump", self.scene, "--tolerance", "1e-3", "--tolerance", "1e-4"), "--tolerance: given 2 times")

    def test_files_named_on_standard_input_are_looked_for_here(self):
        self.write("quad.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n")
        scene = json.dumps({"format": "gjk-scene", "version": 1, "dimension": 3, "bodies": [{"shape": {"type": "mesh", "mesh": "quad.obj"}}, {"shape": {"type": "sphere", "radius": 1}, "pose": {"position": [0, 0, 3]}}]})
        for command in "dump", "query":
            result = run(command, "-", input=scene, cwd=self.path)
            self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertEqual(json.loads(result.stdout)["signed_distance"], 2)

    def test_a_solver_that_complains_without_end_has_its_time_limit(self):
        with open("/dev/null", "w") as nowhere:
            result = subprocess.run([PROGRAM, "run", self.scene, "--exec", "yes complaint >&2", "--timeout", "1"], stdout=subprocess.PIPE, stderr=nowhere, text=True, timeout=60)
        self.assertEqual(result.returncode, 1)
        self.assertIn("timeout", result.stdout)

    def test_query_answers_each_line_as_it_comes(self):
        with subprocess.Popen([PROGRAM, "query", "-"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as program:
            for k in range(3):
                program.stdin.write(json.dumps({**CUBES, "id": k}) + "\n")
                program.stdin.flush()
                self.assertEqual(json.loads(program.stdout.readline())["id"], k)  # before the next is asked
            program.stdin.write(json.dumps({**CUBES, "id": "without an end"}))
            program.stdin.close()
            self.assertEqual(json.loads(program.stdout.read())["id"], "without an end")
            self.assertEqual(program.wait(timeout=60), 0)

    def test_query_stops_when_nobody_reads(self):
        # As long as it reads, there is more; the files are for the statuses.
        line = self.write("line", json.dumps(CUBES))
        script = 'yes "$(cat "$1")" | { "$2" query -; echo $? > "$3"; } | head -1'
        result = subprocess.run(["bash", "-c", script, "bash", line, PROGRAM, self.path / "status"], capture_output=True, text=True, timeout=120)
        self.assertTrue(json.loads(result.stdout)["intersecting"])
        self.assertEqual((self.path / "status").read_text(), "0\n")

    def test_query_in_order_with_bad_lines(self):
        lines = [json.dumps({**CUBES, "id": i}) for i in range(20)]
        lines[3] = "{nonsense"
        lines[7] = json.dumps({**CUBES, "id": "seven", "dimension": 9})
        lines[11] = ""
        pairs = self.write("pairs.jsonl", "\n".join(lines) + "\n")
        for jobs in (1, 3):
            result = run("query", pairs, "--jobs", jobs)
            self.assertEqual(result.returncode, 2)
            answers = [json.loads(line) for line in result.stdout.splitlines()]
            self.assertEqual(len(answers), 19)
            self.assertEqual((answers[3]["line"], answers[3]["error"]["code"]), (4, "bad-json"))
            self.assertEqual((answers[7]["id"], answers[7]["line"], answers[7]["error"]["where"]), ("seven", 8, "/dimension"))
            self.assertEqual([a["id"] for a in answers if "error" not in a], [i for i in range(20) if i not in (3, 7, 11)])
        self.assertEqual(run("query", self.write("good.jsonl", lines[0] + "\n")).returncode, 0)
        # Ids come back as they were, whatever they are.
        broken = '{"id": {"n": 5}, "format": "gjk-scene", "x": -1e400'
        for line in (broken + "}", broken, broken + ', "x": 1, "x": 1}'):
            path = self.path / "broken.jsonl"
            path.write_text(line + "\n")
            self.assertEqual(json.loads(run("query", path).stdout)["id"], {"n": 5})
        ids = ["12345678901234567890123", "-0.10000000000000000000001", '{"a": [1, {"id": 2.50}], "b, }": "\\"]"}', "[1e2, null]", '"\\u00e9"', "true", "null"]
        lines = [json.dumps(CUBES)[:-1] + ', "id" : ' + i + broken for i in ids for broken in ("}", ', "dimensoin": 1}')]
        answers = run("query", self.write("ids.jsonl", "\n".join(lines))).stdout.splitlines()
        self.assertEqual([json.loads(a)["id"] for a in answers], [json.loads(i) for i in ids for _ in range(2)])
        for i, answer in zip(ids[:2], answers[::2]):
            self.assertIn(f'"id":{i},', answer)
        dumped = json.loads(run("dump", self.write("id.json", {**CUBES, "id": {"a": [1, 2.5]}})).stdout)
        self.assertEqual(dumped["scene"]["id"], {"a": [1, 2.5]})
        self.assertEqual(run("query", "-", input=lines[0]).returncode, 0)
        expecting = json.dumps({**CUBES, "expect": {"intersecting": False}})
        self.assertEqual(run("query", self.write("expect.jsonl", expecting)).returncode, 1)

    def test_scenes_lists_the_gallery(self):
        result = run("scenes")
        self.assertEqual(result.returncode, 0)
        names = [line.split()[0] for line in result.stdout.splitlines()]
        self.assertEqual(sorted(names), sorted(p.name.removesuffix(".scene.json") for p in (ROOT / "recordings/gallery").glob("*.scene.json")))

    def test_a_limit_is_no_answer(self):
        for scene, flags in (("box-box-deep", ()), ("boolean-hit-3d", ("--scalar", "float")), ("mpr-box-box", ()), ("pair-hull-hull", ()), ("sphere-in-box", ()), ("stopping-jolt", ()), ("two-unit-cubes", ("--name", "gjk-accelerated"))):
            recording = self.path / "limit.recording.json"
            self.assertIn(run("dump", scene, "--max-iterations", 1, *flags, "-o", recording).returncode, (0, 1))
            result = json.loads(recording.read_text())["result"]
            if result["status"] == "iteration_limit":
                low, high = result.get("lower_bound"), result.get("upper_bound")
                self.assertEqual(result["intersecting"], False if low is not None and low > 0 else True if high is not None and high < 0 else None, scene)
            self.assertEqual(run("verify", recording).returncode, 0)
            self.assertEqual(run("check", recording).stdout, "no findings: every step holds\n", scene)

    def test_a_cast_at_its_limit_is_never_late(self):
        recording = self.path / "cast.recording.json"
        for scene, name in (("cast-slow-approach", "conservative-advancement"), ("cast-slow-approach", "root-finding"), ("cast-rotating-rod", "conservative-advancement")):
            run("dump", scene, "--name", "root-finding", "-o", recording)
            meet = json.loads(recording.read_text())["result"]["touching_at"]
            for limit in (1, 2, 3, 4, 6, 8, 16):
                run("dump", scene, "--name", name, "--max-iterations", limit, "-o", recording)
                result = json.loads(recording.read_text())["result"]
                self.assertLessEqual(result["time"], meet, (scene, name, limit))
                self.assertEqual(result["intersecting"], True if result["status"] == "hit" else None)
                self.assertEqual(run("check", recording).stdout, "no findings: every step holds\n", (scene, name, limit))

    @unittest.skipUnless("render" in run("--help").stdout, "built without the view")
    def test_render(self):
        recording = self.path / "cubes.recording.json"
        run("dump", self.scene, "-o", recording)
        pictures = []
        for step in ("0", "3", "last", "-1"):
            out = self.path / f"step{step}.png"
            result = run("render", recording, "--step", step, "-o", out, "--width", 640, "--height", 400)
            self.assertEqual((result.returncode, result.stderr), (0, ""))
            pictures.append(out.read_bytes())
            self.assertEqual(pictures[-1][1:4], b"PNG")
        self.assertEqual(len(set(pictures)), 3)  # -1 is the last
        svg = self.path / "step.svg"
        self.assertEqual(run("render", self.scene, "--step", 3, "-o", svg).returncode, 0)
        root = xml.etree.ElementTree.fromstring(svg.read_text())
        self.assertGreater(len(list(root.iter("{http://www.w3.org/2000/svg}line"))), 20)
        # A long sentence does not run out of the picture, and nothing of it is lost.
        self.assertEqual(run("render", "accelerated-newton", "--step", 3, "-o", svg, "--width", 640, "--height", 480).returncode, 0)
        texts = [t for t in xml.etree.ElementTree.fromstring(svg.read_text()).iter("{http://www.w3.org/2000/svg}text") if t.get("x") == "16.00" and t.get("font-size") == "12.00"]
        self.assertGreater(len(texts), 3)
        self.assertTrue(all(len(t.text) * 7.2 <= 640 - 32 and float(t.get("y")) <= 480 for t in texts))
        self.assertRegex(" ".join(t.text for t in texts), "^The curvature of the bodies .* at least that far apart\\.$")
        by_sat = self.path / "sat.svg"
        self.assertEqual(run("render", self.scene, "--step", 3, "--method", "sat", "-o", by_sat).returncode, 0)
        self.assertIn("Support along an axis", by_sat.read_text())
        self.refused(run("render", recording, "--method", "sat", "-o", by_sat), "/format")
        gif = self.path / "replay.gif"
        self.assertEqual(run("render", "2d-deep", "--all", "-o", gif, "--width", 320, "--height", 200).returncode, 0)
        self.assertEqual(gif.read_bytes()[:6], b"GIF89a")
        self.refused(run("render", self.scene, "--step", 999, "-o", svg), "--step 999")
        self.refused(run("render", self.scene, "-o", self.path / "picture.bmp"), "picture.bmp")
        for name in ("picture.svg", "picture.png"):
            self.refused(run("render", self.scene, "--all", "-o", self.path / name), name, ".gif")
            self.assertFalse((self.path / name).exists())
        self.refused(run("render", self.scene, "--all", "--step", 3, "-o", gif), "--step 3")
        self.refused(run("render", self.scene, "-o", ""), "--output")
        self.refused(run("view", "no-such.scene.json"), "no-such.scene.json")  # before a display is asked for

    def test_without_a_gallery(self):
        for name in ("cubes.png", "cubes.svg", "cubes.gif"):
            result = run("render", self.scene, *(["--all", "--width", 64, "--height", 64] if name.endswith("gif") else []), "-o", self.path / name, environment={"GJKDBG_GALLERY": "/nope"})
            self.assertEqual((result.returncode, result.stderr), (0, ""), name)
        self.refused(run("scenes", environment={"GJKDBG_GALLERY": "/nope"}), "/nope/lessons.json: cannot be read")
        if "GJKDBG_GALLERY" not in os.environ:
            self.assertEqual(run("scenes", environment={"GJKDBG_GALLERY": ""}).stdout, run("scenes").stdout)

    def test_chart(self):
        folder = self.path / "chart"
        result = run("chart", "--quick", "-o", folder)
        self.assertEqual(result.returncode, 0, result.stderr)
        chart = json.loads((folder / "chart.json").read_text())
        self.assertGreaterEqual(len(chart["families"]), 9)
        for family in chart["families"]:
            self.assertTrue(any(p["front"] for p in family["points"]))
            # MPR has no shortest way out, and says so; other libraries, where installed, are as they are.
            ours = ("signed volumes", "Johnson", "Voronoi regions", "accelerated", "Polyak", "Newton", "smoothed", "SAT")
            tight = [p for p in family["points"] if p["tolerance"] <= 1e-10 and p["method"] in ours]
            self.assertTrue(tight)
            self.assertTrue(all(str(p["worst_pair"]) in family["scenes"] for p in family["points"]))
            for p in tight:  # accuracy, never time, decides
                self.assertEqual(p["wrong"], 0, (family["name"], p))
                self.assertLessEqual(p["worst_error"], 1e-7, (family["name"], p))
        self.assertEqual((folder / "chart.csv").read_text().count("\n"), 1 + sum(len(f["points"]) for f in chart["families"]))
        # More than a scene needs is computed nowhere: fewer supports for less.
        price = {p["what"]: p for p in chart["price"]}
        self.assertLess(price["boxes, yes or no"]["supports"], price["boxes, distance"]["supports"])
        self.assertLess(price["boxes, distance"]["supports"], price["boxes, penetration"]["supports"])
        self.assertAlmostEqual(price["spheres as centre and radius"]["supports"], 2)
        ladder = {(p["shapes"], p["distance"], p["method"]): p for p in chart["ladder"]}
        self.assertLess(ladder["ellipsoids", 1, "plain"]["iterations"], ladder["ellipsoids", 1, "Nesterov"]["iterations"])  # as published
        self.assertLess(2 * ladder["ellipsoids", 0.001, "Newton"]["iterations"], ladder["ellipsoids", 0.001, "plain"]["iterations"])
        # What is published stands beside what is measured; the spheres come nearer to the sphere with their vertices, and never quite.
        self.assertEqual(ladder["ellipsoids", 0.001, "Nesterov"]["published"], {"iterations": 7, "deviation": 2})
        self.assertEqual(ladder["hulls of 2500", 0.001, "plain"]["published_nanoseconds"], 4100)
        errors = [price[f"the same as hulls of {n} vertices"]["worst_error"] for n in (42, 162, 642, 2562, 10242)]
        self.assertEqual(errors, sorted(errors, reverse=True))
        self.assertTrue(1e-5 < errors[-1] < 1e-3 < errors[0] < 0.3, errors)
        for drawing in ("chart", "gap", "ladder", "price", "motion"):
            for kind in ("svg", "png"):
                self.assertGreater((folder / f"{drawing}.{kind}").stat().st_size, 10000, drawing)

    def test_chart_of_chosen_families_and_methods(self):
        folder = self.path / "chart"
        self.assertEqual(run("chart", "--quick", "--families", "capsules-apart,octagons-2d", "--methods", "default,mpr", "-o", folder).returncode, 0)
        chart = json.loads((folder / "chart.json").read_text())
        self.assertEqual([f["name"] for f in chart["families"]], ["capsules-apart", "octagons-2d"])
        self.assertEqual({p["method"] for f in chart["families"] for p in f["points"]}, {"signed volumes", "MPR", "MPR, float"})
        self.assertTrue((folder / "chart.png").exists() and not (folder / "ladder.png").exists())
        self.refused(run("chart", "--families", "bananas", "-o", folder), "bananas")
        for methods in "bananas", "default,bananas", "":
            self.refused(run("chart", "--methods", methods, "-o", folder), "bananas" if methods else "no method has this name")
        self.refused(run("chart", "--quick", "-o", "/proc"), "/proc")
        # A name with a comma in it; families that no chosen method answers.
        self.assertEqual(run("chart", "--quick", "--families", "boxes-apart", "--methods", "SAT, float,rule of Bullet", "-o", folder).returncode, 0)
        chart = json.loads((folder / "chart.json").read_text())
        self.assertEqual({p["method"] for p in chart["families"][0]["points"]}, {"SAT, float", "rule of Bullet"})
        nothing = run("chart", "--quick", "--families", "hulls-apart", "--methods", "closed form", "-o", self.path / "nothing")
        self.assertEqual((nothing.returncode, nothing.stderr), (0, "gjkdbg: nothing to chart: none of these methods answers in these families\n"))
        self.assertEqual({p.name for p in (self.path / "nothing").iterdir()}, {"chart.csv", "chart.json"})

    def test_interrupted_measuring_keeps_what_was_done(self):
        for command in ("chart", "atlas"):
            folder = self.path / f"interrupted-{command}"
            program = subprocess.Popen([PROGRAM, command, "-o", str(folder)], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
            for _ in range(500):  # until it measures
                if folder.exists():
                    break
                time.sleep(0.02)
            program.send_signal(signal.SIGINT)
            self.assertIn(f"gjkdbg: interrupted: {folder} holds what was done until then\n", program.communicate(timeout=120)[1])
            self.assertEqual(program.returncode, 0)
            json.loads((folder / f"{command}.json").read_text())

    def test_atlas_and_its_gate(self):
        folder = self.path / "atlas"
        kept = ROOT / "tests/kept/atlas-quick.json"
        some = ("--method", "default", "--method", "mpr") if SANITIZED else ()  # all take minutes with sanitizers
        result = run("atlas", "--quick", *some, "-o", folder, "--gate", kept)
        self.assertEqual(result.returncode, 0, result.stdout)
        atlas = json.loads((folder / "atlas.json").read_text())
        for family in atlas["families"]:
            for cell in family["cells"]:
                good = ["right", "right-within-rounding"]
                moving = family["name"] in ("T1", "T2")
                if cell["method"] in ("SAT", "closed form", "projections", "root finding", "ray cast") or moving and cell["method"] in ("yes or no", "fastest") or moving and cell["method"] in ("accelerated", "Polyak", "Newton", "smoothed"):
                    good.append("not-applicable")  # round shapes; all but balls and segments; hulls; what does not move; other directions
                if cell["method"] in ("signed volumes", "Johnson", "Voronoi regions", "accelerated", "Polyak", "Newton", "smoothed", "SAT", "closed form", "projections", "fastest", "yes or no", "root finding", "ray cast"):
                    self.assertIn(cell["verdict"], good, (family["name"], cell["method"]))
                if cell["verdict"] not in (*good, "not-applicable"):
                    self.assertIn(cell["method"], cell["why"])
                    self.assertEqual(len(cell["scene"]["bodies"]), 2)
        verdicts = {(f["name"], c["method"]): c["verdict"] for f in atlas["families"] for c in f["cells"]}
        self.assertIn(verdicts["T2", "signed volumes"], ("right", "right-within-rounding"))
        if not some:
            for cell in ("C3", "closed form"), ("T1", "root finding"), ("T1", "ray cast"), ("T2", "root finding"):
                self.assertIn(verdicts[cell], ("right", "right-within-rounding"))
        self.assertEqual(verdicts["K3", "MPR"], "wrong-value")  # as the literature has it: not the shortest way out, and its bounds admit it
        # One method alone.
        result = run("atlas", "--quick", "--method", "johnson", "-o", self.path / "one", "--gate", kept)
        self.assertEqual(result.returncode, 0, result.stdout)
        self.assertRegex(result.stdout, r"\ngate: \d\d cells compared, none worse than kept or not measured\n$")
        one = json.loads((self.path / "one/atlas.json").read_text())
        self.assertEqual({c["method"] for f in one["families"] for c in f["cells"]}, {"Johnson", "Johnson, float"})
        # What was kept of all cases says of fewer only how bad they may be.
        result = run("atlas", "--quick", "--method", "johnson", "-o", self.path / "one", "--gate", ROOT / "tests/kept/atlas.json")
        self.assertEqual(result.returncode, 0, result.stdout)
        # Chosen families.
        result = run("atlas", "--quick", "--method", "default", "--families", "C6,K1", "-o", self.path / "two", "--gate", kept)
        self.assertRegex(result.stdout, r"\ngate: 2 cells compared, none worse than kept or not measured\n$")
        self.assertEqual([f["name"] for f in json.loads((self.path / "two/atlas.json").read_text())["families"]], ["C6", "K1"])
        self.refused(run("atlas", "--families", "C66", "-o", self.path / "none"), "C66")
        self.assertFalse((self.path / "none").exists())
        # Drawn, with rows in words and in colours, whatever the folder's name is and however few columns there are.
        self.assertEqual(run("atlas", "--quick", "--method", "default", "-o", self.path / "it's\nalone").returncode, 0)
        drawn = (self.path / "it's\nalone/atlas.svg").read_text()
        for part in "flat plates", "a ball's centre in, on and at the corner of a cube", "signed volumes", "right within rounding":
            self.assertIn(part, drawn.replace("&#39;", "'").replace("&apos;", "'"))
        self.assertGreater(drawn.count("rgb(  0, 158, 115)"), 10)
        self.refused(run("atlas", "--method", "bananas", "-o", folder), "bananas")
        # A kept result that was better than it can be: the gate closes.
        better = json.loads(kept.read_text())
        for family in better["families"]:
            for cell in family["cells"]:
                cell["verdict"] = "right"
        result = run("atlas", "--quick", "--method", "johnson", "-o", folder, "--gate", self.write("better.json", better))
        self.assertEqual(result.returncode, 1)
        self.assertIn("worse than kept", result.stdout)
        self.assertRegex(result.stdout, r"\ngate: \d\d cells compared, [1-9]\d* worse than kept or not measured\n$")
        # As bad as before, and more often, or by more.
        worst = next((f, c) for f in atlas["families"] for c in f["cells"] if c["method"] == "MPR" and c["verdict"] == "wrong-value")
        for change, told in ({"failed": worst[1]["failed"] - 1}, "wrong-value in "), ({"worst_error": worst[1]["worst_error"] / 20}, "wrong-value, error "):
            cell = {"format": "gjk-atlas", "version": 1, "families": [{**worst[0], "cells": [{**worst[1], **change}]}]}
            result = run("atlas", "--quick", "--method", "mpr", "--families", worst[0]["name"], "-o", folder, "--gate", self.write("cell.json", cell))
            self.assertEqual(result.returncode, 1)
            self.assertIn(f"worse than kept: {worst[0]['name']}, MPR: {told}", result.stdout)
        self.refused(run("atlas", "--quick", "-o", folder, "--gate", self.scene), "/format")
        for change, place in ({"version": 99}, "/version"), ({"families": 5}, "/families"), ({"families": []}, "/families"), ({"families": [{"name": "K1", "cells": "x"}]}, "/families/0/cells"), ({"families": [7]}, "/families/0"):
            self.refused(run("atlas", "--quick", "-o", folder, "--gate", self.write("odd.json", {**better, **change})), place)
        # What was answered and is no longer, and what was kept and is not there.
        better["families"].append({"name": "Z9", "cells": [{"method": "Johnson", "verdict": "right"}]})
        result = run("atlas", "--quick", "--method", "johnson", "-o", folder, "--gate", self.write("more.json", better))
        self.assertEqual(result.returncode, 1)
        self.assertIn("kept, but not measured: Z9, Johnson: right", result.stdout)

    def test_meshes_are_relative_to_the_scene_and_stand_in_the_recording(self):
        self.write("tetra.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n")
        scene = {**CUBES, "bodies": [{"shape": {"type": "hull", "mesh": "tetra.obj"}}, CUBES["bodies"][1]]}
        path = self.write("mesh.scene.json", scene)
        recording = json.loads(run("dump", path, cwd="/").stdout)
        self.assertEqual(len(recording["scene"]["bodies"][0]["shape"]["points"]), 4)
        self.assertEqual(run("verify", self.write("mesh.recording.json", recording)).returncode, 0)
        self.write("tetra.obj", "v 0 0 0\nv 1\0.5 0 0\n")  # what stands behind a NUL byte would be lost
        self.refused(run("dump", path), "/bodies/0/shape/mesh: ", "tetra.obj: line 2: a vertex needs three numbers")


unittest.main()
