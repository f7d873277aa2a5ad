"""``scripts/setup`` on machines that lack something, played with stand-ins on the PATH."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
LIBRARIES = "libegl1 libgl1 libgl1-mesa-dri"


class Machine:
    """A folder with a copy of the script, and commands that only write down what they were told."""

    def __init__(self, folder: Path) -> None:
        self.project = folder / "project"
        self.commands = folder / "commands"
        self.told = folder / "told"
        (self.project / "scripts").mkdir(parents=True)
        self.commands.mkdir()
        shutil.copy(ROOT / "scripts" / "setup", self.project / "scripts" / "setup")
        shutil.copy(ROOT / "pyproject.toml", self.project)
        self.told.touch()
        self.command("id", "echo 1000")
        self.command("sudo", "exit 1")
        self.command("apt-get", f'echo "apt-get $*" >>{self.told}')
        self.command("dpkg-query", "exit 1")
        self.command("python3", self.making_a_venv("0"))

    def making_a_venv(self, ensurepip: str) -> str:
        made = f"mkdir -p .venv/bin; cp {self.commands}/python3 .venv/bin/python; touch .venv/made"
        return (
            f'echo "python3 $*" >>{self.told}\n'
            f'case "$*" in *"import ensurepip"*) exit {ensurepip} ;; "-m venv"*) {made} ;; esac\n'
            'case "$*" in *"import sys, pip"*) test -e .venv/made; exit ;; esac\n'
            'case "$*" in "-m pip"*) touch .venv/bin/uwsim; chmod +x .venv/bin/uwsim ;; esac\n'
            "exit 0"
        )

    def command(self, name: str, body: str) -> None:
        path = self.commands / name
        path.write_text(f"#!/bin/bash\n{body}\n")
        path.chmod(0o755)

    def set_up(self, *extras: str) -> subprocess.CompletedProcess[str]:
        return subprocess.run(
            ["/bin/bash", "scripts/setup", *extras],
            cwd=self.project,
            env={"PATH": f"{self.commands}:/usr/bin:/bin"},
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            check=False,
        )

    def pip_runs(self) -> int:
        return self.told.read_text().count("-m pip install")


@pytest.mark.parametrize(
    "written", ["visibility.result/result.json", "currents.envelope/envelope.json", "comparison/a"]
)
def test_what_commands_write_by_default_is_nothing_to_commit(written: str) -> None:
    if not (ROOT / ".git").exists():
        pytest.skip("not a git checkout")
    ignored = subprocess.run(["git", "-C", ROOT, "check-ignore", "-q", written], check=False)
    assert ignored.returncode == 0
    source = "src/uwsim/benchmark/comparison/new.py"
    kept = subprocess.run(["git", "-C", ROOT, "check-ignore", "-q", source], check=False)
    assert kept.returncode == 1


@pytest.fixture
def machine(tmp_path: Path) -> Machine:
    return Machine(tmp_path)


def test_without_rights_it_stops_with_one_line_that_is_the_command_to_run(machine: Machine) -> None:
    done = machine.set_up()
    assert done.returncode == 1
    assert done.stderr.splitlines() == [
        f"uwsim set-up: some packages are missing; run: sudo apt-get install -y {LIBRARIES}"
    ]
    assert not (machine.project / ".venv").exists()
    assert "apt-get" not in machine.told.read_text()


def test_a_python_without_venv_is_among_what_is_missing(machine: Machine) -> None:
    machine.command("python3", machine.making_a_venv("1"))
    done = machine.set_up()
    assert done.stderr.endswith(f"sudo apt-get install -y python3-venv {LIBRARIES}\n")


def test_a_python_that_is_too_old_is_named(machine: Machine) -> None:
    machine.command("python3", 'case "$*" in *version_info*) exit 1 ;; esac; echo 3.9.2')
    done = machine.set_up()
    assert done.returncode == 1
    assert done.stderr == "uwsim set-up: python3 is 3.9.2; 3.11 or newer is needed\n"


def test_with_sudo_that_asks_nothing_it_installs_after_one_update(machine: Machine) -> None:
    machine.command("sudo", '[[ $1 == -n ]] && shift; exec "$@"')
    done = machine.set_up()
    assert done.returncode == 0, done.stderr
    asked = [line for line in machine.told.read_text().splitlines() if line.startswith("apt-get")]
    assert asked == ["apt-get update -qq", f"apt-get install -y -qq {LIBRARIES}"]
    assert machine.pip_runs() == 1


def test_a_second_set_up_does_nothing_until_pyproject_changes(machine: Machine) -> None:
    machine.command("dpkg-query", "echo installed")
    assert machine.set_up().returncode == 0
    machine.told.write_text("")
    again = machine.set_up()
    assert (again.returncode, again.stdout, machine.told.read_text()) == (0, "", "")
    with (machine.project / "pyproject.toml").open("a") as file:
        file.write("# changed\n")
    assert machine.set_up().returncode == 0
    assert machine.pip_runs() == 1


def test_an_extra_is_installed_once_and_only_for_those_who_ask(machine: Machine) -> None:
    machine.command("dpkg-query", "echo installed")
    assert machine.set_up().returncode == 0
    assert "--editable .\n" in machine.told.read_text()
    assert machine.set_up("dev", "ray").returncode == 0
    assert "--editable .[dev,ray]\n" in machine.told.read_text()
    for extras in ([], ["ray"], ["dev"], ["dev", "ray"]):
        assert machine.set_up(*extras).returncode == 0
    assert machine.pip_runs() == 2


def test_who_only_uses_uwsim_gets_no_linters_and_no_pytest() -> None:
    rules = (ROOT / "Makefile").read_text()
    assert "\ninstall:\n\t@scripts/setup\n" in rules
    peers = "@scripts/ros1_peers --if-possible\n\t@scripts/ros2_messages --if-possible"
    set_up = f"@scripts/setup dev docs ray ros2\n\t{peers}"
    assert f"\ntest:\n\t{set_up}\n\tscripts/check --all\n" in rules


def test_a_set_up_that_failed_is_tried_again(machine: Machine) -> None:
    machine.command("dpkg-query", "echo installed")
    working = (machine.commands / "python3").read_text()
    machine.command("python3", working.replace('"-m pip"*)', '"-m pip"*) exit 1;'))
    assert machine.set_up().returncode != 0
    (machine.commands / "python3").write_text(working)
    shutil.copy(machine.commands / "python3", machine.project / ".venv" / "bin" / "python")
    assert machine.set_up().returncode == 0
    assert (machine.project / ".venv" / "bin" / "uwsim").exists()
