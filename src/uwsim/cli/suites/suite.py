"""``uwsim suite``: the group of commands for suites of tasks."""

from __future__ import annotations


def suite() -> None:
    """Enter an algorithm into a suite of tasks; verify and rank.

    A suite is a file with tasks, public seeds, and tracks by sensors. An entry is a folder with a
    result for each task. No command needs a server: an entry is published as files, and others run
    a part of its trials again.
    """
