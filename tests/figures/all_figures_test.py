"""Every figure of every paper is drawn, as far as its cities are here. A claim that fails is no failure of this test."""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BINARY = os.environ.get("PLAT_BINARY", str(ROOT / "build" / "release" / "plat"))
sys.path[:0] = [str(ROOT / "paper_figures")]

from figure import listing  # noqa: E402


def plat(*arguments):
    return subprocess.run([BINARY, *arguments], capture_output=True, text=True, check=False, timeout=900)


class AllFigures(unittest.TestCase):
    def test_are_drawn_with_a_verdict_on_every_claim(self):
        here = {d["name"] for d in json.loads(plat("list", "datasets", "--json").stdout) if d["is_present"]}
        drawn = 0
        with tempfile.TemporaryDirectory() as out:
            for entry in listing().values():
                if not set(entry["datasets"]) <= here:
                    continue
                with self.subTest(figure=entry["id"]):
                    result = plat("figure", entry["id"], "--out", out)
                    self.assertIn(result.returncode, (0, 1), result.stderr)
                    base = pathlib.Path(out) / entry["id"]
                    record = json.loads(base.with_suffix(".json").read_text(encoding="utf-8"))
                    verdicts = [claim["verdict"] for claim in record["claims"]]
                    self.assertEqual(len(verdicts), len(entry["claims"]))
                    self.assertEqual(result.returncode, 1 if "FAIL" in verdicts else 0)
                    for ending in (".png", ".pdf"):
                        self.assertGreater(base.with_suffix(ending).stat().st_size, 5000)
                    drawn += 1
        self.assertGreater(drawn, 0)


if __name__ == "__main__":
    unittest.main()
