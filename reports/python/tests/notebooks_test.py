# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The Rigor authors
"""Every notebook runs from top to bottom on small runs; executed copies stay in $TEST_TMPDIR. Exit code 77: skipped."""

from __future__ import annotations

import importlib
import os
import sys
import unittest
from pathlib import Path

from made_run import temporary_folder

import rigor

try:
    import nbformat
    from nbclient import NotebookClient

    for needed in ("matplotlib", "scipy", "ipykernel"):
        importlib.import_module(needed)
except ImportError as missing:
    print(f"The notebooks need nbclient, ipykernel, matplotlib and scipy (./rigor --with python): {missing}", file=sys.stderr)
    sys.exit(77)

NOTEBOOKS = Path(__file__).resolve().parents[1] / "notebooks"
NAMES = sorted(file.stem for file in NOTEBOOKS.glob("*.ipynb"))


class Notebooks(unittest.TestCase):
    def test_all_are_here_and_stored_without_outputs(self) -> None:
        self.assertEqual(len(NAMES), 5)
        for name in NAMES:
            notebook = nbformat.read(NOTEBOOKS / f"{name}.ipynb", as_version=4)
            nbformat.validate(notebook)
            for cell in notebook.cells:
                if cell.cell_type == "code":
                    self.assertEqual((cell.outputs, cell.execution_count), ([], None), f"{name}: {cell.id}")

    def run_notebook(self, name: str) -> str:
        """Returns what the notebook prints."""
        notebook = nbformat.read(NOTEBOOKS / f"{name}.ipynb", as_version=4)
        folder = temporary_folder() / f"{name}{'_of_a_run' if 'RIGOR_RUN' in os.environ else ''}"
        folder.mkdir()
        os.environ.setdefault("RIGOR_NOTEBOOK", "small")
        os.environ.setdefault("PYDEVD_DISABLE_FILE_VALIDATION", "1")  # a warning of the kernel
        client = NotebookClient(notebook, timeout=600, kernel_name="python3", resources={"metadata": {"path": str(folder)}})
        client.execute()  # raises CellExecutionError
        nbformat.write(notebook, Path(os.environ.get("TEST_TMPDIR", str(folder))) / f"{name}.ipynb")
        outputs = [output for cell in notebook.cells if cell.cell_type == "code" for output in cell.outputs]
        pictures = [output for output in outputs if "image/png" in output.get("data", {})]
        self.assertGreaterEqual(len(pictures), 1, name)
        return "".join(output.text for output in outputs if output.output_type == "stream")

    def test_of_other_runs(self) -> None:
        """One time step, two specs of one engine, a scenario without a grade, 2D alone, no audit."""
        run = temporary_folder() / "run"
        specs = ["rigor:preset=default", "rigor:preset=fast"]
        rigor.validate(["slide_and_stop_2d", "pile_2d"], engines=specs, dt="1/120", audit=False, out=run, progress=False)
        os.environ["RIGOR_RUN"] = str(run)
        self.addCleanup(os.environ.pop, "RIGOR_RUN")
        printed = self.run_notebook("error_against_cost")
        self.assertIn("(position_max) in this run of: pile_2d", printed)
        self.assertIn("one time step", printed)
        self.assertIn("No scene of this run has a graded error in 2D and in 3D", self.run_notebook("the_same_scene_in_2d_and_3d"))
        self.assertIn("This run has no audit", self.run_notebook("where_normals_go_wrong"))


def add_test(name: str) -> None:
    def test(self: Notebooks) -> None:
        self.run_notebook(name)

    setattr(Notebooks, f"test_{name}", test)


for notebook_name in NAMES:
    add_test(notebook_name)

if __name__ == "__main__":
    unittest.main()
