#!/usr/bin/python3
"""Includes point one way: shapes <- algo <- recordings <- debugger; the view's pictures know no window. Sizes stay readable."""
import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent
ROOMS = ["shapes", "algo", "recordings", "debugger", "tests"]
# What a room may include of the world outside.
BANNED = {
    "shapes": ["nlohmann", "imgui", "GLFW", "epoxy", "EGL", "simdjson"],
    "algo": ["nlohmann", "imgui", "GLFW", "epoxy", "EGL", "simdjson", "qhull"],
    "recordings": ["imgui", "GLFW", "epoxy", "EGL"],
}
# Within debugger/, by folder: render draws; view shows what render draws; commands run either.
INNER = {"debugger/lab": ["debugger/lab"], "debugger/solver": ["debugger/solver"], "debugger/render": ["debugger/render"], "debugger/view": ["debugger/render", "debugger/view"]}


def sources(room):
    return [p for p in (ROOT / room).rglob("*") if p.suffix in (".h", ".cpp")]


def includes(path):
    return re.findall(r'^\s*#\s*include\s+[<"]([^>"]+)[>"]', path.read_text(), re.M)


class IncludeGraph(unittest.TestCase):
    def test_rooms_include_downwards_only(self):
        for rank, room in enumerate(ROOMS):
            self.assertTrue(sources(room), room)
            for path in sources(room):
                for name in includes(path):
                    top = name.split("/")[0]
                    if top in ROOMS:
                        self.assertLessEqual(ROOMS.index(top), rank, f"{path.relative_to(ROOT)} includes {name}")

    def test_rooms_know_only_their_libraries(self):
        for room, banned in BANNED.items():
            for path in sources(room):
                for name in includes(path):
                    for library in banned:
                        self.assertNotIn(library, name, f"{path.relative_to(ROOT)} includes {name}")

    def test_debugger_folders_include_downwards_only(self):
        for folder, allowed in INNER.items():
            for path in (ROOT / folder).rglob("*"):
                if path.suffix not in (".h", ".cpp"):
                    continue
                for name in includes(path):
                    if name.startswith("debugger/"):
                        self.assertIn(str(pathlib.Path(name).parent), allowed, f"{path.relative_to(ROOT)} includes {name}")

    def test_no_cycles_among_headers(self):
        graph = {}
        for room in ROOMS:
            for path in sources(room):
                graph[str(path.relative_to(ROOT))] = [n for n in includes(path) if n.split("/")[0] in ROOMS]
        state = {}

        def visit(node, trail):
            self.assertNotEqual(state.get(node), 1, " -> ".join(trail + [node]))
            if state.get(node) == 2:
                return
            state[node] = 1
            for target in graph.get(node, []):
                visit(target, trail + [node])
            state[node] = 2

        for node in graph:
            visit(node, [])

    def test_files_stay_readable(self):
        for room in ROOMS:
            for path in sources(room):
                self.assertLessEqual(len(path.read_text().splitlines()), 400, path.relative_to(ROOT))

    def test_packages_stand_in_one_list(self):
        listed = re.findall(r"^(?:build|view|tests)\s+(\S+)", (ROOT / "debugger/packages.txt").read_text(), re.M)
        self.assertEqual(len(listed), len(set(listed)))
        for script in ("debugger/start", "tests/run", ".ci/run"):
            for package in listed:
                if package.startswith("lib"):
                    self.assertNotIn(package, (ROOT / script).read_text(), script)


unittest.main()
