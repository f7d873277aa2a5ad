"""The level of an episode: the options of ``reset``, and the values that a seed draws.

The value of a swept parameter is one of the benchmark's levels in the environment's
``<episodeLevels>``, drawn from the stream ``environment/level/<name>`` of the episode's seed.
``options={"level": {"current": 0.15}}`` sets it, and ``{"current": (0.0, 0.3)}`` draws it uniformly
from a range.

A path to a number of the scene or of an updater, as ``--set`` names it, is a parameter, too:
``{"vehicle[bluerov2].hydrodynamics.body[base_link].mass": (12.5, 14.5)}``. A value is that of
``--set``, and a range is a ``<u:uniform>`` of ``<u:vary>`` for the episode. Rows share the scene;
their parameters are the factors of the vehicle in `FACTORS` instead, such as
``{"drag": (0.8, 1.2)}``.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

from ..base.external_values import finite_float
from ..base.rng import stream
from ..benchmark.environment import drawn_values
from ..benchmark.spec import BenchmarkSpec
from ..benchmark.updater_settings import (
    check_same_levels,
    is_updater_path,
    locate_in_benchmark,
)
from ..benchmark.updaters import Level, SceneUpdaterSpec, swept_parameters
from ..errors import BadSetting, did_you_mean, short_repr
from ..runs.planning.plan import Plan
from ..scene.settings import locate, overlaps
from ..scene.variation import Find, UniformSpec, check_variations
from ..schema import Diagnostics

Value = float | tuple[float, float]
"""A value, or the bounds of a range from which it is drawn."""
FACTORS = {
    "mass": "mass",
    "volume": "volume",
    "addedMass": "added_mass",
    "drag": "drag",
    "thrust": "thrust",
    "timeConstant": "time_constant",
}
"""The factors of a vehicle that rows take, with their names in `uwsim.envs.batch`: of the mass with
the moments of inertia, of the displaced volume, the added mass, drag and lift, the thrust of all
thrusters, and the time constants of all actuators."""
MAX_FACTOR = 100.0
"""The greatest factor; a greater one is regarded as a typing error."""
OPTIONS = ("level",)
"""The keys of the options of ``reset``."""


def level_stream(name: str) -> str:
    """Return the name of the random stream of a swept parameter."""
    return f"environment/level/{name}"


def level_values(benchmark: BenchmarkSpec) -> dict[str, tuple[float, ...]]:
    """Return the values of each swept parameter from which an episode is drawn.

    With environments of several vehicles, they are those of any of them.
    """
    selections = [item for spec in benchmark.environments for item in spec.episode_levels]
    return drawn_values(benchmark.scene_updater, selections)


def draw_level(benchmark: BenchmarkSpec, seed: int, choices: Mapping[str, Value]) -> Level:
    """Draw the level of an episode.

    Args:
        benchmark: the benchmark.
        seed: the seed of the episode.
        choices: the values or ranges of swept parameters by name; others are drawn from
            `level_values`.
    """
    values = []
    for name, levels in level_values(benchmark).items():
        rng = stream(seed, level_stream(name))
        choice = choices.get(name)
        if choice is None:
            values.append((name, levels[int(rng.integers(len(levels)))]))
        elif isinstance(choice, tuple):
            low, high = choice
            values.append((name, low + (high - low) * float(rng.random())))
        else:
            values.append((name, choice))
    return Level(tuple(values))


def vary_plan(plan: Plan, choices: Mapping[str, Value]) -> Plan:
    """Return the plan of an episode, with the chosen values and ranges of paths.

    Raises:
        BadSetting: a path leads to no number, or a value is invalid.
    """
    scene, benchmark = plan.scene, plan.benchmark
    for path, value in choices.items():
        if not is_path(path):
            continue
        try:
            if is_updater_path(benchmark, path):
                check = partial(check_same_levels, plan.benchmark)
                benchmark = _vary(benchmark, path, value, locate_in_benchmark, check)
            else:
                scene = _vary(scene, path, value, locate, lambda _: None)
        except BadSetting as error:
            raise BadSetting(f"options['level'][{path!r}]: {error}") from None
    return replace(plan, scene=scene, benchmark=benchmark)


def _vary(
    spec: Any, path: str, value: Value, find: Find, check_bound: Callable[[Any], None]
) -> Any:
    """Return a spec in which a number has a value, or is drawn from a range."""
    location = find(spec, path)
    other_variations = tuple(v for v in spec.vary if not overlaps(find(spec, v.path), location))
    if not isinstance(value, tuple):
        if not location.is_number:
            raise BadSetting(f"it is {location.kind}; expected the path of one number.")
        new_spec = location.with_value(repr(value))
        check_bound(new_spec)
        return replace(new_spec, vary=other_variations)
    low, high = value
    variation = UniformSpec(path=path, low=low, high=high)
    diagnostics = Diagnostics(Path("options"))
    new_spec = replace(spec, vary=(variation,))
    check_variations(new_spec, diagnostics, find=find, check_bound=check_bound)
    for diagnostic in diagnostics.to_list():
        raise BadSetting(diagnostic.message)
    return replace(new_spec, vary=(*other_variations, variation))


def is_path(name: str) -> bool:
    """Return whether the name of a parameter is a path to a number of the scene or an updater."""
    return "." in name


def read_choices(
    updater: SceneUpdaterSpec, options: Mapping[str, Any] | None, *, has_paths: bool = True
) -> dict[str, Value]:
    """Return the values and ranges in the options of ``reset``.

    Args:
        updater: the outermost updater of the benchmark.
        options: the options of ``reset``.
        has_paths: true if parameters may be paths to numbers of the scene.

    Raises:
        BadSetting: a key or a parameter is unknown, or a value is neither a number nor a range.
    """
    options = check_options(options)
    for key in options:
        if key not in OPTIONS:
            raise BadSetting(
                f"options has the key {short_repr(key)}; expected {', '.join(OPTIONS)}."
                f"{did_you_mean(str(key), OPTIONS)}"
            )
    level = options.get("level", {})
    if not isinstance(level, Mapping):
        raise BadSetting(f"options['level'] is {short_repr(level)}; expected a dictionary.")
    names = (*swept_parameters(updater), *(() if has_paths else FACTORS))
    choices: dict[str, Value] = {}
    for name, value in level.items():
        if is_path(str(name)) and not has_paths:
            raise BadSetting(
                f"{short_repr(name)} is a number of the scene, which rows share; expected "
                f"{', '.join(names)}, or stepper='engine'."
            )
        if name not in names and not is_path(str(name)):
            hint = " It is a factor of stepper='rows'." if name in FACTORS else ""
            raise BadSetting(
                f"The benchmark sweeps no parameter {short_repr(name)}."
                f"{hint or did_you_mean(str(name), names)} Known: {', '.join(names)}."
            )
        choices[name] = _read_value(name, value)
        if name in FACTORS and name not in swept_parameters(updater):
            _check_factor(name, choices[name])
    return choices


def check_options(options: Mapping[str, Any] | None) -> Mapping[str, Any]:
    """Return the options of ``reset``; None are none.

    Raises:
        BadSetting: they are no dictionary.
    """
    if options is not None and not isinstance(options, Mapping):
        raise BadSetting(
            f"options is {short_repr(options)}; expected a dictionary, as "
            "options={'level': {'current': 0.2}}."
        )
    return options or {}


def _check_factor(name: str, choice: Value) -> None:
    """Raise BadSetting if a factor is not positive, or is too great."""
    low, high = choice if isinstance(choice, tuple) else (choice, choice)
    if not 0.0 < low <= high <= MAX_FACTOR:
        raise BadSetting(
            f"options['level'][{name!r}] is {choice}; expected a factor above 0, at most "
            f"{MAX_FACTOR:g}."
        )


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
    return (low, high) if low < high else low
