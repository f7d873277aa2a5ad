"""The chain of a tether against closed forms and an independent integrator."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from uwsim.forces.chain.chain_step import advance_chain
from uwsim.forces.chain.line import HELD_MASS, Ends, Line, Nodes, NodeSurroundings

Array = np.ndarray
RHO, DIAMETER = 1000.0, 0.01  # [kg/m3], [m]
AREA = 0.25 * math.pi * DIAMETER**2
BOTH_HELD = Ends(HELD_MASS * np.stack([np.eye(3), np.eye(3)]), np.zeros((2, 3)))
FIRST_HELD = Ends(np.stack([HELD_MASS * np.eye(3), np.zeros((3, 3))]), np.zeros((2, 3)))


def line_of(*, weight: float = 0.0, **values: float) -> Line:
    """A cable of 10 mm with a weight in water [N/m]."""
    numbers = {
        "mass": RHO * AREA + weight / 9.81,
        "area": AREA,
        "diameter": DIAMETER,
        "axial_stiffness": 1e6,
        "axial_damping": 500.0,
        "bending_stiffness": 0.0,
        "normal_drag": 1.2,
        "tangential_drag": 0.01,
        "added_mass": 1.0,
        "contact_stiffness": 1e4,
        "contact_damping": 100.0,
        "friction": 0.4,
    }
    return Line(**(numbers | values))


def nodes_at(positions: Array, lengths: float, broken: int = -1) -> Nodes:
    n = len(positions)
    return Nodes(positions.copy(), np.zeros((n, 3)), np.full(n - 1, lengths), broken)


def advance(
    line: Line,
    nodes: Nodes,
    n_steps: int,
    *,
    step: float = 0.002,
    ends: Ends = BOTH_HELD,
    current: tuple[float, float, float] = (0.0, 0.0, 0.0),
    plane: tuple[float, ...] = (0.0,) * 5,
) -> tuple[Array, Array]:
    """Advance; return the tensions and the forces on the ends."""
    n = len(nodes.positions)
    water = NodeSurroundings(np.tile(current, (n, 1)), np.full(n, RHO), np.tile(plane, (n, 1)))
    tensions, forces = np.zeros(n - 1), np.zeros((2, 3))
    for _ in range(n_steps):
        forces = advance_chain(line, step, nodes, water, ends, tensions)
    return tensions, forces


def with_body(mass: Array) -> Ends:
    """The first end is held; the other one is on a body at rest."""
    return Ends(np.stack([HELD_MASS * np.eye(3), mass]), np.zeros((2, 3)))


def test_a_hung_cable_has_the_shape_and_the_tension_of_the_catenary() -> None:
    """z = a cosh(x / a), T = w a cosh(x / a), with 2 a sinh(D / 2a) = L; to 0.5 % (0.1 % here)."""
    weight, span, length, n = 2.0, 80.0, 100.0, 60
    a = brentq(lambda a: 2.0 * a * math.sinh(0.5 * span / a) - length, 10.0, 1000.0)
    shares = np.linspace(0.0, 1.0, n + 1)
    start = np.zeros((n + 1, 3))
    start[:, 0] = span * (shares - 0.5)
    start[:, 2] = -60.0 * (1.0 - np.abs(2.0 * shares - 1.0))  # a triangle
    nodes = nodes_at(start, length / n)
    line = line_of(weight=weight, axial_stiffness=1e8)
    advance(line, nodes, 1500, step=0.1)
    tensions, _ = advance(line, nodes, 200, step=0.5)
    x = nodes.positions[:, 0]
    sag = a * (np.cosh(0.5 * span / a) - np.cosh(x / a))
    assert nodes.positions[:, 2] == pytest.approx(-sag, abs=1e-3 * sag.max())
    middles = 0.5 * (x[1:] + x[:-1])
    assert tensions == pytest.approx(weight * a * np.cosh(middles / a), rel=1e-3)


def test_a_hanging_cable_stretches_by_its_own_weight() -> None:
    """The elongation is w L^2 / (2 EA)."""
    weight, length, n = 50.0, 20.0, 20
    start = np.zeros((n + 1, 3))
    start[:, 2] = -np.linspace(0.0, length, n + 1)
    nodes = nodes_at(start, length / n)
    tensions, _ = advance(
        line_of(weight=weight, axial_stiffness=1e5), nodes, 400, step=0.05, ends=FIRST_HELD
    )
    elongation = -nodes.positions[-1, 2] - length
    assert elongation == pytest.approx(weight * length**2 / 2e5, rel=1e-4)
    assert tensions[0] == pytest.approx(weight * length * (1.0 - 0.5 / n), rel=1e-6)


def test_a_towed_cable_without_a_load_lies_at_the_critical_angle() -> None:
    """A straight line at the angle where w cos a = rho d C_n U^2 sin^2 a / 2 (Pode 1951)."""
    weight, length, speed, n = 1.5, 30.0, 1.0, 30
    line = line_of(weight=weight, axial_stiffness=1e7)
    start = np.zeros((n + 1, 3))
    start[:, 0] = np.linspace(0.0, length, n + 1)
    nodes = nodes_at(start, length / n)
    tensions, _ = advance(line, nodes, 3000, step=0.1, ends=FIRST_HELD, current=(speed, 0.0, 0.0))
    normal = 0.5 * RHO * DIAMETER * line.normal_drag * speed**2
    angle = brentq(lambda a: weight * math.cos(a) - normal * math.sin(a) ** 2, 1e-3, 0.5 * math.pi)
    end = nodes.positions[-1]
    assert math.atan2(-end[2], end[0]) == pytest.approx(angle, rel=2e-3)
    tangential = 0.5 * RHO * math.pi * DIAMETER * line.tangential_drag * speed**2
    pull = weight * math.sin(angle) + tangential * math.cos(angle) ** 2
    assert tensions[0] == pytest.approx(pull * length * (1.0 - 0.5 / n), rel=2e-3)


def test_a_towed_body_hangs_where_an_independent_integrator_finds_it() -> None:
    """d(T t)/ds = -q(t), from the weight P at the lower end; 2 % are required, 0.5 % found."""
    weight, length, speed, load, n = 0.8, 40.0, 1.2, 60.0, 40
    line = line_of(weight=weight, axial_stiffness=1e7)

    def slopes(s: float, values: Array) -> Array:
        pull = values[3:]
        t = pull / math.sqrt(pull @ pull)
        u = np.array([speed, 0.0, 0.0])
        along = (u @ t) * t
        across = u - along
        drag = line.normal_drag * math.sqrt(across @ across) * across
        drag += math.pi * line.tangential_drag * math.sqrt(along @ along) * along
        force = 0.5 * RHO * DIAMETER * drag - np.array([0.0, 0.0, weight])
        return np.concatenate([t, -force])

    exact = solve_ivp(slopes, (0.0, length), [0, 0, 0, 0, 0, load], rtol=1e-9, atol=1e-9).y[:, -1]
    start = np.zeros((n + 1, 3))
    start[:, 2] = -np.linspace(0.0, length, n + 1)
    nodes = nodes_at(start, length / n)
    ends = with_body(load / 9.81 * np.eye(3))
    tensions = np.zeros(n)
    for _ in range(3000):
        ends.velocities[1] = nodes.velocities[-1]
        ends.velocities[1, 2] -= 9.81 * 0.05  # the engine adds the body's weight
        tensions, _ = advance(line, nodes, 1, step=0.05, ends=ends, current=(speed, 0.0, 0.0))
    position = nodes.positions[0] - nodes.positions[-1]
    assert position == pytest.approx(exact[:3], abs=5e-3 * length)
    top = math.sqrt(exact[3:] @ exact[3:]) - 0.5 * weight * length / n
    assert tensions[0] == pytest.approx(top, rel=5e-3)


@pytest.mark.parametrize("added_mass", [0.0, 1.0])
def test_a_transverse_wave_travels_at_the_speed_of_a_string(added_mass: float) -> None:
    """c = (T / (m + C_a rho A))^1/2; 2 % are required, 0.5 % found."""
    length, n, tension, stiffness = 40.0, 200, 100.0, 1e5
    line = line_of(
        axial_stiffness=stiffness, normal_drag=0.0, tangential_drag=0.0, added_mass=added_mass
    )
    speed = math.sqrt(tension / (line.mass + added_mass * RHO * AREA))
    x = np.linspace(0.0, length, n + 1)
    width, height, begin = 1.5, 0.02, 10.0
    pulse = height * np.exp(-(((x - begin) / width) ** 2))
    start = np.stack([x, np.zeros(n + 1), pulse], axis=1)
    nodes = nodes_at(start, length / n / (1.0 + tension / stiffness))
    nodes.velocities[:, 2] = speed * 2.0 * (x - begin) / width**2 * pulse
    n_steps = round(15.0 / speed / 0.001)
    advance(line, nodes, n_steps, step=0.001)
    shape = nodes.positions[:, 2]
    centre = float((x * shape).sum() / shape.sum())
    assert centre - begin == pytest.approx(speed * n_steps * 0.001, rel=5e-3)


def test_an_axial_wave_travels_at_the_speed_of_sound_in_the_cable() -> None:
    """c = (EA / m)^1/2, found from the first arrival at the middle of half of the final pull."""
    length, n, stiffness = 100.0, 200, 1e4
    line = line_of(
        axial_stiffness=stiffness, axial_damping=0.0, normal_drag=0.0, tangential_drag=0.0
    )
    speed = math.sqrt(stiffness / line.mass)
    start = np.zeros((n + 1, 3))
    start[:, 0] = np.linspace(0.0, length * 1.001, n + 1)
    nodes = nodes_at(start, length / n)
    ends = Ends(BOTH_HELD.masses, np.array([[0.0, 0.0, 0.0], [0.2, 0.0, 0.0]]))
    step, n_steps, middle = 1e-4, 0, n // 2
    rise = 0.0
    before = 0.001 * stiffness
    while rise < 0.5 * 0.2 / speed * stiffness:
        tensions, _ = advance(line, nodes, 1, step=step, ends=ends)
        n_steps, rise = n_steps + 1, float(tensions[middle]) - before
        assert n_steps < 10_000
    assert n_steps * step * speed == pytest.approx(0.5 * length, rel=0.02)


def test_a_beam_on_two_supports_sags_by_its_bending_stiffness() -> None:
    """The middle of a beam sags by 5 w L^4 / (384 EI); one support slides along the beam."""
    weight, length, n, stiffness = 0.05, 2.0, 20, 5.0
    start = np.zeros((n + 1, 3))
    start[:, 0] = np.linspace(0.0, length, n + 1)
    nodes = nodes_at(start, length / n)
    line = line_of(weight=weight, bending_stiffness=stiffness)
    advance(line, nodes, 300, step=0.05, ends=with_body(np.diag([0.0, HELD_MASS, HELD_MASS])))
    sag = 5.0 * weight * length**4 / (384.0 * stiffness)
    assert -nodes.positions[n // 2, 2] == pytest.approx(sag, rel=0.01)


def test_the_momentum_of_two_free_bodies_and_their_tether_is_conserved() -> None:
    """Without drag and weight; the tether is taut at first."""
    masses = np.stack([5.0 * np.eye(3), np.diag([20.0, 30.0, 40.0])])
    n = 12
    start = np.zeros((n + 1, 3))
    start[:, 0] = np.linspace(0.0, 6.3, n + 1)
    nodes = nodes_at(start, 0.5)
    nodes.velocities[0] = 0.3, 0.5, -0.1
    ends = Ends(masses, nodes.velocities[[0, -1]])
    line = line_of(normal_drag=0.0, tangential_drag=0.0, added_mass=0.0, axial_stiffness=1e6)
    lumps = np.full(n + 1, line.mass * 0.5)
    lumps[[0, -1]] *= 0.5

    def momentum() -> Array:
        v = nodes.velocities
        return np.asarray(lumps @ v + masses[0] @ v[0] + masses[1] @ v[-1])

    before = momentum()
    for _ in range(500):
        advance(line, nodes, 1, step=0.005, ends=ends)
        ends.velocities[:] = nodes.velocities[[0, -1]]
    assert momentum() == pytest.approx(before, abs=1e-4)


@pytest.mark.parametrize("step", [0.002, 0.005, 0.01])
def test_a_light_body_on_a_stiff_tether_comes_to_rest_without_growing_oscillation(
    step: float,
) -> None:
    """0.2 kg on segments of 4e7 N/m: an explicit force is unstable above 0.14 ms."""
    n, load = 10, 5.0
    start = np.zeros((n + 1, 3))
    start[:, 2] = -np.linspace(0.0, 2.5, n + 1)
    nodes = nodes_at(start, 0.25)
    ends, line = with_body(0.2 * np.eye(3)), line_of(axial_stiffness=1e7)
    tensions = np.zeros(n)
    for _ in range(400):
        ends.velocities[1] = nodes.velocities[-1] - np.array([0.0, 0.0, load / 0.2 * step])
        tensions, _ = advance(line, nodes, 1, step=step, ends=ends)
    assert tensions == pytest.approx(np.full(n, load), rel=1e-3)
    assert np.abs(nodes.velocities).max() < load / 0.2 * step + 0.01


def test_a_cable_on_the_ground_sinks_in_by_its_weight_and_slides_at_the_friction_limit() -> None:
    """The depth is w / k; dragged along itself it takes mu w L."""
    weight, n = 4.0, 10
    start = np.zeros((n + 1, 3))
    start[:, 0] = np.arange(n + 1)
    start[:, 2] = 0.5 * DIAMETER
    nodes = nodes_at(start, 1.0)
    line = line_of(weight=weight, tangential_drag=0.0, normal_drag=0.0)
    floor = (0.0, 0.0, 1.0, 0.0, 1.0)
    ends = Ends(
        np.stack([np.zeros((3, 3)), HELD_MASS * np.eye(3)]), np.array([[0.0] * 3, [0.1, 0.0, 0.0]])
    )
    tensions, _ = advance(line, nodes, 2000, plane=floor, ends=ends)
    depth = 0.5 * DIAMETER - nodes.positions[5, 2]
    assert depth == pytest.approx(weight / line.contact_stiffness, rel=0.02)
    assert tensions[-1] == pytest.approx(line.friction * weight * (n - 1), rel=0.1)


def test_a_broken_segment_pulls_no_more() -> None:
    start = np.zeros((5, 3))
    start[:, 2] = -np.arange(5.0)
    nodes = nodes_at(start, 1.0, broken=1)
    tensions, _ = advance(line_of(weight=3.0), nodes, 3000, step=0.01, ends=FIRST_HELD)
    assert tensions[1] == 0.0
    assert tensions[0] == pytest.approx(3.0, rel=1e-3)  # it, and half of the broken one
    assert nodes.positions[-1, 2] < -10.0
