"""A water flow defined by the user's Python program, with checks of the values that it returns.

L is the localized world, the frame of the scene file.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager

import numpy as np

from ...base.geometry import Array
from ...currents.current import Current, flow_function_of
from ...currents.flow_function import FlowFunction
from ...errors import BadSetting, UwsimError, short_repr, type_and_text
from ...world import Flow


class UserFlow(Current):
    """A `Flow` object of the user's Python program; error messages name its class.

    The arguments ``vehicles`` are as in `uwsim.world.Flow`.

    Args:
        flow: the object of the user's program.

    Raises:
        BadSetting: ``is_uniform`` or ``is_still`` of the flow raises.
    """

    def __init__(self, flow: Flow) -> None:
        self._flow = flow
        with self._name_flow_in_errors(""):
            self._is_uniform, self._is_still = bool(flow.is_uniform), bool(flow.is_still)

    @property
    def is_uniform(self) -> bool:
        """True if the velocity is the same at all positions."""
        return self._is_uniform

    @property
    def is_still(self) -> bool:
        """True if the velocity is always zero."""
        return self._is_still

    def flow_function(self, vehicles: Sequence[str]) -> FlowFunction | None:
        """Return the compiled function of the flow.

        None if the flow is not one of uwsim's own currents, or only Python can evaluate it.
        """
        return flow_function_of(self._flow, vehicles)

    def velocity(self, points: Array, time: float, vehicles: Sequence[str] = ()) -> Array:
        """Return the velocity of the water at points of L, (n, 3) [m/s].

        Raises:
            BadSetting: the flow raised an exception, or returned another type or shape.
        """
        return self._call_method(self._flow.velocity, points, time, vehicles)

    def acceleration(self, points: Array, time: float, vehicles: Sequence[str] = ()) -> Array:
        """Return the acceleration of the water at points of L, (n, 3) [m/s2]."""
        return self._call_method(self._flow.acceleration, points, time, vehicles)

    def motion(
        self, points: Array, time: float, vehicles: Sequence[str] = ()
    ) -> tuple[Array, Array]:
        """Return the velocity and the acceleration of the water at points of L."""
        with self._name_flow_in_errors(f" at {time:.6g} s"):
            result = self._flow.motion(points, time, vehicles)
            if not isinstance(result, tuple | list) or len(result) != 2:
                raise self._return_error("motion", result, time, "a velocity and an acceleration")
            velocity, acceleration = (
                self._check_vectors("motion", vectors, points, time) for vectors in result
            )
            return velocity, acceleration

    def _call_method(
        self, method: Callable[..., Array], points: Array, time: float, vehicles: Sequence[str]
    ) -> Array:
        with self._name_flow_in_errors(f" at {time:.6g} s"):
            return self._check_vectors(
                method.__name__, method(points, time, vehicles), points, time
            )

    def _check_vectors(self, method: str, result: object, points: Array, time: float) -> Array:
        """Copy the vectors that the flow returned; raise BadSetting if they are invalid."""
        vectors = np.array(result)
        if vectors.shape != points.shape or vectors.dtype.kind not in "iuf":
            raise self._return_error(method, result, time, f"numbers of the shape {points.shape}")
        return vectors.astype(np.float64, copy=False)

    def _return_error(self, method: str, result: object, time: float, expected: str) -> BadSetting:
        kind = type(self._flow).__name__
        return BadSetting(
            f"set_current: {kind}.{method} returned {short_repr(result)} at {time:.6g} s; "
            f"expected {expected}."
        )

    @contextmanager
    def _name_flow_in_errors(self, time_text: str) -> Iterator[None]:
        """Convert exceptions in this block to BadSetting with the name of the flow's class."""
        try:
            yield
        except UwsimError:
            raise
        except (Exception, SystemExit) as error:  # errors of third-party code
            kind, text = type(self._flow).__name__, type_and_text(error)
            raise BadSetting(f"set_current: {kind} raised {text}{time_text}.") from error
