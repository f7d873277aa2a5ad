"""Limits of the size of logs, which readers check before they allocate memory."""

from __future__ import annotations

MAX_BYTES = 2 * 2**30
"""The greatest size of a log [bytes]."""
MAX_TEXT_BYTES = 256 * 2**20
"""The greatest size of a log as text, which is read as a whole [bytes]."""
MAX_SAMPLES = 5_000_000
"""The greatest number of samples of a series."""
MAX_COLUMNS = 1000
"""The greatest number of columns of a table."""
MAX_LINE = 2**18
"""The longest line of a table [bytes]."""
MAX_DIAGNOSTICS = 100
"""The greatest number of errors that a reader reports about a file."""
MAX_VALUE = 1e12
"""The greatest absolute value of a sample in SI units; a larger value is an error."""
MAX_NAME = 200
"""The longest name of a column or a channel [characters]."""
MAX_COMMAND = 1.01
"""The greatest command of a thruster without a remark: 1, and rounding."""
