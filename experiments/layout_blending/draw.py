"""Draws what layout_blending wrote: curves over the weight, trends, and the first seed's networks.

    draw.py OUT
"""

import argparse
import pathlib

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import pandas

COLOURS = ["#1b6ca8", "#2a9d5c", "#d1495b", "#8a5ab5"]


def draw_curves(out, pair):
    """Every measure over the weight, the mean of the seeds with 95 % of them; ends of the examples as observed."""
    weights = pandas.read_csv(out / "weights.csv")
    trends = pandas.read_csv(out / "trends.csv")
    weights, trends = weights[weights["pair"] == pair], trends[trends["pair"] == pair]
    measures = list(dict.fromkeys(weights["measure"]))
    columns = 4
    rows = -(-len(measures) // columns)
    figure, axes = plt.subplots(rows, columns, figsize=(3.6 * columns, 2.6 * rows), squeeze=False)
    for axis, measure in zip(axes.flat, measures):
        for colour, (way, part) in zip(COLOURS, weights[weights["measure"] == measure].groupby("way", sort=False)):
            axis.plot(part["weight_01"], part["mean"], color=colour, label=way)
            axis.fill_between(part["weight_01"], part["low"], part["high"], color=colour, alpha=0.15, lw=0)
        row = trends[trends["measure"] == measure].iloc[0]
        axis.plot([0, 1], [row["grid_observed"], row["irregular_observed"]], "k+", label="as observed")
        unit = "" if pandas.isna(row["unit"]) else f" [{row['unit']}]"
        axis.set_title(f"{measure.replace('_', ' ')}{unit}", fontsize=8)
        axis.tick_params(labelsize=7)
    for axis in list(axes.flat)[len(measures):]:
        axis.axis("off")
    axes.flat[0].legend(fontsize=7)
    figure.supxlabel("weight of the irregular example", fontsize=9)
    figure.tight_layout()
    figure.savefig(out / f"curves_{pair}.png", dpi=110)
    plt.close(figure)


def draw_trends(out):
    """Spearman's correlation with its interval, one line per measure."""
    trends = pandas.read_csv(out / "trends.csv")
    pairs = list(dict.fromkeys(trends["pair"]))
    figure, axes = plt.subplots(1, len(pairs), figsize=(5.6 * len(pairs), 6.2), sharey=True, squeeze=False)
    for axis, pair in zip(axes.flat, pairs):
        part = trends[trends["pair"] == pair]
        measures = list(dict.fromkeys(part["measure"]))
        for i, (colour, (way, some)) in enumerate(zip(COLOURS, part.groupby("way", sort=False))):
            y = [measures.index(m) + 0.2 * (i - 1) for m in some["measure"]]
            axis.hlines(y, some["ci_low"], some["ci_high"], color=colour)
            axis.plot(some["spearman"], y, "o", ms=3.5, color=colour, label=way)
        axis.axvline(0, color="grey", lw=0.6)
        axis.set_xlim(-1.05, 1.05)
        axis.set_yticks(range(len(measures)), [m.replace("_", " ") for m in measures], fontsize=8)
        axis.set_title(pair.replace("_", " "), fontsize=9)
    axes.flat[0].invert_yaxis()
    axes.flat[0].legend(fontsize=8, loc="lower left")
    figure.supxlabel("Spearman's correlation with the weight, towards the irregular example", fontsize=9)
    figure.tight_layout()
    figure.savefig(out / "trends.png", dpi=110)
    plt.close(figure)


def draw_networks(out):
    """The networks of the first seed."""
    networks = pandas.read_csv(out / "networks.csv")
    kept = [w for w in sorted(set(networks["weight_01"])) if round(w * 10) % 2 == 0]
    kinds = list(dict.fromkeys(zip(networks["pair"], networks["way"])))
    figure, axes = plt.subplots(len(kinds), len(kept), figsize=(2.6 * len(kept), 2.7 * len(kinds)), squeeze=False)
    for row, (pair, way) in zip(axes, kinds):
        for axis, weight in zip(row, kept):
            chosen = networks[(networks["pair"] == pair) & (networks["way"] == way)]
            for street in chosen[chosen["weight_01"] == weight].itertuples():
                text = street.line[len("LINESTRING ("):-1]
                x, y = zip(*[map(float, p.split()) for p in text.split(", ")])
                axis.plot(x, y, color="k", lw=0.25 + 0.035 * street.width_m)
            axis.set_aspect("equal")
            axis.axis("off")
            axis.set_title(f"w = {weight:g}", fontsize=8)
        row[0].text(-0.02, 0.5, f"{pair.replace('_', ' ')}\n{way}", transform=row[0].transAxes, rotation=90, ha="right",
                    va="center", fontsize=7)
    figure.tight_layout()
    figure.savefig(out / "networks.png", dpi=110)
    plt.close(figure)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", type=pathlib.Path, help="what layout_blending wrote")
    out = parser.parse_args().out
    for pair in dict.fromkeys(pandas.read_csv(out / "weights.csv")["pair"]):
        draw_curves(out, pair)
    draw_trends(out)
    draw_networks(out)


if __name__ == "__main__":
    main()
