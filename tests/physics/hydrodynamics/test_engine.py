"""The water and MuJoCo's solvers, integrators, threads, sleep and sensors."""

from __future__ import annotations

import math
from collections.abc import Iterator

import mujoco
import numpy as np
import pytest

from tests.physics.water_models import FAR_BELOW, free_body, random_added_mass, set_options
from uwsim.physics.hydrodynamics import callback, prepare
from uwsim.physics.hydrodynamics.callback import CallbackTaken
from uwsim.physics.hydrodynamics.hydrodynamics import Hydrodynamics, NoWater, install
from uwsim.scene.hydrodynamics import BodyHydrodynamics, ThrusterSpec

LINKS = ("base", "upper", "fore")
EXTRA = {"base": 40.0, "upper": 3.0, "fore": 2.0, "box": 4.0}  # isotropic added mass [kg]


@pytest.fixture(autouse=True)
def leave_the_slot_alone() -> Iterator[None]:
    yield
    mujoco.set_mjcb_passive(None)


def robot(
    *,
    extra_as_mass: bool,
    solver: str = "Newton",
    integrator: str = "implicitfast",
    noslip: int = 0,
) -> mujoco.MjModel:
    """A floating base, two servoed links and a box above a floor: light, or light with water."""
    spec = mujoco.MjSpec()
    set_options(spec, timestep=0.004, integrator=integrator)
    spec.option.solver = {
        "Newton": mujoco.mjtSolver.mjSOL_NEWTON,
        "CG": mujoco.mjtSolver.mjSOL_CG,
        "PGS": mujoco.mjtSolver.mjSOL_PGS,
    }[solver]
    spec.option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    spec.option.iterations, spec.option.tolerance = (300, 1e-14)
    spec.option.noslip_iterations = noslip
    spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_PLANE, size=[5, 5, 0.1])
    sizes = {"base": (0.4, 0.3, 0.15), "upper": (0.2, 0.05, 0.05), "fore": (0.2, 0.04, 0.04)}
    dry = {"base": 30.0, "upper": 2.0, "fore": 1.0, "box": 5.0}
    parent, waters = spec.worldbody, {}
    for name in (*LINKS, "box"):
        half = sizes.get(name, (0.15, 0.1, 0.1))
        start = {"base": [0, 0, 0.5], "upper": [0.6, 0, -0.1], "fore": [0.42, 0, 0]}
        node = (spec.worldbody if name == "box" else parent).add_body(
            name=name, pos=start.get(name, [1.2, 0.5, 0.3])
        )
        node.explicitinertial = True
        node.mass = dry[name] + (EXTRA[name] if extra_as_mass else 0.0)
        node.inertia = [1.2 * dry[name] * half[0] ** 2 + 0.01] * 3
        node.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=half, condim=4)
        if name in ("base", "box"):
            node.add_freejoint()
        else:
            node.add_joint(name=name, type=mujoco.mjtJoint.mjJNT_HINGE, axis=[0, 1, 0.2])
            servo = spec.add_actuator(name=name, target=name)
            servo.trntype = mujoco.mjtTrn.mjTRN_JOINT
            servo.set_to_position(kp=200.0, kv=20.0)
            parent = node
        if name == "base":
            parent = node
        added = 0.0 if extra_as_mass else EXTRA[name]
        # buoyancy carries what the heavier body's weight adds, so that both weigh the same
        waters[name] = BodyHydrodynamics(
            link=name,
            added_mass=(added,) * 3 + (0.0,) * 3,
            volume=EXTRA[name] / 1000.0 if extra_as_mass else 0.0,
        )
    prepare(spec, waters, surface=FAR_BELOW)
    model = spec.compile()
    assert isinstance(model, mujoco.MjModel)
    return model


def play(model: mujoco.MjModel, n: int = 400) -> np.ndarray:
    water, data = install(model), mujoco.MjData(model)
    data.qvel[:6] = 0.3, 0.1, -0.5, 0.2, 0.3, 0.1
    data.qvel[8:11] = -0.2, 0.1, -0.4
    trace = []
    for step in range(n):
        data.ctrl[:] = 0.4 * math.sin(0.02 * step), -0.5
        water.step(data)
        trace.append(data.qpos.copy())
    assert data.ncon > 0
    return np.array(trace)


