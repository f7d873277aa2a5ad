"""Random numbers in compiled code are numpy's, of the same generator."""

from __future__ import annotations

from typing import Any

import numpy as np

from uwsim.base import rng
from uwsim.base.numerics.draws import STREAM, normal, stream_of, uniform
from uwsim.base.numerics.jit import njit
from uwsim.base.record import GeneratorState


@njit
def fill(streams: Any, normals: np.ndarray, uniforms: np.ndarray) -> None:
    for i in range(len(normals)):
        normals[i] = normal(streams[0])
    for i in range(len(uniforms)):
        uniforms[i] = uniform(streams[0])


def drawn(generator: np.random.Generator, n: int) -> tuple[np.ndarray, np.ndarray]:
    """Normal numbers, then uniform ones, drawn from a generator in compiled code."""
    streams, normals, uniforms = np.zeros(1, STREAM), np.empty(n), np.empty(n)
    streams[0] = stream_of(generator)
    fill(streams, normals, uniforms)
    return normals, uniforms


def test_a_million_draws_have_the_bytes_of_numpys() -> None:
    """All parts of the ziggurat occur: its tail about 260 times, its layers' edges 7000 times."""
    generator, other = rng.stream(1, "a"), rng.stream(1, "a")
    normals, uniforms = drawn(generator, 1_000_000)
    assert normals.tobytes() == other.standard_normal(1_000_000).tobytes()
    assert uniforms.tobytes() == other.random(1_000_000).tobytes()
    assert np.abs(normals).max() > 4.5


def test_the_generator_goes_on_in_python_where_compiled_code_has_stopped() -> None:
    generator, other = rng.stream(2, "a"), rng.stream(2, "a")
    for n in (1, 2, 3, 4, 5):
        drawn(generator, n)
        other.standard_normal(n), other.random(n)
        assert GeneratorState.from_generator(generator) == GeneratorState.from_generator(other)
    assert generator.integers(1 << 40) == other.integers(1 << 40)
    then = GeneratorState.from_generator(generator)
    first = drawn(generator, 10)[0]
    then.set(generator)
    assert drawn(generator, 10)[0].tobytes() == first.tobytes()
