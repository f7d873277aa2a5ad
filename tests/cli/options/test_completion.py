"""What the shell is offered when Tab is pressed."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from uwsim.cli import COMMANDS, main
from uwsim.cli.options.completion import COMPLETION_VARIABLE


def offered(
    line: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> list[str]:
    """What bash is offered for the last word of a line."""
    monkeypatch.setenv(COMPLETION_VARIABLE, "complete_bash")
    monkeypatch.setenv("COMP_WORDS", line)
    monkeypatch.setenv("COMP_CWORD", str(len(line.split(" ")) - 1))
    assert main([]) == 0
    return capsys.readouterr().out.split()


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        ("uwsim ", sorted(COMMANDS)),
        ("uwsim en", ["envelope"]),
        ("uwsim bench vis", ["visibility", "visibility-moving", "visibility-physical"]),
        ("uwsim envelope cur", ["currents", "currents-figures"]),
        ("uwsim render visibility-m", ["visibility-moving-scene"]),
        ("uwsim bench visibility --algorithm e", ["ecc", "esm"]),
        ("uwsim bench visibility --scene cir", ["cirs"]),
        ("uwsim bench visibility --mode ", ["sequential", "independent"]),
        ("uwsim bench visibility --over", ["--overwrite"]),
        ("uwsim check visibility-s", ["visibility-scene"]),
        ("uwsim list alg", ["algorithms"]),
        ("uwsim bench 'visi", ["visibility", "visibility-moving", "visibility-physical"]),
    ],
)
def test_commands_options_and_names_are_completed(
    line: str,
    expected: list[str],
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert sorted(offered(line, monkeypatch, capsys)) == sorted(expected)


def test_files_of_ones_own_are_offered_with_the_bundled_names(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("visit.xml").touch()
    Path("vista.txt").touch()
    found = offered("uwsim bench vis", monkeypatch, capsys)
    assert found == ["visibility", "visibility-moving", "visibility-physical", "visit.xml"]


@pytest.mark.skipif(shutil.which("bash") is None, reason="needs bash")
def test_bash_completes_by_the_script_that_is_shown(tmp_path: Path) -> None:
    launcher = tmp_path / "uwsim"
    launcher.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m uwsim "$@"\n')
    launcher.chmod(0o755)
    shown = subprocess.run(
        ["bash", "-c", f"{launcher} --show-completion"], capture_output=True, text=True, check=True
    )
    assert "complete -o default -F _uwsim_completion uwsim" in shown.stdout
    ask = f"""{shown.stdout}
COMP_WORDS=(uwsim bench visibility --algorithm ss); COMP_CWORD=4
_uwsim_completion {launcher}; echo "${{COMPREPLY[@]}}"
"""
    done = subprocess.run(["bash", "-c", ask], capture_output=True, text=True, check=True)
    assert done.stdout == "ssd-esm\n"
