"""The program tile_displacement on a few tiles of a city, and the pictures of it."""

import csv
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = pathlib.Path(os.environ.get("PLAT_BINARY", str(ROOT / "build" / "release" / "plat"))).parent / "tile_displacement"
FOLDER = ROOT / "experiments" / "tile_displacement"
DATA = pathlib.Path(os.environ.get("PLAT_DATA_DIR", "/nowhere"))
WAYS = [{"name": "rigid", "options": {"rigidity": 1000, "keep_size": 1}}, {"name": "affine", "options": {"rigidity": 1}},
        {"name": "warp", "by": "warp"}]
CONFIG = {"cities": [{"dataset": "cambridge_ma", "tiles": 150}], "displacements_m": [5, 10], "groups": 2, "group_radius_m": 30,
          "reach_m": 60, "ways": WAYS, "resamples": 50}


def run(*arguments):
    return subprocess.run([str(a) for a in arguments], capture_output=True, text=True, check=False, timeout=600)


def rows_of(path):
    with open(path, encoding="utf-8", newline="") as table:
        return list(csv.DictReader(table))


class TileDisplacement(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.out = pathlib.Path(folder.name)

    def run_config(self, config, *more):
        (self.out / "config.json").write_text(json.dumps(config), encoding="utf-8")
        return run(PROGRAM, "--config", self.out / "config.json", "--out", self.out / "run", *more)

    @unittest.skipUnless((DATA / "cambridge_ma").is_dir(), "needs cambridge_ma in PLAT_DATA_DIR (plat data list)")
    def test_every_way_has_a_row_and_a_warp_bends_what_is_to_stay(self):
        result = self.run_config(CONFIG)
        self.assertEqual(result.returncode, 0, result.stderr)
        rows = rows_of(self.out / "run" / "displacements.csv")
        self.assertEqual(len(rows), 2 * 2 * 3)
        for row in rows:
            self.assertEqual(row["status"], "ok")
            self.assertEqual(int(row["moved_tiles"]) + int(row["free_tiles"]) + int(row["held_tiles"]), 150)
            self.assertEqual(float(row["gap_m"]) == 0.0, row["way"] == "warp")
            if row["way"] == "warp":
                self.assertGreater(float(row["held_deformation"]), 0.0)
                self.assertGreater(float(row["largest_held_off_m"]), 0.01)
        # Nearly linear: a group that goes farther has more tiles within its reach.
        gap_m = {(r["group"], r["displacement_m"]): float(r["gap_m"]) for r in rows if r["way"] == "affine"}
        for group in ("0", "1"):
            self.assertAlmostEqual(gap_m[group, "10"] / gap_m[group, "5"], 2.0, delta=0.2)
        drawn = run(sys.executable, FOLDER / "draw.py", self.out / "run")
        self.assertEqual(drawn.returncode, 0, drawn.stderr)
        self.assertGreater((self.out / "run" / "ways.png").stat().st_size, 5000)

    @unittest.skipUnless((DATA / "cambridge_ma").is_dir(), "needs cambridge_ma in PLAT_DATA_DIR (plat data list)")
    def test_the_number_of_threads_changes_nothing(self):
        texts = []
        for jobs in (1, 3):
            self.assertEqual(self.run_config(CONFIG, "--jobs", jobs).returncode, 0)
            texts.append([(self.out / "run" / name).read_bytes() for name in ("displacements.csv", "curves.csv", "cities.csv")])
        self.assertEqual(texts[0], texts[1])

    def test_bad_input_is_refused_in_one_line(self):
        result = self.run_config({**CONFIG, "cities": [{"dataset": "cambridge_mm"}]})
        self.assertEqual(result.returncode, 2)
        self.assertEqual(len(result.stderr.splitlines()), 1)
        self.assertIn("cambridge_mm", result.stderr)


if __name__ == "__main__":
    unittest.main()
