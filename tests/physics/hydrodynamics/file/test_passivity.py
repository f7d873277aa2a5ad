"""Drag that would drive a body is refused: against closed forms and a blind search."""

from __future__ import annotations

import numpy as np
import pytest

from tests.physics.water_models import free_body
from uwsim.base.rng import stream
from uwsim.scene.hydrodynamics import BadHydrodynamics, BodyHydrodynamics
from uwsim.scene.hydrodynamics.checks import body_errors
from uwsim.scene.hydrodynamics.passivity import Kind, driving_motion, passive_share

DIAGONAL = (5.0, 8.0, 8.0, 0.5, 0.5, 0.5)


def coupled(block: list[list[float]], i: int = 1, j: int = 5) -> np.ndarray:
    """A diagonal with a 2x2 block in the rows and columns i and j."""
    drag = np.diag(DIAGONAL)
    drag[np.ix_([i, j], [i, j])] = block
    return drag


def quadratic_bound(b: float) -> float:
    """The greatest a of [[1, a], [a, b]]: 1 + b t^3 >= a (t + t^2) for every t > 0."""
    t = np.geomspace(1e-4, 1e4, 2_000_001)
    return float(((1.0 + b * t**3) / (t + t**2)).min())


@pytest.mark.parametrize(
    ("kind", "block", "most"),
    [
        ("linear", [[1.0, 1.0], [0.0, 4.0]], 4.0),  # a^2 <= 4 b for one entry
        ("linear", [[1.0, 1.0], [1.0, 9.0]], 3.0),  # a^2 <= b for two
        ("quadratic", [[1.0, 1.0], [1.0, 1.0]], 1.0),  # (1-t)^2 (1+t) >= 0
        ("quadratic", [[1.0, 1.0], [1.0, 100.0]], quadratic_bound(100.0)),
        ("quadratic", [[1.0, 1.0], [0.0, 100.0]], 3.0 * 50.0 ** (2.0 / 3.0)),
        ("quadratic", [[1.0, 0.0], [1.0, 100.0]], 3.0 * 0.5 ** (2.0 / 3.0) * 100.0 ** (1.0 / 3.0)),
    ],
)
def test_couplings_are_borne_up_to_the_closed_form(
    kind: Kind, block: list[list[float]], most: float
) -> None:
    def with_coupling(a: float) -> np.ndarray:
        return coupled([[block[0][0], a * block[0][1]], [a * block[1][0], block[1][1]]])

    for sign in (1.0, -1.0):
        assert driving_motion(kind, with_coupling(0.999 * sign * most)) is None
        found = driving_motion(kind, with_coupling(1.01 * sign * most))
        assert found is not None
        motion, power = found
        drag = with_coupling(1.01 * sign * most)
        moved = motion if kind == "linear" else motion * np.abs(motion)
        assert power == pytest.approx(-motion @ drag @ moved, rel=1e-9)
        assert power > 0.0
    assert passive_share(kind, with_coupling(2.0 * most)) == pytest.approx(0.5, abs=0.011)


def test_a_turning_force_takes_no_energy() -> None:
    assert driving_motion("linear", coupled([[1.0, 50.0], [-50.0, 1.0]])) is None


@pytest.mark.parametrize("kind", ["linear", "quadratic"])
def test_couplings_of_all_six_axes_are_found_as_a_blind_search_finds_them(kind: Kind) -> None:
    random = stream(3, "passivity")
    for strength in (0.1, 0.6, 1.0, 2.0):
        drag = np.eye(6) + strength * random.uniform(-1.0, 1.0, (6, 6)) * (1.0 - np.eye(6))
        motions = random.standard_normal((200_000, 6))
        moved = motions if kind == "linear" else np.abs(motions) * motions
        least = float((motions * (moved @ drag.T)).sum(axis=1).min())
        assert least >= 0.0 or driving_motion(kind, drag) is not None
        assert strength > 0.1 or driving_motion(kind, drag) is None


@pytest.mark.parametrize("name", ["linear_damping", "quadratic_damping"])
def test_a_damping_that_drives_the_body_is_refused_with_the_motion(name: str) -> None:
    numbers = tuple(coupled([[8.0, 30.0], [30.0, 0.5]]).ravel().tolist())
    body = BodyHydrodynamics(link="hull", volume=0.02, **{name: numbers})  # type: ignore[arg-type]
    (said,) = body_errors(body)
    assert said.startswith(f"link 'hull': {name.replace('_', ' ')} drives the body with ")
    assert "Expected drag that only takes energy: entries off this diagonal at most 0." in said
    with pytest.raises(BadHydrodynamics, match="drives the body"):
        free_body(body, mass=20.0)


def test_drag_of_an_axis_without_any_of_its_own_says_none() -> None:
    numbers = tuple(coupled([[0.0, 0.1], [0.0, 0.5]]).ravel().tolist())
    (said,) = body_errors(BodyHydrodynamics(link="hull", linear_damping=numbers))
    assert said.endswith("entries off this diagonal 0 where that is 0")
