"""The flow of water that a program has set."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager

import numpy as np

from ...base.geometry import Array
from ...currents.current import Current, compiled
from ...currents.flow_function import FlowFunction
from ...errors import BadSetting, UwsimError, short_repr, type_and_text
from ...world import Flow


class ProgramFlow(Current):
    """A flow of a program's own class, whose name is in the errors about it.

    Args:
        flow: what the program has made.

    Raises:
        BadSetting: it does not answer whether it is uniform or still.
    """

    def __init__(self, flow: Flow) -> None:
        self._flow = flow
        with self._names_flow(""):
            self._is_uniform, self._is_still = bool(flow.is_uniform), bool(flow.is_still)

    @property
    def is_uniform(self) -> bool:
        """Whether it is the same everywhere."""
        return self._is_uniform

    @property
    def is_still(self) -> bool:
        """Whether it never moves at all."""
        return self._is_still

    def compiled(self, vehicles: Sequence[str]) -> FlowFunction | None:
        """Return the function of a current of uwsim's own; None of any other flow."""
        return compiled(self._flow, vehicles)

    def velocity(self, points: Array, time: float, vehicles: Sequence[str] = ()) -> Array:
        """Return the velocity of the water, in L, (n, 3) [m/s].

        Raises:
            BadSetting: the flow raised, or returned something else.
        """
        return self._vectors(self._flow.velocity, points, time, vehicles)

    def acceleration(self, points: Array, time: float, vehicles: Sequence[str] = ()) -> Array:
        """Return the acceleration of the water, in L, (n, 3) [m/s2]; raises as `velocity` does."""
        return self._vectors(self._flow.acceleration, points, time, vehicles)

    def motion(
        self, points: Array, time: float, vehicles: Sequence[str] = ()
    ) -> tuple[Array, Array]:
        """Return velocity and acceleration; raises as `velocity` does."""
        with self._names_flow(f" at {time:.6g} s"):
            answer = self._flow.motion(points, time, vehicles)
            if not isinstance(answer, tuple | list) or len(answer) != 2:
                raise self._wrong("motion", answer, time, "a velocity and an acceleration")
            velocity, acceleration = (
                self._checked("motion", each, points, time) for each in answer
            )
            return velocity, acceleration

    def _vectors(
        self, method: Callable[..., Array], points: Array, time: float, vehicles: Sequence[str]
    ) -> Array:
        with self._names_flow(f" at {time:.6g} s"):
            return self._checked(method.__name__, method(points, time, vehicles), points, time)

    def _checked(self, method: str, answer: object, points: Array, time: float) -> Array:
        """Return vectors of the flow as an array of the caller's own."""
        vectors = np.array(answer)
        if vectors.shape != points.shape or vectors.dtype.kind not in "iuf":
            raise self._wrong(method, answer, time, f"numbers of the shape {points.shape}")
        return vectors.astype(np.float64, copy=False)

    def _wrong(self, method: str, answer: object, time: float, expected: str) -> BadSetting:
        kind = type(self._flow).__name__
        return BadSetting(
            f"set_current: {kind}.{method} returned {short_repr(answer)} at {time:.6g} s; "
            f"expected {expected}."
        )

    @contextmanager
    def _names_flow(self, when: str) -> Iterator[None]:
        """Let what is raised in this block name the class of the flow."""
        try:
            yield
        except UwsimError:
            raise
        except (Exception, SystemExit) as error:  # errors of third-party code
            raise BadSetting(
                f"set_current: {type(self._flow).__name__} raised {type_and_text(error)}{when}."
            ) from error
