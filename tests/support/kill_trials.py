"""Kill trials: runs are disturbed at random, gone on with, and held against an undisturbed one.

A trial starts a short ``uwsim bench`` or ``uwsim verify`` and disturbs it: a signal at a random
moment, SIGKILL at one of its changes of the result directory, or a full disk. Then it looks for a
traceback, processes and temporary files left behind, and a file that is not whole; goes on with
``--resume``, disturbed again now and then; and compares the bytes of what came out with those of a
run that nobody disturbed. Same ``--seed``: the same trials, but for what the machine's load shifts.

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

MARK = "UWSIM_TRIAL"
"""Environment variable by which all processes of a trial are known, whatever their parents."""
PATIENCE = 300.0
"""How long a disturbed command may take to end [s]."""
LINGER = 15.0
"""How long what it has started may take to end after it [s]."""
SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGKILL)
TO_ALL = (signal.SIGINT, signal.SIGHUP)
"""What a terminal sends to every process of its foreground group."""
KINDS = ("signal", "change", "disk", "verify")
"""What is tried unless ``--kind`` says otherwise; ``ray`` needs Ray."""
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
"""A ``sitecustomize``: counts changes of a directory, and kills its process at one of them."""


@dataclass
class Ended:
    """How a command came to its end."""

    status: int
    said: str
    seconds: float
    errors: list[str] = field(default_factory=list)


@dataclass(kw_only=True)
class Workplace:
    """Where trials are made, and what they are compared with."""

    folder: Path
    benchmark: Path
    whole: dict[str, str] = field(default_factory=dict)
    """Fingerprints of the undisturbed result."""
    seconds: float = 0.0
    """How long the undisturbed run took."""
    n_changes: int = 0
    """How often it changed its directory."""
    changes: list[int] = field(default_factory=list)
    """Those at which no run was killed yet, in the order in which they are taken."""
    counts: Counter[str] = field(default_factory=Counter)
    """What was done so far."""

    @property
    def undisturbed(self) -> Path:
        """The result that nobody disturbed."""
        return self.folder / "undisturbed"

    def bench(self, out: Path, workers: str) -> list[str]:
        """The command whose runs are disturbed."""
        words = ["bench", str(self.benchmark), "--mode", "independent", "--seed", "1"]
        return [*words, "--workers", workers, "--out", str(out)]


def prepare(folder: Path) -> Workplace:
    """Play a short benchmark undisturbed."""
    place = Workplace(folder=folder, benchmark=write_benchmark(folder, "0.2"))
    hook = folder / "hook"
    hook.mkdir()
    (hook / "sitecustomize.py").write_text(HOOK)
    for _ in range(2):  # the second finds all caches filled
        shutil.rmtree(place.undisturbed, ignore_errors=True)
        log = folder / "changes"
        log.unlink(missing_ok=True)
        ended = run(place, place.bench(place.undisturbed, "1"), change=0)
        if ended.status != 0 or ended.errors:
            raise SystemExit(f"the undisturbed run failed: {ended.said}{ended.errors}")
        place.seconds, place.n_changes = ended.seconds, log.stat().st_size
    place.whole = fingerprint(place.undisturbed)
    return place


def run(
    place: Workplace,
    words: Sequence[str],
    *,
    number: int | None = None,
    after: float = 0.0,
    change: int | None = None,
    file_size: int | None = None,
) -> Ended:
    """Run a command, disturb it, and see what it leaves behind.

    Args:
        place: where.
        words: what is typed behind ``uwsim``.
        number: a signal to be sent.
        after: when [s].
        change: at which change of its directory it is killed; 0: none, changes are counted.
        file_size: how large its files may become [bytes].
    """
    scratch = Path(tempfile.mkdtemp(prefix="t", dir=place.folder))
    mark = scratch.name
    environment = {**os.environ, MARK: mark, "TMPDIR": str(scratch)}
    if change is not None:
        environment |= {
            "UWSIM_TRIAL_PLACE": words[words.index("--out") + 1],
            "UWSIM_TRIAL_CHANGE": str(change),
            "UWSIM_TRIAL_LOG": str(place.folder / "changes"),
            "PYTHONPATH": f"{place.folder / 'hook'}:{os.environ.get('PYTHONPATH', '')}",
        }
    ours = set(Path("/tmp").glob("uwsim-ray-*"))
    began = time.monotonic()
    with (place.folder / "said").open("w+b") as said:
        process = subprocess.Popen(
            [sys.executable, "-m", "uwsim", *words],
            stdout=subprocess.DEVNULL,
            stderr=said,
            env=environment,
            start_new_session=True,
            preexec_fn=lambda: _as_from_a_terminal(file_size),
        )
        errors = []
        try:
            if number is not None:
                _disturb(process, number, after)
            process.wait(PATIENCE)
        except subprocess.TimeoutExpired:
            errors.append(f"it did not end within {PATIENCE:g} s")
        finally:  # Ctrl-C ends a trial with what it has started
            process.kill()
            process.wait()
        seconds = time.monotonic() - began
        errors += [f"left behind: {line}" for line in _left_behind(mark)]
        said.seek(0)
        text = said.read().decode(errors="replace")
    errors += [f"it said {word!r}: {text}" for word in ("Traceback", "ignored in") if word in text]
    left = [*scratch.iterdir(), *(set(Path("/tmp").glob("uwsim-ray-*")) - ours)]
    errors += [f"left in the temporary folder: {path.name}" for path in left]
    shutil.rmtree(scratch)
    return Ended(process.returncode, text, seconds, errors)


def _disturb(process: subprocess.Popen[bytes], number: int, after: float) -> None:
    """Send a signal after a while, unless it is over by then."""
    with suppress(subprocess.TimeoutExpired):
        process.wait(after)
    if process.poll() is None:
        (os.killpg if number in TO_ALL else os.kill)(process.pid, number)


def _as_from_a_terminal(file_size: int | None) -> None:
    """Hear all signals, whoever has started the trials, and write no larger files than that."""
    for number in SIGNALS:
        if number != signal.SIGKILL:
            signal.signal(number, signal.SIG_DFL)
    if file_size is not None:
        resource.setrlimit(resource.RLIMIT_FSIZE, (file_size, file_size))


def _left_behind(mark: str) -> list[str]:
    """Wait for what a trial has started to end; end and name what does not."""
    until = time.monotonic() + LINGER
    while (left := dict(_processes(mark))) and time.monotonic() < until:
        time.sleep(0.1)
    for process in left:
        with suppress(ProcessLookupError):
            os.kill(process, signal.SIGKILL)
    return list(left.values())


def _processes(mark: str) -> Iterator[tuple[int, str]]:
    """Processes of a trial that live, and their command lines."""
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit():
            with suppress(OSError):
                variables = (entry / "environ").read_bytes().split(b"\0")
                if f"{MARK}={mark}".encode() in variables:
                    words = (entry / "cmdline").read_bytes().replace(b"\0", b" ")
                    yield int(entry.name), words.decode(errors="replace")[:200]


def broken_files(out: Path) -> list[str]:
    """Files of a disturbed result that are there and are not whole."""
    found = []
    for name in ("result.json", "provenance.json"):
        for path in out.rglob(name):
            try:
                json.loads(path.read_text())
            except ValueError:
                found.append(f"{path.relative_to(out)} is not whole")
    return found


def outcome(place: Workplace, out: Path, workers: str) -> list[str]:
    """Go on to the end, and compare with the undisturbed run; returns what is wrong."""
    errors = broken_files(out)
    ended = run(place, [*place.bench(out, workers), "--resume"])
    errors += ended.errors
    if ended.status != 0:
        return [*errors, f"--resume ended with {ended.status}: {ended.said}"]
    now = fingerprint(out)
    differ = [n for n in sorted({*now, *place.whole}) if now.get(n) != place.whole.get(n)]
    return errors + [f"other bytes: {', '.join(differ)}"] * bool(differ)


def of_signals(place: Workplace, chance: np.random.Generator, out: Path) -> tuple[str, list[str]]:
    """One to three signals at random moments, each to a run that goes on with the last."""
    return _signalled(place, chance, out, str(chance.integers(1, 3)))


def of_ray(place: Workplace, chance: np.random.Generator, out: Path) -> tuple[str, list[str]]:
    """The same with a Ray cluster of the run's own."""
    return _signalled(place, chance, out, "ray")


