"""Har, figure 6.12: nodes and run time of the intermediate graph over the length of a street, and the street of 80 m."""

import json
import pathlib
import sys

import pandas
from matplotlib.patches import Polygon, Rectangle

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from figure import make  # noqa: E402
from drawing import INK, PALE, caption, letter, plt  # noqa: E402

STRATEGY = "intermediate_graph"
ROUNDS = 5
SHOWN_LENGTH_M = 80.0
#: From here on the thesis's counts have three digits, and two ends matter little.
LONG_M = 200.0
OURS, THESIS = "#0072b2", "#999999"
#: An oblique view: depth goes up and to the right.
OBLIQUE = (0.35, 0.22)
STOREY_M = 3.0


def config():
    """The study of the experiment's own config, with one strategy."""
    import os

    folder = pathlib.Path(os.environ.get("PLAT_EXPERIMENTS_DIR", pathlib.Path(__file__).resolve().parents[2] / "experiments"))
    whole = json.loads((folder / "rcksp_scaling" / "config.json").read_text(encoding="utf-8"))
    study = next(s for s in whole["studies"] if s["name"] == "street")
    return {"strategies": [{"name": STRATEGY}], "rounds": ROUNDS, "cell_budget_s": 2, "time_limit_s": 60,
            "studies": [study], "published": [c for c in whole["published"] if c["study"] == "street"]}


def published(settings, quantity):
    (curve,) = [c for c in settings["published"] if c["quantity"] == quantity]
    return pandas.Series(curve["numbers"], index=curve["values"])


def draw_curves(axes, ours, theirs, label):
    axes.plot(theirs.index, theirs, "x--", color=THESIS, label="thesis, its database and machine")
    axes.plot(ours.index, ours, "o-", color=OURS, label="here, synthetic database")
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel("length of the street [m]")
    axes.set_ylabel(label)
    axes.grid(which="major", color="#eeeeee")
    axes.legend(fontsize=7, loc="upper left")


def draw_table(axes, cells, nodes, runtime):
    axes.axis("off")
    rows = [[f"{length:g} m", f"{nodes[length] / 1e3:.0f}K", f"{cells.states_created[length] / 1e3:.1f}K",
             f"{runtime[length]:.2f} s", f"{1e3 * cells.build_s[length]:.1f} + {1e3 * cells.search_s[length]:.1f} ms"]
            for length in nodes.index]
    table = axes.table(rows, colLabels=["length", "nodes, thesis", "here", "run time, thesis", "here, build + search"],
                       loc="center", cellLoc="right", edges="horizontal", colWidths=[0.14, 0.2, 0.15, 0.22, 0.29])
    table.auto_set_font_size(False)
    table.set_fontsize(7.5)
    table.scale(1.0, 1.25)


def shade(colour, factor):
    return tuple(min(1.0, int(colour[i:i + 2], 16) / 255 * factor) for i in (1, 3, 5))


def draw_front(axes, left, building, colour):
    axes.add_patch(Rectangle((left, 0), building.length_m, building.height_m, facecolor=colour, edgecolor=INK, linewidth=0.6))
    columns, storeys = max(1, round(building.length_m / 2.6)), int(building.height_m / STOREY_M)
    bay = building.length_m / columns
    for storey in range(storeys):
        for column in range(columns):
            is_door = storey == 0 and column == columns // 2
            base = 0.0 if is_door else storey * STOREY_M + 1.0
            axes.add_patch(Rectangle((left + (column + 0.3) * bay, base), 0.4 * bay, 2.2 if is_door else 1.4,
                                     facecolor="#6b4a35" if is_door else "#4f6475", edgecolor="none"))


