"""AVB08, figure 5: transition probabilities from a base point; one point set, two attribute sets; lines by tortuosity."""

import json
import math
import pathlib
import random
import sys

import geopandas
import numpy
from matplotlib.lines import Line2D
from shapely.geometry import LineString, Point

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from figure import make  # noqa: E402
from drawing import INK, bounds_of, caption, letter, lines, open_map, sheet  # noqa: E402

CRS, EAST, NORTH = "EPSG:32633", 500000.0, 5000000.0
STEP_M = 90.0
COLUMNS, ROWS = 9, 7
#: Where the street of panel a has come to, and from where: along the middle row.
BASE, BEFORE = (3, 3), (2, 3)
MAIN_COLUMNS, MINOR_ROWS = (2, 6), (1, 5)
#: What grew before: main streets, one crossing street, the row below, and the street itself up to its base.
GROWN = [[(c, r) for r in range(ROWS)] for c in (*MAIN_COLUMNS, 4)] + [[(c, 2) for c in range(COLUMNS)], [(0, 3), (1, 3), BEFORE, BASE]]
TORTUOSITIES = [1.0, 1.05, 1.1, 1.2, 1.35, 1.5]
BARS = {"level": ("x", "(i) not its level"), "improbable": (".", "(ii) too improbable"),
        "connections": ("s", "(iii) connected four times"), "crossing": ("^", "(iv) would cross a street")}


def street(level, distance_m, deviation_m, angle, angle_deviation, tortuosity=1.0):
    return {"hierarchy": level, "connections": 2, "tortuosity": tortuosity, "distance_mean_m": distance_m,
            "distance_variance_m2": deviation_m ** 2, "angle_mean_rad": angle, "angle_variance_rad2": angle_deviation ** 2,
            "width_m": 10.0}


def write_points(path, places, styles):
    """The layer that growers read; styles are (a, b) per place, b may be None."""
    rows = []
    for a, b in styles:
        if b is not None and b["hierarchy"] < a["hierarchy"]:
            a, b = b, a
        row = {f"a_{key}": value for key, value in a.items()}
        row.update({f"b_{key}": (b[key] if b else None) for key in a})
        row["parcel_area_m2"] = None
        rows.append(row)
    frame = geopandas.GeoDataFrame(rows, geometry=[Point(*p) for p in places], crs=CRS)
    for key in frame.columns.drop("geometry"):
        frame[key] = frame[key].astype("Int64" if key.endswith(("hierarchy", "connections")) else float)
    frame.to_file(path, layer="points", driver="GPKG")
    return frame


def jittered(columns, rows, step_m, jitter_m, seed):
    """Place of each (column, row), on the working grid."""
    draw = random.Random(seed)
    snap = lambda v: round(v * 1024) / 1024  # noqa: E731
    return {(c, r): (EAST + snap(c * step_m + draw.uniform(-jitter_m, jitter_m)),
                     NORTH + snap(r * step_m + draw.uniform(-jitter_m, jitter_m)))
            for r in range(rows) for c in range(columns)}


def survey(figure):
    """Panel a: the points, what is grown, and how the base point sees the others."""
    places = jittered(COLUMNS, ROWS, STEP_M, 16.0, 5)
    keys = list(places)
    row = lambda r: street(2 if r in MINOR_ROWS else 1, STEP_M, 35.0, 0.15, 0.5)  # noqa: E731
    column = lambda c: street(0 if c in MAIN_COLUMNS else 1, STEP_M, 35.0, 0.15, 0.5)  # noqa: E731
    write_points(figure.path("base.gpkg"), places.values(), [(row(r), column(c)) for c, r in keys])
    grown = geopandas.GeoDataFrame(geometry=[LineString([places[k] for k in s]) for s in GROWN], crs=CRS)
    grown.to_file(figure.path("grown.gpkg"), layer="grown", driver="GPKG")
    # Of equal levels the row's street is a.
    style = "b" if column(BASE[0])["hierarchy"] < row(BASE[1])["hierarchy"] else "a"
    figure.plat("transitions", figure.path("base.gpkg"), "--base", keys.index(BASE) + 1, "--from", keys.index(BEFORE) + 1,
                "--street", style, "--streets", figure.path("grown.gpkg"), "--out", figure.path("targets.gpkg"))
    return places, row(BASE[1]), grown, geopandas.read_file(figure.path("targets.gpkg"), layer="targets")


