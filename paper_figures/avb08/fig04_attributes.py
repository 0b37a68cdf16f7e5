"""AVB08, figure 4: levels of the streets, stored in their points; mean and variance of distance and angle per street."""

import math
import pathlib
import sys

import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from figure import make  # noqa: E402
from drawing import INK, caption, letter, lines, open_map, sheet  # noqa: E402
from exemplars import Exemplar, chord_statistics, draw_levels, level_handles, level_style, segments_of  # noqa: E402
from places import Window  # noqa: E402

CITY = Window("cambridge_ma", 230600.0, 900700.0, 234600.0, 904700.0,
              "where most of the city's streets of every level lie, from its squares to the river")
#: The share of streets that are main ones where `plat exemplar` is not told otherwise.
MAIN_SHARE_01 = 0.03
#: A street whose points can be told apart in the detail has so many segments.
SEGMENTS_SHOWN = (7, 12)


def shown_street(city, stops):
    """A side street of the map that winds: turns far enough to be seen."""
    def interest(chain):
        count = len(segments_of(stops[chain]))
        is_shown = (SEGMENTS_SHOWN[0] <= count <= SEGMENTS_SHOWN[1] and city.level_of[chain] > 0
                    and not city.is_ring(chain) and city.line_of[chain].within(CITY.shape()))
        return city.chains["angle_mean_rad"].iloc[chain] if is_shown else -1.0

    return max(city.chains["chain"], key=interest)


def draw_street(axes, city, chain, stops):
    """The street, its chords, each with its length, and the turns between them."""
    row = city.chains.iloc[chain]
    colour = level_style(row["hierarchy"])[0]
    places = numpy.array(stops[chain])
    bounds = list(city.line_of[chain].buffer(60.0).bounds)
    open_map(axes, bounds)
    axes.set_xlim(bounds[0], bounds[2])
    axes.set_ylim(bounds[1], bounds[3])
    lines(axes, city.pieces.cx[bounds[0]:bounds[2], bounds[1]:bounds[3]], "#cccccc", 1.2)
    lines(axes, city.chains.iloc[[chain]], colour, 2.4)
    axes.plot(places[:, 0], places[:, 1], color=INK, linewidth=0.9, linestyle="--", zorder=12)
    axes.scatter(places[:, 0], places[:, 1], s=20, color=INK, zorder=13)
    chords = segments_of(stops[chain])
    halo = {"boxstyle": "square,pad=0.1", "facecolor": "white", "edgecolor": "none", "alpha": 0.75}
    for p, q in chords:
        axes.text((p[0] + q[0]) / 2, (p[1] + q[1]) / 2, f"{math.dist(p, q):.0f}", fontsize=7, ha="center", va="center",
                  bbox=halo, zorder=14)
    for (p, q), (_, r) in zip(chords, chords[1:]):
        turn = chord_statistics([p, q, r], False)[2]
        axes.annotate(f"{math.degrees(turn):.0f}°", q, (5, 6), textcoords="offset points", fontsize=7, color=colour,
                      bbox=halo, zorder=14)
    name = row["name"] or f"street {chain}"
    letter(axes, "right, above", f"{name}: $\\mu_d$ {row['distance_mean_m']:.0f} m, $\\sigma_d$ "
           f"{math.sqrt(row['distance_variance_m2']):.0f} m, $\\mu_\\alpha$ {math.degrees(row['angle_mean_rad']):.0f}°, "
           f"$\\sigma_\\alpha$ {math.degrees(math.sqrt(row['angle_variance_rad2'])):.0f}°")


