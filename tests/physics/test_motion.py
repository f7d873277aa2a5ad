"""Motion: everything that moves, as one row of numbers."""

from __future__ import annotations

import mujoco
import numpy as np

from uwsim.physics.motion import Motion

MODEL = """
<mujoco>
  <worldbody>
    <body name="rov">
      <freejoint/> <geom size="0.1" mass="1"/>
      <body name="plate"> <geom size="0.1" mass="1"/>
        <body name="arm"> <joint type="hinge"/> <geom size="0.1" mass="1"/> </body>
      </body>
    </body>
    <body name="slide">
      <joint type="slide"/> <joint type="hinge"/> <geom size="1" mass="1"/>
    </body>
  </worldbody>
</mujoco>
"""


def test_each_body_with_joints_has_its_positions_and_then_its_velocities() -> None:
    model = mujoco.MjModel.from_xml_string(MODEL)
    data = mujoco.MjData(model)
    motion = Motion(model, data, [model.body(i).name for i in range(model.nbody)])
    assert motion.parts == (("rov", 13), ("arm", 2), ("slide", 4))
    data.qpos[:] = np.arange(10)
    data.qvel[:] = 100 + np.arange(9)
    row = np.zeros(motion.size)
    motion.read(row)
    rov = [0, 1, 2, 3, 4, 5, 6, 100, 101, 102, 103, 104, 105]
    assert row.tolist() == [*rov, 7, 106, 8, 9, 107, 108]
    data.qpos[:] = 0.0
    assert row[1] == 1.0  # a copy
