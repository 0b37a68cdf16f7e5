"""The program street_growth on a window of a city, and the pictures of it."""

import csv
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = pathlib.Path(os.environ.get("PLAT_BINARY", str(ROOT / "build" / "release" / "plat"))).parent / "street_growth"
FOLDER = ROOT / "experiments" / "street_growth"
DATA = pathlib.Path(os.environ.get("PLAT_DATA_DIR", "/nowhere"))
CONFIG = {"cities": [{"dataset": "cambridge_ma", "window": [230500, 901000, 232500, 903000]}, {"dataset": "delft_nl"}],
          "strategies": "all", "reference": "nearest", "seeds": 2, "ablation_seeds": 1, "tile_m": 400,
          "ablations": [{"label": "near only", "options": {"neighbours": 3}}, {"label": "no levels", "flatten": "hierarchy"}],
          "resamples": 50, "permutations": 50, "routes": {"sources": 10, "targets": 5}}


def run(*arguments):
    return subprocess.run([str(a) for a in arguments], capture_output=True, text=True, check=False, timeout=600)


def rows_of(path):
    with open(path, encoding="utf-8", newline="") as table:
        return list(csv.DictReader(table))


class StreetGrowth(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.out = pathlib.Path(folder.name)

    def run_config(self, config, *more):
        (self.out / "config.json").write_text(json.dumps(config), encoding="utf-8")
        return run(PROGRAM, "--config", self.out / "config.json", "--out", self.out / "run", *more)

    @unittest.skipUnless((DATA / "cambridge_ma").is_dir(), "needs cambridge_ma in PLAT_DATA_DIR (plat data list)")
    def test_a_window_is_regrown_compared_and_drawn(self):
        result = self.run_config(CONFIG)
        self.assertEqual(result.returncode, 1, result.stderr)  # Delft has no streets: skipped, and said so
        cells = rows_of(self.out / "run" / "cells.csv")
        ok = [row for row in cells if row["status"] == "ok"]
        skipped = [row for row in cells if row["status"] == "skipped"]
        self.assertEqual([row["dataset"] for row in skipped], ["delft_nl"])
        self.assertIn("no streets", skipped[0]["message"])
        variants = {row["variant"] for row in ok}
        self.assertLessEqual({"nearest", "relative_neighbourhood", "near only", "no levels"}, variants)
        self.assertEqual(len(ok), 2 * len(variants - {"near only", "no levels"}) + 2)
        for row in ok:
            self.assertEqual(row["recovered_edges"], row["true_edges"])
            self.assertGreater(float(row["f1_edges_01"]), 0.3)
            self.assertTrue(row["commit"] and row["options"])
        # `nearest` does not look at levels: nothing changes without them, and the difference is nothing.
        differences = [r for r in rows_of(self.out / "run" / "differences.csv") if r["variant"] == "no levels"]
        self.assertEqual({float(r["difference"]) for r in differences}, {0.0})
        self.assertEqual({float(r["p_holm"]) for r in differences}, {1.0})
        drawn = run(sys.executable, FOLDER / "draw_growth.py", self.out / "run")
        self.assertEqual(drawn.returncode, 0, drawn.stderr)
        for name in ("recovery.png", "distances.png", "map_cambridge_ma.png"):
            self.assertGreater((self.out / "run" / name).stat().st_size, 5000)
        self.assertIn("| nearest |", (self.out / "run" / "tables.md").read_text(encoding="utf-8"))

    @unittest.skipUnless((DATA / "cambridge_ma").is_dir(), "needs cambridge_ma in PLAT_DATA_DIR (plat data list)")
    def test_the_number_of_threads_changes_nothing(self):
        texts = []
        config = {**CONFIG, "cities": CONFIG["cities"][:1]}
        for jobs in (1, 3):
            self.assertEqual(self.run_config(config, "--jobs", jobs).returncode, 0)
            tables = ("recovery.csv", "differences.csv", "distances.csv", "scalars.csv")
            texts.append([(self.out / "run" / name).read_bytes() for name in tables])
        self.assertEqual(texts[0], texts[1])

    def test_bad_input_is_refused_in_one_line(self):
        result = self.run_config({**CONFIG, "strategies": [{"name": "nearist"}]})
        self.assertEqual(result.returncode, 2)
        self.assertEqual(len(result.stderr.splitlines()), 1)
        self.assertIn("did you mean", result.stderr)


if __name__ == "__main__":
    unittest.main()
