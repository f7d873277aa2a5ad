"""currentForceUpdater: a current that grows from level to level. Read, not simulated yet.

.. code-block:: xml

    <currentForceUpdater>
      <initialValue>0</initialValue> <finalValue>0.2</finalValue>
      <sphericalDirection> <theta>1.57</theta> <phi>0</phi> </sphericalDirection>
      <forceVariation>0.005</forceVariation> <forcePeriod>4</forcePeriod>
      <directionVariation> <theta>0</theta> <phi>0.7</phi> </directionVariation>
      <directionPeriod> <theta>4</theta> <phi>30</phi> </directionPeriod>
      <random>0.01</random> <step>0.01</step> <interval>120</interval>
      <target>girona500</target>
    </currentForceUpdater>
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from ...dialect import element
from ...world import Stage
from ..not_simulated import NotSimulatedYet
from .updater import SceneUpdater, SceneUpdaterSpec, sweep


@dataclass(frozen=True, kw_only=True)
class SphericalSpec:
    """A value for each of the two angles of the current's direction."""

    theta: float
    """Of the polar angle from z of L."""
    phi: float
    """Of the azimuth from y of L towards -x."""


@dataclass(frozen=True, kw_only=True)
class CurrentForceUpdaterSpec(SceneUpdaterSpec):
    """A ``<currentForceUpdater>`` element. The number of levels is counted in float64."""

    name: ClassVar[str] = "current"
    unit: ClassVar[str] = "m/s"
    is_simulated: ClassVar[bool] = False

    initial_value: float = element(aliases=("initialCurrent",))
    """Speed of the current in the first level [m/s]."""
    final_value: float = element(aliases=("finalCurrent",))
    """Speed that is not exceeded [m/s]."""
    spherical_direction: SphericalSpec
    """Its direction [rad]."""
    force_variation: float
    """Amplitude of its swelling [m/s]."""
    force_period: float = element(above=0.0)
    """Period of its swelling [s]."""
    direction_variation: SphericalSpec
    """Amplitudes of its turning [rad]."""
    direction_period: SphericalSpec
    """Periods of its turning [s]."""
    random: float = element(minimum=0.0)
    """Half-width of the uniform noise, relative."""
    step: float = element(above=0.0)
    """What each level adds [m/s]."""
    interval: float = element(above=0.0)
    """Length of a level [s]."""
    target: str
    """Name of the vehicle."""
    publish_as_force: bool = element(default=False, attribute=True)
    """Whether the current is published as a force instead of moving the vehicle."""

    def values(self) -> tuple[float, ...]:
        """Return the speeds [m/s]."""
        return sweep(self.initial_value, self.final_value, self.step)

    @property
    def seconds_per_level(self) -> float:
        """The interval [s]."""
        return self.interval

    def bind(self, stage: Stage) -> SceneUpdater:
        """Raise NotSimulatedYet."""
        raise NotSimulatedYet("currentForceUpdater")
