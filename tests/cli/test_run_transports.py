"""``uwsim run`` with programs outside."""

from __future__ import annotations

import pytest

from tests.support.waiting import free_port
from uwsim.cli import main


def test_a_scene_is_a_node_of_ros_1_and_starts_a_master(
    capfd: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    port = free_port()
    monkeypatch.setenv("ROS_MASTER_URI", f"http://127.0.0.1:{port}")
    assert main(["run", "currents-scene", "--ros1", "--speed", "0", "--for", "0.1s"]) == 0
    assert (
        f"no master answers; one was started at http://127.0.0.1:{port}/" in capfd.readouterr().err
    )


@pytest.mark.parametrize(
    ("uri", "error"),
    [
        ("nonsense", "ROS_MASTER_URI 'nonsense': expected http://HOST:PORT"),
        ("http://[::", "ROS_MASTER_URI 'http://[::': expected http://HOST:PORT"),
        ("http://127.0.0.2:1", "The ROS master does not answer"),
    ],
)
def test_a_wrong_master_is_one_clean_line(
    capfd: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, uri: str, error: str
) -> None:
    monkeypatch.setenv("ROS_MASTER_URI", uri)
    assert main(["run", "currents-scene", "--ros1", "--for", "0.1s"]) == 2
    printed = capfd.readouterr().err
    assert error in printed
    assert "Traceback" not in printed


@pytest.mark.parametrize(
    ("options", "error"),
    [
        (["--ros1-host", "10.0.0.1"], "--ros1-host needs --ros1"),
        (["--ros1", "--speed", "-1"], "--speed -1: expected 0, or 1e-06 or more"),
        (["--web", "0", "--speed", "1e-13"], "--speed 1e-13: expected 0, or 1e-06 or more"),
        (["--web", "0", "--client", "a", "--client-limit", "1e10"], "--client-limit 1e+10: exp"),
        (["--web", "0", "--client", " "], "--client: it is blank; expected the name by which"),
    ],
)
def test_options_that_contradict_each_other_are_refused(
    capfd: pytest.CaptureFixture[str], options: list[str], error: str
) -> None:
    assert main(["run", "shapes-scene", *options]) == 2
    assert error in capfd.readouterr().err
