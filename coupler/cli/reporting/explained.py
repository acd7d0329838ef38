# SPDX-License-Identifier: GPL-3.0-or-later
"""Warnings of a run with the section of the documentation that explains them, which they name: (docs/PAGE.md, HEADING)."""
import pathlib
import re
from html import escape

HERE = pathlib.Path(__file__).resolve()
# In the tree, and in an installation: share/demvof/reporting beside share/doc/demvof.
PLACES = [HERE.parents[3] / "docs", HERE.parents[2] / "doc" / "demvof" / "docs"]
REFERENCE = re.compile(r" \(docs/(\w+)\.md, ([^)]+)\)$")


def html(warnings):
    """A list of the warnings; each unfolds what its section says, as far as the documentation is installed."""
    return "<ul class=\"warnings\">" + "".join(f"<li>{one(warning)}</li>" for warning in warnings) + "</ul>"


def one(warning):
    named = REFERENCE.search(warning)
    if not named:
        return escape(warning)
    page, heading = named.groups()
    said = escape(warning[:named.start()])
    where = f"<p class=\"quiet\">docs/{page}.md, {escape(heading)}</p>"
    return f"<details><summary>{said}</summary>{paragraphs(section(page, heading))}{where}</details>"


def section(page, heading):
    """The text below a heading of a page of the documentation; empty if it is not to be found."""
    for place in PLACES:
        try:
            text = (place / f"{page}.md").read_text(encoding="utf-8")
        except OSError:
            continue
        parts = re.split(r"^#+ (.*)\n", text, flags=re.MULTILINE)
        return dict(zip(parts[1::2], parts[2::2])).get(heading, "").strip()
    return ""


def paragraphs(text):
    """Paragraphs of Markdown with `code` and links, of which the words remain."""
    text = re.sub(r"\[([^]]+)\]\([^)]+\)", r"\1", escape(text))
    text = re.sub(r"`([^`]+)`", r"<code>\1</code>", text)
    return "".join(f"<p>{part}</p>" for part in re.split(r"\n\s*\n", text) if part)
