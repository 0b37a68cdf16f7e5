"""The house rules that a machine can hold the code to (docs/architecture.md)."""

import re
import shutil
import subprocess
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
ALGORITHMS = ROOT / "algorithms"
MAX_LINES = 500


def ours(*suffixes):
    """Files of ours, as git or the folder lists them."""
    folders = ["algorithms", "cli", "experiments", "benchmarks", "tests", "notebooks", "paper_figures", "scripts", "cmake"]
    for folder in folders:
        for path in sorted((ROOT / folder).rglob("*")):
            if path.suffix in suffixes and "__pycache__" not in path.parts:
                yield path


def stage_dependencies():
    """Stage -> the stages its plat_stage() line names."""
    out = {}
    for file in sorted(ALGORITHMS.glob("*/CMakeLists.txt")):
        call = re.search(r"plat_stage\(([^)]*)\)", file.read_text())
        words = call.group(1).split() if call else []
        depends, reading = set(), False
        for word in words:
            if word in ("DEPENDS", "LINK", "LINK_PRIVATE"):
                reading = word == "DEPENDS"
            elif reading:
                depends.add(word)
        out[file.parent.name] = depends
    return out


class Layers(unittest.TestCase):
    def test_a_stage_includes_only_what_its_line_names(self):
        dependencies = stage_dependencies()
        self.assertGreater(len(dependencies), 5)
        for stage, depends in dependencies.items():
            for path in [*(ALGORITHMS / stage).glob("*.h"), *(ALGORITHMS / stage).glob("*.cpp")]:
                for included in re.findall(r'#include "([a-z_]+)/', path.read_text()):
                    self.assertIn(included, depends | {stage}, f"{path.relative_to(ROOT)} includes {included}/")

    def test_stages_depend_one_way(self):
        dependencies = stage_dependencies()

        def visit(stage, path):
            self.assertNotIn(stage, path, " -> ".join([*path, stage]))
            for other in dependencies[stage]:
                visit(other, [*path, stage])

        for stage in dependencies:
            visit(stage, [])

    def test_algorithms_do_not_know_experiments_or_the_command_line(self):
        for path in ours(".h", ".cpp"):
            if ALGORITHMS in path.parents:
                self.assertNotRegex(path.read_text(), r'#include "(harness|cli)/', str(path))

    def test_the_harness_names_no_strategy(self):
        names = re.findall(r'kName = "([a-z_]+)"', "".join(p.read_text() for p in ALGORITHMS.glob("parcels/*_subdivider.h")))
        self.assertGreaterEqual(len(names), 3)
        for path in (ROOT / "experiments" / "harness").glob("*.cpp"):
            for name in names:
                self.assertNotIn(f'"{name}"', path.read_text(), path.name)


class Code(unittest.TestCase):
    def test_cgal_stays_out_of_public_headers(self):
        for path in ours(".h"):
            if not path.name.endswith("_internal.h"):
                self.assertNotIn("#include <CGAL/", path.read_text(), str(path))

    def test_files_are_short(self):
        for path in ours(".h", ".cpp", ".py", ".cmake", ".sh"):
            self.assertLessEqual(len(path.read_text().splitlines()), MAX_LINES, str(path.relative_to(ROOT)))

    def test_no_standard_distribution_or_random_device(self):
        forbidden = re.compile(r"std::(random_device|mt19937|\w+_distribution)")
        for path in ours(".h", ".cpp"):
            if "tests" not in path.parts:
                self.assertIsNone(forbidden.search(path.read_text()), str(path))

    def test_cited_keys_are_in_the_bibliography(self):
        known = set(re.findall(r"@\w+\{(\w+),", (ALGORITHMS / "bibliography.bib").read_text()))
        cited = {}
        for path in ours(".h", ".cpp"):
            for key in re.findall(r"\[([A-Z][A-Za-z]*\d\d[a-z]?|Har|GMN)[\],]", path.read_text()):
                cited.setdefault(key, path)
        self.assertIn("VKW12", cited)
        for key, path in cited.items():
            self.assertIn(key, known, f"{path.relative_to(ROOT)} cites [{key}]")

    def test_cited_decisions_exist(self):
        known = {p.name[:4] for p in (ROOT / "docs" / "adr").glob("[0-9]*.md")}
        for path in ours(".h", ".cpp", ".py"):
            for number in re.findall(r"ADR (\d{4})", path.read_text()):
                self.assertIn(number, known, f"{path.relative_to(ROOT)} cites ADR {number}")

    @unittest.skipUnless(shutil.which("clang-format-19"), "needs clang-format-19 (apt install clang-format-19)")
    def test_formatted(self):
        files = [str(p) for p in ours(".h", ".cpp")]
        result = subprocess.run(["clang-format-19", "--dry-run", "-Werror", *files], capture_output=True, text=True, cwd=ROOT)
        self.assertEqual(result.returncode, 0, result.stderr[:2000])


if __name__ == "__main__":
    unittest.main()
