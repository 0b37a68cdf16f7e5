"""plat run: the run directory is whole, the same for any number of threads, and can be resumed."""

import csv
import json
import shutil
import unittest

from plat_cli import BAD_INPUT, DONE, FAILURES, CliTest, catalogue_has, plat, read_layer

CITY = "prague_bubenec_cz"
CONFIG = {
    "experiment": "small",
    "datasets": [CITY],
    "strategies": [
        {"name": "obb"},
        {"name": "skeleton"},
        {"name": "voronoi", "label": "coarse", "options": {"area_mean_m2": 900}, "fit": "none"},
        {"name": "voronoi", "label": "found", "search": {"options": {"rows": ["one", "two"], "row_offset_m": [1, 8]}}},
    ],
    "repetitions": 2,
    "seed": 11,
    "statistics": {"resamples": 50, "permutations": 200, "noise_repetitions": 20},
}
TABLES = ["parcels.csv", "blocks.csv", "distances.csv", "differences.csv", "histograms.csv", "search.csv"]


def contents(folder):
    """Bytes of every file by relative path, but for timings.json, which is the one that may differ."""
    files = (p for p in folder.rglob("*") if p.is_file() and p.name != "timings.json")
    return {str(p.relative_to(folder)): p.read_bytes() for p in files}


def rows_of(path):
    with open(path, newline="", encoding="utf-8") as text:
        return list(csv.DictReader(text))


@unittest.skipUnless(
    catalogue_has(CITY), f"needs PLAT_DATA_DIR with {CITY} (plat data list says how to get it)"
)
class Run(CliTest):
    def setUp(self):
        super().setUp()
        self.config = self.path("config.json")
        self.config.write_text(json.dumps(CONFIG))

    def run_into(self, name, *more):
        folder = self.path(name)
        result = plat("run", self.config, "--out", folder, *more)
        self.assertIn(result.returncode, (DONE, FAILURES), result.stderr)
        self.assertNotIn("plat:", result.stderr)
        return folder

    def assert_same(self, left, right):
        a, b = contents(left), contents(right)
        self.assertEqual(sorted(a), sorted(b))
        self.assertEqual([name for name in a if a[name] != b[name]], [], "files that differ")

    def test_same_bytes_for_1_2_and_4_threads(self):
        one = self.run_into("jobs1", "--jobs", 1)
        for jobs in (2, 4):
            self.assert_same(one, self.run_into(f"jobs{jobs}", "--jobs", jobs))

    def test_resume_gives_the_same_bytes(self):
        whole = self.run_into("whole")
        part = self.path("part")
        shutil.copytree(whole, part)
        cells = sorted((part / "cells").iterdir())
        self.assertEqual(len(cells), 9, "four strategies, two repetitions, one search")
        cells[1].unlink()
        cells[2].write_text("{ half a cel")
        (part / "parcels.csv").unlink()
        (part / "manifest.json").unlink()
        result = plat("run", self.config, "--out", part, "--resume")
        self.assertIn("7 cells taken over", result.stdout)
        self.assert_same(whole, part)

    def test_a_cell_of_another_seed_is_not_taken_over(self):
        folder = self.run_into("out")
        result = plat("run", self.config, "--out", folder, "--resume", "--seed", 12)
        self.assertNotIn("taken over", result.stdout)
        self.assert_same(folder, self.run_into("fresh", "--seed", 12))

    def test_rows_layers_and_manifest_agree(self):
        folder = self.run_into("out")
        manifest = json.loads((folder / "manifest.json").read_text())
        self.assertEqual((manifest["seed"], manifest["repetitions"]), (11, 2))
        self.assertEqual([s["label"] for s in manifest["strategies"]], ["obb", "skeleton", "coarse", "found"])
        for table in TABLES:
            self.assertTrue(rows_of(folder / table), table)
        city = manifest["datasets"][0]
        blocks = rows_of(folder / "blocks.csv")
        parcels = rows_of(folder / "parcels.csv")
        layout = folder / f"layout_{CITY}.gpkg"
        self.assertEqual(sum(r["layer"] == "observed" for r in parcels), city["parcels"])
        for label, repetitions in (("observed", 1), ("obb", 2), ("skeleton", 2), ("coarse", 2),
                                   ("found", 2)):
            of_layer = [r for r in blocks if r["layer"] == label]
            self.assertEqual(len(of_layer), repetitions * city["blocks"])
            count = sum(int(r["parcels"]) for r in of_layer if r["status"] == "ok")
            self.assertEqual(count, sum(r["layer"] == label for r in parcels))
            self.assertEqual(count, len(read_layer(layout, label)))
        refused = sum(r["status"] != "ok" for r in blocks) + city["input_failures"]
        self.assertEqual(refused, len(read_layer(layout, "failures")))
        self.assertFalse([p for p in folder.rglob("*") if ".part" in p.name], "no temporary is left")

    def test_options_that_were_given_are_the_ones_that_ran(self):
        folder = self.run_into("out")
        coarse = [r["options"] for r in rows_of(folder / "blocks.csv") if r["layer"] == "coarse"]
        self.assertTrue(all("area_mean_m2=900" in options for options in coarse))

    def test_found_options_are_the_best_of_the_other_fold_and_the_ones_that_ran(self):
        folder = self.run_into("out")
        rows = rows_of(folder / "search.csv")
        self.assertEqual(len(rows), 2 * 4 * 2, "folds, points, measures")
        chosen = {}
        for fold in ("0", "1"):
            of_fold = [r for r in rows if r["fold"] == fold]
            best = min(of_fold, key=lambda r: float(r["score"]))
            chosen[fold] = {r["options"] for r in of_fold if r["is_chosen"] == "1"}
            self.assertEqual(chosen[fold], {best["options"]})
            ratios = [float(r["ks"]) / float(r["noise_mean"]) for r in of_fold if r["options"] == best["options"]]
            self.assertAlmostEqual(float(best["score"]), sum(ratios) / len(ratios))
        wanted = {frozenset(o.split(";")) for options in chosen.values() for o in options}
        for row in rows_of(folder / "blocks.csv"):
            if row["layer"] == "found":
                self.assertTrue(any(w <= set(row["options"].split(";")) for w in wanted), row["options"])
        city = json.loads((folder / "manifest.json").read_text())["datasets"][0]
        self.assertEqual([(s["layer"], s["fold"]) for s in city["searches"]], [("found", 0), ("found", 1)])

    def test_an_interrupted_run_is_no_run(self):
        folder = self.run_into("out")
        # A second run that is refused while it reads must not leave the first one's manifest on mixed tables.
        (folder / "cells").rename(folder / "kept")
        (folder / "cells").write_text("a file where the folder of cells must be")
        result = plat("run", self.config, "--out", folder, "--seed", 5)
        self.assertEqual(result.returncode, BAD_INPUT, result.stderr)
        self.assertRegex(result.stderr, r"(?m)^plat: .*cells")
        self.assertFalse((folder / "manifest.json").exists())


if __name__ == "__main__":
    unittest.main()
