"""plat imagery: every parcel is filled with the image of one like it, streets where streets are."""

import unittest

import numpy
from osgeo import gdal, osr
from plat_cli import CRS, DONE, FAILURES, ORIGIN, CliTest, plat, read_layer, rectangle, write_layer

gdal.UseExceptions()
osr.UseExceptions()

PIXEL_M = 0.5
#: Two rows of five lots, 12 x 30 m each, with streets all around.
LOTS = [rectangle(12 * i, 30 * row, 12, 30) for row in (0, 1) for i in range(5)]
GREEN, RED = (40, 160, 40), (200, 30, 30)


def write_image(path, colour_of, left=-20, top=80, width=100, height=100, crs=CRS):
    """A GeoTIFF: colour_of(x, y) at each pixel's centre, metres from ORIGIN."""
    columns, rows = int(width / PIXEL_M), int(height / PIXEL_M)
    pixels = numpy.zeros((3, rows, columns), dtype="uint8")
    for r in range(rows):
        for c in range(columns):
            pixels[:, r, c] = colour_of(left + (c + 0.5) * PIXEL_M, top - (r + 0.5) * PIXEL_M)
    image = gdal.GetDriverByName("GTiff").Create(str(path), columns, rows, 3, gdal.GDT_Byte)
    image.SetGeoTransform((ORIGIN[0] + left, PIXEL_M, 0, ORIGIN[1] + top, 0, -PIXEL_M))
    reference = osr.SpatialReference()
    reference.SetFromUserInput(crs)
    image.SetProjection(reference.ExportToWkt())
    image.SetMetadataItem("TIFFTAG_IMAGEDESCRIPTION", "rendered for a test")
    image.WriteArray(pixels)
    image = None  # closes the file
    return path


class Image:
    """What a GeoTIFF holds, by metres from ORIGIN."""

    def __init__(self, path):
        data = gdal.Open(str(path))
        self.place = data.GetGeoTransform()
        self.pixels = data.ReadAsArray()
        self.description = data.GetMetadataItem("TIFFTAG_IMAGEDESCRIPTION")

    def index(self, x, y):
        """Column and row of the pixel at a place."""
        return (int((ORIGIN[0] + x - self.place[0]) / self.place[1]), int((ORIGIN[1] + y - self.place[3]) / self.place[5]))

    def at(self, x, y):
        column, row = self.index(x, y)
        return tuple(int(v) for v in self.pixels[:, row, column])


def front_and_back(_, y):
    """Red within 8 m of the street south or north, green behind."""
    return RED if y < 8 or y > 52 else GREEN


