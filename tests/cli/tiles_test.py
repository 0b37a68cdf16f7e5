"""plat tiles: what it makes of small maps and of real cities, and what it refuses."""

import unittest

from plat_cli import BAD_INPUT, DONE, FAILURES, ORIGIN, CliTest, catalogue_has, plat, read_layer, rectangle, write_layer


def shared_vertices(a, b):
    """How many points two polygons have in common, exactly."""
    points = [{tuple(p[:2]) for ring in shape["coordinates"] for p in ring} for shape in (a, b)]
    return len(points[0] & points[1])


class Tiles(CliTest):
    def parcels(self, *rings):
        return write_layer(self.path("parcels.gpkg"), "parcels", [[ring] for ring in rings])

    def tiles(self, *arguments, status=DONE):
        out = self.path("tiles.gpkg")
        result = plat("tiles", *arguments, "--out", out)
        self.assert_status(result, status)
        return out, result.stdout

    def test_gaps_are_closed_and_what_touches_shares_vertices(self):
        parcels = self.parcels(rectangle(0, 0, 20, 30), rectangle(20.4, 0, 20, 30), rectangle(60, 0, 20, 30))
        out, printed = self.tiles("--parcels", f"{parcels}:parcels")
        shapes = [shape for _, shape in read_layer(out, "tiles")]
        self.assertEqual(len(shapes), 3)
        self.assertEqual(shared_vertices(shapes[0], shapes[1]), 2)
        self.assertEqual(len(read_layer(out, "joints")), 2)
        self.assertIn("1 streets, 1 boundaries, 3 tiles", printed)

    def test_links_lie_on_the_streets_that_are_given(self):
        parcels = self.parcels(rectangle(0, 0, 20, 30), rectangle(40, 0, 20, 30))
        streets = write_layer(self.path("streets.gpkg"), "streets", [[(33, -50), (33, 80)]], kind="LineString")
        out, _ = self.tiles("--parcels", f"{parcels}:parcels", "--streets", f"{streets}:streets")
        links = read_layer(out, "links")
        self.assertEqual(len(links), 2)
        for row, shape in links:
            self.assertAlmostEqual(row["width_m"], 20.0)
            self.assertAlmostEqual(shape["coordinates"][1][0] - ORIGIN[0], 33.0)

    def test_the_zone_comes_from_the_field_that_is_named(self):
        parcels = self.parcels(rectangle(0, 0, 20, 30))
        out, _ = self.tiles("--parcels", f"{parcels}:parcels", "--zone-field", "name")
        self.assertEqual(read_layer(out, "tiles")[0][0]["zone"], "f0")

    def test_only_the_nearest_are_taken(self):
        parcels = self.parcels(*(rectangle(40 * i, 0, 20, 30) for i in range(5)))
        near = (ORIGIN[0] + 170, ORIGIN[1])
        out, _ = self.tiles("--parcels", f"{parcels}:parcels", "--count", 2, "--near", *near)
        self.assertEqual([row["source_id"] for row, _ in read_layer(out, "tiles")], ["4", "5"])

    def test_an_overlap_is_a_failure_with_its_reason(self):
        parcels = self.parcels(rectangle(0, 0, 20, 30), rectangle(10, 5, 20, 15))
        out, _ = self.tiles("--parcels", f"{parcels}:parcels", status=FAILURES)
        self.assertEqual([row["code"] for row, _ in read_layer(out, "failures")], ["tiles_overlap"])

    def test_the_same_input_gives_the_same_bytes(self):
        parcels = self.parcels(rectangle(0, 0, 20, 30), rectangle(20.4, 0, 20, 30), rectangle(60, 0, 20, 30))
        files = []
        for jobs in (1, 3):
            out, _ = self.tiles("--parcels", f"{parcels}:parcels", "--jobs", jobs)
            files.append(out.read_bytes())
        self.assertEqual(files[0], files[1])

    def test_bad_arguments_are_refused(self):
        parcels = self.parcels(rectangle(0, 0, 20, 30))
        for arguments, word in (
            ((), "--dataset or --parcels"),
            (("--dataset", "cambridge_ma", "--parcels", parcels), "--dataset or --parcels"),
            (("--dataset", "cambridge_ma", "--zone-field", "name"), "go with --parcels"),
            (("--dataset", "atlantis"), "atlantis"),
            (("--parcels", parcels, "--zone-field", "nam"), 'no field "nam"'),
            (("--parcels", parcels, "--near", 1, 2), "--count"),
        ):
            with self.subTest(arguments=arguments):
                result = plat("tiles", *arguments, "--out", self.path("out.gpkg"))
                self.assert_status(result, BAD_INPUT)
                self.assertIn(word, result.stderr)


class RealPlaces(CliTest):
    def counts(self, *arguments):
        result = plat("tiles", *arguments, "--out", self.path("tiles.gpkg"), timeout=600)
        self.assertIn(result.returncode, (DONE, FAILURES), result.stderr)
        words = result.stdout.replace(",", "").split()
        return {name: int(words[words.index(name) - 1])
                for name in ("streets", "boundaries", "tiles", "joints", "links", "failures")}

    @unittest.skipUnless(catalogue_has("cambridge_ma"), "needs the data set cambridge_ma")
    def test_two_thousand_tiles_of_cambridge(self):
        counts = self.counts("--dataset", "cambridge_ma", "--near", 233000, 901000, "--count", 2000)
        self.assertEqual(counts["tiles"] + counts["failures"], 2000)
        self.assertLess(counts["failures"], 10)
        self.assertGreater(counts["boundaries"], counts["tiles"])
        self.assertGreater(counts["links"], counts["tiles"])

    @unittest.skipUnless(catalogue_has("campo_grande_br"), "needs the data set campo_grande_br")
    def test_blocks_are_tiles_where_there_are_no_parcels(self):
        counts = self.counts("--dataset", "campo_grande_br", "--count", 500)
        self.assertEqual((counts["boundaries"], counts["joints"]), (0, 0))
        self.assertGreater(counts["links"], 2 * counts["tiles"])


if __name__ == "__main__":
    unittest.main()
