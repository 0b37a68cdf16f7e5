"""AVB08, figure 12: two fragments joined by a blend; imagery from one of them, and interpolated from both."""

import json
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

import numpy  # noqa: E402
from figure import make  # noqa: E402
from drawing import INK, caption, fill, letter, lines, open_map, sheet  # noqa: E402
from imagery import Picture, connected_share, filled, rendered  # noqa: E402
from places import Place, Window, layer  # noqa: E402

IRREGULAR = Window("cambridge_ma", 229900.0, 903500.0, 230700.0, 904200.0, "Huron village: streets of many directions")
REGULAR = Window("cambridge_ma", 234050.0, 901950.0, 234850.0, 902650.0, "East Cambridge: a grid")
#: Between the middles of the two copies, metres: 300 m of each overlap and are blended.
APART_M = 500.0
PIXEL_M = 0.5
#: Images as of two places: what the second is rendered with.
OTHER_LOOK = ("--set", "climate=dry", "--set", "roofs=clay")


class Fragment:
    """A fragment's parcels and streets in a file, and its image."""

    def __init__(self, figure, window, name, *look):
        place = Place(figure, window)
        self.middle = [(window.west + window.east) / 2, (window.south + window.north) / 2]
        self.file = figure.path(f"{name}_town.gpkg")
        figure.path("town.gpkg").rename(self.file)
        bounds = place.blocks.total_bounds + numpy.array([-40, -40, 40, 40])
        self.image = rendered(figure, self.file, name, bounds, "--pixel", PIXEL_M, *look)


def blended(figure):
    """The GeoPackage of both fragments side by side, the overlap blended from one style to the other."""
    x, y = 232000.0, 903000.0
    regions = {name: {"window": [w.west, w.south, w.east, w.north]}
               for name, w in (("irregular", IRREGULAR), ("regular", REGULAR))}
    script = {"examples": [{"name": name, "data": IRREGULAR.dataset, "region": region} for name, region in regions.items()],
              "operations": [{"do": "blend", "weight": "across", "examples": [
                  {"example": "irregular", "at": [x - APART_M / 2, y]}, {"example": "regular", "at": [x + APART_M / 2, y]}]}]}
    path, out = figure.path("blend.json"), figure.path("blend.gpkg")
    path.write_text(json.dumps(script, indent=1) + "\n", encoding="utf-8")
    figure.plat("synthesize", path, "--out", out)
    return out


def draw(figure):
    left, right = Fragment(figure, IRREGULAR, "irregular"), Fragment(figure, REGULAR, "regular", *OTHER_LOOK)
    city = blended(figure)
    parcels, streets = layer(city, "parcels"), layer(city, "streets")
    west, south, east, north = parcels.total_bounds
    one, one_report = filled(figure, city, left.file, left.image, "from_left", "--pixel", PIXEL_M)
    both, both_report = filled(figure, city, left.file, left.image, "from_both", "--pixel", PIXEL_M, "--example2", right.file,
                               "--image2", right.image, "--weight", 0, 1, "--ramp", west, south, east, south)

    picture, grid = sheet(3, 1, 9.0, 15.5)
    bounds = [west, south, east, north]
    for (axes,), key, text in zip(grid, ("top", "middle", "bottom"), (
            "streets and parcels", "imagery by example from the fragment on the left",
            "interpolated between the imagery of both fragments")):
        open_map(axes, bounds)
        letter(axes, key, text)
    fill(grid[0, 0], parcels, "#f4efe4", "#bbbbbb", 0.3)
    lines(grid[0, 0], streets, INK, 1.0)
    Picture(one).draw(grid[1, 0])
    Picture(both).draw(grid[2, 0])
    caption(picture, figure)
    figure.save(picture)

    figure.measured("joined", connected_share(streets, streets.iloc[[streets.length.argmax()]]), f"{len(streets)} streets")
    rows = layer(one_report, "imagery")
    figure.measured("left_only", (rows["example"] == str(left.file)).sum() / len(parcels), f"{len(parcels)} parcels")
    rows = layer(both_report, "imagery")
    place = (rows.geometry.representative_point().x - west) / (east - west)
    second = rows["example"] == str(right.file)
    shares = [second[(place >= k / 3) & (place < (k + 1) / 3)].mean() for k in range(3)]
    figure.measured("interpolated", shares[2] - shares[0], "shares of the right city from west to east "
                    + ", ".join(f"{s:.2f}" for s in shares))


if __name__ == "__main__":
    sys.exit(make("avb08/fig12", draw))
