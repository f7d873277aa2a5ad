"""Secrets of a command: from an environment variable or a file, never from the command line.

Every user of the computer can read the command line, and ``provenance.json`` contains it.
"""

from __future__ import annotations

import os
import stat
from functools import cache
from pathlib import Path

from ...base.environment import CLIENT_SECRET, WEB_TOKEN
from ...base.terminal import warn
from ...errors import BadSetting

INVALID_TEXT = "it has bytes that are no characters of UTF-8"
MAX_BYTES = 4096
"""The greatest size of a file with a secret."""


def read_web_token(command_line_token: str | None, file: Path | None) -> str | None:
    """Return the token of web clients, if there is one.

    Raises:
        BadSetting: the token is on the command line, or the file cannot be read or is blank.
    """
    if command_line_token is not None:
        raise BadSetting(
            "--web-token: every user of this computer can read the command line; set "
            f"{WEB_TOKEN}, or write it to a file and give --web-token-file FILE."
        )
    return read_secret(WEB_TOKEN, file, "--web-token-file")


def read_client_secret(file: Path | None) -> str | None:
    """Return the secret with which a client joins, if there is one; raise BadSetting."""
    return read_secret(CLIENT_SECRET, file, "--client-secret-file")


def read_secret(variable: str, file: Path | None, option: str) -> str | None:
    """Return a secret from the first line of a file, or else from an environment variable.

    Raises:
        BadSetting: the file cannot be read or is too long; or the secret is blank.
    """
    if file is None:
        value = os.environ.get(variable)
        if value is None:
            return None
        if not value.strip():
            raise BadSetting(f"{variable}: it is blank.")
        if not value.isprintable():
            raise BadSetting(f"{variable}: {INVALID_TEXT}.")
        return value.strip()
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
        raise BadSetting(f"{option} {file}: {INVALID_TEXT}.")
    return text


@cache
def _warn_once(line: str) -> None:
    warn(line)
