"""Har, figure 6.9: three of the five best buildings of one structure."""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from figure import make  # noqa: E402
from drawing import caption, letter, sheet  # noqa: E402
from buildings import build, open_edges, picture_of, show  # noqa: E402

DESIGN = {
    "name": "k best",
    "skeleton": {
        "nodes": [[0, 0], [24, 0], [48, 0], [24, 26]],
        "edges": [{"from": 0, "to": 1, "front": "right"}, {"from": 1, "to": 2, "front": "right"},
                  {"from": 1, "to": 3, "front": "right"}]},
    "preferences": {"variety_m2": 0.5, "seed": 2}}
SHOWN = [0, 2, 4]


def draw(figure):
    buildings, _ = build(figure, "k_best", DESIGN, "palazzo", k=5)
    picture, (axes,) = sheet(1, 3, 14.0, 4.2)
    for key, panel, i in zip("abc", axes, SHOWN):
        show(panel, picture_of(figure, f"view_{i + 1}", [buildings[i].model], -50.0, 26.0))
        letter(panel, key, f"number {i + 1}: {buildings[i].report['cost_m2']:.2f} m² with preferences")
    caption(picture, figure)
    figure.save(picture)

    costs = [b.report["cost_m2"] for b in buildings]
    tees = [p["part"] for b in buildings for p in b.report["key_points"] if "_tee_" in p["part"]]
    figure.measured("count", len({tuple(b.parts) for b in buildings}), "different ones")
    figure.measured("order", min(b - a for a, b in zip(costs, costs[1:])), "costs " + ", ".join(f"{c:.3f}" for c in costs))
    figure.measured("lengths", max(b.length_error_m() for b in buildings))
    figure.measured("tee", len(set(tees)), ", ".join(tees))
    figure.measured("closed", open_edges(buildings))


if __name__ == "__main__":
    sys.exit(make("har/fig06_09", draw))
