"""plat measures against networkx and osmnx: the same graphs, the same numbers (docs/measures.md says where not)."""

import json
import math
import os
import pathlib
import unittest
from collections import Counter

from plat_cli import DONE, CliTest, catalogue_has, plat, read_layer, rectangle, write_layer

try:
    import networkx as nx
    import numpy as np
    import osmnx
    import shapely
    from shapely.ops import polygonize, unary_union
    MISSING = None
except ImportError as error:
    MISSING = f"needs python3-networkx, python3-osmnx and python3-shapely: {error}"

DATA = pathlib.Path(os.environ.get("PLAT_DATA_DIR", "/nowhere"))
CLOSE = 1e-9  # relative; what the order of sums may change

# A grid of 3 x 3 with a dead end, a bend, two ways between the same nodes, a loop at a dead end's end, and apart from
# them a straight street of two features.
SMALL = [
    [(0, 0), (100, 0), (200, 0)], [(0, 90), (100, 90), (200, 90)], [(0, 200), (100, 200), (200, 200)],
    [(0, 0), (0, 90), (0, 200)], [(100, 0), (100, 90), (100, 200)], [(200, 0), (200, 90), (200, 200)],
    [(200, 90), (240, 100), (260, 130)],
    [(100, 200), (120, 230), (180, 230), (200, 200)],
    [(0, 0), (-50, 0)], [(-50, 0), (-80, 30), (-110, 0), (-80, -30), (-50, 0)],
    [(400, 400), (450, 425)], [(450, 425), (500, 450)],
]


def lines_of(path):
    """The cleaned lines of a file that plat blocks wrote."""
    rows = read_layer(path, "streets")
    return [[(x, y) for x, y, *_ in geometry["coordinates"]] for _, geometry in rows]


def segment_graph(lines):
    """Every vertex of every line a node, every segment an edge in both directions: what osmnx simplifies."""
    graph = nx.MultiDiGraph(crs="EPSG:32633")
    for line in lines:
        for a, b in zip(line, line[1:]):
            for place in (a, b):
                graph.add_node(place, x=place[0], y=place[1])
            length = math.dist(a, b)
            graph.add_edge(a, b, osmid=0, length=length)
            graph.add_edge(b, a, osmid=0, length=length)
    return graph


def simple_graph(graph):
    """The shortest of parallel edges, no loops: what shortest ways are found on."""
    out = nx.Graph()
    out.add_nodes_from(graph.nodes)
    for u, v, edge in graph.edges(data=True):
        if u != v and (not out.has_edge(u, v) or edge["length"] < out.edges[u, v]["length"]):
            out.add_edge(u, v, length=edge["length"])
    return out


