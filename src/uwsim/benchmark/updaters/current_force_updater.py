"""currentForceUpdater: a current that increases from level to level.

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

L is the localized world frame.
"""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ...currents import MAX_SPEED, DelayedCurrent, SceneContext, TargetCurrent
from ...currents.uwsim_sinusoid import MIN_PERIOD, UwsimSinusoidSpec
from ...errors import BadSetting, UnknownName
from ...messages import Empty, Vector3, Wrench, WrenchStamped, header
from ...schema import Original, Spec, element
from ...world import Flow, Stage
from .sweep import SweepSpec
from .updater import SceneUpdater

STILL_WATER_TIME = 2.0
"""The time without current after each step to a level [s]."""
MAX_OFFSET = 3600.0
"""The greatest time offset [s]; the random factors of all earlier times have to be drawn."""
RESET_SERVICE = "dynamics/reset"
"""The service that is called when a level begins, if it is offered."""
FORCE_TOPIC = "currentForce"
"""The topic on which the force of the current is published (geometry_msgs/WrenchStamped)."""
FORCE_RATE = 100.0
"""The rate of the messages on `FORCE_TOPIC` [Hz]."""
DRAG_FACTOR = 500.0 * 0.82
"""The product of half the density of water, drag coefficient and area, as in UWSim [kg/m]."""


@dataclass(frozen=True, kw_only=True)
class SphericalSpec(Spec):
    """Two numbers, one for each of the two angles of the current's direction."""

    theta: float
    """The number for the polar angle, which is measured from the z axis of L."""
    phi: float
    """The number for the azimuth, which is measured from the y axis of L towards -x."""


