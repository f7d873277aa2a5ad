"""The rules for the length of sentences."""

from __future__ import annotations

import re
from collections.abc import Iterator
from inspect import cleandoc

MAX_WORDS = 25
"""The number of words above which a sentence is long."""
MAX_WORDS_EVER = 40
"""The number of words that no sentence of a page exceeds."""

FENCE = re.compile(r"^( *)(```+|~~~+).*?^\1\2[^\n]*$", re.MULTILINE | re.DOTALL)
COMMENT = re.compile(r"<!--.*?-->", re.DOTALL)
FORMULA = re.compile(r"\$\$.*?\$\$|\\\[.*?\\\]|\\\(.*?\\\)|\$[^$\n]+\$", re.DOTALL)
CODE = re.compile(r"(`+)[^`]+?\1")
LINK = re.compile(r"!?\[([^\]]*)\]\([^)]*\)|!?\[([^\]]*)\]\[[^\]]*\]")
HTML = re.compile(r"</?[a-zA-Z][^>]*>")
ROLE = re.compile(r":[a-z]+:(?=`)")
ABBREVIATION = re.compile(r"\b(?:e\.g|i\.e|etc|cf|vs|Fig|Eq|Sec|No|approx|al|ca|resp)\.(?=\s)")
END = re.compile(r"(?<=[.!?])[\"')\]*_”’]*\s+(?=[\"'(\[*_“‘]*(?:[A-Z0-9`]|\w+\.\w))")
WORD = re.compile(r"[^\s]*[^\W_][^\s]*")
ITEM = re.compile(r"^\s*(?:[-*+]|\d+[.)])\s+")
BLOCK_START = re.compile(r"^\s*(?:#|\||!!!|\?\?\?|===|:::|---|\+\+\+|\.\. |\[\w*\]: |\{)")


def split_sentences(text: str) -> list[str]:
    """Split a paragraph into sentences; code and formulas are one word item."""
    text = CODE.sub("X", ROLE.sub("", FORMULA.sub("X", text)))
    text = ABBREVIATION.sub(lambda match: match[0][:-1], text)
    return [part for part in END.split(" ".join(text.split())) if part]


def count_words(sentence: str) -> int:
    """Count the words of a sentence; a dash or a sign alone is none."""
    return len(WORD.findall(sentence))


def page_sentences(page: str) -> Iterator[tuple[int, str]]:
    """Yield line number and text of the sentences of a Markdown page.

    Code blocks, tables, headings and comments are left out. An item of a list is a paragraph.
    """
    for pattern in (FENCE, COMMENT):
        page = pattern.sub(lambda match: "\n" * match[0].count("\n"), page)
    for line, paragraph in _paragraphs(page.split("\n")):
        text = HTML.sub("", LINK.sub(lambda match: match[1] or match[2] or "", paragraph))
        for sentence in split_sentences(text):
            yield line, sentence


def _paragraphs(lines: list[str]) -> Iterator[tuple[int, str]]:
    """Yield line number and text of the paragraphs of a page without code blocks."""
    start_line, paragraph_lines = 1, list[str]()
    for number, line in enumerate([*lines, ""], 1):
        starts_item = ITEM.match(line) is not None
        is_blank = not line.strip()
        if (is_blank or starts_item or BLOCK_START.match(line)) and paragraph_lines:
            yield start_line, " ".join(paragraph_lines)
            paragraph_lines = []
        if not is_blank and not BLOCK_START.match(line):
            if not paragraph_lines:
                start_line = number
            paragraph_lines.append(ITEM.sub("", line).strip())


def text_sentences(text: str) -> Iterator[str]:
    """Yield the English sentences of a string of the program.

    A paragraph ends at a blank line or before an indented one. A sentence with many signs is code,
    and left out.
    """
    for paragraph in re.split(r"\n(?=\s|\$|[-*] )", cleandoc(text)):
        for sentence in split_sentences(paragraph):
            words = WORD.findall(sentence)
            if len(words) >= 4 and _is_english(words):
                yield sentence


def _is_english(words: list[str]) -> bool:
    n_alphabetic = sum(word.strip("\"'.,;:()<>[]`-!?").replace("-", "").isalpha() for word in words)
    return n_alphabetic >= 0.75 * len(words)