def _signalled(
    place: Workplace, chance: np.random.Generator, out: Path, workers: str
) -> tuple[str, list[str]]:
    told, errors = [f"--workers {workers}"], []
    for _ in range(int(chance.integers(1, 4))):
        number = signal.Signals(int(chance.choice([int(s) for s in SIGNALS])))
        after = float(chance.uniform(0.02, 1.1)) * place.seconds
        told.append(f"{number.name} after {after:.2f} s")
        words = [*place.bench(out, workers), *(["--resume"] if out.exists() else [])]
        ended = run(place, words, number=number, after=after)
        place.counts["signals"] += 1
        errors += ended.errors + _wrong_status(ended, number)
    return ", ".join(told), errors + outcome(place, out, workers)


def _wrong_status(ended: Ended, number: signal.Signals) -> list[str]:
    by_signal = -int(number)
    until_there_is_something_to_keep = () if number == signal.SIGINT else (by_signal,)
    by_itself = () if number == signal.SIGKILL else (130,)
    if ended.status in (0, *by_itself, *until_there_is_something_to_keep):
        return []
    return [f"exit status {ended.status} after {number.name}: {ended.said}"]


def of_changes(place: Workplace, chance: np.random.Generator, out: Path) -> tuple[str, list[str]]:
    """SIGKILL right before one of the changes of its directory; each is taken once."""
    place.changes = place.changes or (chance.permutation(place.n_changes) + 1).tolist()
    change = place.changes.pop()
    ended = run(place, place.bench(out, "1"), change=change)
    place.counts["changes"] += 1
    told = f"killed at change {change} of {place.n_changes}"
    missed = [] if ended.status == -signal.SIGKILL else [f"was not killed: {ended.status}"]
    return told, [*ended.errors, *missed, *outcome(place, out, "1")]


