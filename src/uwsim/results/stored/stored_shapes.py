"""The shapes of ``result.json``, of journals and of ``provenance.json`` (`shapes`)."""

from __future__ import annotations

from .shapes import anything, cells, each, fields, items, maybe, number, table, text, whole

_FILE = items(text, text)
_QUAD = maybe(each(number, n=8))
_MEASURED = table(items(maybe(number), text))

INPUTS = fields(
    {},
    {
        "benchmark": _FILE,
        "scene": _FILE,
        "assets": table(text),
        "plugins": each(_FILE),
        "algorithm": table(text),
    },
)
RUN = fields(
    {},
    {
        "seed": whole,
        "repeats": whole,
        "mode": text,
        "algorithm": text,
        "clients": each(items(text, text)),
        "parameters": table(anything),
        "settings": each(items(text, text)),
        "levels": each(items(text, number)),
        "compatibility": each(text),
        "timestep": items(number, text),
        "version": text,
        "physics": text,
        "renderer": text,
        "numpy": text,
        "units": items(whole, whole),
        "notes": each(text),
    },
)
RESULT = fields(
    {},
    {
        "inputs": INPUTS,
        "run": RUN,
        "facts": table(anything),
        "columns": each(fields({}, {"unit": maybe(text), "expression": maybe(text)})),
        "image_streams": each(
            fields({}, {"seed": whole, "topic": text, "level": maybe(each(number))})
        ),
        "pictures": each(fields({}, {"camera": text, "truth": _QUAD, "estimate": _QUAD})),
        "refused": each(fields({}, {"row": whole, "by": text, "what": text, "n": whole})),
        "remarks": each(fields({"row": whole, "text": text})),
    },
)
"""Of ``result.json``, as far as `Result` does not see to it."""

HEAD = fields({}, {"inputs": INPUTS, "run": RUN, "seed": whole, "levels": each(each(number))})
"""The shape of ``unit`` in the first line of a journal."""
ROW = fields(
    {
        "values": each(number),
        "measures": _MEASURED,
        "details": _MEASURED,
        "total": maybe(number),
        "status": text,
        "missing": table(text),
        "duration": number,
        "logs": table(each(cells)),
        "log_headers": table(each(text)),
        "pictures": each(fields({"camera": text, "file": text, "truth": _QUAD, "estimate": _QUAD})),
    },
    {
        "ended_at": number,
        "fingerprint": text,
        "refused": each(items(text, text, whole)),
        "remarks": each(text),
    },
)
"""The shape of ``row`` in each further line."""
END = fields(
    {
        "facts": table(items(anything, text)),
        "parameters": table(anything),
        "streams": each(items(text, whole, text)),
        "notes": each(text),
    },
    {
        "trace": fields(
            {}, {"every": whole, "steps": whole, "parts": each(text), "marks": each(text)}
        )
    },
)
"""The shape of ``end`` in the last line."""

PROVENANCE = fields({}, {"command": each(text), "load": anything, "packages": table(text)})
"""Of ``provenance.json``: what was typed, and on what it ran."""
