"""Colours, names of measures and how figures are saved."""

import io
import os

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.colors import BoundaryNorm, LinearSegmentedColormap, LogNorm, Normalize  # noqa: E402

#: The paper's colours. Red and blue are told apart by most colour-blind readers; red to green (aspect ratio) is not,
#: which is why the report's other maps use viridis.
OBSERVED_RED = "#d62728"
GENERATED_BLUE = "#1f50c8"
RED_TO_GREEN = LinearSegmentedColormap.from_list("aspect", ["#d7191c", "#f98e52", "#fee391", "#a6d96a", "#1a9641"])
#: One colour, dash and marker per strategy where several meet in one picture (Okabe and Ito's palette, safe for most
#: readers, then brown and olive for the seventh and eighth).
LAYER_COLOURS = ["#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#000000", "#7b4a12", "#8a8f00"]
LAYER_DASHES = ["-", "--", "-.", ":", (0, (5, 1, 1, 1, 1, 1)), (0, (1, 1)), (0, (8, 2)), (0, (3, 1, 1, 1))]
LAYER_MARKERS = "osD^v<>P"
#: Entries of a legend in a row below the panels.
LEGEND_COLUMNS = 5

TITLES = {
    "area_m2": "area [m²]", "perimeter_m": "perimeter [m]", "width_m": "minimum width [m]",
    "aspect_ratio": "aspect ratio", "neighbours": "number of neighbours", "frontage_m": "street frontage [m]",
    "has_street_access": "street access", "compactness": "compactness", "rectangularity": "rectangularity",
    "corners": "number of corners"}
DISTANCES = {"ks": "Kolmogorov-Smirnov", "wasserstein": "Wasserstein-1", "jensen_shannon": "Jensen-Shannon"}

plt.rcParams.update({
    "font.size": 9, "axes.titlesize": 10, "figure.titlesize": 11, "axes.spines.top": False,
    "axes.spines.right": False, "figure.facecolor": "white", "pdf.fonttype": 42, "legend.frameon": False,
    "font.family": "DejaVu Sans"})

SCREEN_DPI = 110
RASTER_DPI = 200


def title_of(measure):
    return TITLES.get(measure, measure.replace("_", " "))


def name_of(measure):
    """Without the unit."""
    return title_of(measure).split(" [")[0]


def unit_of(measure):
    title = title_of(measure)
    return title[title.index("[") + 1:-1] if "[" in title else ""


class Colouring:
    """How a map shows a measure: the same for every panel, set by the observed layer."""

    def __init__(self, measure, observed):
        self.measure = measure
        values = observed[measure]
        if measure == "aspect_ratio":
            top = max(2.0, float(values.quantile(0.95)))
            self.cmap, self.norm, self.extend = RED_TO_GREEN, Normalize(1.0, top), "max"
        elif measure == "neighbours":
            top = max(2, int(values.quantile(0.99)))
            bounds = [n - 0.5 for n in range(0, min(top, 10) + 2)]
            self.cmap, self.norm, self.extend = plt.get_cmap("viridis"), BoundaryNorm(bounds, 256, extend="max"), "max"
        else:
            low, high = (max(1e-3, float(q)) for q in values.quantile([0.02, 0.98]))
            self.cmap, self.norm, self.extend = plt.get_cmap("viridis"), LogNorm(low, max(high, 1.01 * low)), "both"


def add_bottom_legend(figure, handles):
    """Below the panels. Debian's matplotlib 3.6 has no legend outside of a constrained layout: make room for it."""
    if not handles:
        return
    rows = -(-len(handles) // LEGEND_COLUMNS)
    room = (0.1 + 0.2 * rows) / figure.get_size_inches()[1]
    figure.get_layout_engine().set(rect=(0.0, room, 1.0, 1.0 - room))
    figure.legend(handles=handles, loc="lower center", ncol=-(-len(handles) // rows))


class Figures:
    """Saves every figure as PDF and PNG under RUN_DIR/figures, and keeps the PNG's bytes for the page."""

    def __init__(self, folder):
        self.folder = folder
        self.folder.mkdir(exist_ok=True)
        self.bytes = {}

    def save(self, figure, name):
        # No dates or versions in the files: the same run gives the same bytes.
        self._write(name + ".pdf", lambda out: figure.savefig(
            out, format="pdf", dpi=RASTER_DPI, metadata={"CreationDate": None, "Producer": None, "Creator": None}))
        picture = io.BytesIO()
        figure.savefig(picture, format="png", dpi=SCREEN_DPI, metadata={"Software": None})
        self.bytes[name] = picture.getvalue()
        self._write(name + ".png", lambda out: out.write(self.bytes[name]))
        plt.close(figure)

    def _write(self, file, write):
        temporary = self.folder / (file + ".part")
        with open(temporary, "wb") as out:
            write(out)
        os.replace(temporary, self.folder / file)
