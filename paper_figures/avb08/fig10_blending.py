"""AVB08, figure 10: a grid and an irregular fragment, and a blend of both that varies from north to south."""

import pathlib
import sys

import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from figure import make  # noqa: E402
from drawing import caption, letter, lines, open_map, sheet  # noqa: E402
from exemplars import draw_levels  # noqa: E402
from layouts import Network, attribute_means, differing, example, synthesized  # noqa: E402
from places import Window  # noqa: E402

GRID = Window("campo_grande_br", 753950.0, 7739550.0, 755250.0, 7740850.0, "a grid from side to side")
IRREGULAR = Window("cambridge_ma", 230150.0, 902550.0, 231450.0, 903850.0, "bent streets that end, blocks of all sizes")
#: The weight runs from the grid's to the irregular style over this much of the height, metres from the middle.
RAMP_M = 450.0
SEEDS = range(1, 11)
MIDDLE = {"offset": [0, 0]}


def script(operation):
    return {"examples": [example("grid", GRID), example("irregular", IRREGULAR)], "operations": [operation]}


def blend(weight):
    return script({"do": "blend", "weight": weight,
                   "examples": [{"example": "grid", "at": MIDDLE}, {"example": "irregular", "at": MIDDLE}]})


def thirds(network):
    """Upper and lower third of a network, by the middles of its edges."""
    y = network.middles()[:, 1]
    low, high = y.min(), y.max()
    return network.part(y > high - (high - low) / 3), network.part(y < low + (high - low) / 3)


def point_thirds(points):
    y = points.geometry.y
    return points[y > y.max() - (y.max() - y.min()) / 3], points[y < y.min() + (y.max() - y.min()) / 3]


def draw_network(axes, layout, bounds):
    open_map(axes, bounds)
    axes.set_xlim(bounds[0], bounds[2])
    axes.set_ylim(bounds[1], bounds[3])
    draw_levels(axes, layout["streets"])
    axes.scatter(layout["points"].geometry.x, layout["points"].geometry.y, s=3, color="#222222", zorder=12)


def draw(figure):
    for window in (GRID, IRREGULAR):
        figure.dataset(window.dataset)
    grid = synthesized(figure, "grid", script({"do": "place", "example": "grid", "at": MIDDLE}))
    irregular = synthesized(figure, "irregular", script({"do": "place", "example": "irregular", "at": MIDDLE}))
    ramp = {"from": {"offset": [0, RAMP_M]}, "to": {"offset": [0, -RAMP_M]}}
    blends = [synthesized(figure, "blend", blend(ramp), seed) for seed in SEEDS]

    picture, ((left, middle, right),) = sheet(1, 3, 15.0, 6.6)
    bounds = grid["points"].total_bounds + numpy.array([-80.0, -80.0, 80.0, 80.0])
    for axes, key, layout, text in ((left, "left", grid, "points of a grid, regrown"),
                                    (middle, "middle", blends[0], "blend: grid in the north, irregular in the south"),
                                    (right, "right", irregular, "points of an irregular city, regrown")):
        draw_network(axes, layout, bounds)
        letter(axes, key, text)
    caption(picture, figure, "Colours: levels of hierarchy. Black: attributed intersection points.")
    figure.save(picture)
    measure_claims(figure, grid, irregular, blends)


def measure_claims(figure, grid, irregular, blends):
    ends = attribute_means(grid["points"]), attribute_means(irregular["points"])
    counted = differing(*ends)
    shares = []
    for layout in blends:
        upper, lower = (attribute_means(part) for part in point_thirds(layout["points"]))
        nearer = lambda means: numpy.abs(means - ends[0]) < numpy.abs(means - ends[1])  # noqa: E731
        shares.append((nearer(upper) & ~nearer(lower))[counted].mean())
    figure.measured("attributes_vary", numpy.mean(shares), f"{int(counted.sum())} attributes that differ, ten seeds")
    networks = [Network(layout["streets"]) for layout in blends]
    parts = [thirds(network) for network in networks]

    def ratios(value):
        return [value(low) / value(high) for high, low in parts]

    variation = ratios(Network.length_variation)
    figure.measured("distance_variance", numpy.mean(variation), f"{min(variation):.2f} to {max(variation):.2f}")
    tortuosity = [1.0 / r for r in ratios(lambda n: n.circuity() - 1.0)]
    figure.measured("tortuosity", numpy.mean(tortuosity), f"{min(tortuosity):.2f} to {max(tortuosity):.2f}")
    low, high = (Network(layout["streets"]).orientation_entropy() for layout in (grid, irregular))
    place = [(network.orientation_entropy() - low) / (high - low) for network in networks]
    note = f"{min(place):.2f} to {max(place):.2f}; entropies {low:.2f} and {high:.2f} nats"
    figure.measured("merge_above", numpy.mean(place), note)
    figure.measured("merge_below", numpy.mean(place), note)
    turns = [lower.orientation_entropy() - upper.orientation_entropy() for upper, lower in parts]
    figure.measured("turns", numpy.mean(turns), f"{min(turns):.2f} to {max(turns):.2f}")


if __name__ == "__main__":
    sys.exit(make("avb08/fig10", draw))
