r"""The implicit step of a chain of nodes.

The velocities :math:`v'` at the end of a step of length h solve

.. math:: M (v' - v) = h\,F(x + h v', v')

(the implicit Euler method) by Newton's method with the matrix of `assembly`. M has the mass of half
of each segment at its nodes and the added mass across it. At an end on a body it also has the mass
of that body for forces at that point, whose v is the velocity of the body. The motion of the body
is thus solved together with the chain, and the force on the body is that at the end of the step. It
remains stable where an explicit force would not, whatever the stiffness. The method is of first
order in h and damps motions that are faster than a few steps: a motion of the angular frequency w
loses the part :math:`w h / 2` of its amplitude per radian.
"""

from __future__ import annotations

import numpy as np

from ...base.geometry import Array
from ...base.numerics.jit import njit
from .assembly import (
    add_bending,
    add_block,
    add_ground,
    add_tension,
    add_water,
    find_shape,
)
from .banded import solve_banded
from .line import Ends, Equations, Line, Nodes, NodeSurroundings, Shape

MAX_ITERATIONS = 20
"""The largest number of Newton's iterations in a step."""
N_FULL_STEPS = 6
"""The number of iterations after which the changes are halved, as where segments become slack and
taut in turn."""
TOLERANCE = 1e-7
"""The change of a velocity at which the iterations end [m/s]."""
BLOCK_WIDTH, BENDING_WIDTH = 6, 9
"""The numbers of diagonals of the lower part of the matrix without and with bending."""


@njit
def find_masses(line: Line, lengths: Array, water: NodeSurroundings, tangents: Array) -> Array:
    """Return the mass matrix of each node without the bodies at the ends, (n, 3, 3) [kg]."""
    masses = np.zeros((len(lengths) + 1, 3, 3))
    for i in range(len(lengths)):
        half = 0.5 * lengths[i]
        for node in range(i, i + 2):
            added_mass = line.added_mass * water.density[node] * line.area * half
            for r in range(3):
                masses[node, r, r] += line.mass * half + added_mass
                for c in range(3):
                    masses[node, r, c] -= added_mass * tangents[i, r] * tangents[i, c]
    return masses


@njit
def contact_lengths(lengths: Array) -> Array:
    """Return the length of tether of each node for its contact; 0 at the ends, (n,) [m]."""
    n = len(lengths) + 1
    shares = np.zeros(n)
    for i in range(1, n - 1):
        shares[i] = 0.5 * (lengths[i - 1] + lengths[i])
    return shares


@njit
def add_inertia(
    step: float,
    masses: Array,
    start: Array,
    ends: Ends,
    nodes: Nodes,
    equations: Equations,
    right: Array,
) -> None:
    """Add the masses of nodes and bodies to the matrix; compute the right side of the equations.

    Args:
        step: the length of the step [s].
        masses: the mass matrix of each node, (n, 3, 3) [kg].
        start: the velocities at the beginning of the step, (n, 3) [m/s].
        ends: the bodies at the ends.
        nodes: the nodes, at the end of the step.
        equations: the equations.
        right: receives the right side, (3 n,) [N s].
    """
    for i in range(len(masses)):
        add_block(equations.band, i, i, masses[i], 1.0)
        for r in range(3):
            momentum = 0.0
            for c in range(3):
                momentum += masses[i, r, c] * (nodes.velocities[i, c] - start[i, c])
            right[3 * i + r] = step * equations.forces[i, r] - momentum
    for side in range(2):
        i = side * (len(masses) - 1)
        add_block(equations.band, i, i, ends.masses[side], 1.0)
        for r in range(3):
            for c in range(3):
                rise = nodes.velocities[i, c] - ends.velocities[side, c]
                right[3 * i + r] -= ends.masses[side, r, c] * rise


@njit
def advance_chain(
    line: Line, step: float, nodes: Nodes, water: NodeSurroundings, ends: Ends, tensions: Array
) -> Array:
    """Advance a chain by a step.

    Args:
        line: the properties of the tether.
        step: the length of the step [s].
        nodes: the nodes, which are advanced. The positions of the ends are those of their bodies.
        water: the water and the ground at the nodes, at the beginning of the step.
        ends: the bodies at the ends.
        tensions: receives the tension of each segment at the end of the step, (n - 1,) [N].

    Returns:
        The force of the chain on the body at each end, (2, 3) [N].
    """
    n = len(nodes.positions)
    velocities = nodes.velocities
    place, start = nodes.positions.copy(), velocities.copy()
    end_nodes = Nodes(place, velocities, nodes.lengths, nodes.broken_segment)
    shape = Shape(np.empty((n - 1, 3)), np.empty(n - 1))
    find_shape(place, shape)
    masses = find_masses(line, nodes.lengths, water, shape.tangents)
    weights = contact_lengths(nodes.lengths)
    width = BENDING_WIDTH if line.bending_stiffness > 0.0 else BLOCK_WIDTH
    equations = Equations(np.empty((n, 3)), np.empty((3 * n, width)))
    change = np.empty(3 * n)
    for iteration in range(MAX_ITERATIONS):
        for i in range(n):
            for k in range(3):
                place[i, k] = nodes.positions[i, k] + step * velocities[i, k]
        find_shape(place, shape)
        equations.forces[:], equations.band[:] = 0.0, 0.0
        add_tension(line, step, end_nodes, shape, tensions, equations)
        if line.bending_stiffness > 0.0:
            add_bending(line, step, end_nodes, shape, equations)
        add_water(line, step, end_nodes, water, shape, equations)
        add_ground(line, step, end_nodes, weights, water.planes, equations)
        add_inertia(step, masses, start, ends, end_nodes, equations, change)
        solve_banded(equations.band, change)
        share = 1.0 if iteration < N_FULL_STEPS else 0.5
        largest_change = 0.0
        for i in range(n):
            for k in range(3):
                velocities[i, k] += share * change[3 * i + k]
                largest_change = max(largest_change, abs(change[3 * i + k]))
        if largest_change < TOLERANCE:
            break
    end_forces = np.zeros((2, 3))
    for side in range(2):
        for r in range(3):
            for c in range(3):
                rise = velocities[side * (n - 1), c] - ends.velocities[side, c]
                end_forces[side, r] += ends.masses[side, r, c] * rise / step
    for i in range(n):
        for k in range(3):
            nodes.positions[i, k] += step * velocities[i, k]
    return end_forces
