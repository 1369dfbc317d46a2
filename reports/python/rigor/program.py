# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The Rigor authors
"""Starts the program ``rigor`` and follows what it reports."""

from __future__ import annotations

import json
import os
import re
import shutil
import signal
import subprocess
import sys
import threading
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any, Callable, Optional, Sequence, Union

from .errors import BadCommand, CommandFailed, ProgramNotFound

_LINE = re.compile(r"^\[(\d+)/(\d+)\] (.*)$")


@dataclass(frozen=True)
class Progress:
    """A case has ended."""

    #: Cases that have ended, and cases of the run.
    done: int
    total: int
    #: "scenario  spec  dt=...  C ran  0.12 s  ETA 0:10".
    text: str


#: True: a line on standard error, or below the notebook's cell; False: silence; a function: called for each case that has ended.
ProgressOption = Union[bool, Callable[[Progress], None]]


def find_program() -> str:
    """Path of the program: $RIGOR_PROGRAM, else the launcher of the source tree that this package is in, else the PATH."""
    named = os.environ.get("RIGOR_PROGRAM")
    if named:
        if shutil.which(named) is None:
            raise ProgramNotFound(f"RIGOR_PROGRAM is '{named}', which is no program")
        return named
    root = Path(__file__).resolve().parents[3]
    launcher = root / "rigor"
    if launcher.is_file() and (root / "CMakeLists.txt").is_file():
        return str(launcher)
    found = shutil.which("rigor")
    if found is None:
        raise ProgramNotFound(
            "the program 'rigor' is not on the PATH; put it there, or set RIGOR_PROGRAM to the launcher ./rigor of a source tree"
        )
    return found


def call(arguments: Sequence[str], progress: ProgressOption = False, cwd: Optional[Path] = None) -> tuple[Any, bool]:
    """Runs ``rigor ARGUMENTS``; its JSON, and whether it ended green. Ctrl-C is passed on, and what has ended stays stored.

    Raises BadCommand for exit code 2, KeyboardInterrupt for 130, CommandFailed for all others but 0 and 1, and but 4 of
    ``validate``: every case is unsupported, which the run that is stored says of each.
    """
    command = [find_program(), *arguments]
    child = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, stdin=subprocess.DEVNULL, cwd=cwd)
    assert child.stdout is not None and child.stderr is not None
    follower = _Follower(child.stderr, progress)
    follower.start()
    try:
        output = child.stdout.read()
        code = child.wait()
    except BaseException:
        child.send_signal(signal.SIGINT)
        child.wait()
        raise
    finally:
        follower.join()
        child.stdout.close()
        child.stderr.close()
    if follower.error is not None:
        raise follower.error
    return _judge(output, code, follower.messages, arguments)


def _judge(output: bytes, code: int, messages: list[str], arguments: Sequence[str]) -> tuple[Any, bool]:
    said = "\n".join(messages) or f"rigor {' '.join(arguments)} ended with exit code {code}"
    if code == 130:
        raise KeyboardInterrupt(said)
    if code == 2:
        raise BadCommand(said)
    if code not in (0, 1) and not (code == 4 and arguments[0] == "validate"):
        raise CommandFailed(said, code)
    try:
        return json.loads(output), code == 0
    except ValueError as error:
        raise CommandFailed(f"{said}\nfound no JSON: {error}", code) from error


class _Follower(threading.Thread):
    """Reads the program's standard error: lines of progress, and messages."""

    def __init__(self, stream: IO[bytes], progress: ProgressOption) -> None:
        super().__init__(daemon=True)
        self._stream, self._progress = stream, progress
        self.messages: list[str] = []
        self.error: Optional[BaseException] = None
        # A terminal and a notebook show a line again and again in one place.
        self._rewrites = sys.stderr.isatty() or "ipykernel" in sys.modules
        self._shown = 0

    def run(self) -> None:
        for raw in self._stream:
            line = raw.decode(errors="replace").rstrip()
            match = _LINE.match(line)
            if match is None:
                self.messages.append(line)
            else:
                self._show(Progress(int(match[1]), int(match[2]), match[3]))
        if self._shown:
            sys.stderr.write("\r" + " " * self._shown + "\r")

    def _show(self, step: Progress) -> None:
        if callable(self._progress):
            if self.error is None:
                try:
                    self._progress(step)
                except BaseException as error:  # raised again by call(), when the program has ended
                    self.error = error
        elif self._progress:
            text = f"[{step.done}/{step.total}] {step.text}"
            if self._rewrites:
                sys.stderr.write("\r" + text[:110].ljust(self._shown))
                self._shown = max(self._shown, len(text[:110]))
            else:
                sys.stderr.write(text + "\n")
            sys.stderr.flush()
