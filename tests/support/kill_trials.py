"""Disturb runs at random, resume them, and compare them with an undisturbed run.

A trial starts a short ``uwsim bench`` or ``uwsim verify`` and disturbs it: a signal at a random
time, SIGKILL at a change of the result directory, or a full disk. Then it checks for a traceback,
for remaining processes and temporary files, and for incomplete files. It continues with
``--resume``, sometimes disturbed again, and compares the bytes of the result with those of an
undisturbed run. The same ``--seed`` gives the same trials, up to effects of the machine's load.

    scripts/kill_trials --count 20 --seed 3
"""

from __future__ import annotations

import argparse
import json
import os
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from tests.support.short_benchmark import fingerprint, write_benchmark

TRIAL_VARIABLE = "UWSIM_TRIAL"
"""The environment variable that identifies all processes of a trial."""
COMMAND_TIMEOUT = 300.0
"""The timeout of a disturbed command [s]."""
EXIT_TIMEOUT = 15.0
"""The timeout of the child processes after the end of a command [s]."""
SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGKILL)
GROUP_SIGNALS = (signal.SIGINT, signal.SIGHUP)
"""The signals that a terminal sends to all processes of its foreground group."""
KINDS = ("signal", "change", "disk", "verify")
"""The kinds of trials without ``--kind``; ``ray`` needs Ray."""
HOOK = """
import os, sys
def watch(event, arguments):
    global left
    if event == "open":
        if not isinstance(arguments[0], str) or not arguments[2] & (os.O_WRONLY | os.O_RDWR):
            return
    elif event not in ("os.rename", "os.remove", "os.mkdir", "os.rmdir"):
        return
    if not str(arguments[0]).startswith(place):
        return
    left -= 1
    if left == 0:
        os.kill(os.getpid(), 9)
    if log is not None:
        os.write(log, b".")
place, left = os.environ["UWSIM_TRIAL_PLACE"], int(os.environ["UWSIM_TRIAL_CHANGE"])
log = None
if "--multiprocessing-fork" not in sys.argv and "uwsim" in " ".join(sys.orig_argv):
    if left == 0:
        log = os.open(os.environ["UWSIM_TRIAL_LOG"], os.O_CREAT | os.O_WRONLY | os.O_APPEND)
    sys.addaudithook(watch)
"""
"""A ``sitecustomize`` that counts changes of a directory, and kills its process at one of them."""


@dataclass
class CommandEnd:
    """The outcome of a command, and errors that the trial found."""

    status: int
    """The exit status."""
    text: str
    """The text on standard error."""
    seconds: float
    """The duration [s]."""
    errors: list[str] = field(default_factory=list)


@dataclass(kw_only=True)
class Workplace:
    """The folder of the trials, and the undisturbed result to compare with."""

    folder: Path
    benchmark: Path
    fingerprints: dict[str, str] = field(default_factory=dict)
    """The fingerprints of the undisturbed result."""
    seconds: float = 0.0
    """The duration of the undisturbed run [s]."""
    n_changes: int = 0
    """The number of changes of the directory of the undisturbed result."""
    changes: list[int] = field(default_factory=list)
    """The numbers of the changes before which no run was killed yet, in the order of use."""
    counts: Counter[str] = field(default_factory=Counter)
    """The numbers of trials, signals, kills at changes, and small disks so far."""

    @property
    def undisturbed_result(self) -> Path:
        """The directory of the undisturbed result."""
        return self.folder / "undisturbed"

    def bench(self, out: Path, workers: str) -> list[str]:
        """Return the command to disturb."""
        words = ["bench", str(self.benchmark), "--mode", "independent", "--seed", "1"]
        return [*words, "--workers", workers, "--out", str(out)]


def prepare(folder: Path) -> Workplace:
    """Run a short benchmark undisturbed."""
    workplace = Workplace(folder=folder, benchmark=write_benchmark(folder, "0.2"))
    hook = folder / "hook"
    hook.mkdir()
    (hook / "sitecustomize.py").write_text(HOOK)
    for _ in range(2):  # the second finds all caches filled
        shutil.rmtree(workplace.undisturbed_result, ignore_errors=True)
        log = folder / "changes"
        log.unlink(missing_ok=True)
        command_end = run(workplace, workplace.bench(workplace.undisturbed_result, "1"), change=0)
        if command_end.status != 0 or command_end.errors:
            raise SystemExit(f"the undisturbed run failed: {command_end.text}{command_end.errors}")
        workplace.seconds, workplace.n_changes = command_end.seconds, log.stat().st_size
    workplace.fingerprints = fingerprint(workplace.undisturbed_result)
    return workplace


