"""The hydrodynamics file of an imported model: bodies, thrusters and fins."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from ...base.geometry import Array, Pose, twist_shift
from ...scene.hydrodynamics.spec import (
    BodyHydrodynamics,
    FinSpec,
    ThrusterSpec,
    VehicleHydrodynamics,
)
from ...scene.hydrodynamics.vehicle_file import set_errors
from ...schema import write
from ...schema.layout import lay_out
from ..mesh_files import MeshFiles
from ..plugins.coefficients import BodyCoefficients, Water
from ..plugins.context import PluginContext
from ..plugins.fins import read_fins
from ..plugins.hydrodynamics import read_hydrodynamics
from ..plugins.thrusters import read_thrusters, triple
from ..plugins.uuv_object import read_uuv_object
from ..report import Status
from ..volumes import Displacement, displacement_of

DEFAULT_DENSITY = 1000.0
"""The density of the water if no plug-in states it [kg/m3]."""
UUV_OBJECTS = ("uuv_underwater_object_ros_plugin", "uuv_underwater_object_plugin")


@dataclass(frozen=True, kw_only=True)
class ImportedHydrodynamics:
    """The hydrodynamics of an imported model, and what its plug-ins state about the water."""

    vehicle: VehicleHydrodynamics
    """The hydrodynamics set."""
    current: tuple[float, float, float]
    """The current in the world [m/s]."""


def make_hydrodynamics(
    name: str, context: PluginContext, water: Water, meshes: MeshFiles
) -> ImportedHydrodynamics:
    """Return the hydrodynamics set of a model."""
    coefficients = {entry.path: entry for entry in _read_coefficients(context)}
    densities = [entry.density for entry in coefficients.values() if entry.density is not None]
    density = water.density or next(iter(densities), DEFAULT_DENSITY)
    bodies = []
    for path in context.robot.links:
        displacement = _displacement(path, context, water, meshes)
        body = _make_body(path, coefficients.get(path), displacement, context)
        if body is not None:
            bodies.append(body)
    vehicle = VehicleHydrodynamics(
        name=name,
        source=f"Imported from {context.model.model.file.name}, model {context.model.model.name}.",
        density=density,
        bodies=tuple(bodies),
        thrusters=tuple(part for part in read_thrusters(context) if _is_valid(part, context)),
        fins=tuple(part for part in read_fins(context) if _is_valid(part, context)),
    )
    currents = [entry.current for entry in coefficients.values() if any(entry.current)]
    return ImportedHydrodynamics(vehicle=vehicle, current=next(iter(currents), (0.0, 0.0, 0.0)))


def write_hydrodynamics(vehicle: VehicleHydrodynamics, path: Path) -> None:
    """Write a hydrodynamics file."""
    path.write_text(lay_out(write(vehicle, "hydrodynamics")), encoding="utf-8")


def _read_coefficients(context: PluginContext) -> Iterator[BodyCoefficients]:
    for plugin in context.model.plugins:
        if plugin.plugin.kind == "hydrodynamics":
            entry = read_hydrodynamics(plugin, context)
            if entry is not None:
                yield entry
        elif plugin.plugin.kind in UUV_OBJECTS:
            yield from read_uuv_object(plugin, context)


def _displacement(
    path: str, context: PluginContext, water: Water, meshes: MeshFiles
) -> Displacement | None:
    """Return the water that the collision shapes of a link displace; None without any."""
    link = context.robot.links[path].link
    if not water.is_buoyant(context.model.model.name, path):
        return None
    shapes = []
    for collision, link_from_shape in link.collisions:
        mesh = None
        if collision.shape.kind == "mesh":
            mesh = meshes.copy(collision.shape, f"collision {collision.name}", collision.place)
        shapes.append((collision.shape, link_from_shape, mesh))
    return displacement_of(shapes)


def _make_body(
    path: str,
    entry: BodyCoefficients | None,
    displacement: Displacement | None,
    context: PluginContext,
) -> BodyHydrodynamics | None:
    """Return the parameters of a link; None if the water does not act on it."""
    link = context.robot.links[path]
    fluid_mass = link.link.inertial.added_mass
    if entry is None and displacement is None and fluid_mass is None:
        return None
    reference = context.robot.frame_from_part(path, Pose.identity()).position
    body = BodyHydrodynamics(link=link.name, reference=triple(reference))
    if entry is not None:
        body = replace(
            body,
            added_mass=_numbers(entry.added_mass),
            linear_damping=_numbers(entry.linear_damping),
            quadratic_damping=_numbers(entry.quadratic_damping, has_axes=True),
        )
    if fluid_mass is not None and not any(body.added_mass):
        inertial = context.robot.frame_from_part(path, link.link.link_from_inertial)
        has_damping = any(body.linear_damping) or any(body.quadratic_damping)
        point = inertial.position if not has_damping else reference
        body = replace(
            body,
            reference=triple(point),
            added_mass=_numbers(move_added_mass(fluid_mass, inertial, point)),
        )
    body = _with_volume(body, path, entry, displacement, context)
    return _valid_body(body, entry, path, context)


def _with_volume(
    body: BodyHydrodynamics,
    path: str,
    entry: BodyCoefficients | None,
    displacement: Displacement | None,
    context: PluginContext,
) -> BodyHydrodynamics:
    """Return the body with its displaced water: that of its plug-in, else of its shapes."""
    if entry is not None and entry.volume is not None:
        centre = entry.centre_of_buoyancy or (0.0, 0.0, 0.0)
        pose = context.robot.frame_from_part(path, Pose(np.array(centre), np.eye(3)))
        body = replace(body, volume=entry.volume, centre_of_buoyancy=triple(pose.position))
        return body if entry.box is None else replace(body, shape="box", size=entry.box)
    if displacement is None:
        return body
    pose = context.robot.frame_from_part(path, Pose(displacement.centre, np.eye(3)))
    low, high = displacement.box
    edges = high - low
    body = replace(
        body,
        volume=float(f"{displacement.volume:.9g}"),
        centre_of_buoyancy=triple(pose.position),
    )
    if edges.min() > 1e-4:
        body = replace(body, shape="box", size=triple(edges))
    return body


def _valid_body(
    body: BodyHydrodynamics, entry: BodyCoefficients | None, path: str, context: PluginContext
) -> BodyHydrodynamics:
    """Return the body and report it; without the terms beside the diagonals if these are wrong."""
    notes = [] if entry is None else list(entry.notes)
    errors = set_errors(VehicleHydrodynamics(name="imported", bodies=(body,)))
    if errors:
        body = replace(
            body,
            added_mass=_diagonal(body.added_mass),
            linear_damping=_diagonal(body.linear_damping),
            quadratic_damping=_diagonal(body.quadratic_damping),
        )
        notes.append(f"{errors[0]}: only the diagonals are used")
    if entry is not None:
        status: Status = "changed" if notes else "imported"
        label = f"plugin {entry.plugin.plugin.kind} {path}"
        context.report.add(status, label, entry.plugin.plugin.place, "; ".join(notes))
    return body


def move_added_mass(matrix: Array, frame_from_inertial: Pose, point: Array) -> Array:
    r"""Return an added mass in the axes of a link, about a point, (6, 6).

    With the rotation R of the frame of the inertia in the frame of the link, and the vector r from
    the point to the origin of the inertia, :math:`M' = H^T \mathrm{diag}(R, R) M \mathrm{diag}(R,
    R)^T H` and :math:`H = [I, -S(r); 0, I]` (Fossen 2011, 7.3).

    Args:
        matrix: the added mass in the frame of the inertia, (6, 6).
        frame_from_inertial: the frame of the inertia in the frame of the link.
        point: the point in the frame of the link, (3,) [m].
    """
    from ...base.numerics.linear import product

    turn = np.zeros((6, 6))
    turn[:3, :3] = turn[3:, 3:] = frame_from_inertial.rotation
    shift = twist_shift(frame_from_inertial.position - point)
    rotated_mass = product(product(turn, matrix), turn.T)
    return product(product(shift.T, rotated_mass), shift)


def _is_valid(part: ThrusterSpec | FinSpec, context: PluginContext) -> bool:
    """Return whether a hydrodynamics file may have a part; report one that it may not."""
    if isinstance(part, ThrusterSpec):
        label, vehicle = "thruster", VehicleHydrodynamics(name="imported", thrusters=(part,))
    else:
        label, vehicle = "fin", VehicleHydrodynamics(name="imported", fins=(part,))
    errors = set_errors(vehicle)
    if errors:
        place = context.model.model.place
        context.report.add("left out", f"{label} {part.name}", place, errors[0])
    return not errors


def _numbers(matrix: Array, *, has_axes: bool = False) -> tuple[float, ...]:
    """Return the diagonal of a matrix, or all of its numbers if it has others.

    A quadratic damping with three equal numbers is also written in full: the reader of the file
    would take a diagonal for that of an isotropic body, and Gazebo's drag is that of each axis.
    """
    x, y, z, *_ = diagonal = np.diag(matrix)
    is_isotropic = has_axes and x == y == z > 0.0
    is_diagonal = np.array_equal(matrix, np.diag(diagonal)) and not is_isotropic
    values = diagonal if is_diagonal else matrix.ravel()
    return tuple(float(f"{value:.12g}") + 0.0 for value in values)


def _diagonal(values: tuple[float, ...]) -> tuple[float, ...]:
    return values if len(values) == 6 else tuple(values[7 * i] for i in range(6))
