#!/usr/bin/python3
"""The pages and the program's help name what there is: commands, flags and their values, events and their fields, files."""
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRAM = os.path.abspath(sys.argv.pop(1))
PAGES = [ROOT / page for page in ("README.md", "algo/README.md", "recordings/README.md", "debugger/solver/README.md")]
FORMATS = (ROOT / "recordings/README.md").read_text()


def run(*arguments):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)


def help_of(*command):
    return run(*command, "--help").stdout


def quoted(text):
    return re.findall(r"`([^` ]+)`", text)


def rows(text):
    """Of a page's tables: what the first cell names, and the other cells."""
    return {name: rest for first, rest in re.findall(r"^\| (`[^|]*) \| (.*) \|$", text, re.MULTILINE) for name in quoted(first)}


class Documents(unittest.TestCase):
    def test_every_command(self):
        commands = re.findall(r"^  ([a-z]+)  +[A-Z]", help_of().split("Subcommands:")[1], re.MULTILINE)
        self.assertGreaterEqual(len(commands), 10)
        pages = "".join(page.read_text() for page in PAGES)
        for command in commands:
            self.assertRegex(pages, rf"gjkdbg {command}\b")
            self.assertIn("Exit status: 0 done; 1 ", help_of(command))

    def test_every_setting_of_the_method(self):
        table = rows(FORMATS[FORMATS.index("`method`, all fields optional"):FORMATS.index("## Motion")])
        flags = help_of("dump").split("Method (overrides the scene's):")[1]
        listed = dict(re.findall(r"^  --([a-z_]+)(?:,\S+)? [A-Z]+(?::\{([^}]*)\})?", flags, re.MULTILINE))
        self.assertEqual(set(listed) - {"start_from"}, set(table) - {"initial_simplex"})
        self.assertIn("--start-from", table["initial_simplex"])
        for name, values in listed.items():
            for value in filter(None, values.split(",")):
                self.assertIn(f"`{value}`", FORMATS if name == "name" else table[name], name)

    def test_every_event_has_its_fields(self):
        kinds = {}

        def collect(value):
            if isinstance(value, dict):
                properties = value.get("properties")
                if isinstance(properties, dict) and isinstance(properties.get("kind"), dict) and "const" in properties["kind"]:
                    kinds[properties["kind"]["const"]] = set(properties) - {"kind"}
            for part in value.values() if isinstance(value, dict) else value if isinstance(value, list) else ():
                collect(part)

        collect(json.loads((ROOT / "recordings/schema/recording.schema.json").read_text()))
        self.assertGreater(len(kinds), 20)
        table = rows(FORMATS)
        for kind, fields in kinds.items():
            cell = re.sub(r"\[\{.*?\}\]|\([^()]*\)", "", table[kind]).split(";")[0]
            self.assertEqual(set(quoted(cell)), fields, kind)

    def test_every_file(self):
        for page in PAGES:
            for name in re.findall(r"[`(]([a-zA-Z_][\w/.-]*\.(?:h|cpp|py|js|java|png|txt|md))[`)]", page.read_text()):
                if page.parent.name == "solver" and name == "first.py":
                    continue  # to be written
                self.assertTrue(any((folder / name).exists() for folder in (ROOT, page.parent)), f"{page}: {name}")

    def test_the_lab_takes_its_methods_by_either_name(self):
        with tempfile.TemporaryDirectory() as folder:
            for command in ("chart", "atlas"):
                for flag in ("--method", "--methods"):
                    result = run(command, flag, "nosuch", "-o", folder)
                    self.assertEqual(result.returncode, 2)
                    self.assertIn("nosuch: no method has this name; there are default;", result.stderr)


unittest.main()
