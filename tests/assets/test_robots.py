import math
from functools import cache

import numpy as np
import pytest
from scipy.spatial import cKDTree

from uwsim.assets import find, load_model
from uwsim.base.geometry import Pose
from uwsim.scene.urdf.kinematics import link_poses
from uwsim.scene.urdf.reader import read_urdf

POSTURES = [
    (0.0, 0.0, 2.15, 0.0, 0.8),
    (0.0, 0.0, 0.0, 0.0, 0.0),
    (-1.5, 0.8, 0.8, 1.0, 0.3),
    (0.5, 1.5, 1.2, -2.0, 1.3),
]


@cache
def points(posture: tuple[float, ...]) -> dict[str, np.ndarray]:
    """Points spread over each link's triangles in base_link, (n, 3) [m]."""
    path = find("data/scenes/g500ARM5.urdf")
    assert path is not None
    robot = read_urdf(path)
    poses = link_poses(robot, posture)
    spread = {}
    for link in robot.links:
        if link.visual is None:
            continue
        visual = Pose.from_rpy(link.visual.position, link.visual.rpy)
        corners = np.concatenate(
            [m.vertices[m.triangles].astype(float) for m in load_model(link.visual.file).meshes]
        )
        weights = np.array(
            [[1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 0], [0, 1, 1], [1, 0, 1]], float
        )
        weights /= weights.sum(axis=1, keepdims=True)
        samples = np.einsum("wk,mkc->mwc", weights, corners).reshape(-1, 3)
        spread[link.name] = (poses[link.name] @ visual).transform(samples)
    return spread


@pytest.mark.parametrize("posture", POSTURES)
@pytest.mark.parametrize(
    ("inner", "outer"),
    [("part0", "part1"), ("part1", "part2"), ("part2", "part3"), ("part3", "part4_base"),
     ("part4_base", "part4_jaw1"), ("part4_base", "part4_jaw2"), ("base_link", "part0")],
)  # fmt: skip
def test_links_touch_in_every_posture(posture: tuple[float, ...], inner: str, outer: str) -> None:
    spread = points(posture)
    distances, _ = cKDTree(spread[inner]).query(spread[outer])
    assert distances.min() < 0.015


@pytest.mark.parametrize(
    ("joint", "a", "b"), [("part2", "part1", "part2"), ("part3", "part2", "part3")]
)
def test_both_links_have_metal_round_the_axis_they_turn_about(joint: str, a: str, b: str) -> None:
    path = find("data/scenes/g500ARM5.urdf")
    assert path is not None
    for posture in POSTURES:
        origin = link_poses(read_urdf(path), posture)[joint].position
        spread = points(posture)
        for link in (a, b):
            assert np.linalg.norm(spread[link] - origin, axis=1).min() < 0.035


def vehicle() -> np.ndarray:
    return points(POSTURES[0])["base_link"]


def test_the_hulls_are_where_the_literature_has_them() -> None:
    body = vehicle()
    upper = body[(body[:, 2] < 0.19) & (np.abs(body[:, 1]) > 0.2)]
    assert np.abs(upper[:, 1]).max() == pytest.approx(0.35 + 0.153 + 0.011, abs=0.005)
    assert body[:, 0].max() - body[:, 0].min() == pytest.approx(1.507, abs=0.01)
    assert body[:, 0].min() == pytest.approx(-0.049 - 1.507 / 2, abs=0.01)


def test_the_vehicle_is_mirror_symmetric_in_its_hulls_and_about_a_metre_high_and_wide() -> None:
    body = vehicle()
    assert body[:, 1].min() == pytest.approx(-body[:, 1].max(), abs=0.005)
    assert 0.95 < body[:, 2].max() - body[:, 2].min() < 1.25
    assert 0.95 < np.ptp(body[:, 1]) < 1.1


@pytest.mark.parametrize("side", [-1.0, 1.0])
def test_the_cameras_beside_the_arm_look_past_vehicle_and_arm_base(side: float) -> None:
    camera = np.array([0.2, side * 0.1, 0.95])
    assert vehicle()[:, 2].max() < camera[2] - 0.02
    for link in ("part0", "part1"):
        seen = points(POSTURES[0])[link] - camera
        seen = seen[seen[:, 2] > 1e-3]
        if link == "part0" or side < 0:
            wide = np.maximum(
                np.abs(seen[:, 0]) / (math.tan(math.radians(25)) * 4 / 3),
                np.abs(seen[:, 1]) / math.tan(math.radians(25)),
            )
            assert (wide > seen[:, 2]).all()


def test_the_jaws_meet_when_closed_and_part_when_opened() -> None:
    closed, opened = points((0.0, 0.0, 0.0, 0.0, 0.0)), points((0.0, 0.0, 0.0, 0.0, 1.0))

    def apart(spread: dict[str, np.ndarray]) -> float:
        tips = []
        for jaw in ("part4_jaw1", "part4_jaw2"):
            far = np.linalg.norm(spread[jaw] - spread["part4_base"].mean(axis=0), axis=1)
            tips.append(spread[jaw][np.argsort(far)[-20:]].mean(axis=0))
        return float(np.linalg.norm(tips[0] - tips[1]))

    assert apart(closed) < 0.03
    assert apart(opened) > 0.12
