"""``uwsim play --virtual-sensors``: a vehicle of a scene follows a log, and observes from there."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image as PngFile

from uwsim.assets.bundled import scene_file
from uwsim.cli import main
from uwsim.messages import pixels_of
from uwsim.middleware.recording import BagReader

BALL = """<object>
    <name>ball</name> <file>objects/sphere.osg</file>
    <position> <x>3</x> <y>0.2</y> <z>1.4</z> </position>
  </object>
  <rosInterfaces>"""
POSES = """time,x,y,z,roll,pitch,yaw
0.0,0.0,0.0,1.5,0,0,0
0.5,0.2,0.0,1.5,0,0,0
1.0,0.4,0.1,1.6,0,0,0.2
"""
MAPPING = """vehicle = "bluerov2"
[time]
column = "time"
[motion]
position = ["x", "y", "z"]
rpy = ["roll", "pitch", "yaw"]
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A pool with a virtual ball, the recording of a second in the pool, and a log as CSV."""
    folder = tmp_path_factory.mktemp("virtual")
    text = scene_file("bluerov2-scene", ()).read_text()
    (folder / "ball.xml").write_text(text.replace("<rosInterfaces>", BALL, 1))
    (folder / "dive.csv").write_text(POSES)
    (folder / "dive.toml").write_text(MAPPING)
    command = ["run", "bluerov2-scene", "--for", "1s", "--record", str(folder / "dive.mcap")]
    assert main(command) == 0
    return folder


def play(folder: Path, log: str, out: Path, *options: str) -> int:
    command = ["play", str(folder / log), str(folder / "ball.xml"), "--virtual-sensors"]
    return main([*command, "--record", str(out), *options])


def read(path: Path, topic: str) -> list[object]:
    with BagReader(path) as reader:
        return [message for _, name, message in reader.messages() if name == topic]


@pytest.mark.slow
def test_real_images_get_virtual_objects_and_all_is_recorded(
    folder: Path, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    out, frames = tmp_path / "a.mcap", tmp_path / "frames"
    options = ["--compose", "camera=/bluerov2/camera", "--frames", str(frames)]
    assert play(folder, "dive.mcap", out, *options) == 0
    assert "11 images composed, 0 left out" in capfd.readouterr().out
    real = [pixels_of(m) for m in read(out, "/bluerov2/camera")]  # type: ignore[arg-type]
    composed = [pixels_of(m) for m in read(out, "/virtual/composed/bluerov2/camera")]  # type: ignore[arg-type]
    assert len(real) == len(composed) == 11
    share = [(a != b).any(axis=2).mean() for a, b in zip(real, composed, strict=True)]
    assert min(share) > 0.005
    assert max(share) < 0.1, "the ball alone"
    png = np.asarray(PngFile.open(frames / "000003.png"))
    assert np.array_equal(png, composed[3])
    again = tmp_path / "b.mcap"
    assert play(folder, "dive.mcap", again, "--compose", "camera=/bluerov2/camera") == 0
    assert out.read_bytes() == again.read_bytes()


@pytest.mark.slow
def test_a_log_without_messages_moves_the_vehicle_at_every_step(
    folder: Path, tmp_path: Path
) -> None:
    out = tmp_path / "a.mcap"
    options = ["--mapping", str(folder / "dive.toml"), "--images", "none"]
    assert play(folder, "dive.csv", out, *options) == 0
    with BagReader(out) as reader:
        found = [(t, m) for t, n, m in reader.messages() if n == "/virtual/bluerov2/odom"]
        assert not any(name.startswith("/bluerov2/") for name in reader.topics
                       if not name.endswith("thrusters"))  # fmt: skip
    assert len(found) == 51
    for time, message in found:
        position = message.pose.pose.position
        assert position.x == pytest.approx(0.4 * time, abs=1e-9)
        assert position.y == pytest.approx(max(0.0, 0.2 * (time - 0.5)), abs=1e-9)
    speeds = [message.twist.twist.linear.x for _, message in found[2:24]]
    assert speeds == pytest.approx([0.4] * len(speeds), abs=1e-6)


@pytest.mark.parametrize(
    ("options", "error"),
    [
        (["--vehicle", "rov"], "'rov'"),
        (["--gaps", "skip"], "--gaps skip: expected one of hold, interpolate, refuse."),
        (["--gaps", "refuse", "--max-gap", "0.3"], "2 gaps of more than 0.3 s"),
        (["--compose", "eye=/cam"], "'eye'"),
        (["--add-fog", "0.1"], "--add-fog needs --compose"),
        (["--compose", "camera=/cam", "--add-fog", "0.1"], "this scene has physical water"),
    ],
)
def test_what_does_not_fit_is_one_clean_error(
    folder: Path,
    tmp_path: Path,
    capfd: pytest.CaptureFixture[str],
    options: list[str],
    error: str,
) -> None:
    mapping = ["--mapping", str(folder / "dive.toml")]
    assert play(folder, "dive.csv", tmp_path / "a.mcap", *mapping, *options) == 2
    printed = capfd.readouterr().err
    assert error in printed
    assert "Traceback" not in printed


def test_virtual_sensors_need_a_scene(folder: Path, capfd: pytest.CaptureFixture[str]) -> None:
    assert main(["play", str(folder / "dive.mcap"), "--virtual-sensors"]) == 2
    assert "--virtual-sensors needs a SCENE" in capfd.readouterr().err
