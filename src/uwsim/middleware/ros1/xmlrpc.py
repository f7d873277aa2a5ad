"""XML-RPC as ROS 1 uses it: servers and calls with limits of size, number and time.

Every method in ROS returns ``[code, text, value]``: code 1 is success, 0 failure, -1 an error of
the caller.
"""

from __future__ import annotations

import http.client
import io
import socket
import threading
import time
import xmlrpc.client
from collections.abc import Callable, Iterable, Mapping
from socketserver import ThreadingMixIn
from typing import Any
from xmlrpc.server import SimpleXMLRPCRequestHandler, SimpleXMLRPCServer

from ..log import Log
from .deadline import DeadlineReader, time_left
from .origins import find_browser_sign, local_names
from .tcpros import PeerError
from .turns import Turns

MAX_REQUEST = 2**20
"""The maximum length of a request [bytes]."""
MAX_ANSWER, MAX_NODE_ANSWER = 2**23, 2**16
"""The maximum length of an answer of a master, and of a node [bytes]."""
MAX_AT_ONCE = 64
"""The maximum number of simultaneous requests of a server; others are closed."""
READ_TIMEOUT = 15.0
"""The time limit for a client to send its whole request [s]."""
CALL_TIMEOUT = 5.0
"""The time limit for a whole call [s]."""
Answer = list[Any]
"""The answer of a method: code, text and value."""
Methods = Mapping[str, Callable[..., Answer]]
"""The methods of a server, by name."""


class RequestHandler(SimpleXMLRPCRequestHandler):
    """A handler of requests with limits of length and time; requests of browsers are refused."""

    rpc_paths = ()  # accept any path, as the servers of ROS do
    timeout = READ_TIMEOUT
    disable_nagle_algorithm = True

    def setup(self) -> None:
        """Read from the connection until a deadline."""
        super().setup()
        self.rfile.close()
        self.rfile = io.BufferedReader(DeadlineReader(self.connection, READ_TIMEOUT))

    def do_POST(self) -> None:  # noqa: N802 - the name is http.server's
        """Answer a request, unless it is too long or comes from a page in a browser."""
        server = self.server
        assert isinstance(server, XmlRpcServer)
        if (refusal := server.find_refusal(_lower_case_names(self.headers.items()))) is not None:
            self.send_error(403, refusal)
            self.close_connection = True
            return
        length = self.headers.get("content-length", "")
        if not length.isdecimal() or int(length) > MAX_REQUEST:
            self.send_error(413)
            self.close_connection = True
            return
        if self.headers.get("content-encoding", "identity").lower() != "identity":
            self.send_error(415)  # clients of ROS do not compress, and little data may expand a lot
            self.close_connection = True
            return
        super().do_POST()

    def send_error(self, code: int, message: str | None = None, explain: str | None = None) -> None:
        """Refuse a request in its turn: a flood of refusals must not stop the simulation."""
        assert isinstance(self.server, XmlRpcServer)
        with self.server.turns.turn(0):
            super().send_error(code, message, explain)

    def log_message(self, format: str, *args: object) -> None:
        """Print nothing: errors in a request are made by the peer."""


class XmlRpcServer(ThreadingMixIn, SimpleXMLRPCServer):
    """A server of methods in threads of its own, until `close`.

    Args:
        host: the address to listen on.
        port: the port; 0 selects a free one.
        methods: the methods by name.
        log: the log for errors.
        name: the name of the server in the log.

    Raises:
        OSError: the port is in use.
    """

    daemon_threads = True
    allow_reuse_address = True
    request_queue_size = 128

    def __init__(self, host: str, port: int, methods: Methods, log: Log, name: str) -> None:
        super().__init__((host, port), RequestHandler, logRequests=False, allow_none=True)
        self._log, self._name = log, name
        self._hosts = local_names(host)
        self._free_slots = threading.BoundedSemaphore(MAX_AT_ONCE)
        self.turns = Turns()
        """The turns of the requests."""
        for method_name, method in methods.items():
            self.register_function(method, method_name)
        self.register_multicall_functions()  # rospy unregisters by a multicall
        self._thread = threading.Thread(target=self.serve_forever, args=(0.1,), daemon=True)
        self._thread.start()

    def _marshaled_dispatch(self, data: Any, *arguments: Any) -> str:
        """Parse a request, and call its method, in its turn."""
        with self.turns.turn(len(data)):
            return super()._marshaled_dispatch(data, *arguments)

    def _dispatch(self, method: str, params: Any) -> Any:
        """Call a method; the fault for an unknown one has no details of this program."""
        if method not in self.funcs:
            raise xmlrpc.client.Fault(1, f"method {method[:100]!r} is not supported")
        return super()._dispatch(method, params)

    def find_refusal(self, headers: Mapping[str, str]) -> str | None:
        """Return the text with which a request is refused for its headers; None if it is not."""
        if (reason := find_browser_sign(headers, self._hosts)) is not None:
            text = f"{self._name}: a request is refused: {reason}"
            self._log.report(text, kind=f"{self._name} page")
        return None if reason is None else "not for pages in browsers"

    @property
    def port(self) -> int:
        """The port on which the server listens."""
        return int(self.server_address[1])

    def process_request(self, request: Any, client_address: Any) -> None:
        """Handle a request in a thread, if not too many are being handled."""
        if not self._free_slots.acquire(blocking=False):
            text = f"more than {MAX_AT_ONCE} requests at once; one is refused"
            self._log.report(f"{self._name}: {text}")
            self.shutdown_request(request)
            return
        super().process_request(request, client_address)

    def process_request_thread(self, request: Any, client_address: Any) -> None:
        """Handle one request."""
        try:
            super().process_request_thread(request, client_address)
        finally:
            self._free_slots.release()

    def handle_error(self, request: Any, client_address: Any) -> None:
        """Report a request whose connection broke."""
        self._log.report(f"{self._name}: the connection of a request was lost")

    def close(self) -> None:
        """Stop listening."""
        self.shutdown()
        self.server_close()
        self._thread.join(timeout=10.0)