def draw_street(axes, street, colours):
    """Cuboids from left to right, each hides the side of the one before it."""
    for building in street.itertuples():
        colour = colours[building.building]
        left, right, top = building.start_m, building.start_m + building.length_m, building.height_m
        dx, dy = (building.depth_m * way for way in OBLIQUE)
        axes.add_patch(Polygon([(left, top), (right, top), (right + dx, top + dy), (left + dx, top + dy)],
                               facecolor=shade(colour, 0.85), edgecolor=INK, linewidth=0.6))
        axes.add_patch(Polygon([(right, 0), (right + dx, dy), (right + dx, top + dy), (right, top)],
                               facecolor=shade(colour, 0.65), edgecolor=INK, linewidth=0.6))
        draw_front(axes, left, building, colour)
        axes.text((left + right) / 2, -1.0, f"{building.building[-3:]}\n{building.length_m:.1f} m", fontsize=6.5, ha="center",
                  va="top")
    end = street.start_m.iloc[-1] + street.length_m.iloc[-1]
    axes.plot([0, end], [0, 0], color=INK, linewidth=1.2)
    axes.set_xlim(-2, end + 8)
    axes.set_ylim(-6, street.height_m.max() + 5)
    axes.set_aspect("equal")
    axes.axis("off")


def exponent(folder, strategy, quantity):
    rows = pandas.read_csv(folder / "exponents.csv")
    (row,) = rows[(rows.strategy == strategy) & (rows.quantity == quantity)].itertuples()
    return row.exponent, f"{row.exponent:.2f} ({row.low:.2f} to {row.high:.2f})"


def measure(figure, cells, nodes, runtime, street):
    off = (cells.states_created / nodes - 1.0).abs()
    longs = off[off.index >= LONG_M]
    figure.measured("nodes_long", longs.max(), f"{cells.states_created.iloc[-1]:,} at {off.index[-1]:g} m")
    shorts = off[off.index < LONG_M]
    figure.measured("nodes_short", shorts.max(), "; ".join(
        f"{length:g} m: {cells.states_created[length]:,} for {nodes[length]:,}" for length in shorts.index))
    slower = cells.total_s / runtime
    figure.measured("runtime", slower.max(), f"{cells.total_s.iloc[-1]:.3f} s at {slower.index[-1]:g} m")
    value, text = exponent(figure.work, STRATEGY, "total_s")
    figure.measured("exponent", value, f"{text}; thesis's table {exponent(figure.work, 'thesis', 'total_s')[1]}")
    figure.measured("length", abs(street.length_m.sum() - SHOWN_LENGTH_M), f"{len(street)} buildings")


def draw(figure):
    settings = config()
    figure.path("config.json").write_text(json.dumps(settings, indent=1), encoding="utf-8")
    figure.program("rcksp_scaling", "--config", figure.path("config.json"), "--out", figure.work)
    cells = pandas.read_csv(figure.path("cells.csv")).set_index("value")
    streets = pandas.read_csv(figure.path("solutions.csv"))
    street = streets[streets.value == SHOWN_LENGTH_M]
    nodes, runtime = published(settings, "states"), published(settings, "total_s")

    picture, axes = plt.subplot_mosaic([["nodes", "time", "table"], ["street"] * 3], figsize=(13, 7.4), layout="constrained",
                                       height_ratios=[1.25, 1.0], width_ratios=[1, 1, 1.15])
    draw_curves(axes["nodes"], cells.states_created, nodes, "nodes of the intermediate graph")
    letter(axes["nodes"], "a", "nodes")
    draw_curves(axes["time"], cells.total_s, runtime, "building the graph and finding the shortest path [s]")
    letter(axes["time"], "b", f"run time, here ~ R^{exponent(figure.work, STRATEGY, 'total_s')[0]:.2f}, thesis R^1.29")
    draw_table(axes["table"], cells, nodes, runtime)
    letter(axes["table"], "c", "the thesis's table, and ours beside it")
    known = sorted(street.building.unique())
    draw_street(axes["street"], street, {name: PALE[i % len(PALE)] for i, name in enumerate(known)})
    letter(axes["street"], "d", f"the best street of {SHOWN_LENGTH_M:g} m: {len(street)} buildings, cost "
                                f"{street.cost_m2.iloc[0]:.2f} m² of cross sections that disagree")
    caption(picture, figure)
    figure.save(picture)
    measure(figure, cells, nodes, runtime, street)


if __name__ == "__main__":
    sys.exit(make("har/fig06_12", draw))
