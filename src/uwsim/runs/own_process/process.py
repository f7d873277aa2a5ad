"""An algorithm in a process of its own, as the simulation sees it: an `Algorithm` like any other.

Its node is that of the simulation's process (`uwsim.simulation.InProcessNode`). Each callback is a
frame to the process and waits for the answer; what the algorithm asks of its node meanwhile is done
in the order in which it asks. So everything happens in the same order as in one process, and
simulation time does not move: the rows are the same.
"""

from __future__ import annotations

import math
import os
import select
import signal
import socket
import struct
import subprocess
import sys
import time
from collections.abc import Callable, Mapping, Sequence
from multiprocessing.connection import Connection
from types import TracebackType
from typing import Any, Self

from ...base.environment import remove_secrets
from ...base.exceptions import RemoteError
from ...base.interrupts import block_interrupts
from ...base.tracked_parameters import untracked_parameters
from ...benchmark.plugin import Plugin
from ...bus import Node
from ...errors import BadSetting, RunFailed, UwsimError
from ...simulation import Stopped
from .codec import MAX_FRAME, FrameError, decode, encode

PROCESS_ENDED = "its process ended"
"""How the reason begins of an algorithm whose process is gone."""
TOO_LONG = "a callback took longer than --callback-limit"
"""The reason of a row whose algorithm did not come back."""
GLANCE = 1.0
"""The longest time between two looks at the clock [s]."""
PATIENCE = 10.0
"""How long a process that has closed its socket may take to end [s of wall time]."""
LONGEST = 1e9
"""The longest limit that a socket is given; a longer one is none [s]."""
MODULE = "uwsim.runs.own_process.child"


class OwnProcess:
    """A process that waits for the class of an algorithm; a context manager, which ends it.

    Args:
        limit: how long it may compute for one request [s of wall time]; None: for ever.
    """

    def __init__(self, limit: float | None = None) -> None:
        ours, theirs = socket.socketpair()
        with theirs, block_interrupts():
            self._process = subprocess.Popen(
                [sys.executable, "-m", MODULE, str(theirs.fileno()), str(os.getpid())],
                pass_fds=(theirs.fileno(),),
                stdin=subprocess.DEVNULL,
                env={
                    **remove_secrets(os.environ),
                    "PYTHONPATH": os.pathsep.join(filter(None, sys.path)),
                },
            )
        if limit is not None:
            # no single read or write of a frame takes longer: seconds and microseconds
            longest = min(limit, LONGEST)
            most = struct.pack("ll", int(longest), int(longest % 1.0 * 1e6) or 1)
            ours.setsockopt(socket.SOL_SOCKET, socket.SO_RCVTIMEO, most)
            ours.setsockopt(socket.SOL_SOCKET, socket.SO_SNDTIMEO, most)
        self._pipe = Connection(ours.detach())
        self._limit = limit
        self._ready = select.poll()
        self._ready.register(self._pipe.fileno(), select.POLLIN)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._pipe.close()
        self._process.kill()
        self._process.wait()

    @property
    def pid(self) -> int:
        """Number of the process."""
        return self._process.pid

    def request(self, frame: list[object], answer: Callable[[list[Any]], object]) -> Any:
        """Send a frame and return the value of its answer.

        Args:
            frame: what is asked of the process.
            answer: does what the algorithm asks for meanwhile, and returns the result; publishes
                first what has come with the frame that asks.

        Raises:
            RemoteError: the algorithm raised, or broke a rule.
            BadSetting: it refused a parameter in its start.
            Stopped: its process has ended, sent what is no frame, or took too long.
        """
        self._send(frame)
        waited = 0.0
        while True:
            waited = self._wait(waited)
            kind, published, *rest = self._receive()
            if kind == "ask":
                self._send(_answered(answer, published, rest))
                continue
            if refused := _refused(answer, published):
                raise RemoteError(f"{refused[1]}: {refused[2]}")
            if kind == "done" and len(rest) == 2:
                value, broken = rest
                if broken is not None:
                    raise RemoteError(f"NotAllowed: {broken}")
                return value
            if kind == "raised" and len(rest) == 3:
                raise _raised(str(frame[0]), *map(str, rest))
            raise Stopped("its process sent a frame that nobody understands")

    def _wait(self, waited: float) -> float:
        """Wait for a frame, which comes ``waited`` after the request; returns when it came [s].

        Raises:
            Stopped: it did not come within the limit, or its process has ended.
        """
        limit = math.inf if self._limit is None else self._limit
        glance = min(GLANCE, limit / 4)
        while waited <= limit:
            began = time.monotonic()
            if self._ready.poll(max(1.0, 1000.0 * glance)):
                return waited + time.monotonic() - began
            if self._process.poll() is not None and not self._ready.poll(0):
                raise self._ended()  # though a child of it may hold the socket
            # of a time in which this process itself was stopped only so much counts
            waited += min(time.monotonic() - began, 2 * glance)
        self._process.kill()
        raise Stopped(TOO_LONG)

    def _send(self, frame: list[object]) -> None:
        try:
            self._pipe.send_bytes(encode(frame))
        except OSError:
            raise self._ended() from None

    def _receive(self) -> list[Any]:
        try:
            frame: object = decode(self._pipe.recv_bytes(MAX_FRAME))
        except FrameError as error:
            raise Stopped(f"its process sent bytes that are no frame: {error}") from None
        except BlockingIOError:  # half a frame
            self._process.kill()
            raise Stopped(TOO_LONG) from None
        except (EOFError, OSError):
            raise self._ended() from None
        match frame:
            case [str(), list(), *_] if isinstance(frame, list):
                return frame
        raise Stopped("its process sent a frame that nobody understands")

    def _ended(self) -> Stopped:
        try:
            status = self._process.wait(PATIENCE)
        except subprocess.TimeoutExpired:
            self._process.kill()
            status = self._process.wait()
        return Stopped(f"{PROCESS_ENDED} ({how(status)})")


