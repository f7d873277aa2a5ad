"""An HTTP server of one page for browsers on this computer."""

from __future__ import annotations

import secrets
import threading
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

from ..errors import BadSetting

LOOPBACK = "127.0.0.1"
POLL_PERIOD = 0.5
"""The period of the check whether the server is running [s]."""


class ServedPage:
    """A page that is served on the loopback interface only, at an address that cannot be guessed.

    Args:
        page: the HTML of the page.
        port: the port; 0 selects a free one.
    """

    def __init__(self, page: str, port: int) -> None:
        path, content = f"/{secrets.token_urlsafe(16)}", page.encode()

        class Handler(BaseHTTPRequestHandler):
            server_version = "uwsim"
            sys_version = ""

            def do_GET(self) -> None:
                """Answer with the page, or with 404."""
                is_page = secrets.compare_digest(
                    self.path.partition("?")[0].encode(), path.encode()
                )
                body = content if is_page else b"not found"
                self.send_response(HTTPStatus.OK if is_page else HTTPStatus.NOT_FOUND)
                self.send_header("Content-Type", "text/html; charset=utf-8")
                self.send_header("Content-Length", str(len(body)))
                self.send_header("Cache-Control", "no-store")
                self.send_header("Referrer-Policy", "no-referrer")
                self.end_headers()
                self.wfile.write(body)

            def log_message(self, format: str, *values: object) -> None:
                """Write nothing."""

        self._server = ThreadingHTTPServer((LOOPBACK, port), Handler)
        self._server.daemon_threads = True
        self.url = f"http://{LOOPBACK}:{self._server.server_port}{path}"
        """The address of the page."""
        self._thread = threading.Thread(target=self._server.serve_forever, daemon=True)
        self._thread.start()

    def wait(self) -> None:
        """Serve until Ctrl-C, or until `close` is called."""
        try:
            while self._thread.is_alive():
                self._thread.join(POLL_PERIOD)
        finally:
            self.close()

    def close(self) -> None:
        """Stop serving."""
        self._server.shutdown()
        self._server.server_close()
        self._thread.join()


def serve(page: str, *, port: int = 0) -> ServedPage:
    """Serve a page on this computer.

    Raises:
        BadSetting: the port is taken.
    """
    try:
        return ServedPage(page, port)
    except OSError as error:
        raise BadSetting(f"--port {port}: {error.strerror}.") from None
