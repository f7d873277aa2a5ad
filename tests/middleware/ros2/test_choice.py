"""Which node the simulator is, where rclpy is not there, or is broken."""

from __future__ import annotations

import importlib.util
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.support.ros2_peers import free_domain
from uwsim.errors import BadSetting, MissingExtra, UwsimError
from uwsim.middleware.log import Log
from uwsim.middleware.ros2.choice import check, open_node

pytest.importorskip("cyclonedds", reason="cyclonedds is not installed: pip install uwsim[ros2]")


@pytest.fixture
def no_rclpy(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "rclpy", None)


@pytest.fixture
def domain() -> Iterator[int]:
    with free_domain() as actual:
        yield actual


def reported_lines(environment: dict[str, str], domain: int) -> list[str]:
    """Open a node and close it; what was said."""
    lines: list[str] = []
    open_node(environment, domain, Log("ros2", lines.append)).close()
    return lines


@pytest.mark.usefixtures("no_rclpy")
def test_without_rclpy_it_is_a_node_on_cyclone_dds_and_a_line_says_so(domain: int) -> None:
    check({}, domain)
    assert reported_lines({}, domain) == [
        "uwsim: ros2: a node on Cyclone DDS, without rclpy; for nodes on this computer"
    ]


def test_a_user_may_do_without_rclpy(domain: int) -> None:
    lines = reported_lines({"UWSIM_ROS2": "dds"}, domain)
    assert lines == [
        "uwsim: ros2: a node on Cyclone DDS, without rclpy; for nodes on this computer"
    ]


def test_an_rclpy_that_cannot_be_imported_is_told(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, domain: int
) -> None:
    for name in [entry for entry in sys.modules if entry.partition(".")[0] == "rclpy"]:
        monkeypatch.delitem(sys.modules, name)
    (tmp_path / "rclpy").mkdir()
    program = "raise ImportError('librcl.so: cannot open shared object file\\nand so on')\n"
    (tmp_path / "rclpy" / "__init__.py").write_text(program)
    monkeypatch.syspath_prepend(tmp_path)
    assert reported_lines({}, domain) == [
        "uwsim: ros2: rclpy is installed but cannot be imported: librcl.so: cannot open shared "
        "object file",
        "uwsim: ros2: a node on Cyclone DDS, without rclpy; for nodes on this computer",
    ]


@pytest.mark.usefixtures("no_rclpy")
def test_an_rclpy_that_is_asked_for_and_not_there_is_an_error(domain: int) -> None:
    with pytest.raises(UwsimError, match="UWSIM_ROS2=rclpy, but rclpy cannot be imported"):
        open_node({"UWSIM_ROS2": "rclpy"}, domain, Log("ros2", print))


def test_an_unknown_choice_names_the_nearest() -> None:
    with pytest.raises(BadSetting, match=r"UWSIM_ROS2=rclp: expected rclpy or dds\..*'rclpy'"):
        check({"UWSIM_ROS2": "rclp"}, None)


def test_with_neither_it_is_said_how_to_get_one(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None)
    with pytest.raises(MissingExtra, match=r"source a ROS 2, or pip install uwsim\[ros2\]"):
        check({}, None)