@pytest.mark.parametrize(
    ("solver", "integrator", "noslip", "tolerance"),
    [
        ("Newton", "implicitfast", 0, 1e-10),
        ("Newton", "discrete", 0, 1e-10),
        ("CG", "implicitfast", 0, 1e-6),
        ("PGS", "implicitfast", 0, 1e-6),
        ("Newton", "implicitfast", 5, 1e-8),
    ],
)
def test_isotropic_added_mass_is_a_heavier_body_also_through_impacts(
    solver: str, integrator: str, noslip: int, tolerance: float
) -> None:
    options = {"solver": solver, "integrator": integrator, "noslip": noslip}
    heavy = play(robot(extra_as_mass=True, **options))  # type: ignore[arg-type]
    light = play(robot(extra_as_mass=False, **options))  # type: ignore[arg-type]
    assert np.abs(heavy - light).max() < tolerance


def test_the_inverse_weights_are_those_of_the_heavier_body() -> None:
    heavy, light = robot(extra_as_mass=True), robot(extra_as_mass=False)
    before = heavy.body_invweight0.copy(), heavy.dof_invweight0.copy(), heavy.stat.meaninertia
    assert not np.allclose(light.body_invweight0, before[0], rtol=0.1)
    install(heavy)
    install(light)
    for model in (heavy, light):
        assert model.body_invweight0 == pytest.approx(before[0], rel=1e-9)
        assert model.dof_invweight0 == pytest.approx(before[1], rel=1e-9)
        assert model.stat.meaninertia == pytest.approx(before[2], rel=1e-9)


def at_the_start(model: mujoco.MjModel) -> None:
    """Forces are those of the state, as under RK4, and not of the middle of a step."""
    model.opt.integrator = mujoco.mjtIntegrator.mjINT_RK4


def full_water(link: str = "body") -> BodyHydrodynamics:
    return BodyHydrodynamics(
        link=link,
        added_mass=random_added_mass(np.random.default_rng(4), 20.0),
        linear_damping=(5.0, 8, 9, 2, 3, 4),
        quadratic_damping=(30.0, 50, 60, 4, 5, 6),
        volume=0.021,
        centre_of_buoyancy=(0.0, 0.0, 0.05),
    )


def test_the_callback_may_run_twice_on_one_state() -> None:
    model = free_body(full_water(), mass=20.0)
    install(model)
    data = mujoco.MjData(model)
    data.qvel[:] = 0.3, 0.2, 0.1, 0.1, -0.2, 0.3
    mujoco.mj_forward(model, data)
    once = data.M.copy(), data.qfrc_passive.copy()
    mujoco.mj_fwdVelocity(model, data)
    mujoco.mj_fwdVelocity(model, data)
    assert (once[0] == data.M).all()
    assert (data.qfrc_passive == once[1]).all()
    for again in (mujoco.mj_forward, mujoco.mj_forward):
        again(model, data)
        assert (once[0] == data.M).all()
    mujoco.mj_inverse(model, data)
    mujoco.mj_fwdVelocity(model, data)
    assert (once[0] == data.M).all()
    copy = mujoco.MjData(model)
    mujoco.mj_copyData(copy, model, data)
    mujoco.mj_fwdVelocity(model, copy)
    assert (once[0] == copy.M).all()


def test_the_engines_finite_differences_see_the_water() -> None:
    model = free_body(full_water(), mass=20.0)
    water = install(model)
    data = mujoco.MjData(model)
    data.qvel[:] = 0.3, 0.2, 0.1, 0.1, -0.2, 0.3
    a = np.zeros((12, 12))
    mujoco.mjd_transitionFD(model, data, 1e-6, True, a, None, None, None)
    state = data.qpos.copy(), data.qvel.copy()
    ends = []
    for sign in (1.0, -1.0):
        other = mujoco.MjData(model)
        other.qpos[:], other.qvel[:] = state
        other.qvel[0] += sign * 1e-6
        water.step(other)
        ends.append(other.qvel.copy())
    assert a[6:, 6] == pytest.approx((ends[0] - ends[1]) / 2e-6, abs=1e-6)
    assert 0.9 < a[6, 6] < 1.0


