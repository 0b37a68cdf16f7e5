"""Cities before and after plat reconfigure: tiles with their placements, and what is between them."""

import itertools
import json

import geopandas
import numpy
from shapely.geometry import Polygon


class Tiles:
    """The tile layers of one output."""

    def __init__(self, path):
        tiles = geopandas.read_file(path, layer="tiles")
        self.frame = tiles.set_index("tile")
        self.corners = {t: json.loads(c) for t, c in self.frame["corners"].items()}
        self.placements = {t: numpy.array([[r.xx, r.xy, r.shift_x], [r.yx, r.yy, r.shift_y]])
                           for t, r in zip(self.frame.index, self.frame.itertuples())}
        joints = geopandas.read_file(path, layer="tile_vertices")
        self.joints = set(joints.loc[joints["joint"] == 1, "vertex"])
        links = geopandas.read_file(path, layer="tile_links")
        self.links = links
        self.origin = self._origin(joints.set_index("vertex"))

    def _origin(self, vertices):
        """Of the local frame that placements are of, whole metres in the CRS."""
        ways = []
        for tile, rings in itertools.islice(self.corners.items(), 200):
            vertex, x, y = rings[0][0]
            point = vertices.geometry[vertex]
            ways.append(numpy.array([point.x, point.y]) - self.placements[tile] @ [x, y, 1.0])
        return numpy.round(numpy.median(ways, axis=0))

    def placed(self, placements):
        """The tiles where placements have them, gaps not closed."""
        shapes = {}
        for tile, rings in self.corners.items():
            ring = numpy.array([[x, y, 1.0] for _, x, y in rings[0]]) @ placements[tile].T + self.origin
            shapes[tile] = Polygon(ring)
        out = self.frame.copy()
        out["geometry"] = [shapes[t] for t in out.index]
        return out

    def gaps_m(self, placements, of):
        """Per joint of the tiles `of` with any other: the distance of where the two have it."""
        at = {}
        for tile, rings in self.corners.items():
            for vertex, x, y in itertools.chain(*rings):
                if vertex in self.joints:
                    at.setdefault(vertex, []).append((tile, placements[tile] @ [x, y, 1.0]))
        return numpy.array([numpy.hypot(*(p - q)) for tiles in at.values()
                            for (a, p), (b, q) in itertools.combinations(tiles, 2) if a != b and (a in of) != (b in of)])

    def neighbours(self, tile):
        """Tiles with an edge in common, and tiles across streets."""
        vertices = {c[0] for ring in self.corners[tile] for c in ring}
        beside = {t for t, rings in self.corners.items() if t != tile
                  and len(vertices & {c[0] for ring in rings for c in ring}) >= 2}
        across = set(self.links.loc[self.links["tile_a"] == tile, "tile_b"])
        across |= set(self.links.loc[self.links["tile_b"] == tile, "tile_a"])
        return beside | across

    def parts(self):
        """How many parts of the city no link and no common vertex connects."""
        root = {}

        def find(key):
            while root.setdefault(key, key) != key:
                key = root[key]
            return key

        for tile, rings in self.corners.items():
            for ring in rings:
                for corner in ring:
                    root[find(("vertex", corner[0]))] = find(tile)
        for a, b in zip(self.links["tile_a"], self.links["tile_b"]):
            root[find(int(a))] = find(int(b))
        return len({find(t) for t in self.corners})


class Session:
    """A city of a data set on which scripts of operations are run, each beginning with the observed city."""

    def __init__(self, figure, dataset, near, count, defaults):
        figure.dataset(dataset)
        self.figure, self.defaults = figure, defaults
        self.city = ("--dataset", dataset, "--near", *near, "--count", count)

    def run(self, name, operations):
        """@returns the tiles afterwards, and what plat says of each operation."""
        script = self.figure.path(f"{name}.json")
        script.write_text(json.dumps({"defaults": self.defaults, "operations": operations}, indent=1), encoding="utf-8")
        said = self.figure.plat("reconfigure", script, *self.city, "--out", self.figure.path(f"{name}.gpkg"))
        return Tiles(self.figure.path(f"{name}.gpkg")), [row for row in said.splitlines() if row.startswith("operation ")]

    def observed(self):
        """Nothing is pinned, so nothing moves."""
        return self.run("observed", [{"do": "relax"}])[0]


def done(rows, operation):
    """How many operations of a kind were not refused."""
    return sum(f" {operation}:" in row and "refused" not in row for row in rows)


def gone_and_new(before, after):
    """Ids of tiles that vanished and of those that appeared, ascending."""
    old, new = set(before.corners), set(after.corners)
    return sorted(old - new), sorted(new - old)
