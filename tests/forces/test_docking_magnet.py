"""Two magnets: the law of dipoles, its balance, its limit at contact."""

from __future__ import annotations

import math

import numpy as np
import pytest

from uwsim.forces.docking_magnet import dipole_wrenches

PERMEABILITY = 4e-7 * math.pi  # of the vacuum [N/A2]
X = np.array([1.0, 0.0, 0.0])


def field(moment: np.ndarray, point: np.ndarray) -> np.ndarray:
    """That of a dipole, from the potential of two poles that are close together [T]."""

    def of_pole(strength: float, place: np.ndarray) -> np.ndarray:
        way = point - place
        return np.asarray(PERMEABILITY * strength / (4.0 * math.pi) * way / (way @ way) ** 1.5)

    size = float(np.linalg.norm(moment))
    half = 5e-4 * moment / size  # [m]
    return of_pole(size / 1e-3, half) + of_pole(-size / 1e-3, -half)


def random_pair(seed: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    random = np.random.Generator(np.random.Philox(seed))
    return random.normal(size=3), random.normal(size=3), random.normal(size=3)


def test_magnets_in_line_attract_each_other_with_the_textbook_force() -> None:
    """3 mu m1 m2 / (2 pi r^4) (Yung, Landecker, Villani 1998, their equation for one axis)."""
    on_first, on_second = dipole_wrenches(5.0 * X, 7.0 * X, 0.3 * X, 0.01)
    strength = 3.0 * PERMEABILITY * 5.0 * 7.0 / (2.0 * math.pi * 0.3**4)
    assert on_second == pytest.approx([-strength, 0, 0, 0, 0, 0])
    assert on_first == pytest.approx([strength, 0, 0, 0, 0, 0])


def test_magnets_side_by_side_repel_each_other_with_half_of_that() -> None:
    up = np.array([0.0, 0.0, 1.0])
    _, on_second = dipole_wrenches(5.0 * up, 7.0 * up, 0.3 * X, 0.01)
    assert on_second[0] == pytest.approx(3.0 * PERMEABILITY * 5.0 * 7.0 / (4.0 * math.pi * 0.3**4))


@pytest.mark.parametrize("seed", range(5))
def test_the_wrench_is_that_of_the_field_of_two_poles_on_two_poles(seed: int) -> None:
    first, second, way = random_pair(seed)
    _, on_second = dipole_wrenches(first, second, way, 1e-3)
    half, pole = 5e-4 * second / np.linalg.norm(second), float(np.linalg.norm(second)) / 1e-3
    north, south = pole * field(first, way + half), -pole * field(first, way - half)
    torque = np.cross(half, north) - np.cross(half, south)
    scale = float(np.abs(on_second).max())
    assert on_second == pytest.approx([*(north + south), *torque], abs=1e-4 * scale)


@pytest.mark.parametrize("closest", [0.01, 20.0])
@pytest.mark.parametrize("seed", range(5))
def test_action_is_reaction_in_force_and_in_torque_also_near_contact(
    seed: int, closest: float
) -> None:
    first, second, way = random_pair(seed)
    on_first, on_second = dipole_wrenches(first, second, way, closest)
    assert on_first[:3].tolist() == (-on_second[:3]).tolist()
    balance = on_first[3:] + on_second[3:] + np.cross(way, on_second[:3])
    assert balance == pytest.approx(np.zeros(3), abs=1e-12 * float(np.abs(on_second).max()))


def test_nearer_than_contact_the_force_is_that_at_contact_and_without_direction_none() -> None:
    at_contact = dipole_wrenches(5.0 * X, 7.0 * X, 0.02 * X, 0.02)[1]
    assert dipole_wrenches(5.0 * X, 7.0 * X, 0.001 * X, 0.02)[1] == pytest.approx(at_contact)
    assert not np.any(dipole_wrenches(5.0 * X, 7.0 * X, 0.0 * X, 0.02))
