"""`plat similarity`: clusters, the matrix and its file, the layers that a GIS opens."""

import json
import unittest

from plat_cli import DONE, FAILURES, CliTest, plat, read_layer, rectangle, write_layer

# Two rows of lots, small ones in the first, large ones in the second.
LOTS = [[rectangle(12 * i, 0, 12, 30 + i % 3)] for i in range(8)] + [[rectangle(60 * i, 60, 60, 80 + i)] for i in range(6)]


class Similarity(CliTest):
    def lots(self, name="lots.gpkg", geometries=None, **how):
        return write_layer(self.path(name), "lots", geometries or LOTS, **how)

    def run_on(self, tiles, *more, status=DONE):
        out = self.path("out.gpkg")
        result = plat("similarity", "--tiles", tiles, "--clusters", "percent=15", "--measure", "box", "--out", out, *more)
        self.assert_status(result, status)
        return out, result

    def test_every_tile_has_a_cluster_and_its_nearest_in_it(self):
        out, _ = self.run_on(self.lots(), "--nearest", 2)
        tiles = {row["source_id"]: row for row, _ in read_layer(out, "tiles")}
        self.assertEqual(len(tiles), len(LOTS))
        self.assertEqual({row["cluster"] for row in tiles.values()}, {0, 1})
        for row in tiles.values():
            self.assertEqual(tiles[row["nearest_1"]]["cluster"], row["cluster"])
            self.assertLessEqual(row["distance_1"], row["distance_2"])
        # Lots of one size stay together.
        self.assertEqual(len({row["cluster"] for row in list(tiles.values())[:8]}), 1)
        for cluster in (0, 1):
            self.assertEqual(sum(row["is_representative"] for row in tiles.values() if row["cluster"] == cluster), 1)

    def test_a_line_leads_to_each_nearest_tile(self):
        out, _ = self.run_on(self.lots(), "--nearest", 3)
        lines = read_layer(out, "nearest")
        self.assertEqual(len(lines), 3 * len(LOTS))
        self.assertTrue(all(len(geometry["coordinates"]) == 2 for _, geometry in lines))
        self.assertEqual({row["rank"] for row, _ in lines}, {1, 2, 3})

    def test_the_matrix_is_computed_once_and_again_when_tiles_change(self):
        lots, matrix = self.lots(), self.path("m.platsim")
        _, first = self.run_on(lots, "--matrix", matrix)
        self.assertIn("was not there", first.stdout)
        whole = matrix.read_bytes()
        out, second = self.run_on(lots, "--matrix", matrix)
        self.assertIn("read, nothing was computed again", second.stdout)
        layers = out.read_bytes()
        changed = self.lots("changed.gpkg", LOTS[:-1] + [[rectangle(300, 60, 55, 85)]])
        _, third = self.run_on(changed, "--matrix", matrix)
        self.assertIn("stale", third.stdout)
        matrix.write_bytes(whole[:-40] + b"x" + whole[-39:])
        out, fourth = self.run_on(lots, "--matrix", matrix)
        self.assertIn("damaged", fourth.stdout)
        self.assertEqual(matrix.read_bytes(), whole)
        self.assertEqual(out.read_bytes(), layers)

    def test_pruning_keeps_so_many_distances_per_tile(self):
        _, all_of_them = self.run_on(self.lots())
        _, kept = self.run_on(self.lots("again.gpkg"), "--keep", 2, "--cheap", "descriptor")
        self.assertIn(f"{2 * len(LOTS)} distances", kept.stdout)
        self.assertNotIn(f" {2 * len(LOTS)} distances", all_of_them.stdout)

    def test_zones_are_read_and_weigh(self):
        # The field "name" is another one for every lot: as a zone of great weight it makes every lot a cluster.
        out = self.path("out.gpkg")
        self.assert_status(plat("similarity", "--tiles", self.lots(), "--zone-field", "name", "--clusters", "percent=100",
                                "--clusters", "zone_weight=50", "--measure", "descriptor", "--out", out), DONE)
        rows = [row for row, _ in read_layer(out, "tiles")]
        self.assertEqual(len({row["cluster"] for row in rows}), len(LOTS))
        self.assertEqual(rows[3]["zone"], "f3")

    def test_the_same_seed_gives_the_same_bytes_for_any_number_of_threads(self):
        lots = self.lots()
        outputs = []
        for jobs in (1, 2):
            out, _ = self.run_on(lots, "--jobs", jobs)
            outputs.append(out.read_bytes())
        self.assertEqual(*outputs)

    def test_what_is_no_tile_is_a_failure_with_its_id(self):
        bow = [[(200, 0), (220, 20), (220, 0), (200, 20), (200, 0)]]
        out, result = self.run_on(self.lots(geometries=LOTS + [bow]), status=FAILURES)
        self.assertIn("1 failures", result.stdout)
        self.assertEqual(len(read_layer(out, "failures")), 1)
        self.assertEqual(len(read_layer(out, "tiles")), len(LOTS))

    def test_every_measure_of_the_menu_runs(self):
        menu = json.loads(plat("list", "strategies", "--json").stdout)
        names = [entry["name"] for entry in menu if entry["family"] == "shape_similarity"]
        self.assertIn("affine_vertex", names)
        for name in names:
            out = self.path(f"{name}.gpkg")
            self.assert_status(plat("similarity", "--tiles", self.lots(f"{name}_lots.gpkg"), "--clusters", "percent=15",
                                    "--measure", name, "--out", out), DONE)

    def test_bad_input_is_refused_and_nothing_is_written(self):
        lots, out = self.lots(), self.path("out.gpkg")
        for words, said in ((["--measure", "bx"], ("bx", "box")), (["--set", "nonsense=1"], ("nonsense",)),
                            (["--clusters", "percent=0"], ("percent", "100")), (["--clusters", "percnt=1"], ("percnt",)),
                            (["--zone-field", "zone"], ("zone", "name")), (["--matrix", self.path("m.bin")], (".platsim",)),
                            (["--matrix", self.path("none/m.platsim")], ("none",)), (["--keep", 2, "--cheap", "cheapest"],
                                                                                   ("cheapest",))):
            with self.subTest(words=words):
                self.assert_refused(plat("similarity", "--tiles", lots, "--out", out, *words), *said)
        other = self.path("other.platsim")
        other.write_text("my thesis")
        self.assert_refused(plat("similarity", "--tiles", lots, "--out", out, "--matrix", other), "other.platsim")
        self.assertEqual(other.read_text(), "my thesis")
        self.assert_only("lots.gpkg", "other.platsim")


if __name__ == "__main__":
    unittest.main()
