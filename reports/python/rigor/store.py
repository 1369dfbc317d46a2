# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The Rigor authors
"""The tables of a run folder's ``results.sqlite`` as data frames.

A column that SQLite declares TEXT holds texts, one that it declares INTEGER integers, one without a type double precision
numbers. A number that is missing or not finite is NaN; ``non_finite`` of its row then says in words which number it
is, and whether it is infinite or not a number.
"""

from __future__ import annotations

import json
import sqlite3
from contextlib import closing
from pathlib import Path
from typing import Any, Callable, Mapping, TypeVar

import numpy as np
import pandas as pd

from .errors import DamagedStore, NewerFormat, NotARun

#: The newest schema of results.sqlite that this package knows (validation/results/store.hpp).
NEWEST_SCHEMA = 15

_APPLICATION_ID = 0x52494752
_LISTS = {"isolates", "tags", "observed", "metrics", "time_steps", "findings"}
_Result = TypeVar("_Result")


class Store:
    """Reads one ``results.sqlite``; the file is open only while a table is read."""

    def __init__(self, folder: Path) -> None:
        self.file = folder / "results.sqlite"
        if not folder.exists():
            raise NotARun(f"'{folder}': there is no such folder")
        if not self.file.is_file():
            raise NotARun(f"'{folder}' is not a run folder: it has no results.sqlite")
        self.schema = self._use(self._check)

    def _check(self, database: sqlite3.Connection) -> int:
        if database.execute("PRAGMA application_id").fetchone()[0] != _APPLICATION_ID:
            raise NotARun(f"'{self.file}' is not a results store of rigor")
        schema = int(database.execute("PRAGMA user_version").fetchone()[0])
        if schema > NEWEST_SCHEMA:
            raise NewerFormat(
                f"'{self.file}' was written by a newer rigor: found schema {schema}, expected at most {NEWEST_SCHEMA}"
            )
        return schema

    def _use(self, work: Callable[[sqlite3.Connection], _Result]) -> _Result:
        """What ``work`` makes of the open database."""
        try:
            with closing(self._connect()) as database:
                return work(database)
        except sqlite3.DatabaseError as error:
            raise DamagedStore(f"'{self.file}' cannot be read as a results store: {error}") from error

    def _connect(self) -> sqlite3.Connection:
        # A store left by a kill may have a journal to roll back, which needs writing.
        uri = self.file.absolute().as_uri()
        try:
            database = sqlite3.connect(uri + "?mode=rw", uri=True, timeout=10)
            database.execute("PRAGMA user_version")
            return database
        except sqlite3.OperationalError:
            return sqlite3.connect(uri + "?mode=ro", uri=True, timeout=10)

    def names(self) -> list[str]:
        """Names of the tables, sorted; those that make up the views of a case (``shared_...``) are left out."""
        query = (
            "SELECT name FROM sqlite_master WHERE type IN ('table', 'view') AND name NOT LIKE 'shared!_%' ESCAPE '!'"
            " ORDER BY name"
        )
        return [name for (name,) in self._use(lambda database: database.execute(query).fetchall())]

    def table(self, name: str) -> pd.DataFrame:
        """A table, its columns as the store declares them. Raises KeyError for a table that there is not."""
        if name not in self.names():
            raise KeyError(f"the store has no table '{name}'; it has {', '.join(self.names())}")

        def read(database: sqlite3.Connection) -> tuple[dict[str, str], list[tuple[Any, ...]]]:
            types = {row[1]: row[2] for row in database.execute(f'PRAGMA table_info("{name}")')}
            return types, database.execute(f'SELECT * FROM "{name}"').fetchall()

        types, rows = self._use(read)
        return _typed(types, rows)

    def problems(self) -> list[str]:
        """What SQLite finds wrong with the file; empty for a sound one."""
        found = self._use(lambda database: database.execute("PRAGMA integrity_check").fetchall())
        return [text for (text,) in found if text != "ok"]


def _typed(types: Mapping[str, str], rows: list[tuple[Any, ...]]) -> pd.DataFrame:
    columns = list(zip(*rows)) if rows else [()] * len(types)
    data: dict[str, Any] = {}
    for (name, declared), values in zip(types.items(), columns):
        if declared == "TEXT":
            data[name] = np.array([value or "" for value in values], dtype=object)
        elif declared == "INTEGER" and None not in values:
            data[name] = np.array(values, dtype=np.int64)
        else:
            data[name] = np.array([_number(value) for value in values], dtype=np.float64)
    return pd.DataFrame(data)


def _number(value: Any) -> float:
    """Older stores have the text 'nan' for NaN."""
    return float("nan") if value is None else float(value)


def parse_lists(frame: pd.DataFrame) -> pd.DataFrame:
    """The frame with its columns of JSON arrays as Python lists."""
    for name in _LISTS.intersection(frame.columns):
        frame[name] = [json.loads(text) if text else [] for text in frame[name]]
    return frame
