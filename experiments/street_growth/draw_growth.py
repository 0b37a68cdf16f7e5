"""python3 draw_growth.py RUN_DIR: draws what street_growth wrote: recovery.png, distances.png, a map per city, tables.md."""

import json
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import fiona
import geopandas
import matplotlib.pyplot as plt
import numpy
import pandas

#: Edges of a map: recovered, missing, false.
COLOURS = {"recovered": "#9aa0a6", "missing": "#0072b2", "false": "#d55e00"}
#: Shares and their marks.
SHARES = {"recall_01": ("#0072b2", "o"), "precision_01": ("#e69f00", "s"), "f1_01": ("#000000", "D")}
MEASURES_IN_TABLE = ["node_degree", "edge_length_m", "block_area_m2", "transport_ratio", "betweenness"]
#: Two lines of a share, this much apart.
STEP = 0.22


def variants_of(run):
    config = json.loads((run / "manifest.json").read_text())["config"]
    cells = pandas.read_csv(run / "cells.csv")
    order = list(cells[cells.status != "skipped"].variant.dropna().unique())
    ablations = [a["label"] for a in config.get("ablations", [])]
    return [v for v in order if v not in ablations], ablations


def draw_recovery(run, out):
    """Every variant's recall, precision and F1 by edges and by length, with intervals over squares."""
    rows = pandas.read_csv(run / "recovery.csv", dtype={"level": str})
    rows = rows[rows.level == "all"]
    strategies, ablations = variants_of(run)
    order = (strategies + ablations)[::-1]
    cities = list(rows.dataset.unique())
    figure, grid = plt.subplots(len(cities), 2, figsize=(13, max(2.5, 0.32 * len(order)) * len(cities)), squeeze=False,
                                sharey=True, layout="constrained")
    for i, city in enumerate(cities):
        for k, by in enumerate(("edges", "length")):
            axes = grid[i][k]
            for s, (share, (colour, marker)) in enumerate(SHARES.items()):
                own = rows[(rows.dataset == city) & (rows.judged_by == by) & (rows.quantity == share)].set_index("variant")
                own = own.reindex(order)
                y = numpy.arange(len(order)) + STEP * (1 - s)
                axes.plot(own.value, y, marker, color=colour, markersize=4, label=share.removesuffix("_01"))
                axes.hlines(y, own.ci_low, own.ci_high, color=colour, linewidth=1)
            axes.set_yticks(range(len(order)), order, fontsize=7)
            axes.axhline(len(ablations) - 0.5, color="#cccccc", linewidth=1)
            axes.grid(axis="x", color="#eeeeee")
            axes.set_title(f"{city}, by {by}; 95 % over squares", fontsize=9)
    grid[0][0].legend(fontsize=7, loc="lower left")
    figure.savefig(out / "recovery.png", dpi=130)
    plt.close(figure)


def draw_distances(run, out):
    """KS of every measure, mean and spread over seeds, by strategy."""
    rows = pandas.read_csv(run / "distances.csv")
    strategies, _ = variants_of(run)
    cities, measures = list(rows.dataset.unique()), list(rows.measure.unique())
    figure, grid = plt.subplots(1, len(cities), figsize=(5 * len(cities), 4), squeeze=False, sharey=True, layout="constrained")
    for axes, city in zip(grid[0], cities):
        for s, strategy in enumerate(strategies):
            own = rows[(rows.dataset == city) & (rows.variant == strategy)].groupby("measure").ks
            mean, low, high = (f.reindex(measures) for f in (own.mean(), own.min(), own.max()))
            y = numpy.arange(len(measures)) + STEP * (s - (len(strategies) - 1) / 2)
            axes.plot(mean, y, "o", markersize=4, label=strategy)
            axes.hlines(y, low, high, linewidth=1)
        axes.set_yticks(range(len(measures)), measures, fontsize=8)
        axes.set_title(f"{city}: KS to the city, least to most over seeds", fontsize=9)
        axes.grid(axis="x", color="#eeeeee")
    grid[0][0].legend(fontsize=8)
    figure.savefig(out / "distances.png", dpi=130)
    plt.close(figure)


