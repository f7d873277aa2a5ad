"""Ctrl-C, whenever it comes: one line, no traceback, exit status 130."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

import pytest

from tests.support.short_benchmark import run, write_benchmark
from tests.support.waiting import LIMIT
from uwsim.base import interrupts
from uwsim.base.numerics.compiling import count_compilation
from uwsim.runs.executors import executor


@pytest.fixture(autouse=True)
def _no_interrupt_is_left(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    for name in ("_was_raised", "_is_pending", "_is_blocked"):
        monkeypatch.setattr(interrupts, name, threading.Event())
    numbers = signal.SIGINT, signal.SIGTERM, signal.SIGHUP
    before = [signal.getsignal(number) for number in numbers]
    yield
    for number, handler in zip(numbers, before, strict=True):
        signal.signal(number, handler)


def pressed(arguments: list[str], when: float) -> tuple[int, str]:
    """Start uwsim, press Ctrl-C after so many seconds, return its exit status and stderr."""
    process = subprocess.Popen(
        [sys.executable, "-m", *arguments],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,  # a terminal sends it to every process of its foreground group
    )
    time.sleep(when)
    os.killpg(process.pid, signal.SIGINT)
    _, said = process.communicate(timeout=200)
    return process.returncode, said


@pytest.mark.slow
@pytest.mark.parametrize("when", [1.0, 1.5, 2.0, 2.5, 3.0, 4.0])
def test_ctrl_c_in_the_first_seconds_of_a_run_shows_no_traceback(
    when: float, tmp_path: Path
) -> None:
    benchmark = write_benchmark(tmp_path, "30")
    call = ["uwsim", "bench", str(benchmark), "--out", str(tmp_path / "out")]
    status, said = pressed(call, when)
    assert "Traceback" not in said
    assert "ignored" not in said
    assert said.splitlines()[-1].startswith("uwsim: interrupted")
    assert status == 130


def test_ctrl_c_while_libraries_are_loaded_ends_a_command_with_one_line(tmp_path: Path) -> None:
    slow = "import sys, time\nsys.stderr.write('loading\\n')\ntime.sleep(250)\n"
    (tmp_path / "lxml").mkdir()
    (tmp_path / "lxml" / "__init__.py").write_text(slow)
    process = subprocess.Popen(
        [sys.executable, "-m", "uwsim", "check", "visibility"],
        stderr=subprocess.PIPE,
        text=True,
        env={**os.environ, "PYTHONPATH": f"{tmp_path}:{os.environ.get('PYTHONPATH', '')}"},
    )
    assert process.stderr is not None
    assert process.stderr.readline() == "loading\n"
    process.send_signal(signal.SIGINT)
    _, said = process.communicate(timeout=200)
    assert (process.returncode, said) == (130, "uwsim: interrupted.\n")


@pytest.mark.slow
def test_ctrl_c_while_the_interpreter_leaves_keeps_the_exit_status() -> None:
    late = """
import os, signal, sys
from uwsim import __main__, cli
class Late:
    def __del__(self):
        os.kill(os.getpid(), signal.SIGINT)
late = Late()  # goes when modules are torn down, after Python has let go of all signals
sys.argv = ["uwsim", "list", "benchmarks"]
sys.exit(__main__.run())
"""
    ended = subprocess.run(
        [sys.executable, "-c", late], capture_output=True, text=True, timeout=200, check=False
    )
    assert (ended.returncode, ended.stderr) == (0, "")


def test_who_ignores_ctrl_c_goes_on_ignoring_it() -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    interrupts.exit_on_interrupt()
    interrupts.raise_on_interrupt()
    assert signal.getsignal(signal.SIGINT) is signal.SIG_IGN


def test_from_a_point_on_ctrl_c_is_an_error_that_can_be_handled() -> None:
    before = signal.getsignal(signal.SIGINT)
    interrupts.raise_on_interrupt()
    assert signal.getsignal(signal.SIGINT) is before  # nobody asked for the other
    interrupts.exit_on_interrupt()
    assert signal.getsignal(signal.SIGINT) is not before
    interrupts.raise_on_interrupt()
    with pytest.raises(KeyboardInterrupt):
        press()


@pytest.fixture
def raising() -> None:
    """Ctrl-C raises KeyboardInterrupt, as in a run."""
    interrupts.exit_on_interrupt()
    interrupts.raise_on_interrupt()


def press() -> None:
    os.kill(os.getpid(), signal.SIGINT)


IN_MODERNGL = """
import os, signal, time
import _moderngl
from uwsim.base import interrupts
from uwsim.rendering.context import create_context