def run(
    workplace: Workplace,
    words: Sequence[str],
    *,
    number: int | None = None,
    delay: float = 0.0,
    change: int | None = None,
    file_size: int | None = None,
) -> CommandEnd:
    """Run a command, disturb it, and check what it leaves behind.

    Args:
        workplace: the folder of the trials.
        words: the arguments of ``uwsim``.
        number: the signal to send.
        delay: the time before the signal [s].
        change: the number of the change of the directory that kills it; 0: count changes only.
        file_size: the largest size of a file that it may write [bytes].
    """
    scratch = Path(tempfile.mkdtemp(prefix="t", dir=workplace.folder))
    mark = scratch.name
    environment = {**os.environ, TRIAL_VARIABLE: mark, "TMPDIR": str(scratch)}
    if change is not None:
        environment |= {
            "UWSIM_TRIAL_PLACE": words[words.index("--out") + 1],
            "UWSIM_TRIAL_CHANGE": str(change),
            "UWSIM_TRIAL_LOG": str(workplace.folder / "changes"),
            "PYTHONPATH": f"{workplace.folder / 'hook'}:{os.environ.get('PYTHONPATH', '')}",
        }
    ray_folders = set(Path("/tmp").glob("uwsim-ray-*"))
    start_time = time.monotonic()
    with (workplace.folder / "stderr").open("w+b") as error_file:
        process = subprocess.Popen(
            [sys.executable, "-m", "uwsim", *words],
            stdout=subprocess.DEVNULL,
            stderr=error_file,
            env=environment,
            start_new_session=True,
            preexec_fn=lambda: _reset_signals(file_size),
        )
        errors = []
        try:
            if number is not None:
                _disturb(process, number, delay)
            process.wait(COMMAND_TIMEOUT)
        except subprocess.TimeoutExpired:
            errors.append(f"it did not end within {COMMAND_TIMEOUT:g} s")
        finally:  # Ctrl-C also ends the processes of a trial
            process.kill()
            process.wait()
        seconds = time.monotonic() - start_time
        errors += [f"left behind: {line}" for line in _kill_remaining(mark)]
        error_file.seek(0)
        text = error_file.read().decode(errors="replace")
    errors += [
        f"it printed {word!r}: {text}" for word in ("Traceback", "ignored in") if word in text
    ]
    remaining_paths = [*scratch.iterdir(), *(set(Path("/tmp").glob("uwsim-ray-*")) - ray_folders)]
    errors += [f"left in the temporary folder: {path.name}" for path in remaining_paths]
    shutil.rmtree(scratch)
    return CommandEnd(process.returncode, text, seconds, errors)


def _disturb(process: subprocess.Popen[bytes], number: int, delay: float) -> None:
    """Send a signal after a delay, unless the process has ended."""
    with suppress(subprocess.TimeoutExpired):
        process.wait(delay)
    if process.poll() is None:
        (os.killpg if number in GROUP_SIGNALS else os.kill)(process.pid, number)


def _reset_signals(file_size: int | None) -> None:
    """Reset all signal handlers, and limit the size of files."""
    for number in SIGNALS:
        if number != signal.SIGKILL:
            signal.signal(number, signal.SIG_DFL)
    if file_size is not None:
        resource.setrlimit(resource.RLIMIT_FSIZE, (file_size, file_size))


def _kill_remaining(mark: str) -> list[str]:
    """Wait for the processes of a trial; kill and name those that remain."""
    deadline = time.monotonic() + EXIT_TIMEOUT
    while (process_names := dict(_processes(mark))) and time.monotonic() < deadline:
        time.sleep(0.1)
    for process in process_names:
        with suppress(ProcessLookupError):
            os.kill(process, signal.SIGKILL)
    return list(process_names.values())


