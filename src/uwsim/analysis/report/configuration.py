"""The configuration in a report: command, settings, versions, hashes, constants, provenance."""

from __future__ import annotations

import shlex
from collections.abc import Mapping, Sequence
from pathlib import Path

from ...results.chosen_code import names_text
from ...results.command import bench_words
from ...results.refused_lines import refused_lines
from ...results.result import FLOOR, Result
from ..plots import algorithm_of, repeats_of, written_unit

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
"""Constant of a scene -> what it is (`uwsim.runs.trial.visibility`)."""
SAID_ELSEWHERE = ("notes", "clients", "levels", "settings", "compatibility", "units")
"""Parts of ``run`` that are in sentences above the table."""
CLIENTS = {
    "own process, grade (b)": "in lock-step, in a process of its own, by messages only (grade b: "
    "each call is waited for)",
    "in process": "in the process of the simulation (--in-process)",
}
"""How an algorithm class takes part -> what that means."""
SURE = ("own process, grade (b)",)
"""Ways of taking part, other than those of programs outside, that give the same numbers again."""
TRANSPORTS = {"web": "WebSocket", "ros1": "ROS 1", "ros2": "ROS 2"}
GRADES = {
    "grade (a)": "in lock-step: simulation time waits for its answers (grade a: each names its "
    "tick)",
    "grade (b)": "in lock-step: simulation time passes in the steps that it asks for (grade b)",
    "grade (c)": "in lock-step: simulation time waits for the outputs that are due (grade c: it "
    "works by /clock alone)",
    "not repeatable": "in real time, which waits for nothing: another run gives other numbers",
}
"""How a program outside takes part -> what that means."""
UNSURE = "what it was sent is only likely to have arrived: the same numbers are not guaranteed"
CODE = ("code", "code_before")
"""Parts of the provenance: what libraries chose for the processor."""
NOT_OF_THE_RESULT = {"--out": 1, "--workers": 1, "--resume": 0, "--overwrite": 0}
"""Options of ``bench`` that change nothing of what is found, and how many words each takes."""


def command(result: Result, provenance: Mapping[str, object]) -> str:
    """Return what to type to have this result again, as it was typed if that is known."""
    typed = provenance.get("command")
    if isinstance(typed, list) and typed:
        return shlex.join(["uwsim", *_of_the_result([str(word) for word in typed])])
    algorithm = algorithm_of(result)
    words = bench_words(
        result.run,
        result.inputs,
        algorithms=[algorithm] if algorithm else [],
        repeats=max(1, len(set(repeats_of(result)))),
    )
    return shlex.join(words)


def warnings(result: Result, unchecked: str | None = None) -> list[str]:
    """Return what reduces confidence: unfinished parts, unchecked rows, results that may differ."""
    run, messages = result.run, []
    if run.units is not None and not run.is_finished:
        messages.append(
            f"Not finished: {run.units[0]} of {run.units[1]} parts are finished. --resume "
            f"continues."
        )
    if unchecked is not None:
        messages.append(f"{unchecked[0].upper()}{unchecked[1:]}.")
    messages += [_participation(who, how) for who, how in run.clients or () if not _is_sure(how)]
    messages += [f"{text}." for text in refused_lines(result)]
    return messages + [f"{note}." for note in run.notes or ()]


def remarks(result: Result) -> list[str]:
    """Return what a reader should know: chosen levels, changed settings, how clients take part."""
    run, messages = result.run, []
    if chosen := run.pairs_of_levels:
        messages.append(f"Only these levels of the sweep were run: {', '.join(chosen)}.")
    if settings := run.pairs_of_settings:
        messages.append(f"Changed for this run: {', '.join(settings)}.")
    messages += [_participation(who, how) for who, how in run.clients or () if _is_sure(how)]
    if names := run.compatibility:
        messages.append(f"Compatibility quirks: {', '.join(names)}.")
    return messages


def _is_sure(how: str) -> bool:
    """Whether another run gives the same numbers: in lock-step, by messages only."""
    return how in SURE or (
        any(grade in how for grade in ("grade (a)", "grade (b)", "grade (c)"))
        and "not guaranteed" not in how
    )


def _participation(who: str, how: str) -> str:
    """Describe in a sentence how an algorithm takes part: ``lock-step, ros1, grade (a)``."""
    return f"{who} takes part {_words_of(how)}."