class ProcessAlgorithm:
    """The algorithm that runs in the process.

    Args:
        process: waits for a class.
        algorithm: the class; its module can be imported there, too, or is that of a plugin.
        plugins: what was read with ``--plugin``.
        given: the parameters set by the user.
        may_refuse: whether a reader of a topic refuses some of its messages; the algorithm then
            waits at each.

    Raises:
        RemoteError: the algorithm cannot be made.
    """

    def __init__(
        self,
        process: OwnProcess,
        algorithm: type,
        plugins: Sequence[Plugin] = (),
        given: Mapping[str, float | str] | None = None,
        may_refuse: Callable[[str], bool] = lambda topic: True,
    ) -> None:
        self._process, self._given, self._may_refuse = process, dict(given or {}), may_refuse
        self._node: Node | None = None
        self._publish: list[Callable[[Any], None]] = []
        sources = [[plugin.module_name, plugin.path, plugin.source] for plugin in plugins]
        self._request("make", sys.path, sources, algorithm.__module__, algorithm.__qualname__)

    @property
    def parameters(self) -> Mapping[str, float | int | str]:
        """The parameters that the algorithm reports; those given if it reports none."""
        reported: Mapping[str, float | int | str] = self._request("parameters", self._given)
        return reported

    @property
    def asked(self) -> list[str]:
        """Names of the parameters that it has read."""
        return list(map(str, self._request("asked")))

    def start(self, node: Node) -> None:
        """Start it there."""
        self._node = node
        bits = node.rng.bit_generator
        rng_state = [type(bits).__name__, dict(bits.state)]
        self._request("start", node.now, untracked_parameters(node.parameters), rng_state)

    def _request(self, *frame: object) -> Any:
        return self._process.request(list(frame), self._do)

    def _calling(self, number: int) -> Callable[..., Any]:
        """Return what calls callback ``number`` over there."""
        node = self._required

        def call(*arguments: object) -> object:
            return self._request("call", number, node.now, *arguments)

        return call

    @property
    def _required(self) -> Node:
        if self._node is None:
            raise RunFailed("the node is used before start(node)")
        return self._node

    def _do(self, asked: list[Any]) -> object:
        """Do what the algorithm asks of its node."""
        node = self._required
        match asked:
            case ["subscribe", str(topic), type() as cls, int(number)]:
                node.subscribe(topic, cls, self._calling(number))
            case ["publisher", str(topic), type() as cls]:
                self._publish.append(node.publisher(topic, cls))
                return len(self._publish) - 1, self._may_refuse(topic)
            case ["publish", bytes() as frame]:
                self._take(decode(frame))
            case ["take"]:
                pass  # what was published has been taken
            case ["serve", str(name), type() as cls, int(number)]:
                node.serve(name, cls, self._calling(number))
            case ["call", str(name), request]:
                return node.call(name, request)
            case ["create_timer", period, int(number)]:
                node.create_timer(period, self._calling(number))
            case _:
                raise TypeError(f"{asked[0] if asked else ''}: wrong arguments")
        return None

    def _take(self, published: Any) -> None:
        match published:
            case [int(number), message] if 0 <= number < len(self._publish):
                self._publish[number](message)
            case _:
                raise TypeError("publish: wrong arguments")


def _answered(
    answer: Callable[[list[Any]], object], published: list[Any], asked: list[Any]
) -> list[object]:
    """Return the frame with the result of what the algorithm asked for, or with its error."""
    if refusal := _refused(answer, published):
        return refusal
    try:
        return ["given", answer(asked)]
    except Stopped:
        raise
    except Exception as error:
        return _refusal(error)


def _refused(answer: Callable[[list[Any]], object], published: list[Any]) -> list[object]:
    """Publish; return the frame of a refusal, or an empty one if all was taken."""
    try:
        for frame in published:
            answer(["publish", frame])
    except Stopped:
        raise
    except Exception as error:
        return _refusal(error)
    return []


def _refusal(error: Exception) -> list[object]:
    about = vars(error) if isinstance(error, UwsimError) else {}
    return ["refused", type(error).__name__, str(error), dict(about)]


def _raised(request: str, kind: str, message: str, text: str) -> Exception:
    """Return what the algorithm raised, as the simulation's process would have it."""
    if request == "start" and kind == "BadSetting":
        return BadSetting(message)
    return RemoteError(text)


def how(exit_code: int | None) -> str:
    """Describe how a process ended."""
    if exit_code is not None and exit_code < 0:
        return f"killed by {signal.Signals(-exit_code).name}"
    return f"with exit status {exit_code}"
