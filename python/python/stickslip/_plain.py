"""Objects as what they were given: pickles and text."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from typing import Any


def rebuild(cls: type[Any], given: dict[str, Any]) -> Any:
    """The object of a class that was made of these arguments."""
    return cls(**given)


def receivers(fault: Any, given: dict[str, Any]) -> Any:
    """The points off a fault that its method made of these arguments, without those that are None."""
    return fault.receivers(**{key: value for key, value in given.items() if value is not None})


def short(value: Any) -> str:
    """A value on one line: long arrays by their shape, times and stresses by seven digits."""
    shape = getattr(value, "shape", None)
    if shape:
        return f"<array of {' x '.join(map(str, shape))}>"
    if isinstance(value, float):
        return f"{value:.7g}"
    text = repr(value)
    if len(text) <= 80:
        return text
    return f"<{type(value).__name__} of {len(value)}>" if hasattr(value, "__len__") else text[:77] + "..."


def call(name: str, given: dict[str, Any]) -> str:
    """The call that makes an object, without arguments that are None."""
    arguments = (f"{key}={short(value)}" for key, value in given.items() if value is not None)
    return f"{name}({', '.join(arguments)})"


def table(name: str, given: dict[str, Any]) -> str:
    """The arguments of an object as a table of HTML."""
    rows = [(key, short(value)) for key, value in given.items() if value is not None]
    return html(name, ("argument", "value"), rows)


def html(title: str, head: tuple[str, ...], rows: Sequence[tuple[str, ...]]) -> str:
    """A table of HTML."""
    body = "".join(f"<tr>{_cells('td', row)}</tr>" for row in rows)
    return f"<table><caption>{escape(title)}</caption><thead><tr>{_cells('th', head)}</tr></thead><tbody>{body}</tbody></table>"


def _cells(tag: str, row: tuple[str, ...]) -> str:
    return "".join(f"<{tag}>{escape(cell)}</{tag}>" for cell in row)


def _arrays(name: str, value: Any) -> list[tuple[str, Any]]:
    """An array with its name, or those of a dictionary with theirs."""
    return list(value.items()) if isinstance(value, dict) else [(name, value)]


def ranges(name: str, fields: dict[str, Any]) -> str:
    """The ranges of the arrays of a run as a table of HTML."""
    rows = []
    flat = {name: field for key, value in fields.items() for name, field in _arrays(key, value)}
    for key, value in flat.items():
        if getattr(value, "ndim", 0) and value.size and value.dtype.names is None:
            rows.append((key, " x ".join(map(str, value.shape)), f"{value.min():.6g}", f"{value.max():.6g}"))
    return html(name, ("array", "shape", "smallest", "largest"), rows)


def fit(given: dict[str, Any]) -> str:
    """A table of HTML of the parameters of a fit."""
    parameters, errors = given["parameters"], given["errors"]
    rows = [(name, f"{value:.6g}", f"{errors[name]:.2g}") for name, value in parameters.items()]
    rows += [("warning", text, "") for text in given["warnings"]]
    return html(f"Fit: residuals of {given['rms']:.3g}", ("parameter", "value", "standard error"), rows)
