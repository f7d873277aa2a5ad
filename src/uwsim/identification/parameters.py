"""The coefficients that a fit may change: their names, first guesses, bounds and plausible errors.

A name is a group (``added_mass``), or one coefficient of it (``added_mass[surge]``). Coefficients
are diagonal entries of the main link's matrices, in SI units, with the signs of hydrodynamics
files. A group stands for its coefficients whose first guess is not 0. Every coefficient has a
*plausible error*: the standard deviation of a first guess that was made by rules of thumb
(docs/your-own-vehicle.md). The fit counts the first guess as one measurement with this error, so
that a coefficient about which a log says nothing keeps its first guess.

| group | coefficients | unit | plausible error |
|---|---|---|---|
| ``added_mass`` | surge ... yaw | kg, kg m2 | 100 % |
| ``linear_damping`` | surge ... yaw | N s/m, N m s | 100 % |
| ``quadratic_damping`` | surge ... yaw | N s2/m2, N m s2 | 100 % |
| ``drag`` | both dampings | | |
| ``mass`` | - | kg | 5 % |
| ``inertia`` | roll, pitch, yaw | kg m2 | 50 % |
| ``buoyancy`` | - | displaced volume, m3 | 1 % |
| ``centre_of_buoyancy`` | x, y, z | m | 0.02 m |
| ``thrust`` | all, or a thruster | factor on the thrust curve | 30 % |
| ``time_constant`` | all, or a thruster | s | 100 %, at least 0.1 s |
| ``current`` | x, y, z of L | m/s | 0.2 m/s |
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from ..base.geometry import Array
from ..base.numerics.linear import rotate
from ..errors import BadSetting, choices
from ..physics.hydrodynamics import columns as c
from ..physics.hydrodynamics.kernel.free_step import FreeVehicle
from .vehicle_model import VehicleModel

AXES = ("surge", "sway", "heave", "roll", "pitch", "yaw")
"""The names of the axes of matrices."""
COMPONENTS = ("x", "y", "z")
MAX_PARAMETERS = 60
"""The greatest number of coefficients of one fit."""
MATRICES = {"added_mass": c.M_A, "linear_damping": c.LINEAR, "quadratic_damping": c.QUADRATIC}
"""The column of each matrix in a body's row."""
FORCE_UNITS = {
    "added_mass": ("kg", "kg m²"),
    "linear_damping": ("N s/m", "N m s"),
    "quadratic_damping": ("N s²/m²", "N m s²"),
}
"""The units of translational and rotational coefficients."""
GROUPS = (
    "added_mass",
    "linear_damping",
    "quadratic_damping",
    "drag",
    "mass",
    "inertia",
    "buoyancy",
    "centre_of_buoyancy",
    "thrust",
    "time_constant",
    "current",
)
"""The names of the groups."""

AXIS_GROUPS = ("added_mass", "linear_damping", "quadratic_damping", "inertia")
"""The groups whose coefficients belong to an axis each."""
HELD_GROUPS = ("buoyancy", "centre_of_buoyancy")
"""The groups without effect in the planar mode."""
HELD_KEYS = (("heave", "roll", "pitch"), ("z",))
"""The axes of matrices, and the components of a current, that the planar mode holds."""


@dataclass(frozen=True, kw_only=True)
class Parameter:
    """One coefficient of a fit."""

    name: str
    """The name, for example ``added_mass[surge]``."""
    group: str
    """The group."""
    key: str
    """The axis, component or thruster; empty: the group has one coefficient, or all thrusters."""
    unit: str
    """The unit; 1 for a factor."""
    first_guess: float
    """The value of the vehicle's files."""
    minimum: float
    """The smallest value."""
    maximum: float
    """The greatest value."""
    plausible_error: float
    """The standard deviation of the first guess."""


@dataclass(frozen=True, eq=False)
class Numbers:
    """The numbers of a simulation with certain coefficients."""

    vehicle: FreeVehicle
    """The vehicle."""
    water: Array
    """The row of the water in W, (12,)."""


