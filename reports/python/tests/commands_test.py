# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The Rigor authors
"""Commands of the program from Python, and how they fail."""

from __future__ import annotations

import os
import unittest
from unittest import mock

import numpy as np

import rigor
from made_run import made_run, temporary_folder

BALL = {
    "rigor": 1,
    "name": "falling",
    "title": "A ball falls",
    "dimension": 3,
    "gravity": [0, -9.81, 0],
    "duration": 0.5,
    "dt": [0.01],
    "materials": {"rubber": {"friction": 0.5}},
    "bodies": [{"name": "ball", "mass": 1, "shapes": [{"sphere": {"radius": 0.1}, "material": "rubber"}]}],
}


class Validate(unittest.TestCase):
    def test_a_dictionary_is_a_scenario_and_values_are_replaced(self) -> None:
        run = rigor.validate(
            BALL,
            engines="rigor:preset=matched",
            set={"gravity": [0, -1.5, 0], "bodies.ball.velocity": [0.25, 0, 0]},
            out=temporary_folder() / "falling",
            audit=False,
            progress=False,
        )
        self.assertTrue(run.green)
        ball = run.trajectory(engine="rigor").bodies["ball"]
        np.testing.assert_allclose(ball.velocity[-1], [0.25, -0.75, 0], atol=1e-12)
        self.assertIn("--no-audit", run.command)

    def test_bad_names_and_folders_are_refused_with_the_program_s_words(self) -> None:
        with self.assertRaisesRegex(rigor.BadCommand, "slide_and_stop"):
            rigor.validate("slide_and_stopp", engines="rigor", progress=False)
        with self.assertRaisesRegex(rigor.BadCommand, "preset"):
            rigor.validate("slide_and_stop", engines="rigor:presett=fast", progress=False)
        with self.assertRaisesRegex(rigor.BadCommand, "holds a run already"):
            rigor.validate("slide_and_stop", engines="rigor", out=made_run().folder, progress=False)

    def test_a_run_of_which_nothing_is_supported_comes_back_and_is_not_green(self) -> None:
        run = rigor.validate(BALL, engines="box2d", out=temporary_folder() / "flat", progress=False)
        self.assertFalse(run.green)
        self.assertEqual(set(run.cases["verdict"]), {"unsupported"})

    def test_an_error_of_the_caller_s_progress_comes_back(self) -> None:
        def stop(step: rigor.Progress) -> None:
            raise RuntimeError(f"seen {step.done}")

        with self.assertRaisesRegex(RuntimeError, "seen 1"):
            rigor.validate(BALL, engines="rigor:preset=matched", out=temporary_folder() / "stopped", progress=stop)

    def test_a_missing_program_is_named(self) -> None:
        with mock.patch.dict(os.environ, {"RIGOR_PROGRAM": "no-such-program"}):
            with self.assertRaisesRegex(rigor.ProgramNotFound, "no-such-program"):
                rigor.engines()


class Others(unittest.TestCase):
    def test_collide_has_a_row_for_each_query_and_engine(self) -> None:
        found = rigor.collide(random=5, seed=3, shapes=["sphere", "box"], engines=["rigor", "fcl"])
        self.assertEqual(sorted(found["engine"].value_counts()), [found["case"].nunique()] * 2)
        self.assertEqual(set(found["verdict"]), {"ok"})
        self.assertEqual(found["exact_signed_distance"].dtype, np.float64)
        self.assertLess(found["distance_error"].max(), 1e-9)
        self.assertEqual(set(found["shape_a"]) | set(found["shape_b"]), {"sphere", "box"})

    def test_a_study_gives_its_run_and_tables(self) -> None:
        run = rigor.study("symptoms", parts="sticking", out=temporary_folder() / "symptoms", progress=False)
        self.assertGreater(len(run.cases), 1)
        self.assertIn("parts", run.study)

    def test_lists(self) -> None:
        self.assertIn("box_stack", rigor.scenarios().index)
        self.assertIn("rigor", rigor.engines().index)
        self.assertIn("symptoms", rigor.studies().index)


if __name__ == "__main__":
    unittest.main()
