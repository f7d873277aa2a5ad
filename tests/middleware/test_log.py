"""The log of a transport: one event is one line, whatever a peer has sent."""

from __future__ import annotations

import pytest

from uwsim.middleware.log import Log


@pytest.mark.parametrize("end", ["\n", "\r\n", "\x85", "\u2028", "\x1b[2K\n"])
def test_a_peer_writes_no_lines_of_its_own(end: str) -> None:
    lines: list[str] = []
    other_lines: list[str] = []
    log = Log("ros1", lines.append)
    log.add_listener(other_lines.append)
    log.report(f"it refuses: boo{end}uwsim: result: ok")
    for line in (*lines, *other_lines, *log.lines):
        assert len(line.splitlines()) == 1
        assert line.isprintable()
        assert line.endswith("uwsim: result: ok")
