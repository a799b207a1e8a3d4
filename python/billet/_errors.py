"""What is raised: every error of this package is a billet.Error."""

from __future__ import annotations

from ._native import Error as Error

Error.__module__ = "billet"
Error.__doc__ = """What cannot be run, read or found, and why.

Errors of a case have the text of `billet check`: every complaint on a line of its own, with file,
line, key and remedy.
"""


class MissingKey(Error, KeyError):
    """A case has no such key, or a table no such column."""

    __str__ = Exception.__str__  # KeyError shows quotes


class MissingPackage(Error, ImportError):
    """A package of Python that is not installed; the message names it."""


class NotConverged(Error):
    """An increment could not be solved. The run is where the last one ended, and can be looked at."""


class ProgramError(Error):
    """The program billet has ended with an error; the message is what it said.

    status   its exit status: docs/guide/results.md, "Exit statuses"
    """

    def __init__(self, message: str, status: int) -> None:
        super().__init__(message)
        self.status = status

    def __reduce__(self) -> tuple[type[ProgramError], tuple[str, int]]:
        """For pickle and copy, as between processes."""
        return type(self), (str(self), self.status)
