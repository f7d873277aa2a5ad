"""Report: one HTML file that says what was run, what was found, and how far to trust it.

Drawn from the result directory alone (``result.json``, logs, pictures, ``provenance.json``), so an
old run can be drawn again. The file holds its pictures and its style in itself, loads nothing, runs
no script (a content security policy forbids both), and every name that came from a file is text.

A directory ``control`` inside it, the same benchmark played by `frozen`, gives every plot its
dashed line.
"""

from __future__ import annotations

import base64
import io
import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path

import jinja2
import numpy as np
from PIL import Image

from ..errors import ResultError
from .directory import CONTROL, REPORT
from .interval import per_level, rows_by_level
from .logs import logs_of
from .overlay import overlay
from .plots import LEVEL_WORDS, OVERVIEW, algorithm_of, draw_plots, written_unit
from .provenance import load_provenance
from .result import Column, Result, TakenPicture, file_of, load, write_whole
from .table import exact_decimals, lines, shown_columns, unit_of

MAX_PICTURES = 60
"""More are thinned out evenly; the report says so."""
MAX_ROWS = 2000
"""More rows of the full table are left to result.json; the report says so."""
PAPER_FOG, PAPER_DISTANCE, PAPER_VISIBILITY = 1.1, 1.36, 0.86
"""What the UWSim benchmarking paper (Perez et al.) states: [1/m], [m], 1."""
FLOORS = {"visibility": "about 1 px", "currents": "about 5 px"}
"""What a perfect tracker scores in the bundled benchmarks, by the first word of their names."""


@dataclass(frozen=True, kw_only=True)
class Card:
    """A number worth reading first."""

    label: str
    """What it is."""
    value: str
    """The number with its unit."""
    note: str = ""
    """How it was found."""


@dataclass(frozen=True, kw_only=True)
class Ending:
    """One way in which levels ended, and how often."""

    status: str
    """``ok``, ``lost``, ``timeout``, ..."""
    n: int
    """Rows that ended so."""
    share: str
    """Share of all rows; no interval, for the levels of one repeat are no repeats."""
    first: str
    """First level of each repeat that ended so."""
    reasons: tuple[str, ...]
    """The reasons given, each once, at most five."""


@dataclass(frozen=True, kw_only=True)
class Shown:
    """A picture in the report."""

    caption: str
    """Level and status."""
    data: str | None
    """The image as a data URL; None when its file cannot be read."""
    ok: bool
    """Whether its level ended ``ok``."""


def write_report(path: Path) -> Path:
    """Draw plots and ``report.html`` of a result directory (or its ``result.json``).

    Raises:
        ResultError: there is no result, or it cannot be read.
    """
    directory = file_of(path).parent
    result = load(path)
    control = _control(directory)
    plots = draw_plots(result, directory / "plots", control=control)
    target = directory / REPORT
    write_whole(target, render(result, directory, plots=plots, control=control))
    return target


def render(
    result: Result, directory: Path, *, plots: Iterable[Path], control: Result | None = None
) -> str:
    """Return the report's HTML."""
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(Path(__file__).parent / "templates"),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    pictures = _pictures(result, directory)
    return environment.get_template("report.html.j2").render(
        title=_title(result),
        algorithm=algorithm_of(result) or "no algorithm",
        lead=_lead(result),
        cards=_cards(result),
        columns=[_heading(result, column) for column in shown_columns(result)],
        table=lines(result),
        repeats=_n_repeats(result),
        full=_full_table(result),
        n_rows=len(result.rows),
        max_rows=MAX_ROWS,
        plots=[
            (plot.stem, _data_url(plot.read_bytes(), "png"))
            for plot in plots
            if plot.stem != OVERVIEW
        ],
        has_control=control is not None,
        pictures=pictures,
        n_pictures=len(result.pictures),
        endings=_endings(result),
        run=_pairs(result.run),
        inputs=_hashes(result.inputs),
        facts=[(name, _fact(result, name)) for name in result.facts],
        streams=result.image_streams,
        logs=[(log.name, log.stat().st_size) for log in logs_of(directory)],
        is_static=_is_static(result),
        floor=FLOORS.get(_title(result).partition("-")[0], "a few px"),
        optics=_optics(result),
        provenance=_pairs(load_provenance(directory)),
        version=str(result.run.get("version", "?")),
    )


