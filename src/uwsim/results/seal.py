"""A seal on journals and motion tracks: while a run goes on, its algorithm cannot read them.

They hold the ground truth, and an algorithm has the rights of the user who runs it. So they are
encrypted with a key that exists in memory only, of processes whose memory the user's other
processes cannot read. At the end of the run they are opened. A process beside the run, the
`Keeper`, has the key as well and opens them if the run is killed. If the machine goes down, what is
sealed is lost.

The key stream is SHAKE-256 of the key and of a number that is used once; HMAC-SHA-256 detects
changes. This file is also the program of the keeper: it imports the standard library alone.
"""

from __future__ import annotations

import base64
import binascii
import ctypes
import fcntl
import hashlib
import hmac
import json
import os
import secrets
import signal
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path

MAGIC = b"uwsim-sealed/1\n"
"""How a sealed file begins."""
SEALED = "sealed"
"""Key of a sealed line of a journal -> its content as base64."""
KEY, ONCE, TAG = 32, 16, 32
"""Bytes of a key, of a number that is used once, and of a tag."""
PATIENCE = 10.0
"""How long the keeper waits for the lock of the directory, and the run for the keeper [s]."""
ALL_OPEN = b"all open\n"
"""What a run tells its keeper that needs it no more."""
PR_SET_DUMPABLE = 4
FOLDER = "units"
"""Folder of a result in which sealed files are."""


@dataclass(frozen=True)
class Seal:
    """Encrypts and decrypts what is written during a run."""

    key: bytes = field(default_factory=lambda: secrets.token_bytes(KEY), repr=False)
    """Random; never on disk."""

    def closed(self, data: bytes) -> bytes:
        """Return data encrypted."""
        once = secrets.token_bytes(ONCE)
        hidden = once + _xor(data, self._stream(once, len(data)))
        return self._tag(hidden) + hidden

    def opened(self, data: bytes) -> bytes:
        """Return what `closed` has encrypted; raises ValueError if it is not that."""
        tag, hidden = data[:TAG], data[TAG:]
        if len(hidden) < ONCE or not hmac.compare_digest(tag, self._tag(hidden)):
            raise ValueError("it was changed, or is sealed with another key")
        return _xor(hidden[ONCE:], self._stream(hidden[:ONCE], len(hidden) - ONCE))

    def line(self, text: str) -> str:
        """Return a line of a journal sealed."""
        return json.dumps({SEALED: base64.b64encode(self.closed(text.encode())).decode()})

    def text(self, content: object) -> str:
        """Return the line whose content under `SEALED` is this; raises ValueError."""
        try:
            return self.opened(base64.b64decode(str(content), validate=True)).decode()
        except binascii.Error as error:
            raise ValueError(f"it is not sealed as uwsim does: {error}") from None

    def file(self, data: bytes) -> bytes:
        """Return the content of a file sealed."""
        return MAGIC + self.closed(data)

    def open_all(self, directory: Path) -> bool:
        """Open every sealed file of a result; returns whether all could be read and written.

        What another key has sealed is left as it is.
        """
        is_all_open = True
        for path in sorted((directory / FOLDER).glob("*")):
            try:
                before = path.read_bytes()
                after = self._plain(before)
                if after != before:
                    draft = path.with_name(f".{path.name}.{os.getpid()}.part")
                    draft.write_bytes(after)
                    draft.replace(path)
            except OSError:
                is_all_open = False
            except ValueError:
                pass
        return is_all_open

    def _plain(self, data: bytes) -> bytes:
        if data.startswith(MAGIC):
            return self.opened(data[len(MAGIC) :])
        start = json.dumps({SEALED: ""})[:-2].encode()
        return b"".join(
            self.text(json.loads(line)[SEALED]).encode() + b"\n" if line.startswith(start) else line
            for line in data.splitlines(keepends=True)
        )

    def _stream(self, once: bytes, length: int) -> bytes:
        return hashlib.shake_256(b"stream" + self.key + once).digest(length)

    def _tag(self, hidden: bytes) -> bytes:
        return hmac.digest(hashlib.sha256(b"tag" + self.key).digest(), hidden, "sha256")


class Keeper:
    """A process that opens the files of a run if the run itself cannot any more.

    Args:
        seal: with which they are sealed.
        directories: of the results.
    """

    def __init__(self, seal: Seal, directories: Sequence[Path]) -> None:
        self._process = subprocess.Popen(
            [sys.executable, "-I", "-S", __file__],
            stdin=subprocess.PIPE,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            start_new_session=True,  # Ctrl-C is for the run
        )
        paths = [str(directory.resolve()) for directory in directories]
        asked = json.dumps({"key": seal.key.hex(), "directories": paths})
        assert self._process.stdin is not None
        with suppress(OSError):
            self._process.stdin.write(asked.encode() + b"\n")
            self._process.stdin.flush()

    def close(self, *, is_all_open: bool = False) -> None:
        """Let it end; it opens what is sealed still, unless the run has opened all of it."""
        assert self._process.stdin is not None
        with suppress(OSError):
            if is_all_open:
                self._process.stdin.write(ALL_OPEN)
            self._process.stdin.close()
        try:
            self._process.wait(PATIENCE)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()


def deny_access_to_memory() -> None:
    """Keep other processes of this user from reading the memory and open files of this one.

    It dumps no core from now on. Programs that it starts are not affected.
    """
    with suppress(OSError, AttributeError):
        ctypes.CDLL(None, use_errno=True).prctl(PR_SET_DUMPABLE, 0, 0, 0, 0)


def keep() -> None:
    """Be the keeper: wait until the run has ended, then open what is sealed."""
    deny_access_to_memory()
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_IGN)
    asked = json.loads(sys.stdin.buffer.readline())
    if sys.stdin.buffer.read() == ALL_OPEN:
        return
    seal = Seal(bytes.fromhex(asked["key"]))
    for name in asked["directories"]:
        with suppress(OSError), _locked(Path(name)):
            seal.open_all(Path(name))


@contextmanager
def _locked(directory: Path) -> Iterator[None]:
    """Hold the lock of a result directory; waits a while, in which the run that had it ends."""
    handle = os.open(directory, os.O_RDONLY)
    end = time.monotonic() + PATIENCE
    try:
        while True:
            try:
                fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
                break
            except OSError:
                if time.monotonic() > end:
                    raise
                time.sleep(0.02)
        yield
    finally:
        os.close(handle)


def _xor(data: bytes, stream: bytes) -> bytes:
    both = int.from_bytes(data, "little") ^ int.from_bytes(stream, "little")
    return both.to_bytes(len(data), "little")


if __name__ == "__main__":
    keep()