def _lower_case_names(headers: Iterable[tuple[str, str]]) -> dict[str, str]:
    return {name.lower(): value for name, value in headers}


class _Response(http.client.HTTPResponse):
    """A response that must arrive within the timeout of its connection."""

    def __init__(self, sock: socket.socket, *arguments: Any, **options: Any) -> None:
        super().__init__(sock, *arguments, **options)
        self.fp.close()
        self.fp = io.BufferedReader(DeadlineReader(sock, sock.gettimeout() or 0.0))


class _Connection(http.client.HTTPConnection):
    """A connection for a limited time."""

    response_class = _Response

    def __init__(self, host: str, end: float) -> None:
        super().__init__(host, timeout=time_left(end))
        self._end = end

    def send(self, data: Any) -> None:
        """Send a part of the request."""
        if self.sock is not None:
            self.sock.settimeout(time_left(self._end))
        super().send(data)

    def getresponse(self) -> http.client.HTTPResponse:
        """Read the headers of the response."""
        self.sock.settimeout(time_left(self._end))
        return super().getresponse()


class _Transport(xmlrpc.client.Transport):
    """A transport with limits of time and length, without compression.

    Args:
        timeout: the time limit for all calls together [s].
        max_length: the maximum length of a response [bytes].
    """

    accept_gzip_encoding = False

    def __init__(self, timeout: float, max_length: int) -> None:
        super().__init__()
        self._end, self._max_length = time.monotonic() + timeout, max_length

    def make_connection(self, host: Any) -> http.client.HTTPConnection:
        """Make a connection with a time limit, which `close` closes."""
        connection = _Connection(self.get_host_info(host)[0], self._end)
        self._connection = host, connection
        return connection

    def parse_response(self, response: http.client.HTTPResponse) -> Any:
        """Parse a response of limited length."""
        parser, unmarshaller = self.getparser()
        data = response.read(self._max_length + 1)
        response.close()
        if len(data) > self._max_length:
            raise ValueError("the response is too long")
        parser.feed(data)
        parser.close()
        return unmarshaller.close()


def call(
    uri: str,
    method: str,
    *arguments: Any,
    timeout: float = CALL_TIMEOUT,
    max_length: int = MAX_ANSWER,
) -> Any:
    """Call a method of a master or a node, and return the value of its answer.

    Args:
        uri: the address of the master or the node.
        method: the name of the method.
        arguments: the arguments of the method.
        timeout: the time limit for the whole call, except looking up the host's address [s].
        max_length: the maximum length of an answer [bytes].

    Raises:
        RefusedCall: the code of the answer is not 1.
        PeerError: there is no answer, or it does not have the form of ROS.
    """
    try:
        transport = _Transport(timeout, max_length)
        with xmlrpc.client.ServerProxy(uri, transport, allow_none=True) as proxy:
            answer = getattr(proxy, method)(*arguments)
    except OSError as error:
        raise PeerError(f"{uri} does not answer: {error.strerror or error}") from error
    except Exception as error:  # the parser may raise exceptions that it does not document
        raise PeerError(f"{uri} does not answer as ROS: {type(error).__name__}") from error
    match answer:
        case [1, _, value]:
            return value
        case [int(), str(text), _]:
            raise RefusedCall(f"{uri} refuses {method}: {text[:300]}")
        case _:
            raise PeerError(f"{uri} does not answer as ROS")


class RefusedCall(PeerError):
    """An answer of a peer with the code of an error or a failure."""