def _processes(mark: str) -> Iterator[tuple[int, str]]:
    """Yield the running processes of a trial, and their command lines."""
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit():
            with suppress(OSError):
                variables = (entry / "environ").read_bytes().split(b"\0")
                if f"{TRIAL_VARIABLE}={mark}".encode() in variables:
                    words = (entry / "cmdline").read_bytes().replace(b"\0", b" ")
                    yield int(entry.name), words.decode(errors="replace")[:200]


def find_broken_files(out: Path) -> list[str]:
    """Describe incomplete files of a disturbed result."""
    errors = []
    for name in ("result.json", "provenance.json"):
        for path in out.rglob(name):
            try:
                json.loads(path.read_text())
            except ValueError:
                errors.append(f"{path.relative_to(out)} is not whole")
    return errors


def resume_and_compare(workplace: Workplace, out: Path, workers: str) -> list[str]:
    """Resume to the end, and compare with the undisturbed run; return the errors."""
    errors = find_broken_files(out)
    command_end = run(workplace, [*workplace.bench(out, workers), "--resume"])
    errors += command_end.errors
    if command_end.status != 0:
        return [*errors, f"--resume ended with {command_end.status}: {command_end.text}"]
    now = fingerprint(out)
    differ = [
        n
        for n in sorted({*now, *workplace.fingerprints})
        if now.get(n) != workplace.fingerprints.get(n)
    ]
    return errors + [f"other bytes: {', '.join(differ)}"] * bool(differ)


def run_signal_trial(
    workplace: Workplace, chance: np.random.Generator, out: Path
) -> tuple[str, list[str]]:
    """Send one to three signals at random times, each to a resumed run."""
    return _run_signalled(workplace, chance, out, str(chance.integers(1, 3)))


def run_ray_trial(
    workplace: Workplace, chance: np.random.Generator, out: Path
) -> tuple[str, list[str]]:
    """Send signals to a run with its own Ray cluster."""
    return _run_signalled(workplace, chance, out, "ray")


def _run_signalled(
    workplace: Workplace, chance: np.random.Generator, out: Path, workers: str
) -> tuple[str, list[str]]:
    steps, errors = [f"--workers {workers}"], []
    for _ in range(int(chance.integers(1, 4))):
        number = signal.Signals(int(chance.choice([int(s) for s in SIGNALS])))
        delay = float(chance.uniform(0.02, 1.1)) * workplace.seconds
        steps.append(f"{number.name} after {delay:.2f} s")
        words = [*workplace.bench(out, workers), *(["--resume"] if out.exists() else [])]
        command_end = run(workplace, words, number=number, delay=delay)
        workplace.counts["signals"] += 1
        errors += command_end.errors + _check_status(command_end, number)
    return ", ".join(steps), errors + resume_and_compare(workplace, out, workers)


def _check_status(command_end: CommandEnd, number: signal.Signals) -> list[str]:
    signal_status = -int(number)
    early_statuses = () if number == signal.SIGINT else (signal_status,)
    own_statuses = () if number == signal.SIGKILL else (130,)
    if command_end.status in (0, *own_statuses, *early_statuses):
        return []
    return [f"exit status {command_end.status} after {number.name}: {command_end.text}"]


def run_change_trial(
    workplace: Workplace, chance: np.random.Generator, out: Path
) -> tuple[str, list[str]]:
    """Kill a run before a change of its directory; trials use each change once."""
    workplace.changes = workplace.changes or (chance.permutation(workplace.n_changes) + 1).tolist()
    change = workplace.changes.pop()
    command_end = run(workplace, workplace.bench(out, "1"), change=change)
    workplace.counts["changes"] += 1
    description = f"killed at change {change} of {workplace.n_changes}"
    kill_errors = (
        [] if command_end.status == -signal.SIGKILL else [f"was not killed: {command_end.status}"]
    )
    return description, [
        *command_end.errors,
        *kill_errors,
        *resume_and_compare(workplace, out, "1"),
    ]


