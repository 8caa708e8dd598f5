"""Pictures of runs and fits by matplotlib, which is imported on request only.

    from stickslip import plots
    plots.history(run)

Each function draws into `ax`, or into a new figure, and returns the axes.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from ._stickslip import FaultRun, FitResult, LineFault, PlaneFault, SliderRun

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["fault_map", "fit", "history", "phase_plane", "slip_profiles"]

YEAR = 365.25 * 86400.0
DAY = 86400.0
FIELDS = {
    "V": "slip rate [m/s]",
    "slip": "slip [m]",
    "theta": "state [s]",
    "mu": "coefficient of friction",
    "shear_stress": "shear stress [MPa]",
    "normal_stress": "normal stress [MPa]",
    "effective_normal_stress": "effective normal stress [MPa]",
    "pore_pressure": "pore pressure [MPa]",
    "temperature": "temperature [K]",
    "darcy_velocity": "Darcy velocity [m/s]",
    "darcy_velocity_along_strike": "Darcy velocity along strike [m/s]",
    "darcy_velocity_down_dip": "Darcy velocity down dip [m/s]",
    "permeability": "permeability [m$^2$]",
    "porosity_change": "change of porosity",
}


def _axes(ax: Axes | None, rows: int = 1, **options: Any) -> Any:
    if ax is not None and rows == 1:
        return ax
    try:
        from matplotlib import pyplot
    except ImportError:
        raise ImportError("stickslip.plots needs matplotlib: pip install matplotlib") from None
    return pyplot.subplots(rows, layout="constrained", **options)[1]


def _time(t: Any) -> tuple[Any, str]:
    """Times in a unit that suits their range."""
    span = float(t[-1] - t[0])
    for unit, name in ((YEAR, "years"), (DAY, "days")):
        if span > 2.0 * unit:
            return t / unit, f"time [{name}]"
    return t, "time [s]"


def _field(run: SliderRun | FaultRun, name: str) -> Any:
    """A field by its name: moduli of vectors, stresses in MPa."""
    readings = run.readings
    if name not in FIELDS or not (hasattr(run, name) or name in readings):
        known = [known for known in FIELDS if hasattr(run, known) or known in readings]
        raise ValueError(f"field must be one of {', '.join(known)}, is {name!r}")
    values = np.asarray(readings[name] if name in readings else getattr(run, name))
    if values.ndim == 3:
        values = np.linalg.norm(values, axis=-1)
    return values * 1e-6 if name.endswith(("stress", "pressure")) else values


def _modulus(values: Any) -> Any:
    """What a logarithmic axis shows of slip rates; at rest nothing."""
    return np.where(values == 0.0, np.nan, np.abs(values))


def history(run: SliderRun | FaultRun, field: str = "V", *, cell: int | None = None, ax: Axes | None = None) -> Axes:
    """A field over time: of a slider, of one cell of a fault, or the largest of all cells.

    Args:
        field: "V", "slip", "theta", "shear_stress", "normal_stress"; of a slider "mu", too; "pore_pressure",
            "effective_normal_stress" and the readings of fields, such as "temperature".
        cell: the number of a cell.
    """
    values = _field(run, field)
    if values.ndim == 2:
        values = np.abs(values).max(axis=1) if cell is None else values[:, cell]
    ax = _axes(ax)
    times, label = _time(np.asarray(run.t))
    if field in ("V", "theta"):
        ax.semilogy(times, _modulus(values))
    else:
        ax.plot(times, values)
    largest = "largest " if isinstance(run, FaultRun) and cell is None else ""
    ax.set(xlabel=label, ylabel=largest + FIELDS[field], xlim=(times[0], times[-1]))
    return ax


def phase_plane(run: SliderRun, *, ax: Axes | None = None) -> Axes:
    """The coefficient of friction over the slip rate: steady sliding is a straight line, a cycle a loop around it."""
    ax = _axes(ax)
    ax.semilogx(_modulus(np.asarray(run.V)), run.mu)
    ax.plot(np.abs(run.V[0]), run.mu[0], "o", label="start")
    ax.set(xlabel=FIELDS["V"], ylabel=FIELDS["mu"])
    ax.legend()
    return ax


def slip_profiles(
    run: FaultRun,
    fault: LineFault,
    *,
    interval: float = YEAR,
    event_interval: float | None = 1.0,
    event_rate: float = 1e-2,
    ax: Axes | None = None,
) -> Axes:
    """Slip along a line, depth downwards in a half space: a curve per interval, and dense ones in events.

    Args:
        interval: between two curves outside of events [s].
        event_interval: between two curves inside of them [s]; None for none.
        event_rate: largest slip rate in an event [m/s].
    """
    slip, t = _field(run, "slip"), np.asarray(run.t)
    in_event = _field(run, "V").max(axis=1) >= event_rate
    ax = _axes(ax)
    position = np.asarray(fault.centers) * 1e-3
    for during, every, color in ((False, interval, "tab:blue"), (True, event_interval, "tab:red")):
        shown = -np.inf
        label = "in events" if during else "between events"
        for n in np.flatnonzero(in_event == during) if every is not None else ():
            if t[n] - shown >= every:
                shown = t[n]
                ax.plot(slip[n], position, color=color, linewidth=0.7, label=label)
                label = "_"
    where = "distance down dip [km]" if fault.poisson_ratio is not None else "depth [km]"
    below = fault.space == "half"
    ax.set(xlabel=FIELDS["slip"], ylabel=where if below else "position [km]", ylim=(fault.ends[0] * 1e-3, fault.ends[1] * 1e-3))
    if below:
        ax.invert_yaxis()
    if ax.get_legend_handles_labels()[0]:
        ax.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=2, frameon=False)
    return ax


def fault_map(
    run: FaultRun, fault: PlaneFault, field: str = "slip", *, sample: int = -1, ax: Axes | None = None
) -> Axes:
    """A field on a plane at one sample, with a colour bar; slip rates and states by their logarithms.

    Args:
        field: as of `history`.
        sample: its number; by default the last one.
    """
    values = _field(run, field)[sample].reshape(fault.shape)
    ax = _axes(ax)
    logarithmic = field in ("V", "theta")
    (left, right), (top, bottom) = fault.along_strike, fault.down_dip
    shown = np.log10(_modulus(values)) if logarithmic else values
    low, high = _limits(shown, 0.1 if logarithmic else 1e-3 * np.abs(shown).max())
    picture = ax.imshow(
        shown,
        vmin=low,
        vmax=high,
        extent=(left * 1e-3, right * 1e-3, bottom * 1e-3, top * 1e-3),
        aspect="equal",
        interpolation="nearest",
    )
    label = f"log10 of {FIELDS[field]}" if logarithmic else FIELDS[field]
    ax.figure.colorbar(picture, ax=ax, label=label, shrink=0.7)
    times, name = _time(np.asarray([0.0, run.t[sample]]))
    ax.set(xlabel="along strike [km]", ylabel="down dip [km]", title=f"{name[:4]} {times[1]:.4g} {name[6:-1]}")
    return ax


def _limits(values: Any, least: float) -> tuple[float, float]:
    """The range of a colour scale, at least so wide: noise of a uniform field has no colours."""
    low, high = np.nanmin(values), np.nanmax(values)
    wider = max(0.5 * (least - (high - low)), 0.0)
    return float(low - wider), float(high + wider)


def fit(result: FitResult, t: ArrayLike | None = None, mu: ArrayLike | None = None) -> Any:
    """Data as points and the model as a curve, and the residuals below. Returns both axes.

    Args:
        t, mu: the record; by default its samples that were fitted.
    """
    times = result.t if t is None else np.asarray(t)
    data = result.mu + result.residuals if mu is None else np.asarray(mu)
    upper, lower = _axes(None, 2, sharex=True, gridspec_kw={"height_ratios": [3, 1]})
    upper.plot(times, data, ".", color="0.6", markersize=3, label="data")
    upper.plot(result.t, result.mu, color="tab:red", label="model")
    upper.set(ylabel=FIELDS["mu"])
    upper.legend()
    lower.axhline(0.0, color="0.3", linewidth=0.7)
    lower.plot(result.t, result.residuals, ".", color="0.4", markersize=3)
    lower.set(xlabel="time [s]", ylabel="data - model")
    return upper, lower
