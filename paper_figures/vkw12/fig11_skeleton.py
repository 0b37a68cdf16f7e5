"""VKW12, figure 11: residential blocks subdivided in skeleton style, maps and histograms of areas."""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from figure import make  # noqa: E402
from drawing import (MeasureMaps, caption, draw_histogram, fill, histogram_legend, letter, open_map,  # noqa: E402
                     sheet)
from places import GENERATED, OBSERVED, Place, Window  # noqa: E402

ESTATE = Window("san_roman_es", 353700.0, 4432250.0, 354760.0, 4432850.0,
                "bent and nearly rectangular residential blocks in one picture; as in the paper, the blocks towards the "
                "middle have the larger observed parcels, and two of them are parted by a straight line")
#: Rows of townhouses, a few hundred square metres, are another kind of place.
SMALLEST_BLOCK_M2 = 8000.0
#: The blocks on both sides of the straight line, by a point in each.
MIDDLE = ((354080.0, 4432660.0), (354210.0, 4432760.0))


def middle_blocks(comparison):
    """Numbers of the blocks that hold the points of MIDDLE."""
    from shapely.geometry import Point

    blocks = comparison.layers["blocks"]
    inside = blocks.geometry.apply(lambda shape: any(shape.contains(Point(p)) for p in MIDDLE))
    return set(blocks.loc[inside, "block_id"])


def draw(figure):
    place = Place(figure, ESTATE, keep=lambda block: block.area >= SMALLEST_BLOCK_M2)
    comparison = place.compare(place.subdivide("skeleton"), "skeleton")
    maps = MeasureMaps(comparison, "area_m2")

    picture, grid = sheet(2, 3, 11.5, 8.8)
    (a, b, c), (d, e, f) = grid
    open_map(a, maps.bounds)
    fill(a, comparison.layers["blocks"], "#f2efe9", "black", 0.8)
    letter(a, "a", "blocks of the estate")
    open_map(b, maps.bounds)
    fill(b, comparison.layers[OBSERVED], "white", "#444444", 0.35)
    letter(b, "b", "observed parcels")
    maps.draw(c, OBSERVED)
    letter(c, "c", "observed, by area")
    draw_histogram(d, comparison, "area_m2")
    histogram_legend(d)
    letter(d, "d", "areas")
    draw_histogram(e, comparison, "aspect_ratio")
    letter(e, "e", "aspect ratios")
    maps.draw(f, GENERATED)
    maps.colour_bar(picture, [c, f], pad=0.06)
    letter(f, "f", "procedural (skeleton), by area")
    caption(picture, figure)
    figure.save(picture)

    for key, measure in (("area_ks", "area_m2"), ("aspect_ks", "aspect_ratio")):
        figure.measured(key, *comparison.distance(measure))
    middle = middle_blocks(comparison)
    for layer in (OBSERVED, GENERATED):
        parcels = comparison.layers[layer]
        is_middle = parcels["block_id"].isin(middle)
        figure.measured(f"middle_larger_{layer}", parcels.loc[is_middle, "area_m2"].median()
                        / parcels.loc[~is_middle, "area_m2"].median(),
                        f"{int(is_middle.sum())} parcels in {len(middle)} middle blocks")


if __name__ == "__main__":
    sys.exit(make("vkw12/fig11", draw))