def _words_of(how: str) -> str:
    _, *more = how.split(", ")
    if how in CLIENTS or not more or more[0] not in TRANSPORTS:
        return CLIENTS.get(how, how)
    said = [f"as a program outside over {TRANSPORTS[more[0]]}", *(GRADES.get(w) for w in more[1:2])]
    text = ", ".join(word for word in said if word is not None)
    return f"{text}; {UNSURE}" if "not guaranteed" in more else text


def settings(result: Result) -> list[tuple[str, str]]:
    """Return all other parts of ``run``."""
    run = {
        name: value for name, value in result.run.as_dict().items() if name not in SAID_ELSEWHERE
    }
    found = flat(run)
    return [(_setting(name), text) for name, text in found]


def flat(mapping: Mapping[str, object], prefix: str = "") -> list[tuple[str, str]]:
    """Flatten nested mappings into (dotted name, text); (value, unit) becomes one text.

    What is empty is left out.
    """
    found: list[tuple[str, str]] = []
    for name, value in mapping.items():
        if isinstance(value, Mapping):
            found += flat(value, f"{prefix}{name}.")
        else:
            words = [_word(v) for v in (value if isinstance(value, tuple | list) else (value,))]
            found.append((f"{prefix}{name}", " ".join(words)))
    return [(name, text) for name, text in found if text]


def machine(provenance: Mapping[str, object]) -> list[tuple[str, str]]:
    """Return the provenance, with short numbers and lists of code."""
    code = provenance.get("code")
    shown = {library: names_text(names) for library, names in _lists(code)}
    others = {name: _rounded(value) for name, value in provenance.items() if name not in CODE}
    return flat({**others, "code": shown})


def facts(result: Result) -> list[tuple[str, str]]:
    """Return the constants of the scene, in words, with units."""
    found = []
    for name in result.facts:
        fact = result.fact(name)
        unit = "" if fact is None or fact[1] == "1" else f" {written_unit(fact[1])}"
        text = str(result.facts[name]) if fact is None else f"{fact[0]:.4g}{unit}"
        found.append((_meaning(name), text))
    return found


def _meaning(name: str) -> str:
    if name.startswith(FLOOR):
        return f"floor of {name.removeprefix(FLOOR)}: what a perfect tracker scores"
    return FACTS.get(name, name)


def variations(result: Result) -> list[tuple[str, str, str]]:
    """Return what varies: which value, drawn from what, and what was drawn.

    Of several seeds the least and the largest value are shown.
    """
    found = []
    for each in result.variations:
        unit = "" if each.unit == "1" else f" {written_unit(each.unit)}"
        drawn = [value for _, value in each.values]
        ends = dict.fromkeys(f"{value:.4g}" for value in (min(drawn), max(drawn))) if drawn else []
        found.append((each.path, each.drawn_from + unit, " to ".join(ends) + unit))
    return found


def logs_text(logs: Sequence[Path]) -> list[tuple[str, str]]:
    """Return name and size of files next to the report."""
    return [(log.name, f"{log.stat().st_size / 1000:.0f} kB") for log in logs]


def _of_the_result(words: Sequence[str]) -> list[str]:
    kept: list[str] = []
    skip = 0
    for word in words:
        option, _, joined = word.partition("=")
        if skip:
            skip -= 1
        elif option in NOT_OF_THE_RESULT:
            skip = 0 if joined else NOT_OF_THE_RESULT[option]
        else:
            kept.append(word)
    return kept


def _lists(value: object) -> list[tuple[str, list[object]]]:
    pairs = value.items() if isinstance(value, Mapping) else ()
    return [(str(name), each) for name, each in pairs if isinstance(each, list)]


def _setting(name: str) -> str:
    if name.startswith("parameters."):
        return f"parameter {name.removeprefix('parameters.')}"
    return {"version": "uwsim"}.get(name, name)


def _word(value: object) -> str:
    """A value as a person writes it: ``3`` for 3.0."""
    if isinstance(value, float):
        return f"{value:.10g}"
    return "" if value is None else str(value)


def _rounded(value: object) -> object:
    if isinstance(value, float):
        return float(f"{value:.4g}")
    return [_rounded(v) for v in value] if isinstance(value, list) else value
