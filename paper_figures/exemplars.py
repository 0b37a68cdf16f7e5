"""Exemplars of observed streets: what `plat exemplar` writes, and how its levels and points are drawn."""

import collections
import math

import numpy

from drawing import lines
from figure import FigureError
from places import layer

#: Colour and line width of a street by its level; deeper levels look like the last.
LEVELS = [("#b2182b", 2.6), ("#ef8a3c", 1.7), ("#2b8cbe", 1.2), ("#7a5195", 1.0), ("#555555", 0.9)]


def level_style(level):
    return LEVELS[min(int(level), len(LEVELS) - 1)]


class Exemplar:
    """The points, pieces and chains of a data set."""

    def __init__(self, figure, dataset):
        figure.dataset(dataset)
        self.file = figure.path(f"{dataset}.gpkg")
        self.summary = figure.plat("exemplar", dataset, "--out", self.file)
        self.points, self.pieces, self.chains = (layer(self.file, key) for key in ("points", "streets", "chains"))
        self.line_of = dict(zip(self.chains["chain"], self.chains.geometry))
        self.level_of = dict(zip(self.chains["chain"], self.chains["hierarchy"]))

    def places_of_chains(self):
        """Chain -> the places of its points."""
        places = collections.defaultdict(set)
        for a, b, at in zip(self.points["a_chain"], self.points["b_chain"], self.points.geometry):
            places[a].add((at.x, at.y))
            if not math.isnan(b):
                places[int(b)].add((at.x, at.y))
        return places

    def stops(self):
        """Chain -> its points' places in the order of its line; a ring's first place comes again at its end."""
        places = self.places_of_chains()
        stops = {}
        for chain, line in self.line_of.items():
            met = [tuple(p[:2]) for p in line.coords if tuple(p[:2]) in places[chain]]
            if self.is_ring(chain) and met and met[0] != met[-1]:
                met.append(met[0])
            stops[chain] = met
        return stops

    def is_ring(self, chain):
        return bool(self.chains["is_closed"].iloc[int(chain)])


def segments_of(stops):
    """The chords between consecutive places, those of length 0 left out."""
    return [(p, q) for p, q in zip(stops, stops[1:]) if p != q]


def chord_statistics(stops, is_ring):
    """Means and variances of distances and unsigned turns, as [AVB08, Sec. 3.1.1 (iv)] has them."""
    chords = [numpy.subtract(q, p) for p, q in segments_of(stops)]
    lengths = [float(numpy.hypot(*c)) for c in chords]
    pairs = list(zip(chords, chords[1:])) + ([(chords[-1], chords[0])] if is_ring and len(chords) > 1 else [])
    turns = [abs(math.atan2(a[0] * b[1] - a[1] * b[0], float(numpy.dot(a, b)))) for a, b in pairs]
    of = lambda values: (numpy.mean(values) if values else 0.0, numpy.var(values, ddof=1) if len(values) > 1 else 0.0)  # noqa: E731
    return (*of(lengths), *of(turns))


def draw_levels(axes, frame, thickness=1.0, column="hierarchy"):
    """Lines by level, the main streets on top. `thickness` is of all widths: less for a whole city."""
    if frame.empty:
        raise FigureError("no street to draw")
    for level in sorted(set(frame[column]), reverse=True):
        colour, width = level_style(level)
        lines(axes, frame[frame[column] == level], colour, thickness * width, zorder=10 - min(level, 9), capstyle="round")


def level_handles(levels):
    from matplotlib.lines import Line2D

    shown = sorted({min(int(level), len(LEVELS) - 1) for level in levels})
    deepest = max(int(level) for level in levels)
    names = [f"$h_{level}$" + (" and deeper" if level == len(LEVELS) - 1 and deepest > level else "") for level in shown]
    return [Line2D([], [], color=LEVELS[level][0], linewidth=LEVELS[level][1], label=name) for level, name in zip(shown, names)]
