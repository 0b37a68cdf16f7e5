"""Layouts of tiles that a displacement has changed: scenes of experiments/tile_displacement, their layers and measures."""

import json

import numpy
from shapely.ops import unary_union

from figure import FigureError
from places import layer


class Shown:
    """What tile_displacement made of a scene."""

    def __init__(self, figure, name, scene):
        figure.dataset(scene["city"]["dataset"])
        path, self.out = figure.path(f"{name}.json"), figure.path(name)
        path.write_text(json.dumps(scene, indent=1) + "\n", encoding="utf-8")
        figure.program("tile_displacement", "--scene", path, "--out", self.out)
        self.measures = json.loads((self.out / "measures.json").read_text(encoding="utf-8"))
        for way, errors in self.measures.get("ways", {}).items():
            if "failure" in errors:
                raise FigureError(f"{name}: {way}: {errors['failure']}")

    def tiles(self, name="observed"):
        return layer(self.out / "tiles.gpkg", name)

    def errors(self, way):
        return self.measures["ways"][way]


def turns_deg(tiles):
    """By how much each tile is turned, counter-clockwise."""
    return numpy.degrees(numpy.arctan2(tiles["yx"] - tiles["xy"], tiles["xx"] + tiles["yy"]))


def blocks_of(tiles):
    """Block -> the union of its tiles."""
    return {block: unary_union([g.buffer(0) for g in part.geometry]) for block, part in tiles.groupby("block")}


def box_aspect(shape):
    """Longer over shorter side of the smallest rectangle around a shape."""
    corners = numpy.asarray(shape.minimum_rotated_rectangle.exterior.coords)
    sides = numpy.hypot(*numpy.diff(corners[:3], axis=0).T)
    return sides.max() / max(sides.min(), 1e-3)


def ranks(values):
    """Mean ranks of ties are not needed here: values are continuous."""
    out = numpy.empty(len(values))
    out[numpy.argsort(values, kind="stable")] = numpy.arange(len(values))
    return out


def rank_correlation(a, b):
    return float(numpy.corrcoef(ranks(numpy.asarray(a)), ranks(numpy.asarray(b)))[0, 1])
