"""Layouts by example: what `plat synthesize` makes of a script, and simple measures of street networks."""

import collections
import json
import math

import numpy

from places import layer

#: How far apart ends of streets that meet may be written, metres.
SAME_PLACE_M = 0.01
ORIENTATION_BINS = 36


def window_region(window):
    return {"window": [window.west, window.south, window.east, window.north]}


def example(name, window):
    return {"name": name, "data": window.dataset, "region": window_region(window)}


def synthesized(figure, name, script, seed=1):
    """The layers of a layout: points, streets, blocks, parcels."""
    path, out = figure.path(f"{name}.json"), figure.path(f"{name}_{seed}.gpkg")
    path.write_text(json.dumps(script, indent=1) + "\n", encoding="utf-8")
    figure.plat("synthesize", path, "--seed", seed, "--out", out)
    return {key: layer(out, key) for key in ("points", "streets", "blocks", "parcels")}


def grown(streets):
    return streets[~streets["is_existing"].astype(bool)]


def existing(streets):
    return streets[streets["is_existing"].astype(bool)]


class Network:
    """Streets as edges between places where streets end or three or more meet."""

    def __init__(self, frame):
        numbers, pieces = {}, []
        for line in frame.geometry:
            ends = [self._number(numbers, line.coords[i]) for i in (0, -1)]
            pieces.append((*ends, numpy.asarray(line.coords)[:, :2]))
        around = collections.defaultdict(list)
        for i, (a, b, _) in enumerate(pieces):
            around[a].append(i)
            around[b].append(i)
        self.places = {number: place for place, number in numbers.items()}
        self._pieces, self._around = pieces, around
        self.edges = list(self._merged())

    @staticmethod
    def _number(numbers, place):
        key = (round(place[0] / SAME_PLACE_M), round(place[1] / SAME_PLACE_M))
        return numbers.setdefault(key, len(numbers))

    def _merged(self):
        """(from, to, coordinates) of each edge; rings without a crossing are left out."""
        done = set()
        for start, pieces in self._around.items():
            if len(pieces) == 2:
                continue
            for piece in pieces:
                if piece in done:
                    continue
                node, line = start, [numpy.empty((0, 2))]
                while True:
                    done.add(piece)
                    a, b, coordinates = self._pieces[piece]
                    line.append(coordinates if a == node else coordinates[::-1])
                    node = b if a == node else a
                    onward = [p for p in self._around[node] if p not in done]
                    if len(self._around[node]) != 2 or not onward:
                        break
                    (piece,) = onward
                yield start, node, numpy.concatenate(line)

    def lengths(self):
        return numpy.array([numpy.hypot(*numpy.diff(line, axis=0).T).sum() for _, _, line in self.edges])

    def chords(self):
        return numpy.array([numpy.hypot(*(line[-1] - line[0])) for _, _, line in self.edges])

    def middles(self):
        return numpy.array([(line[0] + line[-1]) / 2 for _, _, line in self.edges])

    def part(self, keep):
        """The same places with some of the edges; `keep` is one truth value per edge."""
        out = Network.__new__(Network)
        out.places = self.places
        out.edges = [edge for edge, kept in zip(self.edges, keep) if kept]
        return out

    def circuity(self):
        """Length of all edges over that of their chords; rings are left out."""
        chords = self.chords()
        return self.lengths()[chords > 0].sum() / chords.sum()

    def length_variation(self):
        """Variance over squared mean of the edge lengths."""
        lengths = self.lengths()
        return lengths.var(ddof=1) / lengths.mean() ** 2

    def orientation_entropy(self):
        """Of the edges' directions, both ways, in 36 bins about the compass points; nats."""
        chord = numpy.array([line[-1] - line[0] for _, _, line in self.edges])
        bearing = numpy.degrees(numpy.arctan2(chord[:, 0], chord[:, 1]))
        both = numpy.concatenate([bearing, bearing + 180.0])[numpy.tile(numpy.hypot(*chord.T) > 0, 2)]
        width = 360.0 / ORIENTATION_BINS
        counts = numpy.bincount(((both + width / 2) % 360.0 // width).astype(int), minlength=ORIENTATION_BINS)
        share = counts[counts > 0] / counts.sum()
        return float(-(share * numpy.log(share)).sum())

    def angles_deg(self):
        """Between neighbouring ends at places of three ends or more."""
        ends = collections.defaultdict(list)
        for a, b, line in self.edges:
            for node, first, second in ((a, line[0], line[1]), (b, line[-1], line[-2])):
                ends[node].append(math.degrees(math.atan2(*(second - first)[::-1])) % 360.0)
        out = []
        for directions in ends.values():
            if len(directions) < 3:
                continue
            directions.sort()
            out += [(q - p) % 360.0 for p, q in zip(directions, [*directions[1:], directions[0] + 360.0])]
        return numpy.array(out)

    def components(self):
        """Number of the connected part of each edge."""
        parent = {}

        def root(node):
            while parent.setdefault(node, node) != node:
                parent[node] = parent[parent[node]]
                node = parent[node]
            return node

        for a, b, _ in self.edges:
            parent[root(a)] = root(b)
        return [root(a) for a, _, _ in self.edges]

    def connected_share(self):
        """Share of the length in the largest connected part."""
        of = collections.Counter()
        for component, length in zip(self.components(), self.lengths()):
            of[component] += length
        return max(of.values()) / sum(of.values())


def ks_distance(a, b):
    values = numpy.sort(numpy.concatenate([a, b]))
    share = lambda sample: numpy.searchsorted(numpy.sort(sample), values, side="right") / len(sample)  # noqa: E731
    return float(numpy.abs(share(a) - share(b)).max())


def ends_of(frame):
    """Places of the ends of lines, rounded so that ends that meet are equal, each with how often it occurs."""
    return collections.Counter((round(p[0], 2), round(p[1], 2)) for line in frame.geometry
                               for p in (line.coords[0], line.coords[-1]))


#: What a point's streets know, as a person would compare it: key, name, value of a street's columns.
ATTRIBUTES = [("distance_mean_m", lambda v: v), ("distance_variance_m2", lambda v: v), ("angle_mean_rad", lambda v: v),
              ("angle_variance_rad2", lambda v: v), ("tortuosity", lambda v: v - 1.0)]


def attribute_means(points):
    """Mean over all streets of the points, in the order of ATTRIBUTES."""
    means = []
    for key, of in ATTRIBUTES:
        values = numpy.concatenate([points[f"a_{key}"].to_numpy(float), points[f"b_{key}"].to_numpy(float)])
        means.append(float(of(values[~numpy.isnan(values)].mean())))
    return numpy.array(means)


def differing(first, second):
    """Which attributes differ by a tenth or more of the larger."""
    larger = numpy.maximum(numpy.abs(first), numpy.abs(second))
    return numpy.abs(first - second) >= 0.1 * numpy.maximum(larger, 1e-12)
