"""The coefficients of a vehicle to which the gap may be attributed, and their perturbation."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

from ..scene.hydrodynamics import BodyHydrodynamics, ThrusterSpec, VehicleHydrodynamics
from ..scene.spec import SceneSpec

AXES = ("surge", "sway", "heave", "roll", "pitch", "yaw")
CLOCK_KEY = "command_clock"
"""The key of the clock of the commands."""
LAG_KEY = "thruster_lag"
"""The key of the lag of the thrusters."""
MAX_SHIFT = 0.95
"""The greatest shift of the clock of the commands [s]."""

Change = Callable[[VehicleHydrodynamics, float], VehicleHydrodynamics]
"""A function that returns the hydrodynamics with a coefficient scaled by a factor."""


@dataclass(frozen=True, kw_only=True)
class Coefficient:
    """A coefficient, or several that have one cause."""

    key: str
    """The key in files: ``yaw_drag``."""
    name: str
    """The name in sentences: yaw drag."""
    change: Change
    """The change by a factor."""
    advice: str
    """The place of the coefficient in the hydrodynamics file."""
    step: float = 0.05
    """The relative change by which its effect is computed."""
    limits: tuple[float, float] = (0.05, 20.0)
    """The limits of a factor."""

    @property
    def is_clock(self) -> bool:
        """The mark of the clock of the commands, whose factor is 1 + the shift of times [s]."""
        return self.key == CLOCK_KEY


def describe_clock(kind: str) -> Coefficient:
    """Return the clock of the commands, a cause that is no coefficient of the vehicle.

    Args:
        kind: the kind of the commands, for the place in the mapping file.
    """
    return Coefficient(
        key=CLOCK_KEY,
        name="clock of the commands",
        change=lambda dynamics, factor: dynamics,
        advice=f"clock_offset of [commands.{kind}] in a mapping file",
        limits=(1.0 - MAX_SHIFT, 1.0 + MAX_SHIFT),
    )


def list_coefficients(dynamics: VehicleHydrodynamics, link: str) -> list[Coefficient]:
    """Return the coefficients of a vehicle that are not zero.

    Args:
        dynamics: the hydrodynamics of the vehicle.
        link: the link of the hull.
    """
    body = dynamics.body(link)
    coefficients: list[Coefficient] = []
    if body is not None:
        coefficients += _list_body_coefficients(body)
    for index, thruster in enumerate(dynamics.thrusters):
        coefficients.append(
            Coefficient(
                key=f"thrust:{thruster.name}",
                name=f"thrust of {thruster.name}",
                change=_scale_thrust((index,)),
                advice=f"<forward>, <backward> of <thruster name={thruster.name!r}>",
            )
        )
    if len(dynamics.thrusters) > 1:
        coefficients.append(
            Coefficient(
                key="thrust",
                name="thrust of all thrusters",
                change=_scale_thrust(tuple(range(len(dynamics.thrusters)))),
                advice="<forward>, <backward> of all thrusters",
            )
        )
    if any(thruster.time_constant > 0.0 for thruster in dynamics.thrusters):
        coefficients.append(
            Coefficient(
                key=LAG_KEY,
                name="lag of the thrusters",
                change=_scale_lags,
                advice="<timeConstant> of all thrusters",
            )
        )
    if dynamics.fins:
        coefficients.append(
            Coefficient(
                key="fins",
                name="force of the fins",
                change=_scale_fins,
                advice="<area> of all fins",
            )
        )
    return coefficients


def _list_body_coefficients(body: BodyHydrodynamics) -> list[Coefficient]:
    coefficients = []
    for axis, name in enumerate(AXES):
        if _entry(body.linear_damping, axis) or _entry(body.quadratic_damping, axis):
            coefficients.append(
                Coefficient(
                    key=f"{name}_drag",
                    name=f"{name} drag",
                    change=_scale_body(body.link, axis, ("linear_damping", "quadratic_damping")),
                    advice=f"number {axis + 1} of <linearDamping> and <quadraticDamping>",
                )
            )
    for axis, name in enumerate(AXES):
        if _entry(body.added_mass, axis):
            coefficients.append(
                Coefficient(
                    key=f"{name}_added_mass",
                    name=f"{name} added mass",
                    change=_scale_body(body.link, axis, ("added_mass",)),
                    advice=f"number {axis + 1} of <addedMass>",
                )
            )
    if body.volume > 0.0:
        coefficients.append(
            Coefficient(
                key="buoyancy",
                name="buoyancy",
                change=_scale_volume(body.link),
                advice="<volume>, or the mass of the vehicle",
                step=0.005,
            )
        )
    if any(body.centre_of_buoyancy):
        coefficients.append(
            Coefficient(
                key="metacentric_height",
                name="metacentric height",
                change=_scale_centre(body.link),
                advice="<centreOfBuoyancy>, or the centre of mass",
            )
        )
    return coefficients


def scale_coefficient(
    scene: SceneSpec, index: int, dynamics: VehicleHydrodynamics, new_dynamics: VehicleHydrodynamics
) -> SceneSpec:
    """Return a scene whose vehicle has other hydrodynamics.

    Args:
        scene: the scene.
        index: the index of the vehicle.
        dynamics: its present hydrodynamics.
        new_dynamics: its new hydrodynamics, with the same links, thrusters and fins.
    """
    vehicle = scene.vehicles[index]
    settings = dict(vehicle.hydrodynamics)
    settings.update(_list_settings(dynamics, new_dynamics))
    vehicles = list(scene.vehicles)
    vehicles[index] = replace(vehicle, hydrodynamics=tuple(settings.items()))
    return replace(scene, vehicles=tuple(vehicles))


def _list_settings(old_set: VehicleHydrodynamics, new_set: VehicleHydrodynamics) -> dict[str, str]:
    """Return the paths and texts of all values that differ."""
    settings: dict[str, str] = {}
    names = {
        "body": ("link", {"added_mass", "linear_damping", "quadratic_damping", "volume"}),
        "thruster": ("name", {"forward", "backward", "saturation", "time_constant"}),
        "fin": ("name", {"area"}),
    }
    parts = (
        ("body", old_set.bodies, new_set.bodies),
        ("thruster", old_set.thrusters, new_set.thrusters),
        ("fin", old_set.fins, new_set.fins),
    )
    for kind, old_parts, new_parts in parts:
        label, fields = names[kind]
        for old_part, new_part in zip(old_parts, new_parts, strict=True):
            place = f"{kind}[{getattr(old_part, label)}]"
            for name in sorted(fields):
                value = getattr(new_part, name)
                if value != getattr(old_part, name):
                    numbers = value if isinstance(value, tuple) else (value,)
                    settings[f"{place}.{_camel(name)}"] = " ".join(map(repr, numbers))
    for old_body, body in zip(old_set.bodies, new_set.bodies, strict=True):
        if old_body.centre_of_buoyancy != body.centre_of_buoyancy:
            for axis, number in zip("xyz", body.centre_of_buoyancy, strict=True):
                settings[f"body[{body.link}].centreOfBuoyancy.{axis}"] = repr(number)
    return settings


def _camel(name: str) -> str:
    first, *later_words = name.split("_")
    return first + "".join(word.capitalize() for word in later_words)


def _entry(numbers: tuple[float, ...], axis: int) -> float:
    """Return an entry of the diagonal of 6 or 36 numbers."""
    return numbers[axis] if len(numbers) == 6 else numbers[7 * axis]


def _scale_entry(numbers: tuple[float, ...], axis: int, factor: float) -> tuple[float, ...]:
    index = axis if len(numbers) == 6 else 7 * axis
    return tuple(
        factor * number if place == index else number for place, number in enumerate(numbers)
    )


def _replace_body(
    dynamics: VehicleHydrodynamics,
    link: str,
    change: Callable[[BodyHydrodynamics], BodyHydrodynamics],
) -> VehicleHydrodynamics:
    bodies = tuple(change(body) if body.link == link else body for body in dynamics.bodies)
    return replace(dynamics, bodies=bodies)


def _scale_body(link: str, axis: int, fields: tuple[str, ...]) -> Change:
    def scale(dynamics: VehicleHydrodynamics, factor: float) -> VehicleHydrodynamics:
        def scale_fields(body: BodyHydrodynamics) -> BodyHydrodynamics:
            new_values: dict[str, Any] = {
                name: _scale_entry(getattr(body, name), axis, factor) for name in fields
            }
            return replace(body, **new_values)

        return _replace_body(dynamics, link, scale_fields)

    return scale


def _scale_volume(link: str) -> Change:
    return lambda dynamics, factor: _replace_body(
        dynamics, link, lambda body: replace(body, volume=factor * body.volume)
    )


def _scale_centre(link: str) -> Change:
    def scale_centre(body: BodyHydrodynamics, factor: float) -> BodyHydrodynamics:
        x, y, z = body.centre_of_buoyancy
        return replace(body, centre_of_buoyancy=(x, y, factor * z))

    return lambda dynamics, factor: _replace_body(
        dynamics, link, lambda body: scale_centre(body, factor)
    )


def _scale_thrust(indices: tuple[int, ...]) -> Change:
    def scale_thruster(thruster: ThrusterSpec, factor: float) -> ThrusterSpec:
        return replace(
            thruster,
            forward=tuple(factor * number for number in thruster.forward),
            backward=None
            if thruster.backward is None
            else tuple(factor * number for number in thruster.backward),
            saturation=None
            if thruster.saturation is None
            else (factor * thruster.saturation[0], factor * thruster.saturation[1]),
        )

    def scale(dynamics: VehicleHydrodynamics, factor: float) -> VehicleHydrodynamics:
        thrusters = tuple(
            scale_thruster(thruster, factor) if index in indices else thruster
            for index, thruster in enumerate(dynamics.thrusters)
        )
        return replace(dynamics, thrusters=thrusters)

    return scale


def _scale_lags(dynamics: VehicleHydrodynamics, factor: float) -> VehicleHydrodynamics:
    thrusters = tuple(
        replace(thruster, time_constant=factor * thruster.time_constant)
        for thruster in dynamics.thrusters
    )
    return replace(dynamics, thrusters=thrusters)


def _scale_fins(dynamics: VehicleHydrodynamics, factor: float) -> VehicleHydrodynamics:
    return replace(
        dynamics, fins=tuple(replace(fin, area=factor * fin.area) for fin in dynamics.fins)
    )