def choose_parameters(names: Sequence[str], model: VehicleModel) -> tuple[Parameter, ...]:
    """Return the coefficients with these names, each once.

    Raises:
        BadSetting: a name is unknown, a group has no coefficient, or there are too many; with every
            error.
    """
    parameters: dict[str, Parameter] = {}
    errors = []
    for text in names:
        try:
            for parameter in _expand(text.strip(), model):
                parameters.setdefault(parameter.name, parameter)
        except BadSetting as error:
            errors.append(str(error))
    unique_names = set(parameters)
    for group in ("thrust", "time_constant"):
        if group in unique_names and any(name.startswith(f"{group}[") for name in unique_names):
            errors.append(f"--free {group}: all thrusters and a single one; choose either.")
    if not errors and not parameters:
        errors.append("--free: no coefficient; expected groups such as added_mass,drag,thrust.")
    if len(parameters) > MAX_PARAMETERS:
        errors.append(f"--free: {len(parameters)} coefficients; expected {MAX_PARAMETERS} at most.")
    if errors:
        raise BadSetting("\n".join(errors))
    return tuple(parameters.values())


def apply_values(model: VehicleModel, parameters: Sequence[Parameter], values: Array) -> Numbers:
    """Return the numbers of the vehicle with the values of coefficients, (n,)."""
    numbers = model.numbers._replace(
        rigid_body=model.numbers.rigid_body.copy(),
        bodies=model.numbers.bodies.copy(),
        actuators=model.numbers.actuators.copy(),
    )
    body, water = numbers.bodies[model.part], np.zeros(c.WATER_COLUMNS)
    current = np.zeros(3)  # in L [m/s]
    for parameter, value in zip(parameters, values.tolist(), strict=True):
        group, key = parameter.group, parameter.key
        if group in MATRICES:
            body[MATRICES[group] + 7 * AXES.index(key)] = value
        elif group == "mass":
            numbers.rigid_body[0] = value
        elif group == "inertia":
            numbers.rigid_body[4 + AXES.index(key) - 3] = value
        elif group == "buoyancy":
            body[c.DISPLACED_MASS] = numbers.density * value
        elif group == "centre_of_buoyancy":
            k = COMPONENTS.index(key)
            body[c.CENTRE + k] = value - body[c.REFERENCE + k]
        elif group == "current":
            current[COMPONENTS.index(key)] = value
        else:
            _change_thrusters(model, numbers.actuators, group, key, value)
    water[:3] = rotate(model.world_from_localized.rotation, current)
    return Numbers(vehicle=numbers, water=water)


def _change_thrusters(model: VehicleModel, rows: Array, group: str, key: str, value: float) -> None:
    for name, row in zip(model.actuators, rows, strict=True):
        if row[c.ROLE] != c.PROPELLER or key not in ("", name):
            continue
        if group == "time_constant":
            row[c.LAG] = value
            continue
        row[c.FORWARD : c.FORWARD + c.CURVE_TERMS] *= value
        row[c.BACKWARD : c.BACKWARD + c.CURVE_TERMS] *= value
        row[[c.MIN_THRUST, c.MAX_THRUST]] *= value


def _expand(text: str, model: VehicleModel) -> list[Parameter]:
    """Return the coefficients that a name stands for."""
    group, _, rest = text.partition("[")
    key = rest.removesuffix("]")
    if model.is_planar and group in HELD_GROUPS:
        raise BadSetting(
            f"--free {text!r}: the planar mode holds heave, roll and pitch, so that {group} has no "
            "effect."
        )
    if group not in GROUPS or (rest and not rest.endswith("]")):
        raise BadSetting(f"--free {text!r}: unknown.{choices(group, GROUPS)}")
    if group == "drag":
        names = [
            f"{matrix}{text.removeprefix('drag')}"
            for matrix in ("linear_damping", "quadratic_damping")
        ]
        return [parameter for name in names for parameter in _expand(name, model)]
    keys, make = _find_keys(group, model)
    if key and key not in keys:
        raise BadSetting(f"--free {text!r}: unknown.{choices(key, keys)}")
    if key and model.is_planar and key in HELD_KEYS[group == "current"]:
        raise BadSetting(
            f"--free {text!r}: the planar mode holds heave, roll and pitch; expected surge, sway "
            "or yaw, or x or y of a current."
        )
    if key:
        return [make(key)]
    if group in ("thrust", "time_constant"):
        if not model.thrusters:
            raise BadSetting(f"--free {text!r}: the vehicle {model.name!r} has no thruster.")
        return [make("")]
    parameters = [make(name) for name in keys or ("",)]
    if model.is_planar:
        parameters = [
            entry for entry in parameters if entry.key not in HELD_KEYS[group == "current"]
        ]
    if group in (*MATRICES, "inertia"):
        parameters = [parameter for parameter in parameters if parameter.first_guess > 0.0]
        if not parameters:
            raise BadSetting(
                f"--free {text!r}: all first guesses are 0; name the coefficients, such as "
                f"{group}[surge]."
            )
    return parameters


