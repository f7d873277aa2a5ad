"""The tree over fixed shapes finds what the engine's own finds, and looks into fewer boxes."""

import copy

import mujoco
import numpy as np
import pytest

from uwsim.physics.collision.world_tree import (
    MAX_DEPTH,
    N_LISTED_SHAPES,
    place_fixed_shapes,
    rebuild_world_tree,
)


def plates(n: int, seed: int) -> tuple[mujoco.MjModel, mujoco.MjModel]:
    """The same plates around loose boxes, without and with the new tree."""
    rng = np.random.Generator(np.random.Philox(seed))
    spec = mujoco.MjSpec()
    for _ in range(n):
        size = rng.uniform(0.05, 1.0, 3)
        size[rng.integers(3)] = 0.02
        spec.worldbody.add_geom(
            type=mujoco.mjtGeom.mjGEOM_BOX,
            size=size,
            pos=rng.uniform(-3.0, 3.0, 3),
            quat=rng.normal(size=4),
        )
    for i in range(5):
        body = spec.worldbody.add_body(name=f"box{i}", pos=rng.uniform(-2.0, 2.0, 3))
        body.add_freejoint()
        body.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=rng.uniform(0.1, 0.5, 3))
    before, after = spec.compile(), spec.compile()
    rebuild_world_tree(after)
    return before, after


def touching(model: mujoco.MjModel) -> set[tuple[int, ...]]:
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    found = np.column_stack([data.contact.geom, np.round(data.contact.pos, 9)])
    return {tuple(row) for row in found.tolist()}


@pytest.mark.parametrize("n", [1, 2, 3, 40, 150])
def test_the_same_contacts_are_found(n: int) -> None:
    before, after = plates(n, n)
    assert touching(after) == touching(before)
    if n == 150:
        assert len(touching(after)) > 10


def test_every_shape_is_a_leaf_and_lies_in_all_boxes_above_it() -> None:
    _, model = plates(80, 3)
    leaves = []

    def descend(node: int, low: np.ndarray, high: np.ndarray, depth: int) -> None:
        middle, half = model.bvh_aabb[node, :3], model.bvh_aabb[node, 3:]
        assert np.all(middle - half >= low - 1e-9)
        assert np.all(middle + half <= high + 1e-9)
        assert model.bvh_depth[node] == depth
        if model.bvh_nodeid[node] >= 0:
            leaves.append(int(model.bvh_nodeid[node]))
        else:
            for child in model.bvh_child[node].tolist():
                descend(child, middle - half, middle + half, depth + 1)

    everywhere = np.full(3, np.inf)
    descend(int(model.body_bvhadr[0]), -everywhere, everywhere, 0)
    assert sorted(leaves) == list(range(80))


def test_a_row_of_ever_larger_shapes_is_not_too_deep_for_the_engine() -> None:
    spec = mujoco.MjSpec()
    for i in range(200):
        spec.worldbody.add_geom(size=[1.1**i * 1e-3, 0, 0], pos=[1.1**i * 1e-2, 0, 0])
    model = spec.compile()
    rebuild_world_tree(model)
    assert model.bvh_depth.max() <= MAX_DEPTH + 8


def fallen(model: mujoco.MjModel, data: mujoco.MjData, n: int) -> np.ndarray:
    """The state after n steps, with where contacts are."""
    for _ in range(n):
        mujoco.mj_step(model, data)
    return np.concatenate([data.qpos, data.qvel, data.contact.pos.ravel()])


def test_placed_for_good_fixed_shapes_are_met_just_as_before() -> None:
    _, model = plates(150, 5)
    known = mujoco.MjData(model)
    everywhere = mujoco.MjData(model)
    expected = fallen(model, everywhere, 200)
    place_fixed_shapes(model, known)
    assert model.body_geomnum[0] == N_LISTED_SHAPES
    state = mujoco.mjtState.mjSTATE_INTEGRATION
    start = np.empty(mujoco.mj_stateSize(model, state))
    mujoco.mj_getState(model, known, start, state)
    assert fallen(model, known, 200).tobytes() == expected.tobytes()
    assert known.ncon > 5
    other = copy.copy(known)
    mujoco.mj_setState(model, other, start, state)
    assert fallen(model, other, 200).tobytes() == expected.tobytes()


def test_shapes_of_several_kinds_stay_known_to_the_engine() -> None:
    spec = mujoco.MjSpec()
    for bit in (1, 1, 1, 2):
        spec.worldbody.add_geom(size=[1, 0, 0], contype=bit)
    model = spec.compile()
    place_fixed_shapes(model, mujoco.MjData(model))
    assert model.body_geomnum[0] == 4
