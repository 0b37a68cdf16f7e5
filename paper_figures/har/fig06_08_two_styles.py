"""Har, figure 6.8: the same structure in two styles; cylinders stand where a part begins."""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from figure import make  # noqa: E402
from drawing import caption, letter, sheet  # noqa: E402
from buildings import build, draw_skeleton, open_edges, picture_of, show  # noqa: E402

#: The lengths that the figure tells; the thesis does not say which edge each belongs to.
DESIGN = {
    "name": "two styles",
    "skeleton": {
        "nodes": [[0, 0], [67.0, 0], [67.0, 45.6], [22.8, 0], [22.8, 64.4], [0, 64.4], [45.6, 64.4]],
        "edges": [{"from": 0, "to": 3, "front": "right"}, {"from": 3, "to": 1, "front": "right"},
                  {"from": 1, "to": 2, "front": "right"}, {"from": 3, "to": 4, "front": "left"},
                  {"from": 5, "to": 4, "front": "left"}, {"from": 4, "to": 6, "front": "left"}]},
    "preferences": {"variety_m2": 0.4, "seed": 2}}
STYLES = {"b": ("townhouse", (0.95, 0.75, 0.1)), "c": ("palazzo", (0.85, 0.15, 0.15))}


def draw(figure):
    picture, (axes,) = sheet(1, 3, 14.0, 4.6, gridspec_kw={"width_ratios": [0.75, 1.3, 1.3]})
    draw_skeleton(axes[0], DESIGN)
    letter(axes[0], "a", "structure")
    built = {}
    for panel, (key, (kit, rgb)) in zip(axes[1:], STYLES.items()):
        (building,), _ = build(figure, kit, DESIGN, kit)
        top = building.model.bounds()[1][2]
        marks = building.marks(rgb, 0.55 * top, 0.4, 0.62 * top)
        show(panel, picture_of(figure, f"{kit}_view", [building.model], -48.0, 34.0, room=1.15, marks=marks))
        letter(panel, key, f"{kit}: {len(building.parts)} parts")
        built[kit] = building
    caption(picture, figure)
    figure.save(picture)

    one, other = built.values()
    figure.measured("shape", max(abs(a["length_m"] - b["length_m"]) for a, b in zip(one.report["rows"], other.report["rows"])),
                    "lengths of the rows in one style and in the other")
    figure.measured("lengths", max(one.length_error_m(), other.length_error_m()))
    figure.measured("elements", abs(len(one.parts) - len(other.parts)), f"{len(one.parts)} and {len(other.parts)}")
    figure.measured("closed", open_edges(built.values()))


if __name__ == "__main__":
    sys.exit(make("har/fig06_08", draw))
