"""plat edit: a script is replayed, what it wrote is read back without loss, and bad scripts are refused."""

import json
import re
import unittest

from plat_cli import DONE, FAILURES, ORIGIN, ROOT, CliTest, plat, read_layer, write_layer
from shapely.geometry import shape
from shapely.ops import unary_union


def at(x, y):
    return [ORIGIN[0] + x, ORIGIN[1] + y]


GRID = [[(100 * c, 0), (100 * c, 160)] for c in range(3)] + [[(0, 80 * r), (200, 80 * r)] for r in range(3)]


class Edit(CliTest):
    def city(self):
        streets = write_layer(self.path("streets.gpkg"), "roads", GRID, kind="LineString")
        self.assert_status(plat("blocks", "--streets", streets, "--out", self.path("blocks.gpkg")), DONE)
        return self.path("blocks.gpkg")

    def script(self, *edits):
        path = self.path("edits.json")
        path.write_text(json.dumps({"edits": edits}))
        return path

    def edit(self, city, *edits, out="out.gpkg", more=()):
        return plat("edit", self.script(*edits), "--city", city, "--out", self.path(out), *more)

    def parcels(self, out="out.gpkg"):
        return {p["parcel"]: (p, g) for p, g in read_layer(self.path(out), "parcels")}

    def test_an_edit_changes_its_blocks_and_says_so(self):
        city = self.city()
        self.assert_status(self.edit(city, out="before.gpkg"), DONE)
        result = self.edit(city, {"edit": "move_node", "node": {"at": at(100, 80)}, "to": at(104, 83)})
        self.assert_status(result, DONE)
        self.assertRegex(result.stdout, r"edit 1 move_node: blocks 4 changed, 0 new, 0 gone; parcels \d+ kept")
        before, after = self.parcels("before.gpkg"), self.parcels()
        kept = before.keys() & after.keys()
        self.assertGreater(len(kept), 0.8 * len(before))
        for _, (properties, _) in after.items():
            self.assertIn(properties["predecessor"], before)

    def test_parcels_cover_the_blocks(self):
        self.assert_status(self.edit(self.city(), {"edit": "add_street", "from": at(50, 0), "to": at(55, 80)}), DONE)
        blocks = {p["block"]: shape(g) for p, g in read_layer(self.path("out.gpkg"), "blocks")}
        self.assertEqual(len(blocks), 5)
        for block, contour in blocks.items():
            shapes = [shape(g) for p, g in self.parcels().values() if p["block"] == block]
            self.assertLess(unary_union(shapes).symmetric_difference(contour).area, 0.5)
            self.assertAlmostEqual(sum(s.area for s in shapes), unary_union(shapes).area, places=6)

    def test_the_output_is_read_back_without_loss(self):
        edits = [
            {"edit": "bend_street", "street": {"at": at(50, 80)}, "controls": [at(30, 92), at(70, 92)]},
            {"edit": "set_parcel_attribute", "parcel": {"at": at(20, 20)}, "key": "use", "value": "school; \"old\""},
            {"edit": "set_block_style", "blocks": [{"at": at(150, 40)}], "strategy": "obb", "options": {"area_max_m2": 500}},
            {"edit": "add_street", "from": at(150, 80), "to": at(150, 130)},
        ]
        self.assert_status(self.edit(self.city(), *edits), DONE)
        self.assert_status(self.edit(self.path("out.gpkg"), out="again.gpkg"), DONE)
        self.assertEqual(self.path("out.gpkg").read_bytes(), self.path("again.gpkg").read_bytes())

    def test_a_script_in_two_halves_is_the_same(self):
        first = {"edit": "move_node", "node": {"at": at(100, 80)}, "to": at(104, 83)}
        second = {"edit": "add_street", "from": at(50, 0), "to": at(55, 80)}
        city = self.city()
        self.assert_status(self.edit(city, first, second, out="whole.gpkg"), DONE)
        self.assert_status(self.edit(city, first, out="half.gpkg"), DONE)
        self.assert_status(self.edit(self.path("half.gpkg"), second, out="two.gpkg"), DONE)
        self.assertEqual(self.path("whole.gpkg").read_bytes(), self.path("two.gpkg").read_bytes())

    def test_attributes_go_along(self):
        attribute = {"edit": "set_parcel_attribute", "parcel": {"at": at(20, 20)}, "key": "use", "value": "school"}
        move = {"edit": "move_street", "street": {"at": at(50, 80)}, "by": [0, 4]}
        self.assert_status(self.edit(self.city(), attribute, move), DONE)
        marked = [g for p, g in self.parcels().values() if p["attributes"] == '{"use":"school"}']
        self.assertEqual(len(marked), 1)
        self.assertLess(shape(marked[0]).distance(shape({"type": "Point", "coordinates": at(20, 20)})), 5.0)

    def test_a_refused_edit_is_said_and_the_others_go_on(self):
        cross = {"edit": "move_node", "node": {"at": at(100, 80)}, "to": at(100, 200)}
        width = {"edit": "set_street_width", "street": {"at": at(50, 80)}, "width_m": 20}
        result = self.edit(self.city(), cross, width)
        self.assert_status(result, FAILURES)
        self.assertIn("edit 1 move_node: refused, streets_cross", result.stdout)
        self.assertIn("edit 2 set_street_width: blocks 2 changed", result.stdout)

    def test_styles_come_from_fields_or_options(self):
        city = self.city()
        self.assert_status(self.edit(city, more=("--strategy", "obb", "--set", "area_max_m2=500")), DONE)
        styles = {(p["strategy"], p["options"]) for p, _ in read_layer(self.path("out.gpkg"), "blocks")}
        self.assertEqual(styles, {("obb", "area_max_m2=500")})
        # The field "source" of plat blocks is empty; names of strategies come from a field that has them.
        result = self.edit(city, more=("--strategy-field", "source"))
        self.assert_refused(result, "blocks", "unknown strategy")

    def test_bad_scripts_are_refused_with_the_edit_and_the_key(self):
        city = self.city()
        cases = [
            ({"edit": "move_nod"}, ("edit 1", "move_node", "allowed")),
            ({"edit": "move_node", "node": 1}, ("edit 1 (move_node)", '"to" is missing')),
            ({"edit": "move_node", "node": 1, "to": [1]}, ("edit 1", '"to" must be [x, y]')),
            ({"edit": "move_node", "node": 1, "to": at(0, 0), "snap": 1}, ("unknown key", "snap_m")),
            ({"edit": "set_street_width", "street": 1, "width_m": 1000}, ("width_m = 1000", "0.5..150")),
            ({"edit": "set_block_style", "strategy": "obbb"}, ("edit 1", "obb")),
            ({"edit": "set_block_style", "strategy": "obb", "options": {"x": 1}}, ("edit 1", "x")),
            ({"edit": "remove_street", "street": -1}, ("street", "must be an id")),
        ]
        for edit, words in cases:
            with self.subTest(edit=edit):
                self.assert_refused(self.edit(city, edit), *words)
                self.assertFalse(self.path("out.gpkg").exists())

    def test_the_documented_example_runs(self):
        text = (ROOT / "docs" / "edit_script.md").read_text()
        example = json.loads(re.findall(r"```json\n(.*?)```", text, re.S)[1])
        documented = set(re.findall(r"^\| `(\w+)` \| `", text, re.M)) & {e["edit"] for e in example["edits"]}
        self.assertEqual(len(documented), 10, "every kind of edit has an example")
        self.assert_status(self.edit(self.city(), *example["edits"]), DONE)


if __name__ == "__main__":
    unittest.main()
