# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The Rigor authors
"""Commands of the program ``rigor`` as functions."""

from __future__ import annotations

import json
import tempfile
from fractions import Fraction
from pathlib import Path
from typing import Any, Iterable, Mapping, Optional, Sequence, Union

import pandas as pd

from .program import ProgressOption, call
from .run import PathLike, Run

Names = Union[str, Iterable[str]]
TimeStep = Union[float, str, Fraction]


def _list(names: Union[Names, TimeStep, Iterable[TimeStep], None]) -> list[str]:
    if names is None:
        return []
    if isinstance(names, (str, float, int, Fraction)):
        return [_number(names)]
    return [_number(name) for name in names]


def _number(value: Union[TimeStep, str]) -> str:
    """Numbers with all their digits: what the program reads is the same double."""
    return value if isinstance(value, str) else repr(float(value)) if isinstance(value, float) else str(value)


def _option(name: str, value: Any) -> list[str]:
    if value is None or value is False:
        return []
    return [name] if value is True else [name, str(value)]


def _what(what: Union[Names, Mapping[str, Any]], folder: str) -> list[str]:
    """Names and files; a scenario as a dictionary becomes a file."""
    if not isinstance(what, Mapping):
        return _list(what)
    file = Path(folder) / f"{what.get('name', 'scenario')}.json"
    file.write_text(json.dumps(what))
    return [str(file)]


def validate(
    what: Union[Names, Mapping[str, Any], None] = None,
    *,
    engines: Optional[Names] = None,
    dt: Union[TimeStep, Iterable[TimeStep], None] = None,
    set: Optional[Mapping[str, Any]] = None,
    out: Optional[PathLike] = None,
    jobs: int = 1,
    orders: Optional[int] = None,
    audit: bool = True,
    resume: bool = False,
    progress: ProgressOption = True,
) -> Run:
    """Runs scenarios on engines, measures them against their references and returns the stored run.

    what: suites or scenarios by name or file, or one scenario as a dictionary (scenarios/FORMAT.md); default 'standard'.
    engines: specs as "ode:preset=matched,iterations=50"; default: all that are installed, in all of their presets.
    dt: time steps [s] (0.004 or "1/240") instead of the scenarios' own.
    set: values of the scenarios to replace, {"bodies.block.velocity": [3.1, 0, 0.2]}.
    out: run folder; default: a new one in ``runs/`` of the working directory.
    jobs: cases at a time; with more than one, times are disturbed.
    orders: orders of insertion that each case is run in.
    audit: whether the collision engines judge the poses, too.
    resume: go on with the interrupted run in ``out``.
    progress: see ProgressOption.

    A run that ended red (``run.green`` is False) is returned all the same. Raises BadCommand with the program's message.
    """
    with tempfile.TemporaryDirectory(prefix="rigor-") as folder:
        arguments = ["validate", *(_what(what, folder) if what is not None else [])]
        if engines is not None:
            arguments += ["--engines", ",".join(_list(engines))]
        for step in _list(dt):
            arguments += ["--dt", step]
        for key, value in (set or {}).items():
            arguments += ["--set", f"{key}={json.dumps(value)}"]
        arguments += _option("--out", out) + _option("--jobs", jobs) + _option("--orders", orders)
        arguments += _option("--no-audit", not audit) + _option("--resume", resume)
        return _run(arguments, progress)


def study(
    name: str,
    *,
    parts: Optional[Names] = None,
    out: Optional[PathLike] = None,
    jobs: int = 1,
    audit: bool = False,
    resume: bool = False,
    progress: ProgressOption = True,
) -> Run:
    """Runs a study, a grid of choices of algorithms (``studies()`` lists them), and returns the stored run.

    Its tables, as ``rigor study --json`` prints them, are ``run.study``.
    """
    arguments = ["study", name]
    if parts is not None:
        arguments += ["--part", ",".join(_list(parts))]
    arguments += _option("--out", out) + _option("--jobs", jobs)
    arguments += _option("--audit", audit) + _option("--resume", resume)
    return _run(arguments, progress)


def _run(arguments: list[str], progress: ProgressOption) -> Run:
    result, green = call(arguments + ["--json"] + _option("--quiet", progress is False), progress)
    run = CommandRun(result["run"])
    run.green = green
    run.study = result if arguments[0] == "study" else {}
    return run


