"""Secrets of a command: from an environment variable or a file, never from the command line.

What is typed can be read by every user of the computer, and is kept in ``provenance.json``.
"""

from __future__ import annotations

import os
import stat
from functools import cache
from pathlib import Path

from ...base.environment import CLIENT_SECRET, WEB_TOKEN
from ...base.terminal import warn
from ...errors import BadSetting

NO_TEXT = "it has bytes that are no characters of UTF-8"
MAX_BYTES = 4096
"""Longest file that is read."""


def web_token(typed: str | None, file: Path | None) -> str | None:
    """Return the token of web clients; None where there is none.

    Raises:
        BadSetting: it was typed; or the file cannot be read, or is blank.
    """
    if typed is not None:
        raise BadSetting(
            f"--web-token: what is typed can be read by every user of this computer; set "
            f"{WEB_TOKEN}, or put it into a file and give --web-token-file FILE."
        )
    return secret(WEB_TOKEN, file, "--web-token-file")


def client_secret(file: Path | None) -> str | None:
    """Return the secret of a client's join; None where there is none. Raises BadSetting."""
    return secret(CLIENT_SECRET, file, "--client-secret-file")


def secret(variable: str, file: Path | None, option: str) -> str | None:
    """Return a secret: the first line of the file, or else the variable; None without both.

    Raises:
        BadSetting: the file cannot be read or is too long; or the secret is blank.
    """
    if file is None:
        found = os.environ.get(variable)
        if found is None:
            return None
        if not found.strip():
            raise BadSetting(f"{variable}: it is blank.")
        if not found.isprintable():
            raise BadSetting(f"{variable}: {NO_TEXT}.")
        return found.strip()
    try:
        with file.open("rb") as stream:
            if os.fstat(stream.fileno()).st_mode & (stat.S_IRWXG | stat.S_IRWXO):
                _warn_once(f"{option} {file}: other users may read it; chmod 600 prevents that")
            content = stream.read(MAX_BYTES + 1)
    except OSError as error:
        raise BadSetting(f"{option} {file}: cannot be read: {error.strerror}.") from None
    if len(content) > MAX_BYTES:
        raise BadSetting(f"{option} {file}: expected one line of at most {MAX_BYTES} bytes.")
    text = content.decode("utf-8", "surrogateescape").strip().partition("\n")[0].strip()
    if not text:
        raise BadSetting(f"{option} {file}: it is blank.")
    if not text.isprintable():
        raise BadSetting(f"{option} {file}: {NO_TEXT}.")
    return text


@cache
def _warn_once(line: str) -> None:
    warn(line)
