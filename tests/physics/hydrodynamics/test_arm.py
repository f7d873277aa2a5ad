"""A chain of links, each with full added mass: against Lagrange's equations, and its energy."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from tests.physics.water_models import FAR_BELOW, random_added_mass, set_options
from uwsim.physics.hydrodynamics import columns as c
from uwsim.physics.hydrodynamics import prepare
from uwsim.physics.hydrodynamics.hydrodynamics import install
from uwsim.scene.hydrodynamics import BodyHydrodynamics

N = 5
RNG = np.random.default_rng(5)
OFFSETS = [RNG.normal(scale=0.4, size=3) for _ in range(N)]  # of the joint, in the parent [m]
TURNS = [Rotation.random(random_state=int(RNG.integers(1000))) for _ in range(N)]
AXES = [axis / np.linalg.norm(axis) for axis in RNG.normal(size=(N, 3))]
MASSES = RNG.uniform(0.5, 3.0, N)  # [kg]
CENTRES = RNG.normal(scale=0.1, size=(N, 3))  # of mass, in the link [m]
INERTIAS = RNG.uniform(0.05, 0.09, (N, 3))  # [kg m2]
ADDED = [np.array(random_added_mass(RNG, 2.0)).reshape(6, 6) for _ in range(N)]


def arm(*, free: bool, integrator: str = "RK4", gravity: float = 0.0) -> mujoco.MjModel:
    spec = mujoco.MjSpec()
    set_options(spec, integrator=integrator, gravity=gravity)
    node, waters = spec.worldbody, {}
    for i in range(N):
        quat = TURNS[i].as_quat()[[3, 0, 1, 2]]
        node = node.add_body(
            name=f"link{i}", pos=OFFSETS[i].tolist(), quat=quat.tolist(), mass=MASSES[i],
            ipos=CENTRES[i].tolist(), inertia=INERTIAS[i].tolist(),
        )  # fmt: skip
        node.explicitinertial = True
        if free and i == 0:
            node.add_freejoint()
        else:
            node.add_joint(type=mujoco.mjtJoint.mjJNT_HINGE, axis=AXES[i].tolist())
        waters[f"link{i}"] = BodyHydrodynamics(link=f"link{i}", added_mass=tuple(ADDED[i].ravel()))
    prepare(spec, waters, surface=FAR_BELOW)
    return spec.compile()


def twists(q: np.ndarray) -> list[np.ndarray]:
    """Jacobian of each link's body twist (linear first) at its origin, from its own kinematics."""
    origin, turn = np.zeros(3), Rotation.identity()
    anchors, axes, found = [], [], []
    for i in range(N):
        origin = origin + turn.apply(OFFSETS[i])
        turn = turn * TURNS[i]
        axes.append(turn.apply(AXES[i]))
        anchors.append(origin)
        turn = turn * Rotation.from_rotvec(AXES[i] * q[i])
        jacobian = np.zeros((6, N))
        for j in range(i + 1):
            jacobian[:3, j] = turn.inv().apply(np.cross(axes[j], origin - anchors[j]))
            jacobian[3:, j] = turn.inv().apply(axes[j])
        found.append(jacobian)
    return found


def skew(a: np.ndarray) -> np.ndarray:
    return np.array([[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]])


def mass_matrix(q: np.ndarray) -> np.ndarray:
    total = np.zeros((N, N))
    for i, jacobian in enumerate(twists(q)):
        s = skew(CENTRES[i])
        rigid = np.block(
            [
                [MASSES[i] * np.eye(3), -MASSES[i] * s],
                [MASSES[i] * s, np.diag(INERTIAS[i]) - MASSES[i] * s @ s],
            ]
        )
        total += jacobian.T @ (rigid + ADDED[i]) @ jacobian
    return total


def lagrange(q: np.ndarray, v: np.ndarray, torque: np.ndarray) -> np.ndarray:
    """M a + Mdot v - dT/dq = torque, the derivatives of M by differences of eighth order."""
    h = 2e-2
    weights = {1: 4 / 5, 2: -1 / 5, 3: 4 / 105, 4: -1 / 280}
    slopes = np.zeros((N, N, N))
    for k in range(N):
        step = np.eye(N)[k] * h
        for n, weight in weights.items():
            slopes[k] += weight / h * (mass_matrix(q + n * step) - mass_matrix(q - n * step))
    rate = np.einsum("kij,k->ij", slopes, v)
    kinetic = 0.5 * np.einsum("kij,i,j->k", slopes, v, v)
    found: np.ndarray = np.linalg.solve(mass_matrix(q), torque - rate @ v + kinetic)
    return found


