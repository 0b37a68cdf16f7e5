"""Writes a small made-up run directory (docs/run_directory.md), so that the report can be tested without a run."""

import json
import math
import pathlib
import random

import geopandas
import numpy
import pandas
from shapely.geometry import Polygon, box

MEASURES = ["area_m2", "perimeter_m", "width_m", "aspect_ratio", "neighbours", "frontage_m", "has_street_access",
            "compactness", "rectangularity", "corners"]
COMPARED = [m for m in MEASURES if m != "has_street_access"]
CRS = "EPSG:32633"
#: How far each made-up strategy strays from the observed split; 0 repeats it.
SPREAD = {"observed": 0.30, "obb": 0.10, "skeleton": 0.25, "voronoi": 0.55}


def _lots(block, rng, spread):
    """Two rows of lots with uneven cuts."""
    west, south, east, north = block.bounds
    middle = south + (north - south) * rng.uniform(0.5 - 0.3 * spread, 0.5 + 0.3 * spread)
    lots = []
    for low, high in ((south, middle), (middle, north)):
        count = max(1, round((east - west) / 14.0 * rng.uniform(1 - spread / 2, 1 + spread / 2)))
        cuts = [west + (east - west) * (i + (0 if i in (0, count) else spread * rng.uniform(-0.5, 0.5))) / count
                for i in range(count + 1)]
        for a, b in zip(cuts, cuts[1:]):
            lean = 2.0 * spread * rng.uniform(-1, 1) if low == middle else 0.0
            lots.append(Polygon([(a, low), (b, low), (b, high), (a + max(0.0, lean), high), (a, high - 0.1)]))
    return lots


def _measure(lot, block, lots):
    rectangle = lot.minimum_rotated_rectangle.exterior.coords
    sides = sorted(math.dist(rectangle[i], rectangle[i + 1]) for i in range(2))
    frontage = lot.boundary.intersection(block.boundary.buffer(0.2)).length
    return {
        "area_m2": lot.area, "perimeter_m": lot.length, "width_m": sides[0], "aspect_ratio": sides[1] / sides[0],
        "neighbours": sum(1 for other in lots if other is not lot and
                          lot.boundary.intersection(other.buffer(0.05)).length > 0.5),
        "frontage_m": frontage, "has_street_access": int(frontage >= 1.0),
        "compactness": 4 * math.pi * lot.area / lot.length ** 2,
        "rectangularity": lot.area / (sides[0] * sides[1]), "corners": len(lot.exterior.coords) - 1}


def _ks(a, b):
    values = numpy.sort(numpy.concatenate([a, b]))
    cdf = [numpy.searchsorted(numpy.sort(s), values, side="right") / len(s) for s in (a, b)]
    return float(numpy.abs(cdf[0] - cdf[1]).max())


def _wasserstein(a, b):
    levels = (numpy.arange(500) + 0.5) / 500
    return float(numpy.abs(numpy.quantile(a, levels) - numpy.quantile(b, levels)).mean())


def _jensen_shannon(a, b, edges):
    p, q = (numpy.histogram(s, [-numpy.inf, *edges, numpy.inf])[0] / len(s) for s in (a, b))
    m = (p + q) / 2
    with numpy.errstate(divide="ignore", invalid="ignore"):
        parts = numpy.nansum(p * numpy.log2(p / m)) + numpy.nansum(q * numpy.log2(q / m))
    return float(math.sqrt(max(0.0, parts / 2)))


