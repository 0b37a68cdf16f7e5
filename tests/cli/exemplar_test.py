"""plat exemplar: the points of drawn streets, their layers, the window, what is refused."""

import unittest

from plat_cli import DONE, ORIGIN, CliTest, catalogue_has, plat, read_layer, rectangle, write_layer

# A main street, two that cross it, one that ends at it.
STREETS = [
    [(0, 0), (600, 0)],
    [(100, -200), (100, 200)],
    [(300, -150), (300, 150)],
    [(450, 0), (450, 180)],
]


class Exemplar(CliTest):
    def streets(self, lines=STREETS):
        return write_layer(self.path("city.gpkg"), "roads", lines, kind="LineString")

    def take(self, *more, city=None):
        return plat("exemplar", city or self.streets(), *more, "--out", self.path("points.gpkg"))

    def rows(self, layer):
        return read_layer(self.path("points.gpkg"), layer)

    def point_at(self, x, y):
        for properties, geometry in self.rows("points"):
            east, north = geometry["coordinates"]
            if abs(east - ORIGIN[0] - x) < 0.01 and abs(north - ORIGIN[1] - y) < 0.01:
                return properties
        self.fail(f"no point at {x}, {y}")

    def test_points_lie_where_streets_meet_or_end(self):
        result = self.take()
        self.assert_status(result, DONE)
        self.assertEqual(len(self.rows("points")), 3 + 7)
        self.assertIn("points: 10, 0 of them near parcels", result.stdout)
        self.assertIn("streets: 4 of 9 pieces", result.stdout)
        self.assertIn("hierarchy 0: 1 streets", result.stdout)
        self.assertIn("hierarchy 1: 3 streets", result.stdout)
        crossing = self.point_at(100, 0)
        self.assertEqual((crossing["a_hierarchy"], crossing["b_hierarchy"]), (0, 1))
        self.assertEqual((crossing["a_connections"], crossing["b_connections"]), (2, 2))
        self.assertAlmostEqual(crossing["a_distance_mean_m"], 150.0, places=6)
        self.assertEqual(self.point_at(450, 0)["b_connections"], 1)
        self.assertIsNone(self.point_at(0, 0)["b_hierarchy"])

    def test_pieces_and_chains_say_which_street_they_are(self):
        self.assert_status(self.take(), DONE)
        pieces, chains = self.rows("streets"), self.rows("chains")
        self.assertEqual(len(pieces), 9)
        self.assertEqual(len(chains), 4)
        hierarchy = {p["chain"]: p["hierarchy"] for p, _ in chains}
        for properties, _ in pieces:
            self.assertEqual(properties["hierarchy"], hierarchy[properties["chain"]])
        self.assertEqual(self.point_at(100, 0)["a_chain"], next(c for c, h in hierarchy.items() if h == 0))

    def test_the_streets_it_writes_give_the_same_points(self):
        self.assert_status(self.take(), DONE)
        again = plat("exemplar", f"{self.path('points.gpkg')}:streets", "--out", self.path("again.gpkg"))
        self.assert_status(again, DONE)
        first, second = self.rows("points"), read_layer(self.path("again.gpkg"), "points")
        for (a, at_a), (b, at_b) in zip(first, second, strict=True):
            self.assertEqual(at_a["coordinates"], at_b["coordinates"])
            self.assertEqual(
                {k: v for k, v in a.items() if not k.endswith("chain")},
                {k: v for k, v in b.items() if not k.endswith("chain")},
            )

    def test_parcels_nearby_give_an_area(self):
        parcels = write_layer(self.path("parcels.gpkg"), "parcels", [[rectangle(10, 10, 20, 20)]])
        result = self.take("--parcels", parcels)
        self.assert_status(result, DONE)
        self.assertAlmostEqual(self.point_at(0, 0)["parcel_area_m2"], 400.0, places=6)
        self.assertIsNone(self.point_at(600, 0)["parcel_area_m2"])
        self.assertIn("1 of them near parcels", result.stdout)

    def test_window_leaves_out_streets_that_leave_it(self):
        x, y = ORIGIN
        result = self.take("--window", f"{x - 10},{y - 160},{x + 320},{y + 160}")
        self.assert_status(result, DONE)
        # The main street up to 300, the street there; the pieces of the one at 100 reach too far.
        self.assertEqual(len(self.rows("streets")), 3)
        self.assertEqual(len(self.rows("points")), 4)

    def test_options_change_what_a_street_is(self):
        self.assert_status(self.take("--set", "main_share_01=1"), DONE)
        self.assertEqual({p["a_hierarchy"] for p, _ in self.rows("points")}, {0})

    def test_bad_input_is_refused_in_one_line(self):
        city = self.streets()
        for more, words in [
            (("--set", "main_share=1"), ("main_share", "main_share_01")),
            (("--set", "main_share_01=3"), ("main_share_01", "3", "0", "1")),
            (("--set", "continuity=names"), ("continuity", "name_or_direction")),
            (("--window", "1,2,3"), ("--window 1,2,3", "MINX")),
            (("--window", "5,5,1,1"), ("--window", "empty")),
            (("--window", "0,0,1,1"), ("no street", "window")),
            (("--parcels", self.path("none.gpkg")), ("none.gpkg",)),
        ]:
            with self.subTest(more=more):
                self.assert_refused(self.take(*more, city=city), *words)
        self.assert_refused(plat("exemplar", "atlantis", "--out", self.path("points.gpkg")), "atlantis")
        self.assert_refused(plat("exemplar", city, "--out", city), "city.gpkg")
        self.assert_only("city.gpkg")

    def test_a_data_set_is_taken_by_its_name(self):
        if not catalogue_has("cambridge_ma"):
            self.skipTest("needs the data set cambridge_ma")
        result = self.take(city="cambridge_ma")
        self.assert_status(result, DONE)
        rows = self.rows("points")
        self.assertGreater(len(rows), 1800)
        self.assertLess(len(rows), 2000)
        near = sum(p["parcel_area_m2"] is not None for p, _ in rows)
        self.assertGreater(near, 0.9 * len(rows))


if __name__ == "__main__":
    unittest.main()
