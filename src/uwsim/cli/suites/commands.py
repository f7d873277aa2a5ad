"""The table of the commands of ``uwsim suite``."""

from __future__ import annotations

from ..options.command import Command

SUITE_COMMANDS: dict[str, Command] = {
    "list": Command(
        module="suites.list",
        function="list_tasks",
        summary="List the bundled suites, or the tasks and tracks of one.",
        examples=("uwsim suite list", "uwsim suite list intervention"),
    ),
    "run": Command(
        module="suites.run",
        function="run_entry",
        summary="Run an algorithm in the tasks of a suite.",
        examples=(
            "uwsim suite run intervention --algorithm position-pi --tasks station-v1,circle-v1 "
            "--out entry",
            "uwsim suite run intervention --algorithm station-v1=my_control.py:MyControl "
            "--short --out entry",
        ),
    ),
    "seeds": Command(
        module="suites.seeds",
        function="print_seeds",
        summary="Print the seeds of the split test.",
        examples=("uwsim suite seeds intervention --date 2027-01-01 --beacon 4f1c8e",),
    ),
    "site": Command(
        module="suites.site",
        function="write_leaderboard",
        summary="Write the page of a leaderboard.",
        examples=("uwsim suite site entries -o page", "uwsim suite site entries --seeds 3 -o page"),
    ),
    "table": Command(
        module="suites.table",
        function="write_reference_table",
        summary="Run the baselines, experts and controls of a suite.",
        examples=("uwsim suite table intervention --workers 2 --out table",),
    ),
    "verify": Command(
        module="suites.verify",
        function="verify_submissions",
        summary="Check submissions, and run a share of their trials again.",
        examples=("uwsim suite verify entry", "uwsim suite verify entries/* --share 0.05"),
    ),
}
"""The commands of ``uwsim suite``."""
