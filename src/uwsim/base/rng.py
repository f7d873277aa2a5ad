"""Named random streams: one seed gives an independent generator for every name."""

from __future__ import annotations

import hashlib

import numpy as np


def stream(seed: int, name: str) -> np.random.Generator:
    """Return the random generator of a name and a seed.

    ``Generator(Philox(SeedSequence([seed, *words])))`` with ``words`` the 16-byte BLAKE2b digest
    of the name as four little-endian uint32. A name is a path such as ``girona500/bowtech1/noise``;
    equal names give equal numbers whatever else draws, and in whatever order.
    """
    digest = hashlib.blake2b(name.encode(), digest_size=16).digest()
    words = np.frombuffer(digest, dtype="<u4").tolist()
    return np.random.Generator(np.random.Philox(np.random.SeedSequence([seed, *words])))
