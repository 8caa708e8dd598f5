"""Events of a fault."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from . import _frames, _plain

if TYPE_CHECKING:
    import pandas  # type: ignore[import-untyped, import-not-found, unused-ignore]


class Events(np.ndarray[Any, np.dtype[np.void]]):
    """Events, a structured array with an entry each: onset, arrest [s], origin (the number of the cell), hypocentre [m],
    peak_slip_rate [m/s], cells, area, mean_slip, largest_slip [m], moment, stress_drop [Pa], and pressure_change [Pa], the
    mean change of pore pressure. An event that is under way at the end has nan as its arrest.
    """

    def to_frame(self) -> pandas.DataFrame:
        """A table of pandas with a row per event; the hypocentre has the columns hypocentre_x, hypocentre_y, hypocentre_z."""
        return _frames.columns(self._columns())

    def _columns(self) -> dict[str, Any]:
        table: dict[str, Any] = {}
        plain = np.atleast_1d(np.asarray(self))
        for name in plain.dtype.names or ():
            if plain[name].ndim == 2:
                table |= {f"{name}_{axis}": plain[name][:, k] for k, axis in enumerate("xyz")}
            else:
                table[name] = plain[name]
        return table

    def _repr_html_(self) -> str:
        table = self._columns()
        rows = [tuple(f"{value:.6g}" for value in row) for row in zip(*table.values())]
        return _plain.html(f"{len(rows)} events", tuple(table), rows)


def table(rows: list[tuple[Any, ...]], columns: list[tuple[str, str]]) -> Events:
    """The events of these rows."""
    return np.array(rows, dtype=columns).view(Events)
