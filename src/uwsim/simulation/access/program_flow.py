"""The flow of water that a program sets."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager

import numpy as np

from ...base.geometry import Array
from ...currents.current import Current, flow_function_of
from ...currents.flow_function import FlowFunction
from ...errors import BadSetting, UwsimError, short_repr, type_and_text
from ...world import Flow


class ProgramFlow(Current):
    """A flow of a class of the program, which errors name.

    Args:
        flow: the flow of the program.

    Raises:
        BadSetting: ``is_uniform`` or ``is_still`` of the flow raises.
    """

    def __init__(self, flow: Flow) -> None:
        self._flow = flow
        with self._name_flow_in_errors(""):
            self._is_uniform, self._is_still = bool(flow.is_uniform), bool(flow.is_still)

    @property
    def is_uniform(self) -> bool:
        """The velocity is the same at all positions."""
        return self._is_uniform

    @property
    def is_still(self) -> bool:
        """The velocity is always zero."""
        return self._is_still

    def flow_function(self, vehicles: Sequence[str]) -> FlowFunction | None:
        """Return the compiled function of a current of uwsim; None for any other flow."""
        return flow_function_of(self._flow, vehicles)

    def velocity(self, points: Array, time: float, vehicles: Sequence[str] = ()) -> Array:
        """Return the velocity of the water in L, (n, 3) [m/s].

        Raises:
            BadSetting: the flow raised, or returned another type or shape.
        """
        return self._call_method(self._flow.velocity, points, time, vehicles)

    def acceleration(self, points: Array, time: float, vehicles: Sequence[str] = ()) -> Array:
        """Return the acceleration of the water in L, (n, 3) [m/s2]; raises as `velocity` does."""
        return self._call_method(self._flow.acceleration, points, time, vehicles)

    def motion(
        self, points: Array, time: float, vehicles: Sequence[str] = ()
    ) -> tuple[Array, Array]:
        """Return velocity and acceleration; raises as `velocity` does."""
        with self._name_flow_in_errors(f" at {time:.6g} s"):
            answer = self._flow.motion(points, time, vehicles)
            if not isinstance(answer, tuple | list) or len(answer) != 2:
                raise self._return_error("motion", answer, time, "a velocity and an acceleration")
            velocity, acceleration = (
                self._check_vectors("motion", vectors, points, time) for vectors in answer
            )
            return velocity, acceleration

    def _call_method(
        self, method: Callable[..., Array], points: Array, time: float, vehicles: Sequence[str]
    ) -> Array:
        with self._name_flow_in_errors(f" at {time:.6g} s"):
            return self._check_vectors(
                method.__name__, method(points, time, vehicles), points, time
            )

    def _check_vectors(self, method: str, answer: object, points: Array, time: float) -> Array:
        """Return vectors of the flow as a new array; raise BadSetting if they are invalid."""
        vectors = np.array(answer)
        if vectors.shape != points.shape or vectors.dtype.kind not in "iuf":
            raise self._return_error(method, answer, time, f"numbers of the shape {points.shape}")
        return vectors.astype(np.float64, copy=False)

    def _return_error(self, method: str, answer: object, time: float, expected: str) -> BadSetting:
        kind = type(self._flow).__name__
        return BadSetting(
            f"set_current: {kind}.{method} returned {short_repr(answer)} at {time:.6g} s; "
            f"expected {expected}."
        )

    @contextmanager
    def _name_flow_in_errors(self, time_text: str) -> Iterator[None]:
        """Make exceptions of this block name the class of the flow."""
        try:
            yield
        except UwsimError:
            raise
        except (Exception, SystemExit) as error:  # errors of third-party code
            kind, text = type(self._flow).__name__, type_and_text(error)
            raise BadSetting(f"set_current: {kind} raised {text}{time_text}.") from error