class Pressing(dict):
    def get(self, *key):
        os.kill(os.getpid(), signal.SIGINT)
        return super().get(*key)

context = create_context()
_moderngl.UNIFORM_LOOKUP_TABLE = Pressing(_moderngl.UNIFORM_LOOKUP_TABLE)
interrupts.exit_on_interrupt()
interrupts.raise_on_interrupt()
try:
    program = context.program(
        vertex_shader='#version 330\\nuniform vec4 at;\\nvoid main() { gl_Position = at; }'
    )
    assert program['at'].dimension == 4
    time.sleep(100)
except KeyboardInterrupt:
    print('raised when the program was there')
"""


def test_an_interrupt_waits_until_moderngl_has_made_a_program() -> None:
    """Its compiled code calls Python and takes the answer for granted: a segmentation fault."""
    ended = subprocess.run(
        [sys.executable, "-c", IN_MODERNGL], capture_output=True, text=True, timeout=200
    )
    assert (ended.returncode, ended.stdout) == (0, "raised when the program was there\n")


@pytest.mark.usefixtures("raising")
@pytest.mark.parametrize("module", ["numba.core.dispatcher", "llvmlite.binding", "namedtuple_Hit"])
def test_an_interrupt_waits_while_compiled_code_is_made_or_answers(module: str) -> None:
    its: dict[str, Any] = {"__name__": module, "press": press, "done": []}
    exec("def work():\n    press()\n    done.append(1)\n", its)

    def work() -> None:
        its["work"]()
        time.sleep(LIMIT)

    with pytest.raises(KeyboardInterrupt):
        work()
    assert its["done"] == [1]


@pytest.mark.usefixtures("raising")
def test_an_interrupt_that_waits_comes_in_before_the_next_function_is_compiled(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(interrupts, "RETRY_DELAY", LIMIT)
    its: dict[str, Any] = {
        "__name__": "numba.core.compiler",
        "press": press,
        "then": count_compilation,
    }
    exec("def work():\n    press()\n    then()\n", its)
    with pytest.raises(KeyboardInterrupt):
        its["work"]()


@pytest.mark.usefixtures("raising")
def test_an_interrupt_that_another_thread_takes_waits_while_a_process_is_started() -> None:
    done, leave = [], threading.Event()
    other = threading.Thread(target=leave.wait)
    other.start()

    def start() -> None:
        with interrupts.block_interrupts():
            press()  # to the other thread: this one blocks it
            time.sleep(0.1)
            done.append(1)
        time.sleep(LIMIT)

    try:
        with pytest.raises(KeyboardInterrupt):
            start()
    finally:
        leave.set()
        other.join()
    assert done == [1]


def test_a_run_whose_algorithm_swallows_the_interrupt_ends_and_keeps_no_spoiled_row(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def run_trial(*arguments: Any) -> Iterator[Any]:
        with suppress(BaseException):  # compiled code that returns a named tuple does this
            os.kill(os.getpid(), signal.SIGTERM)
        yield from original(*arguments)

    original = executor.run_trial
    monkeypatch.setattr(executor, "run_trial", run_trial)
    interrupts.raise_on_interrupt()
    with pytest.raises(KeyboardInterrupt):
        run(write_benchmark(tmp_path, "0.2"), tmp_path / "out")
    assert [path.read_text().count("\n") for path in (tmp_path / "out/units").iterdir()] == [1]


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGHUP])
def test_what_else_ends_a_run_is_as_ctrl_c_unless_it_is_ignored(number: int) -> None:
    signal.signal(number, signal.SIG_IGN)  # nohup
    interrupts.raise_on_interrupt()
    assert signal.getsignal(number) is signal.SIG_IGN
    signal.signal(number, signal.SIG_DFL)
    interrupts.raise_on_interrupt()
    with pytest.raises(KeyboardInterrupt):
        os.kill(os.getpid(), number)
