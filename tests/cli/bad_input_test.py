"""Bad files and bad options: one line that names the file, the feature or layer and the remedy, and nothing written."""

import json
import math
import os
import pathlib
import time
import unittest

import fiona
from plat_cli import DONE, FAILURES, CliTest, plat, read_layer, rectangle, write_layer

SQUARE = [rectangle(0, 0, 60, 60)]
BOW_TIE = [[(0, 0), (60, 60), (60, 0), (0, 60), (0, 0)]]
STRATEGIES = ("obb", "skeleton", "voronoi")


def many_vertices(count, radius=400.0):
    """A gear of `count` vertices: no vertex is collinear, every second one is reflex."""
    angles = [2 * math.pi * i / count for i in range(count)]
    reach = [radius if i % 2 else radius - 3.0 for i in range(count)]
    ring = [(r * math.cos(a), r * math.sin(a)) for a, r in zip(angles, reach)]
    return [ring + ring[:1]]


class BadFiles(CliTest):
    def divide(self, blocks, *more, strategy="obb", out="out.gpkg"):
        return plat("subdivide", "--blocks", blocks, "--strategy", strategy, *more, "--out", self.path(out))

    def test_missing_file(self):
        self.assert_refused(self.divide(self.path("none.gpkg")), "none.gpkg", "no such file", "check the path")
        self.assert_only()

    def test_missing_layer_is_suggested(self):
        blocks = self.blocks(SQUARE)
        self.assert_refused(self.divide(f"{blocks}:bloks"), blocks, '"bloks"', 'did you mean "blocks"')
        self.assert_only("blocks.gpkg")

    def test_several_layers_and_none_named(self):
        blocks = self.blocks(SQUARE)
        write_layer(blocks, "more", [SQUARE])
        self.assert_refused(self.divide(blocks), blocks, "blocks, more", ":LAYER")
        self.assert_only("blocks.gpkg")

    def test_wrong_geometry_type(self):
        lines = write_layer(self.path("lines.gpkg"), "lines", [[(0, 0), (9, 9)]], kind="LineString")
        self.assert_refused(self.divide(lines), "lines.gpkg:lines", "wanted polygons", "choose another layer")
        polygons = self.blocks(SQUARE)
        self.assert_refused(self.divide(polygons, "--streets", polygons), "blocks.gpkg:blocks", "wanted lines")
        self.assert_refused(self.divide(polygons, "--observed", lines), "lines.gpkg:lines", "wanted polygons")
        self.assert_only("blocks.gpkg", "lines.gpkg")

    def test_no_crs(self):
        blocks = self.blocks(SQUARE, crs=None)
        self.assert_refused(self.divide(blocks), "blocks.gpkg:blocks", "no coordinate reference system", "-a_srs")
        self.assert_only("blocks.gpkg")

    def test_empty_file_and_empty_layer(self):
        empty = self.path("empty.gpkg")
        empty.write_bytes(b"")
        self.assert_refused(self.divide(empty), "empty.gpkg", "GDAL")
        no_features = self.blocks()
        self.assert_refused(self.divide(no_features), "blocks.gpkg:blocks", "empty", "choose another layer")
        text = self.path("noise.geojson")
        text.write_text("{ this is no JSON", encoding="utf-8")
        self.assert_refused(self.divide(text), "noise.geojson", "GDAL")
        self.assert_only("blocks.gpkg", "empty.gpkg", "noise.geojson")

    def test_nothing_but_nan(self):
        blocks = self.blocks([[(math.nan, math.nan)] * 4])
        self.assert_refused(self.divide(blocks), "blocks.gpkg:blocks", "finite", "repair")
        self.assert_only("blocks.gpkg")

    def test_a_damaged_file(self):
        blocks = self.blocks(*[[rectangle(70 * i, 0, 60, 60)] for i in range(500)])
        content = blocks.read_bytes()
        blocks.write_bytes(content[: len(content) // 2])
        self.assert_refused(self.divide(blocks), "blocks.gpkg")
        self.assert_only("blocks.gpkg")

    def test_coordinates_in_the_wrong_crs(self):
        blocks = self.blocks(SQUARE, crs="EPSG:4326")  # metres said to be degrees
        self.assert_refused(self.divide(blocks), "blocks.gpkg:blocks", "coordinate reference system", "-a_srs")
        self.assert_only("blocks.gpkg")


class BadBlocks(CliTest):
    """A block that cannot be used is a row; the others are divided."""

    def assert_row(self, bad, code):
        blocks = self.blocks([rectangle(500, 0, 60, 60)], bad)
        for strategy in STRATEGIES:
            out = self.path("out.gpkg")
            result = plat("subdivide", "--blocks", blocks, "--strategy", strategy, "--out", out)
            self.assert_status(result, FAILURES)
            self.assertNotIn("plat:", result.stderr)
            rows = [p for p, _ in read_layer(out, "failures")]
            self.assertEqual([(r["block_id"], r["code"]) for r in rows], [("2", code)])
            self.assertTrue(rows[0]["message"])
            self.assertEqual({p["block_id"] for p, _ in read_layer(out, "parcels")}, {0})

    def test_nan_in_one_block(self):
        self.assert_row([[(0, 0), (60, 0), (60, math.nan), (0, 60), (0, 0)]], "not_finite")

    def test_infinite_coordinate(self):
        self.assert_row([[(0, 0), (60, 0), (math.inf, 60), (0, 60), (0, 0)]], "not_finite")

    def test_self_crossing(self):
        self.assert_row(BOW_TIE, "not_simple")

    def test_zero_width(self):
        self.assert_row([rectangle(0, 0, 0, 60)], "empty_geometry")

    def test_narrower_than_the_grid(self):
        self.assert_row([rectangle(0, 0, 0.0004, 60)], "empty_geometry")

    def test_a_hole_that_touches_the_border(self):
        self.assert_row([rectangle(0, 0, 60, 60), list(reversed(rectangle(0, 20, 20, 20)))], "bad_hole")

    def test_a_hole_outside(self):
        self.assert_row([rectangle(0, 0, 60, 60), list(reversed(rectangle(80, 20, 20, 20)))], "bad_hole")

    def test_a_block_of_10000_vertices_ends_in_bounded_time(self):
        blocks = self.blocks(many_vertices(10000))
        for strategy in STRATEGIES:
            started = time.monotonic()
            out = self.path("out.gpkg")
            result = plat("subdivide", "--blocks", blocks, "--strategy", strategy, "--out", out)
            self.assertIn(result.returncode, (DONE, FAILURES), result.stderr)
            self.assertLess(time.monotonic() - started, 60.0, strategy)
            rows = len(read_layer(out, "parcels")) + len(read_layer(out, "failures"))
            self.assertGreater(rows, 0, "divided, or a row that says why not")

    def test_smallest_options_on_a_large_block_end_in_bounded_time(self):
        blocks = self.blocks([rectangle(0, 0, 12000, 9000)])
        smallest = {
            "obb": ("area_min_m2=0", "area_max_m2=1", "width_min_m=0", "width_max_m=0.5", "street_access=0"),
            "skeleton": ("area_min_m2=0", "area_max_m2=1", "width_min_m=0", "width_max_m=0.5"),
            "voronoi": ("area_mean_m2=1",),
        }
        for strategy, options in smallest.items():
            started = time.monotonic()
            settings = [word for option in options for word in ("--set", option)]
            out = self.path("out.gpkg")
            result = plat("subdivide", "--blocks", blocks, "--strategy", strategy, *settings, "--out", out)
            self.assertIn(result.returncode, (DONE, FAILURES), result.stderr)
            self.assertLess(time.monotonic() - started, 120.0, strategy)


class BadOptions(CliTest):
    def refused(self, *more, strategy="obb", out="out.gpkg", words=()):
        blocks = self.blocks(SQUARE)
        result = plat("subdivide", "--blocks", blocks, "--strategy", strategy, *more, "--out", self.path(out))
        self.assert_refused(result, *words)
        self.assert_only("blocks.gpkg")

    def test_unknown_strategy_is_suggested(self):
        self.refused(strategy="skeletn", words=('"skeletn"', 'did you mean "skeleton"', "known: border_voronoi, cube_packing"))

    def test_misspelt_option_is_suggested(self):
        self.refused("--set", "area_maxm2=3", words=("obb", '"area_maxm2"', 'did you mean "area_max_m2"'))

    def test_option_out_of_range(self):
        self.refused("--set", "street_access=1.5", words=("obb", "street_access", "1.5", "0..1"))
        self.refused("--set", "street_access=nan", words=("obb", "street_access"))

    def test_option_of_the_wrong_type(self):
        self.refused("--set", "street_access=often", words=("obb", "street_access", "number"))
        self.refused("--set", "corners=3", strategy="skeleton", words=("skeleton", "corners"))
        self.refused("--set", "corners=widest", strategy="skeleton", words=("widest", "street_width"))

    def test_option_without_a_value_or_given_twice(self):
        self.refused("--set", "street_access", words=("street_access", "="))
        self.refused("--set", "omega=1", "--set", "omega=2", words=("omega",))

    def test_output_that_cannot_be_written(self):
        self.refused(out="out.shp", words=("out.shp", ".gpkg"))
        self.refused(out="none/out.gpkg", words=("none", "make it"))

    @unittest.skipUnless(os.path.isdir("/proc/self"), "needs a folder that not even root may write to")
    def test_a_folder_where_no_file_can_be_made(self):
        blocks = self.blocks(SQUARE)
        result = plat("subdivide", "--blocks", blocks, "--strategy", "obb", "--out", "/proc/out.gpkg")
        self.assert_refused(result, "/proc/out.gpkg", "written")
        self.assert_only("blocks.gpkg")

    @unittest.skipIf(os.geteuid() == 0, "root may write anywhere")
    def test_unwritable_output_folder(self):
        closed = self.path("closed")
        closed.mkdir(mode=0o500)
        blocks = self.blocks(SQUARE)
        result = plat("subdivide", "--blocks", blocks, "--strategy", "obb", "--out", closed / "o.gpkg")
        self.assert_refused(result, "closed", "written")

    def test_the_input_is_not_overwritten(self):
        blocks = self.blocks(SQUARE)
        before = blocks.read_bytes()
        for source in (blocks, f"{blocks}:blocks"):
            result = plat("subdivide", "--blocks", source, "--strategy", "obb", "--out", blocks)
            self.assert_refused(result, "blocks.gpkg", "input")
        self.assertEqual(blocks.read_bytes(), before)

    def test_an_old_output_survives_a_refused_run(self):
        out = self.path("out.gpkg")
        self.assert_status(plat("subdivide", "--blocks", self.blocks(SQUARE), "--strategy", "obb", "--out", out), DONE)
        before = out.read_bytes()
        result = plat("subdivide", "--blocks", self.path("none.gpkg"), "--strategy", "obb", "--out", out)
        self.assert_refused(result, "none.gpkg")
        self.assertEqual(out.read_bytes(), before)


class BadRuns(CliTest):
    CONFIG = {"experiment": "e", "datasets": ["prague_bubenec_cz"], "strategies": [{"name": "obb"}]}

    def refused(self, change, *words):
        config = self.path("config.json")
        config.write_text(change if isinstance(change, str) else json.dumps({**self.CONFIG, **change}))
        self.assert_refused(plat("run", config, "--out", self.path("out")), "config.json", *words)
        self.assert_only("config.json")

    def test_bad_json(self):
        self.refused("{", "not valid JSON", "byte")
        self.refused("[]", "JSON object")
        self.refused("\xff\xfe", "not valid JSON")

    def test_unknown_key_is_suggested(self):
        self.refused({"repetition": 2}, '"repetition"', 'did you mean "repetitions"')

    def test_wrong_values(self):
        self.refused({"repetitions": 0}, "repetitions", "1..")
        self.refused({"repetitions": 1.5}, "repetitions", "whole")
        self.refused({"repetitions": "two"}, "repetitions", "whole")
        self.refused({"seed": -1}, "seed")
        self.refused({"datasets": []}, "datasets", "list")
        self.refused({"datasets": "prague_bubenec_cz"}, "datasets", "list")
        self.refused({"strategies": [{"name": "obb"}, {"name": "obb"}]}, "label")
        self.refused({"strategies": [{"name": "obb", "label": "observed"}]}, "label", "observed")
        self.refused({"strategies": [{"name": "obb", "label": "../x"}]}, "label")
        self.refused({"strategies": ["obb"]}, "JSON object")
        self.refused({"strategies": [{"name": "obb", "fit": "all"}]}, "fit", "per_block")
        self.refused({"strategies": [{"name": "obb", "options": {"snap_m": [1]}}]}, "snap_m")
        self.refused({"statistics": {"resample": 3}}, "statistics", "resample")

    def test_names_in_a_config_are_suggested_with_the_file(self):
        self.refused({"datasets": ["prague"]}, "prague")
        self.refused({"strategies": [{"name": "ob"}]}, 'did you mean "obb"')
        self.refused({"strategies": [{"name": "obb", "options": {"snapm": 1}}]}, 'did you mean "snap_m"')

    def test_unknown_experiment_and_data_set(self):
        result = plat("run", "parcels_vs_observd", "--out", self.path("out"))
        self.assert_refused(result, 'did you mean "parcels_vs_observed"')
        result = plat("run", "parcels_vs_observed", "--data", "cambridge", "--out", self.path("out"))
        self.assert_refused(result, "cambridge", 'did you mean "cambridge_ma"')
        self.assert_only()

    def test_a_data_set_that_is_not_there_says_how_to_get_it(self):
        here = {"PLAT_DATA_DIR": str(self.folder)}
        result = plat("run", "parcels_vs_observed", "--data", "cambridge_ma", "--out", self.path("out"), env=here)
        self.assert_refused(result, "cambridge_ma", "plat data fetch cambridge_ma")
        self.assert_only()

    def test_output_folder_that_is_a_file(self):
        self.path("taken").write_text("mine")
        result = plat("run", "parcels_vs_observed", "--data", "prague_bubenec_cz", "--out", self.path("taken"))
        self.assert_refused(result, "taken")
        self.assertEqual(self.path("taken").read_text(), "mine")

    def test_report_on_a_folder_that_is_no_run(self):
        self.assert_refused(plat("report", self.folder), "manifest.json", "plat run")
        self.assert_refused(plat("report", self.path("none")), "manifest.json")
        self.path("manifest.json").write_text("{}")
        self.assert_refused(plat("report", self.folder))
        self.assert_only("manifest.json")

    def test_a_damaged_data_set_is_refused(self):
        folder = self.path("prague_bubenec_cz")
        folder.mkdir()
        (folder / "prague_bubenec_cz.gpkg").write_text("no database")
        here = {"PLAT_DATA_DIR": str(self.folder)}
        result = plat("run", "parcels_vs_observed", "--data", "prague_bubenec_cz", "--out", self.path("out"), env=here)
        self.assert_refused(result, "prague_bubenec_cz.gpkg")
        self.assertFalse(list(pathlib.Path(self.folder).glob("out/*")))


class BadStreets(CliTest):
    def test_blocks_without_any_input(self):
        self.assert_refused(plat("blocks", "--out", self.path("o.gpkg")), "--streets")
        self.assert_only()

    def test_streets_without_a_geometry(self):
        path = self.path("table.gpkg")
        with fiona.open(
            path, "w", driver="GPKG", layer="table", crs="EPSG:32633", schema={"geometry": "None", "properties": {"a": "int"}}
        ) as out:
            out.write({"geometry": None, "properties": {"a": 1}})
        self.assert_refused(plat("blocks", "--streets", path, "--out", self.path("o.gpkg")), "table.gpkg")
        self.assert_only("table.gpkg")

    def test_streets_that_enclose_nothing(self):
        path = write_layer(self.path("s.gpkg"), "streets", [[(0, 0), (100, 0)]], kind="LineString")
        result = plat("blocks", "--streets", path, "--out", self.path("o.gpkg"))
        self.assert_status(result, DONE)
        self.assertIn("0 blocks", result.stdout)

    def test_four_streets_make_a_block_that_can_be_divided(self):
        ring = [[(0, 0), (200, 0)], [(200, 0), (200, 90)], [(200, 90), (0, 90)], [(0, 90), (0, 0)]]
        path = write_layer(self.path("s.gpkg"), "streets", ring, kind="LineString")
        self.assert_status(plat("blocks", "--streets", path, "--out", self.path("b.gpkg")), DONE)
        source = f"{self.path('b.gpkg')}:blocks"
        result = plat("subdivide", "--blocks", source, "--streets", path, "--strategy", "skeleton", "--out", self.path("p.gpkg"))
        self.assert_status(result, DONE)
        self.assertTrue(read_layer(self.path("p.gpkg"), "parcels"))


if __name__ == "__main__":
    unittest.main()
