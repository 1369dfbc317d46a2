# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The Rigor authors
"""What may go wrong, as exceptions."""

from __future__ import annotations


class RigorError(Exception):
    """Base class of all errors of this package."""


class NotARun(RigorError):
    """The path is no run folder."""


class DamagedStore(RigorError):
    """The run has a store or a trajectory that cannot be read."""


class NewerFormat(RigorError):
    """The run was written by a newer version of Rigor than this package."""


class NoSuchCase(RigorError, KeyError):
    """No case of the run, or more than one, is what was requested."""

    def __str__(self) -> str:
        return str(self.args[0]) if self.args else ""


class ProgramNotFound(RigorError):
    """The program `rigor` is not where this package looks for it."""


class BadCommand(RigorError, ValueError):
    """The program refused the command line or a file (exit code 2)."""


class CommandFailed(RigorError):
    """The program ended in another way than green or red."""

    def __init__(self, message: str, exit_code: int) -> None:
        super().__init__(message)
        #: As the program ended: 3 internal error, 4 unsupported, 5 crashed; negative: killed by this signal.
        self.exit_code = exit_code