def of_disks(place: Workplace, chance: np.random.Generator, out: Path) -> tuple[str, list[str]]:
    """A disk that is full: a tmpfs where one can be mounted, else files that cannot grow."""
    size = int(10 ** chance.uniform(3.6, 5.6))
    place.counts["disks"] += 1
    with small_disk(out, size) as is_mounted:
        words = place.bench(out / "r", "1")
        ended = run(place, words, file_size=None if is_mounted else size)
        kind = "tmpfs" if is_mounted else "files"
        told = f"{kind} of {size} bytes"
        if ended.status == 0:
            return f"{told}, which was enough", ended.errors
        errors = list(ended.errors)
        if ended.status != 3 or len(ended.said.strip().splitlines()) != 1:
            errors.append(f"exit status {ended.status} and not one line: {ended.said}")
        if is_mounted:
            subprocess.run(["mount", "-o", "remount,size=64m", str(out)], check=True)
        return told, errors + outcome(place, out / "r", "1")


@contextmanager
def small_disk(folder: Path, size: int) -> Iterator[bool]:
    """A file system of so many bytes; yields whether it could be had."""
    folder.mkdir()
    call = ["mount", "-t", "tmpfs", "-o", f"size={size}", "tmpfs", str(folder)]
    is_mounted = subprocess.run(call, capture_output=True, check=False).returncode == 0
    try:
        yield is_mounted
    finally:
        if is_mounted:
            subprocess.run(["umount", "-l", str(folder)], check=True)


def of_verify(place: Workplace, chance: np.random.Generator, out: Path) -> tuple[str, list[str]]:
    """A ``verify`` that is killed leaves nothing behind, and the result as it was."""
    workers = str(chance.integers(1, 3))
    number = signal.Signals(int(chance.choice([int(s) for s in SIGNALS])))
    after = float(chance.uniform(0.02, 1.0)) * place.seconds
    call = ["verify", str(place.undisturbed), "--all", "--workers", workers]
    ended = run(place, call, number=number, after=after)
    place.counts["signals"] += 1
    errors = ended.errors + _wrong_status(ended, number)
    if fingerprint(place.undisturbed) != place.whole:
        errors.append("the verified result was changed")
    return f"verify --workers {workers}, {number.name} after {after:.2f} s", errors


TRIALS: dict[str, Callable[[Workplace, np.random.Generator, Path], tuple[str, list[str]]]] = {
    "signal": of_signals,
    "change": of_changes,
    "disk": of_disks,
    "verify": of_verify,
    "ray": of_ray,
}


def trial(place: Workplace, seed: int, index: int, kinds: Sequence[str]) -> list[str]:
    """Make one trial, say what it was, and return what was wrong."""
    kind = kinds[index % len(kinds)]
    chance = np.random.Generator(np.random.Philox([seed, index]))
    out = place.folder / f"trial-{index}"
    told, errors = TRIALS[kind](place, chance, out)
    place.counts["trials"] += 1
    print(f"{index} {kind}: {told}: {'WRONG' if errors else 'right'}", flush=True)
    for error in errors:
        print(f"  {error}", flush=True)
    shutil.rmtree(out, ignore_errors=True)
    return errors


def main() -> int:
    """Make trials; exit status 1 if anything was wrong."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--count", type=int, default=20, help="how many trials [20]")
    parser.add_argument("--seed", type=int, default=0, help="draws the trials [0]")
    parser.add_argument(
        "--kind", action="append", choices=TRIALS, help="only trials of this kind; may be repeated"
    )
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="kill-trials-") as folder:
        place = prepare(Path(folder))
        print(f"undisturbed: {place.seconds:.1f} s, {place.n_changes} changes", flush=True)
        kinds = arguments.kind or KINDS
        found = [trial(place, arguments.seed, i, kinds) for i in range(arguments.count)]
    n_wrong = sum(bool(errors) for errors in found)
    counts = ", ".join(f"{n} {what}" for what, n in sorted(place.counts.items()))
    print(f"{counts}; {n_wrong} trials went wrong")
    return 1 if n_wrong else 0


if __name__ == "__main__":
    sys.exit(main())
