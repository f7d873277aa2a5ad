"""Moving water: one file a current. Velocities of several add up."""

from __future__ import annotations

from .constant import Constant, ConstantSpec
from .current import Current, CurrentSpec, Place
from .late import LateCurrent
from .total import TotalCurrent, bind_currents
from .uwsim_sinusoid import UwsimSinusoid, UwsimSinusoidSpec

CURRENTS: dict[str, type[CurrentSpec]] = {
    "constant": ConstantSpec,
    "uwsimSinusoid": UwsimSinusoidSpec,
}
"""Element, without its prefix -> what a file says about it. In alphabetical order."""

__all__ = [
    "CURRENTS",
    "Constant",
    "ConstantSpec",
    "Current",
    "CurrentSpec",
    "LateCurrent",
    "Place",
    "TotalCurrent",
    "UwsimSinusoid",
    "UwsimSinusoidSpec",
    "bind_currents",
]
