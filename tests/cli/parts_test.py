"""plat parts: makes the kits that it promises, reads them back, and a database of one's own."""

import json
import unittest

from plat_cli import BAD_INPUT, DONE, CliTest, plat

CUBE = """OFF
8 6 0
0 -2 0
3 -2 0
3 2 0
0 2 0
0 -2 5
3 -2 5
3 2 5
0 2 5
4 0 3 2 1
4 4 5 6 7
4 0 1 5 4
4 1 2 6 5
4 2 3 7 6
4 3 0 4 7
"""


class Parts(CliTest):
    def listed(self, folder):
        process = plat("parts", "list", folder, "--json")
        self.assert_status(process, DONE)
        return json.loads(process.stdout)

    def test_a_kit_is_made_and_listed(self):
        made = plat("parts", "make", "tower", "--out", self.path("tower"), "--format", "off")
        self.assert_status(made, DONE)
        self.assertIn("synthetic", made.stdout)
        database = self.listed(self.path("tower"))
        self.assertEqual(len(database["parts"]), 18)
        self.assertEqual(database["transitions"], 81)
        for part in database["parts"]:
            self.assertEqual([port["role"] for port in part["ports"]], ["bottom", "top"])
        self.assertTrue((self.path("tower") / "meshes" / "podium.off").is_file())

    def test_making_it_again_gives_the_same_bytes(self):
        for name in ("one", "two"):
            self.assert_status(plat("parts", "make", "tower", "--out", self.path(name)), DONE)
        for file in sorted(self.path("one").rglob("*.*")):
            twin = self.path("two") / file.relative_to(self.path("one"))
            self.assertEqual(file.read_bytes(), twin.read_bytes(), file.name)

    def test_ones_own_parts_are_read_scaled_and_named(self):
        folder = self.path("own")
        folder.mkdir()
        manifest = {"format": "plat parts 1", "name": "own", "parts": [
            {"name": "bay", "class": "middle", "length_m": 2.95, "mesh": "bay.off", "attributes": {"windows": 2}}]}
        (folder / "parts.json").write_text(json.dumps(manifest))
        (folder / "bay.off").write_text(CUBE.replace("3 -2", "2.95 -2").replace("3 2 0", "2.95 2 0").replace("3 2 5", "2.95 2 5"))
        listed = plat("parts", "list", folder)
        self.assert_status(listed, DONE)
        self.assertIn("bay: length times 1.0169", listed.stdout)
        part = self.listed(folder)["parts"][0]
        self.assertEqual(part["attributes"], {"length_m": 3.0, "windows": 2.0})
        self.assertEqual([port["section_area_m2"] for port in part["ports"]], [20.0, 20.0])

    def test_bad_input_is_refused(self):
        unknown = plat("parts", "make", "townhous", "--out", self.path("x"))
        self.assert_status(unknown, BAD_INPUT)
        self.assertIn('did you mean "townhouse"', unknown.stderr)
        self.assertFalse(self.path("x").exists())
        self.assert_status(plat("parts", "list", self.path("nowhere")), BAD_INPUT)
        self.assert_status(plat("parts", "make", "tower", "--out", self.path("t"), "--format", "stl"), BAD_INPUT)
        self.assert_status(plat("parts"), BAD_INPUT)


if __name__ == "__main__":
    unittest.main()
