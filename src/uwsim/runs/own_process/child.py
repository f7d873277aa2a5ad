"""The process of an algorithm: ``python -m uwsim.runs.own_process.child FD PARENT_PID``.

It receives frames through one socket, answers each, and has no other access to the simulation.

.. code-block:: text

    from the simulation                 answer, when the algorithm has returned
      describe  path, file, name, parameters
      make  path, plugins, class          done  published, value, violated rule
      start now, parameters, rng_state    raised  published, kind, message, text
      call  callback, now, message
      parameters  defaults
      names_read                          (names of parameters that the algorithm has read)
      accepted / refused                  (the reply to a request of the algorithm)

During a call the algorithm may request the functions of its node (`ask`), so the frames nest as
function calls do. A message that the simulation is certain to accept needs no answer of its own: it
is sent with the next frame of any kind (``published``: a list of frames, each with the index of a
publisher and a message). The request ``flush`` sends the published messages at once.
"""

from __future__ import annotations

import builtins
import importlib
import os
import sys
import threading
import time
from collections.abc import Callable, Mapping
from multiprocessing.connection import Connection
from typing import Any, NoReturn, TypeVar

import numpy as np

from ... import errors
from ...base.deprecation import deprecated_name
from ...base.exceptions import describe_exception
from ...base.files.source_module import source_module
from ...base.message_fields import find_invalid_field
from ...base.terminal import suppress_cast_warnings
from ...base.tracked_parameters import TrackedParameters, untracked_parameters
from ...bus import Bus
from ...errors import BadSetting, NotAllowed, UwsimError
from .codec import MAX_FRAME, UnknownValue, decode, encode, message_class

M = TypeVar("M")
PARENT_CHECK_PERIOD = 0.5
"""The period at which this process checks that its parent exists [s]."""
MAX_PUBLISHED = 100
"""The number of waiting messages at which they are sent without waiting for the next frame."""
MAX_PUBLISHED_BYTES = 2**20
"""The total size of waiting messages at which they are sent without waiting [bytes]."""


class ChildNode:
    """The node of an algorithm in this process; it forwards every request to the simulation.

    Args:
        ask: sends a request to the simulation and returns the result.
    """

    def __init__(self, ask: Callable[..., Any]) -> None:
        self._ask = ask
        self._message_frames: list[bytes] = []
        self._n_bytes = 0
        self._types = Bus()  # checks the classes of messages before they are encoded
        self._thread = threading.get_ident()
        self.callbacks: list[Callable[..., object]] = []
        """The algorithm's callbacks, by the index with which the simulation calls them."""
        self.violation: str | None = None
        """The rule that a thread of the algorithm has violated."""
        self.now = 0.0
        """The simulation time [s]."""
        self.parameters = TrackedParameters({})
        """The parameters of the algorithm that the user set."""
        self.rng = np.random.default_rng(0)
        """The algorithm's own random stream."""

    def subscribe(self, topic: str, type: type[M], callback: Callable[[M], None]) -> None:
        """Call ``callback`` with every message on ``topic``."""
        self._request(
            "subscribe", topic, _check_message_class(type), self._register_callback(callback)
        )

    def publisher(self, topic: str, type: type[M]) -> Callable[[M], None]:
        """Return ``publish(message)`` for ``topic``."""
        publisher_index, may_refuse = self._request("publisher", topic, _check_message_class(type))
        check = self._types.publisher(topic, type)

        def publish(message: M) -> None:
            check(message)
            self._check_thread()
            frame = encode([publisher_index, message])
            self._message_frames.append(frame)
            self._n_bytes += len(frame)
            is_full = (
                len(self._message_frames) >= MAX_PUBLISHED or self._n_bytes >= MAX_PUBLISHED_BYTES
            )
            if is_full or may_refuse or find_invalid_field(message, converts=False):
                self._request("flush")

        return publish

    def serve(self, name: str, type: type[M], handler: Callable[[M], object]) -> None:
        """Advertise a service; ``type`` is the class of its request."""
        self._request("serve", name, _check_message_class(type), self._register_callback(handler))

    def call(self, name: str, request: object) -> object:
        """Call a service; raise UnknownName if no node advertises it."""
        return self._request("call", name, request)

    def create_timer(self, period_s: float, callback: Callable[[], None]) -> None:
        """Call ``callback`` every ``period_s`` of simulation time, from now on."""
        self._request("create_timer", period_s, self._register_callback(callback))

    @property
    @deprecated_name("rng")
    def random(self) -> np.random.Generator:
        """The old name of `rng`."""
        return self.rng

    @deprecated_name("create_timer")
    def every(self, period_s: float, callback: Callable[[], None]) -> None:
        """Call `create_timer`; this is its deprecated name."""
        self.create_timer(period_s, callback)

    def take_published(self) -> list[bytes]:
        """Return the messages published since the last call, as frames."""
        frames, self._message_frames, self._n_bytes = self._message_frames, [], 0
        return frames

    def _register_callback(self, callback: Callable[..., object]) -> int:
        self.callbacks.append(callback)
        return len(self.callbacks) - 1

    def _request(self, method: str, *arguments: object) -> Any:
        self._check_thread()
        return self._ask(method, *arguments)

    def _check_thread(self) -> None:
        if threading.get_ident() != self._thread:
            self.violation = self.violation or "it uses its node from a thread of its own"
            raise NotAllowed(self.violation)