def draw_statistics(axes, city):
    """Every street as a cross: mean and deviation of distance and of angle."""
    chains = city.chains[city.chains["angle_variance_rad2"] > 0.0]
    for row in chains.sort_values("hierarchy", ascending=False).itertuples():
        colour, width = level_style(row.hierarchy)
        axes.errorbar(row.distance_mean_m, math.degrees(row.angle_mean_rad),
                      math.degrees(math.sqrt(row.angle_variance_rad2)), math.sqrt(row.distance_variance_m2), color=colour,
                      linewidth=0.3 * width, marker="o", markersize=2.0 * width, alpha=0.4, zorder=10 - min(row.hierarchy, 9))
    axes.set_xlim(0.0, numpy.percentile(chains["distance_mean_m"], 99) * 1.5)
    axes.set_ylim(0.0, 100.0)
    axes.set_xlabel("distance between consecutive points, mean ± deviation [m]")
    axes.set_ylabel("angle between segments, mean ± deviation [°]")
    axes.grid(color="#e5e5e5", linewidth=0.5)
    letter(axes, "right, below", f"the {len(chains)} streets with two turns or more")


def draw(figure):
    city = Exemplar(figure, CITY.dataset)
    stops = city.stops()
    bounds = list(CITY.shape().bounds)
    picture = sheet(1, 1, 14.5, 9.4)[0]
    picture.clear()
    panels = picture.subplot_mosaic([["map", "street"], ["map", "table"]], gridspec_kw={"width_ratios": [1.35, 1.0]})
    open_map(panels["map"], bounds)
    panels["map"].set_xlim(bounds[0], bounds[2])
    panels["map"].set_ylim(bounds[1], bounds[3])
    draw_levels(panels["map"], city.pieces)
    panels["map"].scatter(city.points.geometry.x, city.points.geometry.y, s=3.5, color=INK, zorder=12, linewidths=0)
    panels["map"].legend(handles=level_handles(city.pieces["hierarchy"]), fontsize=8, loc="upper right")
    letter(panels["map"], "left", "levels of the streets and the points they generate")
    draw_street(panels["street"], city, shown_street(city, stops), stops)
    draw_statistics(panels["table"], city)
    caption(picture, figure)
    figure.save(picture)
    measure_claims(figure, city, stops)


def measure_claims(figure, city, stops):
    importance = city.chains["length_m"] * city.chains["width_m"]
    count = round(MAIN_SHARE_01 * len(city.chains))
    main = importance.sort_values(ascending=False).index[:count]
    figure.measured("longest_and_widest", (city.chains.loc[main, "hierarchy"] == 0).mean(),
                    f"the first {count} of {len(city.chains)} streets; {int((city.chains['hierarchy'] == 0).sum())} are level 0")
    lowest = lowest_met(city)
    below = [(chain, level) for chain, level in city.level_of.items() if level > 0]
    figure.measured("next_level", sum(lowest[chain] == level - 1 for chain, level in below) / len(below),
                    f"{len(below)} streets of levels 1 to {max(city.level_of.values())}")
    stored = [level == city.level_of[chain] for side in ("a", "b") for level, chain
              in zip(city.points[f"{side}_hierarchy"], city.points[f"{side}_chain"]) if not math.isnan(chain)]
    figure.measured("stored", sum(stored) / len(stored), f"{len(stored)} streets of {len(city.points)} points")
    columns = ("distance_mean_m", "distance_variance_m2", "angle_mean_rad", "angle_variance_rad2")
    worst = 0.0
    for row in city.chains.to_dict("records"):
        for column, value in zip(columns, chord_statistics(stops[row["chain"]], bool(row["is_closed"]))):
            worst = max(worst, abs(row[column] - value) / max(1.0, abs(value)))
    figure.measured("from_the_points", worst, f"{len(city.chains)} streets, four values each, computed again")


def lowest_met(city):
    """Chain -> the lowest level among the other streets that it meets."""
    at = {}
    for line, chain in zip(city.pieces.geometry, city.pieces["chain"]):
        for end in (line.coords[0], line.coords[-1]):
            at.setdefault(tuple(end[:2]), set()).add(chain)
    lowest = {}
    for chains in at.values():
        for chain in chains:
            for other in chains - {chain}:
                lowest[chain] = min(lowest.get(chain, math.inf), city.level_of[other])
    return {chain: lowest.get(chain, math.inf) for chain in city.level_of}


if __name__ == "__main__":
    sys.exit(make("avb08/fig04", draw))
