"""What the seeds of rows draw at the beginning of episodes: levels, variations, starts.

The values are those of `levels.draw_level` and of `scene.variation.draw` for the same seeds. Which
numbers vary is found once, and the random streams of all rows are computed together, so that a row
costs a few microseconds.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ...base.geometry import Array
from ...base.numerics.memory import Floats
from ...base.numerics.named_draws import (
    Words,
    first_words,
    integers_of,
    name_words,
    seed_array,
    uniforms_of,
)
from ...benchmark.updater_settings import locate_in_benchmark
from ...benchmark.updaters import Level
from ...runs.planning.plan import Plan
from ...scene.settings import ValueLocation, locate
from ...scene.variation import VariationSpec, value_at, vary_stream
from ..levels import FACTORS, Value, level_stream, level_values
from ..row_task import start_paths


@dataclass(frozen=True, eq=False, kw_only=True)
class Draws:
    """The values that the seeds of some rows draw."""

    levels: Mapping[str, Floats]
    """The value of each swept parameter, (m,)."""
    variations: Mapping[str, Floats]
    """The value of each varied number by its path, (m,)."""
    factors: Mapping[str, Floats]
    """The value of each factor of the vehicle that was chosen, by its name in `FACTORS`, (m,)."""
    starts: Floats
    """The position of the vehicle in L [m], and its angles, ``Rx Ry Rz`` [rad], (m, 6)."""

    def level(self, i: int) -> Level:
        """Return the level of one of the rows."""
        return Level(tuple((name, float(values[i])) for name, values in self.levels.items()))


class EpisodeDraws:
    """The numbers of a benchmark that a seed draws.

    Args:
        plan: the plan of the benchmark.
        vehicle: the index of the vehicle in the scene.
    """

    def __init__(self, plan: Plan, vehicle: int) -> None:
        self._parameters = list(level_values(plan.benchmark).items())
        self._variations = [*_locations(plan)]
        names = [level_stream(name) for name, _ in self._parameters]
        names += [vary_stream(location) for _, location in self._variations]
        self._names: Words = name_words(names)
        self.factors = [name for name in FACTORS if name not in dict(self._parameters)]
        """The names of the factors of the vehicle."""
        self._factor_names: Words = name_words([level_stream(name) for name in self.factors])
        spec = plan.scene.vehicles[vehicle]
        self._start: Array = np.array([*spec.position, *spec.orientation])
        self._start_paths = start_paths(spec.name)

    def draw(self, seeds: Sequence[int], choices: Mapping[str, Value]) -> Draws:
        """Draw the values of new episodes.

        Args:
            seeds: the seeds of the episodes, (m,).
            choices: the values or ranges of swept parameters and of factors by name, as for
                `draw_level`.

        Raises:
            BadSetting: a seed is invalid.
        """
        words = first_words(seed_array(seeds), self._names)
        levels = {
            name: _draw_parameter(values, choices.get(name), words[:, i])
            for i, (name, values) in enumerate(self._parameters)
        }
        starts = np.repeat(self._start[None], len(seeds), axis=0)
        variations: dict[str, Floats] = {}
        for i, (variation, location) in enumerate(self._variations, len(self._parameters)):
            shares = uniforms_of(words[:, i]).tolist()
            values = np.array([value_at(variation, location.is_integer, s) for s in shares])
            variations[location.path] = values
            if location.path in self._start_paths:
                starts[:, self._start_paths.index(location.path)] = values
        factors = self._draw_factors(seeds, choices)
        return Draws(levels=levels, variations=variations, factors=factors, starts=starts)

    def _draw_factors(
        self, seeds: Sequence[int], choices: Mapping[str, Value]
    ) -> dict[str, Floats]:
        """Draw the chosen factors of the vehicle."""
        if not any(name in choices for name in self.factors):
            return {}
        words = first_words(seed_array(seeds), self._factor_names)
        return {
            name: _draw_number(choices[name], words[:, i])
            for i, name in enumerate(self.factors)
            if name in choices
        }


def _locations(plan: Plan) -> list[tuple[VariationSpec, ValueLocation]]:
    """Return the variations of the scene, then of the benchmark, with their locations."""
    scene, benchmark = plan.scene, plan.benchmark
    return [
        *((variation, locate(scene, variation.path)) for variation in scene.vary),
        *((item, locate_in_benchmark(benchmark, item.path)) for item in benchmark.vary),
    ]


def _draw_parameter(levels: Sequence[float], choice: Value | None, words: Words) -> Floats:
    """Return the values of a swept parameter for the first words of streams, (m,)."""
    if choice is None:
        values: Floats = np.array(levels)
        drawn_values: Floats = values[integers_of(words, len(values))]
        return drawn_values
    return _draw_number(choice, words)


def _draw_number(choice: Value, words: Words) -> Floats:
    """Return a value, or uniform draws from a range, for the first words of streams, (m,)."""
    if isinstance(choice, tuple):
        low, high = choice
        numbers: Floats = low + (high - low) * uniforms_of(words)
        return numbers
    return np.full(len(words), choice)
