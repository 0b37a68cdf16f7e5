"""Blocks drawn for a figure, where the paper draws a schema and not a city."""

import geopandas
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
