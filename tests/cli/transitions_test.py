"""plat transitions: how one step of the random walk sees all points."""

import math
import unittest

import fiona

from plat_cli import BAD_INPUT, CRS, DONE, ORIGIN, CliTest, plat, read_layer, write_layer

STYLE = {"hierarchy": 1, "connections": 2, "tortuosity": 1.0, "distance_mean_m": 100.0, "distance_variance_m2": 400.0,
         "angle_mean_rad": 0.0, "angle_variance_rad2": 0.25, "width_m": 10.0}


def write_points(path, places):
    """One street of level 1 at each place, but for a level of its own where a third number is given."""
    kinds = {"hierarchy": "int", "connections": "int"}
    columns = {f"{side}_{key}": kinds.get(key, "float") for side in "ab" for key in STYLE}
    schema = {"geometry": "Point", "properties": {**columns, "parcel_area_m2": "float"}}
    with fiona.open(path, "w", driver="GPKG", layer="points", schema=schema, crs=CRS) as out:
        for x, y, *level in places:
            row = {f"a_{key}": value for key, value in STYLE.items()} | {f"b_{key}": None for key in STYLE}
            row |= {"a_hierarchy": level[0] if level else 1, "parcel_area_m2": None}
            out.write({"geometry": {"type": "Point", "coordinates": (x + ORIGIN[0], y + ORIGIN[1])}, "properties": row})
    return path


class Transitions(CliTest):
    def survey(self, places, *words):
        out = self.path("targets.gpkg")
        result = plat("transitions", write_points(self.path("points.gpkg"), places), "--out", out, *words)
        self.assert_status(result, DONE)
        return [properties for properties, _ in read_layer(out, "targets")]

    def test_tells_probability_and_bar_of_every_point(self):
        streets = write_layer(self.path("streets.gpkg"), "streets",
                              [[(-100, 0), (0, 0)], [(50, 20), (50, 150)], [(0, -100), (100, -100)], [(0, -100), (-100, -100)]],
                              kind="LineString")
        rows = self.survey([(0, 0), (-100, 0), (120, 0), (80, 80), (100, 30, 2), (300, 0), (0, -100)],
                           "--base", 1, "--from", 2, "--streets", streets)
        self.assertEqual([row["bar"] for row in rows[2:]], ["none", "crossing", "level", "improbable", "improbable"])
        self.assertAlmostEqual(rows[2]["probability"], math.exp(-0.5), places=9)
        # A first step has no turn; below the base, one street has passed already.
        rows = self.survey([(0, 0), (-100, 0), (0, -100)], "--base", 1, "--streets", streets)
        self.assertEqual(rows[2]["bar"], "connections")

    def test_refuses_points_that_are_not_there(self):
        points = write_points(self.path("points.gpkg"), [(0, 0), (100, 0)])
        for words in (["--base", 3], ["--base", 0], ["--base", 1, "--from", 9], ["--base", 1, "--street", "b"]):
            result = plat("transitions", points, "--out", self.path("t.gpkg"), *words)
            self.assert_status(result, BAD_INPUT)
            self.assertFalse(self.path("t.gpkg").exists())


if __name__ == "__main__":
    unittest.main()
