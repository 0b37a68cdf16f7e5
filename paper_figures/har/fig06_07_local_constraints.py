"""Har, figure 6.7: a building with other constraints on every edge."""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from figure import make  # noqa: E402
from drawing import caption, letter, sheet  # noqa: E402
from buildings import build, draw_skeleton, example, open_edges, picture_of, show  # noqa: E402


def words(bounds):
    """Bounds as one reads them."""
    out = []
    for name, value in bounds.items():
        low, high = value if isinstance(value, list) else (value, value)
        amount = f"{low}" if low == high else f"{low} to {high}" if high is not None else f"at least {low}"
        out.append(f"{name.replace('_', ' ')}: {amount}")
    return ", ".join(out)


def broken(row, bounds):
    """How many of the bounds the attributes of a row do not keep."""
    count = 0
    for name, value in bounds.items():
        low, high = value if isinstance(value, list) else (value, value)
        amount = row["attributes"].get(name, 0.0)
        count += amount < (low or 0) or (high is not None and amount > high)
    return count


def draw(figure):
    design = example("balconies")
    edges = design["skeleton"]["edges"]
    (building,), _ = build(figure, "balconies", design, "townhouse")

    picture, (axes,) = sheet(1, 2, 12.0, 5.0, gridspec_kw={"width_ratios": [1, 1.9]})
    draw_skeleton(axes[0], design, labels=False)
    for edge in edges:
        middle = [0.5 * (a + b) for a, b in zip(*(design["skeleton"]["nodes"][edge[end]] for end in ("from", "to")))]
        axes[0].text(*middle, words(edge.get("bounds", {})), fontsize=6.5, ha="center", va="center",
                     bbox={"boxstyle": "round,pad=0.2", "facecolor": "white", "edgecolor": "#999999"})
    letter(axes[0], "a", "constraints on edges")
    show(axes[1], picture_of(figure, "view", [building.model], -40.0, 26.0))
    letter(axes[1], "b", f"{len(building.parts)} parts")
    caption(picture, figure)
    figure.save(picture)

    rows = {row["edges"][0]: row for row in building.report["rows"]}
    figure.measured("local", sum(broken(rows[i], e.get("bounds", {})) for i, e in enumerate(edges)),
                    f"of {sum(len(e.get('bounds', {})) for e in edges)} on {len(edges)} edges")
    figure.measured("lengths", building.length_error_m())
    figure.measured("closed", open_edges([building]))


if __name__ == "__main__":
    sys.exit(make("har/fig06_07", draw))
