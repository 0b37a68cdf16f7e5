"""python3 classify_errors.py RUN_DIR CITY: why edges of street_growth's first seed are missing or false, by geometry; a table per variant."""

import pathlib
import sys
from collections import Counter, defaultdict

import geopandas
from shapely.geometry import Point

#: A street of ordinary width passes no point nearer than this.
CLEARANCE_M = 6.0


def ends_of(edge):
    return tuple(edge.coords[0]), tuple(edge.coords[-1])


def degrees(edges):
    return Counter(end for edge in edges for end in ends_of(edge))


def crosses(tree, edges, edge):
    """Whether the edge crosses one of the others but at a common end."""
    return any(edges[i].crosses(edge) for i in tree.query(edge) if not set(ends_of(edges[i])) & set(ends_of(edge)))


def passes(tree, points, edge, clearance=CLEARANCE_M):
    return any(points[i].distance(edge) < clearance and points[i].coords[0] not in ends_of(edge)
               for i in tree.query(edge.buffer(clearance)))


class Errors:
    def __init__(self, file, layer):
        edges = geopandas.read_file(file, layer=layer)
        self.edges = {kind: list(edges[edges.kind == kind].geometry) for kind in ("recovered", "missing", "false")}
        self.trees = {kind: geopandas.GeoSeries(own).sindex for kind, own in self.edges.items()}
        self.known = degrees(self.edges["recovered"] + self.edges["missing"])
        self.grown = degrees(self.edges["recovered"] + self.edges["false"])
        self.at_false = degrees(self.edges["false"])
        self.points = [Point(place) for place in self.known]
        self.point_tree = geopandas.GeoSeries(self.points).sindex
        self.neighbours = defaultdict(set)
        for edge in self.edges["recovered"] + self.edges["missing"]:
            a, b = ends_of(edge)
            self.neighbours[a].add(b)
            self.neighbours[b].add(a)

    def crosses(self, kind, edge):
        return crosses(self.trees[kind], self.edges[kind], edge)

    def why_missing(self, edge):
        if self.crosses("false", edge):
            return "a false street crosses its way"
        if self.crosses("recovered", edge) or self.crosses("missing", edge):
            return "its chord crosses a true street"
        if passes(self.point_tree, self.points, edge):
            return "its chord passes close by a point"
        if any(self.at_false[end] for end in ends_of(edge)):
            return "a false street begins at one of its ends"
        return "none of these: too unlikely a step"

    def why_false(self, edge):
        a, b = ends_of(edge)
        if self.crosses("missing", edge):
            return "crosses a missing street"
        if self.neighbours[a] & self.neighbours[b]:
            return "short cut past one point"
        if any(self.grown[end] > self.known[end] for end in (a, b)):
            return "goes on where a street ends"
        return "another street's point"

    def table(self):
        for kind, why in (("missing", self.why_missing), ("false", self.why_false)):
            counts = Counter(why(edge) for edge in self.edges[kind])
            for cause, count in counts.most_common():
                yield kind, cause, count, count / len(self.edges[kind])


def main(run, city, variants):
    for variant in variants or ["random_walk", "the paper's word"]:
        for kind, cause, count, share in Errors(run / f"edges_{city}.gpkg", variant).table():
            print(f"| {variant} | {kind} | {cause} | {count} | {share:.0%} |")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]), sys.argv[2], sys.argv[3:])
