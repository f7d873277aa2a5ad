"""The robot of showcase scenes: that of the paper's scenes in all but its meshes."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial import cKDTree

from uwsim.assets import find, load_model
from uwsim.base.geometry import Pose
from uwsim.scene.urdf.kinematics import link_poses
from uwsim.scene.urdf.reader import read_urdf
from uwsim.scene.urdf.robot import RobotSpec

POSTURES = [
    (0.0, 0.0, 2.15, 0.0, 0.8),
    (0.0, 0.0, 0.0, 0.0, 0.0),
    (-1.5, 0.8, 0.8, 1.0, 0.3),
    (0.5, 1.5, 1.2, -2.0, 1.3),
]
NEIGHBOURS = [
    ("base_link", "part0"), ("part0", "part1"), ("part1", "part2"), ("part2", "part3"),
    ("part3", "part4_base"), ("part4_base", "part4_jaw1"), ("part4_base", "part4_jaw2"),
]  # fmt: skip


def robot(name: str) -> RobotSpec:
    path = find(name)
    assert path is not None
    return read_urdf(path)


def without_meshes(spec: RobotSpec) -> list[object]:
    return [
        *(replace(link, visuals=()) for link in spec.links),
        *spec.joints,
        *(visual.position for link in spec.links for visual in link.visuals),
        *(visual.rpy for link in spec.links for visual in link.visuals),
    ]


def points(posture: tuple[float, ...]) -> dict[str, np.ndarray]:
    """Return points on each link in base_link, (n, 3) [m]."""
    spec = robot("girona500_arm5e.urdf")
    poses = link_poses(spec, posture)
    samples = {}
    for link in spec.links:
        for visual in link.visuals:
            corners = np.concatenate(
                [m.vertices[m.triangles].astype(float) for m in load_model(visual.file).meshes]
            )
            middles = np.concatenate([corners.reshape(-1, 3), corners.mean(axis=1)])
            pose = poses[link.name] @ Pose.from_rpy(visual.position, visual.rpy)
            samples[link.name] = pose.transform(middles)
    return samples


def test_only_the_meshes_differ_from_the_robot_of_the_paper() -> None:
    spec, original = robot("girona500_arm5e.urdf"), robot("g500ARM5.urdf")
    assert without_meshes(spec) == without_meshes(original)
    assert all(load_model(v.file).source == "bundled" for link in spec.links for v in link.visuals)


@pytest.mark.parametrize("posture", POSTURES)
def test_neighbours_touch_in_every_posture(posture: tuple[float, ...]) -> None:
    samples = points(posture)
    for inner, outer in NEIGHBOURS:
        distances, _ = cKDTree(samples[inner]).query(samples[outer])
        assert distances.min() < 0.015, (inner, outer)


def test_links_are_about_as_large_as_those_of_the_paper() -> None:
    spec, original = robot("girona500_arm5e.urdf"), robot("g500ARM5.urdf")
    for link, old in zip(spec.links, original.links, strict=True):
        for visual, old_visual in zip(link.visuals, old.visuals, strict=True):
            box, old_box = load_model(visual.file).box, load_model(old_visual.file).box
            np.testing.assert_allclose(box.lower, old_box.lower, atol=0.1)
            np.testing.assert_allclose(box.upper, old_box.upper, atol=0.1)


def test_closed_jaws_leave_16_mm_between_parallel_pads() -> None:
    samples = points((0.0, 0.0, 0.0, 0.0, 0.0))
    distances, _ = cKDTree(samples["part4_jaw1"]).query(samples["part4_jaw2"])
    assert distances.min() == pytest.approx(0.016, abs=0.001)
