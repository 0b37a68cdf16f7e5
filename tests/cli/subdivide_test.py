"""plat subdivide: what it writes is a coverage with measures, and what it cannot divide is a row."""

import itertools
import math
import unittest

from plat_cli import DONE, FAILURES, CliTest, plat, read_layer, rectangle, write_layer
from shapely.geometry import shape
from shapely.ops import unary_union

STRATEGIES = ("obb", "skeleton", "voronoi")
COURTYARD = [rectangle(200, 0, 90, 80), list(reversed(rectangle(230, 30, 20, 20)))]
L_SHAPE = [[(0, 100), (100, 100), (100, 150), (50, 150), (50, 200), (0, 200), (0, 100)]]


class Subdivide(CliTest):
    def divide(self, blocks, strategy, *more, out="out.gpkg"):
        return plat("subdivide", "--blocks", blocks, "--strategy", strategy, *more, "--out", self.path(out))

    def parcels(self, out="out.gpkg"):
        return read_layer(self.path(out), "parcels")

    def test_parcels_cover_their_blocks_once(self):
        blocks = self.blocks([rectangle(0, 0, 120, 60)], COURTYARD, L_SHAPE)
        expected = {i: shape(g).area for i, (_, g) in enumerate(read_layer(blocks, "blocks"))}
        for strategy in STRATEGIES:
            with self.subTest(strategy=strategy):
                self.assert_status(self.divide(blocks, strategy), DONE)
                rows = self.parcels()
                self.assertGreater(len(rows), 3 * len(expected))
                for block, area in expected.items():
                    shapes = [shape(g) for p, g in rows if p["block_id"] == block]
                    self.assertTrue(all(s.is_valid and s.area > 0 for s in shapes))
                    # The output is on a grid of 2^-10 m: a contour may move by a millimetre along its length.
                    self.assertAlmostEqual(sum(s.area for s in shapes), area, delta=1.0)
                    self.assertAlmostEqual(unary_union(shapes).area, sum(s.area for s in shapes), places=6)
                    self.assert_no_overlap(shapes)

    def assert_no_overlap(self, shapes):
        for a, b in itertools.combinations(shapes, 2):
            self.assertEqual(a.intersection(b).area, 0.0)

    def test_rows_carry_ids_strategy_and_true_measures(self):
        self.assert_status(self.divide(self.blocks([rectangle(0, 0, 120, 60)]), "obb"), DONE)
        rows = self.parcels()
        self.assertEqual([p["parcel_id"] for p, _ in rows], [str(i) for i in range(len(rows))])
        for properties, geometry in rows:
            polygon = shape(geometry)
            self.assertEqual(properties["strategy"], "obb")
            self.assertAlmostEqual(properties["area_m2"], polygon.area, places=6)
            self.assertAlmostEqual(properties["perimeter_m"], polygon.length, places=6)
            compactness = 4 * math.pi * polygon.area / polygon.length**2
            self.assertAlmostEqual(properties["compactness"], compactness, places=9)
        self.assertEqual(read_layer(self.path("out.gpkg"), "failures"), [])

    def test_parcels_say_which_feature_they_came_from(self):
        blocks = self.blocks([rectangle(0, 0, 0, 60)], [rectangle(50, 0, 60, 60)])
        self.assert_status(self.divide(blocks, "obb"), FAILURES)
        source = {p["block_id"]: p["source_id"] for p, _ in read_layer(self.path("out.gpkg"), "blocks")}
        self.assertEqual({source[p["block_id"]] for p, _ in self.parcels()}, {"2"}, "the second feature")
        self.assertEqual([p["block_id"] for p, _ in read_layer(self.path("out.gpkg"), "failures")], ["1"])

    def test_the_output_keeps_the_blocks_place_and_crs(self):
        blocks = self.blocks([rectangle(0, 0, 120, 60)])
        self.assert_status(self.divide(blocks, "voronoi"), DONE)
        union = unary_union([shape(g) for _, g in self.parcels()])
        original = shape(read_layer(blocks, "blocks")[0][1])
        self.assertLess(union.symmetric_difference(original).area, 1.0)

    def test_streets_say_where_frontage_is(self):
        blocks = self.blocks([rectangle(0, 0, 120, 60)])
        streets = write_layer(self.path("streets.gpkg"), "streets", [[(-10, -6), (130, -6)]], kind="LineString")
        self.assert_status(self.divide(blocks, "obb", "--streets", streets), DONE)
        frontage = sum(p["frontage_m"] for p, _ in self.parcels())
        self.assertAlmostEqual(frontage, 120.0, delta=1.0)

    def test_observed_parcels_fit_the_options(self):
        blocks = self.blocks([rectangle(0, 0, 120, 60)], [rectangle(0, 100, 120, 60)])
        narrow = [[rectangle(6 * i, 0, 6, 60)] for i in range(20)]
        wide = [[rectangle(40 * i, 100, 40, 60)] for i in range(3)]
        observed = write_layer(self.path("observed.gpkg"), "parcels", narrow + wide)
        for strategy in STRATEGIES:
            with self.subTest(strategy=strategy):
                self.assert_status(self.divide(blocks, strategy, "--observed", observed), DONE)
                count = [sum(p["block_id"] == b for p, _ in self.parcels()) for b in (0, 1)]
                self.assertGreater(count[0], 2 * count[1], "many narrow parcels against three wide ones")

    def test_set_wins_over_the_fit(self):
        blocks = self.blocks([rectangle(0, 0, 120, 60)])
        observed = write_layer(self.path("observed.gpkg"), "parcels", [[rectangle(6 * i, 0, 6, 60)] for i in range(20)])
        more = ("--observed", observed, "--set", "area_mean_m2=3600")
        self.assert_status(self.divide(blocks, "voronoi", *more), DONE)
        self.assertEqual(len(self.parcels()), 2)

    def test_a_block_without_observed_parcels_is_a_row(self):
        blocks = self.blocks([rectangle(0, 0, 120, 60)], [rectangle(0, 100, 120, 60)])
        observed = write_layer(self.path("observed.gpkg"), "parcels", [[rectangle(0, 0, 60, 60)]])
        self.assert_status(self.divide(blocks, "obb", "--observed", observed), FAILURES)
        failures = read_layer(self.path("out.gpkg"), "failures")
        self.assertEqual([(p["block_id"], p["code"]) for p, _ in failures], [("1", "no_observation")])

    def test_a_trace_shows_the_splits_and_leaves_the_parcels_as_they_are(self):
        blocks = self.blocks([rectangle(0, 0, 120, 60)], [rectangle(200, 0, 90, 80)])
        trace = self.path("trace.gpkg")
        self.assert_status(self.divide(blocks, "obb", "--trace", trace, out="watched.gpkg"), DONE)
        self.assert_status(self.divide(blocks, "obb"), DONE)
        self.assertEqual(self.parcels("watched.gpkg"), self.parcels())
        splits = read_layer(trace, "splits")
        for block in (0, 1):
            parcels = [p for p, _ in self.parcels() if p["block_id"] == block]
            depths = [p["number"] for p, _ in splits if p["block_id"] == block]
            self.assertEqual(len(depths) + 1, len(parcels))  # a split of a rectangle adds one parcel
            self.assertEqual(min(depths), 0)
        self.assertEqual(len(read_layer(trace, "lot_boxes")), len(splits))

    def test_a_trace_that_cannot_be_written_is_refused_first(self):
        blocks = self.blocks([rectangle(0, 0, 120, 60)])
        for trace, word in ((self.path("out.gpkg"), "--out"), (blocks, "input"), (self.path("trace.csv"), ".gpkg")):
            self.assert_refused(self.divide(blocks, "obb", "--trace", trace), "--trace", word)
        self.assert_only("blocks.gpkg")

    def test_same_seed_same_bytes_whatever_the_threads(self):
        blocks = self.blocks([rectangle(0, 0, 120, 60)], COURTYARD, L_SHAPE)
        for strategy in STRATEGIES:
            outputs = set()
            for jobs in (1, 2, 4):
                self.assert_status(self.divide(blocks, strategy, "--seed", 5, "--jobs", jobs), DONE)
                outputs.add(self.path("out.gpkg").read_bytes())
            self.assertEqual(len(outputs), 1, strategy)
            self.assert_status(self.divide(blocks, strategy, "--seed", 6), DONE)
            self.assertNotIn(self.path("out.gpkg").read_bytes(), outputs, f"{strategy}: another seed, other parcels")


if __name__ == "__main__":
    unittest.main()
