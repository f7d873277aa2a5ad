"""Two hosts on one computer: network namespaces with a cable between them."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from typing import Any

import pytest

ADDRESSES = ("10.231.7.1", "10.231.7.2")


class Host:
    """A namespace with an address.

    Args:
        name: of the namespace.
        address: that it has.
    """

    def __init__(self, name: str, address: str) -> None:
        self.name, self.address = name, address
        self._programs: list[subprocess.Popen[str]] = []

    def start(self, *words: str, **options: Any) -> subprocess.Popen[str]:
        """Start a program there."""
        program = subprocess.Popen(
            ["ip", "netns", "exec", self.name, *words],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            **options,
        )
        self._programs.append(program)
        return program

    def close(self) -> None:
        """End its programs."""
        for program in self._programs:
            program.kill()
            program.communicate()


def _ip(*words: str) -> None:
    completed_process = subprocess.run(["ip", *words], capture_output=True, text=True)
    if completed_process.returncode:
        raise OSError(f"ip {' '.join(words)}: {completed_process.stderr.strip()}")


@contextmanager
def two_hosts() -> Iterator[tuple[Host, Host]]:
    """Give two hosts that reach each other; skips the test where that is not permitted."""
    names = [f"uwsim-{os.getpid()}-{side}" for side in "ab"]
    cables = [f"uw{os.getpid()}{side}" for side in "ab"]
    with ExitStack() as stack:
        try:
            for name in names:
                _ip("netns", "add", name)
                stack.callback(_ip, "netns", "del", name)
            _ip("link", "add", cables[0], "type", "veth", "peer", "name", cables[1])
            for name, cable, address in zip(names, cables, ADDRESSES, strict=True):
                _ip("link", "set", cable, "netns", name)
                _ip("-n", name, "addr", "add", f"{address}/24", "dev", cable)
                _ip("-n", name, "link", "set", cable, "up")
                _ip("-n", name, "link", "set", "lo", "up")
        except OSError as error:
            pytest.skip(f"network namespaces cannot be made: {error}")
        hosts = Host(names[0], ADDRESSES[0]), Host(names[1], ADDRESSES[1])
        for host in hosts:
            stack.callback(host.close)
        yield hosts
