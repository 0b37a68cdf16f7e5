"""python3 draw_scaling.py RUN_DIR: draws RUN_DIR/scaling.png and memory.png from what rcksp_scaling wrote there."""

import json
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import pandas

COLOURS = ["#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#d55e00", "#000000", "#7b4a12", "#8a8f00"]
MARKERS = "osD^vP*X<"
COLUMNS = 3


def draw_thesis(axes, config, study, quantity):
    for curve in config.get("published", []):
        if (curve["study"], curve["quantity"]) == (study, quantity):
            axes.plot(curve["values"], curve["numbers"], "x--", color="#999999", label=f"{curve['label']} (its own machine)")


def exponent_of(exponents, study, strategy, quantity):
    own = exponents[(exponents.study == study) & (exponents.strategy == strategy) & (exponents.quantity == quantity)]
    return f"  ~x^{own.exponent.iloc[0]:.2f}" if len(own) and own.points.iloc[0] > 2 else ""


def set_scales(axes, values):
    """Logarithmic, at least a decade high; where zero is one of the values it has its place to the left."""
    axes.set_yscale("log")
    low, high = axes.get_ylim()
    if high < 10 * low:
        middle = (low * high) ** 0.5
        axes.set_ylim(middle / 10**0.5, middle * 10**0.5)
    if min(values) > 0 and max(values) / min(values) > 4:
        axes.set_xscale("log")
    elif min(values) == 0 and max(values) > 5:
        axes.set_xscale("symlog", linthresh=min(v for v in values if v > 0))
        axes.set_xlim(left=-0.02)
    if len(values) < 5:
        axes.set_xticks(values, [f"{v:g}" for v in values])


def draw_study(axes, rows, exponents, config, study, quantity, styles):
    values = sorted(rows.value.unique())
    for strategy, own in rows.groupby("strategy", sort=False):
        colour, marker = styles[strategy]
        done = own[own.status == "ok"]
        grows = exponent_of(exponents, study["name"], strategy, quantity) if study["name"] == "street" else ""
        if len(done):
            axes.plot(done.value, done[quantity], marker=marker, color=colour, markersize=4, linewidth=1.2,
                      label=strategy + grows)
        unfinished = own[~own.status.isin(["ok", "not_tried"])]
        for value, status in zip(unfinished.value, unfinished.status):
            if quantity == "total_s":
                axes.plot([value], [config["time_limit_s"]], marker="x" if status == "time_limit" else "+", color=colour,
                          markersize=7, linestyle="none")
    draw_thesis(axes, config, study["name"], quantity)
    set_scales(axes, values)
    axes.set_xlabel(study.get("title", study["name"]), fontsize=8)
    axes.set_title(study["name"], fontsize=9, loc="left")
    axes.grid(which="major", color="#eeeeee")
    axes.tick_params(labelsize=7)
    if study["name"] == "street":
        axes.legend(fontsize=6, frameon=False)


def draw(folder, cells, exponents, manifest, quantity, label, name):
    config = manifest["config"]
    studies = [s for s in config["studies"] if s["name"] in set(cells.study)]
    styles = {s: (COLOURS[i % len(COLOURS)], MARKERS[i % len(MARKERS)]) for i, s in enumerate(cells.strategy.unique())}
    lines = -(-len(studies) // COLUMNS)
    figure, axes = plt.subplots(lines, COLUMNS, figsize=(13, 3.8 * lines), layout="constrained", squeeze=False)
    for study, panel in zip(studies, axes.flat):
        draw_study(panel, cells[cells.study == study["name"]], exponents, config, study, quantity, styles)
    for panel in list(axes.flat)[len(studies):]:
        panel.axis("off")
    for line in axes:
        line[0].set_ylabel(label, fontsize=8)
    handles = {text: handle for panel in axes.flat for handle, text in zip(*panel.get_legend_handles_labels())
               if "~" not in text}
    figure.suptitle(f"{label} on {manifest['processor']}, load {manifest['load_before']:.1f} to {manifest['load_after']:.1f}; "
                    f"crosses: not finished within {config['time_limit_s']:g} s (x) or its memory (+)", fontsize=9)
    if "street" not in set(cells.study):
        figure.legend(handles.values(), handles.keys(), loc="outside lower center", ncol=4, fontsize=8)
    figure.savefig(folder / name, dpi=110, metadata={"Software": None})
    print(folder / name)


def main(arguments):
    if len(arguments) != 1:
        print(__doc__.split("\n", maxsplit=1)[0], file=sys.stderr)
        return 2
    folder = pathlib.Path(arguments[0])
    cells, exponents = pandas.read_csv(folder / "cells.csv"), pandas.read_csv(folder / "exponents.csv")
    manifest = json.loads((folder / "manifest.json").read_text(encoding="utf-8"))
    draw(folder, cells, exponents, manifest, "total_s", "wall time, median [s]", "scaling.png")
    draw(folder, cells, exponents, manifest, "peak_mb", "peak of resident memory [MB]", "memory.png")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
