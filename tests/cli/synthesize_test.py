"""plat synthesize: scripts become cities whose layers fit together, are read by other commands, and bad scripts are refused."""

import json
import pathlib
import re
import unittest

from plat_cli import DONE, FAILURES, ORIGIN, ROOT, CliTest, catalogue_has, plat, read_layer, rectangle, write_layer
from shapely.geometry import LineString, Point, shape
from shapely.ops import unary_union

GROWER = {"name": "relative_neighbourhood"}
SUBDIVIDER = {"name": "voronoi"}
COLUMNS, ROWS, STEP = 6, 5, (120, 80)


def at(x, y):
    return [ORIGIN[0] + x, ORIGIN[1] + y]


def grid_lines(columns=COLUMNS, rows=ROWS, step=STEP):
    width, height = (columns - 1) * step[0], (rows - 1) * step[1]
    return [[(c * step[0], 0), (c * step[0], height)] for c in range(columns)] + [
        [(0, r * step[1]), (width, r * step[1])] for r in range(rows)
    ]


def lots(size=20.0):
    """Parcels of 400 m2 in every block of the grid, 10 m wide streets between them."""
    out = []
    for c in range(COLUMNS - 1):
        for r in range(ROWS - 1):
            x, y = c * STEP[0] + 5, r * STEP[1] + 5
            out += [[rectangle(x + i * size, y + j * size, size, size)] for i in range(5) for j in range(3)]
    return out


