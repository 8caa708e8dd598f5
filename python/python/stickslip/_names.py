"""Parameters by their names."""

from __future__ import annotations

OTHERS = {"b": "b1", "L": "L1", "Vc": "Vc1", "c": "c1", "Dc": "L1", "D_c": "L1", "Dc1": "L1", "Dc2": "L2", "D_c1": "L1", "D_c2": "L2"}


class Parameters(dict[str, float]):
    """Values by the name of the parameter; "b", "L", "Vc" and "c" are of the first state, and "Dc" is "L"."""

    def __missing__(self, name: str) -> float:
        other = OTHERS.get(name)
        if other is not None and other in self:
            return self[other]
        raise KeyError(f"{name!r} is none of {', '.join(self)}")
