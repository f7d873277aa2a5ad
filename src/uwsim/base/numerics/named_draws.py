"""The first numbers of many named random streams at once, bit for bit those of `uwsim.base.rng`.

A stream of numpy costs 19 us to create, and an environment draws a few numbers from a few streams
of a new seed for each episode. Here the first 256 bits of a stream are computed in compiled code,
by the published algorithms of `numpy.random.SeedSequence` (O'Neill's ``seed_seq`` with a fixed
pool of four words) and of Philox4x64-10 (Salmon et al. 2011, "Parallel random numbers: as easy as
1, 2, 3").
"""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from ...errors import BadSetting
from .jit import njit
from .memory import Floats, Ints64

Words = npt.NDArray[np.uint64]
MAX_SEED = 2**63 - 1
"""The greatest seed."""
N_WORDS = 4
"""The number of 64-bit words that are computed of a stream."""

_U = np.uint64
_LOW, _HALF, _SIXTEEN = _U(0xFFFFFFFF), _U(32), _U(16)
_FIRST_A, _FACTOR_A = _U(0x43B0D7E5), _U(0x931E8875)
_FIRST_B, _FACTOR_B = _U(0x8B51F9DD), _U(0x58F38DED)
_MIX_LEFT, _MIX_RIGHT = _U(0xCA01F9DD), _U(0x4973F715)
_ROUND_A, _ROUND_B = _U(0xD2E7470EE14C6C93), _U(0xCA5A826395121157)
_BUMP_A, _BUMP_B = _U(0x9E3779B97F4A7C15), _U(0xBB67AE8584CAA73B)
_N_ROUNDS = 10
_UNIT_SCALE = 1.0 / 9007199254740992.0  # 2**-53


def name_words(names: Sequence[str]) -> Words:
    """Return the words that identify the streams of some names, (k, 4)."""
    digests = [hashlib.blake2b(name.encode(), digest_size=16).digest() for name in names]
    words = np.frombuffer(b"".join(digests), dtype="<u4").astype(np.uint64)
    return words.reshape(len(names), N_WORDS)


def seed_array(seeds: Sequence[int]) -> Ints64:
    """Return seeds as an array, (m,).

    Raises:
        BadSetting: a seed is below 0 or above `MAX_SEED`.
    """
    for seed in seeds:
        if not 0 <= seed <= MAX_SEED:
            raise BadSetting(f"The seed is {seed}; expected 0 to 2^63 - 1.")
    return np.array(seeds, dtype=np.int64)


@njit
def first_words(seeds: Ints64, names: Words) -> Words:
    """Return the first words of streams.

    Args:
        seeds: the seeds, (m,).
        names: the words of the names (`name_words`), (k, 4).

    Returns:
        The words, (m, k, 4).
    """
    words = np.empty((len(seeds), len(names), N_WORDS), np.uint64)
    pool = np.empty(N_WORDS, np.uint64)
    for i in range(len(seeds)):
        for j in range(len(names)):
            _mix_pool(_U(seeds[i]), names[j], pool)
            _write_block(pool, words[i, j])
    return words


@njit
def uniform_of(words: Words) -> float:
    """Return the first number of ``Generator.random`` of a stream with these first words."""
    number: float = float(words[0] >> _U(11)) * _UNIT_SCALE
    return number


@njit
def integer_of(words: Words, n: int) -> int:
    """Return the first number of ``Generator.integers(n)`` of a stream, with n up to 2^32 - 1.

    The method is that of Lemire (2019) without bias; of eight draws at most, the last is taken,
    which numpy would reject with the probability (n / 2^32)^8.
    """
    if n <= 1:
        return 0
    size = _U(n)
    threshold = (_LOW - (size - _U(1))) % size
    product = _U(0)
    for k in range(2 * N_WORDS):
        word = words[k // 2]
        draw = word & _LOW if k % 2 == 0 else word >> _HALF
        product = draw * size
        if product & _LOW >= threshold:
            break
    number: int = np.int64(product >> _HALF)  # type: ignore[assignment]  # numba's integer
    return number


@njit
def uniforms_of(words: Words) -> Floats:
    """Return `uniform_of` for streams with the words (m, 4), (m,)."""
    numbers = np.empty(len(words))
    for i in range(len(words)):
        numbers[i] = uniform_of(words[i])
    return numbers


@njit
def integers_of(words: Words, n: int) -> Ints64:
    """Return `integer_of` for streams with the words (m, 4), (m,)."""
    numbers = np.empty(len(words), np.int64)
    for i in range(len(words)):
        numbers[i] = integer_of(words[i], n)
    return numbers


@njit
def _hash(value: Any, factor: Any) -> Any:
    """Return a word of the pool times a new factor."""
    value = (value * factor) & _LOW
    return value ^ (value >> _SIXTEEN)


@njit
def _mix(x: Any, y: Any) -> Any:
    value = (_MIX_LEFT * x - _MIX_RIGHT * y) & _LOW
    return value ^ (value >> _SIXTEEN)


@njit
def _mix_pool(seed: Any, name: Words, pool: Words) -> None:
    """Mix the words of a seed and of a name to a pool of four words, as ``SeedSequence`` does."""
    entropy = np.empty(6, np.uint64)
    entropy[0], n = seed & _LOW, 1
    if seed >> _HALF != _U(0):
        entropy[1], n = seed >> _HALF, 2
    for i in range(4):
        entropy[n + i] = name[i]
    n += 4
    factor = _FIRST_A
    for i in range(4):
        value = entropy[i] ^ factor
        factor = (factor * _FACTOR_A) & _LOW
        pool[i] = _hash(value, factor)
    for source in range(4):
        for target in range(4):
            if source != target:
                value = pool[source] ^ factor
                factor = (factor * _FACTOR_A) & _LOW
                pool[target] = _mix(pool[target], _hash(value, factor))
    for source in range(4, n):
        for target in range(4):
            value = entropy[source] ^ factor
            factor = (factor * _FACTOR_A) & _LOW
            pool[target] = _mix(pool[target], _hash(value, factor))


@njit
def _write_block(pool: Words, block: Words) -> None:
    """Write the first block of the Philox generator that a pool seeds, (4,)."""
    state, factor = np.empty(4, np.uint64), _FIRST_B
    for i in range(4):
        value = pool[i] ^ factor
        factor = (factor * _FACTOR_B) & _LOW
        state[i] = _hash(value, factor)
    a, b = state[0] | (state[1] << _HALF), state[2] | (state[3] << _HALF)
    x, y, z, w = _U(1), _U(0), _U(0), _U(0)  # the counter of the first block
    for i in range(_N_ROUNDS):
        if i > 0:
            a, b = a + _BUMP_A, b + _BUMP_B
        p, q = _high_product(_ROUND_A, x), _high_product(_ROUND_B, z)
        x, y, z, w = q ^ y ^ a, _ROUND_B * z, p ^ w ^ b, _ROUND_A * x
    block[0], block[1], block[2], block[3] = x, y, z, w


@njit
def _high_product(x: Any, y: Any) -> Any:
    """Return the upper 64 bits of a product."""
    a, b, c, d = x & _LOW, x >> _HALF, y & _LOW, y >> _HALF
    low = a * c
    middle = b * c + (low >> _HALF)
    other = a * d + (middle & _LOW)
    return b * d + (middle >> _HALF) + (other >> _HALF)
