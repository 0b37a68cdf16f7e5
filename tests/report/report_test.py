"""The report of a made-up run. Run: /usr/bin/python3 -m unittest discover -s tests/report -p '*_test.py'"""

import contextlib
import io
import pathlib
import re
import sys
import tempfile
import unittest
import warnings

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "experiments" / "report"), str(ROOT / "tests" / "report")]
warnings.simplefilter("ignore")

import make_report  # noqa: E402
from fake_run import write_fake_run  # noqa: E402


def run_report(folder):
    """(exit status, standard error)."""
    errors = io.StringIO()
    with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(errors):
        status = make_report.main([str(folder)])
    return status, errors.getvalue()


class WithRun(unittest.TestCase):
    OPTIONS = {}

    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.temporary.name)
        write_fake_run(cls.folder, **cls.OPTIONS)
        cls.status, cls.errors = run_report(cls.folder)
        page = cls.folder / "report.html"
        cls.page = page.read_text(encoding="utf-8") if page.exists() else ""

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()


class FullReport(WithRun):
    def test_is_written(self):
        self.assertEqual((self.status, self.errors), (0, ""))
        self.assertFalse(list(self.folder.rglob("*.part")))

    def test_has_every_figure_twice_and_embedded(self):
        expected = {f"{kind}_{m}_madeup" for kind in ("map", "zoom") for m in ("aspect_ratio", "area_m2", "neighbours")}
        expected |= {f"{kind}_{s}_madeup" for kind in ("histograms", "worst") for s in ("obb", "skeleton", "voronoi")}
        expected |= {"ecdf_madeup", "distances_madeup"}
        for ending in ("pdf", "png"):
            found = {p.stem for p in (self.folder / "figures").glob(f"*.{ending}")}
            self.assertEqual(found, expected)
        self.assertEqual(self.page.count("data:image/png;base64,"), len(expected))

    def test_a_gallery_of_many_blocks_goes_on_to_another_figure(self):
        from gallery import PER_FIGURE, draw_gallery, worst_blocks
        from maps import Layout
        from run_data import Run

        class Kept(dict):
            def save(self, figure, name):
                self[name] = len(figure.axes)

        run, figures = Run(self.folder), Kept()
        dataset = run.datasets[0]
        rows = worst_blocks(run, dataset, "obb", 14)
        self.assertEqual(len(rows), 14)
        self.assertTrue(rows["ks_area"].is_monotonic_decreasing)
        names = draw_gallery(figures, run, dataset, Layout(run.layout(dataset)), "obb", 14)
        self.assertEqual(names, ["worst_obb_madeup", "worst_obb_madeup_2"])
        self.assertEqual(list(figures.values()), [2 * PER_FIGURE, 2 * 4])

    def test_asks_for_nothing_from_outside(self):
        self.assertFalse(re.search(r"""(src|href)\s*=\s*["'](?!data:|#)""", self.page))
        for word in ("http://", "https://", "<script", "@import", "url("):
            self.assertNotIn(word, self.page)

    def test_says_where_the_numbers_come_from(self):
        for word in ("A made-up town", "CC0", "nobody &amp; co", "0123456789abcdef", "EPSG:32633", "observed parcels"):
            self.assertIn(word, self.page)
        self.assertNotIn("tessellat", self.page)

    def test_lists_failures_with_their_code(self):
        self.assertIn("not_covered", self.page)
        self.assertIn("voronoi left 1 of 36 blocks undivided", self.page)

    def test_names_the_nearest_strategy(self):
        self.assertIn("On area, skeleton is closest", self.page)


class TessellatedReport(WithRun):
    OPTIONS = {"plots": "tessellated", "columns": 3, "rows": 2, "strategies": ("obb",)}

    def test_says_so_in_every_title_and_caption(self):
        self.assertEqual(self.status, 0)
        self.assertNotIn("observed parcels", self.page)
        headings = re.findall(r"<(h1|h2|h3|caption)[^>]*>(.*?)</", self.page)
        for _, text in headings:
            if text not in ("Methods", "Verdict"):
                self.assertIn("tessellated plots", text)
        self.assertIn("There is no cadastre here", self.page)

    def test_is_the_same_when_made_again(self):
        before = {p.name: p.read_bytes() for p in (self.folder / "figures").iterdir()}
        run_report(self.folder)
        self.assertEqual(self.page, (self.folder / "report.html").read_text(encoding="utf-8"))
        for path in (self.folder / "figures").iterdir():
            self.assertEqual(before[path.name], path.read_bytes(), path.name)


class EmptyStrategyReport(WithRun):
    OPTIONS = {"empty": "skeleton", "columns": 3, "rows": 2}

    def test_is_written_and_says_that_nothing_was_divided(self):
        self.assertEqual((self.status, self.errors), (0, ""))
        self.assertIn("skeleton divided no block", self.page)
        self.assertNotIn("nan", re.sub(r"base64,[^\"]*", "", self.page).lower())


class SingleEmptyStrategyReport(WithRun):
    OPTIONS = {"empty": "obb", "columns": 2, "rows": 1, "strategies": ("obb",)}

    def test_is_written(self):
        self.assertEqual((self.status, self.errors), (0, ""))


class BrokenRun(unittest.TestCase):
    def expect_one_line(self, folder, *words):
        status, errors = run_report(folder)
        self.assertEqual(status, 2)
        self.assertEqual(errors.count("\n"), 1, errors)
        for word in words:
            self.assertIn(word, errors)

    def test_of_a_missing_folder(self):
        self.expect_one_line("/nonexistent/run", "/nonexistent/run")

    def test_of_missing_or_bad_files(self):
        for file in ("manifest.json", "parcels.csv", "blocks.csv", "distances.csv", "differences.csv",
                     "histograms.csv", "layout_madeup.gpkg"):
            with self.subTest(file=file), tempfile.TemporaryDirectory() as name:
                folder = pathlib.Path(name)
                write_fake_run(folder, columns=2, rows=1, strategies=("obb",))
                (folder / file).unlink()
                self.expect_one_line(folder, file)
                (folder / file).write_text("{}" if file.endswith("json") else "x,y\n1,2\n")
                self.expect_one_line(folder, file)
                self.assertFalse((folder / "report.html").exists())


if __name__ == "__main__":
    unittest.main()
