"""Runs the plat binary and makes its small inputs; what every test of this folder uses."""

import json
import os
import pathlib
import subprocess
import tempfile
import unittest

import fiona

ROOT = pathlib.Path(__file__).resolve().parents[2]
BINARY = os.environ.get("PLAT_BINARY", str(ROOT / "build" / "release" / "plat"))
CRS = "EPSG:32633"
ORIGIN = (458000.0, 5550000.0)  # a place in that CRS

DONE, FAILURES, BAD_INPUT = 0, 1, 2


def plat(*arguments, env=None, timeout=300):
    """The finished process: returncode, stdout, stderr."""
    return subprocess.run(
        [BINARY, *map(str, arguments)],
        capture_output=True,
        text=True,
        timeout=timeout,
        check=False,
        env={**os.environ, **(env or {})},
    )


def rectangle(x, y, width, height):
    """A closed ring, metres from ORIGIN."""
    return [(x, y), (x + width, y), (x + width, y + height), (x, y + height), (x, y)]


def write_layer(path, layer, geometries, crs=CRS, kind="Polygon", shift=ORIGIN):
    """Adds a layer to a GeoPackage. Geometries are lists of rings (polygons) or one list of points (lines)."""
    def placed(points):
        return [(x + shift[0], y + shift[1]) for x, y in points]

    schema = {"geometry": kind, "properties": {"name": "str"}}
    options = {"crs": crs} if crs else {}
    with fiona.open(path, "w", driver="GPKG", layer=layer, schema=schema, **options) as out:
        for i, geometry in enumerate(geometries):
            coordinates = placed(geometry) if kind == "LineString" else [placed(ring) for ring in geometry]
            record = {"geometry": {"type": kind, "coordinates": coordinates}, "properties": {"name": f"f{i}"}}
            out.write(record)
    return path


def read_layer(path, layer):
    """(properties, geometry mapping or None) of every feature."""
    with fiona.open(path, layer=layer) as source:
        return [(dict(f["properties"]), f["geometry"]) for f in source]


def catalogue_has(name):
    """Whether the data set is in the data folder."""
    listed = json.loads(plat("list", "datasets", "--json").stdout)
    return any(d["name"] == name and d["is_present"] for d in listed)


class CliTest(unittest.TestCase):
    """A test with a folder of its own for files."""

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def path(self, name):
        return self.folder / name

    def blocks(self, *geometries, name="blocks.gpkg", **how):
        """A GeoPackage with one layer `blocks`."""
        return write_layer(self.path(name), "blocks", geometries, **how)

    def assert_status(self, result, status):
        self.assertEqual(result.returncode, status, f"\nstdout: {result.stdout}\nstderr: {result.stderr}")

    def assert_refused(self, result, *words):
        """Bad input: status 2, one line on standard error that begins "plat:" and holds the words."""
        self.assert_status(result, BAD_INPUT)
        lines = result.stderr.splitlines()
        self.assertEqual(len(lines), 1, result.stderr)
        self.assertTrue(lines[0].startswith("plat: "), lines[0])
        for word in words:
            self.assertIn(str(word), lines[0])

    def assert_only(self, *names):
        """The folder holds these files and no other: no output, no temporary was left."""
        self.assertEqual(sorted(p.name for p in self.folder.iterdir()), sorted(names))
