"""ABVA08, figure 3: what the constraint solver sees of two tiles; a tile moved, and its deformed neighbour replaced."""

import json
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from figure import make  # noqa: E402
from drawing import GREY, INK, caption, fill, letter, lines, open_map, sheet  # noqa: E402
from imagery import Picture, rendered  # noqa: E402
from places import Window, layer, mapped_layer  # noqa: E402

import numpy  # noqa: E402

PLACE = Window("cambridge_ma", 232820.0, 901850.0, 232920.0, 901950.0, "Cambridgeport: parcels on both sides of a short street")
MIDDLE, COUNT = (232900, 901900), 300
#: Tile i, by the cadastre's number, and how far it goes.
MOVED, BY_M = "90-91", (0, -12)
OPTIONS = {"reach_m": 120, "rigidity": 0.1}
REPLACEMENT = {"deformation_threshold": 0.2, "gap_threshold_m": 4.0, "max_rounds": 3}
ORANGE, BLUE, RED = "#f2a05a", "#7fb0dc", "#c0302a"


def deformation(tiles):
    """(3) of the paper, as the solver measures it: how far each map is from a similarity."""
    return numpy.hypot(tiles["xx"] - tiles["yy"], tiles["xy"] + tiles["yx"])


def moved(figure, city, name, options):
    """The tiles after tile i was moved, by their numbers."""
    script, out = figure.path(f"{name}.json"), figure.path(f"{name}.gpkg")
    operation = {"do": "move", "tiles": {"source_ids": [MOVED]}, "by": BY_M, "options": options}
    script.write_text(json.dumps({"defaults": OPTIONS, "operations": [operation]}), encoding="utf-8")
    figure.plat("reconfigure", script, "--city", city, "--out", out)
    return layer(out, "tiles").set_index("tile")


def base_city(figure):
    script, out = figure.path("nothing.json"), figure.path("city.gpkg")
    script.write_text(json.dumps({"operations": [{"do": "unpin", "tiles": {"all": True}}]}), encoding="utf-8")
    figure.plat("reconfigure", script, "--dataset", PLACE.dataset, "--near", *MIDDLE, "--count", COUNT, "--out", out)
    return out


def orthophoto(figure):
    observed = figure.dataset(PLACE.dataset)["observed"]
    town = figure.path("town.gpkg")
    near = PLACE.shape().buffer(200.0)
    for name in ("parcels", "streets"):
        mapped_layer(observed[name], near).to_file(town, layer=name, driver="GPKG")
    return Picture(rendered(figure, town, "view", PLACE.shape().bounds, "--pixel", 0.25))


def show_quantities(axes, i, k, joints):
    """Centroids, and the vectors from them to a point that both tiles have."""
    common = joints[joints.intersects(i.buffer(0.7)) & joints.intersects(k.buffer(0.7))]
    ends = [(p.x, p.y) for p in common.geometry]
    p = max(ends, key=lambda q: q[1])
    for shape, name, away in ((i, "i", (6, 6)), (k, "k", (-14, -14))):
        c = shape.centroid
        point = {"i": "ij", "k": "km"}[name]
        axes.annotate("", p, (c.x, c.y), arrowprops={"arrowstyle": "->", "color": "white", "linewidth": 1.6})
        axes.plot([c.x], [c.y], "o", color="white", markersize=5)
        axes.annotate(f"$c_{name}$", (c.x, c.y), away, textcoords="offset points", color="white", fontsize=12)
        axes.annotate(f"$d_{{{point}}}$", ((c.x + p[0]) / 2, (c.y + p[1]) / 2), (4, -10), textcoords="offset points",
                      color="white", fontsize=11)
    axes.scatter(*zip(*ends), s=26, color=RED, zorder=6)
    axes.annotate("$p_{ij} = p_{km}$", p, (8, 8), textcoords="offset points", color="white", fontsize=12, weight="bold")


def draw(figure):
    city = base_city(figure)
    before = layer(city, "tiles").set_index("tile")
    without = moved(figure, city, "without", {})
    replaced = moved(figure, city, "with", {"replacement": REPLACEMENT})
    file = figure.path("tiles.gpkg")
    figure.plat("tiles", "--dataset", PLACE.dataset, "--near", *MIDDLE, "--count", COUNT, "--out", file)
    joints, links = layer(file, "joints"), layer(file, "links")

    i = before.index[before["source"] == MOVED][0]
    bent = deformation(without)
    k = bent.idxmax()
    new = replaced.index.difference(before.index)

    picture, ((left, middle, right),) = sheet(1, 3, 15.0, 6.2)
    bounds = numpy.array(PLACE.shape().bounds)
    for axes in (left, middle, right):
        open_map(axes, bounds)
        axes.set_xlim(bounds[0], bounds[2])
        axes.set_ylim(bounds[1], bounds[3])
    orthophoto(figure).draw(left)
    fill(left, before, "none", "white", 1.0)
    lines(left, links, "#9fd0ff", 0.8)
    show_quantities(left, before.geometry[i], before.geometry[k], joints)
    letter(left, "a", "tiles over a rendered view; joints of i and k (red), links (blue)")
    for axes, tiles, key, text in ((middle, without, "b", f"i moved by {-BY_M[1]} m to the south, k deformed ({bent[k]:.2f})"),
                                   (right, replaced, "b", "k replaced" if len(new) else "k stays: nothing fits better")):
        faces = [ORANGE if t == i else BLUE if t == k or t in new else "white" for t in tiles.index]
        fill(axes, tiles, faces, INK, 0.6)
        fill(axes, before.loc[[t for t in (i, k) if t in before.index]], "none", GREY, 0.8, linestyles="dashed")
        letter(axes, key, text)
    for axes, tiles, names in ((middle, without, {i: "i", k: "k"}), (right, replaced, {i: "i", **{t: "j" for t in new}})):
        for t, name in names.items():
            c = tiles.geometry[t].representative_point()
            axes.annotate(f"${name}$", (c.x, c.y), ha="center", va="center", fontsize=12)
    caption(picture, figure)
    figure.save(picture)

    figure.measured("same_point", joints["gap_m"].max(), f"{len(joints)} joints of {COUNT} tiles")
    touches = without.geometry[k].touches(without.geometry[i])
    figure.measured("deformed", float(touches), f"k has deformation {bent[k]:.3f}, the mean is {bent.mean():.3f}")
    ratio = deformation(replaced)[new].max() / bent[k] if len(new) else float("nan")
    figure.measured("smaller", ratio, f"{len(new)} new tiles")
    figure.measured("union", len(new), ", ".join(replaced.loc[new, "source"]))


if __name__ == "__main__":
    sys.exit(make("abva08/fig03", draw))
