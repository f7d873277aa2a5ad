"""Checks of a built site: links lead somewhere, and nothing is loaded from the network."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from urllib.parse import unquote, urlsplit

from lxml import html


def broken_links(site: Path) -> list[str]:
    """Return one line for each link within the site to a page or an anchor that is not there."""
    errors = []
    for page in sorted(site.rglob("*.html")):
        if page.name == "404.html":
            continue
        for target in sorted(set(html.parse(page).getroot().xpath("//a/@href | //img/@src"))):
            parts = urlsplit(target)
            if parts.scheme or parts.netloc:
                continue
            path = (page.parent / unquote(parts.path)).resolve() if parts.path else page
            if not path.exists():
                errors.append(f"{page.relative_to(site)}: {target} is not there")
            elif parts.fragment and unquote(parts.fragment) not in anchors(path):
                errors.append(f"{page.relative_to(site)}: {target} has no such anchor")
    return errors


@cache
def anchors(page: Path) -> frozenset[str]:
    """Return the anchors of a page."""
    if page.suffix != ".html":
        return frozenset()
    root = html.parse(page).getroot()
    return frozenset(root.xpath("//@id")) | frozenset(root.xpath("//a/@name"))


def loaded_from_elsewhere(site: Path) -> list[str]:
    """Return one line for each script, style or image that a page loads from the network."""
    loaded = "//script/@src | //link[@rel='stylesheet']/@href | //img/@src"
    return [
        f"{page.relative_to(site)}: {source} is loaded from the network"
        for page in sorted(site.rglob("*.html"))
        for source in html.parse(page).getroot().xpath(loaded)
        if urlsplit(source).netloc
    ]
