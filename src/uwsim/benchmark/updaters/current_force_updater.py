"""currentForceUpdater: a current that grows from level to level.

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

import numpy as np

from ...currents import (
    MAX_SPEED,
    MIN_PERIOD,
    LateCurrent,
    Place,
    TargetCurrent,
    UwsimSinusoidSpec,
)
from ...errors import BadSetting, UnknownName
from ...messages import Empty, Vector3, Wrench, WrenchStamped, header
from ...schema import Original, Spec, element
from ...world import Flow, Stage
from .sweep import SweepSpec
from .updater import SceneUpdater

STILL_WATER = 2.0
"""After each change of level there is no current for so long [s]."""
MAX_OFFSET = 3600.0
"""A clock may not begin earlier than this: all its random factors would have to be drawn [s]."""
RESET = "dynamics/reset"
"""The service called when a level begins, if it exists."""
FORCE_TOPIC = "currentForce"
FORCE_RATE = 100.0
"""Of the messages on it [Hz]."""
DRAG = 500.0 * 0.82
"""Half the density of water, times the drag coefficient of a cube, times 1 m2 [kg/m]."""


@dataclass(frozen=True, kw_only=True)
class SphericalSpec(Spec):
    """A value for each of the two angles of the current's direction."""

    theta: float
    """Of the polar angle from z of L."""
    phi: float
    """Of the azimuth from y of L towards -x."""


@dataclass(frozen=True, kw_only=True)
class CurrentForceUpdaterSpec(SweepSpec):
    """A ``<currentForceUpdater>`` element. The number of levels is counted in float64."""

    name: ClassVar[str] = "current"
    unit: ClassVar[str] = "m/s"

    initial_value: float = element(
        original=Original(aliases=("initialCurrent",)), minimum=-MAX_SPEED, maximum=MAX_SPEED
    )
    """Speed of the current in the first level [m/s]."""
    final_value: float = element(
        original=Original(aliases=("finalCurrent",)), minimum=-MAX_SPEED, maximum=MAX_SPEED
    )
    """Speed that is not exceeded [m/s]."""
    spherical_direction: SphericalSpec
    """Its direction [rad]."""
    force_variation: float = element(minimum=-MAX_SPEED, maximum=MAX_SPEED)
    """Amplitude of its swelling [m/s]."""
    force_period: float = element(minimum=MIN_PERIOD)
    """Period of its swelling [s]."""
    direction_variation: SphericalSpec
    """Amplitudes of its turning [rad]."""
    direction_period: SphericalSpec
    """Periods of its turning [s]."""
    random: float = element(minimum=0.0, maximum=10.0)
    """Half-width of the uniform noise, relative."""
    step: float = element(above=0.0)
    """What each level adds [m/s]."""
    target: str = element(refers_to="vehicle")
    """Name of the vehicle that is put back when a level begins."""
    publish_as_force: bool = element(default=False, attribute=True)
    """Whether the current is published as a force instead of moving the vehicle."""
    time_offset: float = element(
        default=0.0, attribute=True, namespaced=True, minimum=0.0, maximum=MAX_OFFSET
    )
    """What the current's clock shows when a level begins [s] (``u:timeOffset``)."""

    def current(self, value: float) -> UwsimSinusoidSpec:
        """Return the current of a level.

        Raises:
            BadSetting: the direction is to turn with a period that is not above 0.
        """
        periods = {}
        for angle in ("theta", "phi"):
            period = getattr(self.direction_period, angle)
            if period < MIN_PERIOD and getattr(self.direction_variation, angle) != 0.0:
                raise BadSetting(
                    f"<directionPeriod> has {angle} {period:g}; expected a number >= "
                    f"{MIN_PERIOD:g} [s], as <directionVariation> lets {angle} turn."
                )
            periods[angle] = period if period >= MIN_PERIOD else 1.0
        return UwsimSinusoidSpec(
            speed=value,
            speed_variation=self.force_variation,
            speed_period=self.force_period,
            theta=self.spherical_direction.theta,
            theta_variation=self.direction_variation.theta,
            theta_period=periods["theta"],
            phi=self.spherical_direction.phi,
            phi_variation=self.direction_variation.phi,
            phi_period=periods["phi"],
            random=self.random,
        )

    def bind(self, stage: Stage) -> CurrentForceUpdater:
        """Find the vehicle; raises UnknownName if it is not there."""
        if self.target not in stage.vehicles:
            raise UnknownName("vehicle", self.target, stage.vehicles)
        self.current(self.initial)
        return CurrentForceUpdater(stage, self)


