"""Names of a TypeScript module, found by regular expressions."""

from __future__ import annotations

import re

from .syntax import Name
from .words import word_set

COMMENT = re.compile(r"/\*.*?\*/|(?<![:\"'`])//[^\n]*", re.DOTALL)
STRING = re.compile(r"\"(?:\\.|[^\"\\\n])*\"|'(?:\\.|[^'\\\n])*'|`(?:\\.|[^`\\])*`", re.DOTALL)
CLASS = re.compile(r"\b(?:class|interface|type|enum)\s+([A-Za-z_$]\w*)")
FUNCTION = re.compile(r"\bfunction\*?\s+([A-Za-z_$]\w*)\s*(?:<[^>(]*>)?\(([^)]*)\)")
METHOD = re.compile(
    r"^[ \t]+(?:(?:async|static|private|protected|public|override|get|set)[ \t]+|\*)*"
    r"(#?[A-Za-z_$]\w*)\??[ \t]*(?:<[^>(]*>)?"
    r"\(([^()]*(?:\([^()]*\)[^()]*)*)\)[ \t]*(?::[^{;=]+;|(?::[^{;=]+)?\{)",
    re.MULTILINE,
)
VARIABLE = re.compile(
    r"\b(const|let|var)\s+([A-Za-z_$]\w*)(\s*=\s*(?:async\s*)?(?:\([^()]*\)[^=;{]*|\w+\s*)=>)?"
)
DESTRUCTURING = re.compile(r"\b(?:const|let|var)\s+[\[{]([^\]}=]*)[\]}]\s*(?:=|of)")
ARROW = re.compile(r"\(([^()]*)\)\s*(?::\s*[\w<>\[\]| ]+)?=>|\b([A-Za-z_$]\w*)\s*=>")
FIELD = re.compile(
    r"^[ \t]+(?:(?:private|protected|public|readonly|static|declare)[ \t]+)*"
    r"(#?[A-Za-z_$]\w*)[?!]?(?::[^,\n]*;|[ \t]*=[^=>][^\n]*;)[ \t]*$",
    re.MULTILINE,
)
PARAMETER = re.compile(
    r"(?:^|,)\s*(?:(?:private|protected|public|readonly)\s+)*(?:\.\.\.)?([A-Za-z_$]\w*)\??\s*(?=[:,=]|$)"
)
INTERFACE = re.compile(r"\binterface\s+\w+[^{]*\{[^{}]*(?:\{[^{}]*\}[^{}]*)*\}", re.DOTALL)
KEYWORDS = word_set(
    "catch constructor do else for function if new return super switch throw typeof while with"
)


def read_typescript(source: str) -> list[Name]:
    """Collect the names that a TypeScript module binds, each once for each kind."""
    source = COMMENT.sub(lambda match: "\n" * match[0].count("\n"), source)
    source = STRING.sub(lambda match: "''" + "\n" * match[0].count("\n"), source)
    names: dict[tuple[str, str], Name] = {}
    keys = INTERFACE.sub(lambda match: "\n" * match[0].count("\n"), source)

    def bind(kind: str, name: str, position: int) -> None:
        line = source.count("\n", 0, position) + 1
        names.setdefault((kind, name), Name(kind, line, name.lstrip("#$"), ""))

    def bind_parameters(parameters: str, position: int) -> None:
        for parameter in PARAMETER.finditer(parameters):
            bind("variable", parameter[1], position)

    for match in CLASS.finditer(source):
        bind("class", match[1], match.start(1))
    for match in (*FUNCTION.finditer(source), *METHOD.finditer(source)):
        if match[1] == "constructor" or match[1] not in KEYWORDS:
            bind_parameters(match[2], match.start(1))
        if match[1] not in KEYWORDS:
            bind("function", match[1], match.start(1))
    for match in VARIABLE.finditer(source):
        kind = "function" if match[3] else "constant" if match[2].isupper() else "variable"
        bind(kind, match[2], match.start(2))
    for match in DESTRUCTURING.finditer(source):
        for part in match[1].split(","):
            bind("variable", part.rpartition(":")[2].strip(" .\n\t"), match.start(1))
    for match in ARROW.finditer(source):
        bind_parameters(match[1] or match[2] or "", match.start())
    for match in FIELD.finditer(keys):  # members of interfaces are keys of messages and files
        bind("variable", match[1], match.start(1))
    return [name for name in names.values() if name.name.isidentifier()]
