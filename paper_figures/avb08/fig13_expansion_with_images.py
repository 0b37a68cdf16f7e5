"""AVB08, figure 13: a fragment is expanded to the east, streets and images."""

import json
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

import numpy  # noqa: E402
from figure import make  # noqa: E402
from drawing import caption, fill, letter, lines, open_map, sheet  # noqa: E402
from imagery import Picture, connected_share, filled, rendered  # noqa: E402
from places import Place, Window, layer  # noqa: E402
from shapely.geometry import box  # noqa: E402

FRAGMENT = Window("cambridge_ma", 230000.0, 903400.0, 230700.0, 904100.0, "Huron village: an irregular pattern")
#: How far to the east the copy of the fragment's points lies.
EAST_M = 700.0
PIXEL_M = 0.5
#: One of so many of the most similar lots, so that neighbours do not look the same.
VARIETY = 8
RED = "#b2182b"


def expanded(figure):
    """The GeoPackage of the fragment as it is, with streets grown over a copy of its points beside it."""
    region = {"window": [FRAGMENT.west, FRAGMENT.south, FRAGMENT.east, FRAGMENT.north]}
    middle = [(FRAGMENT.west + FRAGMENT.east) / 2 + EAST_M, (FRAGMENT.south + FRAGMENT.north) / 2]
    script = {"city": {"data": FRAGMENT.dataset, "region": region},
              "examples": [{"name": "fragment", "data": FRAGMENT.dataset, "region": region}],
              "operations": [{"do": "place", "example": "fragment", "at": middle}]}
    path, out = figure.path("expansion.json"), figure.path("expansion.gpkg")
    path.write_text(json.dumps(script, indent=1) + "\n", encoding="utf-8")
    figure.plat("synthesize", path, "--out", out)
    return out


def draw(figure):
    place = Place(figure, FRAGMENT)
    town = figure.path("town.gpkg")
    image = rendered(figure, town, "fragment", place.blocks.total_bounds + numpy.array([-30, -30, 30, 30]), "--pixel", PIXEL_M)
    city = expanded(figure)
    parcels, streets = layer(city, "parcels"), layer(city, "streets")
    bounds = numpy.concatenate([numpy.minimum(parcels.total_bounds, place.blocks.total_bounds)[:2],
                                numpy.maximum(parcels.total_bounds, place.blocks.total_bounds)[2:]]).round()
    out, report = filled(figure, city, town, image, "expanded", "--pixel", PIXEL_M, "--set", f"variety={VARIETY}",
                         "--window", *bounds)
    is_old = streets["is_existing"].astype(bool)

    picture, grid = sheet(2, 1, 9.5, 11.5)
    for axes in grid[:, 0]:
        open_map(axes, bounds)
    letter(grid[0, 0], "a", "the fragment's streets (black) and the new ones (red), with parcels")
    fill(grid[0, 0], parcels, "#f4efe4", "#bbbbbb", 0.3)
    lines(grid[0, 0], streets[is_old], "black", 1.0)
    lines(grid[0, 0], streets[~is_old], RED, 1.0)
    letter(grid[1, 0], "b", "the fragment as it is, and imagery re-used for the new parcels")
    drawn = Picture(out)
    drawn.draw(grid[1, 0])
    fragment = place.blocks.unary_union.buffer(8.0)
    Picture(image).draw(grid[1, 0], clip_to=fragment)
    caption(picture, figure)
    figure.save(picture)

    figure.measured("connected", connected_share(streets[~is_old], streets[is_old]), f"{(~is_old).sum()} new streets")
    rows = layer(report, "imagery")
    new = rows[~rows.intersects(box(*place.blocks.total_bounds))]
    wanted = parcels[~parcels.intersects(box(*place.blocks.total_bounds))]
    figure.measured("images", len(new) / len(wanted), f"{len(wanted)} new parcels, {new['source_parcel'].nunique()} sources")
    old_light = Picture(image).at(place.parcels.representative_point()).mean()
    new_light = drawn.at(new.representative_point()).mean()
    figure.measured("seam", abs(new_light - old_light) / old_light, f"brightness {new_light:.0f} and {old_light:.0f} of 255")


if __name__ == "__main__":
    sys.exit(make("avb08/fig13", draw))