@pytest.mark.slow
def test_a_loop_without_the_callback_gives_the_same() -> None:
    results = []
    for callback_used in (True, False):
        model = robot(extra_as_mass=False)
        water, data = install(model), mujoco.MjData(model)
        data.qvel[:6] = 0.3, 0.1, -0.5, 0.2, 0.3, 0.1
        (water.step if callback_used else water.step_without_callback)(data, 200)
        results.append(data.qpos.copy())
    assert (results[0] == results[1]).all()


def test_where_mujoco_hides_its_slot_the_loop_steps(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(callback, "has_slot", lambda: False)
    model = robot(extra_as_mass=False)
    water, data = install(model), mujoco.MjData(model)
    data.qvel[:6] = 0.3, 0.1, -0.5, 0.2, 0.3, 0.1
    water.step(data, 100)
    monkeypatch.undo()
    assert not callback.is_installed()
    other = mujoco.MjData(model)
    other.qvel[:6] = 0.3, 0.1, -0.5, 0.2, 0.3, 0.1
    install(model).step(other, 100)
    assert (data.qpos == other.qpos).all()


def test_a_model_without_tables_is_not_touched_by_a_neighbour_with_them() -> None:
    plain = mujoco.MjModel.from_xml_string(
        '<mujoco><size nuser_body="128"/><worldbody><body><freejoint/><geom size="0.1"/></body>'
        "</worldbody></mujoco>"
    )
    data = mujoco.MjData(plain)
    mujoco.mj_step(plain, data, 10)
    alone = data.qpos.copy()
    install(free_body(full_water(), mass=20.0))
    data = mujoco.MjData(plain)
    mujoco.mj_step(plain, data, 10)
    assert (data.qpos == alone).all()


def test_two_threads_give_the_bits_of_one_and_of_a_plain_loop() -> None:
    from mujoco import batch

    model = robot(extra_as_mass=False)
    install(model)
    n, n_steps = 8, 150
    starts = np.random.default_rng(0).normal(scale=0.2, size=(n, model.nv))
    finals = []
    for n_threads in (1, 2):
        pool = batch.Batch(model, n, n_threads)
        pool.qvel = starts
        pool.step(nstep=n_steps)
        finals.append(pool.qpos.copy())
    loop = []
    for start in starts:
        data = mujoco.MjData(model)
        data.qvel[:] = start
        mujoco.mj_step(model, data, n_steps)
        loop.append(data.qpos.copy())
    assert (finals[0] == finals[1]).all()
    assert (finals[0] == np.array(loop)).all()


def test_a_sleeping_tree_does_not_grow_heavier() -> None:
    model = robot(extra_as_mass=False)
    model.opt.enableflags |= int(mujoco.mjtEnableBit.mjENBL_SLEEP)
    water, data = install(model), mujoco.MjData(model)
    water.step(data, 1000)
    full = np.empty((model.nv, model.nv))
    mujoco.mj_fullM(model, data, full)
    before = full.copy()
    water.step(data, 1000)
    mujoco.mj_fullM(model, data, full)
    assert not data.tree_awake.all()
    assert full == pytest.approx(before, rel=1e-6, abs=1e-6)


def test_a_body_on_three_slides_keeps_its_couplings() -> None:
    """MuJoCo keeps only the diagonal of M for such a body unless it is told not to."""
    spec = mujoco.MjSpec()
    set_options(spec, gravity=0.0)
    body = spec.worldbody.add_body(name="body", mass=1.0, ipos=[0, 0, 0], inertia=[1, 1, 1])
    for axis in np.eye(3).tolist():
        body.add_joint(type=mujoco.mjtJoint.mjJNT_SLIDE, axis=axis)
    prepare(spec, {"body": full_water()}, surface=FAR_BELOW)
    model = spec.compile()
    install(model)
    data, full = mujoco.MjData(model), np.empty((3, 3))
    mujoco.mj_forward(model, data)
    mujoco.mj_fullM(model, data, full)
    added = np.array(full_water().added_mass).reshape(6, 6)[:3, :3]
    slope = 0.5 * 0.002 * np.diag([5.0, 8.0, 9.0])
    assert full == pytest.approx(np.eye(3) + added + slope, rel=1e-12)


def wrist() -> mujoco.MjModel:
    """A gripper on a fixed arm, with all the water it can have, and a force-torque sensor."""
    spec = mujoco.MjSpec()
    set_options(spec)
    arm = spec.worldbody.add_body(name="arm", mass=1.0, inertia=[0.1] * 3)
    arm.explicitinertial = True
    arm.add_joint(type=mujoco.mjtJoint.mjJNT_HINGE, axis=[0, 1, 0])
    hand = arm.add_body(name="hand", pos=[0.5, 0, 0], mass=14.2, inertia=[0.1] * 3)
    hand.explicitinertial = True
    hand.add_site(name="wrist", pos=[0.0, 0.0, 0.02])
    for kind in (mujoco.mjtSensor.mjSENS_FORCE, mujoco.mjtSensor.mjSENS_TORQUE):
        spec.add_sensor(type=kind, objtype=mujoco.mjtObj.mjOBJ_SITE, objname="wrist")
    water = BodyHydrodynamics(
        link="hand",
        added_mass=random_added_mass(np.random.default_rng(4), 5.0),
        quadratic_damping=(50.0,) * 6,
        volume=0.009,
        centre_of_buoyancy=(0.01, 0.0, 0.0),
        implicitness=0.0,
    )
    prepare(spec, {"hand": water}, surface=FAR_BELOW)
    model = spec.compile()
    assert isinstance(model, mujoco.MjModel)
    return model


def force_and_torque(
    water: Hydrodynamics, data: mujoco.MjData, site: int
) -> tuple[np.ndarray, np.ndarray]:
    """What the parent does to the body with a site, in the site's axes."""
    body = water.model.site_bodyid[site]
    torque, force = np.split(data.cfrc_int[body] - water.wrenches(data)[body], 2)
    lever = data.site_xpos[site] - data.subtree_com[water.model.body_rootid[body]]
    axes = data.site_xmat[site].reshape(3, 3)
    return axes.T @ force, axes.T @ (torque - np.cross(lever, force))


def test_a_force_sensor_at_rest_carries_the_weight_in_water() -> None:
    model = wrist()
    water, data = install(model), mujoco.MjData(model)
    data.qacc[:] = 0.0
    mujoco.mj_inverse(model, data)  # at rest, held by whatever is needed
    mujoco.mj_rnePostConstraint(model, data)
    force, torque = force_and_torque(water, data, 0)
    assert force == pytest.approx([0.0, 0.0, (14.2 - 9.0) * 9.81], abs=1e-9)
    # what the arm gives balances weight at the centre of mass and buoyancy 1 cm beside it
    assert torque == pytest.approx([0.0, 9.0 * 9.81 * 0.01, 0.0], abs=1e-9)


def test_a_force_sensor_in_motion_balances_the_body_it_carries() -> None:
    """Newton and Euler for the hand alone: what the arm gives + water + weight = m a."""
    model = wrist()
    water, data = install(model), mujoco.MjData(model)
    data.qpos[0], data.qvel[0] = 0.3, 1.5
    mujoco.mj_forward(model, data)
    force, _ = force_and_torque(water, data, 0)
    axes = data.site_xmat[0].reshape(3, 3)
    acceleration = np.empty(6)
    mujoco.mj_objectAcceleration(model, data, mujoco.mjtObj.mjOBJ_BODY, 2, acceleration, 0)
    on_water = water.wrenches(data)[2, 3:]
    mass_times_acceleration = 14.2 * acceleration[3:]  # contains -g already
    assert axes @ force + on_water == pytest.approx(mass_times_acceleration, abs=1e-9)
    assert np.linalg.norm(on_water) > 20.0


THRUSTER = ThrusterSpec(
    name="t",
    link="body",
    position=(0.1, 0.4, 0.2),
    direction=(1.0, 1.0, 0.0),
    forward=(2.0, 30.0),
    backward=(1.0, 20.0),
    dead_zone=0.1,
    saturation=(-10.0, 18.0),
    torque=0.02,
)


@pytest.mark.parametrize(
    ("command", "thrust"),
    [(0.05, 0.0), (-0.1, 0.0), (0.6, 8.5), (-0.6, -5.5), (1.0, 18.0), (7.0, 18.0), (-1.0, -10.0)],
)
def test_a_thruster_pushes_by_its_curve_at_its_place(command: float, thrust: float) -> None:
    model = free_body(BodyHydrodynamics(link="body"), mass=20.0, thrusters={"t": THRUSTER})
    at_the_start(model)
    water, data = install(model), mujoco.MjData(model)
    water.set_thrusters(data, [command])
    mujoco.mj_forward(model, data)
    force = thrust * np.array([1.0, 1.0, 0.0]) / math.sqrt(2.0)
    torque = np.cross([0.1, 0.4, 0.2], force) + 0.02 * force
    assert data.qfrc_passive == pytest.approx(np.concatenate([force, torque]), abs=1e-12)


def test_the_rotor_follows_its_command_as_an_exponential() -> None:
    lagging = ThrusterSpec(name="t", link="body", forward=(10.0,), time_constant=0.2)
    model = free_body(BodyHydrodynamics(link="body"), mass=20.0, thrusters={"t": lagging})
    water, data = install(model), mujoco.MjData(model)
    water.set_thruster(data, water.thruster("t"), 1.0)
    water.step(data, 100)  # 0.2 s
    at_the_start(model)
    mujoco.mj_forward(model, data)
    assert data.qfrc_passive[0] == pytest.approx(10.0 * (1.0 - math.exp(-1.0)), rel=1e-12)


def test_a_lost_thruster_gives_what_is_left() -> None:
    model = free_body(BodyHydrodynamics(link="body"), mass=20.0, thrusters={"t": THRUSTER})
    at_the_start(model)
    water, data = install(model), mujoco.MjData(model)
    water.set_thrusters(data, [0.6])
    water.set_loss(data, 0, 0.75)
    mujoco.mj_forward(model, data)
    assert np.linalg.norm(data.qfrc_passive[:3]) == pytest.approx(0.25 * 8.5)
    water.set_loss(data, 0, 1.0)
    mujoco.mj_forward(model, data)
    assert not data.qfrc_passive.any()


def test_a_thruster_out_of_the_water_pushes_nothing() -> None:
    model = free_body(
        BodyHydrodynamics(link="body"), mass=20.0, thrusters={"t": THRUSTER}, surface=-1.0
    )
    at_the_start(model)
    water, data = install(model), mujoco.MjData(model)
    water.set_thrusters(data, [1.0])
    mujoco.mj_forward(model, data)
    assert not data.qfrc_passive.any()
    water.water(data)[:, 6] = 2.0  # until a wave reaches it
    mujoco.mj_forward(model, data)
    assert np.linalg.norm(data.qfrc_passive[:3]) == pytest.approx(18.0)


def test_light_things_with_much_drag_stay_calm_when_drag_is_implicit() -> None:
    """A 0.4 kg plate without added mass; explicit drag blows up at 10 ms."""
    speeds = {}
    for theta in (0.0, 1.0):
        water = BodyHydrodynamics(
            link="body", quadratic_damping=(0, 0, 300, 0, 0, 0), implicitness=theta
        )
        model = free_body(water, mass=0.4, timestep=0.01, gravity=0.0, inertia=(0.01,) * 3)
        model.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_AUTORESET)
        hydrodynamics, data = install(model), mujoco.MjData(model)
        data.qvel[2] = 1.0
        hydrodynamics.step(data, 20)
        speeds[theta] = abs(data.qvel[2])
    assert speeds[1.0] < 0.2
    assert not speeds[0.0] < 1.0


