"""What the engine warns of: one line, and no file in the folder that the user works in."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import mujoco
import pytest

from uwsim.physics.engine_warnings import hush, why_untrue

BALLS = "".join(f'<body name="b{i}"><freejoint/><geom size="0.1"/></body>' for i in range(30))
MODEL = '<mujoco><size memory="{memory}"/><worldbody>' + BALLS + "</worldbody></mujoco>"
UNSTABLE = """
import os, sys
from dataclasses import replace
from multiprocessing import get_context
import numpy as np
from uwsim.errors import RunFailed
from uwsim.scene.reader import read_scene
from uwsim.simulation import Simulation
from importlib import resources

def diverge():
    scene = read_scene(resources.files("uwsim") / "data" / "scenes" / "currents-scene.xml")
    simulation = Simulation(scene, is_blind=True)
    simulation._state._data.qvel[0] = 1e12
    try:
        simulation.advance()
    except RunFailed:
        print("failed")

if __name__ == "__main__":
    diverge()
    worker = get_context("spawn").Process(target=diverge)
    worker.start()
    worker.join()
"""


def warned(memory: str) -> str:
    model = mujoco.MjModel.from_xml_string(MODEL.format(memory=memory))
    data = mujoco.MjData(model)
    hush()
    mujoco.mj_step(model, data)
    names = [model.body(i).name for i in model.dof_bodyid]
    assert data.warning.number.any()
    return why_untrue(data, 0.002, 0.002, names)


def test_contacts_that_find_no_room_are_said(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert "more contacts at 0.002 s than the engine has memory for" in warned("100K")
    assert list(tmp_path.iterdir()) == []
    assert capfd.readouterr() == ("", "")


def test_a_run_that_diverges_leaves_no_file_in_a_worker_either(tmp_path: Path) -> None:
    (tmp_path / "program.py").write_text(UNSTABLE)
    done = subprocess.run(
        [sys.executable, "program.py"], cwd=tmp_path, capture_output=True, text=True, check=True
    )
    assert (done.stdout, done.stderr) == ("failed\nfailed\n", "")
    assert [path.name for path in tmp_path.iterdir()] == ["program.py"]


def test_somebody_elses_listener_stays() -> None:
    before = mujoco.get_mju_user_warning()
    try:
        mujoco.set_mju_user_warning(print)
        hush()
        assert mujoco.get_mju_user_warning() is print
    finally:
        mujoco.set_mju_user_warning(before)
