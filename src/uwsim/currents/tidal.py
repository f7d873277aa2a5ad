r"""tidal: a current that is the sum of tidal constituents.

.. code-block:: xml

    <u:tidal>
      <u:start>3600</u:start>
      <u:constituent>
        <u:name>M2</u:name>
        <u:semiMajor>0.4</u:semiMajor> <u:semiMinor>-0.05</u:semiMinor>
        <u:inclination>M_PI_4</u:inclination> <u:phase>0</u:phase>
      </u:constituent>
      <u:constituent> <u:name>S2</u:name> <u:semiMajor>0.15</u:semiMajor> </u:constituent>
    </u:tidal>
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np

from ..base.numerics.calls import address_of
from ..base.numerics.memory import carray, pointer
from ..schema import Spec, element
from .compiled import CompiledCurrent
from .current import MAX_SPEED, CurrentSpec, SceneContext
from .flow_function import QUERY, FlowFunction, write_everywhere

DEGREES_PER_HOUR = {"M2": 28.9841042, "S2": 30.0, "K1": 15.0410686, "O1": 13.9430356}
"""The angular rate of each constituent (Doodson) [degrees/h], with periods of 12.4206, 12, 23.9345
and 25.8193 h."""


@dataclass(frozen=True, kw_only=True)
class ConstituentSpec(Spec):
    """A ``<u:constituent>``: the ellipse of the velocity of one tidal constituent."""

    name: Literal["M2", "S2", "K1", "O1"] = element(namespaced=True)
    """The constituent: M2 (principal lunar), S2 (principal solar), K1 (lunisolar diurnal) or O1
    (lunar diurnal)."""
    semi_major: float = element(namespaced=True, minimum=0, maximum=MAX_SPEED)
    """The semi-major axis of the ellipse: the highest speed [m/s]."""
    semi_minor: float = element(namespaced=True, default=0.0, minimum=-MAX_SPEED, maximum=MAX_SPEED)
    """The semi-minor axis of the ellipse: the lowest speed [m/s]. With a negative value the
    velocity turns from y of L towards x, else from x towards y."""
    inclination: float = element(namespaced=True, default=0.0)
    """The angle from the x axis of L to the semi-major axis, positive towards y [rad]."""
    phase: float = element(namespaced=True, default=0.0)
    """The phase lag of the highest speed behind time 0 of the tide [rad]."""

    @property
    def angular_rate(self) -> float:
        """The angular rate of the constituent [rad/s]."""
        return math.radians(DEGREES_PER_HOUR[self.name]) / 3600.0

    @property
    def period(self) -> float:
        """The period of the constituent [s]."""
        return 2.0 * math.pi / self.angular_rate


@dataclass(frozen=True, kw_only=True)
class TidalSpec(CurrentSpec):
    """A ``<u:tidal>``: the sum of the velocities of tidal constituents."""

    start: float = element(namespaced=True, default=0.0)
    """The time of the tide at which the simulation begins [s]."""
    constituents: tuple[ConstituentSpec, ...] = element("constituent", namespaced=True)
    """The tidal constituents."""

    def bind(self, context: SceneContext) -> Tidal:
        """Create the current; ``context`` is not used."""
        return Tidal(self)


TERM = np.dtype(
    [
        ("rate", np.float64),  # the angular rate [rad/s]
        ("lag", np.float64),  # the phase lag [rad]
        ("major", np.float64),  # the semi-major axis [m/s]
        ("minor", np.float64),  # the semi-minor axis [m/s]
        ("cosine", np.float64),  # the cosine of the inclination
        ("sine", np.float64),  # the sine of the inclination
    ]
)
"""The ellipse of one tidal constituent."""
TIDAL = np.dtype([("start", np.float64), ("terms", np.int64), ("n_terms", np.int64)])
"""The parameters of `flow_tidal`: the start [s], the address of records of `TERM`, their number."""


class Tidal(CompiledCurrent):
    r"""A uniform current that is the sum of tidal ellipses.

    .. math:: v = \sum_i R(\alpha_i)
        (a_i \cos(\omega_i t - g_i),\ b_i \sin(\omega_i t - g_i),\ 0)

    in the localized world frame L, with the rotation R about its z axis, the semi-axes a and b, the
    inclination :math:`\alpha`, the angular rate :math:`\omega` and the phase lag g (the usual
    parameters of a tidal ellipse; Foreman, Manual for Tidal Currents Analysis and Prediction,
    1978). M2 and S2 together give the spring-neap cycle of 14.77 days.

    Not modelled: variation in space and with depth, other constituents, nodal corrections, the
    height of the tide. Phase lags refer to time 0 of the tide, not to Greenwich. The x-y plane of L
    is assumed to be horizontal.
    """

    def __init__(self, spec: TidalSpec) -> None:
        terms = np.zeros(len(spec.constituents), TERM)
        for term, part in zip(terms, spec.constituents, strict=True):
            term["rate"], term["lag"] = part.angular_rate, part.phase
            term["major"], term["minor"] = part.semi_major, part.semi_minor
            term["cosine"], term["sine"] = (
                math.cos(part.inclination),
                math.sin(part.inclination),
            )
        row = np.zeros(1, TIDAL)
        row["start"], row["terms"], row["n_terms"] = spec.start, address_of(terms), len(terms)
        self._flow = FlowFunction(function=flow_tidal, parameters=row, memory_owners=(terms,))

    @property
    def is_uniform(self) -> bool:
        """True if the velocity is the same at every point; it always is."""
        return True


def flow_tidal(parameters_address: int, query_address: int, time: float) -> None:
    """Evaluate a query of a tidal current; see `uwsim.currents.flow_function`."""
    current = carray(pointer(parameters_address), (1,), TIDAL)[0]
    terms = carray(pointer(current.terms), (current.n_terms,), TERM)
    velocity, acceleration = np.zeros(3), np.zeros(3)
    for i in range(current.n_terms):
        term = terms[i]
        angle = term.rate * (current.start + time) - term.lag
        cosine, sine = math.cos(angle), math.sin(angle)
        major_part, minor_part = term.major * cosine, term.minor * sine
        velocity[0] += major_part * term.cosine - minor_part * term.sine
        velocity[1] += major_part * term.sine + minor_part * term.cosine
        major_part, minor_part = -term.rate * term.major * sine, term.rate * term.minor * cosine
        acceleration[0] += major_part * term.cosine - minor_part * term.sine
        acceleration[1] += major_part * term.sine + minor_part * term.cosine
    write_everywhere(carray(pointer(query_address), (1,), QUERY)[0], velocity, acceleration)
