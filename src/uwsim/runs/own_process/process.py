"""An algorithm in a process of its own, which the simulation uses like any other `Algorithm`.

The node of the algorithm is in the simulation's process (`uwsim.simulation.InProcessNode`). To call
a callback, the simulation sends a frame to the algorithm's process and waits for the answer;
meanwhile it executes the algorithm's requests to the node, in order. Therefore the order of events
and the rows are the same as with one process, and no simulation time passes during a call.
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
from pathlib import Path
from types import TracebackType
from typing import Any, Self

from ...base.environment import remove_secrets
from ...base.exceptions import RemoteError
from ...base.interrupts import block_interrupts
from ...base.tracked_parameters import untracked_parameters
from ...benchmark.plugin import Plugin
from ...bus import Node
from ...errors import BadSetting, RunFailed, UwsimError
from ...simulation import CallStopped
from .codec import MAX_FRAME, FrameError, decode, encode
from .facts import AlgorithmFacts, facts_of, search_path

PROCESS_ENDED = "its process ended"
"""The beginning of the reason in the row of a level in which the algorithm's process ended."""
CALL_TIMEOUT = "a callback took longer than --callback-limit"
"""The reason in the row of a level in which the algorithm did not return from a call."""
CLOCK_PERIOD = 1.0
"""The longest time between two checks of the clock [s of wall time]."""
END_TIMEOUT = 10.0
"""The time in which a process that has closed its socket must end [s of wall time]."""
MAX_SOCKET_TIMEOUT = 1e9
"""The longest timeout that is set on a socket [s of wall time]."""
CHILD_MODULE = "uwsim.runs.own_process.child"
"""The module that the algorithm's process executes."""


