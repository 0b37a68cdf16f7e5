"""Draws what tile_similarity wrote: precision by task, agreement of the measures, and examples of what is found.

    draw.py OUT
"""

import argparse
import pathlib

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy
import pandas
from matplotlib.patches import Polygon

COLOURS = ["#1b6ca8", "#d1495b", "#2a9d5c", "#8a5ab5", "#e08e2b", "#5b6770", "#b39b00"]


def draw_retrieval(out):
    """Precision at 10 with its interval, a panel per place; a cross where chance is."""
    table = pandas.read_csv(out / "retrieval.csv")
    places = list(dict.fromkeys(table["place"]))
    measures = sorted(set(table["measure"]))
    figure, axes = plt.subplots(2, -(-len(places) // 2), figsize=(16, 8.5), sharey=True, squeeze=False)
    for axis, place in zip(axes.flat, places):
        part = table[table["place"] == place]
        tasks = list(dict.fromkeys(part["task"]))
        for m, measure in enumerate(measures):
            rows = part[part["measure"] == measure].set_index("task").loc[tasks]
            at = numpy.arange(len(tasks)) + (m - (len(measures) - 1) / 2) * 0.8 / len(measures)
            spread = [rows["precision_at_10"] - rows["at_10_low"], rows["at_10_high"] - rows["precision_at_10"]]
            axis.errorbar(at, rows["precision_at_10"], yerr=spread, fmt="o", ms=3.5, lw=1, color=COLOURS[m % len(COLOURS)],
                          label=measure)
        chance = part.groupby("task")["chance_01"].mean().loc[tasks]
        axis.plot(numpy.arange(len(tasks)), chance, "kx", ms=5, label="chance")
        axis.set_xticks(numpy.arange(len(tasks)), [t.replace("copies_", "").replace("_", " ") for t in tasks], rotation=30,
                        ha="right", fontsize=8)
        axis.set_title(place, fontsize=10)
        axis.set_ylim(0, 1.03)
        axis.grid(axis="y", alpha=0.3)
    for axis in axes[:, 0]:
        axis.set_ylabel("precision at 10")
    axes.flat[-1].legend(fontsize=7, ncols=4, loc="lower left")
    figure.tight_layout()
    figure.savefig(out / "retrieval.png", dpi=110)
    plt.close(figure)


def draw_correlation(out):
    """Spearman's correlation between measures, a table per place."""
    table = pandas.read_csv(out / "correlation.csv")
    places = list(dict.fromkeys(table["place"]))
    measures = sorted(set(table["measure_a"]) | set(table["measure_b"]))
    figure, axes = plt.subplots(2, -(-len(places) // 2), figsize=(14, 9), squeeze=False)
    for axis, place in zip(axes.flat, places):
        grid = numpy.eye(len(measures))
        for _, row in table[table["place"] == place].iterrows():
            i, j = measures.index(row["measure_a"]), measures.index(row["measure_b"])
            grid[i, j] = grid[j, i] = row["spearman"]
        axis.imshow(grid, vmin=-1, vmax=1, cmap="RdBu_r")
        for i in range(len(measures)):
            for j in range(len(measures)):
                axis.text(j, i, f"{grid[i, j]:.2f}", ha="center", va="center", fontsize=7)
        axis.set_xticks(range(len(measures)), measures, rotation=40, ha="right", fontsize=7)
        axis.set_yticks(range(len(measures)), measures, fontsize=7)
        axis.set_title(place, fontsize=10)
    figure.tight_layout()
    figure.savefig(out / "correlation.png", dpi=110)
    plt.close(figure)


def ring_of(wkt):
    """The outline of a WKT polygon about its middle."""
    points = numpy.array([[float(v) for v in pair.split()] for pair in wkt[wkt.index("((") + 2:-2].split(",")])
    return points - (points.min(axis=0) + points.max(axis=0)) / 2


def draw_examples(out):
    """A sheet per place and query: the query, and its five nearest by every measure, all to one scale."""
    table = pandas.read_csv(out / "examples.csv", dtype={"query": str, "tile": str})
    for place, of_place in table.groupby("place", sort=False):
        for number, (query, part) in enumerate(of_place.groupby("query", sort=False), start=1):
            measures = list(dict.fromkeys(part["measure"]))
            ranks = int(part["rank"].max()) + 1
            reach = 0.55 * max(numpy.ptp(ring_of(w), axis=0).max() for w in part["wkt"])
            figure, axes = plt.subplots(len(measures), ranks, figsize=(1.7 * ranks, 1.8 * len(measures)), squeeze=False)
            for axis in axes.flat:
                axis.axis("off")
                axis.set_aspect("equal")
                axis.set_xlim(-reach, reach)
                axis.set_ylim(-reach, reach)
            for i, measure in enumerate(measures):
                for _, row in part[part["measure"] == measure].iterrows():
                    axis = axes[i, int(row["rank"])]
                    colour = "#d1495b" if row["rank"] == 0 else "#8fb8de"
                    axis.add_patch(Polygon(ring_of(row["wkt"]), closed=True, facecolor=colour, edgecolor="black", lw=0.7))
                    text = measure if row["rank"] == 0 else f"{row['distance']:.3g}"
                    axis.set_title(text, fontsize=8)
            figure.suptitle(f"{place}, tile {query} (red) and its nearest; {2 * reach:.0f} m across", fontsize=10)
            figure.tight_layout()
            figure.savefig(out / f"examples_{place.lower().replace(' ', '_')}_{number}.png", dpi=100)
            plt.close(figure)


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("out", type=pathlib.Path, help="folder that tile_similarity wrote")
    out = arguments.parse_args().out
    draw_retrieval(out)
    draw_correlation(out)
    draw_examples(out)


if __name__ == "__main__":
    main()
