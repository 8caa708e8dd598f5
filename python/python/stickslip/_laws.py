"""Laws of the user whose contract has been checked."""

from __future__ import annotations

import weakref
from typing import Any

_checked: dict[tuple[str, int], weakref.ref[Any]] = {}


def is_checked(kind: str, law: Any) -> bool:
    """Whether this object has been checked as a law of this kind."""
    seen = _checked.get((kind, id(law)))
    return seen is not None and seen() is law


def check(kind: str, law: Any) -> None:
    """Remembers an object while it lives; one that has no weak references is checked each time."""
    key = kind, id(law)
    try:
        _checked[key] = weakref.ref(law, lambda _: _checked.pop(key, None))
    except TypeError:
        pass
