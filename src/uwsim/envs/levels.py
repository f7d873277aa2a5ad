"""The level of an episode: the options of ``reset``, and the values that a seed draws.

The value of a swept parameter is one of the benchmark's levels, drawn from the stream
``environment/level/<name>`` of the episode's seed. ``options={"level": {"current": 0.15}}`` sets
it, and ``{"current": (0.0, 0.3)}`` draws it uniformly from a range.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ..base.external_values import finite_float
from ..base.rng import stream
from ..benchmark.updaters import Level, SceneUpdaterSpec, chain, swept_parameters
from ..errors import BadSetting, did_you_mean, short_repr

Value = float | tuple[float, float]
"""A value, or the bounds of a range from which it is drawn."""
OPTIONS = ("level",)
"""The keys of the options of ``reset``."""


def draw_level(updater: SceneUpdaterSpec, seed: int, choices: Mapping[str, Value]) -> Level:
    """Draw the level of an episode.

    Args:
        updater: the outermost updater of the benchmark.
        seed: the seed of the episode.
        choices: the values or ranges of swept parameters by name; others are drawn from the levels.
    """
    values = []
    for name, spec in zip(swept_parameters(updater), chain(updater), strict=True):
        rng = stream(seed, f"environment/level/{name}")
        choice = choices.get(name)
        if choice is None:
            levels = spec.values()
            values.append((name, levels[int(rng.integers(len(levels)))]))
        elif isinstance(choice, tuple):
            low, high = choice
            values.append((name, low + (high - low) * float(rng.random())))
        else:
            values.append((name, choice))
    return Level(tuple(values))


def read_choices(updater: SceneUpdaterSpec, options: Mapping[str, Any] | None) -> dict[str, Value]:
    """Return the values and ranges in the options of ``reset``.

    Raises:
        BadSetting: a key or a parameter is unknown, or a value is neither a number nor a range.
    """
    for key in options or {}:
        if key not in OPTIONS:
            raise BadSetting(
                f"options has the key {short_repr(key)}; expected {', '.join(OPTIONS)}."
                f"{did_you_mean(str(key), OPTIONS)}"
            )
    level = (options or {}).get("level", {})
    if not isinstance(level, Mapping):
        raise BadSetting(f"options['level'] is {short_repr(level)}; expected a dictionary.")
    names = swept_parameters(updater)
    choices: dict[str, Value] = {}
    for name, value in level.items():
        if name not in names:
            raise BadSetting(
                f"The benchmark sweeps no parameter {short_repr(name)}."
                f"{did_you_mean(str(name), names)} Known: {', '.join(names)}."
            )
        choices[name] = _read_value(name, value)
    return choices


def _read_value(name: str, value: Any) -> Value:
    pair = value if isinstance(value, tuple | list) else (value, value)
    numbers = [
        finite_float(number)
        for number in pair
        if isinstance(number, int | float) and not isinstance(number, bool)
    ]
    if len(pair) != 2 or len(numbers) != 2 or numbers[0] is None or numbers[1] is None:
        raise BadSetting(
            f"options['level'][{name!r}] is {short_repr(value)}; expected a number, or two for a "
            "range."
        )
    low, high = numbers[0], numbers[1]
    if low > high:
        raise BadSetting(f"The range of {name!r} is {low:g} to {high:g}; expected low to high.")
    return (low, high) if isinstance(value, tuple | list) else low
