"""A MuJoCo that steps otherwise than the kernel believes is refused, not misread."""

from __future__ import annotations

import mujoco
import pytest

from uwsim.physics.hydrodynamics import callback, self_test
from uwsim.physics.hydrodynamics.kernel import fields, layout
from uwsim.physics.hydrodynamics.kernel.layout import MujocoChanged


def test_this_mujoco_passes() -> None:
    self_test.self_test.cache_clear()
    self_test.self_test()


@pytest.mark.parametrize(
    ("field", "name"),
    [
        (fields.CONTACT_POINT, "contact"),
        (fields.CONTACT_AXES, "contact"),
        (fields.CONTACT_GEOMS, "contact"),
        (fields.CONTACT_SIZE, "contact"),
        (fields.CONTACTS, "contact"),
        (fields.N_CONTACTS, "ncon"),
        (fields.GEOM_BODY, "geom_bodyid"),
        (fields.SUBTREE_FORCE, "cfrc_int"),
    ],
)
def test_a_field_at_another_place_is_found(field: int, name: str) -> None:
    model = mujoco.MjModel.from_xml_string(callback._SMALL_MODEL)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    at = layout.offsets()
    layout.check(model, data, at)
    at[field] += 8
    with pytest.raises(MujocoChanged, match=f"has '{name}' at another offset"):
        layout.check(model, data, at)


def test_a_gyroscopic_term_that_is_not_undone_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    """With Euler MuJoCo has no such term: as if a new version had left it out."""
    step2 = mujoco.mj_step2

    def without_term(model: mujoco.MjModel, data: mujoco.MjData) -> None:
        model.opt.integrator = mujoco.mjtIntegrator.mjINT_EULER
        step2(model, data)

    monkeypatch.setattr(mujoco, "mj_step2", without_term)
    self_test.self_test.cache_clear()
    with pytest.raises(MujocoChanged, match="fails its self-test"):
        self_test.self_test()
    self_test.self_test.cache_clear()
