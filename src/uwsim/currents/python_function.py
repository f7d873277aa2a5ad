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
from .current import MAX_SPEED, Current, CurrentSpec, Place

Function = Callable[[Array, float, str], Sequence[float]]


@dataclass(frozen=True, kw_only=True)
class PythonFunctionSpec(CurrentSpec):
    """A ``<u:pythonFunction>``: the velocity that a user-supplied function returns."""

    function: str = element(namespaced=True)
    """``module:function``."""

    def bind(self, place: Place) -> PythonFunction:
        """Import the module: its code runs here.

        Where no code may run it is only looked for, and the water of it is still.

        Raises:
            BadSetting: there is no such module, or no such function in it.
        """
        if not place.runs_code:
            self.look_up()
            return PythonFunction(self.function, still)
        module_name, name = self._names()
        try:
            module = importlib.import_module(module_name)
        except ModuleNotFoundError as error:
            raise self._lost(error.name) from error
        except (Exception, SystemExit) as error:  # whatever a third-party module raises
            raise BadSetting(
                f"<u:function> is {self.function!r}; its module raised {_returned(error)}"
            ) from error
        function = getattr(module, name, None)
        if not callable(function):
            known = [each for each in dir(module) if callable(getattr(module, each))]
            raise BadSetting(
                f"<u:function> is {self.function!r}; {module_name} has no function {name!r}."
                f"{did_you_mean(name, known)}"
            )
        return PythonFunction(self.function, function)

    def look_up(self) -> str:
        """Locate the module without running it.

        Raises:
            BadSetting: it is not on Python's path.
        """
        try:
            return find_module_file(self._names()[0])
        except ModuleNotFoundError as error:
            raise self._lost(error.name) from error

    @property
    def code(self) -> str:
        """The module and function that it runs."""
        return self.function

    def files(self, place: Place) -> dict[str, Path]:
        """The file of the module and those that it imports, once it is imported."""
        module = self._names()[0]
        return find_sources(module) if module in sys.modules else {}

    def _lost(self, module: str | None) -> BadSetting:
        return BadSetting(
            f"<u:function> is {self.function!r}; there is no module {module!r} on Python's path "
            "(PYTHONPATH adds folders to it)."
        )

    def _names(self) -> tuple[str, str]:
        """Module and function."""
        module, _, name = self.function.partition(":")
        if not name.isidentifier() or not all(part.isidentifier() for part in module.split(".")):
            raise BadSetting(f"<u:function> is {self.function!r}; expected 'module:function'.")
        return module, name


def still(point: Array, time: float, vehicle: str) -> tuple[float, float, float]:
    """Still water, in place of a function that may not run."""
    return 0.0, 0.0, 0.0


class PythonFunction(Current):
    """What ``function(point, time, vehicle)`` returns: three numbers, the velocity in L [m/s].

    ``point`` is in L, (3,) [m], its own copy; ``time`` is simulation time [s]; ``vehicle`` is the
    name of the vehicle whose part is there, ``""`` for a loose object. The function is called at
    every step for every body that the water acts on: once for the velocity, twice for the
    acceleration and six times for shear, so its cost is the simulation's. A result is repeatable
    only if it depends on its arguments alone.
    """

    def __init__(self, name: str, function: Function) -> None:
        self._name, self._function = name, function

    def velocity(self, points: Array, time: float, vehicles: Sequence[str] = ()) -> Array:
        """Return the velocity of the water, in L, (n, 3) [m/s].

        Raises:
            BadSetting: the function raised, or returned something else than three numbers up to
                `MAX_SPEED`.
        """
        names = vehicles if len(vehicles) else [""] * len(points)
        velocities = np.empty((len(points), 3))
        for i, (point, vehicle) in enumerate(zip(points, names, strict=True)):
            velocities[i] = self._ask(point, time, vehicle)
        return velocities

    def _ask(self, point: Array, time: float, vehicle: str) -> tuple[float, float, float]:
        try:
            returned = self._function(point.copy(), time, vehicle)
        except (Exception, SystemExit) as error:  # errors of the third-party function
            raise BadSetting(
                f"The current {self._name!r} raised {_place(point, time)}: {_returned(error)}"
            ) from error
        try:
            x, y, z = (float(value) for value in returned)
        except Exception:  # a third-party object may raise anything in __float__
            x = y = z = math.nan
        if not (abs(x) <= MAX_SPEED and abs(y) <= MAX_SPEED and abs(z) <= MAX_SPEED):
            raise BadSetting(
                f"The current {self._name!r} returned {short_repr(returned)} {_place(point, time)}"
                f"; expected three numbers from -{MAX_SPEED:g} to {MAX_SPEED:g} [m/s]."
            )
        return x, y, z


def _place(point: Array, time: float) -> str:
    return f"at {point.tolist()}, {time:g} s"


def _returned(error: BaseException) -> str:
    return f"{type(error).__name__}: {' '.join(str(error).split()):.200}"
