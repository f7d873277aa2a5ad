"""The configuration in a report: command, settings, versions, hashes, constants, provenance."""

from __future__ import annotations

import shlex
from collections.abc import Mapping, Sequence
from pathlib import Path

from ...results.code_paths import names_text
from ...results.command import bench_words
from ...results.refused_lines import refused_lines
from ...results.result import ERROR_FLOOR_PREFIX, Result
from ..plots import repeats_of, written_unit

FACTS = {
    "S": "contrast S of the patch: standard deviation, no noise, fog 0",
    "sigma": "noise σ of a colour channel",
    "sigma_grey": "noise σ of the grey image",
    "d": "mean distance d from camera to patch",
    "z": "threshold z of the ZNCC",
    "f_star": "predicted loss f*, with the noise of a channel",
    "f_star_grey": "predicted loss f*, with the noise of the grey image",
    "shift": "how far the target moved in the image",
}
"""The description of each image statistic (`uwsim.runs.trial.visibility`)."""
OMITTED_KEYS = ("notes", "clients", "levels", "settings", "compatibility", "units")
"""The entries of ``run`` that sentences above the table state."""
CLIENTS = {
    "own process, grade (b)": "in lock-step, in its own process, by messages only (grade b: the "
    "simulation waits for each call)",
    "in process": "in the process of the simulation (--in-process)",
}
"""The meaning of each way in which an algorithm class takes part."""
REPEATABLE_CLIENTS = ("own process, grade (b)",)
"""The clients, other than external programs, whose runs give the same numbers again."""
TRANSPORTS = {"web": "WebSocket", "ros1": "ROS 1", "ros2": "ROS 2"}
GRADES = {
    "grade (a)": "in lock-step: simulation time waits for its answers (grade a: each names its "
    "tick)",
    "grade (b)": "in lock-step: simulation time passes in the steps that it requests (grade b)",
    "grade (c)": "in lock-step: simulation time waits for the outputs that are due (grade c: it "
    "uses /clock alone)",
    "not repeatable": "in real time, without waiting: another run gives other numbers",
}
"""The meaning of each way in which an external program takes part."""
MISSING_MESSAGES_TEXT = "messages to it may be lost, so the same numbers are not guaranteed"
CODE_KEYS = ("code", "code_before")
"""The entries of the provenance with the code paths that libraries chose for the processor."""
IRRELEVANT_OPTIONS = {"--out": 1, "--workers": 1, "--resume": 0, "--overwrite": 0}
"""The options of ``bench`` that do not change the result, with their numbers of arguments."""


def command(result: Result, provenance: Mapping[str, object]) -> str:
    """Return the command that gives this result again, as the user typed it if that is recorded."""
    typed_words = provenance.get("command")
    if isinstance(typed_words, list) and typed_words:
        return shlex.join(["uwsim", *_omit_irrelevant_options([str(w) for w in typed_words])])
    algorithm = result.run.algorithm
    words = bench_words(
        result.run,
        result.inputs,
        algorithms=[algorithm] if algorithm else [],
        repeats=max(1, len(set(repeats_of(result)))),
    )
    return shlex.join(words)


def warnings(result: Result, check_note: str | None = None) -> list[str]:
    """Return the warnings: unfinished parts, unchecked rows, clients that are not repeatable."""
    run, messages = result.run, []
    if run.trial_counts is not None and not run.is_finished:
        n_finished, n_trials = run.trial_counts
        messages.append(
            f"Not finished: {n_finished} of {n_trials} trials are finished. Use --resume "
            "to continue."
        )
    if check_note is not None:
        messages.append(f"{check_note[0].upper()}{check_note[1:]}.")
    clients = run.clients or ()
    messages += [_participation(name, mode) for name, mode in clients if not _is_repeatable(mode)]
    messages += [f"{text}." for text in refused_lines(result)]
    return messages + [f"{note}." for note in run.notes or ()]


def remarks(result: Result) -> list[str]:
    """Return the remarks: chosen levels, changed settings, repeatable clients."""
    run, messages = result.run, []
    if levels := run.pairs_of_levels:
        messages.append(f"Only these levels of the sweep were run: {', '.join(levels)}.")
    if settings := run.pairs_of_settings:
        messages.append(f"Changed for this run: {', '.join(settings)}.")
    clients = run.clients or ()
    messages += [_participation(name, mode) for name, mode in clients if _is_repeatable(mode)]
    if names := run.compatibility:
        messages.append(f"Compatibility quirks: {', '.join(names)}.")
    return messages


