"""Arguments of the programs of this folder, without ROS."""

import math
import sys


def numbers(words, usage, type=float):
    """Return words as numbers; ends the program with its usage where one is no finite number."""
    return [_number(word, usage, type) for word in words]


def _number(word, usage, type):
    try:
        number = type(word)
        if math.isfinite(number):
            return number
    except ValueError:
        pass
    kind = "whole number" if type is int else "finite number"
    sys.exit(f"{word!r} is no {kind}.\n\n{usage.strip()}")