def run_disk_trial(
    workplace: Workplace, chance: np.random.Generator, out: Path
) -> tuple[str, list[str]]:
    """Run with a full disk: a small tmpfs, or limited file sizes if mounting is not allowed."""
    size = int(10 ** chance.uniform(3.6, 5.6))
    workplace.counts["disks"] += 1
    with small_disk(out, size) as is_mounted:
        words = workplace.bench(out / "r", "1")
        command_end = run(workplace, words, file_size=None if is_mounted else size)
        kind = "tmpfs" if is_mounted else "files"
        description = f"{kind} of {size} bytes"
        if command_end.status == 0:
            return f"{description}, which was enough", command_end.errors
        errors = list(command_end.errors)
        if command_end.status != 3 or len(command_end.text.strip().splitlines()) != 1:
            errors.append(f"exit status {command_end.status} and not one line: {command_end.text}")
        if is_mounted:
            subprocess.run(["mount", "-o", "remount,size=64m", str(out)], check=True)
        return description, errors + resume_and_compare(workplace, out / "r", "1")


@contextmanager
def small_disk(folder: Path, size: int) -> Iterator[bool]:
    """Mount a file system of a size [bytes]; yield True if that is possible."""
    folder.mkdir()
    call = ["mount", "-t", "tmpfs", "-o", f"size={size}", "tmpfs", str(folder)]
    is_mounted = subprocess.run(call, capture_output=True, check=False).returncode == 0
    try:
        yield is_mounted
    finally:
        if is_mounted:
            subprocess.run(["umount", "-l", str(folder)], check=True)


def run_verify_trial(
    workplace: Workplace, chance: np.random.Generator, out: Path
) -> tuple[str, list[str]]:
    """Kill ``verify``, and check that the result is unchanged and nothing remains."""
    workers = str(chance.integers(1, 3))
    number = signal.Signals(int(chance.choice([int(s) for s in SIGNALS])))
    delay = float(chance.uniform(0.02, 1.0)) * workplace.seconds
    call = ["verify", str(workplace.undisturbed_result), "--all", "--workers", workers]
    command_end = run(workplace, call, number=number, delay=delay)
    workplace.counts["signals"] += 1
    errors = command_end.errors + _check_status(command_end, number)
    if fingerprint(workplace.undisturbed_result) != workplace.fingerprints:
        errors.append("the verified result was changed")
    return f"verify --workers {workers}, {number.name} after {delay:.2f} s", errors


TRIALS: dict[str, Callable[[Workplace, np.random.Generator, Path], tuple[str, list[str]]]] = {
    "signal": run_signal_trial,
    "change": run_change_trial,
    "disk": run_disk_trial,
    "verify": run_verify_trial,
    "ray": run_ray_trial,
}


def run_trial(workplace: Workplace, seed: int, index: int, kinds: Sequence[str]) -> list[str]:
    """Run a trial, print its description, and return its errors."""
    kind = kinds[index % len(kinds)]
    chance = np.random.Generator(np.random.Philox([seed, index]))
    out = workplace.folder / f"trial-{index}"
    description, errors = TRIALS[kind](workplace, chance, out)
    workplace.counts["trials"] += 1
    print(f"{index} {kind}: {description}: {'WRONG' if errors else 'right'}", flush=True)
    for error in errors:
        print(f"  {error}", flush=True)
    shutil.rmtree(out, ignore_errors=True)
    return errors


def main() -> int:
    """Run trials; return 1 if any failed."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--count", type=int, default=20, help="number of trials [20]")
    parser.add_argument("--seed", type=int, default=0, help="seed of the trials [0]")
    parser.add_argument(
        "--kind", action="append", choices=TRIALS, help="only trials of this kind; may be repeated"
    )
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="kill-trials-") as folder:
        workplace = prepare(Path(folder))
        print(f"undisturbed: {workplace.seconds:.1f} s, {workplace.n_changes} changes", flush=True)
        kinds = arguments.kind or KINDS
        trial_errors = [
            run_trial(workplace, arguments.seed, i, kinds) for i in range(arguments.count)
        ]
    n_wrong = sum(bool(errors) for errors in trial_errors)
    counts = ", ".join(f"{n} {name}" for name, n in sorted(workplace.counts.items()))
    print(f"{counts}; {n_wrong} trials went wrong")
    return 1 if n_wrong else 0


if __name__ == "__main__":
    sys.exit(main())
