"""Loose objects that are too thin for a step are warned of, with a step that would do."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from tests.checks.model.test_plausibility import SCENE, written
from tests.support.opened import open_scene
from uwsim.base.geometry import Pose
from uwsim.checks import model_warnings
from uwsim.checks.model.steps import describe_rotation
from uwsim.model.collision.shapes import CollisionShape
from uwsim.scene.object import PhysicsSpec
from uwsim.scene.reader import read_scene


def said(mass: float, edges: tuple[float, float, float], timestep: float) -> str:
    half = tuple(0.5 * edge for edge in edges)
    box = CollisionShape(kind="box", size=half, body_from_shape=Pose.identity())
    return describe_rotation(PhysicsSpec(mass=mass), [box], 1000.0, timestep)


@pytest.mark.parametrize(
    ("mass", "edges", "step"),
    [
        (0.0006, (0.001, 0.001, 0.1), "0.005"),  # a needle
        (0.01, (0.1, 0.004, 0.004), "0.01"),  # a nail
        (0.106, (0.012, 0.12, 0.012), "0.01"),  # a bolt
    ],
)
def test_a_thing_too_thin_for_the_step_is_warned_of_with_one_that_would_do(
    mass: float, edges: tuple[float, float, float], step: str
) -> None:
    text = said(mass, edges, 0.02)
    assert text.endswith(f"expected steps of {step} s at most")
    assert f"it is {1000.0 * sorted(edges)[1]:g} mm thick" in text
    assert said(mass, edges, float(step)) == ""


@pytest.mark.parametrize(
    ("mass", "edges"),
    [
        (0.157, (0.1, 0.1, 0.002)),  # a tag does not roll
        (3.85, (0.025, 0.025, 1.0)),
        (0.0001, (0.001, 0.001, 0.3)),  # it floats
    ],
)
def test_what_bears_the_longest_step_is_not_warned_of(
    mass: float, edges: tuple[float, float, float]
) -> None:
    assert said(mass, edges, 0.02) == ""


def test_a_run_warns_of_it_at_its_own_step(tmp_path: Path) -> None:
    scene = re.sub(r"<mass>1</mass>", "<mass>1</mass> <u:volume>0</u:volume>", SCENE)
    file = "<scaleFactor> <x>0.01</x> <y>0.01</y> <z>0.3</z> </scaleFactor>"
    scene = scene.replace("<physics>", f"{file} <physics>", 1)
    written(tmp_path, scene=scene)
    for timestep, n in ((0.0001, 0), (0.02, 1)):
        with open_scene(
            read_scene(tmp_path / "scene.xml"), is_blind=True, timestep=timestep
        ) as one:
            found = [
                each.message for each in model_warnings(one.world.model) if "thick" in each.message
            ]
        assert len(found) == n, found