class Child:
    """The server of the frames that the simulation sends.

    Args:
        pipe: the connection to the simulation.
    """

    def __init__(self, pipe: Connection) -> None:
        self._pipe = pipe
        self._node = ChildNode(self._ask)
        self._algorithm: Any = None
        self._class: type = object

    def serve(self) -> None:
        """Answer every frame until the simulation has ended."""
        while True:
            self._run(*self._receive())

    def _run(self, kind: str, *arguments: Any) -> None:
        try:
            value = getattr(self, f"_{kind}")(*arguments)
            frame = encode(["done", self._node.take_published(), value, self._node.violation])
        except BaseException as error:
            message = str(error) if isinstance(error, UwsimError) else ""
            trace = error.__traceback__
            error.__traceback__ = trace and trace.tb_next  # the first is that of this function
            text = describe_exception(error, self._class)
            description = (type(error).__name__, message, text)
            frame = encode(["raised", self._node.take_published(), *description])
        self._send(frame)

    def _describe(
        self, path: list[str], source: list[Any], name: str, parameters: dict[str, Any]
    ) -> object:
        """Import a class, and return what a run needs to know of it."""
        from .describe_class import describe

        sys.path[:] = path
        return describe(source, name, parameters)

    def _make(self, path: list[str], sources: list[list[Any]], module: str, name: str) -> None:
        """Import the class as the simulation did, and construct the algorithm."""
        sys.path[:] = path
        for module_name, file, source in sources:
            source_module(module_name, file, source)
        cls: Any = sys.modules.get(module) or importlib.import_module(module)
        for part in name.split("."):
            cls = getattr(cls, part)
        self._class = cls
        if not hasattr(cls, "start"):
            from ...algorithms.policy import make_algorithm_of

            self._algorithm = make_algorithm_of(cls)
        else:
            self._algorithm = cls()

    def _start(self, now: float, parameters: dict[str, Any], rng_state: list[Any]) -> None:
        name, state = rng_state
        bit_generator = getattr(np.random, name)()
        bit_generator.state = state
        self._node.rng = np.random.Generator(bit_generator)
        self._node.now, self._node.parameters = now, TrackedParameters(parameters)
        self._algorithm.start(self._node)

    def _call(self, callback_index: int, now: float, *arguments: Any) -> object:
        self._node.now = now
        return self._node.callbacks[callback_index](*arguments)

    def _parameters(self, defaults: dict[str, Any]) -> object:
        parameters: object = untracked_parameters(getattr(self._algorithm, "parameters", defaults))
        return dict(parameters) if isinstance(parameters, Mapping) else parameters

    def _names_read(self) -> list[str]:
        return list(self._node.parameters.names_read)

    def _ask(self, method: str, *arguments: object) -> Any:
        """Send a request to the simulation, and execute calls that arrive before its reply."""
        self._send(encode(["ask", self._node.take_published(), method, *arguments]))
        while True:
            kind, *rest = self._receive()
            if kind == "accepted":
                return rest[0]
            if kind == "refused":
                _raise(*rest)
            self._run(kind, *rest)

    def _send(self, frame: bytes) -> None:
        try:
            self._pipe.send_bytes(frame)
        except OSError:
            os._exit(1)  # the simulation has ended

    def _receive(self) -> list[Any]:
        try:
            frame: list[Any] = decode(self._pipe.recv_bytes(MAX_FRAME))
        except (EOFError, OSError):
            _leave()
        return frame


def _check_message_class(cls: type) -> type:
    """Return the class of a message; raise BadSetting if the simulation cannot decode it."""
    name = f"{cls.__module__}:{cls.__qualname__}" if isinstance(cls, type) else ""
    if message_class(name) is not cls:
        raise BadSetting(
            f"{cls!r} is not a message class that the algorithm's process can exchange."
        )
    return cls


def _raise(kind: str, message: str, attributes: dict[str, Any]) -> NoReturn:
    cls = getattr(errors, kind, None) or getattr(builtins, kind, None)
    if not (isinstance(cls, type) and issubclass(cls, Exception)):
        raise RuntimeError(f"{kind}: {message}")
    error = cls.__new__(cls)
    error.args = (message,)
    for name, value in attributes.items():
        if not isinstance(value, UnknownValue):
            setattr(error, name, value)
    raise error


def _leave() -> NoReturn:
    """End this process: its parent does not wait for it any more."""
    sys.stdout.flush()
    os._exit(0)


def main(descriptor: int, parent_pid: int) -> None:
    """Serve the simulation at the other end of a socket, and end with it.

    Args:
        descriptor: the file descriptor of the socket.
        parent_pid: the process ID of the simulation.
    """
    suppress_cast_warnings()
    os.set_inheritable(descriptor, False)  # not for processes that the algorithm starts
    threading.Thread(target=_exit_with, args=(parent_pid,), daemon=True).start()
    Child(Connection(descriptor)).serve()


def _exit_with(parent_pid: int) -> None:
    """End this process when its parent has ended, even during an endless callback."""
    while os.getppid() == parent_pid:
        time.sleep(PARENT_CHECK_PERIOD)
    os._exit(1)


if __name__ == "__main__":
    main(int(sys.argv[1]), int(sys.argv[2]))
