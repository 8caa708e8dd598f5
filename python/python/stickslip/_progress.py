"""Progress of a run: a bar of tqdm where it is installed, else a line."""

from __future__ import annotations

import sys
import time
import warnings
from typing import Any

# Between lines of a log [s], which cannot be overwritten.
PAUSE = 5.0


class Progress:
    """Shows the time that a run has reached, of that from `begin` to `end` [s]."""

    def __init__(self, begin: float, end: float) -> None:
        self.begin, self.end, self.reached = begin, end, begin
        self.started = self.shown = time.monotonic()
        self.bar: Any = None
        # A notebook overwrites a line as a terminal does.
        self.overwrites = sys.stderr.isatty() or "ipykernel" in sys.modules
        self.width = 0
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                from tqdm.auto import tqdm  # type: ignore[import-untyped, import-not-found, unused-ignore]

                self.bar = tqdm(total=100.0, bar_format="{l_bar}{bar}| {elapsed}<{remaining}", leave=True)
        except ImportError:
            pass

    def update(self, reached: float) -> None:
        """Shows a time [s]."""
        done = 100.0 * (reached - self.begin) / (self.end - self.begin)
        if self.bar is not None:
            self.bar.n = done
            self.bar.refresh()
        elif self.overwrites or time.monotonic() - self.shown >= PAUSE:
            self.shown = time.monotonic()
            self.line(reached, done)
        self.reached = reached

    def line(self, reached: float, done: float) -> None:
        """Writes the line of a time [s]."""
        spent = time.monotonic() - self.started
        left = f", {spent * (100.0 / done - 1.0):.0f} s left" if done > 0.0 else ""
        text = f"{done:.1f} % ({reached:.6g} of {self.end:.6g} s){left}"
        if self.overwrites:
            self.width = max(self.width, len(text))
            sys.stderr.write(f"\r{text:<{self.width}}")
        else:
            sys.stderr.write(text + "\n")
        sys.stderr.flush()

    def close(self, reached: float) -> None:
        """Shows the time of the end [s]."""
        done = 100.0 * (reached - self.begin) / (self.end - self.begin)
        if self.bar is not None:
            self.bar.n = done
            self.bar.refresh()
            self.bar.close()
        elif self.overwrites or self.shown != self.started:
            self.line(reached, done)
            if self.overwrites:
                sys.stderr.write("\n")
