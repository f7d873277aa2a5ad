"""The seeds of the split ``test``: nobody knows them before a public text exists.

The organiser announces a date. After it, a public text that nobody could choose, such as the
output of a public randomness beacon at that time, gives the seeds.
"""

from __future__ import annotations

import datetime
import hashlib

from ..errors import BadSetting
from .entry import Seeds
from .suite import TEST_SPLIT, Suite

FIRST_TEST_SEED = 2**24
"""The least seed of the split test; public seeds are smaller."""
N_TEST_SEEDS = 2**30
"""The number of possible first seeds."""
GENERATOR = "uwsim-suite-seeds/1"
"""The name of the generator, which is hashed with its inputs."""


def draw_test_seeds(suite: Suite, date: str, beacon: str, count: int) -> Seeds:
    r"""Return the test seeds of a suite.

    The first seed is :math:`2^{24} + (h \bmod 2^{30})`, where h is the number of the first eight
    bytes, big-endian, of the SHA-256 of four lines: the name of the generator, the hash of the
    suite file, the date and the text. The others follow it.

    Args:
        suite: the suite.
        date: the date of the seeds, as 2027-01-01.
        beacon: the public text.
        count: the number of seeds.

    Raises:
        BadSetting: the date is no date, or the text is empty.
    """
    try:
        day = datetime.date.fromisoformat(date)
    except ValueError:
        raise BadSetting(f"--date {date}: expected a date, as 2027-01-01.") from None
    if not beacon.strip():
        raise BadSetting("--beacon: expected the public text of that date.")
    text = "\n".join([GENERATOR, suite.sha256, day.isoformat(), beacon.strip()])
    number = int.from_bytes(hashlib.sha256(text.encode()).digest()[:8], "big")
    first_seed = FIRST_TEST_SEED + number % N_TEST_SEEDS
    return Seeds(
        split=TEST_SPLIT,
        first=first_seed,
        count=count,
        date=day.isoformat(),
        beacon=beacon.strip(),
    )


def public_seeds(suite: Suite, split: str, count: int | None) -> Seeds:
    """Return the first ``count`` seeds of a public split; None for all.

    Raises:
        UnknownName: there is no such split.
        BadSetting: the split has fewer seeds.
    """
    spec = suite.split(split)
    if count is not None and count > spec.count:
        raise BadSetting(f"--seeds {count}: the split {split!r} has {spec.count} seeds.")
    return Seeds(split=split, first=spec.first, count=count or spec.count)
