r"""The forces on the nodes of a chain, and the matrix of the equations of its implicit step.

The nodes 0..n-1 have the positions :math:`x_i` and the velocities :math:`v_i` at the *end* of the
step of length h. The segment i of the unstretched length :math:`l_i` connects the nodes i and
i+1. With :math:`d = x_{i+1} - x_i`, the present length :math:`L = |d|` and the tangent
:math:`t = d / L`, the forces are:

- tension :math:`T = \max(0, EA\,\epsilon + C\,\dot\epsilon)` of the strain
  :math:`\epsilon = L / l_i - 1`, never below 0: a tether cannot be pushed;
- bending, from the energy :math:`\tfrac12 EI\,|t_i - t_{i-1}|^2 / \bar l` of each inner node, with
  the mean length :math:`\bar l` of its two segments;
- weight and buoyancy :math:`-(m - \rho A)\,g\,l_i` along z, half of it on each node;
- drag (Morison's equation, in the form of Driscoll and Nahon, Mathematical modeling and simulation
  of a moored buoy system, OCEANS 1996, with constant coefficients) of the velocity u of the water
  relative to the node, with parts across and along the tangent:
  :math:`\tfrac12 \rho d\,(C_n |u_n| u_n + \pi C_t |u_t| u_t)` for a length, half of each segment on
  each of its nodes;
- the ground: :math:`k\,\delta - c\,\dot n` for a length at the depth :math:`\delta` in a plane, and
  friction up to :math:`\mu N`, which grows linearly up to the speed `CREEP_SPEED`.

The matrix :math:`M + h D + h^2 K` has the derivatives D and K without the terms that are not
symmetric and positive semidefinite: it always has a solution.
"""

from __future__ import annotations

import math

import numpy as np

from ...base.geometry import Array
from ...base.numerics.jit import njit
from .line import Equations, Line, Nodes, NodeSurroundings, Shape

GRAVITY = 9.81
"""The acceleration of free fall [m/s2], as of `uwsim.world.GRAVITY`."""
CREEP_SPEED = 1e-3
"""The speed at which friction reaches its limit [m/s]."""
MIN_LENGTH = 1e-9
"""The length of a segment below which it has no direction [m]."""


@njit
def add_block(band: Array, row: int, column: int, block: Array, factor: float) -> None:
    """Add a symmetric block (3, 3) for two nodes, ``row >= column``, to a band matrix.

    Args:
        band: the lower part of the matrix by columns; see `banded.solve_banded`.
        row: the node of the block's rows.
        column: the node of the block's columns.
        block: the block, (3, 3).
        factor: the factor on the block.
    """
    for c in range(3):
        for r in range(3):
            k = 3 * (row - column) + r - c
            if k >= 0:
                band[3 * column + c, k] += factor * block[r, c]


@njit
def find_shape(positions: Array, shape: Shape) -> None:
    """Compute the shape of a chain from the positions of its nodes, (n, 3) [m]."""
    tangents = shape.tangents
    for i in range(len(tangents)):
        x = positions[i + 1, 0] - positions[i, 0]
        y = positions[i + 1, 1] - positions[i, 1]
        z = positions[i + 1, 2] - positions[i, 2]
        length = math.sqrt(x * x + y * y + z * z)
        shape.present_lengths[i] = length
        if length < MIN_LENGTH:
            tangents[i, 0], tangents[i, 1], tangents[i, 2] = 0.0, 0.0, -1.0
        else:
            tangents[i, 0], tangents[i, 1], tangents[i, 2] = x / length, y / length, z / length


@njit
def add_tension(
    line: Line, step: float, nodes: Nodes, shape: Shape, tensions: Array, equations: Equations
) -> None:
    """Add the tension of each segment to the equations.

    Args:
        line: the properties of the tether.
        step: the length of the step [s].
        nodes: the nodes, at the end of the step.
        shape: the shape of the chain.
        tensions: receives the tensions, (n - 1,) [N].
        equations: the equations.
    """
    forces, band = equations
    velocities, lengths, broken_segment = nodes.velocities, nodes.lengths, nodes.broken_segment
    tangents, present_lengths = shape
    block = np.empty((3, 3))
    for i in range(len(lengths)):
        tensions[i] = 0.0
        strain = present_lengths[i] / lengths[i] - 1.0
        if i == broken_segment or present_lengths[i] < MIN_LENGTH:
            continue
        rate = 0.0
        for k in range(3):
            rate += tangents[i, k] * (velocities[i + 1, k] - velocities[i, k])
        tension = line.axial_stiffness * strain + line.axial_damping * rate / lengths[i]
        if tension <= 0.0:
            continue
        tensions[i] = tension
        lateral_part = step * step * tension / present_lengths[i]
        axial_part = step * (step * line.axial_stiffness + line.axial_damping) / lengths[i]
        for r in range(3):
            forces[i, r] += tension * tangents[i, r]
            forces[i + 1, r] -= tension * tangents[i, r]
            for c in range(3):
                block[r, c] = (axial_part - lateral_part) * tangents[i, r] * tangents[i, c]
            block[r, r] += lateral_part
        add_block(band, i, i, block, 1.0)
        add_block(band, i + 1, i + 1, block, 1.0)
        add_block(band, i + 1, i, block, -1.0)


