"""Arguments of functions: lists as well as tuples, and names in messages."""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any, TypeVar, cast

from ._errors import ArgumentTypeError, ArgumentValueError

Function = TypeVar("Function", bound=Callable[..., Any])


def _tuples(name: str, value: Any) -> Any:
    """Pairs that are given as lists or arrays."""
    is_list = isinstance(value, list) or hasattr(value, "tolist")
    if name == "load" and is_list:
        return [tuple(pair) if hasattr(pair, "__len__") else pair for pair in value]
    if name == "window" and is_list:
        return tuple(value)
    if name == "bounds" and isinstance(value, dict):
        return {key: tuple(pair) if isinstance(pair, list) else pair for key, pair in value.items()}
    return value


def named(function: Function) -> Function:
    """A function whose errors of arguments have the name of the argument in their message, not in a note."""

    @functools.wraps(function)
    def call(*args: Any, **kwargs: Any) -> Any:
        try:
            return function(*args, **{name: _tuples(name, value) for name, value in kwargs.items()})
        except (TypeError, ValueError, OverflowError) as error:
            for note in getattr(error, "__notes__", ()):
                if note.startswith("while processing "):
                    kind = ArgumentTypeError if isinstance(error, TypeError) else ArgumentValueError
                    wrong = kind(str(error), "Argument")
                    wrong.add_note(note)
                    raise wrong from None
            raise

    return cast(Function, call)
