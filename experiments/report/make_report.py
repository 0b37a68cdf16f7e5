"""python3 make_report.py RUN_DIR: writes RUN_DIR/report.html and RUN_DIR/figures/ from what the run wrote.

Exit status 0 done, 2 the run directory cannot be used (one line on standard error says why).
"""

import argparse
import os
import pathlib
import sys
import warnings

# Debian's geopandas 0.12 warns of its own dependencies' versions.
warnings.filterwarnings("ignore", category=FutureWarning)
warnings.filterwarnings("ignore", message=".*[Ss]hapely.*")

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))


def make_report(folder, worst):
    """`worst`: how many blocks the gallery of each strategy shows. Returns the path of the page."""
    from distributions import draw_distances, draw_ecdfs, draw_histograms
    from gallery import draw_gallery
    from maps import Layout, draw_maps
    from page import dataset_html, page_html
    from run_data import Run
    from style import Figures

    run = Run(folder)
    layouts = {d["name"]: run.layout(d) for d in run.datasets}
    figures = Figures(run.folder / "figures")
    sections = []
    for dataset in run.datasets:
        layout = Layout(layouts[dataset["name"]])
        has_parcels = set(run.of("parcels", dataset)["layer"])
        strategies = [s for s in run.strategies if s in has_parcels]
        names = {
            "distances": [draw_distances(figures, run, dataset)] if strategies else [],
            "histograms": [draw_histograms(figures, run, dataset, s) for s in strategies],
            "ecdf": [draw_ecdfs(figures, run, dataset)],
            "maps": draw_maps(figures, run, dataset, layout),
            "worst": [n for s in strategies for n in draw_gallery(figures, run, dataset, layout, s, worst)],
        }
        sections.append(dataset_html(run, dataset, figures, names))
    page = run.folder / "report.html"
    temporary = run.folder / "report.html.part"
    temporary.write_text(page_html(run, sections), encoding="utf-8")
    os.replace(temporary, page)
    return page


def main(arguments=None):
    parser = argparse.ArgumentParser(description="Writes report.html and figures/ into a run directory.")
    parser.add_argument("run", metavar="RUN_DIR", help="the --out of `plat run`")
    parser.add_argument("--worst", type=int, default=6, metavar="N",
                        help="blocks to show where each strategy is farthest off (default: %(default)s)")
    given = parser.parse_args(arguments)
    try:
        page = make_report(given.run, given.worst)
    except ModuleNotFoundError as error:
        if error.name not in ("matplotlib", "geopandas", "pandas", "numpy", "fiona", "shapely"):
            raise
        print(f"plat: report: Python has no {error.name}; use the distribution's own /usr/bin/python3 with "
              "python3-matplotlib and python3-geopandas", file=sys.stderr)
        return 2
    except Exception as error:
        from run_data import RunError
        if not isinstance(error, RunError):
            raise
        print(f"plat: report: {error}", file=sys.stderr)
        return 2
    print(page)
    return 0


if __name__ == "__main__":
    sys.exit(main())