# ---------------------------------------------------------------------------- what is said


def _title(result: Result) -> str:
    benchmark = result.inputs.get("benchmark")
    name = str(benchmark[0]) if isinstance(benchmark, tuple) and benchmark else "benchmark"
    return name.removesuffix(".xml")


def _lead(result: Result) -> str:
    """One sentence: what was swept, over what, how often."""
    levels = rows_by_level(result)
    spans = []
    for i, column in enumerate(result.of_kind("level")):
        values = sorted({level[i] for level in levels})
        word = LEVEL_WORDS.get(column.name, column.name)
        if word and values:
            span = f"{values[0]:g}" + (f" to {values[-1]:g}" if len(values) > 1 else "")
            spans.append(f"{word} {span}{_space(column.unit)}")
    over = " and ".join(spans) or "one scene"
    many = f", {n} repeats" if (n := _n_repeats(result)) > 1 else ""
    count = f"{len(levels)} level" + ("s" if len(levels) != 1 else "")
    return f"{count}, {over}{many}; {result.run.get('mode', 'sequential')}."


def _cards(result: Result) -> list[Card]:
    endings = _endings(result)
    n_ok = sum(ending.n for ending in endings if ending.status == "ok")
    played = f"{n_ok} of {len(result.rows)}"
    cards = [Card(label="rows that ended ok", value=played, note="a row: one level of one repeat")]
    for ending in endings:
        if ending.status != "ok":
            note = ending.reasons[0] if ending.reasons else "no reason was given"
            cards.append(Card(label=f"first {ending.status}", value=ending.first, note=note))
    star = result.fact("f_star")
    if star is not None:
        note = "fog at which the patch's ZNCC should fall to its threshold"
        cards.append(
            Card(label="loss predicted at f*", value=f"{star[0]:.3f}{_space(star[1])}", note=note)
        )
    for column in result.of_kind("score") + result.of_kind("measure"):
        entries = [e for e in per_level(result, column.name) if e.interval.mean is not None]
        if not entries:
            continue
        first, last = entries[0], entries[-1]
        value = f"{first.interval.mean:.3g}"
        if len(entries) > 1:
            value += f" to {last.interval.mean:.3g}"
        at = (
            ""
            if len(entries) < 2
            else (f"at {_level_text(result, first.level)} and {_level_text(result, last.level)}")
        )
        unit = unit_of(result, column)
        cards.append(Card(label=column.name, value=value + _space(unit), note=at))
    return cards[:8]


def _endings(result: Result) -> list[Ending]:
    """Group the rows by how they ended, ok first, then by number."""
    status = result.of_kind("status")
    if not status:
        return []
    cells = [str(cell) for cell in result.values(status[0].name)]
    levels = {row: level for level, rows in rows_by_level(result).items() for row in rows}
    repeats = _repeats(result)
    found = []
    for name in sorted(set(cells), key=lambda s: (s != "ok", -cells.count(s), s)):
        rows = [row for row, cell in enumerate(cells) if cell == name]
        reasons = dict.fromkeys(why for row in rows for why in result.reasons(row))
        found.append(
            Ending(
                status=name,
                n=len(rows),
                share=f"{100 * len(rows) / len(cells):.0f} %",
                first=_first_at(result, [(repeats[row], levels[row]) for row in rows]),
                reasons=tuple(reasons)[:5],
            )
        )
    return found


