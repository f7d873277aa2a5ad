r"""u:waterUpdater: physical water that becomes more turbid from level to level.

.. code-block:: xml

    <u:waterUpdater u:quantity="attenuationLengths" u:exposure="automatic">
      <initialValue>0.5</initialValue> <finalValue>8</finalValue> <step>0.5</step>
      <interval>2</interval>
      <camera>bowtech1</camera> <target>blackbox</target>
    </u:waterUpdater>

A level multiplies absorption and scattering of the scene's ``<u:water>`` by one factor, in all
channels. So b/c, the colour of the water and the phase function remain. ``u:quantity`` selects the
quantity whose value the factor makes true in the green channel:

``beamAttenuation``
    The beam attenuation c [1/m].
``attenuationLengths``
    The optical depth :math:`n = c R` of the line from a camera, or a body, to a target: c is
    :math:`n / R`, with the distance R at the moment when the level begins.
``turbidity``
    The turbidity [NTU], with :math:`b = k\,T` and the factor k of ``<scatteringPerNtu>``.
``scale``
    The factor itself: 1 is the water of the scene.

A turbidity is no optical property (Kitchener, Wainwright and Parsons, *Prog. Phys. Geogr.* 41, 620
(2017)): water and instrument determine k. A beam attenuation of 0.3 to 1 1/m per NTU is usual; the
default of k lies in the middle for b/c = 0.85. Not modelled: particles that are added to clear
water, whose own absorption remains. Here it grows with them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np

from ...base.geometry import Array, Triple
from ...errors import BadSetting, UwsimError
from ...optics import Medium
from ...optics.medium import MAX_COEFFICIENT, name_channel
from ...schema import element
from ...world import Body, Camera, LineOfSight, Stage, StageWater
from .sweep import SweepSpec, step_values
from .updater import SceneUpdater

Quantity = Literal["beamAttenuation", "attenuationLengths", "turbidity", "scale"]
"""A quantity that a sweep changes."""
PARAMETERS: dict[Quantity, tuple[str, str]] = {
    "beamAttenuation": ("beamAttenuation", "1/m"),
    "attenuationLengths": ("attenuationLengths", "1"),
    "turbidity": ("turbidity", "NTU"),
    "scale": ("waterScale", "1"),
}
"""The name of the column of each quantity, and its unit."""
GREEN = 1
"""The channel in which the quantity has its value."""
MIN_DISTANCE = 0.01
"""The smallest distance of a target [m]."""


@dataclass(frozen=True, kw_only=True)
class WaterUpdaterSpec(SweepSpec):
    """A ``<u:waterUpdater>`` element.

    A level scales the coefficients of the scene's physical water by one factor. The scene has to
    have ``<u:water law="physical">`` whose green channel attenuates.
    """

    name: ClassVar[str] = "beamAttenuation"
    unit: ClassVar[str] = "1/m"

    initial_value: float = element(minimum=0.0, maximum=MAX_COEFFICIENT)
    """The value of the first level, in the unit of the quantity."""
    final_value: float = element(minimum=0.0, maximum=MAX_COEFFICIENT)
    """The greatest value of a level."""
    quantity: Quantity = element(default="beamAttenuation", attribute=True, namespaced=True)
    """The quantity that the sweep changes (``u:quantity``): the beam attenuation [1/m], the number
    of attenuation lengths to the target [1], the turbidity [NTU], or a factor on the scene's
    coefficients [1]."""
    exposure: Literal["constant", "automatic"] = element(
        default="constant", attribute=True, namespaced=True
    )
    """The exposure of the cameras (``u:exposure``): that of the scene's own water, or one for each
    level, in which a white board at the target has 0.7 of linear full scale."""
    camera: str | None = element(default=None, refers_to="camera")
    """The virtual camera from which the target is seen."""
    from_: str | None = element("from", default=None, refers_to="body")
    """The vehicle or link from whose origin the target is seen, instead of a camera."""
    target: str | None = element(default=None, refers_to="body")
    """The body that is seen."""
    point: Triple = (0.0, 0.0, 0.0)
    """The point of the target, in its frame, to which the distance counts [m]."""
    scattering_per_ntu: float = element(default=0.5, exclusive_minimum=0.0, maximum=100.0)
    """The scattering of a turbidity of 1 NTU [1/m]."""

    @property
    def parameter(self) -> str:
        """The name of the column: the quantity, or ``waterScale``."""
        return PARAMETERS[self.quantity][0]

    @property
    def parameter_unit(self) -> str:
        """The unit of the column."""
        return PARAMETERS[self.quantity][1]

    @property
    def has_sight(self) -> bool:
        """True if the line of sight to the target counts."""
        return self.quantity == "attenuationLengths" or self.exposure == "automatic"

    def values(self) -> tuple[float, ...]:
        """Return the value of each level; the final value is one if whole steps lead to it."""
        return step_values(self.initial_value, self.final_value, self.step)

    def errors(self) -> Iterator[str]:
        """Report a line of sight that is incomplete, ambiguous or without an effect."""
        yield from super().errors()
        n_origins = sum(name is not None for name in (self.camera, self.from_))
        if not self.has_sight and (n_origins or self.target is not None):
            tag = next(
                tag
                for tag, name in (
                    ("camera", self.camera),
                    ("from", self.from_),
                    ("target", self.target),
                )
                if name is not None
            )
            yield (
                f"<{tag}> has no effect; expected u:quantity='attenuationLengths' or "
                "u:exposure='automatic' with it"
            )
        elif self.has_sight and (n_origins != 1 or self.target is None):
            reason = (
                "u:quantity='attenuationLengths'"
                if self.quantity == "attenuationLengths"
                else "u:exposure='automatic'"
            )
            yield f"{reason} needs <target>, and one of <camera> and <from>"

    def bind(self, stage: Stage) -> WaterUpdater:
        """Resolve the line of sight, and set the water of the first level.

        Raises:
            UwsimError: the scene has no physical water, its green channel is empty, the target is
                at the camera, or the last level is more turbid than allowed.
        """
        medium = stage.water.medium
        if medium is None:
            raise UwsimError(
                'The scene has no physical water; expected <u:water law="physical"> in its '
                "<oceanState>."
            )
        find_sight = self._bind_sight(stage) if self.has_sight else None
        updater = WaterUpdater(self, stage.water, medium, find_sight)
        for value in (self.values()[-1], self.first_value):
            updater.apply(value)
        return updater

    def _bind_sight(self, stage: Stage) -> Callable[[], LineOfSight]:
        """Return a function that returns the present line of sight."""
        assert self.target is not None
        target = stage.world.body(self.target)
        camera = None if self.camera is None else stage.world.camera(self.camera)
        body = None if self.from_ is None else stage.world.body(self.from_)

        def find_sight() -> LineOfSight:
            point = target.world_from_body.transform(np.array([self.point]))[0]
            return LineOfSight(camera=_find_position(camera, body), point=point)

        return find_sight

    def compute_factor(self, value: float, medium: Medium, sight: LineOfSight | None) -> float:
        """Compute the factor on the coefficients of a medium that makes a value true [1].

        Args:
            value: the value of a level.
            medium: the water of the scene.
            sight: the line of sight to the target, if it counts.

        Raises:
            BadSetting: the green channel of the medium is empty, or the target is at the camera.
        """
        if self.quantity == "scale":
            return value
        is_turbidity = self.quantity == "turbidity"
        attenuation = (
            medium.scattering[GREEN] if is_turbidity else float(medium.beam_attenuation[GREEN])
        )
        if attenuation == 0.0:
            name = "scattering" if is_turbidity else "beam attenuation"
            raise BadSetting(f"The {name} of the scene's water is 0 in green; expected more.")
        if is_turbidity:
            return value * self.scattering_per_ntu / attenuation
        if self.quantity == "attenuationLengths":
            assert sight is not None
            return value / (sight.length * attenuation)
        return value / attenuation


class WaterUpdater(SceneUpdater):
    """An updater that scales the coefficients of physical water.

    Args:
        spec: the spec.
        water: the water of the scene, which is changed.
        medium: the water of the scene file.
        find_sight: returns the present line of sight to the target; None if it does not count.
    """

    def __init__(
        self,
        spec: WaterUpdaterSpec,
        water: StageWater,
        medium: Medium,
        find_sight: Callable[[], LineOfSight] | None,
    ) -> None:
        self._spec, self._water, self._medium = spec, water, medium
        self._find_sight = find_sight

    def apply(self, value: float) -> None:
        """Set the water to a value of the quantity, at the present distance of the target.

        Raises:
            BadSetting: a coefficient is more than allowed, or the target is at the camera.
        """
        sight = None if self._find_sight is None else self._find_sight()
        if sight is not None and sight.length < MIN_DISTANCE:
            raise BadSetting(
                f"The target {self._spec.target!r} is {sight.length:g} m from the camera; "
                f"expected {MIN_DISTANCE:g} m or more."
            )
        factor = self._spec.compute_factor(value, self._medium, sight)
        if texts := list(_find_excesses(self._medium, factor)):
            raise BadSetting(
                f"At {self._spec.parameter} {value:g} the water has {', '.join(texts)}; expected "
                f"at most {MAX_COEFFICIENT:g} 1/m."
            )
        is_automatic = self._spec.exposure == "automatic"
        self._water.set_medium(self._medium.scale(factor), sight=sight if is_automatic else None)


def _find_excesses(medium: Medium, factor: float) -> Iterator[str]:
    """Yield the coefficients that are more than allowed after they are scaled by a factor."""
    columns = (("an absorption", medium.absorption), ("a scattering", medium.scattering))
    for name, values in columns:
        numbers = [
            f"{factor * value:.4g} 1/m in {name_channel(number, medium.n_channels)}"
            for number, value in enumerate(values, start=1)
            if not factor * value <= MAX_COEFFICIENT
        ]
        if numbers:
            yield f"{name} of {', '.join(numbers)}"


def _find_position(camera: Camera | None, body: Body | None) -> Array:
    """Return the present position of a camera, or else of a body, in W, (3,) [m]."""
    if camera is not None:
        return camera.world_from_camera.position
    assert body is not None
    return body.world_from_body.position