@dataclass(frozen=True, kw_only=True)
class CurrentForceUpdaterSpec(SweepSpec):
    """A ``<currentForceUpdater>`` element."""

    name: ClassVar[str] = "current"
    unit: ClassVar[str] = "m/s"

    initial_value: float = element(
        original=Original(aliases=("initialCurrent",)), minimum=-MAX_SPEED, maximum=MAX_SPEED
    )
    """The speed of the current in the first level [m/s]."""
    final_value: float = element(
        original=Original(aliases=("finalCurrent",)), minimum=-MAX_SPEED, maximum=MAX_SPEED
    )
    """The greatest speed of the current in a level [m/s]."""
    spherical_direction: SphericalSpec
    """The mean direction of the current, in L [rad]."""
    force_variation: float = element(minimum=-MAX_SPEED, maximum=MAX_SPEED)
    """The amplitude of the variation of the speed [m/s]."""
    force_period: float = element(minimum=MIN_PERIOD)
    """The period of the variation of the speed [s]."""
    direction_variation: SphericalSpec
    """The amplitudes of the variation of the direction [rad]."""
    direction_period: SphericalSpec
    """The periods of the variation of the direction [s]."""
    random: float = element(minimum=0.0, maximum=10.0)
    """The half-width of the uniform noise, relative to the speed and to each angle."""
    step: float = element(exclusive_minimum=0.0)
    """The increment from level to level [m/s]."""
    target: str = element(refers_to="vehicle")
    """The name of the vehicle whose pose is reset when a level begins."""
    publish_as_force: bool = element(default=False, attribute=True)
    """True if the current is published as a force instead of moving the vehicle."""
    time_offset: float = element(
        default=0.0, attribute=True, namespaced=True, minimum=0.0, maximum=MAX_OFFSET
    )
    """The time of the current's clock when a level begins [s] (``u:timeOffset``)."""

    def current(self, value: float) -> UwsimSinusoidSpec:
        """Return the current with the mean speed ``value`` [m/s].

        Raises:
            BadSetting: the direction varies with a period that is not above 0.
        """
        periods = {}
        for angle in ("theta", "phi"):
            period = getattr(self.direction_period, angle)
            if period < MIN_PERIOD and getattr(self.direction_variation, angle) != 0.0:
                raise BadSetting(
                    f"<directionPeriod> has {angle} {period:g}; expected a number >= "
                    f"{MIN_PERIOD:g} [s], as <directionVariation> varies {angle}."
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

    def flow(
        self,
        value: float,
        stream: Callable[[str], np.random.Generator],
        compatibility: Collection[str],
        *,
        start: float,
        delay: float,
    ) -> Flow:
        """Return the current of a level.

        Args:
            value: the mean speed [m/s].
            stream: returns the random generator of a name.
            compatibility: the names of the active compatibility quirks.
            start: the simulation time at which the level begins [s].
            delay: the time without current from then on [s].
        """
        sinusoid = self.current(value).bind(SceneContext(stream=stream))
        current = DelayedCurrent(sinusoid, start=start, delay=delay, offset=self.time_offset)
        has_target = "current-target" in compatibility and not self.publish_as_force
        return TargetCurrent(current, self.target) if has_target else current

    def bind(self, stage: Stage) -> CurrentForceUpdater:
        """Resolve the vehicle; raises UnknownName if there is none."""
        if self.target not in stage.vehicles:
            raise UnknownName("vehicle", self.target, stage.vehicles)
        self.current(self.first_value)
        return CurrentForceUpdater(stage, self)


class CurrentForceUpdater(SceneUpdater):
    """An updater that resets the vehicle's pose and, 2 s later, starts the current of a level.

    As in the original UWSim, in the first level of a sequence the vehicle keeps its pose and the
    current flows at once. Before the first level there is no current.

    The time and the random factors of the current begin anew with each level, so that a level does
    not depend on earlier levels. (In the original UWSim they depend on the wall clock, and continue
    from level to level.)

    Compatibility ``current-target``: the current moves only the target, not all floating bodies.
    """

    def __init__(self, stage: Stage, spec: CurrentForceUpdaterSpec) -> None:
        self._stage, self._spec = stage, spec
        self._force: ForcePublisher | None = None

    def apply(self, value: float) -> None:
        """Reset the vehicle's pose, and start a current of ``value`` [m/s] in 2 s."""
        self._stage.put_back(self._spec.target)
        self._set_current(value, delay=STILL_WATER_TIME)
        if self._stage.bus.services.is_offered(RESET_SERVICE):
            self._stage.bus.services.call(RESET_SERVICE, Empty())

    def begin(self, value: float) -> None:
        """Start a current of ``value`` [m/s]."""
        self._set_current(value, delay=0.0)

    def ramp(self, value: float) -> None:
        """Hold the vehicle's pose, so that the level does not begin with a jump in the image."""
        self._stage.put_back(self._spec.target)

    def _set_current(self, value: float, *, delay: float) -> None:
        stage, spec = self._stage, self._spec
        world, start = stage.world, stage.time
        current = spec.flow(value, world.stream, world.compatibility, start=start, delay=delay)
        if not spec.publish_as_force:
            stage.set_current(current)
        elif self._force is None:
            self._force = ForcePublisher(stage, current)
        else:
            self._force.current = current


class ForcePublisher:
    r"""A publisher of the force of a current on ``currentForce`` at 100 Hz, in still water.

    .. math:: f_i = \tfrac{1}{2} \rho\, C_d A\; v_i |v_i|, \quad
        \rho = 1000,\ C_d = 0.82,\ A = 1

    along each axis of L (``frame_id`` "Currents"), with the velocity v of the current. The torque
    is 0. The message is for external dynamics nodes that do not model a current. With the
    compatibility ``current-force``, :math:`v_i^2` replaces :math:`v_i |v_i|` as in the original
    UWSim, which loses the sign. Not modelled: the velocity and shape of the vehicle.
    """

    def __init__(self, stage: Stage, current: Flow) -> None:
        self.current = current
        """The present current."""
        self._stage = stage
        self._is_signless = "current-force" in stage.world.compatibility
        self._publish = stage.bus.publisher(FORCE_TOPIC, WrenchStamped)
        stage.create_timer(FORCE_RATE, self._publish_force)

    def _publish_force(self) -> None:
        time = self._stage.time
        v = self.current.velocity(np.zeros((1, 3)), time)[0]  # (3,) [m/s]
        force = DRAG_FACTOR * v * (v if self._is_signless else np.abs(v))  # (3,) [N]
        x, y, z = force.tolist()
        wrench = Wrench(force=Vector3(x=x, y=y, z=z), torque=Vector3(x=0.0, y=0.0, z=0.0))
        self._publish(WrenchStamped(header=header(time, "Currents"), wrench=wrench))
