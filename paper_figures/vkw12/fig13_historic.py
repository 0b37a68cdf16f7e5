"""VKW12, figure 13: a town that nobody planned, divided by OBB with an irregularity set by hand."""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from figure import make  # noqa: E402
from drawing import bounds_of, caption, draw_histogram, fill, histogram_legend, letter, open_map, sheet  # noqa: E402
from places import GENERATED, OBSERVED, Place, Window  # noqa: E402

VILLAGE = Window("san_roman_es", 352180.0, 4436775.0, 352450.0, 4437010.0,
                 "the old core of the village around its church: crooked lanes, blocks without a straight side, "
                 "parcels of 30 to 400 m2 in no order")
#: "Manually adjusting attributes such as the split irregularity" [VKW12, Sec. 6]: omega, the range of areas (k) and the
#: preference for street access (xi), chosen by looking at the blocks.
IRREGULARITY_BY_HAND = 0.5
OTHERS_BY_HAND = {"fit_deviations": 0.5, "street_access": 0.6}
LARGEST_BLOCK_M2 = 20000.0


def draw(figure):
    place = Place(figure, VILLAGE, keep=lambda block: block.area < LARGEST_BLOCK_M2)
    runs = {omega: place.compare(place.subdivide("obb", name=f"obb_{i}", irregularity=omega, **OTHERS_BY_HAND), f"omega_{i}")
            for i, omega in enumerate((IRREGULARITY_BY_HAND, 0.0))}
    comparison = runs[IRREGULARITY_BY_HAND]

    picture, grid = sheet(2, 2, 11.0, 9.0, gridspec_kw={"height_ratios": [1.0, 0.42]})
    bounds = bounds_of(comparison.layers["blocks"])
    for axes, name, face, edge, key, text in (
            (grid[0][0], OBSERVED, "#b5d99c", "#2f6b1f", "a", "actual parcels"),
            (grid[0][1], GENERATED, "#a9c6ea", "#1c3f7a", "b",
             f"procedural parcels (OBB, ω = {IRREGULARITY_BY_HAND:g} by hand)")):
        open_map(axes, bounds)
        fill(axes, comparison.layers[name], face, edge, 0.6)
        fill(axes, comparison.layers["blocks"], "none", "black", 1.0)
        letter(axes, key, text)
    for axes, measure, key, text in ((grid[1][0], "area_m2", "c", "areas"), (grid[1][1], "aspect_ratio", "d", "aspect ratios")):
        draw_histogram(axes, comparison, measure)
        letter(axes, key, text + " (not in the paper)")
    histogram_legend(grid[1][0])
    caption(picture, figure)
    figure.save(picture)

    for key, measure in (("area_ks", "area_m2"), ("aspect_ks", "aspect_ratio")):
        value, note = comparison.distance(measure)
        figure.measured(key, value, f"{note}; with ω = 0 it is {runs[0.0].distance(measure)[0]:.3f}")
    spread = {omega: run.layers[GENERATED]["area_m2"].std() for omega, run in runs.items()}
    observed = comparison.layers[OBSERVED]["area_m2"].std()
    figure.measured("irregularity_helps", abs(spread[IRREGULARITY_BY_HAND] - observed) - abs(spread[0.0] - observed),
                    f"deviation of areas {observed:.0f} m² observed, {spread[IRREGULARITY_BY_HAND]:.0f} with ω by hand, "
                    f"{spread[0.0]:.0f} with ω = 0")


if __name__ == "__main__":
    sys.exit(make("vkw12/fig13", draw))