class Synthesize(CliTest):
    def streets(self, name="streets.gpkg", lines=None):
        return write_layer(self.path(name), "roads", lines or grid_lines(), kind="LineString")

    def example(self, **more):
        return {"name": "grid", "streets": f"{self.streets()}:roads", **more}

    def example_with_parcels(self):
        parcels = write_layer(self.path("parcels.gpkg"), "parcels", lots())
        return self.example(parcels=f"{parcels}:parcels")

    def script(self, *operations, examples=None, name="script.json", **more):
        text = {"examples": examples or [self.example()], "operations": operations, "grower": GROWER,
                "subdivider": SUBDIVIDER, **more}
        self.path(name).write_text(json.dumps(text))
        return self.path(name)

    def synthesize(self, *operations, out="out.gpkg", flags=(), status=DONE, **more):
        result = plat("synthesize", self.script(*operations, **more), "--out", self.path(out), *flags)
        self.assert_status(result, status)
        return result

    def layer(self, name, out="out.gpkg"):
        return read_layer(self.path(out), name)

    PLACE = {"do": "place", "example": "grid"}

    def test_points_become_streets_blocks_and_parcels(self):
        result = self.synthesize(self.PLACE)
        self.assertEqual(len(self.layer("points")), COLUMNS * ROWS)
        self.assertEqual(len(self.layer("streets")), COLUMNS * (ROWS - 1) + ROWS * (COLUMNS - 1))
        self.assertEqual(len(self.layer("blocks")), (COLUMNS - 1) * (ROWS - 1))
        self.assertEqual(self.layer("failures"), [])
        for stage in ("points", "streets", "blocks", "parcels"):
            self.assertRegex(result.stdout, rf"(?m)^{stage}: \d+.*; \d+\.\d\d s$")

    def test_parcels_cover_their_blocks(self):
        self.synthesize(self.PLACE)
        blocks = {p["block_id"]: (p, shape(g)) for p, g in self.layer("blocks")}
        of_block = {}
        for p, g in self.layer("parcels"):
            of_block.setdefault(p["block_id"], []).append(shape(g))
        self.assertEqual(blocks.keys(), of_block.keys())
        for block, (properties, contour) in blocks.items():
            shapes = of_block[block]
            self.assertEqual(properties["parcels"], len(shapes))
            self.assertLess(unary_union(shapes).symmetric_difference(contour).area, 0.1)
            self.assertAlmostEqual(sum(s.area for s in shapes), unary_union(shapes).area, places=6)

    def test_parcels_have_the_size_of_the_examples(self):
        self.synthesize(self.PLACE, examples=[self.example_with_parcels()])
        blocks = [p for p, _ in self.layer("blocks")]
        self.assertEqual({p["style_source"] for p in blocks}, {"points"})
        for block in blocks:
            self.assertAlmostEqual(block["wanted_area_m2"], 400.0, places=6)
            self.assertAlmostEqual(block["area_m2"] / block["parcels"], 400.0, delta=40.0)

    def test_without_parcels_the_subdivider_divides_as_it_was_given(self):
        self.synthesize(self.PLACE, subdivider={"name": "voronoi", "options": {"area_mean_m2": 900}})
        for block, _ in self.layer("blocks"):
            self.assertEqual((block["style_source"], block["wanted_area_m2"]), ("none", None))
            self.assertIn("area_mean_m2=900", block["options"])

    def test_given_options_win_over_fitted_ones(self):
        self.synthesize(self.PLACE, examples=[self.example_with_parcels()],
                        subdivider={"name": "voronoi", "options": {"rows": "one"}})
        for block, _ in self.layer("blocks"):
            self.assertIn("rows=one", block["options"])
            self.assertIn("area_mean_m2=400", block["options"])

    def test_the_same_seed_gives_the_same_bytes_on_any_number_of_threads(self):
        for out, flags in (("one.gpkg", ("--jobs", 1)), ("three.gpkg", ("--jobs", 3)), ("other.gpkg", ("--seed", 9))):
            self.synthesize(self.PLACE, out=out, flags=flags)
        self.assertEqual(self.path("one.gpkg").read_bytes(), self.path("three.gpkg").read_bytes())
        self.assertNotEqual(self.layer("parcels", "one.gpkg"), self.layer("parcels", "other.gpkg"))

    def test_the_seed_of_the_script_counts_where_none_is_given(self):
        self.synthesize(self.PLACE, out="script.gpkg", seed=9)
        self.synthesize(self.PLACE, out="flag.gpkg", flags=("--seed", 9))
        self.assertEqual(self.layer("parcels", "script.gpkg"), self.layer("parcels", "flag.gpkg"))

    def test_the_output_says_what_it_was_made_by(self):
        self.synthesize(self.PLACE, seed=5)
        [(record, _)] = self.layer("synthesis")
        self.assertEqual((record["seed"], record["grower"], record["subdivider"]),
                         ("5", "relative_neighbourhood", "voronoi"))
        self.assertEqual(json.loads(record["script"])["operations"], [self.PLACE])

    def test_a_copy_lies_where_it_is_placed(self):
        self.synthesize({**self.PLACE, "at": at(1000, 2000), "rotate_deg": 90})
        places = [g["coordinates"] for _, g in self.layer("points")]
        xs, ys = [p[0] - ORIGIN[0] for p in places], [p[1] - ORIGIN[1] for p in places]
        self.assertEqual((min(xs), max(xs), min(ys), max(ys)), (840, 1160, 1700, 2300))

    def test_an_offset_counts_from_the_centre_of_the_first_example(self):
        self.synthesize({**self.PLACE, "at": {"offset": [50, 0]}})
        xs = [g["coordinates"][0] - ORIGIN[0] for _, g in self.layer("points")]
        self.assertEqual((min(xs), max(xs)), (50, 650))

    def test_only_points_in_the_regions_stay(self):
        example = self.example(region={"window": [*at(-1, -1), *at(300, 500)]})
        self.synthesize({**self.PLACE, "region": {"window": [*at(-1, 100), *at(700, 500)]}}, examples=[example])
        places = [g["coordinates"] for _, g in self.layer("points")]
        self.assertEqual(len(places), 3 * 3)
        self.assertTrue(all(x <= ORIGIN[0] + 300 and y >= ORIGIN[1] + 100 for x, y in places))

    def test_join_lays_copies_side_by_side_and_keeps_the_first_where_they_meet(self):
        join = {"do": "join", "examples": [
            {"example": "grid"}, {"example": "grid", "at": {"offset": [600, 0]}}, {"example": "grid", "at": {"offset": [9, 0]}}]}
        self.synthesize(join)
        self.assertEqual(len(self.layer("points")), (2 * COLUMNS - 1) * ROWS)

    def test_blend_changes_from_one_style_to_the_other(self):
        other = {"name": "wide", "streets": f"{self.streets('wide.gpkg', grid_lines(3, 3, (240, 160)))}:roads"}
        blend = {"do": "blend", "examples": [{"example": "grid"}, {"example": "wide", "at": {"offset": [0, 0]}}]}
        counts = []
        for weight in (0, 0.5, 1):
            self.synthesize({**blend, "weight": weight}, examples=[self.example(), other])
            counts.append(len(self.layer("points")))
        self.assertEqual((counts[0], sorted(counts, reverse=True)), (COLUMNS * ROWS, counts))
        self.assertLess(counts[2], counts[0])

    def test_points_of_a_file_can_be_examples(self):
        self.synthesize(self.PLACE, out="first.gpkg")
        again = [{"name": "grid", "points": str(self.path("first.gpkg"))}]
        self.synthesize(self.PLACE, examples=again)
        self.assertEqual(self.layer("streets"), self.layer("streets", "first.gpkg"))

    def test_a_city_keeps_its_streets_and_grows_into_a_region(self):
        expand = {"do": "expand", "example": "grid", "region": {"window": [*at(610, 0), *at(1200, 320)]}}
        self.synthesize(expand, city={"streets": f"{self.streets('city.gpkg')}:roads"})
        old = [(p, shape(g)) for p, g in self.layer("streets") if p["is_existing"]]
        new = [(p, shape(g)) for p, g in self.layer("streets") if not p["is_existing"]]
        self.assertTrue(old and new)
        city = unary_union([LineString([at(*p) for p in line]) for line in grid_lines()])
        self.assertLess(unary_union([g for _, g in old]).symmetric_difference(city).length, 1e-6)
        self.assertFalse({p["chain"] for p, _ in old} & {p["chain"] for p, _ in new})
        self.assertTrue(all(g.bounds[0] > ORIGIN[0] + 600 for _, g in new))
        self.assertEqual({p["is_existing"] for p, _ in self.layer("blocks")}, {0, 1})

    def test_points_keep_clear_of_a_citys_streets(self):
        self.synthesize({**self.PLACE, "at": at(650, 200)}, city={"streets": f"{self.streets('city.gpkg')}:roads"})
        city = unary_union([LineString([at(*p) for p in line]) for line in grid_lines()])
        distances = [shape(g).distance(city) for _, g in self.layer("points")]
        self.assertLess(len(distances), COLUMNS * ROWS)
        self.assertGreaterEqual(min(distances), 40.0)

    def test_growth_stays_inside_the_boundary_and_out_of_obstacles(self):
        boundary = [at(-10, -10), at(700, -10), at(700, 250), at(-10, 250)]
        water = write_layer(self.path("water.gpkg"), "water", [[rectangle(200, 60, 100, 60)]])
        self.synthesize(self.PLACE, boundary={"polygon": boundary}, obstacles=[{"layer": f"{water}:water"}])
        streets = unary_union([shape(g) for _, g in self.layer("streets")])
        self.assertLessEqual(streets.bounds[3], ORIGIN[1] + 250)
        pond = Point(at(250, 90)).buffer(29)
        self.assertTrue(streets.disjoint(pond))
        self.assertIn(0, {p["is_reached"] for p, _ in self.layer("points")})

    def test_plat_edit_goes_on_with_a_synthesized_city(self):
        self.synthesize(self.PLACE, examples=[self.example_with_parcels()])
        edits = self.path("edits.json")
        edits.write_text(json.dumps({"edits": [{"edit": "move_node", "node": {"at": at(120, 80)}, "to": at(126, 84)}]}))
        result = plat("edit", edits, "--city", self.path("out.gpkg"), "--out", self.path("edited.gpkg"),
                      "--strategy-field", "strategy", "--options-field", "options")
        self.assert_status(result, DONE)
        self.assertIn("blocks 4 changed, 0 new, 0 gone", result.stdout)
        widths = {p["width_m"] for p, _ in self.layer("streets", "edited.gpkg")}
        self.assertEqual(widths, {p["width_m"] for p, _ in self.layer("streets")})
        made, kept = len(self.layer("parcels")), len(self.layer("parcels", "edited.gpkg"))
        self.assertAlmostEqual(kept / made, 1.0, delta=0.1)

    def test_other_commands_read_a_synthesized_city(self):
        self.synthesize(self.PLACE)
        out = self.path("out.gpkg")
        self.assert_status(plat("blocks", "--streets", f"{out}:streets", "--out", self.path("blocks.gpkg")), DONE)
        self.assertEqual(len(self.layer("blocks", "blocks.gpkg")), len(self.layer("blocks")))
        self.assert_status(plat("subdivide", "--blocks", f"{out}:blocks", "--streets", f"{out}:streets",
                                "--strategy", "obb", "--out", self.path("lots.gpkg")), DONE)

    def test_a_face_that_is_no_block_is_a_row(self):
        lines = grid_lines() + [[(0, 7), (600, 7)]]
        example = {"name": "grid", "streets": f"{self.streets('narrow.gpkg', lines)}:roads"}
        self.synthesize(self.PLACE, examples=[example], status=FAILURES)
        rows = self.layer("failures")
        self.assertTrue(rows)
        for properties, geometry in rows:
            self.assertEqual((properties["stage"], properties["code"]), ("blocks", "too_small"))
            self.assertTrue(shape(geometry).buffer(0.01).contains(Point(properties["x"], properties["y"])))

    def test_bad_scripts_are_refused_with_the_path(self):
        grid = self.example()
        cases = [
            (dict(), [{"do": "plase"}], ("operations[0].do", "plase", "place")),
            (dict(), [{**self.PLACE, "example": "gird"}], ("operations[0].example", "grid")),
            (dict(), [{**self.PLACE, "at": at(9e6, 0)}], ("operations[0]", "km away")),
            (dict(), [{**self.PLACE, "region": {"window": [*at(-9, -9), *at(-5, -5)]}}], ("operations", "no point is left")),
            (dict(), [{**self.PLACE, "region": {"polygon": [at(0, 0), at(9, 9), at(9, 0), at(0, 9)]}}],
             ("operations[0].region", "is no polygon")),
            (dict(), [{"do": "blend", "examples": [{"example": "grid"}, {"example": "grid", "at": at(5000, 0)}]}],
             ("operations[0].weight", "do not overlap")),
            (dict(examples=[{**grid, "region": {"window": [*at(-9, -9), *at(-5, -5)]}}]), [self.PLACE], ("examples[0]", "points lie in x 458000")),
            (dict(examples=[{"name": "grid", "streets": str(self.path("no.gpkg"))}]), [self.PLACE], ("examples[0]", "no.gpkg")),
            (dict(examples=[{"name": "grid", "data": "atlantis"}]), [self.PLACE], ("examples[0]", "atlantis")),
            (dict(city={"streets": grid["streets"], "region": {"window": [*at(-9, -9), *at(-5, -5)]}}), [self.PLACE], ("city.region", "no street")),
            (dict(boundary={"layer": grid["streets"]}), [self.PLACE], ("boundary", "wrong geometry type")),
            (dict(grower={"name": "wolk"}), [self.PLACE], ("grower.name", "wolk")),
            (dict(subdivider={"name": "voronoi", "options": {"rows": "three"}}), [self.PLACE], ("subdivider.options", "rows")),
        ]
        for more, operations, words in cases:
            with self.subTest(words=words):
                result = plat("synthesize", self.script(*operations, **more), "--out", self.path("out.gpkg"))
                self.assert_refused(result, "script.json", *words)
                self.assertFalse(self.path("out.gpkg").exists())

    def test_an_input_is_never_overwritten(self):
        script = self.script(self.PLACE)
        before = self.path("streets.gpkg").read_bytes()
        self.assert_refused(plat("synthesize", script, "--out", self.path("streets.gpkg")), "--out", "streets.gpkg")
        self.assertEqual(self.path("streets.gpkg").read_bytes(), before)