class OwnProcess:
    """A child process that runs an algorithm; a context manager, which kills it at the end.

    Args:
        limit: the longest wait for the answer to one request [s of wall time]; None: no limit.
        folder: the working directory of the process; None for that of this process.
    """

    def __init__(self, limit: float | None = None, folder: Path | None = None) -> None:
        own_socket, child_socket = socket.socketpair()
        with child_socket, block_interrupts():
            self._process = subprocess.Popen(
                [sys.executable, "-m", CHILD_MODULE, str(child_socket.fileno()), str(os.getpid())],
                pass_fds=(child_socket.fileno(),),
                stdin=subprocess.DEVNULL,
                cwd=folder,
                env={
                    **remove_secrets(os.environ),
                    "PYTHONPATH": os.pathsep.join(filter(None, sys.path)),
                },
            )
        if limit is not None:
            # the limit of a single read or write of a frame, in seconds and microseconds
            timeout = min(limit, MAX_SOCKET_TIMEOUT)
            timeval = struct.pack("ll", int(timeout), int(timeout % 1.0 * 1e6) or 1)
            own_socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVTIMEO, timeval)
            own_socket.setsockopt(socket.SOL_SOCKET, socket.SO_SNDTIMEO, timeval)
        self._pipe = Connection(own_socket.detach())
        self._limit = limit
        self._poll = select.poll()
        self._poll.register(self._pipe.fileno(), select.POLLIN)

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
        """The process ID."""
        return self._process.pid

    def request(self, frame: list[object], answer: Callable[[list[Any]], object]) -> Any:
        """Send a frame and return the value of its answer; `child` lists the kinds of frames.

        Args:
            frame: the request to the process.
            answer: the function that executes a request of the algorithm and returns its result;
                it first receives the messages that arrive with the request, to publish them.

        Raises:
            RemoteError: the algorithm raised an exception, or violated a rule.
            BadSetting: the algorithm rejected a parameter in its ``start``.
            CallStopped: the process has ended, sent bytes that are no frame, or took too long.
        """
        self._send(frame)
        wait_time = 0.0
        while True:
            wait_time = self._wait(wait_time)
            kind, message_frames, *rest = self._receive()
            if kind == "ask":
                self._send(_answer_request(answer, message_frames, rest))
                continue
            if refusal := _publish_frames(answer, message_frames):
                raise RemoteError(f"{refusal[1]}: {refusal[2]}")
            if kind == "done" and len(rest) == 2:
                value, violation = rest
                if violation is not None:
                    raise RemoteError(f"NotAllowed: {violation}")
                return value
            if kind == "raised" and len(rest) == 3:
                raise _algorithm_error(str(frame[0]), *map(str, rest))
            raise CallStopped("its process sent a frame that nobody understands")

    def _wait(self, wait_time: float) -> float:
        """Wait for a frame from the child process.

        Args:
            wait_time: the time already waited since the request, without suspensions of this
                process [s of wall time].

        Returns:
            The time waited since the request, without suspensions [s of wall time].

        Raises:
            CallStopped: no frame arrived within the limit, or the process has ended.
        """
        limit = math.inf if self._limit is None else self._limit
        period = min(CLOCK_PERIOD, limit / 4)
        while wait_time <= limit:
            start = time.monotonic()
            has_frame = bool(self._poll.poll(max(1.0, 1000.0 * period)))
            # the time for which this process itself was suspended does not count
            wait_time += min(time.monotonic() - start, 2 * period)
            if has_frame:
                return wait_time
            if self._process.poll() is not None and not self._poll.poll(0):
                raise self._end_error()  # a child of the process may still hold the socket open
        self._process.kill()
        raise CallStopped(CALL_TIMEOUT)

    def _send(self, frame: list[object]) -> None:
        try:
            self._pipe.send_bytes(encode(frame))
        except BlockingIOError:  # the process did not read the frame in time
            self._process.kill()
            raise CallStopped(CALL_TIMEOUT) from None
        except OSError:
            raise self._end_error() from None

    def _receive(self) -> list[Any]:
        try:
            frame: object = decode(self._pipe.recv_bytes(MAX_FRAME))
        except FrameError as error:
            raise CallStopped(f"its process sent bytes that are no frame: {error}") from None
        except BlockingIOError:  # the rest of a frame did not arrive in time
            self._process.kill()
            raise CallStopped(CALL_TIMEOUT) from None
        except (EOFError, OSError):
            raise self._end_error() from None
        match frame:
            case [str(), list(), *_] if isinstance(frame, list):
                return frame
        raise CallStopped("its process sent a frame that nobody understands")

    def _end_error(self) -> CallStopped:
        try:
            status = self._process.wait(END_TIMEOUT)
        except subprocess.TimeoutExpired:
            self._process.kill()
            status = self._process.wait()
        return CallStopped(f"{PROCESS_ENDED} ({describe_exit(status)})")


