"""python3 draw_scaling.py RUN_DIR: draws scaling.png, memory.png and states.png there from what rcksp_scaling wrote."""

import json
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import pandas

#: A colour and a marker per strategy, a dash per choice of its options.
COLOURS = ["#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#000000", "#7b4a12", "#8a8f00"]
MARKERS = "osD^vP<>"
DASHES = ["-", "--", ":", "-."]
COLUMNS = 3
LEGEND_COLUMNS = 6
#: How a run is marked that did not finish.
UNFINISHED = {"time_limit": "x", "memory_limit": "+", "failed": "1"}


def styles_of(cells):
    """Label -> what plot() takes."""
    names, out = list(cells.name.unique()), {}
    for name, own in cells.groupby("name", sort=False):
        which = names.index(name)
        for variant, label in enumerate(own.strategy.unique()):
            out[label] = {"color": COLOURS[which % len(COLOURS)], "marker": MARKERS[which % len(MARKERS)],
                          "linestyle": DASHES[variant % len(DASHES)]}
    return out


def draw_published(axes, config, study, quantity):
    for curve in config.get("published", []):
        if (curve["study"], curve["quantity"]) == (study, quantity):
            axes.plot(curve["values"], curve["numbers"], "x--", color="#999999", label=f"{curve['label']} (its own machine)")


def exponent_text(exponents, study, strategy, quantity):
    own = exponents[(exponents.study == study) & (exponents.strategy == strategy) & (exponents.quantity == quantity)]
    return f" {own.exponent.iloc[0]:.2f}" if len(own) and own.points.iloc[0] > 2 else ""


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
    for strategy, own in rows.groupby("strategy", sort=False):
        done = own[own.status == "ok"]
        if len(done):
            # What did not finish leaves a gap.
            axes.plot(own.value, own[quantity].where(own.status == "ok"), markersize=3.5, linewidth=1.1, label=strategy,
                      **styles[strategy])
        if len(done) and study["name"] == "street":
            axes.annotate(exponent_text(exponents, study["name"], strategy, quantity),
                          (done.value.iloc[-1], done[quantity].iloc[-1]), fontsize=6, color=styles[strategy]["color"])
        unfinished = own[own.status.isin(list(UNFINISHED))]
        for value, status in zip(unfinished.value, unfinished.status):
            if quantity == "total_s":
                axes.plot([value], [config["time_limit_s"]], marker=UNFINISHED[status], color=styles[strategy]["color"],
                          markersize=7, linestyle="none")
    draw_published(axes, config, study["name"], quantity)
    set_scales(axes, sorted(rows.value.unique()))
    axes.set_xlabel(study.get("title", study["name"]), fontsize=8)
    axes.set_title(study["name"], fontsize=9, loc="left")
    axes.grid(which="major", color="#eeeeee")
    axes.tick_params(labelsize=7)


def draw_legend(figure, axes):
    """Below the panels. Debian's matplotlib 3.6 has no legend outside of a constrained layout: make room for it."""
    handles = {text: handle for panel in axes.flat for handle, text in zip(*panel.get_legend_handles_labels())}
    room = (0.15 + 0.2 * -(-len(handles) // LEGEND_COLUMNS)) / figure.get_size_inches()[1]
    figure.get_layout_engine().set(rect=(0.0, room, 1.0, 1.0 - room))
    figure.legend(handles.values(), handles.keys(), loc="lower center", ncol=LEGEND_COLUMNS, fontsize=8, frameon=False)


def draw(folder, cells, exponents, manifest, quantity, label, name):
    config = manifest["config"]
    studies = [s for s in config["studies"] if s["name"] in set(cells.study)]
    styles = styles_of(cells)
    lines = -(-len(studies) // COLUMNS)
    figure, axes = plt.subplots(lines, COLUMNS, figsize=(13, 3.6 * lines + 0.6), layout="constrained", squeeze=False)
    for study, panel in zip(studies, axes.flat):
        draw_study(panel, cells[cells.study == study["name"]], exponents, config, study, quantity, styles)
    for panel in list(axes.flat)[len(studies):]:
        panel.axis("off")
    for line in axes:
        line[0].set_ylabel(label, fontsize=8)
    draw_legend(figure, axes)
    figure.suptitle(f"{label} on {manifest['processor']}, load {manifest['load_before']:.1f} to {manifest['load_after']:.1f}; numbers "
                    f"at curves: exponent of length; at the top, not finished: x {config['time_limit_s']:g} s, + memory, Y states",
                    fontsize=9)
    figure.savefig(folder / name, dpi=110, metadata={"Software": None})
    plt.close(figure)
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
    draw(folder, cells, exponents, manifest, "states_expanded", "states expanded", "states.png")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
