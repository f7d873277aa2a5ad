"""The hydrodynamics file with identified coefficients, their intervals and their provenance."""

from __future__ import annotations

import datetime
from collections.abc import Sequence
from dataclasses import replace

from lxml import etree

from ..scene.hydrodynamics.spec import BodyHydrodynamics, ThrusterSpec, VehicleHydrodynamics
from ..schema import write
from ..version import __version__
from .identify import Identification
from .parameters import AXES, COMPONENTS
from .uncertainty import Estimate
from .vehicle_model import VehicleModel

MIN_DATE = 1e9
"""The start of a log from which on it is a time since 1970, not the clock of the log [s]."""
MATRIX_FIELDS = ("added_mass", "linear_damping", "quadratic_damping")
"""The matrices of a body, which have the names of groups."""


def write_hydrodynamics(result: Identification, name: str) -> str:
    """Return the hydrodynamics file: the first guess with the identified coefficients.

    Args:
        result: the identification.
        name: the name of the set, which is that of its file without ``.xml``.
    """
    estimates = result.uncertainty.estimates
    vehicle = replace(
        apply_estimates(result.model, estimates), name=name, source=describe_source(result)
    )
    root = write(vehicle, "hydrodynamics")
    etree.indent(root)
    comments = "\n".join(f"<!-- {_describe(estimate)} -->" for estimate in estimates)
    text = etree.tostring(root, encoding="unicode")
    return f'<?xml version="1.0"?>\n{comments}\n{text}\n'


def apply_estimates(model: VehicleModel, estimates: Sequence[Estimate]) -> VehicleHydrodynamics:
    """Return the vehicle's hydrodynamics with identified coefficients."""
    vehicle = model.hydrodynamics
    bodies, thrusters = list(vehicle.bodies), list(vehicle.thrusters)
    place = next(i for i, body in enumerate(bodies) if body.link == model.link)
    for estimate in estimates:
        group, key = estimate.parameter.group, estimate.parameter.key
        if group in ("thrust", "time_constant"):
            thrusters = [
                _change_thruster(thruster, group, estimate.value)
                if key in ("", thruster.name)
                else thruster
                for thruster in thrusters
            ]
        elif group != "current":  # a property of the water
            bodies[place] = _change_body(bodies[place], model, estimate)
    return replace(vehicle, bodies=tuple(bodies), thrusters=tuple(thrusters))


def _change_body(
    body: BodyHydrodynamics, model: VehicleModel, estimate: Estimate
) -> BodyHydrodynamics:
    group, key = estimate.parameter.group, estimate.parameter.key
    value, change = _round(estimate.value), estimate.value - estimate.parameter.first_guess
    if group in MATRIX_FIELDS:
        numbers = list(getattr(body, group))
        axis = AXES.index(key)
        numbers[axis if len(numbers) == 6 else 7 * axis] = value
        if group == "added_mass":
            return replace(body, added_mass=tuple(numbers))
        if group == "linear_damping":
            return replace(body, linear_damping=tuple(numbers))
        return replace(body, quadratic_damping=tuple(numbers))
    if group == "buoyancy":
        return replace(body, volume=value)
    if group == "centre_of_buoyancy":
        x, y, z = (
            value if name == key else number
            for name, number in zip(COMPONENTS, body.centre_of_buoyancy, strict=True)
        )
        return replace(body, centre_of_buoyancy=(x, y, z))
    x, y, z = model.link_centre
    body = replace(body, centre_of_mass=(x, y, z))
    inertia = list(body.inertia or model.link_inertia)
    mass = model.link_mass if body.mass is None else body.mass
    if group == "mass":
        return replace(body, mass=_round(mass + change), inertia=tuple(inertia))
    inertia[AXES.index(key) - 3] = _round(inertia[AXES.index(key) - 3] + change)
    return replace(body, mass=mass, inertia=tuple(inertia))


def _change_thruster(thruster: ThrusterSpec, group: str, value: float) -> ThrusterSpec:
    if group == "time_constant":
        return replace(thruster, time_constant=_round(value))
    saturation = thruster.saturation
    return replace(
        thruster,
        forward=_scale(thruster.forward, value),
        backward=None if thruster.backward is None else _scale(thruster.backward, value),
        saturation=None if saturation is None else (value * saturation[0], value * saturation[1]),
    )


def _scale(numbers: Sequence[float], factor: float) -> tuple[float, ...]:
    return tuple(_round(factor * number) for number in numbers)


def _round(number: float) -> float:
    """Round a number to six digits, so that files do not depend on the processor."""
    return float(f"{number:.6g}")


def describe_source(result: Identification) -> str:
    """Return the provenance: logs with hash and date, settings, the source of the first guess."""
    logs = "; ".join(describe_log(log.path, log.sha256, log.start) for log in result.logs)
    settings = result.settings
    first = result.model.hydrodynamics
    return (
        f"Identified by uwsim {__version__} from {logs}. Free: {','.join(settings.free_names)}; "
        f"{'planar; ' if result.model.is_planar else ''}"
        f"{len(result.windows)} windows of {settings.windows.length:g} s, loss {settings.loss}, "
        f"seed {settings.seed}. First guess and all other numbers: {first.name} ({first.source})"
    )


def describe_log(path: str, sha256: str, start: float) -> str:
    """Return a log's name, hash and date."""
    parts = [f"sha256 {sha256.removeprefix('sha256:')[:16]}"] if sha256 else []
    if start >= MIN_DATE:
        moment = datetime.datetime.fromtimestamp(int(start), tz=datetime.UTC)
        parts.append(f"of {moment:%Y-%m-%d %H:%M} UTC")
    name = path.replace("\\", "/").rsplit("/", 1)[-1]
    return f"{name} ({', '.join(parts)})" if parts else name


def _describe(estimate: Estimate) -> str:
    parameter = estimate.parameter
    unit = "" if parameter.unit == "1" else f" {parameter.unit}"
    note = "" if estimate.is_determined else "; not determined by the logs"
    return (
        f"{parameter.name}: {estimate.value:.4g}{unit}, 95 % interval {estimate.low:.4g} to "
        f"{estimate.high:.4g}, first guess {parameter.first_guess:.4g}{note}"
    )
