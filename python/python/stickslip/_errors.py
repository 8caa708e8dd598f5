"""Exceptions: one class per kind of error of the library."""

from __future__ import annotations

import sys


class StickslipError(Exception):
    """An error of the library.

    Attributes:
        message: One line that says what is wrong, with numbers.
        kind: The name of the error among those of its class.

    The numbers of the message are attributes, too, such as `what`, `value`, `requirement`, `vertex`, `dt` or `time`.
    """

    def __init__(self, message: str, kind: str = "") -> None:
        super().__init__(message)
        self.message = message
        self.kind = kind

    def __reduce__(self) -> tuple[object, ...]:
        return type(self), (self.message, self.kind), self.__dict__


class SceneError(StickslipError, ValueError):
    """Parameters, loads or initial values that do not make a scene."""


class FrictionLawError(SceneError):
    """A friction law with a parameter out of its range, or that violates its contract."""


class StateLawError(SceneError):
    """A state law with a parameter out of its range, or that violates its contract."""


class FaultError(SceneError):
    """Cells or a medium that do not make a fault, or points off one that cannot be receivers."""


class FileError(StickslipError, ValueError):
    """A file that is not in its format. `path` is its name and `line` the number of the wrong line."""


class FitError(StickslipError, ValueError):
    """A record that cannot be fitted, or a fit without a minimum."""


class MeshError(StickslipError, ValueError):
    """A file that cannot be read as a mesh."""


class StepError(StickslipError, ArithmeticError):
    """A step that failed. `step` is its number and `time` its end [s]; `partial` has the run up to there.

    Where it failed at a vertex of a contact, `contact` is the number of the contact, `point` the position [m] and `cell`
    the row and the column of a plane of cells; each is None where it is unknown.
    """


class ArgumentError(StickslipError):
    """An argument that is none of its kind. `argument` is its name."""

    argument: str | None = None

    def add_note(self, note: str) -> None:
        """Takes the name of the argument, which the binding adds as a note, into the message."""
        begin, _, name = note.partition("'")
        if begin != "while processing " or self.argument is not None:
            if sys.version_info >= (3, 11):
                super().add_note(note)
            return
        self.argument = name.rstrip("'")
        self.message = f"{self.argument}: {self.message}"
        self.args = (self.message, *self.args[1:])


class ArgumentTypeError(ArgumentError, TypeError):
    """An argument of a wrong type."""


class ArgumentValueError(ArgumentError, ValueError):
    """An argument whose value its type does not have, such as a negative number of cells."""
