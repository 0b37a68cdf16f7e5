"""plat reconfigure: a script is replayed on tiles, what it wrote is read back without loss, imagery goes along."""

import json
import re
import unittest

from osgeo import gdal
from plat_cli import DONE, FAILURES, ORIGIN, ROOT, CliTest, catalogue_has, plat, read_layer, write_layer
from shapely.geometry import shape
from shapely.ops import unary_union

gdal.UseExceptions()
GRID = [[(100 * c, 0), (100 * c, 240)] for c in range(4)] + [[(0, 80 * r), (300, 80 * r)] for r in range(4)]


def at(x, y):
    return [ORIGIN[0] + x, ORIGIN[1] + y]


class Reconfigure(CliTest):
    def city(self):
        streets = write_layer(self.path("streets.gpkg"), "roads", GRID, kind="LineString")
        self.assert_status(plat("blocks", "--streets", streets, "--out", self.path("blocks.gpkg")), DONE)
        return self.path("blocks.gpkg")

    def reconfigure(self, city, *operations, out="out.gpkg", defaults=None, more=()):
        script = self.path("script.json")
        script.write_text(json.dumps({"defaults": defaults or {}, "operations": operations}))
        return plat("reconfigure", script, "--city", city, "--out", self.path(out), "--strategy", "obb", *more)

    def tiles(self, out="out.gpkg"):
        return {p["tile"]: (p, shape(g)) for p, g in read_layer(self.path(out), "tiles")}

    def same(self, a, b):
        return self.path(a).read_bytes() == self.path(b).read_bytes()

    MOVE = {"do": "move", "tiles": {"window": [*at(100, 80), *at(200, 160)]}, "by": [2, 1]}

    def test_parcels_become_tiles_and_blocks_are_not_divided(self):
        self.assert_status(self.reconfigure(self.city()), DONE)
        tiles = self.tiles()
        self.assertGreater(len(tiles), 9)
        self.assertEqual(read_layer(self.path("out.gpkg"), "parcels"), [])
        blocks = unary_union([shape(g) for _, g in read_layer(self.path("out.gpkg"), "blocks")])
        land = unary_union([g for _, g in tiles.values()])
        self.assertLess(land.symmetric_difference(blocks).area, 1.0)

    def test_a_move_takes_streets_along_and_says_so(self):
        city = self.city()
        self.assert_status(self.reconfigure(city, out="before.gpkg"), DONE)
        pins = {"do": "pin", "tiles": {"all": True}}
        result = self.reconfigure(city, pins, self.MOVE)
        self.assert_status(result, DONE)
        self.assertRegex(
            result.stdout,
            r"operation 2 move: \d+ tiles named; \d+ moved, 0 new, 0 gone; mean gap 0.\d+ -> 0.\d+ m, "
            r"across streets .* deformation .* streets: \d+ nodes moved, 4 widths, blocks 9 changed",
        )
        before, after = self.tiles("before.gpkg"), self.tiles()
        moved = [i for i in before if before[i][1].centroid.distance(after[i][1].centroid) > 0.1]
        for i in moved:
            x, y = before[i][1].centroid.x - ORIGIN[0], before[i][1].centroid.y - ORIGIN[1]
            self.assertTrue(100 < x < 200 and 80 < y < 160)
            self.assertAlmostEqual(after[i][1].centroid.x, before[i][1].centroid.x + 2, places=2)
        self.assertGreater(len(moved), 0)
        widths = sorted(p["width_m"] for p, _ in read_layer(self.path("out.gpkg"), "streets"))
        self.assertLess(widths[0], widths[len(widths) // 2] - 0.5)
        self.assertGreater(widths[-1], widths[len(widths) // 2] + 0.5)

    def test_fronts_that_stand_in_their_street_are_said(self):
        pins = {"do": "pin", "tiles": {"all": True}}
        apart = self.reconfigure(self.city(), pins, {**self.MOVE, "by": [11, 0]})
        self.assertRegex(apart.stdout, r"2 widths, blocks 9 changed")
        inside = self.reconfigure(self.city(), pins, {**self.MOVE, "by": [11.8, 0]})
        self.assertRegex(inside.stdout, r"2 widths, 1 of them with fronts in the street, blocks 9 changed")

    def test_the_output_is_read_back_without_loss_by_both_commands(self):
        paste = [{"do": "copy", "tiles": {"at": at(30, 30)}, "as": "a"}, {"do": "paste", "group": "a", "to": at(230, 130)}]
        self.reconfigure(self.city(), self.MOVE, *paste)
        self.assert_status(self.reconfigure(self.path("out.gpkg"), out="again.gpkg"), DONE)
        self.assertTrue(self.same("out.gpkg", "again.gpkg"))
        edits = self.path("edits.json")
        edits.write_text('{"edits": []}')
        self.assert_status(plat("edit", edits, "--city", self.path("out.gpkg"), "--out", self.path("edited.gpkg")), DONE)
        self.assertTrue(self.same("out.gpkg", "edited.gpkg"))

    def test_a_script_in_two_halves_is_the_same(self):
        city = self.city()
        cut = {"do": "cut", "tiles": {"at": at(30, 30)}}
        self.assert_status(self.reconfigure(city, self.MOVE, cut, out="whole.gpkg"), DONE)
        self.assert_status(self.reconfigure(city, self.MOVE, out="half.gpkg"), DONE)
        self.assert_status(self.reconfigure(self.path("half.gpkg"), cut, out="two.gpkg"), DONE)
        self.assertTrue(self.same("whole.gpkg", "two.gpkg"))

    def test_undo_gives_the_file_before_and_redo_the_file_after(self):
        city = self.city()
        undo, redo = {"do": "undo"}, {"do": "redo"}
        self.assert_status(self.reconfigure(city, out="none.gpkg"), DONE)
        self.assert_status(self.reconfigure(city, self.MOVE, out="moved.gpkg"), DONE)
        self.assert_status(self.reconfigure(city, self.MOVE, undo, out="undone.gpkg"), DONE)
        self.assert_status(self.reconfigure(city, self.MOVE, undo, redo, out="redone.gpkg"), DONE)
        self.assertTrue(self.same("none.gpkg", "undone.gpkg"))
        self.assertTrue(self.same("moved.gpkg", "redone.gpkg"))
        self.assertFalse(self.same("none.gpkg", "moved.gpkg"))

    def test_a_refused_operation_is_said_and_the_others_go_on(self):
        unknown = {"do": "move", "tiles": {"ids": [99999]}, "by": [1, 0]}
        empty = {"do": "pin", "tiles": {"zone": "harbour"}}
        result = self.reconfigure(self.city(), unknown, {"do": "undo"}, empty, self.MOVE)
        self.assert_status(result, FAILURES)
        self.assertIn("operation 1 move: refused, unknown_entity: there is no tile 99999", result.stdout)
        self.assertIn("operation 2 undo: refused", result.stdout)
        self.assertIn("operation 3 pin: refused, unknown_entity: operations[2].tiles: no tile is selected", result.stdout)
        self.assertRegex(result.stdout, r"operation 4 move: \d+ tiles named")
        self.assertIn("3 of 4 operations refused", result.stdout)

    def test_bad_scripts_are_refused_with_the_path(self):
        city = self.city()
        one = {"ids": [1]}
        cases = [
            ({"do": "mov"}, ("operations[0].do", 'did you mean "move"')),
            ({"do": "move", "tiles": one}, ("operations[0]", "by, to or angle_deg")),
            ({"do": "move", "tiles": {}, "by": [1, 0]}, ("operations[0].tiles", "one or more of")),
            ({"do": "move", "tiles": {"id": [1]}, "by": [1, 0]}, ("tiles", "unknown key", "ids")),
            ({"do": "move", "tiles": one, "by": [1]}, ("operations[0].by", "[east, north]")),
            ({"do": "move", "tiles": one, "by": [1, 0], "to": [1, 0]}, ("operations[0].to", "goes without")),
            ({"do": "move", "tiles": one, "about": [1, 0], "by": [0, 1]}, ("about", "angle_deg")),
            ({"do": "move", "tiles": one, "by": [1, 0], "options": {"rigidity": -1}}, ("rigidity", "-1", "0..10000")),
            ({"do": "move", "tiles": one, "by": [1, 0], "options": {"rigid": 1}}, ("unknown key", "rigidity")),
            ({"do": "relax", "options": {"similarity": "affin"}}, ("options", "affine_vertex")),
            ({"do": "relax", "options": {"replacement": {"candidates": 0}}}, ("candidates", "1..1000")),
            ({"do": "paste", "group": "a", "by": [1, 0]}, ("operations[0].group", 'copies or cuts "a"')),
            ({"do": "cut", "tiles": one, "land": "sea"}, ("land", "vacant, closed")),
            ({"do": "pin", "tiles": {"window": [1, 1, 0, 0]}}, ("window", "empty")),
            ({"do": "undo", "tiles": one}, ("unknown key", "tiles")),
        ]
        for operation, words in cases:
            with self.subTest(operation=operation):
                self.assert_refused(self.reconfigure(city, operation), "script.json", *words)
                self.assertFalse(self.path("out.gpkg").exists())

    def test_city_or_data_set(self):
        script = self.path("s.json")
        script.write_text('{"operations": []}')
        self.assert_refused(plat("reconfigure", script, "--out", self.path("o.gpkg")), "--city", "--dataset")
        more = ("--city", self.city(), "--out", self.path("o.gpkg"))
        self.assert_refused(plat("reconfigure", script, *more, "--count", 5), "--dataset")
        place = ("--dataset", "cambridge_ma", "--out", self.path("o.gpkg"))
        self.assert_refused(plat("reconfigure", script, *place, "--near", 231500, 902500), "--near", "--count")
        self.assert_refused(plat("reconfigure", script, *more, "--image", "a.tif"), "--image-out")

    def test_an_image_goes_along(self):
        city = self.city()
        self.assert_status(self.reconfigure(city, out="before.gpkg"), DONE)
        old = self.path("old.tif")
        rendered = plat("orthophoto", "--streets", f"{city}:streets", "--parcels", f"{self.path('before.gpkg')}:tiles",
                        "--pixel", 0.5, "--out", old)
        self.assert_status(rendered, DONE)
        images = ("--image", old, "--image-out", self.path("new.tif"))
        self.assert_status(self.reconfigure(city, more=images), DONE)
        still = self.pixels("new.tif", (50, 50, 250, 190))
        self.assertTrue((still == self.pixels("old.tif", (50, 50, 250, 190))).all())
        shift = {"do": "move", "tiles": {"window": [*at(100, 80), *at(200, 160)]}, "by": [2, 1]}
        self.assert_status(self.reconfigure(city, {"do": "pin", "tiles": {"all": True}}, shift, more=images), DONE)
        inner = (120, 100, 180, 140)
        self.assertTrue((self.pixels("new.tif", inner, shift=(2, 1)) == self.pixels("old.tif", inner)).all())
        self.assertFalse((self.pixels("new.tif", inner) == self.pixels("old.tif", inner)).all())

    def pixels(self, name, box, shift=(0, 0)):
        """The pixels of a box, metres from ORIGIN."""
        image = gdal.Open(str(self.path(name)))
        left, pixel, _, top, _, _ = image.GetGeoTransform()
        x = round((ORIGIN[0] + box[0] + shift[0] - left) / pixel)
        y = round((top - ORIGIN[1] - box[3] - shift[1]) / pixel)
        return image.ReadAsArray(x, y, round((box[2] - box[0]) / pixel), round((box[3] - box[1]) / pixel))[:3]

    def test_observed_tiles_without_streets(self):
        if not catalogue_has("san_roman_es"):
            self.skipTest("san_roman_es is not here")
        script = self.path("s.json")
        script.write_text(json.dumps({"operations": [{"do": "relax"}]}))
        result = plat("reconfigure", script, "--dataset", "san_roman_es", "--count", 60, "--out", self.path("out.gpkg"))
        self.assertIn(result.returncode, (DONE, FAILURES), result.stderr)
        self.assertIn(" 0 streets", result.stdout)
        self.assertIn("0 of 1 operations refused", result.stdout)

    def test_the_documented_example_runs(self):
        text = (ROOT / "docs" / "reconfigure_script.md").read_text()
        example = json.loads(re.findall(r"```json\n(.*?)```", text, re.S)[1])
        self.assertEqual(
            {o["do"] for o in example["operations"]},
            {"move", "copy", "cut", "paste", "pin", "unpin", "replace", "relax", "undo", "redo"},
        )
        result = self.reconfigure(self.city(), *example["operations"], defaults=example["defaults"])
        self.assert_status(result, DONE)


if __name__ == "__main__":
    unittest.main()