class Imagery(CliTest):
    def city(self, name, lots):
        """A city whose blocks are the rectangle around the lots."""
        path = write_layer(self.path(name), "parcels", [[lot] for lot in lots])
        xs, ys = [x for lot in lots for x, _ in lot], [y for lot in lots for _, y in lot]
        block = rectangle(min(xs), min(ys), max(xs) - min(xs), max(ys) - min(ys))
        return write_layer(path, "blocks", [[block]])

    def fill(self, *more, city="new.gpkg", out="out.tif"):
        return plat("imagery", "--city", self.path(city), "--example", self.path("old.gpkg"), "--image",
                    self.path("old.tif"), *more, "--out", self.path(out))

    def make_example(self, colour_of=front_and_back):
        self.city("old.gpkg", LOTS)
        write_image(self.path("old.tif"), colour_of)

    def image(self):
        return Image(self.path("out.tif"))

    def test_fronts_of_new_parcels_show_the_fronts_of_examples(self):
        self.make_example()
        # The same lots turned by a quarter: streets west and east.
        self.city("new.gpkg", [rectangle(30 * column, 12 * i, 30, 12) for column in (0, 1) for i in range(5)])
        self.assert_status(self.fill(), DONE)
        image = self.image()
        for y in (30, 6, 54):
            self.assertEqual([image.at(x, y) for x in (3, 20, 40, 57)], [RED, GREEN, GREEN, RED])

    def test_the_report_tells_sources_warps_and_repetition(self):
        self.make_example()
        self.city("new.gpkg", LOTS)
        self.assert_status(self.fill("--report", self.path("report.gpkg")), DONE)
        rows = [p for p, _ in read_layer(self.path("report.gpkg"), "imagery")]
        self.assertEqual(len(rows), len(LOTS))
        for row in rows:
            self.assertEqual((row["warp"], row["match"], row["outside_01"]), ("scan_lines", "front_and_zone", 0.0))
            self.assertAlmostEqual(row["stretch_median"], 1.0, places=6)
            self.assertAlmostEqual(row["area_ratio"], 1.0, places=6)
        self.assertEqual(sum(1 / row["uses"] for row in rows), len({row["source_parcel"] for row in rows}))
        self.assertEqual(read_layer(self.path("report.gpkg"), "failures"), [])

    def test_the_grid_shows_the_points_that_correspond(self):
        self.make_example()
        self.city("new.gpkg", LOTS)
        report = self.path("report.gpkg")
        self.assert_status(self.fill("--report", report, "--grid", 5, 3), DONE)
        target, source = read_layer(report, "target_grid"), read_layer(report, "source_grid")
        self.assertEqual(len(target), len(LOTS) * 15)
        self.assertEqual([p for p, _ in target], [p for p, _ in source])
        self.assert_refused(self.fill("--grid", 5, 3), "--grid", "--report")

    def test_no_ground_shows_between_parcels(self):
        self.make_example(lambda x, y: (10, 20, 250))
        self.city("new.gpkg", [rectangle(13.3 * i, 0, 13.3, 31) for i in range(4)])
        self.assert_status(self.fill(), DONE)
        image = self.image()
        (west, south), (east, north) = image.index(1, 1), image.index(52, 30)
        inside = image.pixels[:, north:south, west:east]
        self.assertGreater(inside.size, 0)
        self.assertTrue((inside == numpy.array([10, 20, 250])[:, None, None]).all())

    def test_two_sources_are_mixed_along_a_ramp(self):
        self.make_example(lambda x, y: RED)
        write_image(self.path("green.tif"), lambda x, y: GREEN)
        lots = [rectangle(12 * i, 30 * row, 12, 30) for row in (0, 1) for i in range(60)]
        self.city("new.gpkg", lots)
        ramp = [ORIGIN[0], ORIGIN[1], ORIGIN[0] + 720, ORIGIN[1]]
        self.assert_status(self.fill("--example2", self.path("old.gpkg"), "--image2", self.path("green.tif"),
                                     "--weight", 0, 1, "--ramp", *ramp), DONE)
        image = self.image()
        west = [image.at(6 + 12 * i, y) for i in range(20) for y in (15, 45)]
        east = [image.at(6 + 12 * i, y) for i in range(40, 60) for y in (15, 45)]
        self.assertEqual(set(west) | set(east), {RED, GREEN})
        self.assertGreater(west.count(RED), 28)
        self.assertGreater(east.count(GREEN), 28)

    def test_a_city_can_be_its_own_example_without_showing_itself(self):
        self.make_example()
        report = self.path("report.gpkg")
        self.assert_status(self.fill("--not-itself", "--report", report, city="old.gpkg"), DONE)
        for row, _ in read_layer(report, "imagery"):
            self.assertNotEqual(row["parcel"], row["source_parcel"])

    def test_same_seed_same_bytes_whatever_the_threads(self):
        self.make_example(lambda x, y: (int(x * 7) % 256, int(y * 5) % 256, 90))
        self.city("new.gpkg", [rectangle(11.7 * i, 0, 11.7, 30 + i) for i in range(9)])
        outputs = set()
        for jobs in (1, 2, 4):
            self.assert_status(self.fill("--jobs", jobs, "--set", "variety=5", "--seed", 3), DONE)
            outputs.add(self.path("out.tif").read_bytes())
        self.assertEqual(len(outputs), 1)
        self.assert_status(self.fill("--set", "variety=5", "--seed", 4), DONE)
        self.assertNotIn(self.path("out.tif").read_bytes(), outputs)

    def test_rendered_stays_written_on_what_is_made_of_it(self):
        self.make_example()
        self.city("new.gpkg", LOTS)
        self.assert_status(self.fill(), DONE)
        self.assertIn("rendered for a test", self.image().description)
        self.assertIn("synthesised", self.image().description)

    def test_a_parcel_without_area_is_a_row(self):
        self.make_example()
        self.city("new.gpkg", [*LOTS, [(200, 0), (210, 0), (205, 0), (200, 0)]])
        self.assert_status(self.fill("--report", self.path("report.gpkg")), FAILURES)
        self.assertEqual(len(read_layer(self.path("report.gpkg"), "failures")), 1)

    def test_bad_input_is_refused_before_anything_is_written(self):
        self.make_example()
        self.city("new.gpkg", LOTS)
        elsewhere = write_image(self.path("elsewhere.tif"), front_and_back, left=900)
        old = self.path("old.gpkg")
        self.assert_refused(self.fill(out="out.png"), "--out", ".tif")
        self.assert_refused(self.fill("--image2", elsewhere), "--example2")
        self.assert_refused(self.fill("--weight", 0.5), "--weight", "--example2")
        self.assert_refused(self.fill("--example2", old, "--image2", elsewhere, "--weight", 2), "0..1")
        self.assert_refused(self.fill("--example2", old, "--image2", elsewhere, "--weight", 0.5), elsewhere)
        self.assert_refused(self.fill("--example2", old, "--image2", self.path("old.tif"), "--weight", 0, 1), "--ramp")
        self.assert_refused(self.fill("--set", "varety=2"), "variety")
        self.assert_refused(self.fill("--pixel", 0.001, "--jobs", 1), "--pixel")
        self.assert_only("old.gpkg", "old.tif", "new.gpkg", "elsewhere.tif")


if __name__ == "__main__":
    unittest.main()
