"""The program rcksp_scaling on a small grid of every registered search, and the pictures of it."""

import csv
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = pathlib.Path(os.environ.get("PLAT_BINARY", str(ROOT / "build" / "release" / "plat"))).parent / "rcksp_scaling"
FOLDER = ROOT / "experiments" / "rcksp_scaling"
CONFIG = {"strategies": "all", "rounds": 3, "time_limit_s": 30, "cell_budget_s": 0.1,
          "studies": [{"name": "street", "vary": "length_m", "values": [30, 40], "set": {"elements": 10, "length_slack_m": 2}},
                      {"name": "k", "vary": "k", "values": [1, 5], "set": {"elements": 10, "length_m": 40, "length_slack_m": 2}}]}


def run(*arguments):
    return subprocess.run([str(a) for a in arguments], capture_output=True, text=True, check=False, timeout=600)


class RckspScaling(unittest.TestCase):
    def test_every_search_agrees_on_a_small_grid_and_is_drawn(self):
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder)
            (out / "config.json").write_text(json.dumps(CONFIG), encoding="utf-8")
            result = run(PROGRAM, "--config", out / "config.json", "--out", out)
            self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
            with open(out / "cells.csv", encoding="utf-8") as table:
                rows = list(csv.DictReader(table))
            names = {row["name"] for row in rows}
            self.assertGreater(len(names), 0)
            self.assertEqual(len(rows), 4 * len(names))
            self.assertEqual({row["status"] for row in rows}, {"ok"})
            for value in ("1", "5"):
                costs = {(row["found"], row["cost"]) for row in rows if row["study"] == "k" and row["value"] == value}
                self.assertEqual(len(costs), 1)
            manifest = json.loads((out / "manifest.json").read_text(encoding="utf-8"))
            self.assertEqual(set(manifest["build"]) & {"commit", "compiler"}, {"commit", "compiler"})
            drawn = run(sys.executable, FOLDER / "draw_scaling.py", out)
            self.assertEqual(drawn.returncode, 0, drawn.stderr)
            for name in ("scaling", "memory", "states"):
                self.assertGreater((out / f"{name}.png").stat().st_size, 5000)

    def test_bad_input_is_refused_in_one_line(self):
        with tempfile.TemporaryDirectory() as folder:
            config = pathlib.Path(folder) / "config.json"
            config.write_text(json.dumps({**CONFIG, "strategies": [{"name": "layerd"}]}), encoding="utf-8")
            result = run(PROGRAM, "--config", config, "--out", folder)
            self.assertEqual(result.returncode, 2)
            self.assertEqual(len(result.stderr.splitlines()), 1)
            self.assertIn("did you mean", result.stderr)


if __name__ == "__main__":
    unittest.main()
