"""plat build: every example gives a closed mesh, the files are what they say, and refusals are one line."""

import json
import pathlib
import struct
import tempfile
import unittest

from plat_cli import BAD_INPUT, DONE, FAILURES, ROOT, plat

EXAMPLES = sorted((ROOT / "docs" / "examples" / "buildings").glob("*.json"))


class Build(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def build(self, design, *arguments, out="house.glb"):
        if not isinstance(design, pathlib.Path):
            file = self.folder / "design.json"
            file.write_text(design if isinstance(design, str) else json.dumps(design), encoding="utf-8")
            design = file
        parts = [] if "--parts" in arguments else ["--parts", "townhouse"]
        return plat("build", design, *parts, "--out", self.folder / out, *arguments)

    def report(self, name="house.json"):
        return json.loads((self.folder / name).read_text(encoding="utf-8"))

    def test_every_example_is_watertight(self):
        self.assertGreaterEqual(len(EXAMPLES), 8)
        for example in EXAMPLES:
            if "tower" in example.name:
                continue
            with self.subTest(example=example.name):
                result = self.build(example)
                self.assertEqual(result.returncode, DONE, result.stdout + result.stderr)
                report = self.report()
                self.assertTrue(report["surface"]["is_watertight"])
                for row in report["rows"]:
                    self.assertLessEqual(abs(row["length_m"] - row["quantised_m"]), 0.1001)

    def test_a_tower_has_its_height_and_floor_area(self):
        result = self.build(ROOT / "docs" / "examples" / "buildings" / "tower_10.json", "--parts", "tower", "--method",
                            "intermediate_graph")
        self.assertEqual(result.returncode, DONE, result.stdout + result.stderr)
        resources = self.report()["resources"]
        self.assertAlmostEqual(resources["height_m"], 120.0)
        self.assertAlmostEqual(resources["floor_area_m2"], 15280.0)

    def test_local_constraints_are_kept(self):
        example = ROOT / "docs" / "examples" / "buildings" / "balconies.json"
        self.assertEqual(self.build(example).returncode, DONE)
        rows = {row["edges"][0]: row["attributes"] for row in self.report()["rows"]}
        self.assertEqual(rows[0]["balconies"], 3)
        self.assertEqual(rows[4]["balconies"], 4)

    def test_a_glb_holds_the_mesh(self):
        self.assertEqual(self.build(EXAMPLES[0]).returncode, DONE)
        data = (self.folder / "house.glb").read_bytes()
        magic, version, length = struct.unpack("<4sII", data[:12])
        self.assertEqual((magic, version, length), (b"glTF", 2, len(data)))
        head = struct.unpack("<I", data[12:16])[0]
        document = json.loads(data[20:20 + head])
        primitives = document["meshes"][0]["primitives"]
        faces = sum(document["accessors"][p["indices"]]["count"] for p in primitives) // 3
        self.assertEqual(faces, self.report()["surface"]["faces"])
        self.assertEqual(len(primitives), len(document["materials"]))
        for accessor, view in zip(document["accessors"], document["bufferViews"]):
            size = {5126: 12, 5125: 4}[accessor["componentType"]]
            self.assertEqual(accessor["count"] * size, view["byteLength"])

    def test_an_obj_names_its_materials_and_k_best_are_numbered(self):
        self.assertEqual(self.build(EXAMPLES[0], "--k", 3, out="house.obj").returncode, DONE)
        materials = (self.folder / "house.mtl").read_text(encoding="utf-8")
        for line in (self.folder / "house.obj").read_text(encoding="utf-8").splitlines():
            if line.startswith("usemtl "):
                self.assertIn(f"newmtl {line.split()[1]}\n", materials)
        lines = (self.folder / "house.obj").read_text(encoding="utf-8").splitlines()
        corners = {int(word) for line in lines if line.startswith("f ") for word in line.split()[1:]}
        self.assertEqual((min(corners), max(corners)), (1, sum(line.startswith("v ") for line in lines)))
        costs = [self.report(f"house{i}.json")["cost_m2"] for i in ("", "_2", "_3")]
        self.assertEqual(costs, sorted(costs))

    def test_the_same_design_gives_the_same_bytes(self):
        for ending in ("obj", "ply", "glb"):
            self.assertEqual(self.build(EXAMPLES[0], out=f"a.{ending}").returncode, DONE)
            self.assertEqual(self.build(EXAMPLES[0], out=f"b.{ending}").returncode, DONE)
            a, b = ((self.folder / f"{name}.{ending}").read_bytes() for name in "ab")
            self.assertEqual(a.replace(b"a.mtl", b"b.mtl"), b)

    def test_no_building_is_told_with_what_is_near(self):
        edge = {"from": 0, "to": 1, "front": "left", "bounds": {"balconies": 9}}
        result = self.build({"skeleton": {"nodes": [[0, 0], [12, 0]], "edges": [edge]}})
        self.assertEqual(result.returncode, FAILURES)
        self.assertIn("no building", result.stdout)
        self.assertIn("balconies of edge 0 9: nearest attainable", result.stdout)
        self.assertFalse((self.folder / "house.glb").exists())

    def test_bad_input_is_one_line(self):
        row = {"skeleton": {"nodes": [[0, 0], [30, 0]], "edges": [{"from": 0, "to": 1, "front": "right"}]}}
        for design, arguments, out, said in [
                (row, [], "house.stl", "must end in .obj, .ply or .glb"),
                (row, ["--parts", "castle"], "house.glb", "neither a folder with parts nor a kit"),
                (row, ["--method", "magic"], "house.glb", "magic"),
                ("{", [], "house.glb", "not JSON"),
                ({"skeleton": {**row["skeleton"], "nods": 1}}, [], "house.glb", "unknown key \"nods\"")]:
            result = self.build(design, *arguments, out=out)
            self.assertEqual(result.returncode, BAD_INPUT, result.stdout)
            self.assertIn(said, result.stderr)
            self.assertEqual(len(result.stderr.strip().splitlines()), 1)


if __name__ == "__main__":
    unittest.main()
