"""The shapes of ``result.json``, of journals and of ``provenance.json`` (`shapes`)."""

from __future__ import annotations

from .shapes import any_value, array, cells, fields, integer, items, null_or, number, table, text

_FILE = items(text, text)
_QUAD = null_or(array(number, n=8))
_VALUES_WITH_UNITS = table(items(null_or(number), text))

INPUTS = fields(
    {},
    {
        "benchmark": _FILE,
        "scene": _FILE,
        "assets": table(text),
        "plugins": array(_FILE),
        "algorithm": table(text),
    },
)
RUN = fields(
    {},
    {
        "seed": integer,
        "repeats": integer,
        "mode": text,
        "algorithm": text,
        "clients": array(items(text, text)),
        "parameters": table(any_value),
        "settings": array(items(text, text)),
        "levels": array(items(text, number)),
        "track": items(text, array(text)),
        "compatibility": array(text),
        "timestep": items(number, text),
        "version": text,
        "physics": text,
        "renderer": text,
        "numpy": text,
        "units": items(integer, integer),
        "notes": array(text),
    },
)
RESULT = fields(
    {},
    {
        "inputs": INPUTS,
        "run": RUN,
        "facts": table(any_value),
        "columns": array(fields({}, {"unit": null_or(text), "expression": null_or(text)})),
        "image_streams": array(
            fields({}, {"seed": integer, "topic": text, "level": null_or(array(number))})
        ),
        "pictures": array(fields({}, {"camera": text, "truth": _QUAD, "estimate": _QUAD})),
        "refused": array(fields({}, {"row": integer, "by": text, "what": text, "n": integer})),
        "remarks": array(fields({"row": integer, "text": text})),
    },
)
"""The shape of ``result.json``, as far as `Result` does not check it."""

HEAD = fields({}, {"inputs": INPUTS, "run": RUN, "seed": integer, "levels": array(array(number))})
"""The shape of ``unit`` in the first line of a journal."""
ROW = fields(
    {
        "values": array(number),
        "measures": _VALUES_WITH_UNITS,
        "details": _VALUES_WITH_UNITS,
        "total": null_or(number),
        "status": text,
        "missing": table(text),
        "duration": number,
        "logs": table(array(cells)),
        "log_headers": table(array(text)),
        "pictures": array(
            fields({"camera": text, "file": text, "truth": _QUAD, "estimate": _QUAD})
        ),
    },
    {
        "ended_at": number,
        "fingerprint": text,
        "refused": array(items(text, text, integer)),
        "remarks": array(text),
    },
)
"""The shape of ``row`` in each further line."""
END = fields(
    {
        "facts": table(items(any_value, text)),
        "parameters": table(any_value),
        "streams": array(items(text, integer, text)),
        "notes": array(text),
    },
    {
        "trace": fields(
            {}, {"every": integer, "steps": integer, "parts": array(text), "marks": array(text)}
        )
    },
)
"""The shape of ``end`` in the last line."""

PROVENANCE = fields({}, {"command": array(text), "load": any_value, "packages": table(text)})
"""The shape of ``provenance.json``: the command, and the machine of the run."""
