"""Checking options: settings ``NAME=VALUE``, modes, levels, names of quirks."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from ...errors import BadSetting, ErrorCollector, did_you_mean

if TYPE_CHECKING:
    from ...benchmark.spec import BenchmarkSpec
    from .plan import Mode


def pairs_of(settings: Sequence[str], wrong: ErrorCollector) -> list[tuple[str, str]]:
    """Split every ``--set`` into name and value; collects errors."""
    pairs = []
    for setting in settings:
        with wrong.collect():
            pairs.append(split(setting, "--set"))
    return pairs


def mode_of(mode: str | None) -> Mode:
    """Return how levels follow each other; raises BadSetting."""
    if mode is None or mode == "sequential":
        return "sequential"
    if mode == "independent":
        return "independent"
    near = did_you_mean(mode, ("sequential", "independent"))
    raise BadSetting(f"--mode is {mode!r}; expected sequential or independent.{near}")


def compatibility_of(compat: Sequence[str], wrong: ErrorCollector) -> frozenset[str]:
    """Return the quirks of ``--compat``; an unknown name goes into ``wrong``."""
    from ...base.compatibility import compatibility

    found: frozenset[str] = frozenset()
    for name in [word for words in compat for word in words.replace(",", " ").split()]:
        with wrong.collect():
            found |= compatibility([name])
    return found


def levels_of(
    wanted: Sequence[tuple[str, float]], spec: BenchmarkSpec | None, wrong: ErrorCollector
) -> tuple[tuple[str, float], ...]:
    """Return the wanted levels that the sweep has; collects errors for the others."""
    from ...benchmark import updaters
    from .plan import chosen_levels

    levels = () if spec is None or not wanted else updaters.levels(spec.scene_updater)
    chosen = []
    for pair in wanted:
        with wrong.collect():
            if levels:
                chosen_levels(levels, [pair])
            chosen.append(pair)
    return tuple(chosen)


def split(setting: str, option: str) -> tuple[str, str]:
    """Split ``NAME=VALUE``; raises BadSetting."""
    name, equals, value = setting.partition("=")
    if not equals or not name.strip():
        raise BadSetting(f"{option} {setting!r}: expected NAME=VALUE.")
    return name.strip(), value.strip()


def number_or_text(text: str) -> float | str:
    """Return a finite number where the text is one, else the text."""
    try:
        number = float(text)
    except ValueError:
        return text
    return number if abs(number) < float("inf") else text
