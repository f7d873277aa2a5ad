"""Command lines of scripts for the original UWSim name today's command."""

from __future__ import annotations

import pytest

from uwsim.cli import main

OLD = {
    "--configfile cirs.xml --dataPath DIR --disableShaders": "run cirs.xml --data-path DIR",
    "--configfile=a b.xml": "run 'a b.xml'",
    "--dataPath /a --configfile x.xml --dataPath /b": "run x.xml --data-path /a --data-path /b",
    "--disableShaders": "run cirs",
    "--disableTextures --freeMotion --resw 640 --resh 480": (
        "run cirs --set simParams.resw=640 --set simParams.resh=480"
    ),
    "--windSpeed 3 --configfile s.xml --oceanSurfaceHeight -1 --depth 20": (
        "run s.xml --set oceanState.windSpeed=3 --set oceanState.oceanSurfaceHeight=-1 "
        "--set oceanState.depth=20"
    ),
    "--configfile s.xml --benchmark b.xml": "bench b.xml --scene s.xml",
    "--configfile s.xml __name:=uwsim": "run s.xml",
    "--configfile": "run ...",
}


@pytest.mark.parametrize("words", OLD)
def test_a_command_line_of_the_original_names_todays_command(
    words: str, capsys: pytest.CaptureFixture[str]
) -> None:
    given = [words] if "a b" in words else words.split()
    assert main(given) == 2
    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert f"The command is now: uwsim {OLD[words]}" in said


@pytest.mark.parametrize("name", ["run", "bench"])
def test_the_options_that_it_names_are_those_of_today(
    name: str, capsys: pytest.CaptureFixture[str]
) -> None:
    main([name, "--help"])
    described = capsys.readouterr().out
    of_bench = ["--scene"] if name == "bench" else ["--ros1", "--ros2", "--view"]
    for option in ("--data-path", "--set", *of_bench):
        assert f"{option} " in described


@pytest.mark.parametrize(
    ("words", "today"),
    [
        ("run cirs --dataPath DIR", "--dataPath: now --data-path DIR"),
        ("run --configfile cirs.xml", "--configfile: now the scene is an argument"),
        ("render cirs -o a.png --disableShaders", "--disableShaders: now there is none"),
        ("info cirs --windx 3", "--windx: now --set oceanState.windx=VALUE"),
    ],
)
def test_an_old_option_of_a_command_of_today_names_todays(
    words: str, today: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(words.split()) == 2
    assert today in capsys.readouterr().err


def test_options_of_today_are_not_taken_for_old_ones(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["verify", "no.result", "--benchmark", "b.xml"]) == 2
    assert main(["--version"]) == 0
    assert "original UWSim" not in capsys.readouterr().err