def _is_repeatable(mode: str) -> bool:
    return mode in REPEATABLE_CLIENTS or (
        any(grade in mode for grade in ("grade (a)", "grade (b)", "grade (c)"))
        and "not guaranteed" not in mode
    )


def _participation(name: str, mode: str) -> str:
    return f"{name} takes part {_participation_phrase(mode)}."


def _participation_phrase(mode: str) -> str:
    _, *details = mode.split(", ")
    if mode in CLIENTS or not details or details[0] not in TRANSPORTS:
        return CLIENTS.get(mode, mode)
    text = f"as an external program over {TRANSPORTS[details[0]]}"
    if grade := GRADES.get("".join(details[1:2])):
        text += f", {grade}"
    return f"{text}; {MISSING_MESSAGES_TEXT}" if "not guaranteed" in details else text


def settings(result: Result) -> list[tuple[str, str]]:
    """Return all other entries of ``run``, as names and texts."""
    run = {name: value for name, value in result.run.as_dict().items() if name not in OMITTED_KEYS}
    return [(_setting_name(name), text) for name, text in flatten(run)]


def flatten(mapping: Mapping[str, object], prefix: str = "") -> list[tuple[str, str]]:
    """Return nested mappings as pairs of dotted name and text; (value, unit) becomes one text.

    Empty texts are omitted.
    """
    texts: list[tuple[str, str]] = []
    for name, value in mapping.items():
        if isinstance(value, Mapping):
            texts += flatten(value, f"{prefix}{name}.")
        else:
            values = value if isinstance(value, tuple | list) else (value,)
            texts.append((f"{prefix}{name}", " ".join(map(_value_text, values))))
    return [(name, text) for name, text in texts if text]


def provenance_texts(provenance: Mapping[str, object]) -> list[tuple[str, str]]:
    """Return the provenance as names and texts, with rounded numbers and short lists."""
    code = provenance.get("code")
    code_texts = {library: names_text(names) for library, names in _code_lists(code)}
    values = {name: _round_numbers(v) for name, v in provenance.items() if name not in CODE_KEYS}
    return flatten({**values, "code": code_texts})


def facts(result: Result) -> list[tuple[str, str]]:
    """Return the values measured for the whole run, with their descriptions and units."""
    texts = []
    for name in result.facts:
        fact = result.fact(name)
        unit = "" if fact is None or fact[1] == "1" else f" {written_unit(fact[1])}"
        text = str(result.facts[name]) if fact is None else f"{fact[0]:.4g}{unit}"
        texts.append((_fact_name(name), text))
    return texts


def _fact_name(name: str) -> str:
    if name.startswith(ERROR_FLOOR_PREFIX):
        return f"error floor of {name.removeprefix(ERROR_FLOOR_PREFIX)}, of a perfect tracker"
    return FACTS.get(name, name)


def variations(result: Result) -> list[tuple[str, str, str]]:
    """Return the varied values: the path, the distribution, and the minimum and maximum sample."""
    texts = []
    for variation in result.variations:
        unit = "" if variation.unit == "1" else f" {written_unit(variation.unit)}"
        values = [value for _, value in variation.values]
        ends = dict.fromkeys(f"{v:.4g}" for v in (min(values), max(values))) if values else []
        texts.append((variation.path, variation.drawn_from + unit, " to ".join(ends) + unit))
    return texts


def logs_text(logs: Sequence[Path]) -> list[tuple[str, str]]:
    """Return the names and sizes of files next to the report."""
    return [(log.name, f"{log.stat().st_size / 1000:.0f} kB") for log in logs]


def _omit_irrelevant_options(words: Sequence[str]) -> list[str]:
    remaining_words: list[str] = []
    skip = 0
    for word in words:
        option, _, value = word.partition("=")
        if skip:
            skip -= 1
        elif option in IRRELEVANT_OPTIONS:
            skip = 0 if value else IRRELEVANT_OPTIONS[option]
        else:
            remaining_words.append(word)
    return remaining_words


def _code_lists(value: object) -> list[tuple[str, list[object]]]:
    pairs = value.items() if isinstance(value, Mapping) else ()
    return [(str(name), names) for name, names in pairs if isinstance(names, list)]


def _setting_name(name: str) -> str:
    if name.startswith("parameters."):
        return f"parameter {name.removeprefix('parameters.')}"
    return {"version": "uwsim"}.get(name, name)


def _value_text(value: object) -> str:
    if isinstance(value, float):
        return f"{value:.10g}"
    return "" if value is None else str(value)


def _round_numbers(value: object) -> object:
    if isinstance(value, float):
        return float(f"{value:.4g}")
    return [_round_numbers(v) for v in value] if isinstance(value, list) else value
