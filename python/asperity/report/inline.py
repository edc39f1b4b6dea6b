"""Pictures inside of a page: SVG without what belongs to a file of its own."""

import re
from html import escape

_HEAD = re.compile(r"<\?xml.*?\?>|<!DOCTYPE.*?>|<metadata>.*?</metadata>", re.DOTALL)
_STYLE = re.compile(r"<defs>\s*<style.*?</style>\s*</defs>", re.DOTALL)
_SIZE = re.compile(r'\s(?:width|height)="[\d.]+pt"|\sversion="1.1"')
_NAMED = re.compile(r'(\bid="|url\(#|href="#)')


def inline_svg(picture: bytes, name: str, text: str) -> str:
    """The picture as an element of a page. `name` keeps its ids from those of others, and `text` is
    read out in its place."""
    svg = _STYLE.sub("", _HEAD.sub("", picture.decode()))  # the page has that style
    svg = _NAMED.sub(rf"\g<1>{name}-", svg).strip()
    head, end, rest = svg.partition(">")
    head = _SIZE.sub("", head)  # the viewBox stays, the page says how wide
    return f'{head} role="img" aria-label="{escape(text)}"{end}{rest}'