def _find_keys(
    group: str, model: VehicleModel
) -> tuple[tuple[str, ...], Callable[[str], Parameter]]:
    """Return the keys of a group, and a function that makes the coefficient of a key."""
    numbers = model.numbers
    body = numbers.bodies[model.part]
    if group in MATRICES:
        return AXES, lambda key: _matrix_entry(group, key, model)
    if group == "inertia":
        keys = AXES[3:]
        return keys, lambda key: _scale_free(
            group, key, "kg m²", float(numbers.rigid_body[4 + keys.index(key)]), 0.5, (0.05, 20.0)
        )
    if group == "mass":
        return (), lambda _: _scale_free(
            group, "", "kg", float(numbers.rigid_body[0]), 0.05, (0.5, 2.0)
        )
    if group == "buoyancy":
        volume = float(body[c.DISPLACED_MASS]) / numbers.density
        return (), lambda _: _scale_free(group, "", "m³", volume, 0.01, (0.8, 1.25))
    if group == "centre_of_buoyancy":
        return COMPONENTS, lambda key: _shift(
            group,
            key,
            "m",
            float(
                body[c.CENTRE + COMPONENTS.index(key)] + body[c.REFERENCE + COMPONENTS.index(key)]
            ),
            0.02,
            0.5,
        )
    if group == "current":
        return COMPONENTS, lambda key: _shift(group, key, "m/s", 0.0, 0.2, 3.0)
    if group == "thrust":
        return model.thrusters, lambda key: _scale_free(group, key, "1", 1.0, 0.3, (0.1, 10.0))
    return model.thrusters, lambda key: _time_constant(key, model)


def _matrix_entry(group: str, key: str, model: VehicleModel) -> Parameter:
    axis = AXES.index(key)
    body = model.numbers.bodies[model.part]
    value = float(body[MATRICES[group] + 7 * axis])
    unit = FORCE_UNITS[group][axis // 3]
    if value > 0.0:
        return _scale_free(group, key, unit, value, 1.0, (0.0, 20.0))
    scale = _typical_value(group, axis, model)
    return Parameter(
        name=f"{group}[{key}]", group=group, key=key, unit=unit, first_guess=0.0,
        minimum=0.0, maximum=20.0 * scale, plausible_error=scale,
    )  # fmt: skip


def _typical_value(group: str, axis: int, model: VehicleModel) -> float:
    """Return a coefficient of a compact body of the vehicle's size, where the first guess is 0."""
    numbers = model.numbers
    mass = float(numbers.rigid_body[0])
    inertia = float(numbers.rigid_body[4 + axis - 3]) if axis >= 3 else mass
    if group == "added_mass":
        return 0.5 * inertia
    return inertia  # a velocity that decays within a second, or a metre or radian


def _scale_free(
    group: str,
    key: str,
    unit: str,
    value: float,
    relative_error: float,
    limits: tuple[float, float],
) -> Parameter:
    """Return a positive coefficient whose bounds and error are multiples of its first guess."""
    return Parameter(
        name=f"{group}[{key}]" if key else group, group=group, key=key, unit=unit,
        first_guess=value, minimum=limits[0] * value, maximum=limits[1] * value,
        plausible_error=relative_error * value,
    )  # fmt: skip


def _shift(group: str, key: str, unit: str, value: float, error: float, reach: float) -> Parameter:
    """Return a coefficient of any sign."""
    return Parameter(
        name=f"{group}[{key}]", group=group, key=key, unit=unit, first_guess=value,
        minimum=value - reach, maximum=value + reach, plausible_error=error,
    )  # fmt: skip


def _time_constant(key: str, model: VehicleModel) -> Parameter:
    rows = model.numbers.actuators
    lags = [
        float(row[c.LAG])
        for name, row in zip(model.actuators, rows, strict=True)
        if row[c.ROLE] == c.PROPELLER and key in ("", name)
    ]
    lag = sum(lags) / len(lags)
    return Parameter(
        name=f"time_constant[{key}]" if key else "time_constant", group="time_constant", key=key,
        unit="s", first_guess=lag, minimum=0.0, maximum=5.0, plausible_error=max(lag, 0.1),
    )  # fmt: skip
