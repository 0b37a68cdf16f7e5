"""The empty block of figures 6.10 and 6.11: a face of the centrelines, the building's axis in it, the footprints around."""

import os
import pathlib

import geopandas
import numpy
from buildings import build
from shapely.geometry import Polygon
from shapely.ops import polygonize, unary_union

#: From the centrelines to the axis: half a street, a front garden, half a building.
OFFSET_M = 15.0


class EmptyBlock:
    """Coordinates are metres from the middle of the block."""

    def __init__(self, figure, window):
        source = figure.dataset(window.dataset)
        read = {key: _read(source["observed"][key]["layer"]) for key in ("streets", "footprints")}
        faces = [f for f in polygonize(unary_union(list(read["streets"].geometry))) if f.within(window.shape())]
        self.face = max(faces, key=lambda f: f.area).simplify(0.5)
        self.origin = numpy.round(numpy.array(self.face.centroid.coords[0]))
        self.streets = read["streets"].translate(*-self.origin)
        self.footprints = read["footprints"].translate(*-self.origin)
        self.face = geopandas.GeoSeries([self.face]).translate(*-self.origin).iloc[0]
        self.inside = self.footprints.representative_point().within(self.face)
        self.design = {"name": "block", "contour": {
            "ring": [[round(x, 3), round(y, 3)] for x, y in list(self.face.exterior.coords)[:-1]],
            "offset_m": OFFSET_M, "min_edge_m": 18}}

    def build(self, figure, parts):
        (building,), _ = build(figure, "block", self.design, parts)
        return building

    @staticmethod
    def axis(building):
        """The offset polygon: where the parts of the building meet, joined."""
        return Polygon([row["from_m"] for row in _in_order(building.report["rows"])])


def _in_order(rows):
    """Rows of a closed skeleton, each beginning where the one before ends."""
    rows, out = list(rows), []
    out.append(rows.pop(0))
    while rows:
        at = min(range(len(rows)), key=lambda i: numpy.hypot(*numpy.subtract(rows[i]["from_m"], out[-1]["to_m"])))
        out.append(rows.pop(at))
    return out


def _read(name):
    file, layer = name.rsplit(":", 1)
    return geopandas.read_file(pathlib.Path(os.environ["PLAT_DATA_DIR"]) / file, layer=layer)
