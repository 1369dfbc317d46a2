# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The Rigor authors
"""Runs as data frames and arrays; what is no run, is damaged, or is newer."""

from __future__ import annotations

import math
import re
import shutil
import sqlite3
import unittest
from contextlib import closing
from pathlib import Path

import h5py
import numpy as np
import pandas as pd

import rigor
from made_run import PROGRESS, made_run, temporary_folder
from rigor.store import NEWEST_SCHEMA
from rigor.trajectory import NEWEST_TRAJECTORY

_SOURCE = Path(rigor.store.__file__).resolve().parents[3]


def copied_run(name: str) -> Path:
    """A copy of the run, to be spoiled."""
    folder = temporary_folder() / name
    shutil.copytree(made_run().folder, folder)
    return folder


def change(folder: Path, statement: str) -> None:
    with closing(sqlite3.connect(folder / "results.sqlite")) as database:
        database.execute(statement)
        database.commit()


class Tables(unittest.TestCase):
    def test_cases_have_one_row_for_each_engine_and_step(self) -> None:
        cases = made_run().cases
        self.assertEqual(list(cases["engine"].value_counts().sort_index()), [2, 2])
        self.assertEqual(sorted(set(cases["dt"])), [1 / 240, 1 / 60])
        self.assertEqual(set(cases["outcome"]), {"completed"})
        self.assertEqual(cases["steps"].dtype, np.int64)
        self.assertTrue(made_run().finished)

    def test_values_are_those_of_the_store_to_the_bit(self) -> None:
        with closing(sqlite3.connect(made_run().folder / "results.sqlite")) as database:
            query = "SELECT value FROM metrics WHERE case_id = ? AND name = 'position_final' AND subject = ''"
            for case in made_run().cases.index:
                metrics = made_run().metrics
                row = metrics[(metrics.case_id == case) & (metrics.name == "position_final") & (metrics.subject == "")]
                self.assertEqual(row["value"].iloc[0], database.execute(query, (case,)).fetchone()[0])

    def test_columns_of_numbers_are_numbers(self) -> None:
        run = made_run()
        for name in ("metrics", "timings", "quantities", "audit", "read_back"):
            frame = run.table(name)
            self.assertGreater(len(frame), 0, name)
            for column in ("value", "bound", "median", "exact", "normal_error_max", "expected", "dt"):
                if column in frame:
                    self.assertEqual(frame[column].dtype, np.float64, f"{name}.{column}")
                    self.assertFalse(math.isinf(frame[column].mean()))

    def test_what_is_not_finite_is_nan_and_named(self) -> None:
        folder = copied_run("not-finite")
        change(folder, "UPDATE metrics SET value = NULL, non_finite = 'value is infinite' WHERE ordinal = 0")
        metrics = rigor.open(folder).metrics
        self.assertEqual(metrics["value"].dtype, np.float64)
        self.assertEqual(set(metrics["value"][metrics.non_finite != ""].isna()), {True})
        self.assertEqual(set(metrics["non_finite"]), {"", "value is infinite"})

    def test_text_of_older_stores_for_nan_is_read_as_nan(self) -> None:
        folder = copied_run("old-nan")
        change(folder, "UPDATE metrics SET value = 'nan' WHERE ordinal = 0")
        metrics = rigor.open(folder).metrics
        self.assertEqual(metrics["value"].dtype, np.float64)
        self.assertEqual(metrics["value"].isna().sum(), 4)

    def test_an_older_schema_is_read_without_what_it_did_not_have(self) -> None:
        folder = copied_run("older")
        change(folder, "ALTER TABLE cases DROP COLUMN order_dependent")
        change(folder, "PRAGMA user_version = 9")
        self.assertNotIn("order_dependent", rigor.open(folder).cases)
        self.assertEqual(len(rigor.open(folder).cases), 4)

    def test_frames_are_copies(self) -> None:
        made_run().cases["scenario"] = "spoiled"
        self.assertEqual(set(made_run().cases["scenario"]), {"slide_and_stop"})

    def test_lists_environment_and_wide_table(self) -> None:
        run = made_run()
        self.assertEqual(run.scenarios.loc["slide_and_stop", "isolates"], ["friction"])
        self.assertIn("compiler", run.environment)
        wide = run.wide("position_final")
        self.assertEqual(wide.shape, (2, 2))
        rows = run.metrics.query("name == 'position_final' and subject == '' and engine == 'rigor' and dt > 0.01")
        self.assertEqual(wide.loc[("slide_and_stop", 1 / 60), "rigor:preset=matched"], rows["value"].iloc[0])
        with self.assertRaisesRegex(KeyError, "position_final"):
            run.wide("position_finial")

    def test_progress_has_counted_the_cases(self) -> None:
        made_run()
        self.assertEqual([step.done for step in PROGRESS], [1, 2, 3, 4])
        self.assertEqual({step.total for step in PROGRESS}, {4})
        self.assertIn("slide_and_stop", PROGRESS[0].text)