class CommandRun(Run):
    """A run that a command of this package has just made."""

    #: Whether the command ended green (exit code 0).
    green: bool = False
    #: The tables of a study; empty for other runs.
    study: dict[str, Any] = {}


def collide(
    files: Optional[Union[Names, Mapping[str, Any]]] = None,
    *,
    random: Optional[int] = None,
    seed: int = 1,
    dimension: int = 3,
    shapes: Optional[Names] = None,
    engines: Optional[Names] = None,
    jobs: Optional[int] = None,
) -> pd.DataFrame:
    """Puts collision queries to every engine and to the exact oracle: a row for each query and engine.

    files: files of cases or their names, or the content of one as a dictionary; default: the whole library, unless
        ``random`` says how many random pairs to make from ``seed`` (of ``shapes``, in ``dimension`` 2 or 3).
    engines: specs; default: every engine, every algorithm.

    Columns: case, file, dimension, tags, shape_a, shape_b, engine, verdict, message; what the engine found: overlap,
    signed_distance and depth [m] (depth is positive where they overlap), normal (unit, from a to b), witness_a, witness_b [m],
    contacts (how many), seconds; its errors against the oracle: distance_error [m], normal_angle [rad] (to the nearest right
    normal), normal_excess, point_error [m]; and the oracle: exact_signed_distance, exact_overlap, exact_normals (all that are
    right), ... NaN or None: not given.
    """
    with tempfile.TemporaryDirectory(prefix="rigor-") as folder:
        arguments = ["collide", *(_what(files, folder) if files is not None else [])]
        if random is not None:
            arguments += ["--random", str(random), "--seed", str(seed), "--dimension", str(dimension)]
            if shapes is not None:
                arguments += ["--shapes", ",".join(_list(shapes))]
        elif files is None:
            arguments.append("--suite")
        if engines is not None:
            arguments += ["--engines", ",".join(_list(engines))]
        result, _ = call(arguments + _option("--jobs", jobs) + ["--json", "--quiet"])
    rows = []
    for case in result["cases"]:
        about = {name: case[name] for name in ("file", "dimension", "tags")}
        shapes_of = {f"shape_{side}": _kind(case.get(side)) for side in ("a", "b")}
        truth = {f"exact_{key}": value for key, value in case["truth"].items()}
        rows += [{"case": case["name"], **about, **shapes_of, **found, **truth} for found in case["answers"]]
    return _numeric(pd.DataFrame(rows))


def _kind(shape: Any) -> str:
    """The kind of a shape as files have it: {"box": {...}, "position": ...}."""
    keys: list[str] = [key for key in shape or {} if key not in ("position", "orientation", "rotation", "angle", "angle_deg")]
    return keys[0] if keys else ""


def _numeric(frame: pd.DataFrame) -> pd.DataFrame:
    """Columns of numbers and nothing as columns of numbers and NaN."""
    for name in frame.columns:
        values = [value for value in frame[name] if value is not None and value == value]
        if values and all(isinstance(value, (int, float)) and not isinstance(value, bool) for value in values):
            frame[name] = pd.to_numeric(frame[name])
    return frame


def compare(before: Union[Run, PathLike], after: Union[Run, PathLike], tolerance: float = 0.01) -> dict[str, Any]:
    """What became better or worse between two runs, as ``rigor compare --json`` judges it, with statistics of times.

    ``before`` may be 'recorded': the numbers on record for the engines of ``after``. For plain numbers: Run.compare.
    """
    names = [str(run.folder) if isinstance(run, Run) else str(run) for run in (before, after)]
    result, _ = call(["compare", *names, "--tolerance", repr(tolerance), "--json"])
    return dict(result)


def _listed(what: str, columns: Sequence[str]) -> pd.DataFrame:
    result, _ = call(["list", what, "--json"])
    rows = result[what] if isinstance(result, dict) else result
    frame = pd.DataFrame(rows)
    return frame[[name for name in columns if name in frame] + [name for name in frame if name not in columns]]


def engines() -> pd.DataFrame:
    """Installed engines: version, precision, presets, capabilities, and every key of their specs."""
    return _listed("engines", ["name", "title", "version", "precision", "presets"]).set_index("name")


def scenarios() -> pd.DataFrame:
    """Scenarios of the library."""
    return _listed("scenarios", ["name", "title", "dimension", "bodies", "duration", "dt"]).set_index("name")


def studies() -> pd.DataFrame:
    """Studies of the library, with their parts."""
    return _listed("studies", ["name", "title", "parts"]).set_index("name")