class ProcessAlgorithm:
    """An algorithm that runs in an `OwnProcess`.

    Args:
        process: the process, which has no algorithm yet.
        algorithm: the class of the algorithm, which the process imports, or facts of it.
        plugins: the plugins to load in the process; one of them may contain the class.
        settings: the parameters set by the user.
        may_refuse: the function that returns whether a subscriber of a topic may refuse messages;
            the algorithm then waits for the answer to each message that it publishes there.
        folder: the folder of its files, in which modules are found; None without one.

    Raises:
        RemoteError: the algorithm cannot be constructed.
    """

    def __init__(
        self,
        process: OwnProcess,
        algorithm: type[Any] | AlgorithmFacts,
        plugins: Sequence[Plugin] = (),
        settings: Mapping[str, float | str] | None = None,
        may_refuse: Callable[[str], bool] = lambda topic: True,
        folder: Path | None = None,
    ) -> None:
        self._process, self._settings, self._may_refuse = process, dict(settings or {}), may_refuse
        self._node: Node | None = None
        self._publishers: list[Callable[[Any], None]] = []
        sources = [[plugin.module_name, plugin.path, plugin.source] for plugin in plugins]
        facts = facts_of(algorithm)
        self._request("make", search_path(folder), sources, facts.module, facts.qualname)

    @property
    def parameters(self) -> Mapping[str, float | int | str]:
        """The parameters that the algorithm reports, or else the parameters set by the user."""
        parameters: Mapping[str, float | int | str] = self._request("parameters", self._settings)
        return parameters

    @property
    def names_read(self) -> list[str]:
        """The names of the parameters that the algorithm has read."""
        return list(map(str, self._request("names_read")))

    def start(self, node: Node) -> None:
        """Start the algorithm in its process; its requests are executed by ``node``."""
        self._node = node
        bit_generator = node.rng.bit_generator
        rng_state = [type(bit_generator).__name__, dict(bit_generator.state)]
        self._request("start", node.now, untracked_parameters(node.parameters), rng_state)

    def _request(self, *frame: object) -> Any:
        return self._process.request(list(frame), self._execute)

    def _remote_call(self, callback_index: int) -> Callable[..., Any]:
        """Return a function that calls the callback with this index in the process."""
        node = self._attached_node

        def call(*arguments: object) -> object:
            return self._request("call", callback_index, node.now, *arguments)

        return call

    @property
    def _attached_node(self) -> Node:
        if self._node is None:
            raise RunFailed("the node is used before start(node)")
        return self._node

    def _execute(self, command: list[Any]) -> object:
        node = self._attached_node
        match command:
            case ["subscribe", str(topic), type() as cls, int(callback_index)]:
                node.subscribe(topic, cls, self._remote_call(callback_index))
            case ["publisher", str(topic), type() as cls]:
                self._publishers.append(node.publisher(topic, cls))
                return len(self._publishers) - 1, self._may_refuse(topic)
            case ["publish", bytes() as frame]:
                self._publish_frame(decode(frame))
            case ["flush"]:
                pass  # the messages that arrived with the request have been published already
            case ["serve", str(name), type() as cls, int(callback_index)]:
                node.serve(name, cls, self._remote_call(callback_index))
            case ["call", str(name), request]:
                return node.call(name, request)
            case ["create_timer", period, int(callback_index)]:
                node.create_timer(period, self._remote_call(callback_index))
            case _:
                raise TypeError(f"{command[0] if command else ''}: wrong arguments")
        return None

    def _publish_frame(self, content: Any) -> None:
        match content:
            case [int(publisher_index), message] if 0 <= publisher_index < len(self._publishers):
                self._publishers[publisher_index](message)
            case _:
                raise TypeError("publish: wrong arguments")


def _answer_request(
    answer: Callable[[list[Any]], object], message_frames: list[Any], request: list[Any]
) -> list[object]:
    """Return the frame with the result of a request of the algorithm, or with its error."""
    if refusal := _publish_frames(answer, message_frames):
        return refusal
    try:
        return ["accepted", answer(request)]
    except CallStopped:
        raise
    except Exception as error:
        return _refusal(error)


def _publish_frames(
    answer: Callable[[list[Any]], object], message_frames: list[Any]
) -> list[object]:
    """Publish messages; return the frame with the first refusal, or [] if all were accepted."""
    try:
        for frame in message_frames:
            answer(["publish", frame])
    except CallStopped:
        raise
    except Exception as error:
        return _refusal(error)
    return []


def _refusal(error: Exception) -> list[object]:
    attributes = vars(error) if isinstance(error, UwsimError) else {}
    return ["refused", type(error).__name__, str(error), dict(attributes)]


def _algorithm_error(request: str, kind: str, message: str, text: str) -> Exception:
    """Return the error of an algorithm: a `BadSetting` of its ``start``, or a `RemoteError`."""
    if request == "start" and kind == "BadSetting":
        return BadSetting(message)
    return RemoteError(text)


def describe_exit(exit_code: int | None) -> str:
    """Describe how a process ended, from its exit code; a negative code is a signal."""
    if exit_code is not None and exit_code < 0:
        return f"killed by {signal.Signals(-exit_code).name}"
    return f"with exit status {exit_code}"