def test_two_bodies_feel_their_own_water() -> None:
    spec = mujoco.MjSpec()
    set_options(spec, gravity=0.0)
    waters = {}
    for name in ("a", "b"):
        node = spec.worldbody.add_body(name=name, mass=1.0, inertia=[1, 1, 1])
        node.explicitinertial = True
        node.add_freejoint()
        waters[name] = BodyHydrodynamics(link=name, linear_damping=(2.0,) * 6)
    prepare(spec, waters, surface=FAR_BELOW)
    model = spec.compile()
    water, data = install(model), mujoco.MjData(model)
    water.set_current(data, (0.5, 0, 0), body=model.body("a").id)
    water.set_current(data, (0, -0.3, 0), body=model.body("b").id)
    mujoco.mj_forward(model, data)
    assert data.qfrc_passive.reshape(2, 6)[:, :3] == pytest.approx(
        np.array([[1.0, 0, 0], [0, -0.6, 0]])
    )


def test_somebody_elses_callback_is_not_thrown_out() -> None:
    models = [free_body(full_water(), mass=20.0) for _ in range(2)]
    install(models[0])
    mujoco.set_mjcb_passive(lambda m, d: None)
    with pytest.raises(CallbackTaken, match="mjcb_passive"):
        install(models[1])


def test_a_reset_of_the_callbacks_is_mended_by_the_next_step() -> None:
    model = free_body(full_water(), mass=20.0)
    water, data = install(model), mujoco.MjData(model)
    mujoco.set_mjcb_passive(None)
    assert not callback.is_installed()
    water.step(data)
    assert callback.is_installed()