def draw_survey(axes, places, grown, targets):
    open_map(axes, bounds_of(targets, 0.06))
    lines(axes, grown, "#9a9a9a", 2.0, zorder=2)
    base = places[BASE]
    is_open = (targets["bar"] == "none").to_numpy()
    x, y = targets.geometry.x.to_numpy(), targets.geometry.y.to_numpy()
    for k in numpy.flatnonzero(is_open):
        axes.plot([base[0], x[k]], [base[1], y[k]], color="#c23b22", linewidth=0.6 + 2.0 * targets["probability"][k],
                  alpha=0.6, zorder=3)
    shown = axes.scatter(x[is_open], y[is_open], c=targets["probability"][is_open], cmap="YlOrRd", vmin=0.0, vmax=1.0, s=85,
                         edgecolors=INK, linewidths=0.8, zorder=6)
    for bar, (marker, _) in BARS.items():
        rows = (targets["bar"] == bar).to_numpy() & ((x != base[0]) | (y != base[1]))
        axes.scatter(x[rows], y[rows], marker=marker, s=38, color="#555555", zorder=5)
    axes.scatter(*base, s=130, color="#1f50c8", zorder=7)
    axes.annotate("", base, places[BEFORE], arrowprops={"arrowstyle": "-|>", "color": "#1f50c8", "linewidth": 2.4}, zorder=6)
    handles = [Line2D([], [], marker="o", linestyle="", color="#1f50c8", label="base point and last segment")]
    handles += [Line2D([], [], marker=m, linestyle="", color="#555555", label=text) for m, text in BARS.values()]
    axes.legend(handles=handles, fontsize=7, loc="upper center", bbox_to_anchor=(0.5, -0.01), ncol=2, frameon=False)
    axes.figure.colorbar(shown, ax=axes, shrink=0.6, pad=0.01, label="p(v_i, v_j), relative to the likeliest step")
    letter(axes, "a", "transition probabilities from a base point")


def gaussian(style, base, before, to):
    """[AVB08, Sec. 3.1.1], once more and apart from plat's."""
    step, last = numpy.subtract(to, base), numpy.subtract(base, before)
    turn = abs(math.atan2(last[0] * step[1] - last[1] * step[0], float(numpy.dot(last, step))))
    scores = ((math.hypot(*step) - style["distance_mean_m"]) ** 2 / style["distance_variance_m2"]
              + (turn - style["angle_mean_rad"]) ** 2 / style["angle_variance_rad2"])
    return math.exp(-0.5 * scores)


def grow(figure, name, places, styles):
    """The streets that `plat synthesize` grows between points."""
    write_points(figure.path(f"{name}_points.gpkg"), places, styles)
    script = {"examples": [{"name": name, "points": str(figure.path(f"{name}_points.gpkg"))}],
              "operations": [{"do": "place", "example": name}], "grower": {"name": "random_walk"}}
    figure.path(f"{name}.json").write_text(json.dumps(script, indent=1) + "\n", encoding="utf-8")
    figure.plat("synthesize", figure.path(f"{name}.json"), "--out", figure.path(f"{name}.gpkg"))
    return geopandas.read_file(figure.path(f"{name}.gpkg"), layer="streets")


def ends(streets):
    """The pairs of places that streets connect."""
    return {tuple(sorted((g.coords[0][:2], g.coords[-1][:2]))) for g in streets.geometry}


