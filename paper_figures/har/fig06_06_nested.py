"""Har, figure 6.6: a closed loop with nested t-parts."""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from figure import make  # noqa: E402
from drawing import caption, letter, sheet  # noqa: E402
from buildings import build, draw_skeleton, example, open_edges, picture_of, show  # noqa: E402

RUNS = 5


def draw(figure):
    design = example("nested")
    times = []
    for _ in range(RUNS):
        (building,), time_ms = build(figure, "nested", design, "palazzo")
        times.append(time_ms)

    picture, (axes,) = sheet(1, 2, 12.0, 5.0, gridspec_kw={"width_ratios": [1, 1.9]})
    draw_skeleton(axes[0], design)
    letter(axes[0], "a", "skeleton, fronts in blue")
    show(axes[1], picture_of(figure, "view", [building.model], -65.0, 34.0))
    letter(axes[1], "b", f"{len(building.parts)} parts")
    caption(picture, figure)
    figure.save(picture)

    tees = sum("_tee_" in part["part"] for part in building.report["key_points"])
    edges, nodes = len(design["skeleton"]["edges"]), len(design["skeleton"]["nodes"])
    figure.measured("tees", tees)
    figure.measured("loop", edges - nodes + 1, "edges less nodes and one")
    figure.measured("lengths", building.length_error_m())
    figure.measured("closed", open_edges([building]))
    figure.measured("time", sorted(times)[RUNS // 2] / 1000, f"median of {RUNS}: search alone")


if __name__ == "__main__":
    sys.exit(make("har/fig06_06", draw))
