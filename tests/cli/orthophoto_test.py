"""plat orthophoto: a GeoTIFF where the map is, that says it is rendered."""

import subprocess
import unittest

from osgeo import gdal
from plat_cli import DONE, ORIGIN, CliTest, plat, rectangle, write_layer

gdal.UseExceptions()
WINDOW = (ORIGIN[0] - 10, ORIGIN[1] - 20, ORIGIN[0] + 90, ORIGIN[1] + 40)


class Orthophoto(CliTest):
    def city(self):
        """Four parcels with houses along a street, and a pond, as one GeoPackage."""
        city = self.path("city.gpkg")
        write_layer(city, "parcels", [[rectangle(20 * i, 0, 20, 30)] for i in range(4)])
        write_layer(city, "buildings", [[rectangle(20 * i + 4, 6, 11, 12)] for i in range(4)])
        write_layer(city, "water", [[rectangle(0, 32, 80, 20)]])
        write_layer(city, "streets", [[(-10, -6), (90, -6)]], kind="LineString")
        return city

    def render(self, *more, out="out.tif"):
        return plat("orthophoto", *more, "--out", self.path(out))

    def test_a_window_of_a_city_is_a_geotiff_that_says_it_is_rendered(self):
        result = self.render("--city", self.city(), "--window", *WINDOW, "--pixel", 0.5)
        self.assert_status(result, DONE)
        self.assertIn("rendered", result.stdout)
        self.assertIn("4 heights assumed", result.stdout)
        image = gdal.Open(str(self.path("out.tif")))
        self.assertEqual((image.RasterXSize, image.RasterYSize, image.RasterCount), (200, 120, 3))
        self.assertEqual(image.GetGeoTransform(), (WINDOW[0], 0.5, 0.0, WINDOW[3], 0.0, -0.5))
        self.assertEqual(image.GetSpatialRef().GetAuthorityCode(None), "32633")
        description = image.GetMetadataItem("TIFFTAG_IMAGEDESCRIPTION")
        self.assertEqual(description, "rendered by plat from map layers, not a photograph")
        red, _, blue = image.ReadAsArray()[:, 8:16, 60:140].reshape(3, -1).mean(axis=1)  # the pond
        self.assertGreater(blue, red)

    def test_layers_one_by_one_give_the_same_bytes_as_one_city(self):
        city = self.city()
        layers = [("--streets", "streets"), ("--parcels", "parcels"), ("--footprints", "buildings"), ("--water", "water")]
        named = [word for flag, layer in layers for word in (flag, f"{city}:{layer}")]
        self.assert_status(self.render("--city", city, "--pixel", 1, out="a.tif"), DONE)
        self.assert_status(self.render(*named, "--pixel", 1, "--jobs", 1, "--set", "tile_px=64", out="b.tif"), DONE)
        self.assertEqual(self.path("a.tif").read_bytes(), self.path("b.tif").read_bytes())
        self.assert_status(self.render("--city", city, "--pixel", 1, "--seed", 9, out="c.tif"), DONE)
        self.assertNotEqual(self.path("a.tif").read_bytes(), self.path("c.tif").read_bytes())

    def test_houses_are_assumed_where_the_map_has_none_and_counted(self):
        parcels = f"{self.city()}:parcels"
        self.assertIn(" 0 footprints assumed", self.render("--parcels", parcels, "--set", "missing_footprints=leave").stdout)
        self.assertNotIn(" 0 footprints assumed", self.render("--parcels", parcels).stdout)

    def test_gdalinfo_reads_it_without_a_warning(self):
        self.assert_status(self.render("--city", self.city(), "--jpeg"), DONE)
        info = subprocess.run(["gdalinfo", self.path("out.tif")], capture_output=True, text=True, check=True)
        self.assertEqual(info.stderr, "")

    def test_bad_input_is_refused_before_anything_is_written(self):
        city = self.city()
        far = (0, 0, 100, 100)
        for arguments, words in (
            (("--city", city, "--window", *far), ("--window", "covers")),
            (("--city", city, "--pixel", 0), ("pixel_m", "0.05")),
            (("--city", city, "--set", "climat=dry"), ("climat", "climate")),
            (("--city", self.path("none.gpkg")), ("none.gpkg", "no such file")),
            (("--parcels", f"{city}:plots"), ("plots", "parcels")),
            (("--footprints", f"{city}:buildings", "--height-field", "nam"), ("nam", "name")),
            ((), ("no layer is given",)),
        ):
            with self.subTest(arguments=arguments):
                self.assert_refused(self.render(*arguments), *words)
        self.assert_refused(self.render("--city", city, out="out.png"), ".tif")
        self.assert_only("city.gpkg")


if __name__ == "__main__":
    unittest.main()
