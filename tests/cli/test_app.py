"""The frame of the command line."""

from __future__ import annotations

import re
import subprocess
import sys

import pytest

from uwsim import errors
from uwsim.base import terminal
from uwsim.base.exceptions import convert_to_run_failed
from uwsim.base.numerics import compiling
from uwsim.cli import COMMANDS, app, exit_status, main
from uwsim.cli.suites.commands import SUITE_COMMANDS


def uwsim(*arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-m", "uwsim", *arguments],
        capture_output=True,
        text=True,
        check=False,
    )


def command_that(
    monkeypatch: pytest.MonkeyPatch, raised: BaseException | None = None, returned: object = None
) -> None:
    """Put a command ``bench`` in place of the real one."""

    def bench() -> object:
        if raised is not None:
            raise raised
        return returned

    monkeypatch.setattr(app.Command, "load", lambda self: bench)


def test_help_names_every_command_with_its_one_line(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["--help"]) == 0
    text = capsys.readouterr().out
    for name, command in COMMANDS.items():
        assert f"  {name} " in text
        assert command.summary in text


def test_without_arguments_help_is_shown(capsys: pytest.CaptureFixture[str]) -> None:
    assert main([]) == 0
    assert capsys.readouterr().out.startswith("Usage: uwsim")


def test_help_imports_no_heavy_library() -> None:
    heavy = (
        "numba",
        "scipy",
        "matplotlib",
        "mujoco",
        "moderngl",
        "cv2",
        "trimesh",
        "lxml",
        "numpy",
    )
    code = (
        "import sys; from uwsim.cli import main; main(['--help']); "
        f"sys.exit(','.join(name for name in {heavy} if name in sys.modules) or 0)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.parametrize("name", COMMANDS)
def test_the_help_of_a_command_says_what_it_does_and_shows_an_example(
    name: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([name, "--help"]) == 0
    text = capsys.readouterr().out
    assert text.startswith(f"Usage: uwsim {name} ")
    for example in COMMANDS[name].examples:
        assert f"$ {example}" in text


@pytest.mark.parametrize("name", COMMANDS)
def test_h_is_help(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["-h"]) == 0
    assert capsys.readouterr().out.startswith("Usage: uwsim [OPTIONS] COMMAND")
    assert main([name, "-h"]) == 0
    assert capsys.readouterr().out.startswith(f"Usage: uwsim {name} ")


@pytest.mark.parametrize("name", [n for n, c in COMMANDS.items() if not c.subcommands])
def test_the_help_of_a_command_shows_options_in_groups_and_no_types_of_python(
    name: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([name, "--help"]) == 0
    text = capsys.readouterr().out
    assert re.findall(r"<[\w\[\] ]+>", text) == []
    titles = re.findall(r"^([A-Z][a-z ]+):$", text, re.M)
    assert titles[-1] == "Options"
    listed = text.partition("\nOptions:\n")[2].partition("\n\n")[0]
    assert listed.strip() == "-h, --help  Show this message and exit."


@pytest.mark.parametrize("name", SUITE_COMMANDS)
def test_a_command_of_a_group_has_a_help_with_examples(
    name: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["suite", name, "--help"]) == 0
    text = capsys.readouterr().out
    assert text.startswith(f"Usage: uwsim suite {name} ")
    assert SUITE_COMMANDS[name].examples
    for example in SUITE_COMMANDS[name].examples:
        assert example.startswith(f"uwsim suite {name}")
        assert f"$ {example}" in " ".join(text.split())


def test_the_help_of_a_group_names_its_commands(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["suite", "--help"]) == 0
    text = capsys.readouterr().out
    for name, command in SUITE_COMMANDS.items():
        assert f"  {name} " in text
        assert command.summary in text


def test_the_first_line_of_a_commands_help_is_its_summary_of_one_line() -> None:
    for command in (*COMMANDS.values(), *SUITE_COMMANDS.values()):
        first, _, rest = (command.load().__doc__ or "").partition("\n")
        assert first.endswith(".")
        assert rest.strip() == "" or rest.startswith("\n"), command


def test_the_package_itself_is_the_command() -> None:
    done = uwsim("--version")
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.startswith("uwsim 0.")


@pytest.mark.parametrize("name", COMMANDS)
def test_an_example_of_a_command_is_a_call_of_that_command(name: str) -> None:
    assert COMMANDS[name].examples
    assert all(example.split()[:2] == ["uwsim", name] for example in COMMANDS[name].examples)


def test_the_version_is_printed(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["--version"]) == 0
    assert capsys.readouterr().out.startswith("uwsim 0.")


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["bensh"], "uwsim: No such command 'bensh'. Did you mean 'bench'?\n"),
        (["--sed", "1"], "uwsim: No such option: --sed\n"),
    ],
)
def test_a_wrong_call_gets_one_line_and_exit_status_2(
    arguments: list[str], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(arguments) == 2
    assert capsys.readouterr().err == said


def test_a_missing_argument_is_reported_with_where_to_look(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert main(["check"]) == 2
    said = "uwsim: Missing argument 'FILE.xml'; uwsim check -h shows its options.\n"
    assert capsys.readouterr().err == said


ERROR = errors.Diagnostic(
    file="a.xml", line=3, message="<fog> is 'thick'; expected a number [1/m]."
)
WHOLE = errors.Diagnostic(file="a.xml", line=None, message="too deep.")


@pytest.mark.parametrize(
    ("error", "said", "status"),
    [
        (
            errors.SceneError([ERROR, WHOLE]),
            "a.xml:3: <fog> is 'thick'; expected a number [1/m].\na.xml: too deep.\n",
            2,
        ),
        (errors.AssetNotFound("box.obj is nowhere."), "uwsim: box.obj is nowhere.\n", 2),
        (errors.BadSetting("fog is not here."), "uwsim: fog is not here.\n", 2),
        (errors.NoGraphics("no context."), "uwsim: no context.\n", 2),
        (errors.ResultError("not a result."), "uwsim: not a result.\n", 2),
        (errors.ReplayDiffers("row 3 differs."), "uwsim: row 3 differs.\n", 3),
        (errors.NeverStarted("no call."), "uwsim: no call.\n", 3),
        (
            FileNotFoundError(2, "No such file or directory", "x.xml"),
            "uwsim: No such file or directory: x.xml\n",
            2,
        ),
        (OSError(28, "No space left on device", "r"), "uwsim: No space left on device: r\n", 3),
        (ZeroDivisionError("oh"), "uwsim: ZeroDivisionError: oh (--traceback shows where)\n", 3),
        (KeyboardInterrupt(), "uwsim: interrupted; finished results are kept.\n", 130),
        (errors.BadSetting("\x1b[2J"), "uwsim: \\x1b[2J\n", 2),
    ],
)
def test_an_error_is_printed_in_clean_lines_with_its_exit_status(
    error: BaseException,
    said: str,
    status: int,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    command_that(monkeypatch, raised=error)
    assert main(["bench"]) == status
    assert capsys.readouterr().err == said


@pytest.mark.parametrize("arguments", [["--traceback", "bench"], ["bench", "--traceback"]])
def test_traceback_shows_where_an_error_was_raised(
    arguments: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    command_that(monkeypatch, raised=errors.BadSetting("no"))
    with pytest.raises(errors.BadSetting):
        main(arguments)


def test_what_a_command_returns_is_the_exit_status(monkeypatch: pytest.MonkeyPatch) -> None:
    command_that(monkeypatch, returned=3)
    assert main(["bench"]) == 3
    command_that(monkeypatch, returned=None)
    assert main(["bench"]) == 0


def test_every_error_of_the_tree_has_an_exit_status_of_wrong_input_or_failed_run() -> None:
    def below(kind: type[BaseException]) -> set[type[BaseException]]:
        return {kind}.union(*(below(child) for child in kind.__subclasses__()))

    for kind in below(errors.UwsimError):
        assert exit_status.exit_status(kind.__new__(kind)) in (2, 3), kind


@pytest.mark.parametrize(
    ("said", "expected"),
    [
        (f"<fog> is {'x' * 10_000!r}; expected a number.", "expected a number."),
        (f"<name> {'y' * 10_000} is not known", "is not known"),
        ("a.xml:3: '" + "thick fog " * 1000 + "' is no number", "is no number"),
    ],
)
def test_an_error_shows_no_more_of_a_file_than_can_be_read(said: str, expected: str) -> None:
    shown = exit_status.format_error(errors.BadSetting(said))
    assert 300 < len(shown) < 420
    assert shown.endswith(expected)
    assert "more letters)" in shown


def test_an_error_of_normal_length_is_shown_whole() -> None:
    folders = ", ".join(f"/home/someone/simulation/data/folder-{i}" for i in range(20))
    said = f"'box.obj' is neither a file nor bundled. The file's folders: {folders}. Is 'x' meant?"
    assert exit_status.format_error(errors.BadSetting(said)) == f"uwsim: {said}"
    long = terminal.clean_text(" ".join(["word"] * 10_000))
    assert len(long) == terminal.MAX_LINE_LENGTH + 1


def test_what_the_system_refuses_while_a_run_is_on_is_a_failed_run() -> None:
    said = r"No such file or directory: out/result\.json"
    with pytest.raises(errors.RunFailed, match=said), convert_to_run_failed():
        raise FileNotFoundError(2, "No such file or directory", "out/result.json")
    with pytest.raises(BrokenPipeError), convert_to_run_failed():
        raise BrokenPipeError


def test_a_reader_that_closes_the_pipe_early_causes_no_error() -> None:
    done = subprocess.run(
        ["bash", "-c", f"{sys.executable} -m uwsim.cli list | head -1"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.stdout, done.stderr) == ("scenes\n", "")


@pytest.mark.parametrize("is_terminal", [True, False])
def test_a_terminal_is_told_of_a_start_that_compiles(
    is_terminal: bool, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Once, when several functions are not on the disk."""

    def start() -> None:
        for _ in range(2 * compiling.SLOW_START_COUNT):
            compiling.count_compilation()

    monkeypatch.setattr(compiling, "_n_compiled", 0)
    compiling.on_slow_start(compiling.report_compilation)  # as in a new process
    monkeypatch.setattr(app.Command, "load", lambda self: start)
    monkeypatch.setattr(sys.stderr, "isatty", lambda: is_terminal)
    assert main(["bench"]) == 0
    assert capsys.readouterr().err == (f"{compiling.COMPILATION_MESSAGE}\n" if is_terminal else "")
