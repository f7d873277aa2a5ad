"""Water currents, one module for each kind. The velocities of several currents add up.

L is the localized world frame of the scene, W the world frame (z up).
"""

from __future__ import annotations

from .constant import Constant, ConstantSpec
from .current import MAX_SPEED, Current, CurrentSpec, SceneContext
from .delayed import DelayedCurrent
from .field import Field, FieldSpec, Grid, read_grid
from .gauss_markov import GaussMarkov, GaussMarkovSpec
from .profile import (
    Layers,
    LayerSpec,
    LayersSpec,
    LogProfile,
    LogProfileSpec,
    PowerProfile,
    PowerProfileSpec,
)
from .python_function import PythonFunction, PythonFunctionSpec
from .target import TargetCurrent
from .tidal import ConstituentSpec, Tidal, TidalSpec
from .total import TotalCurrent, bind_currents
from .uwsim_sinusoid import MIN_PERIOD, UwsimSinusoid, UwsimSinusoidSpec

CURRENTS: dict[str, type[CurrentSpec]] = {
    "constant": ConstantSpec,
    "field": FieldSpec,
    "gaussMarkov": GaussMarkovSpec,
    "layers": LayersSpec,
    "logProfile": LogProfileSpec,
    "powerProfile": PowerProfileSpec,
    "pythonFunction": PythonFunctionSpec,
    "tidal": TidalSpec,
    "uwsimSinusoid": UwsimSinusoidSpec,
}
"""The spec class of each child element of ``<u:currents>``."""

__all__ = [
    "CURRENTS",
    "MAX_SPEED",
    "MIN_PERIOD",
    "Constant",
    "ConstantSpec",
    "ConstituentSpec",
    "Current",
    "CurrentSpec",
    "DelayedCurrent",
    "Field",
    "FieldSpec",
    "GaussMarkov",
    "GaussMarkovSpec",
    "Grid",
    "LayerSpec",
    "Layers",
    "LayersSpec",
    "LogProfile",
    "LogProfileSpec",
    "PowerProfile",
    "PowerProfileSpec",
    "PythonFunction",
    "PythonFunctionSpec",
    "SceneContext",
    "TargetCurrent",
    "Tidal",
    "TidalSpec",
    "TotalCurrent",
    "UwsimSinusoid",
    "UwsimSinusoidSpec",
    "bind_currents",
    "read_grid",
]
