"""ABVA08, figure 2: aerial views of an urban layout, the geometric configuration under it, zones of its tiles."""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from figure import make  # noqa: E402
from drawing import GREY, INK, caption, fill, letter, lines, open_map, sheet  # noqa: E402
from imagery import Picture, rendered  # noqa: E402
from places import MARGIN_M, Window, layer, mapped_layer  # noqa: E402
from matplotlib.patches import Patch  # noqa: E402

import numpy  # noqa: E402

VILLAGE = Window("san_roman_es", 352000.0, 4436600.0, 352400.0, 4437000.0,
                 "the village: houses, workshops and public buildings side by side")
ZONES = {"residential": "#f0d890", "commercial": "#d9705f", "industrial": "#a898c8", "park": "#9ccc85", "other": "#a9bcc8",
         "": "#f2efe9"}
#: Views overlap by so much, so that what they share can be compared.
OVERLAP_M = 50.0
PIXEL_M = 0.5


def render_views(figure, window):
    """Four overlapping views of the window, each rendered by itself."""
    town = town_of(figure, window)
    middle_x, middle_y = (window.west + window.east) / 2, (window.south + window.north) / 2
    views = []
    for name, west, south, east, north in (
            ("nw", window.west, middle_y - OVERLAP_M, middle_x + OVERLAP_M, window.north),
            ("ne", middle_x - OVERLAP_M, middle_y - OVERLAP_M, window.east, window.north),
            ("sw", window.west, window.south, middle_x + OVERLAP_M, middle_y + OVERLAP_M),
            ("se", middle_x - OVERLAP_M, window.south, window.east, middle_y + OVERLAP_M)):
        views.append(Picture(rendered(figure, town, f"view_{name}", (west, south, east, north), "--set", "climate=dry",
                                      "--pixel", PIXEL_M)))
    return views


def town_of(figure, window):
    """Parcels and footprints in and around the window, as `plat orthophoto` reads them."""
    observed = figure.dataset(window.dataset)["observed"]
    town = figure.path("town.gpkg")
    near = window.shape().buffer(MARGIN_M)
    for name in ("parcels", "footprints"):
        mapped_layer(observed[name], near).to_file(town, layer=name, driver="GPKG")
    return town


def differing_pixels(views):
    """Share of the pixels that two views have in common and do not agree on."""
    common = differing = 0
    for i, a in enumerate(views):
        for b in views[i + 1:]:
            rows, columns = overlap(a, b)
            if rows is None:
                continue
            same = a.pixels[rows[0], columns[0]] == b.pixels[rows[1], columns[1]]
            common += same.shape[0] * same.shape[1]
            differing += int((~same.all(axis=2)).sum())
    return differing / common, common


def overlap(a, b):
    """Slices of rows and of columns that two pictures of one raster have in common, in each."""
    down, right = round((a.top - b.top) / a.pixel_m), round((b.left - a.left) / a.pixel_m)

    def shared(shift, n, m):
        first, last = max(0, shift), min(n, shift + m)
        return None if last <= first else (slice(first, last), slice(first - shift, last - shift))

    rows = shared(down, a.pixels.shape[0], b.pixels.shape[0])
    columns = shared(right, a.pixels.shape[1], b.pixels.shape[1])
    return (rows, columns) if rows and columns else (None, None)


def draw(figure):
    views = render_views(figure, VILLAGE)
    file = figure.path("tiles.gpkg")
    said = figure.plat("tiles", "--dataset", VILLAGE.dataset, "--out", file)
    shape = VILLAGE.shape()
    everywhere = layer(file, "tiles")
    links = layer(file, "links")
    tiles = everywhere[everywhere.representative_point().within(shape)]
    zones = tiles["zone"].fillna("")

    picture, ((left, middle, right),) = sheet(1, 3, 15.0, 6.2)
    bounds = numpy.array(shape.bounds)
    for axes in (left, middle, right):
        open_map(axes, bounds)
        axes.set_xlim(bounds[0], bounds[2])
        axes.set_ylim(bounds[1], bounds[3])
    for view in views:
        view.draw(left)
    left.axvline((bounds[0] + bounds[2]) / 2, color="white", linewidth=0.8)
    left.axhline((bounds[1] + bounds[3]) / 2, color="white", linewidth=0.8)
    letter(left, "a", "four registered views, rendered")
    fill(middle, everywhere, "white", INK, 0.6)
    lines(middle, links[links.intersects(shape)], "#3a6fb0", 0.8)
    joints = layer(file, "joints")
    joints = joints[joints.within(shape)]
    middle.scatter(joints.geometry.x, joints.geometry.y, s=3, color="#c0302a", zorder=5)
    letter(middle, "b", "tiles, joints (red), links across streets (blue)")
    fill(right, everywhere, [ZONES[z] for z in everywhere["zone"].fillna("")], GREY, 0.4)
    letter(right, "c", "zones")
    right.legend(handles=[Patch(facecolor=c, edgecolor=GREY, label=z or "unknown") for z, c in ZONES.items()
                          if (zones == z).any()], fontsize=8, loc="lower right")
    caption(picture, figure)
    figure.save(picture)

    share, common = differing_pixels(views)
    figure.measured("registered", share, f"{common} pixels in common")
    measure_layout(figure, everywhere, links, said)
    figure.measured("zoned", (zones != "").mean(), f"{len(tiles)} tiles in the window")


def measure_layout(figure, tiles, links, said):
    """On the whole place: the tiles are a partition, and streets reach them."""
    pairs = tiles.sindex.query_bulk(tiles.geometry, predicate="overlaps")
    pairs = pairs[:, pairs[0] < pairs[1]]
    over = sum(tiles.geometry.iloc[i].intersection(tiles.geometry.iloc[j]).area for i, j in pairs.T)
    figure.measured("partition", over / tiles.area.sum(), said.strip().splitlines()[0].split(": ")[-1])
    reached = set(links["tile_a"]) | set(links["tile_b"])
    figure.measured("egress", tiles["tile"].isin(reached).mean(), f"{len(tiles)} tiles")


if __name__ == "__main__":
    sys.exit(make("abva08/fig02", draw))
