"""Har, figure 6.5: skyscrapers of one height and three floor area ratios, stacked from floors."""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from figure import make  # noqa: E402
from drawing import caption, letter, sheet  # noqa: E402
from buildings import build, example, open_edges, picture_of, show  # noqa: E402
from rendering import read_ply  # noqa: E402

RATIOS = [10, 15, 20]


def floor_parts(figure):
    """All floors of the kit side by side."""
    figure.plat("parts", "make", "tower", "--out", figure.path("tower_parts"))
    models = []
    for file in sorted(figure.path("tower_parts").rglob("*.ply")):
        model = read_ply(file)
        row, column = divmod(len(models), 6)
        models.append(model.moved((column * 48.0, -row * 52.0, 0.0)))
    return models


def draw(figure):
    floors = floor_parts(figure)
    towers = {}
    for ratio in RATIOS:
        design = example(f"tower_{ratio}")
        (towers[ratio],), _ = build(figure, f"tower_{ratio}", design, "tower", method="intermediate_graph")

    picture, (axes,) = sheet(1, 4, 12.0, 6.2, gridspec_kw={"width_ratios": [1.7, 1, 1, 1]})
    show(axes[0], picture_of(figure, "floors", floors, -70.0, 48.0, 1100, 900))
    letter(axes[0], "a", f"{len(floors)} floor parts")
    for key, ratio, panel in zip("bcd", RATIOS, axes[1:]):
        show(panel, picture_of(figure, f"tower_{ratio}_view", [towers[ratio].model], -62.0, 12.0, 600, 1100))
        letter(panel, key, f"FAR {ratio}: {len(towers[ratio].parts)} parts")
    caption(picture, figure)
    figure.save(picture)

    areas = {ratio: towers[ratio].report["resources"]["floor_area_m2"] for ratio in RATIOS}
    ground = example("tower_10")["tower"]["ground_area_m2"]
    figure.measured("elements", len(floors), "of the generated kit")
    figure.measured("height", max(abs(t.model.bounds()[1][2] - 120.0) for t in towers.values()), "top of the mesh")
    figure.measured("ratio", max(abs(areas[r] / ground - r) for r in RATIOS),
                    ", ".join(f"{areas[r]:.0f} m2" for r in RATIOS) + f" on {ground} m2")
    volumes = [towers[r].report["surface"]["volume_m3"] for r in RATIOS]
    figure.measured("chubby", min(b / a for a, b in zip(volumes, volumes[1:])),
                    "volumes " + ", ".join(f"{v:.0f}" for v in volumes) + " m3")
    figure.measured("closed", open_edges(towers.values()))


if __name__ == "__main__":
    sys.exit(make("har/fig06_05", draw))
