"""Blocks drawn for a figure, where the paper draws a schema and not a city."""

import json

import geopandas
from figure import FigureError
from places import layer
from shapely.geometry import LineString, Polygon

#: A metric CRS and a place in it; where the block stands means nothing.
CRS = "EPSG:32633"
ORIGIN = (458000.0, 5550000.0)
#: Distance of a made street's centreline from the block it bounds, and its width unless said, metres.
STREET_DISTANCE_M = 6.0
STREET_WIDTH_M = 12.0


def placed(points):
    return [(x + ORIGIN[0], y + ORIGIN[1]) for x, y in points]


class MadeBlock:
    """One block and the streets around it in `file`, layers blocks and streets.

    `streets` are (first, last, width): the contour's edges first to last lie on one street. Without them each run of
    edges that turn little is a street.
    """

    def __init__(self, figure, name, contour, streets=()):
        self.file = figure.path(f"{name}.gpkg")
        self.shape = Polygon(placed(contour))
        geopandas.GeoDataFrame({"name": [name]}, geometry=[self.shape], crs=CRS).to_file(
            self.file, layer="blocks", driver="GPKG")
        self.blocks = f"{self.file}:blocks"
        self.streets = ""
        if streets:
            lines = [_street(self.shape, first, last) for first, last, _ in streets]
            geopandas.GeoDataFrame({"name": [f"street {i}" for i in range(len(streets))],
                                    "width": [width for _, _, width in streets]}, geometry=lines, crs=CRS).to_file(
                self.file, layer="streets", driver="GPKG")
            self.streets = f"{self.file}:streets"


def _street(shape, first, last):
    """The edges first to last of the contour, moved outwards."""
    corners = list(shape.exterior.coords)[:-1]
    chain = LineString([corners[i % len(corners)] for i in range(first, last + 2)])
    outside = chain.parallel_offset(STREET_DISTANCE_M, "right", join_style=2)
    # GEOS may turn the line round; a centreline has no direction that matters here.
    return outside


#: Keys of an edit script that hold places, which the scripts here give relative to ORIGIN.
POINT_KEYS = ("to", "from", "center", "at")


def _placed_edit(value, key=""):
    if isinstance(value, dict):
        return {k: _placed_edit(v, k) for k, v in value.items()}
    if key in POINT_KEYS:
        return list(placed([value])[0])
    if key == "controls":
        return [list(p) for p in placed(value)]
    return value


def made_city(figure, name, streets, strategy, settings, edits=(), width_m=STREET_WIDTH_M):
    """A street network given as chains of points, its blocks and parcels, after the first edits (`plat edit`)."""
    file = figure.path(f"{name}_streets.gpkg")
    geopandas.GeoDataFrame({"name": [f"street {i}" for i in range(len(streets))], "width": float(width_m)},
                           geometry=[LineString(placed(s)) for s in streets], crs=CRS).to_file(
        file, layer="streets", driver="GPKG")
    blocks = figure.path(f"{name}_blocks.gpkg")
    figure.plat("blocks", "--streets", f"{file}:streets", "--out", blocks)
    words = [word for key, value in settings.items() for word in ("--set", f"{key}={value}")]
    return edited(figure, name, blocks, edits, "--strategy", strategy, *words)


def edited(figure, name, city, edits, *words):
    """The layers of a city after a list of edits, and its file."""
    script = figure.path(f"{name}.json")
    script.write_text(json.dumps({"edits": [_placed_edit(edit) for edit in edits]}, indent=1), encoding="utf-8")
    out = figure.path(f"{name}.gpkg")
    said = figure.plat("edit", script, "--city", city, "--out", out, *words)
    if "refused" in said.replace("0 of", "").split("edits refused")[0]:
        raise FigureError(f"{name}: {said.splitlines()[0]}")
    layers = {key: layer(out, key) for key in ("streets", "blocks", "parcels")}
    figure.note_failures(name, len(layer(out, "failures")), len(layers["blocks"]))
    return {"file": out, "said": said, **layers}
