"""The properties of a tether's material and of its surroundings, for compiled code."""

from __future__ import annotations

from typing import NamedTuple

from ...base.geometry import Array


class Line(NamedTuple):
    """The properties of a tether, which are the same along its length."""

    mass: float
    """The mass per length [kg/m]."""
    area: float
    """The area of the cross section, which displaces water [m2]."""
    diameter: float
    """The diameter, to which the drag refers [m]."""
    axial_stiffness: float
    """The tension by the strain, EA [N]."""
    axial_damping: float
    """The tension by the rate of the strain [N s]."""
    bending_stiffness: float
    """The bending moment by the curvature, EI [N m2]."""
    normal_drag: float
    """The drag coefficient across the tether, on the area of its side view [1]."""
    tangential_drag: float
    """The drag coefficient along the tether, on the area of its skin [1]."""
    added_mass: float
    """The added mass across the tether, in displaced masses [1]."""
    contact_stiffness: float
    """The force of the ground on a length of tether, by its depth in the ground [N/m2]."""
    contact_damping: float
    """The force of the ground on a length of tether, by its speed into the ground [N s/m2]."""
    friction: float
    """The friction coefficient on the ground [1]."""


class NodeSurroundings(NamedTuple):
    """The water and the ground at the nodes of a chain."""

    velocity: Array
    """The velocity of the water in W, (n, 3) [m/s]."""
    density: Array
    """The density of the water, 0 in the air, (n,) [kg/m3]."""
    planes: Array
    """The plane of the ground near each node: its unit normal n, the product n p with a point p of
    the plane [m], and 1; or zeros without ground nearby; (n, 5)."""


HELD_MASS = 1e30
"""The mass of a body whose velocity is prescribed [kg]."""


class Ends(NamedTuple):
    """The bodies at both ends of a chain."""

    masses: Array
    """The mass of each body for forces at its end, (2, 3, 3) [kg]; 0 for a free end, and
    `HELD_MASS` times the identity for a prescribed velocity."""
    velocities: Array
    """The velocities of the bodies at the ends, at the beginning of the step, (2, 3) [m/s]."""


class Nodes(NamedTuple):
    """The n nodes of a chain, and the segments between them."""

    positions: Array
    """The positions in W, (n, 3) [m]."""
    velocities: Array
    """The velocities in W, (n, 3) [m/s]."""
    lengths: Array
    """The unstretched lengths of the segments, (n - 1,) [m]."""
    broken_segment: int
    """The index of the broken segment; -1: none."""


class Shape(NamedTuple):
    """The shape of a chain."""

    tangents: Array
    """The unit vector along each segment, (n - 1, 3)."""
    present_lengths: Array
    """The present length of each segment, (n - 1,) [m]."""


class Equations(NamedTuple):
    """The linear equations of an iteration of the implicit step."""

    forces: Array
    """The forces on the nodes, (n, 3) [N]."""
    band: Array
    """The lower part of the symmetric matrix by columns, ``band[j, k] = A[j + k, j]``, [kg]."""
