"""Designs and buildings that figures share: what `plat build` made of a design, and its pictures."""

import json
import pathlib
import re

import matplotlib.image
import matplotlib.pyplot as plt
import numpy
from rendering import Model, looking_at, read_ply, render

#: Half a quantum of length: what rounding an edge moves [Har, Sec. 6.2].
HALF_QUANTUM_M = 0.1
EXAMPLES = pathlib.Path(__file__).resolve().parents[1] / "docs" / "examples" / "buildings"


def example(name):
    """A design of docs/examples/buildings."""
    return json.loads((EXAMPLES / f"{name}.json").read_text(encoding="utf-8"))


class Built:
    """One of the best buildings of a design: its report and its mesh."""

    def __init__(self, file):
        self.report = json.loads(file.with_suffix(".json").read_text(encoding="utf-8"))
        self.model = read_ply(file)

    @property
    def parts(self):
        """Names in the order of the rows."""
        return [p["part"] for p in self.report["key_points"]] + [p for r in self.report["rows"] for p in r["parts"]]

    def length_error_m(self):
        """How far any edge of the skeleton is from what its parts add up to."""
        return max(abs(r["length_m"] - r["quantised_m"]) for r in self.report["rows"])

    def marks(self, rgb, top_m, radius=0.45, height_m=4.0):
        """A cylinder above the roof where a part begins [Har, Fig. 6.8]."""
        return [((*j["at"][:2], top_m), height_m, radius, rgb) for j in self.report["joints"]]


def build(figure, name, design, parts, k=1, method="layered"):
    """The k best buildings of a design, and the search's processor time in milliseconds."""
    file, out = figure.path(f"{name}_design.json"), figure.path(f"{name}.ply")
    file.write_text(json.dumps(design), encoding="utf-8")
    said = figure.plat("build", file, "--parts", parts, "--k", k, "--method", method, "--out", out)
    time_ms = float(re.search(rf"{method} in [0-9.]+ ms \(([0-9.]+) ms of processor", said).group(1))
    files = [out, *(out.with_name(f"{name}_{i}.ply") for i in range(2, k + 1))]
    return [Built(f) for f in files if f.exists()], time_ms


def open_edges(buildings):
    """Edges of the meshes that are not used as often one way as the other."""
    return sum(b.report["surface"]["unmatched_edges"] for b in buildings)


def skeleton_of(design):
    """(nodes, edges) of a design."""
    skeleton = design["skeleton"]
    return numpy.array(skeleton["nodes"], float), [(e["from"], e["to"]) for e in skeleton["edges"]]


def draw_skeleton(axes, design, labels=True):
    """Edges with their lengths and a tick on the side of the front."""
    nodes, edges = skeleton_of(design)
    for (a, b), edge in zip(edges, design["skeleton"]["edges"]):
        p, q = nodes[a], nodes[b]
        along = (q - p) / numpy.linalg.norm(q - p)
        right = numpy.array([along[1], -along[0]])
        front = edge["front"]
        if not isinstance(front, str):
            right = right * numpy.sign(right @ numpy.array(front))
        elif front == "left":
            right = -right
        axes.plot(*zip(p, q), color="#222222", linewidth=1.6, zorder=1)
        middle = 0.5 * (p + q)
        axes.annotate("", middle + 6.5 * right, middle, arrowprops={"arrowstyle": "-|>", "color": "#1f50c8", "linewidth": 0.8})
        if labels:
            axes.text(*(middle - 3.6 * right), f"{numpy.linalg.norm(q - p):.1f}", fontsize=6.5, ha="center", va="center")
    axes.plot(*nodes.T, "o", color="#d62728", markersize=3.4, zorder=2)
    axes.set_aspect("equal")
    axes.margins(0.14)
    axes.set_axis_off()


def show(axes, picture):
    axes.imshow(matplotlib.image.imread(picture))
    axes.set_axis_off()


def merged(models):
    """Several models as one."""
    offsets = numpy.cumsum([0] + [len(m.vertices) for m in models[:-1]])
    return Model(numpy.vstack([m.vertices for m in models]),
                 numpy.vstack([m.faces + o for m, o in zip(models, offsets)]), numpy.vstack([m.colours for m in models]))


def picture_of(figure, name, models, azimuth_deg=-55.0, elevation_deg=30.0, width=1200, height=800, room=1.05, **how):
    """A rendered picture that holds all of the models."""
    camera = looking_at(models, azimuth_deg, elevation_deg, aspect=width / height, room=room)
    return render(figure, name, models, camera, width, height, **how)


__all__ = ["Built", "HALF_QUANTUM_M", "build", "draw_skeleton", "example", "merged", "open_edges", "picture_of", "plt", "show"]
