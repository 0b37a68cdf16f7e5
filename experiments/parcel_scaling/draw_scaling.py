"""python3 draw_scaling.py RUN_DIR: draws RUN_DIR/scaling.png from what parcel_scaling wrote there."""

import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import pandas

COLOURS = ["#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#000000", "#7b4a12", "#8a8f00"]
#: What half a million parcels may take on two cores: seconds, layer included, and megabytes.
LIMIT_PARCELS, LIMITS_S, LIMIT_MB = 500_000, {"obb": 30.0, "skeleton": 60.0}, 3000.0


def draw_time(axes, rows, exponents, colours):
    for strategy, own in rows.groupby("strategy", sort=False):
        exponent = exponents[(exponents["strategy"] == strategy) & (exponents["phase"] == "divide")]["exponent"]
        fitted = f", grows as n^{exponent.iloc[0]:.2f}" if len(exponent) else ""
        colour = colours[strategy]
        axes.plot(own["parcels"], own["divide_s"], "o-", color=colour, label=f"{strategy}: divide{fitted}")
        axes.plot(own["parcels"], own["divide_cpu_s"] / own["threads"], "-", color=colour, linewidth=0.8, alpha=0.6,
                  label=f"{strategy}: processor time of dividing / threads")
        axes.plot(own["parcels"], own["divide_s"] + own["check_s"], "s--", color=colour, markersize=4,
                  label=f"{strategy}: and check the coverage")
        if own["write_s"].notna().all():
            axes.plot(own["parcels"], own["divide_s"] + own["check_s"] + own["write_s"], "^:", color=colour,
                      markersize=4, label=f"{strategy}: and measure, and write a GeoPackage")
        if strategy in LIMITS_S:
            axes.plot([LIMIT_PARCELS], [LIMITS_S[strategy]], "_", color=colour, markersize=30, markeredgewidth=3)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel("parcels")
    axes.set_ylabel("wall time [s]")
    axes.set_title(f"Time on {rows['threads'].iloc[0]} threads (bars: limit at {LIMIT_PARCELS:,})")
    axes.grid(which="major", color="#eeeeee")
    axes.legend(fontsize=8, frameon=False)


def draw_memory(axes, rows, colours):
    for strategy, own in rows.groupby("strategy", sort=False):
        axes.plot(own["parcels"], own["peak_mb"], "o-", color=colours[strategy], label=f"{strategy}: divide and check")
        axes.plot(own["parcels"], own["peak_with_layer_mb"], "^:", color=colours[strategy], markersize=4,
                  label=f"{strategy}: with the GeoPackage")
    axes.plot([LIMIT_PARCELS], [LIMIT_MB], "_", color="#d62728", markersize=30, markeredgewidth=3)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel("parcels")
    axes.set_ylabel("peak resident memory [MB]")
    axes.set_title(f"Memory (bar: limit at {LIMIT_PARCELS:,})")
    axes.grid(which="major", color="#eeeeee")
    axes.legend(fontsize=8, frameon=False)


def main(arguments):
    if len(arguments) != 1:
        print(__doc__.split("\n", maxsplit=1)[0], file=sys.stderr)
        return 2
    folder = pathlib.Path(arguments[0])
    rows, exponents = pandas.read_csv(folder / "scaling.csv"), pandas.read_csv(folder / "exponents.csv")
    colours = dict(zip(rows["strategy"].unique(), COLOURS))
    figure, (left, right) = plt.subplots(1, 2, figsize=(12, 5.2), layout="constrained")
    draw_time(left, rows, exponents, colours)
    draw_memory(right, rows, colours)
    figure.suptitle(f"Dividing {rows['dataset'].iloc[0]}, tiled: copies of the city side by side, no real place")
    figure.savefig(folder / "scaling.png", dpi=110, metadata={"Software": None})
    print(folder / "scaling.png")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
