"""A part of a real city: its observed parcels, its blocks and streets, and what a strategy makes of them."""

import dataclasses
import os
import pathlib

import geopandas
import pandas
from shapely.geometry import box
from shapely.ops import unary_union
from shapely.prepared import prep

from figure import FigureError

#: So much around a window is read that every block in it is whole, metres.
MARGIN_M = 300.0
OBSERVED, GENERATED = "observed", "generated"


@dataclasses.dataclass
class Window:
    """A rectangle of a data set, in its CRS, and why it was chosen."""

    dataset: str
    west: float
    south: float
    east: float
    north: float
    why: str

    def shape(self):
        return box(self.west, self.south, self.east, self.north)


class Place:
    """The blocks whose middle lies in a window, with all their parcels. Layers are in `file`."""

    def __init__(self, figure, window, keep=None):
        self.figure, self.window = figure, window
        source = figure.dataset(window.dataset)
        self.title = source["title"].split(":")[0]
        self.file = figure.path("place.gpkg")
        self.streets = ""
        near = window.shape().buffer(MARGIN_M)
        town = figure.path("town.gpkg")
        parcels = mapped_layer(source["observed"]["parcels"], near)
        parcels.to_file(town, layer="parcels", driver="GPKG")
        command = ["blocks", "--parcels", f"{town}:parcels", "--out", figure.path("blocks.gpkg")]
        mapping = source["observed"].get("streets")
        if mapping:
            mapped_layer(mapping, near).to_file(town, layer="streets", driver="GPKG")
            command += ["--streets", f"{town}:streets", *_street_words(mapping)]
            self.streets = f"{figure.path('blocks.gpkg')}:streets"
        figure.plat(*command)
        blocks = geopandas.read_file(figure.path("blocks.gpkg"), layer="blocks")
        blocks = blocks[blocks.representative_point().within(window.shape())]
        if keep is not None:
            blocks = blocks[[bool(keep(b)) for b in blocks.geometry]]
        if blocks.empty:
            raise FigureError(f"{window.dataset}: no block in the window")
        # Debian's geopandas has no spatial index without rtree; a window is small.
        self._land = prep(unary_union(list(blocks.geometry)))
        parcels = self._inside(parcels)
        blocks.reset_index(drop=True).to_file(self.file, layer="blocks", driver="GPKG")
        parcels.to_file(self.file, layer="parcels", driver="GPKG")
        self.blocks, self.parcels = blocks.reset_index(drop=True), parcels.reset_index(drop=True)

    def subdivide(self, strategy, name=None, fit=True, blocks=None, seed=1, **settings):
        """Parcels of a strategy; options are fitted to the observed parcels block by block unless `fit` is false."""
        name = name or strategy
        if self.streets:
            return subdivide(self.figure, name, f"{blocks or self.file}:blocks", strategy, settings, seed, self.streets,
                             f"{self.file}:parcels" if fit else "")
        # Without centrelines a block's streets are the gaps to its neighbours: those outside the window are needed.
        town = self.figure.path("town.gpkg")
        whole = subdivide(self.figure, f"{name}_town", f"{self.figure.path('blocks.gpkg')}:blocks", strategy, settings, seed,
                          "", f"{town}:parcels" if fit else "", count=False)
        out = self.figure.path(f"{name}.gpkg")
        for key in ("parcels", "blocks"):
            self._inside(layer(whole, key)).to_file(out, layer=key, driver="GPKG")
        self.figure.note_failures(name, len(self._inside(layer(whole, "failures"))), len(self.blocks))
        return out

    def _inside(self, frame):
        """The features whose middle lies in a block of this place."""
        return frame[[self._land.contains(g.representative_point()) for g in frame.geometry]] if len(frame) else frame

    def compare(self, generated, name):
        """The statistics of a generated layer beside the observed one (`plat compare`)."""
        return Comparison(self.figure, f"{self.file}:parcels", f"{generated}:parcels", name)


def subdivide(figure, name, blocks, strategy, settings, seed=1, streets="", observed="", trace=None, count=True):
    """Path of the GeoPackage that `plat subdivide` writes."""
    out = figure.path(f"{name}.gpkg")
    command = ["subdivide", "--blocks", blocks, "--strategy", strategy, "--seed", seed, "--out", out]
    if streets:
        command += ["--streets", streets]
    if observed:
        command += ["--observed", observed]
    if trace:
        command += ["--trace", trace]
    for key, value in settings.items():
        command += ["--set", f"{key}={value}"]
    figure.plat(*command)
    if count:
        figure.note_failures(name, len(layer(out, "failures")), len(layer(out, "blocks")))
    return out


def layer(path, name):
    """A layer of a GeoPackage, features without a shape left out."""
    frame = geopandas.read_file(pathlib.Path(path), layer=name)
    return frame[frame.geometry.notna()].reset_index(drop=True) if len(frame) else frame


def merged(figure, name, files):
    """One GeoPackage with the parcels of several: blocks in different styles."""
    out = figure.path(f"{name}.gpkg")
    frames = [layer(file, "parcels") for file in files]
    pandas.concat(frames, ignore_index=True).to_file(out, layer="parcels", driver="GPKG")
    return out


class Comparison:
    """What `plat compare` wrote: both layers measured alike, block by block, and how far apart they are."""

    def __init__(self, figure, observed, generated, name):
        folder = figure.path(f"compare_{name}")
        figure.plat("compare", observed, generated, "--out", folder)
        (layout,) = folder.glob("layout_*.gpkg")
        self.layers = {key: layer(layout, key) for key in ("blocks", OBSERVED, GENERATED)}
        self.histograms = pandas.read_csv(folder / "histograms.csv")
        self._distances = pandas.read_csv(folder / "distances.csv")

    def distance(self, measure, distance="ks"):
        """(value, text with interval and noise floor)."""
        rows = self._distances
        row = rows[(rows["measure"] == measure) & (rows["distance"] == distance)].iloc[0]
        note = (f"95 % interval {row['ci_low']:.3f} to {row['ci_high']:.3f}; noise floor {row['noise_mean']:.3f} "
                f"(97.5th percentile {row['noise_high']:.3f}); {int(row['n_observed'])} observed, "
                f"{int(row['n_generated'])} procedural parcels in {int(row['n_blocks'])} blocks")
        return float(row["value"]), note


def mapped_layer(mapping, near):
    """A layer that the catalogue names as PATH:LAYER, near a shape."""
    if mapping["where"]:
        raise FigureError(f"{mapping['layer']}: the catalogue's condition \"{mapping['where']}\" is not applied here")
    file, name = mapping["layer"].rsplit(":", 1)
    frame = geopandas.read_file(pathlib.Path(os.environ["PLAT_DATA_DIR"]) / file, layer=name, bbox=near.bounds)
    return frame.reset_index(drop=True)


def _street_words(mapping):
    """The catalogue's fields and settings of streets as `plat blocks` takes them."""
    fields = {"name": "--name-field", "class": "--class-field", "width": "--width-field", "lanes": "--lanes-field",
              "layer": "--level-field", "structure": "--structure-field"}
    settings = {"class_prefix": "--class-prefix", "default_class": "--default-class"}
    known = [(fields, mapping["fields"]), (settings, mapping["settings"])]
    return [word for flags, values in known for key, value in values.items() if key in flags
            for word in (flags[key], value)]