@pytest.mark.slow
def test_five_links_with_full_added_mass_obey_lagrange_to_1e_8() -> None:
    model = arm(free=False)
    install(model)
    data = mujoco.MjData(model)
    rng = np.random.default_rng(2)
    worst = 0.0
    for _ in range(20):
        q, v, torque = rng.uniform(-2, 2, N), rng.normal(size=N), rng.normal(size=N)
        data.qpos[:], data.qvel[:], data.qfrc_applied[:] = q, v, torque
        mujoco.mj_forward(model, data)
        right = lagrange(q, v, torque)
        worst = max(worst, float(np.linalg.norm(data.qacc - right) / np.linalg.norm(right)))
    assert worst < 1e-8


@pytest.mark.parametrize("surface", [FAR_BELOW, 0.1])
def test_the_quick_way_for_diagonal_matrices_is_the_way_for_full_ones(surface: float) -> None:
    """Links of unequal added mass and drag, about points off their origins, also half wet."""
    spec = mujoco.MjSpec()
    set_options(spec)
    rng = np.random.default_rng(8)
    node, waters = spec.worldbody, {}
    for i in range(3):
        node = node.add_body(
            name=f"link{i}", pos=OFFSETS[i].tolist(), quat=TURNS[i].as_quat().tolist(), mass=2.0,
            ipos=CENTRES[i].tolist(), inertia=[0.1, 0.12, 0.15],
        )  # fmt: skip
        node.explicitinertial = True
        if i == 0:
            node.add_freejoint()
        else:
            node.add_joint(type=mujoco.mjtJoint.mjJNT_HINGE, axis=AXES[i].tolist())
        waters[f"link{i}"] = BodyHydrodynamics(
            link=f"link{i}",
            reference=tuple(rng.normal(scale=0.2, size=3)),
            added_mass=tuple(rng.uniform(1, 9, 6)),
            linear_damping=tuple(rng.uniform(1, 9, 6)),
            quadratic_damping=tuple(rng.uniform(1, 9, 6)),
            volume=0.002,
            centre_of_buoyancy=tuple(rng.normal(scale=0.2, size=3)),
            shape="ellipsoid",
            size=(0.6, 0.5, 0.7),
        )
    prepare(spec, waters, surface=surface)
    model = spec.compile()
    water = install(model)
    found, velocity = [], rng.normal(size=model.nv)
    for kind in (c.DIAGONAL_MATRICES, c.FULL_MATRICES):
        model.body_user[1:, c.KIND] = kind
        data = mujoco.MjData(model)
        data.qvel[:] = velocity
        water.set_current(data, (0.3, -0.2, 0.1), (0.4, 0.5, -0.6))
        mujoco.mj_forward(model, data)
        found.append((data.M.copy(), data.qfrc_passive.copy()))
    assert found[0][0] == pytest.approx(found[1][0], rel=1e-12, abs=1e-12)
    assert found[0][1] == pytest.approx(found[1][1], rel=1e-12, abs=1e-12)
    assert np.abs(found[0][1]).max() > 1.0


def energy(model: mujoco.MjModel, data: mujoco.MjData) -> float:
    mujoco.mj_forward(model, data)
    full = np.empty((model.nv, model.nv))
    mujoco.mj_fullM(model, data, full)
    return float(0.5 * data.qvel @ full @ data.qvel)


def test_a_drifting_vehicle_with_an_arm_keeps_its_energy_and_the_waters_to_1e_9() -> None:
    model = arm(free=True)
    water = install(model)
    data = mujoco.MjData(model)
    data.qvel[:] = np.random.default_rng(3).normal(scale=0.3, size=model.nv)
    before = energy(model, data)
    water.step(data, 4000)  # 8 s
    assert np.linalg.norm(data.qpos[:3] - model.qpos0[:3]) > 0.1
    assert energy(model, data) == pytest.approx(before, rel=1e-9)


def test_the_engines_own_kinetic_energy_contains_the_waters() -> None:
    model = arm(free=True)
    model.opt.enableflags |= int(mujoco.mjtEnableBit.mjENBL_ENERGY)
    install(model)
    data = mujoco.MjData(model)
    data.qvel[:] = np.random.default_rng(3).normal(scale=0.3, size=model.nv)
    right = energy(model, data)
    assert data.energy[1] == pytest.approx(right, rel=1e-12)
