"""Images in figures: rendered orthophotos, parcels filled by `plat imagery`, and how both are drawn on a map."""

import geopandas
import numpy
from figure import FigureError
from matplotlib.patches import PathPatch
from places import layer
from shapely.geometry import LineString
from shapely.ops import unary_union

from maps import path_of


def rendered(figure, city, name, bounds, *more):
    """Path of the orthophoto that `plat orthophoto` renders of a GeoPackage with parcels and streets."""
    out = figure.path(f"{name}.tif")
    figure.plat("orthophoto", "--city", city, "--out", out, "--window", *[round(v) for v in bounds], *more)
    return out


def filled(figure, city, example, image, name, *more):
    """(image, report) of `plat imagery`: the parcels of `city` with images of those of `example`."""
    out, report = figure.path(f"{name}.tif"), figure.path(f"{name}_report.gpkg")
    figure.plat("imagery", "--city", city, "--example", example, "--image", image, "--out", out, "--report", report, *more)
    return out, report


def connected_share(streets, to):
    """Share of the streets' length that hangs together with one of `to`, ends within half a metre."""
    parts = unary_union([g.buffer(0.25) for g in [*streets.geometry, *to.geometry]])
    parts = [p for p in getattr(parts, "geoms", [parts]) if p.intersects(to.unary_union)]
    reached = unary_union(parts)
    return sum(g.length for g in streets.geometry if g.intersects(reached)) / streets.length.sum()


class Picture:
    """The pixels of a GeoTIFF and where they are."""

    def __init__(self, path):
        from osgeo import gdal

        gdal.UseExceptions()
        data = gdal.Open(str(path))
        self.left, self.pixel_m, _, self.top, _, _ = data.GetGeoTransform()
        self.pixels = numpy.moveaxis(data.ReadAsArray(), 0, -1)[:, :, :3]

    def draw(self, axes, clip_to=None):
        """`clip_to` is a polygon, or several: nothing is drawn outside."""
        rows, columns = self.pixels.shape[:2]
        extent = (self.left, self.left + columns * self.pixel_m, self.top - rows * self.pixel_m, self.top)
        limits = axes.get_xlim(), axes.get_ylim()
        shown = axes.imshow(self.pixels, extent=extent, interpolation="bilinear", zorder=0)
        if clip_to is not None:
            shown.set_clip_path(PathPatch(path_of(clip_to), transform=axes.transData))
        axes.set_xlim(limits[0])
        axes.set_ylim(limits[1])

    def at(self, points):
        """Colours at places, one row each."""
        columns = ((numpy.array([p.x for p in points]) - self.left) / self.pixel_m).astype(int)
        rows = ((self.top - numpy.array([p.y for p in points])) / self.pixel_m).astype(int)
        if columns.min() < 0 or rows.min() < 0 or columns.max() >= self.pixels.shape[1] or rows.max() >= self.pixels.shape[0]:
            raise FigureError("a place lies beyond the image")
        return self.pixels[rows, columns].astype(float)

    def share_of(self, colour, shape):
        """Of the pixels whose middle lies in a polygon, the share of one colour."""
        from matplotlib.path import Path

        west, south, east, north = shape.bounds
        columns = numpy.arange(int((west - self.left) / self.pixel_m), int((east - self.left) / self.pixel_m))
        rows = numpy.arange(int((self.top - north) / self.pixel_m), int((self.top - south) / self.pixel_m))
        x, y = numpy.meshgrid(self.left + (columns + 0.5) * self.pixel_m, self.top - (rows + 0.5) * self.pixel_m)
        inside = Path(numpy.asarray(shape.exterior.coords)[:, :2]).contains_points(numpy.column_stack([x.ravel(), y.ravel()]))
        pixels = self.pixels[rows[0]:rows[-1] + 1, columns[0]:columns[-1] + 1].reshape(-1, 3)[inside]
        return float((pixels == numpy.array(colour)).all(axis=1).mean())


class GridPoints:
    """The corresponding points of one parcel: report layers target_grid or source_grid."""

    def __init__(self, report, name, parcel):
        points = layer(report, name)
        self.points = points[points["parcel"] == parcel].sort_values(["line", "sample"]).reset_index(drop=True)
        self.lines = int(self.points["line"].max()) + 1
        self.samples = int(self.points["sample"].max()) + 1

    def at(self, line, sample):
        p = self.points.geometry.iloc[line * self.samples + sample]
        return p.x, p.y

    def scan_lines(self):
        return geopandas.GeoSeries([LineString([self.at(i, 0), self.at(i, self.samples - 1)]) for i in range(self.lines)
                                    if self.at(i, 0) != self.at(i, self.samples - 1)])

    def rows(self):
        return geopandas.GeoSeries([LineString([self.at(i, j) for i in range(self.lines)]) for j in range(self.samples)])

    def quad_areas(self):
        """Signed, one per quadrilateral of the grid."""
        areas = []
        for i in range(self.lines - 1):
            for j in range(self.samples - 1):
                corners = [self.at(i, j), self.at(i + 1, j), self.at(i + 1, j + 1), self.at(i, j + 1)]
                areas.append(0.5 * sum(corners[k - 1][0] * corners[k][1] - corners[k][0] * corners[k - 1][1] for k in range(4)))
        return numpy.array(areas)