class CurrentForceUpdater(SceneUpdater):
    """Each step puts the vehicle back; after 2 s of still water the level's current flows.

    As in the original, the first level of a sequence is no step: the vehicle stays where it is and
    the current flows at once. Before it there is none.

    The current's time and its random factors begin with the level, so that a level does not depend
    on those before it. (In the original both ran on through the levels, from the clock.)

    Compatibility ``current-target``: the current moves the target alone, not all that floats.
    """

    def __init__(self, stage: Stage, spec: CurrentForceUpdaterSpec) -> None:
        self._stage, self._spec = stage, spec
        self._force: ForcePublisher | None = None

    def apply(self, value: float) -> None:
        """Put the vehicle back and let a current of ``value`` [m/s] flow in 2 s."""
        self._stage.put_back(self._spec.target)
        self._flow(value, delay=STILL_WATER)
        if self._stage.bus.services.is_offered(RESET):
            self._stage.bus.services.call(RESET, Empty())

    def begin(self, value: float) -> None:
        """Let a current of ``value`` [m/s] flow."""
        self._flow(value, delay=0.0)

    def ramp(self, value: float) -> None:
        """Hold the vehicle in its place: else the level would begin with a jump in the image."""
        self._stage.put_back(self._spec.target)

    def _flow(self, value: float, *, delay: float) -> None:
        stage, spec = self._stage, self._spec
        steady = spec.current(value).bind(Place(stream=stage.stream))
        offset = spec.time_offset
        current = LateCurrent(steady, began=stage.time, delay=delay, offset=offset)
        if not spec.publish_as_force:
            alone = "current-target" in stage.world.compatibility
            stage.set_current(TargetCurrent(current, spec.target) if alone else current)
        elif self._force is None:
            self._force = ForcePublisher(stage, current)
        else:
            self._force.current = current


class ForcePublisher:
    r"""Publishes the force of a current on ``currentForce`` at 100 Hz, instead of moving the water.

    .. math:: f_i = \tfrac{1}{2} \rho\, C_d A\; v_i |v_i|, \quad
        \rho = 1000,\ C_d = 0.82,\ A = 1

    along each axis of L (``frame_id`` "Currents"), torque 0. It serves dynamics nodes without a
    current of their own. With the compatibility ``current-force`` it is :math:`v_i^2` as in the
    original, which loses the sign. Not modelled: the vehicle's own velocity and shape.
    """

    def __init__(self, stage: Stage, current: Flow) -> None:
        self.current = current
        """The current as of now."""
        self._stage = stage
        self._is_signless = "current-force" in stage.world.compatibility
        self._publish = stage.bus.publisher(FORCE_TOPIC, WrenchStamped)
        stage.create_timer(FORCE_RATE, self._say)

    def _say(self) -> None:
        time = self._stage.time
        v = self.current.velocity(np.zeros((1, 3)), time)[0]  # (3,) [m/s]
        force = DRAG * v * (v if self._is_signless else np.abs(v))  # (3,) [N]
        x, y, z = force.tolist()
        wrench = Wrench(force=Vector3(x=x, y=y, z=z), torque=Vector3(x=0.0, y=0.0, z=0.0))
        self._publish(WrenchStamped(header=header(time, "Currents"), wrench=wrench))