class Documentation(CliTest):
    EXAMPLES = sorted((ROOT / "docs" / "examples" / "synthesis").glob("*.json"))

    def test_every_example_runs_on_real_cities(self):
        self.assertGreaterEqual(len(self.EXAMPLES), 2)
        for path in self.EXAMPLES:
            text = path.read_text()
            with self.subTest(example=path.name):
                if not all(catalogue_has(name) for name in re.findall(r'"data": "(\w+)"', text)):
                    self.skipTest("data set not here: plat data list")
                out = self.path(path.stem + ".gpkg")
                result = plat("synthesize", path, "--out", out)
                self.assertIn(result.returncode, (DONE, FAILURES), result.stderr)
                self.check_city(out)

    def check_city(self, out):
        blocks = {p["block_id"]: shape(g) for p, g in read_layer(out, "blocks")}
        areas = dict.fromkeys(blocks, 0.0)
        for p, _ in read_layer(out, "parcels"):
            areas[p["block_id"]] += p["area_m2"]
        self.assertGreater(len(blocks), 50)
        undivided = {p["feature"] for p, _ in read_layer(out, "failures") if p["stage"] == "parcels"}
        for block, contour in blocks.items():
            wanted = 0.0 if f"block {block}" in undivided else contour.area
            # The contour's own vertices may lie off the parcels by one and a half grid steps.
            self.assertLess(abs(areas[block] - wanted), 0.0015 * contour.length)
        points = [p for p, _ in read_layer(out, "points")]
        self.assertGreater(sum(p["is_reached"] for p in points), 0.9 * len(points))
        grown = sum(1 for p, _ in read_layer(out, "streets") if not p["is_existing"])
        self.assertGreater(grown, len(points) / 2)

    def test_the_page_names_every_key(self):
        page = (ROOT / "docs" / "synthesis_script.md").read_text()
        source = pathlib.Path(ROOT / "experiments" / "harness" / "synthesis_script.cpp").read_text()
        keys = set(re.findall(r'(?:find|needed)\("(\w+)"', source)) | set(re.findall(r'read\("(\w+)"', source))
        self.assertGreater(len(keys), 30)
        for key in keys:
            self.assertRegex(page, rf'[`"]{key}[`"]')


if __name__ == "__main__":
    unittest.main()
