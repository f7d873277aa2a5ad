r"""pythonFunction: a current computed by a user-supplied function.

.. code-block:: xml

    <u:pythonFunction> <u:function>my_water:eddy</u:function> </u:pythonFunction>

with, in ``my_water.py`` on Python's path::

    def eddy(point, time, vehicle):
        x, y, z = point
        return -0.1 * y, 0.1 * x, 0.0
"""

from __future__ import annotations

import importlib
import math
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..base.files.modules import find_module_file
from ..base.files.python_sources import find_sources
from ..base.geometry import Array
from ..errors import BadSetting, did_you_mean, short_repr
from ..schema import element
from .current import MAX_SPEED, Current, CurrentSpec, SceneContext

Function = Callable[[Array, float, str], Sequence[float]]


@dataclass(frozen=True, kw_only=True)
class PythonFunctionSpec(CurrentSpec):
    """A ``<u:pythonFunction>``: the velocity that a user-supplied function returns."""

    function: str = element(namespaced=True)
    """The function, as ``module:function``."""

    def bind(self, context: SceneContext) -> PythonFunction:
        """Import the module, which runs its code.

        If `SceneContext.runs_code` is False, only locate the module; the current is then zero.

        Raises:
            BadSetting: there is no such module, or no such function in it.
        """
        if not context.runs_code:
            self.look_up()
            return PythonFunction(self.function, still_water)
        module_name, name = self._names()
        try:
            module = importlib.import_module(module_name)
        except ModuleNotFoundError as error:
            raise self._missing_module(error.name) from error
        except (Exception, SystemExit) as error:  # whatever a third-party module raises
            raise BadSetting(
                f"<u:function> is {self.function!r}; its module raised {_error_text(error)}"
            ) from error
        function = getattr(module, name, None)
        if not callable(function):
            function_names = [member for member in dir(module) if callable(getattr(module, member))]
            raise BadSetting(
                f"<u:function> is {self.function!r}; {module_name} has no function {name!r}."
                f"{did_you_mean(name, function_names)}"
            )
        return PythonFunction(self.function, function)

    def look_up(self) -> str:
        """Return the file of the module without running it.

        Raises:
            BadSetting: the module is not on Python's path.
        """
        try:
            return find_module_file(self._names()[0])
        except ModuleNotFoundError as error:
            raise self._missing_module(error.name) from error

    @property
    def code(self) -> str:
        """The function that the current calls, as ``module:function``."""
        return self.function

    def files(self, context: SceneContext) -> dict[str, Path]:
        """Return the files of the module and its imports; empty before the module is imported."""
        module = self._names()[0]
        return find_sources(module) if module in sys.modules else {}

    def _missing_module(self, module: str | None) -> BadSetting:
        return BadSetting(
            f"<u:function> is {self.function!r}; there is no module {module!r} on Python's path "
            "(PYTHONPATH adds folders to it)."
        )

    def _names(self) -> tuple[str, str]:
        """Return the names of the module and of the function."""
        module, _, name = self.function.partition(":")
        if not name.isidentifier() or not all(part.isidentifier() for part in module.split(".")):
            raise BadSetting(f"<u:function> is {self.function!r}; expected 'module:function'.")
        return module, name


def still_water(point: Array, time: float, vehicle: str) -> tuple[float, float, float]:
    """Return zero velocity; replaces a user-supplied function that may not run."""
    return 0.0, 0.0, 0.0


class PythonFunction(Current):
    """The current of a user-supplied ``function(point, time, vehicle)``.

    ``point`` is a copy of the point in L, (3,) [m]; ``time`` is the simulation time [s];
    ``vehicle`` is the name of the vehicle to which the body at the point belongs, ``""`` for a
    loose object. The function returns the velocity in L [m/s]. It is called in every step for every
    body that the water acts on: once for the velocity, twice for the acceleration and six times for
    the shear. A slow function therefore slows the simulation. A run is repeatable only if the
    function depends on its arguments alone.
    """

    def __init__(self, name: str, function: Function) -> None:
        self._name, self._function = name, function

    def velocity(self, points: Array, time: float, vehicles: Sequence[str] = ()) -> Array:
        """Return the velocity of the water, in L, (n, 3) [m/s].

        Raises:
            BadSetting: the function raised an exception, or did not return three numbers from
                -`MAX_SPEED` to `MAX_SPEED`.
        """
        names = vehicles if len(vehicles) else [""] * len(points)
        velocities = np.empty((len(points), 3))
        for i, (point, vehicle) in enumerate(zip(points, names, strict=True)):
            velocities[i] = self._call_function(point, time, vehicle)
        return velocities

    def _call_function(self, point: Array, time: float, vehicle: str) -> tuple[float, float, float]:
        try:
            result = self._function(point.copy(), time, vehicle)
        except (Exception, SystemExit) as error:  # errors of the third-party function
            raise BadSetting(
                f"The current {self._name!r} raised {_location(point, time)}: {_error_text(error)}"
            ) from error
        try:
            x, y, z = (float(value) for value in result)
        except Exception:  # a third-party object may raise anything in __float__
            x = y = z = math.nan
        if not (abs(x) <= MAX_SPEED and abs(y) <= MAX_SPEED and abs(z) <= MAX_SPEED):
            raise BadSetting(
                f"The current {self._name!r} returned {short_repr(result)} {_location(point, time)}"
                f"; expected three numbers from -{MAX_SPEED:g} to {MAX_SPEED:g} [m/s]."
            )
        return x, y, z


def _location(point: Array, time: float) -> str:
    return f"at {point.tolist()}, {time:g} s"


def _error_text(error: BaseException) -> str:
    return f"{type(error).__name__}: {' '.join(str(error).split()):.200}"