def draw_networks(axes_pair, figure):
    """Panel b. @returns both networks"""
    places = jittered(11, 9, 100.0, 15.0, 8)
    regular = [(street(0 if r % 4 == 0 else 1, 100.0, 14.0, 0.12, 0.12), street(1, 100.0, 14.0, 0.12, 0.12)) for _, r in places]
    irregular = [(street(0 if (c + r) % 4 == 0 else 1, 141.0, 25.0, 0.9, 0.35, 1.15), street(1, 105.0, 20.0, 1.0, 0.4, 1.1))
                 for c, r in places]
    networks = []
    for axes, name, styles, text in ((axes_pair[0], "regular", regular, "$\\mu_d$ 100 m, $\\mu_\\alpha$ 7°, tortuosity 1"),
                                     (axes_pair[1], "irregular", irregular,
                                      "the same points: $\\mu_d$ 141 and 105 m, $\\mu_\\alpha$ 52° and 57°, tortuosity 1.15 and 1.1")):
        streets = grow(figure, name, list(places.values()), styles)
        open_map(axes, bounds_of(geopandas.GeoSeries([Point(*p) for p in places.values()]), 0.06))
        for level, colour, width in ((1, "#2b8cbe", 1.4), (0, "#b2182b", 2.2)):
            lines(axes, streets[streets["hierarchy"] == level], colour, width, zorder=3 - level)
        axes.scatter(*zip(*places.values()), s=9, color=INK, zorder=6)
        letter(axes, "b", text)
        networks.append(streets)
    return networks


def draw_lines(axes, figure):
    """Panel c. @returns the largest relative error of a line's tortuosity"""
    places, styles = [], []
    for k, tortuosity in enumerate(TORTUOSITIES):
        for x in (0.0, 150.0, 400.0, 550.0, 800.0, 950.0):
            places.append((EAST + x, NORTH - 160.0 * k))
            styles.append((street(k, 150.0, 10.0, 0.0, 0.1, tortuosity), None))  # a level of its own: no street from row to row
    streets = grow(figure, "tortuosity", places, styles)
    open_map(axes, bounds_of(streets, 0.12), scale=False)
    lines(axes, streets, "#b2182b", 1.8)
    axes.scatter(*zip(*places), s=16, color=INK, zorder=6)
    worst = 0.0
    for k, tortuosity in enumerate(TORTUOSITIES):
        axes.text(EAST - 40.0, NORTH - 160.0 * k, f"{tortuosity:g}", ha="right", va="center", fontsize=8)
    for line in streets.geometry:
        wanted = TORTUOSITIES[round((NORTH - line.coords[0][1]) / 160.0)]
        worst = max(worst, abs(line.length / math.dist(line.coords[0], line.coords[-1]) / wanted - 1.0))
    letter(axes, "c", "lines of six tortuosities, three of each")
    return worst if len(streets) == len(places) // 2 else math.inf


def draw(figure):
    places, style, grown, targets = survey(figure)
    picture, grid = sheet(2, 2, 13.5, 11.4)
    draw_survey(grid[0][0], places, grown, targets)
    regular, irregular = draw_networks((grid[0][1], grid[1][1]), figure)
    worst = draw_lines(grid[1][0], figure)
    caption(picture, figure)
    figure.save(picture)

    counts = targets["bar"].value_counts()
    figure.measured("reasons", sum(counts.get(bar, 0) > (bar == "crossing") for bar in BARS),
                    ", ".join(f"{bar} {count}" for bar, count in counts.items()))
    error = max(abs(p - gaussian(style, places[BASE], places[BEFORE], places[key]))
                for key, p in zip(places, targets["probability"]) if key != BASE)
    figure.measured("gaussian", error, f"{len(targets) - 1} targets")
    one, other = ends(regular), ends(irregular)
    figure.measured("two_networks", len(one & other) / len(one | other), f"{len(one)} and {len(other)} segments")
    figure.measured("tortuosity", worst, f"{3 * len(TORTUOSITIES)} lines")


if __name__ == "__main__":
    sys.exit(make("avb08/fig05", draw))
