"""Draws summary.csv of parcel_persistence: /usr/bin/python3 draw.py RUN_FOLDER [STRATEGY]; writes persistence.png there."""

import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import pandas as pd

MEASURES = {
    "survivors": "old parcels that survive",
    "identity": "survivors recognised",
    "transfer": "parcels that inherit\nfrom their place",
    "iou": "IoU with the match",
}
MATCHINGS = {
    "relative_distances": ("#1b6ca8", "relative distances [VKW12]"),
    "nearest_centroid": ("#d1495b", "nearest centroid"),
    "largest_overlap": ("#66a182", "largest overlap"),
}


def draw(folder, strategy):
    rows = pd.read_csv(folder / "summary.csv")
    kinds = list(dict.fromkeys(rows.kind))
    figure, axes = plt.subplots(
        len(MEASURES), len(kinds), figsize=(2.3 * len(kinds) + 1, 2.1 * len(MEASURES)), sharex=True, sharey=True, squeeze=False
    )
    for (measure, title), line in zip(MEASURES.items(), axes):
        for kind, axis in zip(kinds, line):
            cell = rows[(rows.measure == measure) & (rows.kind == kind)].dropna(subset=["value"])
            for matching, (colour, label) in MATCHINGS.items():
                if measure == "survivors" and matching != "relative_distances":
                    continue  # it does not depend on the matching
                colour = "#333333" if measure == "survivors" else colour
                one = cell[cell.matching == matching]
                for name, other in one.groupby("strategy"):
                    axis.plot(other.size_m, other.value, color=colour, alpha=0.18, linewidth=0.8)
                main = one[one.strategy == strategy]
                axis.fill_between(main.size_m, main.ci_low, main.ci_high, color=colour, alpha=0.2, linewidth=0)
                axis.plot(main.size_m, main.value, color=colour, linewidth=1.8, label=label)
            axis.set_xscale("log")
            axis.set_ylim(0, 1.03)
            axis.grid(alpha=0.25)
            if axis in axes[0]:
                axis.set_title(kind, fontsize=9)
        line[0].set_ylabel(title, fontsize=8)
    for axis in axes[-1]:
        axis.set_xlabel("size of the edit, m", fontsize=8)
    handles, labels = axes[1][0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="lower center", ncol=3, fontsize=9, frameon=False)
    figure.suptitle(f"Parcels of the blocks that an edit changes: {strategy} with 95 % intervals over edits, thin lines the other strategies", fontsize=9)
    figure.tight_layout(rect=(0, 0.04, 1, 0.98))
    figure.savefig(folder / "persistence.png", dpi=150)


if __name__ == "__main__":
    draw(Path(sys.argv[1]), sys.argv[2] if len(sys.argv) > 2 else "skeleton")
