"""Every notebook runs from top to bottom on a run directory."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "report"))

from fake_run import write_fake_run  # noqa: E402


class Notebooks(unittest.TestCase):
    def test_each_runs_on_a_run_directory(self):
        notebooks = sorted((ROOT / "notebooks").glob("*.ipynb"))
        self.assertTrue(notebooks)
        with tempfile.TemporaryDirectory() as folder:
            run = pathlib.Path(folder) / "run"
            write_fake_run(run)
            for notebook in notebooks:
                result = subprocess.run(
                    [sys.executable, "-m", "jupyter", "nbconvert", "--to", "notebook", "--execute", "--log-level=ERROR",
                     "--output-dir", folder, str(notebook)],
                    env={**os.environ, "PLAT_RUN_DIR": str(run)}, capture_output=True, text=True, timeout=600)
                self.assertEqual(result.returncode, 0, result.stderr[-3000:])

    def test_each_is_committed_without_outputs(self):
        for notebook in (ROOT / "notebooks").glob("*.ipynb"):
            self.assertNotIn('"output_type"', notebook.read_text(), notebook.name)


if __name__ == "__main__":
    unittest.main()
