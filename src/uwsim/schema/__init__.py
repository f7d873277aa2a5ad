r"""Reading and writing of dataclasses as XML, with all errors of a file reported at once.

.. code-block:: xml

    <rangeSensor> <name>sonar</name> <relativeTo>part0</relativeTo> <range>10</range> </rangeSensor>

A frozen dataclass, called a spec, is the grammar of an element. Each field is a child element
(``relative_to`` is ``<relativeTo>`` unless `element` gives another name); its annotation gives the
type, its documentation string the meaning and, in brackets, the unit:

=========================  ====================================================================
annotation                 in the file
=========================  ====================================================================
``str``                    text, trimmed
``float``                  a number up to 1e9, or ``M_PI``, ``-M_PI_2`` ...; never NaN
``int``                    a whole number; ``320.5`` is read as 320 with a warning, as by ``atoi``
``bool``                   0 or 1 (attributes: true or false); else the default, with a warning
``Literal["a", "b"]``      one of the words
``tuple[float, x3]``       three elements, ``parts="xyz"`` (or ``rpy``, ``rgb``)
a dataclass                an element that is filled from its own fields
`Numbers`                  numbers in one text, separated by blanks; `TwoNumbers`: two
``tuple[T, ...]``          the element any number of times, or with ``item=`` one list of items
``tuple[Base, ...]``       with ``choice=TABLE``: an element whose children the table names
``T | None``               may be absent
=========================  ====================================================================

Elements may be in any order. Elements without a namespace are those of UWSim (C++), which this
package calls the original; the elements of this simulator, its extensions, are in the namespace
``urn:uwsim:1``. DTDs are not loaded, entities not expanded, the network not used. In strict mode
`Diagnostics` also reports elements that are not in the order of the fields.
"""

from .declaration import CLAMPED_NUMBER, REQUIRED_BY_DTD, Limits, Original, element
from .diagnostics import MAX_DIAGNOSTICS, Diagnostics, diagnostic_at
from .document import MAX_BYTES, MAX_DEPTH, MAX_NODES, Document, Expansion, check_head, parse
from .grammar import (
    MAX_DISTANCE,
    MAX_NUMBER,
    Field,
    Numbers,
    TwoNumbers,
    camel_case,
    field_docs,
    fields_of,
)
from .names import NAMESPACE, advice, format_tag, quote
from .reading import read, read_choice, read_text
from .source_line import SourceLine, Spec, line_of, source_line
from .values import TOKENS, parse_number
from .writing import fill_element, uses_extensions, write, write_value

__all__ = [
    "CLAMPED_NUMBER",
    "MAX_BYTES",
    "MAX_DEPTH",
    "MAX_DIAGNOSTICS",
    "MAX_DISTANCE",
    "MAX_NODES",
    "MAX_NUMBER",
    "NAMESPACE",
    "REQUIRED_BY_DTD",
    "TOKENS",
    "Diagnostics",
    "Document",
    "Expansion",
    "Field",
    "Limits",
    "Numbers",
    "Original",
    "SourceLine",
    "Spec",
    "TwoNumbers",
    "advice",
    "camel_case",
    "check_head",
    "diagnostic_at",
    "element",
    "field_docs",
    "fields_of",
    "fill_element",
    "format_tag",
    "line_of",
    "parse",
    "parse_number",
    "quote",
    "read",
    "read_choice",
    "read_text",
    "source_line",
    "uses_extensions",
    "write",
    "write_value",
]
