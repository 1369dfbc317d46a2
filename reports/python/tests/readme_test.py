# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The Rigor authors
"""Every Python block of the documentation runs, those of one page one after the other."""

from __future__ import annotations

import contextlib
import io
import os
import re
import unittest
from pathlib import Path

from made_run import temporary_folder

SOURCE = Path(__file__).resolve().parents[3]


def blocks(page: str) -> list[str]:
    return re.findall(r"^```python\n(.*?)^```$", (SOURCE / page).read_text(), re.MULTILINE | re.DOTALL)


class Documentation(unittest.TestCase):
    def run_page(self, page: str, least: int) -> str:
        found = blocks(page)
        self.assertGreaterEqual(len(found), least, page)
        folder = temporary_folder() / page.replace("/", "-")
        folder.mkdir()
        before, printed, names = os.getcwd(), io.StringIO(), {}
        os.chdir(folder)
        try:
            with contextlib.redirect_stdout(printed):
                for number, block in enumerate(found):
                    exec(compile(block, f"{page}, block {number}", "exec"), names)
        finally:
            os.chdir(before)
        return printed.getvalue()

    def test_readme(self) -> None:
        self.assertIn("slide_and_stop", self.run_page("README.md", 1))

    def test_page_of_the_package(self) -> None:
        self.assertIn("same", self.run_page("reports/python/README.md", 3))


if __name__ == "__main__":
    unittest.main()
