"""The tables of ``docs/sensors.md``: simulated sensors, and those that are only read.

The page itself is written by hand; each table stands between ``<!-- table: NAME -->`` and
``<!-- end of table -->`` and is made by `filled` from the specs that read scene files.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Callable, Sequence
from pathlib import Path

from uwsim.checks.benchmark_tables import bundled_tables
from uwsim.cli.list import devices, find_limit, qualified_name, sensors
from uwsim.schema import fields_of
from uwsim.schema.names import prefixed_name
from uwsim.sensors import SENSORS
from uwsim.topics import INTERFACES

TABLE = re.compile(r"(<!-- table: ([\w-]+) -->\n).*?(<!-- end of table -->)", re.DOTALL)
COMMON = ("name", "relativeTo")
"""Elements that every sensor has."""


def filled(page: str) -> str:
    """Return the page with all its tables made anew; raises KeyError for an unknown one."""
    return TABLE.sub(lambda found: found[1] + TABLES[found[2]]() + found[3], page)


def _sensors(*, simulated: bool) -> str:
    """Sensors, with their elements besides name and link."""
    rows = []
    for name, summary in sensors(bundled_tables()).items():
        if simulated is (find_limit("sensors", name) == ""):
            own = [
                field.label
                for field in fields_of(SENSORS[qualified_name(name)])
                if field.label not in COMMON
            ]
            rows.append((_linked(name), summary, ", ".join(f"`{each}`" for each in own)))
    return _table(("element", "what it measures", "its elements"), rows)


def _devices(*, simulated: bool) -> str:
    rows = [
        (_linked(name), summary)
        for name, summary in devices(bundled_tables()).items()
        if simulated is (find_limit("devices", name) == "")
    ]
    return _table(("element", "what it is"), rows)


def _topics(*, simulated: bool) -> str:
    """Interfaces that publish, with their default rates."""
    rows = []
    for tag, spec in INTERFACES.items():
        name = prefixed_name(tag)
        summary = (spec.__doc__ or "").strip().split("\n")[0]
        elements = {field.label: field for field in fields_of(spec)}
        topics = ", ".join(f"`{each}`" for each in elements if each.lower().endswith("topic"))
        publishes = not spec.subscribes and (topics or spec.message_types())
        if publishes and simulated is (find_limit("interfaces", name) == ""):
            rate = f"{elements['rate'].default:g} Hz" if "rate" in elements else "-"
            rows.append((_linked(name), summary, topics or "-", rate))
    return _table(("element of `<rosInterfaces>`", "what it does", "topics", "default rate"), rows)


def _linked(name: str) -> str:
    return f"[`<{name}>`](dialect.md#{name.lower().replace(':', '')})"


def _table(head: tuple[str, ...], rows: Sequence[tuple[str, ...]]) -> str:
    if not rows:
        return "None.\n"
    lines = [head, ("---",) * len(head), *rows]
    return "".join(f"| {' | '.join(cells)} |\n" for cells in lines)


TABLES: dict[str, Callable[[], str]] = {
    "sensors": lambda: _sensors(simulated=True),
    "sensors-read-only": lambda: _sensors(simulated=False),
    "devices": lambda: _devices(simulated=True),
    "devices-read-only": lambda: _devices(simulated=False),
    "topics": lambda: _topics(simulated=True),
    "topics-read-only": lambda: _topics(simulated=False),
}


def main() -> None:
    """Fill the tables of the page given."""
    page = Path(sys.argv[1])
    page.write_text(filled(page.read_text()))


if __name__ == "__main__":
    main()
