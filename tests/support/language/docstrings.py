"""The rules for the first words of docstrings."""

from __future__ import annotations

import re

from .words import (
    CONJUNCTIONS,
    FIELD_TERMS,
    INTERROGATIVES,
    PREPOSITIONS,
    PRONOUNS,
    THIRD_PERSON,
    VERBS,
    word_class,
    word_set,
)

ARTICLES = word_set("a an the")
DETERMINERS = ARTICLES | word_set("all another any each every no one some several two")
"""Words that begin a noun phrase as an article does."""
STATES = word_set("am are being can could has have having is may might must should was")
"""The finite verbs with which no docstring begins."""
IMPERATIVES = VERBS | word_set("be damp double equal let lower mute near still")
"""Verbs among the words of other classes, with which a docstring of a function may begin."""
PROPER_NOUNS = word_set(
    """axes coordinates data fossen gymnasium indices matrices numba numpy okabe opencv python
    radii vargha vertices von"""
)
"""The proper nouns and irregular plurals, which need no article."""
TRUTH = re.compile(r"\s*True (if|while)\b")
FIRST_WORD = re.compile(r"\S*\w\S*")
WORD = re.compile(r"[A-Za-z]+(?:[-'’][A-Za-z]+)*")


def docstring_fault(owner: str, text: str) -> tuple[str, str] | None:
    """Return the kind of fault of a docstring's first words and its reason, or None.

    A fragment (``Of images.``, ``What it took.``) is of the kind docstring. A noun phrase without
    an article (``Number of images.``) is of the kind article; plurals, names, symbols need none.

    Args:
        owner: procedure (a function that returns nothing), function, property, class or attribute.
        text: the docstring.
    """
    match = FIRST_WORD.search(text)
    if match is None:
        return "docstring", "is empty"
    first_word = match[0].rstrip(",;:.")
    word = first_word.lower()
    if not WORD.fullmatch(first_word) or (len(first_word) == 1 and word != "a"):
        return None  # a symbol, a number or markup
    if owner in ("procedure", "function"):
        has_fault = _is_bad_verb(owner, word)
        return (
            ("docstring", f"begins with {first_word!r}; begin with a verb") if has_fault else None
        )
    if TRUTH.match(text):
        return None  # of a flag, as in Python's and NumPy's documentation
    if _is_fragment(word):
        return "docstring", f"begins with {first_word!r}; begin with an article and a noun"
    if not _begins_noun_phrase(first_word):
        return "article", f"begins with {first_word!r}; begin with an article"
    return None


def _is_bad_verb(owner: str, word: str) -> bool:
    """Return whether a docstring of a function cannot begin with a word."""
    if word in ARTICLES:
        return owner == "procedure"
    if word in IMPERATIVES or word in FIELD_TERMS or (word in THIRD_PERSON and word not in STATES):
        return False
    return word == "have" or word_class(word) is not None


def _is_fragment(word: str) -> bool:
    """Return whether a word of a closed class, other than a determiner, begins a docstring."""
    closed_classes = PREPOSITIONS | INTERROGATIVES | CONJUNCTIONS | PRONOUNS
    return word in STATES or (word in closed_classes and word not in DETERMINERS | {"other"})


def _begins_noun_phrase(first_word: str) -> bool:
    """Return whether a noun phrase may begin with a word, as far as its form shows."""
    word = first_word.lower()
    is_name = (
        any(letter.isupper() for letter in first_word[1:]) or "'" in first_word or "’" in first_word
    )
    is_plural = word.endswith("s") and not word.endswith("ss") and word not in THIRD_PERSON
    return is_name or is_plural or word in DETERMINERS or word in PROPER_NOUNS
