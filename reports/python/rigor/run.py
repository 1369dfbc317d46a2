# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The Rigor authors
"""A run folder: its results as data frames, its trajectories as arrays."""

from __future__ import annotations

import os
from functools import lru_cache
from pathlib import Path
from typing import Any, Optional, Union

import numpy as np
import pandas as pd

from .errors import DamagedStore, NewerFormat, NoSuchCase, NotARun
from .store import Store, parse_lists
from .trajectory import Trajectory, read_trajectory

PathLike = Union[str, "os.PathLike[str]"]

#: What names a case in the frames of its parts.
CASE = ["scenario", "engine", "spec", "preset", "dt"]
#: What must agree for two runs to have "the same" number.
_KEYS = ["scenario", "spec", "dt", "name", "subject"]


class Run:
    """Results of ``rigor validate``, ``rigor study`` or ``rigor bench``.

    Each table of ``results.sqlite`` is a data frame of the same name: ``cases``, ``metrics``, ``timings``,
    ``quantities``, ``settings``, ``ledger``, ``read_back``, ``audit``, ``orders``, ``fairness``,
    ``engines``, ``scenarios``, ``bench_cases`` and the others (``tables()``). Columns of numbers hold numbers
    alone, in SI units. One that is missing or not finite is NaN; the column ``non_finite`` says which of a row are not
    finite, and how. Frames of parts of a case begin with the case's scenario, engine, spec, preset and dt [s].

    Nothing is written. A run may be read while it is still going on; ``reload()`` shows what has come since.
    """

    def __init__(self, folder: PathLike) -> None:
        #: The run folder.
        self.folder = Path(folder)
        self._store = Store(self.folder)
        self._read = lru_cache(maxsize=None)(self._load)

    def __repr__(self) -> str:
        cases = self.cases
        engines = ", ".join(sorted(set(cases["engine"])))
        state = "" if self.finished else ", not finished"
        return f"<rigor.Run '{self.folder}': {len(cases)} cases of {cases['scenario'].nunique()} scenarios on {engines}{state}>"

    # ------------------------------------------------------------------------------------------- tables
    def tables(self) -> list[str]:
        """Names of all tables that the run has."""
        return self._store.names()

    def table(self, name: str) -> pd.DataFrame:
        """A table by name, a copy of its own. Raises KeyError with the names that there are."""
        return self._read(name).copy()

    def _load(self, name: str) -> pd.DataFrame:
        frame = self._store.table(name)
        if name == "scenarios":
            return parse_lists(frame).set_index("name")
        if name in ("cases", "bench_cases"):
            return frame.sort_values("position").set_index("id")
        if name in ("engines", "orders", "fairness") and "position" in frame:
            return frame.sort_values("position").drop(columns="position").reset_index(drop=True)
        if {"case_id", "ordinal"}.issubset(frame.columns) and not name.startswith("bench_"):
            return self._with_case(parse_lists(frame) if name == "audit" else frame)
        return frame

    def _with_case(self, frame: pd.DataFrame) -> pd.DataFrame:
        """Parts of cases, in the order of the cases, with what names the case in front."""
        cases = self._read("cases")
        joined = cases[CASE + ["position"]].merge(frame, left_index=True, right_on="case_id", suffixes=("", "_"))
        joined = joined.sort_values(["position", "ordinal"]).drop(columns=["position", "ordinal"])
        return joined.reset_index(drop=True)

    def reload(self) -> None:
        """Forgets what was read: the next access reads the files again."""
        self._read.cache_clear()

    @property
    def cases(self) -> pd.DataFrame:
        """One row for each case (scenario x engine spec x time step), in the order of the plan; the index is the id.

        ``outcome`` is how the process ended, ``verdict`` how it was judged, ``grade`` its accuracy ('A' to 'E', '' where
        not graded), ``relative_error`` the error that the grade rests on over the scenario's scale, ``dt`` in seconds.
        """
        return self.table("cases")

    @property
    def metrics(self) -> pd.DataFrame:
        """One row for each case, metric and subject ('' for the whole scene): value, unit, bound, verdict, ..."""
        return self.table("metrics")

    @property
    def quantities(self) -> pd.DataFrame:
        """Numbers of a case beside their exact value and that of an ideal run of the engine's own scheme."""
        return self.table("quantities")

    @property
    def timings(self) -> pd.DataFrame:
        """One row for each case and phase ('step', 'build', ...): median, p10, p90, ... of wall time [s]."""
        return self.table("timings")

    @property
    def ledger(self) -> pd.DataFrame:
        """What each engine was requested to do, what it does, and why they differ."""
        return self.table("ledger")

    @property
    def audit(self) -> pd.DataFrame:
        """Contacts that the collision engines found in the poses of each case, against the exact oracle.

        ``findings`` are the worst of each kind, as dictionaries (validation/results/README.md).
        """
        return self.table("audit")

    @property
    def settings(self) -> pd.DataFrame:
        """Every setting of every case, as resolved."""
        return self.table("settings")

    @property
    def orders(self) -> pd.DataFrame:
        """Observed orders of convergence (from three time steps on)."""
        return self.table("orders")

    @property
    def engines(self) -> pd.DataFrame:
        """Engines of the run: version, precision, capabilities."""
        return self.table("engines")

    @property
    def scenarios(self) -> pd.DataFrame:
        """Scenarios of the run by name; ``text`` is the file as it was run."""
        return self.table("scenarios")

    @property
    def environment(self) -> dict[str, str]:
        """Machine, system, compiler, flags and versions."""
        frame = self._read("environment")
        return dict(zip(frame["key"], frame["value"]))

    @property
    def command(self) -> str:
        """The command line of the run."""
        return str(self._read("run")["command"].iloc[0])

    @property
    def finished(self) -> bool:
        """Whether the run has ended (not interrupted, not still going on)."""
        return bool(self._read("run")["finished"].iloc[0])

    def wide(self, metric: str, subject: str = "") -> pd.DataFrame:
        """Values of one metric: a row for each scenario and time step, a column for each engine spec."""
        rows = self._read("metrics")
        rows = rows[(rows["name"] == metric) & (rows["subject"] == subject)]
        if rows.empty:
            known = ", ".join(sorted(set(self._read("metrics")["name"])))
            raise KeyError(f"the run has no metric '{metric}' of subject '{subject}'; its metrics are {known}")
        return rows.pivot_table(index=["scenario", "dt"], columns="spec", values="value", sort=False, dropna=False)

    # ------------------------------------------------------------------------------------- trajectories
    def case(self, id: Optional[str] = None, **select: Any) -> "pd.Series[Any]":
        """The one case with this id, or with these values: ``run.case(scenario="slide_and_stop", engine="ode", dt=0.004)``.

        ``dt`` is compared with a tolerance of 1e-9 of it. Raises NoSuchCase where none or several fit, with their names.
        """
        cases = self._read("cases")
        if id is not None:
            if id not in cases.index:
                raise NoSuchCase(f"the run has no case '{id}'; run.cases lists them")
            return cases.loc[id]
        fits = np.ones(len(cases), dtype=bool)
        for key, value in select.items():
            if key not in cases.columns:
                raise NoSuchCase(f"cases have no column '{key}'; expected one of {', '.join(CASE)}")
            column = cases[key]
            fits &= np.isclose(column, value, rtol=1e-9, atol=0) if key == "dt" else (column == value).to_numpy()
        found = cases[fits]
        if len(found) != 1:
            some = found if len(found) else cases
            names = "; ".join(f"{c.scenario} {c.spec} dt={c.dt:.9g}" for c in some.head(8).itertuples())
            more = f"; and {len(some) - 8} more" if len(some) > 8 else ""
            count = f"{len(found)} cases fit" if len(found) else "no case fits"
            raise NoSuchCase(f"{count} {select}, expected one of: {names}{more}")
        return found.iloc[0]

    def trajectory(self, case: Union[str, "pd.Series[Any]", None] = None, **select: Any) -> Trajectory:
        """The recorded motion of a case, named by its id, by a row of ``cases``, or as for ``case()``."""
        if isinstance(case, pd.Series):
            row = self._read("cases").loc[case.name] if case.name in self._read("cases").index else case
        else:
            row = self.case(case, **select)
        if not row["trajectory_file"]:
            raise NoSuchCase(f"{row['scenario']} on {row['spec']} has no trajectory: it ended as {row['outcome']}")
        return read_trajectory(self.folder / row["trajectory_file"])

    # --------------------------------------------------------------------------------------- comparison
    def compare(self, other: Union["Run", PathLike], tolerance: float = 0.01) -> pd.DataFrame:
        """Metrics of this run (before) beside those of another (after), case by case.

        Columns: scenario, spec, dt, name, subject, unit, before, after, ratio (after over before), verdict_before,
        verdict_after, and change: 'same' (equal, within ``tolerance`` of each other, or both below 1e-9), 'less' or 'more'
        (in size), 'lost' (not finite or missing after), 'found' (before). Rows that only one run has are left out. Whether a
        change is worse than chance is judged by ``rigor.compare``.
        """
        after = other if isinstance(other, Run) else Run(other)
        columns = _KEYS + ["unit", "value", "verdict"]
        both = self._read("metrics")[columns].merge(
            after._read("metrics")[_KEYS + ["value", "verdict"]], on=_KEYS, suffixes=("_before", "_after")
        )
        if both.empty:
            raise NoSuchCase(f"'{self.folder}' and '{after.folder}' have no case in common")
        both = both.rename(columns={"value_before": "before", "value_after": "after"})
        with np.errstate(divide="ignore", invalid="ignore"):
            both["ratio"] = both["after"] / both["before"]
        both["change"] = _change(both["before"].to_numpy(), both["after"].to_numpy(), tolerance)
        return both[_KEYS + ["unit", "before", "after", "ratio", "change", "verdict_before", "verdict_after"]]

    # -------------------------------------------------------------------------------------------- check
    def check(self) -> list[str]:
        """Reads everything. What is damaged or missing, as sentences; empty for a sound run."""
        found = [f"results.sqlite: {text}" for text in self._store.problems()]
        for row in self._read("cases").itertuples():
            if not row.trajectory_file:
                continue
            try:
                read_trajectory(self.folder / str(row.trajectory_file))
            except (DamagedStore, NewerFormat, NoSuchCase, NotARun) as error:
                found.append(str(error))
        return found


def _change(before: Any, after: Any, tolerance: float) -> Any:
    """A word for each pair of numbers, as in Run.compare."""
    b, a = np.abs(before), np.abs(after)
    same = (before == after) | (np.abs(after - before) <= tolerance * b) | ((b < 1e-9) & (a < 1e-9))
    words = np.where(a < b, "less", "more")
    words = np.where(np.isnan(after) & ~np.isnan(before), "lost", words)
    words = np.where(np.isnan(before) & ~np.isnan(after), "found", words)
    return np.where(same | (np.isnan(before) & np.isnan(after)), "same", words)


def open(folder: PathLike) -> Run:
    """Opens a run folder. Raises NotARun, NewerFormat, DamagedStore."""
    return Run(folder)
