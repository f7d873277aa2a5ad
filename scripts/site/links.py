"""Check a built site: links have targets, and nothing is loaded from the network."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from urllib.parse import unquote, urlsplit

from lxml import html


def broken_links(site: Path) -> list[str]:
    """Return a line for each link within the site to a missing page or anchor."""
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
                errors.append(f"{page.relative_to(site)}: {target} does not exist")
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


def network_sources(site: Path) -> list[str]:
    """Return a line for each script, style or image that a page loads from the network."""
    xpath = "//script/@src | //link[@rel='stylesheet']/@href | //img/@src"
    return [
        f"{page.relative_to(site)}: {source} is loaded from the network"
        for page in sorted(site.rglob("*.html"))
        for source in html.parse(page).getroot().xpath(xpath)
        if urlsplit(source).netloc
    ]
