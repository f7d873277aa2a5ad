"""The encryption (sealing) of journals and motion tracks during a run.

These files hold the ground truth, and an algorithm under test has the rights of the user who runs
it. So that it cannot read them, they are encrypted with a key that exists only in the memory of
processes that the user's other processes cannot read. At the end of the run they are decrypted. A
second process, the `Keeper`, also has the key and decrypts the files if the run is killed. If the
machine goes down, sealed content is lost.

The key stream is SHAKE-256 of the key and a nonce; HMAC-SHA-256 detects changes. This file is also
the program of the keeper, so it imports the standard library alone.
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
"""The first bytes of a sealed file."""
SEALED_KEY = "sealed"
"""The key, in a sealed line of a journal, of its content as base64."""
KEY_SIZE, NONCE_SIZE, TAG_SIZE = 32, 16, 32
"""The sizes of the key, of a nonce (a number that is used once), and of an authentication tag
[bytes]."""
LOCK_TIMEOUT = 10.0
"""The longest wait for the lock of the directory, and for the keeper at the end of a run [s]."""
ALL_OPEN = b"all open\n"
"""The message to the keeper that all files are decrypted."""
PR_SET_DUMPABLE = 4
FOLDER = "units"
"""The folder of a result with the sealed files."""


@dataclass(frozen=True)
class Seal:
    """The key of a run, with the encryption and decryption of its files."""

    key: bytes = field(default_factory=lambda: secrets.token_bytes(KEY_SIZE), repr=False)
    """The random key, which is never on disk."""

    def encrypt(self, data: bytes) -> bytes:
        """Return encrypted data."""
        nonce = secrets.token_bytes(NONCE_SIZE)
        ciphertext = nonce + _xor(data, self._stream(nonce, len(data)))
        return self._tag(ciphertext) + ciphertext

    def decrypt(self, data: bytes) -> bytes:
        """Return decrypted data; raise ValueError if `encrypt` did not write it with this key."""
        tag, ciphertext = data[:TAG_SIZE], data[TAG_SIZE:]
        if len(ciphertext) < NONCE_SIZE or not hmac.compare_digest(tag, self._tag(ciphertext)):
            raise ValueError("it was changed, or is sealed with another key")
        nonce, encrypted_data = ciphertext[:NONCE_SIZE], ciphertext[NONCE_SIZE:]
        return _xor(encrypted_data, self._stream(nonce, len(encrypted_data)))

    def line(self, text: str) -> str:
        """Return the sealed line of a journal for a text."""
        return json.dumps({SEALED_KEY: base64.b64encode(self.encrypt(text.encode())).decode()})

    def text(self, content: object) -> str:
        """Return the decrypted content under `SEALED_KEY`; raise ValueError if it is invalid."""
        try:
            return self.decrypt(base64.b64decode(str(content), validate=True)).decode()
        except binascii.Error as error:
            raise ValueError(f"it is not sealed as uwsim does: {error}") from None

    def file(self, data: bytes) -> bytes:
        """Return the content of the sealed file for some data."""
        return MAGIC + self.encrypt(data)

    def open_all(self, directory: Path) -> bool:
        """Decrypt every sealed file of a result; return whether all could be read and written.

        Files that are sealed with another key are left unchanged.
        """
        is_all_open = True
        for path in sorted((directory / FOLDER).glob("*")):
            try:
                content = path.read_bytes()
                decrypted_content = self._decrypt_file(content)
                if decrypted_content != content:
                    draft = path.with_name(f".{path.name}.{os.getpid()}.part")
                    draft.write_bytes(decrypted_content)
                    draft.replace(path)
            except OSError:
                is_all_open = False
            except ValueError:
                pass
        return is_all_open

    def _decrypt_file(self, data: bytes) -> bytes:
        if data.startswith(MAGIC):
            return self.decrypt(data[len(MAGIC) :])
        start = json.dumps({SEALED_KEY: ""})[:-2].encode()
        return b"".join(
            self.text(json.loads(line)[SEALED_KEY]).encode() + b"\n"
            if line.startswith(start)
            else line
            for line in data.splitlines(keepends=True)
        )

    def _stream(self, nonce: bytes, length: int) -> bytes:
        return hashlib.shake_256(b"stream" + self.key + nonce).digest(length)

    def _tag(self, ciphertext: bytes) -> bytes:
        return hmac.digest(hashlib.sha256(b"tag" + self.key).digest(), ciphertext, "sha256")


class Keeper:
    """A process that decrypts the files of a run if the run itself cannot do so.

    Args:
        seal: the seal of the files.
        directories: the directories of the results.
    """

    def __init__(self, seal: Seal, directories: Sequence[Path]) -> None:
        self._process = subprocess.Popen(
            [sys.executable, "-I", "-S", __file__],
            stdin=subprocess.PIPE,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            start_new_session=True,  # Ctrl-C reaches the run alone
        )
        paths = [str(directory.resolve()) for directory in directories]
        request = json.dumps({"key": seal.key.hex(), "directories": paths})
        assert self._process.stdin is not None
        with suppress(OSError):
            self._process.stdin.write(request.encode() + b"\n")
            self._process.stdin.flush()

    def close(self, *, is_all_open: bool = False) -> None:
        """End the keeper; it decrypts sealed files, unless the run has decrypted all of them."""
        assert self._process.stdin is not None
        with suppress(OSError):
            if is_all_open:
                self._process.stdin.write(ALL_OPEN)
            self._process.stdin.close()
        try:
            self._process.wait(LOCK_TIMEOUT)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()


def deny_access_to_memory() -> None:
    """Prevent the user's other processes from reading the memory and open files of this process.

    This process no longer dumps core. Programs that it starts are not affected.
    """
    with suppress(OSError, AttributeError):
        ctypes.CDLL(None, use_errno=True).prctl(PR_SET_DUMPABLE, 0, 0, 0, 0)


def run_keeper() -> None:
    """Run the keeper: wait until the run has ended, then decrypt the sealed files."""
    deny_access_to_memory()
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_IGN)
    request = json.loads(sys.stdin.buffer.readline())
    if sys.stdin.buffer.read() == ALL_OPEN:
        return
    seal = Seal(bytes.fromhex(request["key"]))
    for name in request["directories"]:
        with suppress(OSError), _lock_directory(Path(name)):
            seal.open_all(Path(name))


@contextmanager
def _lock_directory(directory: Path) -> Iterator[None]:
    """Hold the lock of a result directory; wait for a run that holds it to end."""
    handle = os.open(directory, os.O_RDONLY)
    end = time.monotonic() + LOCK_TIMEOUT
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
    mixed_number = int.from_bytes(data, "little") ^ int.from_bytes(stream, "little")
    return mixed_number.to_bytes(len(data), "little")


if __name__ == "__main__":
    run_keeper()