class Cases(unittest.TestCase):
    def test_a_case_is_found_by_what_it_is(self) -> None:
        case = made_run().case(engine="ode", dt=1 / 240)
        self.assertEqual((case["engine"], case["dt"]), ("ode", 1 / 240))
        self.assertEqual(made_run().case(case.name)["spec"], "ode:preset=matched")

    def test_what_fits_none_or_several_is_refused_with_names(self) -> None:
        with self.assertRaisesRegex(rigor.NoSuchCase, "2 cases fit .*ode:preset=matched dt=0.01666"):
            made_run().case(engine="ode")
        with self.assertRaisesRegex(rigor.NoSuchCase, "no case fits"):
            made_run().case(engine="bullet")
        with self.assertRaisesRegex(rigor.NoSuchCase, "no column 'motor'"):
            made_run().case(motor="ode")


class Trajectories(unittest.TestCase):
    def test_arrays_units_and_exact_motion(self) -> None:
        motion = made_run().trajectory(engine="ode", dt=1 / 240)
        block = motion.body("block")
        self.assertEqual(block.position.shape, (len(motion.time), 3))
        self.assertEqual(block.orientation.shape, (len(motion.time), 4))
        np.testing.assert_allclose(np.linalg.norm(block.orientation, axis=1), 1, atol=1e-12)
        self.assertEqual(motion.units["velocity"], "m/s")
        self.assertEqual(motion.units["contacts/normal_impulse"], "N s")
        np.testing.assert_allclose(np.diff(motion.time), motion.dt * motion.stride, rtol=1e-9)
        error = motion.position_error("block")
        np.testing.assert_allclose(error, motion.series["position_error", "block"], atol=1e-12)
        metrics = made_run().metrics
        final = metrics[(metrics.case_id == motion.case_id) & (metrics.name == "position_final") & (metrics.subject == "")]
        self.assertAlmostEqual(error[-1], final["value"].iloc[0], delta=1e-12)

    def test_contacts_are_rows(self) -> None:
        motion = made_run().trajectory(engine="rigor", dt=1 / 240)
        first = motion.contacts_at(1)
        self.assertEqual(len(first), 4)
        np.testing.assert_allclose(first["normal"], [[0, 1, 0]] * 4, atol=1e-9)
        weight = 2.0 * 9.81 / 240  # the impulse of a step under the block of 2 kg
        self.assertAlmostEqual(first["normal_impulse"].sum(), weight, delta=1e-6)
        self.assertEqual((set(motion.contacts["body_a"]), set(motion.contacts["body_b"])), ({0}, {1}))

    def test_frames_and_unknown_bodies(self) -> None:
        motion = made_run().trajectory(made_run().cases.iloc[0])
        frame = motion.frame("block")
        self.assertEqual(list(frame.columns[:4]), ["x", "y", "z", "qw"])
        np.testing.assert_array_equal(frame["x"].to_numpy(), motion.bodies["block"].position[:, 0])
        with self.assertRaisesRegex(rigor.NoSuchCase, "expected one of floor, block"):
            motion.body("brick")
        with self.assertRaisesRegex(rigor.NoSuchCase, "does not know"):
            motion.position_error("floor")