def test_a_model_that_was_not_prepared_is_refused() -> None:
    model = mujoco.MjModel.from_xml_string("<mujoco><worldbody/></mujoco>")
    with pytest.raises(NoWater, match="prepare"):
        install(model)


def test_springs_and_dampers_both_off_is_refused() -> None:
    model = free_body(full_water(), mass=20.0)
    model.opt.disableflags |= 32 | 64
    with pytest.raises(NoWater, match="both disabled"):
        install(model)


def test_jaws_hold_a_heavy_box_that_is_shaken_in_a_current() -> None:
    """50 N in water, 80 N of clamp, friction 0.8: it creeps a little and does not drop."""
    spec = mujoco.MjSpec()
    set_options(spec)
    spec.option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    spec.option.impratio = 10.0
    slide = spec.worldbody.add_body(name="slide", mass=5, ipos=[0, 0, 0], inertia=[0.1] * 3)
    slide.add_joint(name="lift", type=mujoco.mjtJoint.mjJNT_SLIDE, axis=[0, 0, 1])
    pad = {"size": [0.04, 0.01, 0.04], "condim": 4, "friction": [0.8, 0.01, 0.001]}
    waters = {}
    for name, side in (("left", 1.0), ("right", -1.0)):
        jaw = slide.add_body(
            name=name, pos=[0, side * 0.11, 0], mass=0.5, ipos=[0, 0, 0], inertia=[0.001] * 3
        )
        jaw.add_joint(name=name, type=mujoco.mjtJoint.mjJNT_SLIDE, axis=[0, -side, 0])
        jaw.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, **pad)
        waters[name] = BodyHydrodynamics(link=name, added_mass=(0.2,) * 3 + (0.001,) * 3)
    box = spec.worldbody.add_body(name="box", mass=14.2, ipos=[0, 0, 0], inertia=[0.08, 0.13, 0.15])
    box.add_freejoint()
    box.add_geom(
        type=mujoco.mjtGeom.mjGEOM_BOX,
        size=[0.15, 0.1, 0.075],
        condim=4,
        friction=[0.8, 0.01, 0.001],
    )
    waters["box"] = BodyHydrodynamics(
        link="box",
        added_mass=(4.0, 6, 9, 0.05, 0.08, 0.05),
        quadratic_damping=(15.0, 25, 35, 0.3, 0.5, 0.4),
        volume=0.0091,
        implicitness=1.0,
    )
    for name in ("left", "right"):
        clamp = spec.add_actuator(name=name, target=name)
        clamp.trntype = mujoco.mjtTrn.mjTRN_JOINT
        clamp.set_to_motor()
    servo = spec.add_actuator(name="lift", target="lift")
    servo.trntype = mujoco.mjtTrn.mjTRN_JOINT
    servo.set_to_position(kp=20000.0, kv=2000.0)
    prepare(spec, waters, surface=FAR_BELOW)
    model = spec.compile()
    water, data = install(model), mujoco.MjData(model)
    slips = []
    for tick in range(200):  # 4 s
        t = 0.02 * tick
        data.ctrl[:] = 80.0, 80.0, 0.02 * math.sin(math.pi * t)
        water.set_current(data, (0.5 * math.sin(t), 0.0, 0.0))
        water.step(data, 10)
        slips.append(data.body("box").xpos[2] - data.body("slide").xpos[2])
    assert data.ncon >= 8
    assert abs(slips[-1] - slips[50]) < 2e-3
    assert abs(slips[-1]) < 0.02


def test_nobody_looks_at_a_clock_during_a_step_unless_asked() -> None:
    model = robot(extra_as_mass=False)
    install(model)
    callback.stop_profiler.cache_clear()
    mujoco.set_mjcb_time(lambda: 1.0)
    callback.stop_profiler()
    assert mujoco.get_mjcb_time() is not None
    mujoco.set_mjcb_time(None)
    callback.stop_profiler.cache_clear()
    callback.stop_profiler()
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data)
    assert not np.any(data.timer.duration)
