r"""Inertia and hydrodynamics of loose objects, from the boxes around their shapes.

The drag is :math:`\tfrac12\rho C_d A v|v|` for each pair of faces of the box, with :math:`C_d` =
1.05. The translational added mass follows from plates and prisms in DNV-RP-H103 (2011, appendix A),
the rotational added mass from an ellipsoid with the proportions and volume of the box (Lamb). The
displaced volume is the volume of the box unless ``u:volume`` states another. An object whose only
shape is a sphere has :math:`C_d` = 0.47 in all directions. The file's ``linearDamping`` and
``angularDamping``, times mass and inertia, are added as linear damping.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from ..base.geometry import Array
from ..errors import Diagnostic
from ..model.collision.shapes import CollisionShape, bounding_box
from ..model.inertias import MAX_BUOYANCY
from ..scene.hydrodynamics import BodyHydrodynamics
from ..scene.object import ObjectSpec, PhysicsSpec
from ..scene.urdf.robot import LinkSpec
from ..schema import diagnostic_at

BOX_DRAG = 1.05
"""The drag coefficient of a cube with a face across the flow [1]."""
BALL_DRAG = 0.47
"""The drag coefficient of a sphere [1]."""
MIN_INERTIA = 1e-14
"""The limit that mass [kg] and inertia [kg m2] must exceed in the engine."""

BALL_TORQUE = 0.05
"""The torque on a rotating sphere, divided by half the density, the square of the angular speed and
the fifth power of the radius [1] (Sawatzki, Acta Mechanica 9, 1970, at a Reynolds number of
20 000)."""
PLATES = (
    (1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 8.0, 10.0, 1e3),
    (0.579, 0.642, 0.690, 0.757, 0.801, 0.830, 0.872, 0.897, 0.934, 0.947, 1.0),
)
"""The ratio b/a of the sides of a plate, and its added mass divided by the mass of water in a
cylinder of the diameter a and the length b [1] (DNV-RP-H103, table A-2)."""
DEPTHS = (
    (0.0, 0.1, 0.2, 0.5, 1.0, 2.0, 4.0, 6.0, 10.0),
    (1.0, 1.14, 1.21, 1.36, 1.495, 1.583, 1.67, 1.715, 1.76),
)
"""The ratio of a box's length along its motion to the short side of its face, and the ratio of its
added mass to that of the face as a plate [1] (up to 0.5: rectangles of table A-1; from 1 on: square
prisms of table A-2)."""


def loose_link(name: str, physics: PhysicsSpec, shapes: Sequence[CollisionShape]) -> LinkSpec:
    """Return the mass properties of an object; a missing inertia is that of its box or sphere."""
    box = bounding_box(shapes)
    x, y, z = (2.0 * half for half in box.size)
    inertia = physics.inertia
    if not any(inertia):
        share = physics.mass / 12.0
        inertia = (share * (y * y + z * z), share * (x * x + z * z), share * (x * x + y * y))
        if _is_ball(shapes):
            inertia = (0.1 * physics.mass * x * x,) * 3
    mx, my, mz = physics.centre_of_mass or box.body_from_shape.position.tolist()
    return LinkSpec(
        name=name,
        mass=physics.mass,
        centre_of_mass=(mx, my, mz),
        inertia=(*inertia, 0.0, 0.0, 0.0),
    )


def object_errors(
    spec: ObjectSpec, physics: PhysicsSpec, shapes: Sequence[CollisionShape], density: float | None
) -> list[Diagnostic]:
    """Return the errors in mass, inertia and volume of a loose object.

    Args:
        spec: the object.
        physics: the physics of the object.
        shapes: the collision shapes of the object.
        density: the density of the water [kg/m3]; None in a scene without buoyancy.
    """
    messages = []
    inertia = min(loose_link(spec.name, physics, shapes).inertia[:3])
    is_heavy = physics.mass > MIN_INERTIA and (inertia > MIN_INERTIA or any(physics.inertia))
    if not is_heavy:  # an inertia in the file is checked where it is read
        messages.append(
            f"the object {spec.name!r} has {physics.mass:g} kg and an inertia of {inertia:.3g} kg "
            f"m2 about an axis; expected more than {MIN_INERTIA:g} of both. A fixed object has "
            "the mass 0"
        )
    elif density is not None and (physics.volume or 0.0) * density > MAX_BUOYANCY * physics.mass:
        box = float(np.prod(2.0 * np.array(bounding_box(shapes).size)))
        messages.append(
            f"the object {spec.name!r} has {physics.mass:g} kg and displaces "
            f"{(physics.volume or 0.0) * density:.4g} kg of water; expected less than "
            f"{MAX_BUOYANCY:g} times the mass. The unit of <u:volume> is m3; the box around it has "
            f"{box:.3g} m3"
        )
    return [diagnostic_at(spec, message, "physics") for message in messages]


def loose_hydrodynamics(
    name: str, physics: PhysicsSpec, shapes: Sequence[CollisionShape], density: float
) -> BodyHydrodynamics:
    """Return the hydrodynamics of a loose object.

    Args:
        name: the name of the object's body in the model.
        physics: the physics of the object.
        shapes: the collision shapes of the object.
        density: the density of the water [kg/m3].
    """
    box = bounding_box(shapes)
    edges = 2.0 * np.array(box.size)  # (3,) [m]
    is_ball = _is_ball(shapes)
    drag = density * (_ball_drag(box.size[0]) if is_ball else box_drag(edges))
    volume = float(np.prod(edges)) * (math.pi / 6.0 if is_ball else 1.0)
    half = 0.5 * edges * (1.0 if is_ball else (6.0 / math.pi) ** (1.0 / 3.0))
    added_mass = ellipsoid_added_mass(half)
    if not is_ball:
        added_mass[:3] = box_added_mass(edges)
    mx, my, mz = box.body_from_shape.position.tolist()
    link = loose_link(name, physics, shapes)
    masses = np.array([physics.mass] * 3 + list(link.inertia[:3]))
    rates = np.array([physics.linear_damping] * 3 + [physics.angular_damping] * 3)
    return BodyHydrodynamics(
        link=name,
        reference=(mx, my, mz),
        added_mass=tuple((density * added_mass).tolist()),
        linear_damping=tuple((masses * np.maximum(rates, 0.0)).tolist()),
        quadratic_damping=tuple(drag.tolist()),
        volume=volume if physics.volume is None else physics.volume,
        centre_of_buoyancy=(mx, my, mz),
        shape="sphere" if is_ball else "box",
        size=(box.size[0],) if is_ball else tuple(edges.tolist()),
        drag_law="speed" if is_ball else "axes",
        implicitness=1.0,
    )


def box_drag(edges: Array) -> Array:
    """Return the quadratic drag of a box divided by the density of the water, (6,) [m2, m5]."""
    x, y, z = edges.tolist()
    faces = [y * z, x * z, x * y]
    # drag of a strip of a face at the distance r from the axis: proportional to r^2, lever arm r
    moments = [
        x * (y**4 + z**4) / 32.0,
        y * (x**4 + z**4) / 32.0,
        z * (x**4 + y**4) / 32.0,
    ]
    return 0.5 * BOX_DRAG * np.array(faces + moments)


def _is_ball(shapes: Sequence[CollisionShape]) -> bool:
    return len(shapes) == 1 and shapes[0].kind == "sphere"


def _ball_drag(radius: float) -> Array:
    translation, rotation = BALL_DRAG * math.pi * radius**2, BALL_TORQUE * radius**5
    return 0.5 * np.array([translation] * 3 + [rotation] * 3)


def box_added_mass(edges: Array) -> Array:
    """Return the added mass of a box along its axes, divided by the density, (3,) [m3]."""
    added_mass = np.empty(3)
    for axis in range(3):
        a, b = sorted(np.delete(edges, axis).tolist())
        plate = np.interp(b / a, *PLATES) * math.pi / 4.0 * a * a * b
        added_mass[axis] = plate * np.interp(edges[axis] / a, *DEPTHS)
    return added_mass


def ellipsoid_added_mass(half: Array) -> Array:
    """Return the added mass of an ellipsoid divided by the density, (6,) [m3, m5].

    Args:
        half: the semi-axes, (3,) [m].
    """
    from scipy.special import elliprd

    a2, b2, c2 = (half**2).tolist()
    volume = 4.0 / 3.0 * math.pi * float(np.prod(half))
    factor = 2.0 / 3.0 * float(np.prod(half))
    alpha = factor * np.array(
        [elliprd(b2, c2, a2), elliprd(c2, a2, b2), elliprd(a2, b2, c2)]
    )  # (3,) [1]
    squares = (a2, b2, c2)
    moments = []
    for axis in range(3):
        j, k = (axis + 1) % 3, (axis + 2) % 3
        gap, total = squares[j] - squares[k], squares[j] + squares[k]
        slope = alpha[j] - alpha[k]
        denominator = 2.0 * gap + total * slope
        if abs(gap) < 1e-9 * total:
            moments.append(0.0)
        else:
            moments.append(max(0.0, volume / 5.0 * gap * gap * -slope / denominator))
    return np.array([*(volume * alpha / (2.0 - alpha)), *moments])