def _optics(result: Result) -> dict[str, str] | None:
    """Where the paper's fog 1.1 lies against f*, in fog and in what the water lets through."""
    star, distance = result.fact("f_star"), result.fact("d")
    if star is None or distance is None:
        return None
    f, d = star[0], distance[0]
    z = result.fact("z")
    losses = [e.first for e in _endings(result) if e.status == "lost"]
    return {
        "f_star": f"{f:.3f}",
        "d": f"{d:.3f}",
        "z": f"{z[0]:g}" if z else "0.5",
        "difference": f"{abs(PAPER_FOG - f):.3f}",
        "side": "below" if f > PAPER_FOG else "above",
        "paper_fog": f"{PAPER_FOG:g}",
        "paper_transmission": f"{100 * math.exp(-((PAPER_FOG * d) ** 2)):.1f} %",
        "star_transmission": f"{100 * math.exp(-((f * d) ** 2)):.1f} %",
        "paper_distance": f"{PAPER_DISTANCE:g}",
        "paper_visibility": f"{PAPER_VISIBILITY:g}",
        "paper_formula": f"{1 - math.exp(-((PAPER_FOG * PAPER_DISTANCE) ** 2)):.3f}",
        "paper_needs_fog": f"{math.sqrt(-math.log(1 - PAPER_VISIBILITY)) / PAPER_DISTANCE:.3f}",
        "paper_needs_distance": f"{math.sqrt(-math.log(1 - PAPER_VISIBILITY)) / PAPER_FOG:.2f}",
        "lost": losses[0] if losses else "",
    }


def _is_static(result: Result) -> bool:
    """Whether the target stood still in the picture through all levels: the truth never moved."""
    quads: dict[str, list[tuple[float, ...]]] = {}
    for picture in result.pictures:
        if picture.truth is not None:
            quads.setdefault(picture.camera, []).append(picture.truth)
    if any(len(found) > 1 for found in quads.values()):
        return all(float(np.ptp(np.array(found), axis=0).max()) < 0.05 for found in quads.values())
    return _title(result) == "visibility"


def _control(directory: Path) -> Result | None:
    try:
        return load(directory / CONTROL)
    except ResultError:
        return None


# ---------------------------------------------------------------------------- how it is said


def _heading(result: Result, column: Column) -> tuple[str, str]:
    """Name and unit of a column."""
    name = {"time": "time", "score": "total"}.get(column.kind, column.name)
    return name, unit_of(result, column)


def _full_table(result: Result) -> tuple[list[tuple[str, str]], list[list[tuple[str, str]]]]:
    """All columns, and the rows as (text, reason) cells."""
    decimals = {
        column.name: exact_decimals(
            [float(v) for v in result.numbers(column.name) if v is not None]
        )
        for column in result.of_kind("level")
    }
    rows = [
        [_cell(result, row, column, decimals.get(column.name)) for column in result.columns]
        for row in range(min(len(result.rows), MAX_ROWS))
    ]
    return [(column.name, unit_of(result, column)) for column in result.columns], rows


def _cell(result: Result, row: int, column: Column, decimals: int | None) -> tuple[str, str]:
    value = result.rows[row][result.index(column.name)]
    if value is None:
        return "–", result.why(row, column.name) or "no reason was given"
    if isinstance(value, str):
        return value, ""
    return (f"{value:.{decimals}f}" if decimals is not None else _number(value)), ""


def _number(value: float | None) -> str:
    if value is None:
        return "–"
    return f"{value:.0f}" if float(value).is_integer() and abs(value) < 1e6 else f"{value:.4g}"


def _space(unit: str | None) -> str:
    return f" {written_unit(unit)}" if unit else ""


def _level_text(result: Result, level: tuple[float, ...]) -> str:
    named = zip(result.of_kind("level"), level, strict=True)
    parts = [f"{c.name} {value:g}{_space(c.unit)}" for c, value in named if c.name != "none"]
    return ", ".join(parts) or "the only level"


