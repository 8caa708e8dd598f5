"""Tables of pandas, which is imported on request only."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    import pandas  # type: ignore[import-untyped, import-not-found, unused-ignore]


def _pandas() -> Any:
    try:
        import pandas
    except ImportError:
        raise ImportError("to_frame() needs pandas: pip install pandas") from None
    return pandas


def columns(fields: dict[str, Any]) -> pandas.DataFrame:
    """A column per array of one length."""
    return _pandas().DataFrame({name: np.asarray(values) for name, values in fields.items()})


def cells(fields: dict[str, Any], chosen: Any) -> pandas.DataFrame:
    """A row per sample and cell: the time, the cell, and a column per field or component."""
    times = fields["t"]
    count = fields["theta"].shape[1]
    numbers = np.arange(count) if chosen is None else np.atleast_1d(np.asarray(chosen))
    if numbers.dtype.kind not in "iu" or numbers.ndim != 1 or ((numbers < 0) | (numbers >= count)).any():
        raise ValueError(f"cells must be numbers of cells from 0 to {count - 1}, is {chosen!r}")
    table = {"t": np.repeat(times, len(numbers)), "cell": np.tile(numbers, len(times))}
    names = ["V", "slip", "theta", "shear_stress", "normal_stress"]
    # Of a fault with fields.
    names += ["pore_pressure", "effective_normal_stress", *fields["readings"]] if fields["readings"] else []
    for name in names:
        field = fields["readings"].get(name, fields.get(name))[:, numbers]
        if field.ndim == 2:
            table[name] = field.ravel()
        else:
            for component, direction in enumerate(("strike", "dip")):
                table[f"{name}_{direction}"] = field[..., component].ravel()
    return _pandas().DataFrame(table)


def fit(given: dict[str, Any]) -> pandas.DataFrame:
    """A row per fitted parameter: its value and its standard error."""
    frame = _pandas().DataFrame({"value": given["parameters"], "standard_error": given["errors"]})
    frame.index.name = "parameter"
    return frame