def write_fake_run(folder, columns=6, rows=6, strategies=("obb", "skeleton", "voronoi"), plots="observed",
                   empty=None, name="madeup", seed=1):
    """`empty` names a strategy that fails in every block."""
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    rng = random.Random(seed)
    blocks = []
    for r in range(rows):
        for c in range(columns):
            blocks.append(box(c * 130, r * 70, c * 130 + rng.uniform(70, 115), r * 70 + rng.uniform(42, 58)))

    parcels, block_rows, failures, shapes = [], [], [], {}
    for layer in ("observed", *strategies):
        for b, block in enumerate(blocks):
            is_failed = layer == empty or (layer == "voronoi" and b == 3)
            lots = [] if is_failed else _lots(block, rng, SPREAD.get(layer, 0.4))
            for p, lot in enumerate(lots):
                row = {"dataset": name, "layer": layer, "repetition": 0, "block_id": b, "parcel_id": p}
                parcels.append(row | _measure(lot, block, lots))
                shapes.setdefault(layer, []).append(lot)
            status = "not_covered" if is_failed else "ok"
            message = "made-up failure: 1.5 m2 left" if is_failed else ""
            if is_failed:
                failures.append({"block_id": b, "strategy": layer, "repetition": 0, "code": status,
                                 "message": message, "geometry": block})
            areas = [lot.area for lot in lots]
            block_rows.append({
                "dataset": name, "layer": layer, "repetition": 0, "block_id": b, "status": status,
                "message": message, "block_area_m2": block.area, "parcels": len(lots), "observed_parcels": 0,
                "area_mean_m2": numpy.mean(areas) if areas else None,
                "area_deviation_m2": numpy.std(areas) if areas else None, "width_mean_m": None,
                "width_deviation_m": None, "ks_area": None, "options": "omega=0.2", "seed": 17})
    table = pandas.DataFrame(parcels)
    of = {key: group for key, group in table.groupby(["layer", "block_id"])}
    for row in block_rows:
        observed = of[("observed", row["block_id"])]
        row["observed_parcels"] = len(observed)
        own = of.get((row["layer"], row["block_id"]))
        if own is not None and row["layer"] != "observed":
            row["ks_area"] = _ks(own.area_m2.values, observed.area_m2.values)

    distances, differences, histograms = [], [], []
    for measure in COMPARED:
        observed = table[table.layer == "observed"][measure].values
        edges = numpy.linspace(*numpy.quantile(observed, [0.01, 0.99]) + [-0.5, 0.5], 21)
        for layer in ("observed", *strategies):
            values = table[table.layer == layer][measure].values
            open_edges = [-numpy.inf, *edges, numpy.inf]
            counts = numpy.histogram(values, open_edges)[0]
            histograms += [{"dataset": name, "measure": measure, "layer": layer, "bin_low": open_edges[i],
                            "bin_high": open_edges[i + 1], "count": int(n)} for i, n in enumerate(counts)]
            if layer == "observed":
                continue
            found = {} if len(values) == 0 else {
                "ks": _ks(observed, values), "wasserstein": _wasserstein(observed, values),
                "jensen_shannon": _jensen_shannon(observed, values, edges)}
            for distance in ("ks", "wasserstein", "jensen_shannon"):
                value = found.get(distance)
                floor = 0.05 if distance != "wasserstein" else 0.05 * float(numpy.std(observed))
                distances.append({
                    "dataset": name, "layer": layer, "measure": measure, "distance": distance, "value": value,
                    "ci_low": None if value is None else max(0.0, 0.8 * value), "noise_mean": floor,
                    "ci_high": None if value is None else 1.2 * value, "noise_low": 0.5 * floor,
                    "noise_high": 1.8 * floor, "n_observed": len(observed), "n_generated": len(values),
                    "n_blocks": len(blocks) if len(values) else 0})
    value_of = {(d["layer"], d["measure"], d["distance"]): d["value"] for d in distances}
    for measure in COMPARED:
        for i, a in enumerate(strategies):
            for b in strategies[i + 1:]:
                for distance in ("ks", "wasserstein", "jensen_shannon"):
                    va, vb = value_of[(a, measure, distance)], value_of[(b, measure, distance)]
                    if va is None or vb is None:
                        continue
                    p = 0.001 if abs(va - vb) > 0.1 * max(va, vb, 1e-9) else 0.4
                    differences.append({
                        "dataset": name, "measure": measure, "distance": distance, "layer_a": a, "layer_b": b,
                        "difference": va - vb, "ci_low": va - vb - 0.02, "ci_high": va - vb + 0.02, "p_value": p,
                        "p_holm": min(1.0, 27 * p), "effect_size": max(-1.0, min(1.0, 3 * (va - vb))),
                        "n_blocks": len(blocks)})

    table.to_csv(folder / "parcels.csv", index=False)
    pandas.DataFrame(block_rows).to_csv(folder / "blocks.csv", index=False)
    pandas.DataFrame(distances).to_csv(folder / "distances.csv", index=False)
    columns_of_differences = ["dataset", "measure", "distance", "layer_a", "layer_b", "difference", "ci_low",
                              "ci_high", "p_value", "p_holm", "effect_size", "n_blocks"]
    pandas.DataFrame(differences, columns=columns_of_differences).to_csv(folder / "differences.csv", index=False)
    pandas.DataFrame(histograms).to_csv(folder / "histograms.csv", index=False)
    (folder / "summary.json").write_text("{}\n")
    (folder / "manifest.json").write_text(json.dumps({
        "plat_version": "0.1.0", "commit": "0123456789abcdef", "dirty": False, "compiler": "g++ 12.2.0",
        "compiler_flags": "-O2", "libraries": {"gdal": "3.6.2", "cgal": "5.5.1"}, "config": {}, "seed": seed,
        "repetitions": 1, "experiment": "parcels_vs_observed",
        "datasets": [{"name": name, "title": "A made-up town", "licence": "CC0", "attribution": "nobody & co",
                      "plots": plots, "crs": CRS, "blocks": len(blocks),
                      "parcels": int((table.layer == "observed").sum())}],
        "strategies": [{"label": s, "name": s, "options": {"omega": 0.2}} for s in strategies]}, indent=2))
    _write_layout(folder / f"layout_{name}.gpkg", blocks, table, shapes, failures)


def _write_layout(path, blocks, table, shapes, failures):
    path.unlink(missing_ok=True)
    geopandas.GeoDataFrame({"block_id": range(len(blocks))}, geometry=blocks, crs=CRS).to_file(
        path, layer="blocks", driver="GPKG")
    for layer, polygons in shapes.items():
        rows = table[table.layer == layer].drop(columns=["dataset", "layer"]).assign(strategy=layer)
        geopandas.GeoDataFrame(rows.reset_index(drop=True), geometry=polygons, crs=CRS).to_file(
            path, layer=layer, driver="GPKG")
    if failures:
        geopandas.GeoDataFrame(failures, geometry="geometry", crs=CRS).to_file(path, layer="failures", driver="GPKG")


if __name__ == "__main__":
    import sys
    write_fake_run(sys.argv[1], *(int(n) for n in sys.argv[2:4]))
