"""AVB08, figure 9: a grid city grows into an empty area, with points of a grid and of an irregular city."""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from figure import make  # noqa: E402
from drawing import caption, letter, lines, open_map, sheet  # noqa: E402
from layouts import Network, ends_of, example, existing, grown, ks_distance, synthesized, window_region  # noqa: E402
from exemplars import Exemplar  # noqa: E402
from places import Window  # noqa: E402

CITY = Window("montevideo_uy", 573900.0, 6136300.0, 575900.0, 6137900.0, "a regular grid all around the area")
AREA = [574480.0, 6136760.0, 575260.0, 6137420.0]
GRID = Window("montevideo_uy", 575050.0, 6139300.0, 575950.0, 6140900.0, "another district of the same kind of grid")
IRREGULAR = Window("porto_alegre_br", 485300.0, 6675300.0, 486500.0, 6676500.0,
                   "winding streets and small angles, with dense and open parts")
SMALL_ANGLE_DEG = 60.0


def expanded(figure, name, window):
    script = {"examples": [example("points", window)],
              "city": {"data": CITY.dataset, "region": window_region(CITY)},
              "operations": [{"do": "expand", "example": "points", "region": {"window": AREA},
                              "at": [(AREA[0] + AREA[2]) / 2, (AREA[1] + AREA[3]) / 2]}]}
    return synthesized(figure, name, script)


def connected_with_existing(streets):
    """Share of the grown length in parts of the network that hold an existing street."""
    network = Network(streets)
    marks = set(ends_of(existing(streets)))
    at = {number: (round(x * 0.01, 2), round(y * 0.01, 2)) for number, (x, y) in network.places.items()}
    components = network.components()
    old = {c for c, (a, b, _) in zip(components, network.edges) if at[a] in marks or at[b] in marks}
    lengths = dict.fromkeys((True, False), 0.0)
    for component, length in zip(components, network.lengths()):
        lengths[component in old] += length
    old_length = existing(streets).length.sum()
    return (lengths[True] - old_length) / (sum(lengths.values()) - old_length)


def cut_ends(streets):
    """Ends of existing streets on the border of the area."""
    low_x, low_y, high_x, high_y = AREA
    near = lambda a, b: abs(a - b) < 0.1  # noqa: E731
    return [p for p in ends_of(existing(streets))
            if low_x - 0.1 <= p[0] <= high_x + 0.1 and low_y - 0.1 <= p[1] <= high_y + 0.1
            and (near(p[0], low_x) or near(p[0], high_x) or near(p[1], low_y) or near(p[1], high_y))]


def draw_city(axes, layout, new):
    open_map(axes, [CITY.west, CITY.south, CITY.east, CITY.north])
    axes.set_xlim(CITY.west, CITY.east)
    axes.set_ylim(CITY.south, CITY.north)
    lines(axes, existing(layout["streets"]), "#555555", 0.9)
    if new:
        lines(axes, grown(layout["streets"]), "#b2182b", 1.0)
        axes.scatter(layout["points"].geometry.x, layout["points"].geometry.y, s=4, color="#1f4e9c", zorder=5)


def observed(figure, window):
    city = Exemplar(figure, window.dataset)
    return Network(city.pieces[city.pieces.within(window.shape())])


def draw(figure):
    for window in (CITY, IRREGULAR):
        figure.dataset(window.dataset)
    layouts = {"grid": expanded(figure, "grid", GRID), "irregular": expanded(figure, "irregular", IRREGULAR)}
    picture, ((left, middle, right),) = sheet(1, 3, 15.0, 5.2)
    draw_city(left, layouts["grid"], False)
    letter(left, "left", "the city and the empty area")
    draw_city(middle, layouts["grid"], True)
    letter(middle, "middle", "filled with points of a grid")
    draw_city(right, layouts["irregular"], True)
    letter(right, "right", "filled with points of an irregular city")
    caption(picture, figure, "Red: grown streets. Blue: attributed intersection points.")
    figure.save(picture)

    networks = {}
    for key, layout in layouts.items():
        streets = layout["streets"]
        networks[key] = Network(grown(streets))
        reached = len(layout["points"]) and int(layout["points"]["is_reached"].sum())
        figure.measured(f"connected_{key}", connected_with_existing(streets),
                        f"{len(layout['points'])} points, {reached} reached; {len(grown(streets))} grown streets")
        cut, new = cut_ends(streets), ends_of(grown(streets))
        figure.measured(f"joints_{key}", sum(p in new for p in cut) / len(cut), f"{len(cut)} cut ends")
        window = GRID if key == "grid" else IRREGULAR
        lengths = observed(figure, window).lengths()
        figure.measured(f"resembles_{key}", ks_distance(networks[key].lengths(), lengths),
                        f"{len(networks[key].edges)} grown, {len(lengths)} observed edges")
    excess = {key: network.circuity() - 1.0 for key, network in networks.items()}
    figure.measured("higher_tortuosity", excess["irregular"] / excess["grid"],
                    f"circuity {1 + excess['irregular']:.3f} and {1 + excess['grid']:.3f}")
    small = {key: (network.angles_deg() < SMALL_ANGLE_DEG).mean() for key, network in networks.items()}
    figure.measured("small_angles", small["irregular"] - small["grid"],
                    f"shares {small['irregular']:.3f} and {small['grid']:.3f}")


if __name__ == "__main__":
    sys.exit(make("avb08/fig09", draw))