@njit
def add_bending(line: Line, step: float, nodes: Nodes, shape: Shape, equations: Equations) -> None:
    """Add the bending of each inner node; see `add_tension` for the arguments."""
    forces, band = equations
    lengths, broken_segment = nodes.lengths, nodes.broken_segment
    tangents, present_lengths = shape
    slopes = np.empty((3, 3, 3))  # of the change of the tangent by the three nodes [1/m]
    block = np.empty((3, 3))
    for i in range(1, len(lengths)):
        if i in (broken_segment, broken_segment + 1):
            continue
        if present_lengths[i - 1] < MIN_LENGTH or present_lengths[i] < MIN_LENGTH:
            continue
        factor = line.bending_stiffness / (0.5 * (lengths[i - 1] + lengths[i]))
        for r in range(3):
            for c in range(3):
                unit = 1.0 if r == c else 0.0
                slope_before = (unit - tangents[i - 1, r] * tangents[i - 1, c]) / present_lengths[
                    i - 1
                ]
                slope_after = (unit - tangents[i, r] * tangents[i, c]) / present_lengths[i]
                slopes[0, r, c], slopes[1, r, c] = slope_before, -slope_before - slope_after
                slopes[2, r, c] = slope_after
        for p in range(3):
            for r in range(3):
                for c in range(3):  # each slope is a symmetric matrix
                    change = tangents[i, c] - tangents[i - 1, c]
                    forces[i - 1 + p, r] -= factor * slopes[p, r, c] * change
            for q in range(p + 1):
                for r in range(3):
                    for c in range(3):
                        total = 0.0
                        for k in range(3):
                            total += slopes[p, r, k] * slopes[q, k, c]
                        block[r, c] = total
                add_block(band, i - 1 + p, i - 1 + q, block, step * step * factor)


@njit
def add_water(
    line: Line,
    step: float,
    nodes: Nodes,
    water: NodeSurroundings,
    shape: Shape,
    equations: Equations,
) -> None:
    """Add weight, buoyancy and drag of the halves of each segment; see `add_tension`."""
    forces, band = equations
    velocities, lengths = nodes.velocities, nodes.lengths
    tangents = shape.tangents
    block, slip, cross_slip = np.empty((3, 3)), np.empty(3), np.empty(3)
    for i in range(len(lengths)):
        half = 0.5 * lengths[i]
        for node in range(i, i + 2):
            density = water.density[node]
            forces[node, 2] -= (line.mass - density * line.area) * GRAVITY * half
            if density <= 0.0:
                continue
            axial_slip = 0.0
            for k in range(3):
                slip[k] = water.velocity[node, k] - velocities[node, k]
                axial_slip += slip[k] * tangents[i, k]
            square = 0.0
            for k in range(3):
                cross_slip[k] = slip[k] - axial_slip * tangents[i, k]
                square += cross_slip[k] * cross_slip[k]
            speed = math.sqrt(square)
            pressure = 0.5 * density * line.diameter * half
            normal = pressure * line.normal_drag
            tangential = pressure * math.pi * line.tangential_drag * abs(axial_slip)
            for r in range(3):
                forces[node, r] += (
                    normal * speed * cross_slip[r] + tangential * axial_slip * tangents[i, r]
                )
                for c in range(3):
                    value = (2.0 * tangential - normal * speed) * tangents[i, r] * tangents[i, c]
                    if speed > 0.0:
                        value += normal * cross_slip[r] * cross_slip[c] / speed
                    block[r, c] = value
                block[r, r] += normal * speed
            add_block(band, node, node, block, step)


@njit
def add_ground(
    line: Line, step: float, nodes: Nodes, weights: Array, planes: Array, equations: Equations
) -> None:
    """Add the forces of the ground on nodes below their planes; see `add_tension`.

    Args:
        line: the properties of the tether.
        step: the length of the step [s].
        nodes: the nodes, at the end of the step.
        weights: the length of tether of each node; 0: it has no contact, (n,) [m].
        planes: the planes of `NodeSurroundings`.
        equations: the equations.
    """
    forces, band = equations
    positions, velocities = nodes.positions, nodes.velocities
    block = np.empty((3, 3))
    for i in range(len(weights)):
        if weights[i] == 0.0 or planes[i, 4] == 0.0:
            continue
        depth, rate = planes[i, 3] + 0.5 * line.diameter, 0.0
        for k in range(3):
            depth -= planes[i, k] * positions[i, k]
            rate += planes[i, k] * velocities[i, k]
        if depth <= 0.0:
            continue
        stiffness, damping = line.contact_stiffness * weights[i], line.contact_damping * weights[i]
        push = stiffness * depth - damping * rate
        if push <= 0.0:
            continue
        square = 0.0
        for k in range(3):
            square += (velocities[i, k] - rate * planes[i, k]) ** 2
        grip = line.friction * push / max(math.sqrt(square), CREEP_SPEED)
        implicit_stiffness = step * (step * stiffness + damping)
        for r in range(3):
            slide = velocities[i, r] - rate * planes[i, r]
            forces[i, r] += push * planes[i, r] - grip * slide
            for c in range(3):
                block[r, c] = (implicit_stiffness - step * grip) * planes[i, r] * planes[i, c]
            block[r, r] += step * grip
        add_block(band, i, i, block, 1.0)
