"""Draws what tile_displacement wrote: errors over the displacement, and what replacing tiles changes.

    draw.py OUT
"""

import argparse
import pathlib

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import pandas

COLOURS = ["#1b6ca8", "#2a9d5c", "#d1495b", "#8a5ab5", "#e08e1b", "#444444", "#7fb7be"]
MEASURES = ["gap_m", "property_gap_m", "street_gap_m", "deformation", "closed_deformation", "size_change", "non_affine_m",
            "held_off_m"]


def title(measure, unit):
    return measure.removesuffix("_m").replace("_", " ") + (f" [{unit}]" if isinstance(unit, str) and unit else "")


def curve(axis, part, colour, label, mean="mean"):
    part = part.sort_values("displacement_m")
    axis.plot(part["displacement_m"], part[mean], "o-", ms=3, color=colour, label=label)
    axis.fill_between(part["displacement_m"], part["low"], part["high"], color=colour, alpha=0.15, lw=0)


def draw_ways(out, curves):
    """A row per city, a column per measure, a line per way."""
    curves = curves[curves["similarity"].isna() & (curves["way"] != "operation")]
    cities = list(dict.fromkeys(curves["dataset"]))
    figure, axes = plt.subplots(len(cities), len(MEASURES), figsize=(2.9 * len(MEASURES), 2.5 * len(cities)), squeeze=False)
    for row, city in zip(axes, cities):
        for axis, measure in zip(row, MEASURES):
            part = curves[(curves["dataset"] == city) & (curves["measure"] == measure)]
            for colour, (way, some) in zip(COLOURS, part.groupby("way", sort=False)):
                curve(axis, some, colour, way)
            axis.set_xscale("log")
            axis.set_yscale("symlog", linthresh=0.01)
            axis.set_title(title(measure, part["unit"].iloc[0]), fontsize=8)
            axis.tick_params(labelsize=7)
        row[0].set_ylabel(city, fontsize=8)
    axes.flat[0].legend(fontsize=7)
    figure.supxlabel("displacement of the group, metres", fontsize=9)
    figure.tight_layout()
    figure.savefig(out / "ways.png", dpi=110)
    plt.close(figure)


def draw_replacements(out):
    """Differences from moving without replacement, and how many tiles are replaced."""
    table = pandas.read_csv(out / "replacements.csv")
    if table.empty:
        return
    shown = ["gap_m", "deformation", "largest_deformation", "objective", "replacements"]
    cities = list(dict.fromkeys(table["dataset"]))
    figure, axes = plt.subplots(len(cities), len(shown), figsize=(3.3 * len(shown), 2.5 * len(cities)), squeeze=False)
    for row, city in zip(axes, cities):
        for axis, measure in zip(row, shown):
            part = table[(table["dataset"] == city) & (table["measure"] == measure)]
            for colour, (similarity, some) in zip(COLOURS, part.groupby("similarity", sort=False)):
                curve(axis, some, colour, similarity, "difference")
            axis.axhline(0, color="grey", lw=0.6)
            axis.set_xscale("log")
            axis.set_title(title(measure, part["unit"].iloc[0]), fontsize=8)
            axis.tick_params(labelsize=7)
        row[0].set_ylabel(city, fontsize=8)
    axes.flat[0].legend(fontsize=7)
    figure.supxlabel("displacement of the group, metres; with replacement less without", fontsize=9)
    figure.tight_layout()
    figure.savefig(out / "replacements.png", dpi=110)
    plt.close(figure)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", type=pathlib.Path, help="what tile_displacement wrote")
    out = parser.parse_args().out
    draw_ways(out, pandas.read_csv(out / "curves.csv"))
    draw_replacements(out)


if __name__ == "__main__":
    main()