def _first_at(result: Result, rows: Iterable[tuple[tuple[object, ...], tuple[float, ...]]]) -> str:
    """The first level of each repeat among the rows: one level, or from the lowest to the last."""
    first: dict[tuple[object, ...], tuple[float, ...]] = {}
    for repeat, level in rows:
        first.setdefault(repeat, level)
    low, high = min(first.values()), max(first.values())
    text = _level_text(result, low)
    return text if low == high else f"{text} to {_level_text(result, high)}"


def _fact(result: Result, name: str) -> str:
    fact = result.fact(name)
    if fact is None:
        return str(result.facts[name])
    return f"{fact[0]:.4g}" + ("" if fact[1] == "1" else _space(fact[1]))


def _pairs(mapping: Mapping[str, object], prefix: str = "") -> list[tuple[str, str]]:
    """Flatten nested mappings into (dotted name, text); (value, unit) becomes one text.

    What is empty is left out.
    """
    found: list[tuple[str, str]] = []
    for name, value in mapping.items():
        if isinstance(value, Mapping):
            found += _pairs(value, f"{prefix}{name}.")
        else:
            words = [_word(v) for v in (value if isinstance(value, tuple | list) else (value,))]
            found.append((f"{prefix}{name}", " ".join(words)))
    return [(name, text) for name, text in found if text]


def _word(value: object) -> str:
    """A value as a person writes it: ``3`` for 3.0."""
    if isinstance(value, float):
        return f"{value:.10g}"
    return "" if value is None else str(value)


def _hashes(inputs: Mapping[str, object]) -> list[tuple[str, str, str]]:
    """(what, file, hash) of every input."""
    found = []
    for what, value in inputs.items():
        if isinstance(value, Mapping):
            found += [(what, str(name), str(digest)) for name, digest in value.items()]
        elif isinstance(value, tuple) and len(value) == 2:
            found.append((what, str(value[0]), str(value[1])))
        else:
            found.append((what, str(value), ""))
    return found


def _n_repeats(result: Result) -> int:
    return len(set(_repeats(result))) or 1


def _repeats(result: Result) -> list[tuple[object, ...]]:
    """Which repeat every row belongs to: its cells of kind ``run``."""
    runs = [result.index(column.name) for column in result.of_kind("run")]
    return [tuple(row[i] for i in runs) for row in result.rows]


# ---------------------------------------------------------------------------- pictures


def _pictures(result: Result, directory: Path) -> list[Shown]:
    taken = result.pictures
    if len(taken) > MAX_PICTURES:
        chosen = np.linspace(0, len(taken) - 1, MAX_PICTURES).round().astype(int)
        taken = tuple(taken[i] for i in chosen.tolist())
    levels = {row: level for level, rows in rows_by_level(result).items() for row in rows}
    status = result.of_kind("status")
    shown = []
    for picture in taken:
        ended = str(result.values(status[0].name)[picture.row]) if status else ""
        caption = f"{_level_text(result, levels[picture.row])} · {ended or picture.camera}"
        shown.append(
            Shown(caption=caption, data=_drawn(picture, directory), ok=ended in ("ok", ""))
        )
    return shown


def _drawn(picture: TakenPicture, directory: Path) -> str | None:
    """Read a picture from inside the directory, draw its quads; None when that fails."""
    file = (directory / picture.file).resolve()
    if not file.is_relative_to(directory.resolve()):
        return None
    try:
        with Image.open(file, formats=("PNG", "JPEG")) as image:
            pixels = np.asarray(image.convert("RGB"))
    except (OSError, ValueError, Image.DecompressionBombError, SyntaxError):
        return None
    scale = 2 if max(pixels.shape) <= 400 else 1
    drawn = overlay(pixels, truth=picture.truth, estimate=picture.estimate, scale=scale)
    stream = io.BytesIO()
    Image.fromarray(drawn).save(stream, format="JPEG", quality=85)
    return _data_url(stream.getvalue(), "jpeg")


def _data_url(data: bytes, kind: str) -> str:
    return f"data:image/{kind};base64,{base64.b64encode(data).decode('ascii')}"
