"""VKW12, figure 1: observed and procedural parcels of a mixed-use suburb, maps by aspect ratio and histograms."""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from figure import make  # noqa: E402
from drawing import (MeasureMaps, caption, draw_histogram, draw_statistics_map, fill,  # noqa: E402
                     histogram_legend, letter, open_map, pale_faces)
from places import GENERATED, OBSERVED, Place, Window, layer, merged  # noqa: E402
import matplotlib.pyplot as plt  # noqa: E402

SUBURB = Window("cambridge_ma", 229120.0, 902780.0, 229960.0, 903700.0,
                "the most suburban part of the city: nearly rectangular and warped blocks, houses, schools and shops")
#: West of this line rows of houses (skeleton), east of it mixed uses with yards behind yards (OBB): the user's choice.
STYLE_LINE_X = 229670.0
#: Golf course and college grounds are no blocks of parcels.
LARGEST_BLOCK_M2 = 80000.0
#: What a building needs: a lot narrower or thinner than this has none in the observed part either.
NARROWEST_M, MOST_ELONGATED = 4.0, 8.0
#: Width and height of the details.
DETAIL_M = (330.0, 235.0)


def styled(figure, place):
    """The parcels of both styles in one layer, and which blocks got which."""
    is_skeleton = place.blocks.representative_point().x < STYLE_LINE_X
    files = {}
    for style, chosen in (("skeleton", is_skeleton), ("obb", ~is_skeleton)):
        blocks = figure.path(f"blocks_{style}.gpkg")
        place.blocks[chosen].to_file(blocks, layer="blocks", driver="GPKG")
        files[style] = place.subdivide(style, blocks=blocks)
    return files, merged(figure, "procedural", files.values()), place.blocks[is_skeleton]


def detail(axes, file, blocks, key, text):
    """A few blocks of one style at a scale where each parcel can be seen."""
    parcels = layer(file, "parcels")
    chosen = blocks.iloc[(blocks.area - blocks.area.median()).abs().argsort()[:1]]
    middle = chosen.geometry.iloc[0].centroid
    (wide, high) = DETAIL_M
    bounds = [middle.x - wide / 2, middle.y - high / 2, middle.x + wide / 2, middle.y + high / 2]
    open_map(axes, bounds)
    axes.set_xlim(bounds[0], bounds[2])
    near = parcels.cx[bounds[0]:bounds[2], bounds[1]:bounds[3]]
    fill(axes, near, pale_faces(near), clip_on=True)
    letter(axes, key, text)


def draw(figure):
    place = Place(figure, SUBURB, keep=lambda block: block.area < LARGEST_BLOCK_M2)
    files, procedural, skeleton_blocks = styled(figure, place)
    comparison = place.compare(procedural, "procedural")
    maps = MeasureMaps(comparison, "aspect_ratio")

    picture = plt.figure(figsize=(16.5, 14.0), layout="constrained")
    panels = picture.subplot_mosaic([["a", "b", "c"], ["d", "f", "g"], ["e", "f", "h"]],
                                    gridspec_kw={"height_ratios": [1.0, 0.6, 0.6]})
    open_map(panels["a"], maps.bounds)
    fill(panels["a"], comparison.layers[OBSERVED], "white", "#444444", 0.3)
    fill(panels["a"], comparison.layers["blocks"], "none", "black", 0.8)
    letter(panels["a"], "a", "observed parcels")
    maps.draw(panels["b"], OBSERVED)
    letter(panels["b"], "b", "observed, by aspect ratio")
    draw_statistics_map(panels["c"], comparison)
    letter(panels["c"], "c", "per block: area ± deviation [m²], width ± deviation [m]")
    draw_histogram(panels["d"], comparison, "aspect_ratio")
    letter(panels["d"], "d", "aspect ratios")
    histogram_legend(panels["d"])
    draw_histogram(panels["e"], comparison, "area_m2")
    letter(panels["e"], "e", "areas")
    fill(panels["f"], skeleton_blocks.assign(geometry=skeleton_blocks.buffer(9.0)), "#c4c4c4", "none", 0.0, zorder=0)
    maps.draw(panels["f"], GENERATED)
    maps.colour_bar(picture, panels["f"], location="bottom", shrink=0.7)
    letter(panels["f"], "f", "procedural: shaded skeleton, unshaded OBB")
    detail(panels["g"], files["skeleton"], skeleton_blocks, "g", "detail, skeleton")
    detail(panels["h"], files["obb"], place.blocks.drop(skeleton_blocks.index), "h", "detail, OBB")
    caption(picture, figure)
    figure.save(picture)
    measure_claims(figure, comparison)


def measure_claims(figure, comparison):
    for key, measure in (("area_ks", "area_m2"), ("aspect_ks", "aspect_ratio")):
        figure.measured(key, *comparison.distance(measure))
    means = {name: comparison.layers[name].groupby("block_id")["aspect_ratio"].mean() for name in (OBSERVED, GENERATED)}
    both = means[OBSERVED].index.intersection(means[GENERATED].index)
    ranks = [means[name].loc[both].rank() for name in (OBSERVED, GENERATED)]
    figure.measured("same_blocks", ranks[0].corr(ranks[1]), f"{len(both)} blocks")
    for name in (OBSERVED, GENERATED):
        parcels = comparison.layers[name]
        is_fit = (parcels["width_m"] >= NARROWEST_M) & (parcels["aspect_ratio"] <= MOST_ELONGATED)
        if name == OBSERVED:
            of_observed = f"of the observed parcels {is_fit.mean():.4f}"
        else:
            figure.measured("buildable", is_fit.mean(), f"{int((~is_fit).sum())} of {len(parcels)} are not; {of_observed}")


if __name__ == "__main__":
    sys.exit(make("vkw12/fig01", draw))
