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

    def run_notebook(self, name: str) -> None:
        notebook = nbformat.read(NOTEBOOKS / f"{name}.ipynb", as_version=4)
        folder = temporary_folder() / name
        folder.mkdir()
        os.environ.setdefault("RIGOR_NOTEBOOK", "small")
        os.environ.setdefault("PYDEVD_DISABLE_FILE_VALIDATION", "1")  # a warning of the kernel
        client = NotebookClient(notebook, timeout=600, kernel_name="python3", resources={"metadata": {"path": str(folder)}})
        client.execute()  # raises CellExecutionError
        nbformat.write(notebook, Path(os.environ.get("TEST_TMPDIR", str(folder))) / f"{name}.ipynb")
        outputs = [output for cell in notebook.cells if cell.cell_type == "code" for output in cell.outputs]
        pictures = [output for output in outputs if "image/png" in output.get("data", {})]
        self.assertGreaterEqual(len(pictures), 1, name)


def add_test(name: str) -> None:
    setattr(Notebooks, f"test_{name}", lambda self: self.run_notebook(name))


for notebook_name in NAMES:
    add_test(notebook_name)

if __name__ == "__main__":
    unittest.main()
