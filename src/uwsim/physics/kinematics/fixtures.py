"""The joints of objects that are fastened to the scene: hinges and slides."""

from __future__ import annotations

import mujoco

from ...errors import UnknownName
from ...model.body_names import fixture_joint
from ...scene.spec import SceneSpec


class Fixtures:
    """The hinges and slides of the objects of a scene, by the name of the object.

    Objects that share a name are the first of them.

    Args:
        scene: the spec of the scene.
        model: the engine's model.
        data: the engine's state.
    """

    def __init__(self, scene: SceneSpec, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        self._data = data
        self._addresses: dict[str, int] = {}  # in qpos
        for index, spec in enumerate(scene.objects):
            joint = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_JOINT, fixture_joint(index))
            if joint >= 0:
                self._addresses.setdefault(spec.name, int(model.jnt_qposadr[joint]))

    def position(self, name: str) -> float:
        """Return the position of a hinge [rad] or slide [m]; raise UnknownName without a joint."""
        if name not in self._addresses:
            raise UnknownName("object with a <u:hinge> or <u:slide>", name, self._addresses)
        return float(self._data.qpos[self._addresses[name]])
