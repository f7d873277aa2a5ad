"""The checks of option values: settings ``NAME=VALUE``, modes, levels, compatibility quirks."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from ...errors import BadSetting, ErrorCollector, did_you_mean

if TYPE_CHECKING:
    from ...benchmark.spec import BenchmarkSpec
    from .plan import Mode


def pairs_of(settings: Sequence[str], errors: ErrorCollector) -> list[tuple[str, str]]:
    """Split every ``--set`` into name and value; collect errors."""
    pairs = []
    for setting in settings:
        with errors.collect():
            pairs.append(split(setting, "--set"))
    return pairs


def mode_of(mode: str | None) -> Mode:
    """Return the mode of the levels, sequential by default; raise BadSetting for another name."""
    if mode is None or mode == "sequential":
        return "sequential"
    if mode == "independent":
        return "independent"
    near = did_you_mean(mode, ("sequential", "independent"))
    raise BadSetting(f"--mode is {mode!r}; expected sequential or independent.{near}")


def compatibility_of(compat: Sequence[str], errors: ErrorCollector) -> frozenset[str]:
    """Return the quirks of ``--compat``; collect errors for unknown names."""
    from ...base.compatibility import compatibility

    quirks: frozenset[str] = frozenset()
    for name in [word for words in compat for word in words.replace(",", " ").split()]:
        with errors.collect():
            quirks |= compatibility([name])
    return quirks


def levels_of(
    pairs: Sequence[tuple[str, float]], spec: BenchmarkSpec | None, errors: ErrorCollector
) -> tuple[tuple[str, float], ...]:
    """Return the requested levels that the sweep has; collect errors for the others."""
    from ...benchmark import updaters
    from .plan import chosen_levels

    levels = () if spec is None or not pairs else updaters.levels(spec.scene_updater)
    level_choices = []
    for pair in pairs:
        with errors.collect():
            if levels:
                chosen_levels(levels, [pair])
            level_choices.append(pair)
    return tuple(level_choices)


def split(setting: str, option: str) -> tuple[str, str]:
    """Split ``NAME=VALUE``; raise BadSetting if there is no name."""
    name, separator, value = setting.partition("=")
    if not separator or not name.strip():
        raise BadSetting(f"{option} {setting!r}: expected NAME=VALUE.")
    return name.strip(), value.strip()


def number_or_text(text: str) -> float | str:
    """Return the text as a number if it is a finite number, or else the text itself."""
    try:
        number = float(text)
    except ValueError:
        return text
    return number if abs(number) < float("inf") else text
