"""Generate the tables of ``docs/sensors.md``: simulated sensors, and those that are only read.

The page itself is written by hand; each table is between ``<!-- table: NAME -->`` and
``<!-- end of table -->`` and `fill_tables` generates it from the specs that read scene files.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Callable, Sequence
from pathlib import Path

from uwsim.checks.benchmark_tables import bundled_tables
from uwsim.cli.list import devices, find_limitation, qualified_name, sensors
from uwsim.schema import fields_of
from uwsim.schema.names import prefixed_name
from uwsim.sensors import SENSORS
from uwsim.topics import INTERFACES

TABLE = re.compile(r"(<!-- table: ([\w-]+) -->\n).*?(<!-- end of table -->)", re.DOTALL)
COMMON_ELEMENTS = ("name", "relativeTo")
"""The elements of every sensor."""


def fill_tables(page: str) -> str:
    """Return the page with new tables; raise KeyError for an unknown table."""
    return TABLE.sub(lambda match: match[1] + TABLES[match[2]]() + match[3], page)


def _sensors(*, is_simulated: bool) -> str:
    """Return the table of sensors, with their elements besides name and link."""
    rows = []
    for name, summary in sensors(bundled_tables()).items():
        if is_simulated is (find_limitation("sensors", name) == ""):
            labels = [
                field.label
                for field in fields_of(SENSORS[qualified_name(name)])
                if field.label not in COMMON_ELEMENTS
            ]
            rows.append((_element_link(name), summary, ", ".join(f"`{label}`" for label in labels)))
    return _table(("element", "what it measures", "its elements"), rows)


def _devices(*, is_simulated: bool) -> str:
    rows = [
        (_element_link(name), summary)
        for name, summary in devices(bundled_tables()).items()
        if is_simulated is (find_limitation("devices", name) == "")
    ]
    return _table(("element", "what it is"), rows)


def _topics(*, is_simulated: bool) -> str:
    """Return the table of interfaces that publish, with their default rates."""
    rows = []
    for tag, spec in INTERFACES.items():
        name = prefixed_name(tag)
        summary = (spec.__doc__ or "").strip().split("\n")[0]
        elements = {field.label: field for field in fields_of(spec)}
        topics = ", ".join(
            f"`{element}`" for element in elements if element.lower().endswith("topic")
        )
        is_publisher = not spec.subscribes and (topics or spec.message_types())
        if is_publisher and is_simulated is (find_limitation("interfaces", name) == ""):
            rate = f"{elements['rate'].default:g} Hz" if "rate" in elements else "-"
            rows.append((_element_link(name), summary, topics or "-", rate))
    return _table(("element of `<rosInterfaces>`", "what it does", "topics", "default rate"), rows)


def _element_link(name: str) -> str:
    return f"[`<{name}>`](dialect.md#{name.lower().replace(':', '')})"


def _table(head: tuple[str, ...], rows: Sequence[tuple[str, ...]]) -> str:
    if not rows:
        return "None.\n"
    lines = [head, ("---",) * len(head), *rows]
    return "".join(f"| {' | '.join(cells)} |\n" for cells in lines)


TABLES: dict[str, Callable[[], str]] = {
    "sensors": lambda: _sensors(is_simulated=True),
    "sensors-read-only": lambda: _sensors(is_simulated=False),
    "devices": lambda: _devices(is_simulated=True),
    "devices-read-only": lambda: _devices(is_simulated=False),
    "topics": lambda: _topics(is_simulated=True),
    "topics-read-only": lambda: _topics(is_simulated=False),
}


def main() -> None:
    """Fill the tables of a page."""
    page = Path(sys.argv[1])
    page.write_text(fill_tables(page.read_text()))


if __name__ == "__main__":
    main()