def draw_map(file, strategies, out, title):
    """True, missing and false edges of every strategy's first seed."""
    layers = [s for s in strategies if s in fiona.listlayers(file)]
    figure, grid = plt.subplots(1, len(layers), figsize=(9 * len(layers), 9), squeeze=False, layout="constrained")
    for axes, layer in zip(grid[0], layers):
        edges = geopandas.read_file(file, layer=layer)
        for kind, colour in COLOURS.items():
            own = edges[edges.kind == kind]
            if len(own):
                own.plot(ax=axes, color=colour, linewidth=0.7 if kind == "recovered" else 1.1)
        counts = edges.kind.value_counts()
        legend = [plt.Line2D([], [], color=c, label=f"{kind} {counts.get(kind, 0)}") for kind, c in COLOURS.items()]
        axes.legend(handles=legend, fontsize=9, loc="lower right")
        axes.set_title(f"{title}: {layer}")
        axes.set_axis_off()
    figure.savefig(out, dpi=110)
    plt.close(figure)


def table(columns, rows):
    lines = ["| " + " | ".join(columns) + " |", "|" + " --- |" * len(columns)]
    return "\n".join(lines + ["| " + " | ".join(map(str, row)) + " |" for row in rows])


def shares_table(run, city):
    rows = pandas.read_csv(run / "recovery.csv", dtype={"level": str})
    rows = rows[(rows.dataset == city) & (rows.level == "all")]
    differences = pandas.read_csv(run / "differences.csv")
    differences = differences[(differences.dataset == city) & (differences.judged_by == "edges") & (differences.quantity == "f1_01")]

    def cell(variant, by, share):
        own = rows[(rows.variant == variant) & (rows.judged_by == by) & (rows.quantity == share)]
        if own.empty:
            return "–"
        row = own.iloc[0]
        return f"{row.value:.3f} ({row.ci_low:.3f}..{row.ci_high:.3f})" if share == "f1_01" else f"{row.value:.3f}"

    out = []
    for variant in sum(variants_of(run), []):
        own = differences[differences.variant == variant]
        difference, p = ("", "") if own.empty else (
            f"{own.difference.iloc[0]:+.3f} ({own.ci_low.iloc[0]:+.3f}..{own.ci_high.iloc[0]:+.3f})", f"{own.p_holm.iloc[0]:.2g}")
        out.append([variant, *(cell(variant, "edges", s) for s in SHARES), difference, p, *(cell(variant, "length", s) for s in SHARES)])
    return table(["variant", "recall", "precision", "F1", "F1 less reference's", "p (Holm)", "recall by length", "precision", "F1"], out)


def levels_table(run, city):
    rows = pandas.read_csv(run / "recovery.csv", dtype={"level": str})
    rows = rows[(rows.dataset == city) & (rows.level != "all") & (rows.judged_by == "edges") & (rows.quantity != "f1_01")]
    levels = sorted(rows.level.unique())
    out = []
    for variant in variants_of(run)[0]:
        line = [variant]
        for level in levels:
            own = rows[(rows.variant == variant) & (rows.level == level)].set_index("quantity").value
            line.append(" / ".join(f"{own[s]:.2f}" if s in own else "–" for s in ("recall_01", "precision_01")))
        out.append(line)
    return table(["recall / precision by level", *levels], out)


def measures_table(run, city):
    distances = pandas.read_csv(run / "distances.csv")
    scalars = pandas.read_csv(run / "scalars.csv")
    distances, scalars = distances[distances.dataset == city], scalars[scalars.dataset == city]
    strategies = variants_of(run)[0]
    out = [["KS " + m, "0", *(f"{distances[(distances.variant == s) & (distances.measure == m)].ks.mean():.3f}" for s in strategies)]
           for m in MEASURES_IN_TABLE]
    for name, own in scalars.groupby("measure", sort=False):
        values = [own[own.variant == s].grown.mean() for s in strategies]
        out.append([name, f"{own.known.iloc[0]:.4g}", *(f"{v:.4g}" for v in values)])
    return table(["measure", "city", *strategies], out)


def main(run):
    cities = list(pandas.read_csv(run / "recovery.csv").dataset.unique())
    draw_recovery(run, run)
    draw_distances(run, run)
    text = []
    for city in cities:
        file = run / f"edges_{city}.gpkg"
        if file.exists():
            draw_map(file, variants_of(run)[0], run / f"map_{city}.png", city)
        text += [f"## {city}", shares_table(run, city), levels_table(run, city), measures_table(run, city)]
    (run / "tables.md").write_text("\n\n".join(text) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]))
