"""Convert TeX formulas in HTML, as Python-Markdown's arithmatex writes them, to MathML."""

from __future__ import annotations

import html
import re

from latex2mathml.converter import convert

FORMULA = re.compile(
    r'<(span|div) class="arithmatex">\\([(\[])(.*?)\\[)\]]</(?:span|div)>', re.DOTALL
)
"""The pattern of a formula: element, delimiter (a parenthesis: within a line), and TeX."""


def with_mathml(page: str) -> str:
    """Return the page with every formula as MathML, which browsers render."""

    def replace(match: re.Match[str]) -> str:
        element, delimiter, tex = match.groups()
        display = "inline" if delimiter == "(" else "block"
        mathml = convert(html.unescape(tex).strip(), display=display)
        return f'<{element} class="formula">{mathml}</{element}>'

    return FORMULA.sub(replace, page)
