"""The papers' figures: the listing agrees with the scripts, the command finds them, verdicts are honest."""

import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
FIGURES = ROOT / "paper_figures"
BINARY = os.environ.get("PLAT_BINARY", str(ROOT / "build" / "release" / "plat"))
sys.path[:0] = [str(FIGURES)]

from figure import BOUNDS, Figure, FigureError, bound_of, listing  # noqa: E402

ENTRIES = listing()
KEYS = {"id", "paper", "figure", "title", "script", "datasets", "run_time_s", "caption", "stands_in", "claims"}


def plat(*arguments, **environment):
    return subprocess.run([BINARY, *arguments], capture_output=True, text=True, check=False, timeout=600,
                          env={**os.environ, **environment})


class Listing(unittest.TestCase):
    def test_every_entry_says_all_there_is_to_say(self):
        for entry in ENTRIES.values():
            with self.subTest(figure=entry["id"]):
                self.assertEqual(set(entry), KEYS)
                for key in KEYS - {"datasets", "run_time_s", "claims"}:
                    self.assertTrue(entry[key])
                self.assertGreater(entry["run_time_s"], 0)

    def test_every_figure_has_a_claim_with_one_bound_and_its_reason(self):
        for entry in ENTRIES.values():
            with self.subTest(figure=entry["id"]):
                self.assertTrue(entry["claims"])
                keys = [c["key"] for c in entry["claims"]]
                self.assertEqual(len(keys), len(set(keys)))
                for claim in entry["claims"]:
                    self.assertEqual(len([k for k in BOUNDS if k in claim]), 1, claim["key"])
                    for word in ("text", "measure", "why"):
                        self.assertTrue(claim[word], claim["key"])

    def test_scripts_and_listing_name_each_other(self):
        listed = {entry["script"]: entry for entry in ENTRIES.values()}
        scripts = {str(p.relative_to(FIGURES)) for p in FIGURES.glob("*/fig*.py")}
        self.assertEqual(scripts, set(listed))
        for script, entry in listed.items():
            self.assertIn(f'make("{entry["id"]}", draw)', (FIGURES / script).read_text(encoding="utf-8"), script)

    def test_data_sets_are_in_the_catalogue(self):
        known = {d["name"] for d in json.loads(plat("list", "datasets", "--json").stdout)}
        for entry in ENTRIES.values():
            self.assertLessEqual(set(entry["datasets"]), known, entry["id"])

    def test_the_catalogue_tells_where_observed_layers_are(self):
        known = {d["name"]: d["observed"] for d in json.loads(plat("data", "list", "--json").stdout)}
        self.assertEqual(known["cambridge_ma"]["streets"]["fields"]["class"], "MajorRoad")
        for entry in ENTRIES.values():
            for name in entry["datasets"]:
                self.assertTrue({"parcels", "streets"} & set(known[name]), name)

    def test_scripts_name_the_data_sets_they_read(self):
        for entry in ENTRIES.values():
            text = (FIGURES / entry["script"]).read_text(encoding="utf-8")
            named = set(re.findall(r'(?:Window\(|"dataset":)\s*"(\w+)"', text))
            self.assertEqual(named, set(entry["datasets"]), entry["id"])


class Claims(unittest.TestCase):
    """With a figure of its own, so that no plat runs."""

    def figure(self, **claim):
        claim = {"key": "a", "text": "t", "measure": "m", "why": "w", **claim}
        figure = Figure.__new__(Figure)
        figure.id, figure.entry, figure._measured = "x/y", {"claims": [claim]}, {}
        return figure

    def verdict(self, value, **bound):
        figure = self.figure(**bound)
        figure.measured("a", value)
        return figure.verdicts()[0]["verdict"]

    def test_verdicts_follow_the_bound(self):
        for bound, value, expected in [("at_most", 1.0, "PASS"), ("at_most", 1.1, "FAIL"), ("at_least", 1.0, "PASS"),
                                       ("at_least", 0.9, "FAIL"), ("below", 1.0, "FAIL"), ("above", 1.0, "FAIL"),
                                       ("above", 1.1, "PASS"), ("below", 0.9, "PASS")]:
            self.assertEqual(self.verdict(value, **{bound: 1.0}), expected, (bound, value))

    def test_what_could_not_be_measured_fails(self):
        for bound in BOUNDS:
            self.assertEqual(self.verdict(float("nan"), **{bound: 1.0}), "FAIL")

    def test_a_claim_that_nobody_measured_ends_the_figure(self):
        with self.assertRaises(FigureError):
            self.figure(at_most=1.0).verdicts()

    def test_a_claim_that_is_not_listed_ends_the_figure(self):
        with self.assertRaises(FigureError):
            self.figure(at_most=1.0).measured("b", 1.0)


class Command(unittest.TestCase):
    def assert_refused(self, result, *words):
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
        for word in words:
            self.assertIn(word, result.stderr)

    def test_lists_every_figure(self):
        result = plat("figure", "--list")
        self.assertEqual(result.returncode, 0, result.stderr)
        for identifier, entry in ENTRIES.items():
            self.assertIn(identifier, result.stdout)
            self.assertIn(entry["title"], result.stdout)

    def test_refuses_what_it_does_not_know(self):
        self.assert_refused(plat("figure", "vkw12/fig1l"), "vkw12/fig1l", "did you mean")
        self.assert_refused(plat("figure"), "--list")
        self.assert_refused(plat("figure", "vkw12", PLAT_FIGURES_DIR="/nonexistent"), "/nonexistent", "PLAT_FIGURES_DIR")

    def test_a_missing_city_is_named_with_its_source(self):
        self.assert_refused(plat("figure", "vkw12/fig11", PLAT_DATA_DIR="/nonexistent"),
                            "san_roman_es", "/nonexistent", "Catastro")

    def test_draws_a_figure_that_needs_no_city(self):
        entry = next(e for e in ENTRIES.values() if not e["datasets"])
        with tempfile.TemporaryDirectory() as out:
            result = plat("figure", entry["id"], "--out", out)
            self.assertIn(result.returncode, (0, 1), result.stderr)
            for ending in ("pdf", "png", "json"):
                self.assertTrue((pathlib.Path(out) / f"{entry['id']}.{ending}").stat().st_size > 0)
            record = json.loads((pathlib.Path(out) / f"{entry['id']}.json").read_text(encoding="utf-8"))
            self.assertEqual([c["key"] for c in record["claims"]], [c["key"] for c in entry["claims"]])
            holds = all(c["verdict"] == "PASS" for c in record["claims"])
            self.assertEqual(result.returncode, 0 if holds else 1)
            for claim, listed in zip(record["claims"], entry["claims"]):
                self.assertEqual(claim["bound"], dict([bound_of(listed)]))


if __name__ == "__main__":
    unittest.main()
