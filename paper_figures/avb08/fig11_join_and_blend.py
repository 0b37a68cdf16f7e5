"""AVB08, figure 11: a grid joined with an irregular city by blends, in two positions."""

import pathlib
import sys

import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from figure import make  # noqa: E402
from drawing import caption, letter, lines, open_map, sheet  # noqa: E402
from layouts import (Network, attribute_means, differing, example, existing, grown, synthesized,  # noqa: E402
                     window_region)
from places import Window  # noqa: E402
from shapely.geometry import Polygon, box  # noqa: E402

IRREGULAR = Window("cambridge_ma", 230200.0, 902600.0, 231400.0, 903800.0, "bent streets that end, blocks of all sizes")
GRID = Window("campo_grande_br", 754000.0, 7739600.0, 755200.0, 7740800.0, "a grid from side to side")
#: Offsets from the centre of the irregular city: the grid's window, the space between, where its copies lie, and
#: from where to where the weight runs.
POSITIONS = {
    "first": {"title": "the grid in the north-west", "grid": (-2000, 400),
              "between": [(-1400, -200), (-620, -600), (-620, 600), (-1400, 1000)], "copies": (-1000, 200),
              "ramp": ((-1400, 280), (-620, 120))},
    "second": {"title": "the grid in the north", "grid": (300, 2000),
               "between": [(-600, 620), (600, 620), (900, 1400), (-300, 1400)], "copies": (150, 1000),
               "ramp": ((230, 1400), (120, 620))}}
HALF_M = 600.0
RED, BLUE, VIOLET = "#b2182b", "#2b62b5", "#7a5195"


def offset(place):
    return {"offset": list(place)}


def script(position):
    x, y = position["grid"]
    between = {"polygon": [offset(p) for p in position["between"]]}
    start, end = position["ramp"]
    return {"examples": [example("grid", GRID), example("irregular", IRREGULAR)],
            "city": {"data": IRREGULAR.dataset, "region": window_region(IRREGULAR)},
            "operations": [
                {"do": "place", "example": "grid", "at": offset((x, y)),
                 "region": {"offset_window": [x - HALF_M, y - HALF_M, x + HALF_M, y + HALF_M]}},
                {"do": "blend", "region": between, "weight": {"from": offset(start), "to": offset(end)},
                 "examples": [{"example": "grid", "at": offset(position["copies"])},
                              {"example": "irregular", "at": offset(position["copies"])}]}]}


def middle_of(streets):
    """The centre that offsets count from: that of the existing streets' ends."""
    ends = numpy.array([p[:2] for line in streets.geometry for p in (line.coords[0], line.coords[-1])])
    return (ends.min(axis=0) + ends.max(axis=0)) / 2


def square(middle, place):
    return box(*(middle + place - HALF_M), *(middle + place + HALF_M))


def draw_layout(axes, layout, of_grid, title, key):
    streets = layout["streets"]
    low_x, low_y, high_x, high_y = streets.total_bounds
    open_map(axes, [low_x - 50, low_y - 50, high_x + 50, high_y + 50])
    lines(axes, existing(streets), RED, 1.0)
    new = grown(streets)
    is_grid = new.geometry.centroid.within(of_grid)
    lines(axes, new[is_grid], BLUE, 1.0)
    lines(axes, new[~is_grid], VIOLET, 1.0)
    letter(axes, key, title)


def draw(figure):
    for window in (GRID, IRREGULAR):
        figure.dataset(window.dataset)
    layouts = {key: synthesized(figure, key, script(position)) for key, position in POSITIONS.items()}
    grid, irregular = (synthesized(figure, name, {"examples": [example(name, window)],
                                                  "operations": [{"do": "place", "example": name}]})
                       for name, window in (("grid", GRID), ("irregular", IRREGULAR)))
    picture, panels = sheet(1, 2, 15.0, 8.0, gridspec_kw={"width_ratios": (1.45, 1.0)})
    shapes = {}
    for axes, (key, position) in zip(panels[0], POSITIONS.items()):
        middle = middle_of(existing(layouts[key]["streets"]))
        shapes[key] = Polygon([(middle[0] + x, middle[1] + y) for x, y in position["between"]])
        draw_layout(axes, layouts[key], square(middle, numpy.array(position["grid"])), position["title"],
                    "left" if key == "first" else "right")
    caption(picture, figure, "Red: the city that stays. Blue: streets grown from the grid's points. Violet: the blend between.")
    figure.save(picture)

    lines_of = {key: {line.wkt for line in existing(layout["streets"]).geometry} for key, layout in layouts.items()}
    everyone = lines_of["first"] | lines_of["second"]
    figure.measured("original_stays", len(lines_of["first"] & lines_of["second"]) / len(everyone),
                    f"{len(everyone)} streets")
    ends = attribute_means(grid["points"]), attribute_means(irregular["points"])
    counted = differing(*ends)
    for key, layout in layouts.items():
        figure.measured(f"connected_{key}", Network(layout["streets"]).connected_share(),
                        f"{len(grown(layout['streets']))} grown streets, {int(layout['points']['is_reached'].sum())} of "
                        f"{len(layout['points'])} points reached")
        between = layout["points"][layout["points"].within(shapes[key])]
        place = ((attribute_means(between) - ends[0]) / (ends[1] - ends[0]))[counted]
        figure.measured(f"blended_{key}", abs(place.mean() - 0.5),
                        f"{len(between)} points; {', '.join(f'{p:.2f}' for p in place)}")


if __name__ == "__main__":
    sys.exit(make("avb08/fig11", draw))
