"""Reads a run directory as docs/run_directory.md defines it, and nothing else."""

import json
import pathlib

import fiona
import geopandas
import pandas

OBSERVED = "observed"


class RunError(Exception):
    """The run directory cannot be used; the message is one line that names the file."""


TABLES = {
    "parcels": ["dataset", "layer", "repetition", "block_id", "parcel_id"],
    "blocks": ["dataset", "layer", "repetition", "block_id", "status", "message", "observed_parcels",
               "ks_area"],
    "distances": ["dataset", "layer", "measure", "distance", "value", "ci_low", "ci_high", "noise_mean", "noise_low",
                  "noise_high", "n_observed", "n_generated", "n_blocks"],
    "differences": ["dataset", "measure", "distance", "layer_a", "layer_b", "difference", "ci_low", "ci_high",
                    "p_value", "p_holm", "effect_size", "n_blocks"],
    "histograms": ["dataset", "measure", "layer", "bin_low", "bin_high", "count"],
}
SEARCH = ["dataset", "layer", "fold", "options", "is_chosen", "score", "measure", "blocks"]


class Run:
    """The manifest and the tables of a run; layouts are read data set by data set."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        if not self.folder.is_dir():
            raise RunError(f"{self.folder}: no such run directory; `plat run CONFIG --out DIR` makes one")
        self.manifest = self._read_manifest()
        for name, columns in TABLES.items():
            setattr(self, name, self._read_table(name, columns))
        #: Runs of `plat compare` have no search.
        self.search = self._read_table("search", SEARCH) if (self.folder / "search.csv").is_file() else None
        self.datasets = self.manifest["datasets"]
        self.strategies = [s["label"] for s in self.manifest["strategies"]]
        self.repetitions = max(1, int(self.manifest.get("repetitions", 1)))
        #: In the order of the distance table, which is that of measure_columns().
        self.measures = list(dict.fromkeys(self.histograms["measure"]))

    def _need(self, file):
        path = self.folder / file
        if not path.is_file():
            raise RunError(f"{path}: missing; the run is not finished, `plat run ... --resume` completes it")
        return path

    def _read_manifest(self):
        path = self._need("manifest.json")
        try:
            manifest = json.loads(path.read_text(encoding="utf-8"))
        except ValueError as error:
            raise RunError(f"{path}: not JSON ({error})") from error
        for key in ("datasets", "strategies", "seed", "commit"):
            if key not in manifest:
                raise RunError(f"{path}: has no \"{key}\"")
        return manifest

    def _read_table(self, name, columns):
        path = self._need(f"{name}.csv")
        try:
            # Labels may read as numbers ("1") or as missing ("nan"): they are text.
            text = {c: str for c in ("dataset", "layer", "layer_a", "layer_b", "message", "options", "status", "parcel_id")}
            table = pandas.read_csv(path, dtype=text, keep_default_na=False, na_values={
                c: [""] for c in pandas.read_csv(path, nrows=0).columns if c not in text})
        except (ValueError, pandas.errors.ParserError) as error:
            raise RunError(f"{path}: not a table ({str(error).splitlines()[0]})") from error
        missing = [c for c in columns if c not in table.columns]
        if missing:
            raise RunError(f"{path}: has no column {', '.join(missing)}")
        return table

    def of(self, table, dataset):
        """The rows of one data set."""
        rows = getattr(self, table)
        return rows[rows["dataset"] == dataset["name"]]

    def layout(self, dataset):
        """Layer name -> GeoDataFrame of the first repetition; layers without features are left out."""
        path = self._need(f"layout_{dataset['name']}.gpkg")
        try:
            layers = fiona.listlayers(str(path))
        except fiona.errors.FionaError as error:
            raise RunError(f"{path}: not a GeoPackage") from error
        out = {}
        for layer in ("blocks", OBSERVED, *self.strategies):
            if layer not in layers:
                if layer in ("blocks", OBSERVED):
                    raise RunError(f"{path}: has no layer \"{layer}\"")
                continue
            frame = geopandas.read_file(path, layer=layer)
            if "repetition" in frame.columns and len(frame):
                frame = frame[frame["repetition"] == frame["repetition"].min()]
            frame = frame[frame.geometry.notna()]
            if len(frame):
                out[layer] = frame.reset_index(drop=True)
        return out


def plots_word(dataset):
    """What the reference is, in every title and caption."""
    return "tessellated plots" if dataset.get("plots") == "tessellated" else "observed parcels"


def layer_word(dataset, layer):
    """A layer's name in legends: the reference is never called observed when it is not."""
    return plots_word(dataset) if layer == OBSERVED else layer


def short_title(dataset):
    """The place, for titles of figures and tables: what comes before a colon."""
    return dataset["title"].split(":")[0]