def entropy_by_length(graph):
    """osmnx repeats a bearing int(length) times; here it counts by its length itself."""
    bins = np.zeros(36)
    for u, v, edge in graph.edges(data=True):
        if u != v:
            for bearing in (edge["bearing"], (edge["bearing"] - 180) % 360):
                bins[(int(bearing // 5) + 1) // 2 % 36] += edge["length"]
    share = bins[bins > 0] / bins.sum()
    return -float(np.sum(share * np.log(share)))


@unittest.skipIf(MISSING, MISSING)
class Measures(CliTest):
    def measured(self, streets, *more):
        """The report of plat measures and the graph that osmnx makes of the same lines."""
        blocks = self.path("blocks.gpkg")
        plat("blocks", "--streets", streets, "--all-classes", "--out", blocks)
        lines = lines_of(blocks)
        out = self.path("measures.json")
        self.assert_status(plat("measures", f"{blocks}:streets", "--out", out, *more), DONE)
        directed = osmnx.simplification.simplify_graph(segment_graph(lines))
        directed.graph["crs"] = "EPSG:32633"
        nx.set_node_attributes(directed, osmnx.stats.count_streets_per_node(directed), "street_count")
        graph = osmnx.utils_graph.get_undirected(directed)
        for u, v, edge in graph.edges(data=True):
            edge["bearing"] = math.degrees(math.atan2(v[0] - u[0], v[1] - u[1])) % 360
        return json.loads(out.read_text()), directed, graph, lines

    def assert_close(self, ours, theirs, what):
        self.assertLessEqual(abs(ours - theirs), CLOSE * max(1.0, abs(theirs)), f"{what}: {ours} and {theirs}")

    def assert_same_graph(self, report, graph):
        places = [(node["x"], node["y"]) for node in report["nodes"]]
        self.assertEqual(sorted(places), sorted(graph.nodes))
        ours = sorted((*sorted((places[e["from"]], places[e["to"]])), e["length_m"]) for e in report["edges"])
        theirs = sorted((*sorted((u, v)), e["length"]) for u, v, e in graph.edges(data=True))
        self.assertEqual(len(ours), len(theirs))
        for a, b in zip(ours, theirs):
            self.assertEqual(a[:2], b[:2])
            self.assert_close(a[2], b[2], "length of an edge")
        return places

    def assert_same_scalars(self, report, directed, graph):
        scalars = report["scalars"]
        stats = osmnx.stats.basic_stats(directed, area=scalars["land_area_km2"] * 1e6)
        counts = stats["streets_per_node_counts"]
        self.assertEqual(dict(Counter(node["degree"] for node in report["nodes"])),
                         {k: n for k, n in counts.items() if n})
        for ours, theirs in (("nodes", stats["n"]), ("edges", stats["street_segment_count"]),
                             ("length_m", stats["street_length_total"]), ("mean_edge_length_m", stats["street_length_avg"]),
                             ("mean_degree", stats["streets_per_node_avg"]), ("circuity", stats["circuity_avg"]),
                             ("dead_end_share_01", stats["streets_per_node_proportions"].get(1, 0.0)),
                             ("edges_per_km2", stats["street_segment_count"] / scalars["land_area_km2"]),
                             ("length_km_per_km2", stats["street_density_km"] / 1000.0)):
            self.assert_close(scalars[ours], theirs, ours)
        intersections = osmnx.stats.intersection_count(directed, min_streets=3)
        self.assert_close(scalars["intersections_per_km2"], intersections / scalars["land_area_km2"], "intersections")
        graph.graph["crs"] = "EPSG:4326"  # osmnx refuses bearings of a projected graph; these are ours
        entropy = osmnx.bearing.orientation_entropy(graph)
        self.assert_close(scalars["orientation_entropy_nats"], entropy, "entropy")
        self.assert_close(scalars["orientation_entropy_length_nats"], entropy_by_length(graph), "entropy by length")

    def assert_same_routes(self, report, graph, places):
        shortest = simple_graph(graph)
        for route in report["routes"][:300]:
            a, b = places[route["from"]], places[route["to"]]
            self.assert_close(route["network_m"], nx.dijkstra_path_length(shortest, a, b, weight="length"), "route")
            self.assert_close(route["straight_m"], math.dist(a, b), "straight")
        n, k = len(places), len(report["sources"])
        if k == n:
            theirs = nx.betweenness_centrality(shortest, weight="length")
        else:  # networkx draws its own pivots: the same sums over ours
            inner = nx.algorithms.centrality.betweenness
            theirs = dict.fromkeys(shortest, 0.0)
            for source in report["sources"]:
                ways = inner._single_source_dijkstra_path_basic(shortest, places[source], "length")
                theirs, _ = inner._accumulate_basic(theirs, *ways[:3], places[source])
            theirs = inner._rescale(theirs, n, True, k=k)
        for place, node in zip(places, report["nodes"]):
            self.assert_close(node["betweenness"], theirs[place], f"betweenness of {place}")

    def assert_same_faces(self, report, lines):
        faces = list(polygonize(unary_union([shapely.geometry.LineString(line) for line in lines])))
        self.assertEqual(len(report["faces"]), len(faces))
        # Dead ends touch the outer ring of shapely's faces in no way; both are sorted by area.
        for ours, theirs in zip(sorted(report["faces"], key=lambda f: f["area_m2"]), sorted(faces, key=lambda f: f.area)):
            self.assert_close(ours["area_m2"], theirs.area, "area")
            box = theirs.minimum_rotated_rectangle
            self.assert_close(ours["rectangularity"], theirs.area / box.area, "rectangularity")
            self.assert_close(ours["perimeter_m"], theirs.length, "perimeter")
        total = sum(face.area for face in faces) / 1e6
        self.assert_close(report["scalars"]["land_area_km2"], total, "land")

    def check(self, streets, *more):
        report, directed, graph, lines = self.measured(streets, *more)
        places = self.assert_same_graph(report, graph)
        self.assert_same_scalars(report, directed, graph)
        self.assert_same_routes(report, graph, places)
        self.assert_same_faces(report, lines)
        return report

    def test_a_small_network_is_measured_as_networkx_and_osmnx_do(self):
        streets = write_layer(self.path("city.gpkg"), "streets", SMALL, kind="LineString")
        report = self.check(streets)
        self.assertEqual(len(report["sources"]), len(report["nodes"]))
        self.assertGreater(report["scalars"]["unreachable_01"], 0.0)

    def test_densities_are_per_the_land_given(self):
        streets = write_layer(self.path("city.gpkg"), "streets", SMALL, kind="LineString")
        land = write_layer(self.path("land.gpkg"), "land", [[rectangle(0, 0, 500, 400)]])
        out = self.path("m.json")
        self.assert_status(plat("measures", streets, "--land", land, "--out", out), DONE)
        scalars = json.loads(out.read_text())["scalars"]
        self.assertAlmostEqual(scalars["land_area_km2"], 0.2, 9)
        self.assertAlmostEqual(scalars["edges_per_km2"], scalars["edges"] / 0.2, 6)

    def test_the_same_seed_gives_the_same_bytes(self):
        streets = write_layer(self.path("city.gpkg"), "streets", SMALL, kind="LineString")
        texts = []
        for seed in (1, 1, 2):
            self.assert_status(plat("measures", streets, "--sources", 3, "--seed", seed, "--out", self.path("m.json")), DONE)
            texts.append(self.path("m.json").read_bytes())
        self.assertEqual(texts[0], texts[1])
        self.assertNotEqual(texts[0], texts[2])

    def test_bad_input_is_refused(self):
        streets = write_layer(self.path("city.gpkg"), "streets", SMALL, kind="LineString")
        self.assert_refused(plat("measures", streets, "--out", self.path("m.csv")), "m.csv", ".json")
        self.assert_refused(plat("measures", self.path("none.gpkg"), "--out", self.path("m.json")), "none.gpkg")

    @unittest.skipUnless(catalogue_has("cambridge_ma"), "needs cambridge_ma in PLAT_DATA_DIR (plat data list)")
    def test_cambridge(self):
        report = self.check(f"{DATA}/cambridge_ma/cambridge_ma.gpkg:streets", "--sources", 40)
        self.assertGreater(report["scalars"]["nodes"], 1500)

    @unittest.skipUnless(catalogue_has("montevideo_uy"), "needs montevideo_uy in PLAT_DATA_DIR (plat data list)")
    def test_a_window_of_montevideo(self):
        import geopandas

        roads = geopandas.read_file(f"{DATA}/montevideo_uy/montevideo_osm.gpkg", layer="roads")
        x, y = roads.union_all().centroid.coords[0] if hasattr(roads, "union_all") else roads.unary_union.centroid.coords[0]
        window = shapely.geometry.box(x - 1200, y - 1200, x + 1200, y + 1200)
        inside = roads[roads.geometry.within(window)]
        inside[["name", "highway", "geometry"]].to_file(self.path("window.gpkg"), layer="roads", driver="GPKG")
        report = self.check(self.path("window.gpkg"), "--sources", 100000)
        self.assertGreater(report["scalars"]["nodes"], 200)


if __name__ == "__main__":
    unittest.main()
