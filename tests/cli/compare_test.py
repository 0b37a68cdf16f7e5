"""plat compare: any two parcel layers; a layer with itself has distance 0 everywhere."""

import csv
import json
import unittest

from plat_cli import DONE, FAILURES, CliTest, plat, read_layer, rectangle, write_layer


def rows_of(path):
    with open(path, newline="", encoding="utf-8") as text:
        return list(csv.DictReader(text))


class Compare(CliTest):
    def setUp(self):
        super().setUp()
        # Six blocks of five parcels, none like another.
        self.shapes = [
            [rectangle(150 * b + 20 * k, 10 * k, 20, 30 + 7 * b + 3 * k)] for b in range(6) for k in range(5)
        ]
        self.layer = write_layer(self.path("parcels.gpkg"), "parcels", self.shapes)
        self.out = self.path("out")

    def compare(self, observed, generated, *more):
        return plat("compare", observed, generated, "--out", self.out, "--resamples", 50, *more)

    def test_a_layer_with_itself_has_distance_0(self):
        self.assert_status(self.compare(self.layer, f"{self.layer}:parcels"), DONE)
        rows = rows_of(self.out / "distances.csv")
        self.assertEqual({r["distance"] for r in rows}, {"ks", "wasserstein", "jensen_shannon"})
        for row in rows:
            self.assertEqual(float(row["value"]), 0.0, row)
            self.assertLessEqual(float(row["ci_low"]), 0.0, row)
        blocks = rows_of(self.out / "blocks.csv")
        self.assertEqual({float(r["ks_area"]) for r in blocks}, {0.0})

    def test_other_parcels_have_a_distance(self):
        halves = [[rectangle(150 * b + 20 * k, 10 * k, 10, 30)] for b in range(6) for k in range(5)]
        other = write_layer(self.path("other.gpkg"), "parcels", halves)
        self.assert_status(self.compare(self.layer, other), DONE)
        area = {r["distance"]: float(r["value"]) for r in rows_of(self.out / "distances.csv") if r["measure"] == "area_m2"}
        self.assertEqual(area["ks"], 1.0)
        self.assertGreater(area["wasserstein"], 100.0)

    def test_it_writes_a_run_that_names_its_sources(self):
        self.assert_status(self.compare(self.layer, self.layer), DONE)
        manifest = json.loads((self.out / "manifest.json").read_text())
        self.assertEqual(manifest["experiment"], "compare")
        self.assertEqual(manifest["datasets"][0]["parcels"], 30)
        written = {p.name for p in self.out.iterdir()}
        expected = {"parcels.csv", "blocks.csv", "distances.csv", "differences.csv", "histograms.csv", "summary.json"}
        self.assertLessEqual(expected | {"layout_parcels.gpkg", "manifest.json"}, written)
        self.assertEqual(len(read_layer(self.out / "layout_parcels.gpkg", "observed")), 30)

    def test_a_parcel_outside_every_block_is_a_row(self):
        other = write_layer(self.path("other.gpkg"), "parcels", self.shapes + [[rectangle(0, 900, 20, 20)]])
        self.assert_status(self.compare(self.layer, other), FAILURES)
        rows = [p for p, _ in read_layer(self.out / "layout_parcels.gpkg", "failures")]
        self.assertEqual([(r["block_id"], r["code"]) for r in rows], [("31", "not_covered")])

    def test_another_place_is_refused(self):
        other = write_layer(self.path("other.gpkg"), "parcels", self.shapes, shift=(470000.0, 5550000.0))
        self.assert_refused(self.compare(self.layer, other), "other.gpkg", "none of its 30 parcels", "same place")
        self.assert_only("other.gpkg", "parcels.gpkg")

    def test_another_crs_of_the_same_place_is_reprojected(self):
        source = self.path("parcels.gpkg")
        other = self.path("other.geojson")
        import geopandas

        geopandas.read_file(source).to_crs("EPSG:4326").to_file(other, driver="GeoJSON", engine="fiona")
        self.assert_status(self.compare(self.layer, other), DONE)
        for row in rows_of(self.out / "distances.csv"):
            if row["distance"] == "wasserstein" and row["measure"] == "area_m2":
                self.assertLess(float(row["value"]), 1.0)

    def test_same_seed_same_bytes_whatever_the_threads(self):
        halves = [[rectangle(150 * b + 20 * k, 10 * k, 10, 30)] for b in range(6) for k in range(5)]
        other = write_layer(self.path("other.gpkg"), "parcels", halves)
        seen = set()
        for jobs in (1, 2, 4):
            self.assert_status(self.compare(self.layer, other, "--jobs", jobs, "--seed", 3), DONE)
            seen.add(tuple(p.read_bytes() for p in sorted(self.out.iterdir()) if p.name != "timings.json"))
        self.assertEqual(len(seen), 1)

    def test_missing_layer_is_refused_before_anything_is_written(self):
        self.assert_refused(self.compare(self.layer, f"{self.layer}:parcel"), 'did you mean "parcels"')
        self.assert_only("parcels.gpkg")


if __name__ == "__main__":
    unittest.main()
