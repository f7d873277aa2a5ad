"""Parse the arguments of the programs in this folder, without ROS."""

import math
import sys


def parse_numbers(words, usage, type=float):
    """Return words as numbers; exit with the usage if one is not a finite number."""
    return [_parse_number(word, usage, type) for word in words]


def _parse_number(word, usage, type):
    try:
        number = type(word)
        if math.isfinite(number):
            return number
    except ValueError:
        pass
    kind = "whole number" if type is int else "finite number"
    sys.exit(f"{word!r} is not a {kind}.\n\n{usage.strip()}")
