"""AVB08, figure 8: the points of a city, connected again by the random walk."""

import json
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

import numpy  # noqa: E402
import pandas  # noqa: E402
from figure import make  # noqa: E402
from drawing import bounds_of, caption, letter, open_map, sheet  # noqa: E402
from exemplars import Exemplar, draw_levels, level_handles, segments_of  # noqa: E402
from places import Window, layer  # noqa: E402
from matplotlib.collections import LineCollection  # noqa: E402
from matplotlib.lines import Line2D  # noqa: E402

CITY = Window("cambridge_ma", 226000.0, 899500.0, 236500.0, 906500.0, "the whole city")
MISSED, INVENTED, FOUND = "#d6604d", "#2166ac", "#bbbbbb"
THICKNESS = 0.6
#: Coordinates lie on a grid of 2^-10 m; rounding to this many digits tells places apart and forgives how files print them.
DIGITS = 3


def key_of(p, q):
    """A segment by the places it connects, whichever comes first."""
    return tuple(sorted((round(float(x), DIGITS), round(float(y), DIGITS)) for x, y in (p[:2], q[:2])))


def regrown(figure, city):
    """The layers of a layout from the copied points alone."""
    script = figure.path("copy.json")
    out = figure.path("copy.gpkg")
    script.write_text(json.dumps({
        "seed": 1, "examples": [{"name": "city", "points": f"{city.file}:points"}],
        "operations": [{"do": "place", "example": "city"}], "grower": {"name": "random_walk"}}, indent=1), encoding="utf-8")
    figure.plat("synthesize", script, "--out", out)
    return layer(out, "streets")


def observed_segments(city):
    """Segment -> level of its street, point to point along the streets."""
    segments = {}
    for chain, places in city.stops().items():
        for p, q in segments_of(places):
            key = key_of(p, q)
            segments[key] = min(segments.get(key, math.inf), city.level_of[chain])
    return segments


def grown_segments(grown):
    return {key_of(line.coords[0], line.coords[-1]): level
            for line, level in zip(grown.geometry, grown["hierarchy"]) if line.coords[0] != line.coords[-1]}


def length_of(keys):
    return sum(math.dist(p, q) for p, q in keys)


def ks_distance(first, second):
    """Largest difference of two empirical distributions."""
    values = numpy.sort(numpy.concatenate([first, second]))
    shares = [numpy.searchsorted(numpy.sort(sample), values, side="right") / len(sample) for sample in (first, second)]
    return float(numpy.abs(shares[0] - shares[1]).max())


def draw_differences(axes, observed, grown):
    for keys, colour, width in ((observed & grown, FOUND, 0.6), (observed - grown, MISSED, 1.0),
                                (grown - observed, INVENTED, 1.0)):
        collection = LineCollection([list(k) for k in sorted(keys)], colors=colour, linewidths=width)
        collection.set_in_layout(False)
        axes.add_collection(collection, autolim=False)
    axes.legend(handles=[Line2D([], [], color=MISSED, label="not found"), Line2D([], [], color=INVENTED, label="not in the example"),
                         Line2D([], [], color=FOUND, label="in both")], fontsize=8, loc="lower right")


def draw(figure):
    city = Exemplar(figure, CITY.dataset)
    grown_layer = regrown(figure, city)
    observed, grown = observed_segments(city), grown_segments(grown_layer)
    picture, ((left, middle, right),) = sheet(1, 3, 19.0, 7.0)
    bounds = bounds_of(city.points)
    for axes in (left, middle, right):
        open_map(axes, bounds, scale=axes is left)
    draw_levels(left, city.pieces, THICKNESS)
    left.legend(handles=level_handles(city.pieces["hierarchy"]), fontsize=8, loc="lower right")
    letter(left, "left", f"example: {len(city.points)} points, {len(observed)} segments")
    draw_differences(middle, set(observed), set(grown))
    letter(middle, "between", "what differs, as straight lines from point to point")
    draw_levels(right, grown_layer, THICKNESS)
    letter(right, "right", f"grown from the points: {len(grown)} segments")
    caption(picture, figure)
    figure.save(picture)
    measure_claims(figure, city, observed, grown)


def measure_claims(figure, city, observed, grown):
    main = {key for key, level in observed.items() if level == 0}
    found = set(observed) & set(grown)
    of_main = length_of(main & found) / length_of(main)
    of_all = length_of(found) / length_of(observed)
    true_share = length_of(found) / length_of(grown)
    figure.measured("main_recovered", of_main, f"{length_of(main) / 1000:.1f} km of level 0; of their "
                    f"{len(main)} segments {len(main & found) / len(main):.3f}, of all segments {len(found) / len(observed):.3f}")
    figure.measured("main_better", of_main - of_all,
                    f"of all streets {of_all:.3f}; {true_share:.3f} of the grown length is the example's")
    figure.measured("closely_resembles", ks_distance([math.dist(*k) for k in observed], [math.dist(*k) for k in grown]),
                    f"{len(observed)} and {len(grown)} segments")
    ratio = length_of(grown) / length_of(observed)
    figure.measured("same_amount", max(ratio, 1.0 / ratio), f"{length_of(grown) / 1000:.1f} km grown, "
                    f"{length_of(observed) / 1000:.1f} km in the example")
    streets = pandas.DataFrame(
        [(len(set(places)), numpy.mean([key_of(p, q) not in found for p, q in segments_of(places)]))
         for places in city.stops().values() if segments_of(places)], columns=["points", "missed"])
    figure.measured("errors_atypical", streets["points"].rank().corr(streets["missed"].rank()),
                    f"{int((streets['missed'] > 0).sum())} of {len(streets)} streets have errors")


if __name__ == "__main__":
    sys.exit(make("avb08/fig08", draw))