class Comparison(unittest.TestCase):
    def test_a_run_is_the_same_as_itself(self) -> None:
        change_of = made_run().compare(made_run().folder)["change"]
        self.assertEqual(set(change_of), {"same"})

    def test_what_became_more_less_and_lost_is_named(self) -> None:
        folder = copied_run("changed")
        case = made_run().case(engine="ode", dt=1 / 60).name
        change(folder, f"UPDATE metrics SET value = value * 2 WHERE name = 'position_final' AND case_id = '{case}'")
        change(folder, f"UPDATE metrics SET value = NULL WHERE name = 'velocity_max' AND case_id = '{case}'")
        table = made_run().compare(folder)
        rows = table[table.change != "same"]
        self.assertEqual(set(rows["spec"]), {"ode:preset=matched"})
        words = dict(zip(rows["name"], rows["change"]))
        self.assertEqual(words, {"position_final": "more", "velocity_max": "lost"})
        self.assertEqual(set(rows[rows.change == "more"]["ratio"]), {2.0})
        back = rigor.open(folder).compare(made_run())
        self.assertEqual(set(back[back.change != "same"]["change"]), {"less", "found"})

    def test_the_program_judges_two_runs(self) -> None:
        result = rigor.compare(made_run(), made_run())
        self.assertEqual(result["metrics"], [])
        self.assertEqual(len(result["specs"]), 2)


class Refusals(unittest.TestCase):
    def test_what_is_no_run(self) -> None:
        with self.assertRaisesRegex(rigor.NotARun, "no such folder"):
            rigor.open(temporary_folder() / "none")
        empty = temporary_folder() / "empty"
        empty.mkdir()
        with self.assertRaisesRegex(rigor.NotARun, "no results.sqlite"):
            rigor.open(empty)
        with closing(sqlite3.connect(empty / "results.sqlite")) as other:
            other.execute("CREATE TABLE cases (id TEXT)")
            other.commit()
        with self.assertRaisesRegex(rigor.NotARun, "not a results store"):
            rigor.open(empty)

    def test_a_newer_store_or_trajectory(self) -> None:
        folder = copied_run("newer")
        change(folder, f"PRAGMA user_version = {NEWEST_SCHEMA + 1}")
        with self.assertRaisesRegex(rigor.NewerFormat, f"found schema {NEWEST_SCHEMA + 1}, expected at most"):
            rigor.open(folder)
        folder = copied_run("newer-trajectory")
        case = made_run().cases.iloc[0]
        with h5py.File(folder / case["trajectory_file"], "r+") as file:
            file.attrs["rigor_trajectory"] = NEWEST_TRAJECTORY + 1
        with self.assertRaises(rigor.NewerFormat):
            rigor.open(folder).trajectory(case.name)

    def test_the_newest_formats_are_those_that_the_program_writes(self) -> None:
        store = (_SOURCE / "validation/results/store.hpp").read_text()
        self.assertEqual(int(re.search(r"kSchemaVersion = (\d+)", store)[1]), NEWEST_SCHEMA)
        trajectory = (_SOURCE / "validation/results/trajectory_file.cpp").read_text()
        self.assertEqual(int(re.search(r"kFormat = (\d+)", trajectory)[1]), NEWEST_TRAJECTORY)

    def test_damaged_files(self) -> None:
        folder = copied_run("damaged")
        store = folder / "results.sqlite"
        content = bytearray(store.read_bytes())
        content[4096:] = bytes(len(content) - 4096)
        store.write_bytes(content)
        with self.assertRaisesRegex(rigor.DamagedStore, "cannot be read as a results store"):
            rigor.open(folder).metrics
        store.write_bytes(b"no database at all" * 100)
        with self.assertRaises(rigor.DamagedStore):
            rigor.open(folder)

    def test_damaged_trajectories_are_found_by_check(self) -> None:
        self.assertEqual(made_run().check(), [])
        folder = copied_run("damaged-trajectory")
        files = [folder / name for name in rigor.open(folder).cases["trajectory_file"]]
        files[0].write_bytes(files[0].read_bytes()[:1000])
        files[1].unlink()
        found = rigor.open(folder).check()
        self.assertEqual(len(found), 2)
        self.assertIn("cannot be read as a trajectory", found[0])
        self.assertIn("no such trajectory", found[1])


if __name__ == "__main__":
    pd.set_option("display.width", 200)
    unittest.main()
