"""How things look in a notebook."""

from __future__ import annotations

from collections.abc import Iterable
from html import escape

CELL = "text-align:left;padding:2px 12px 2px 0;vertical-align:top"


def table(rows: Iterable[Iterable[object]], title: str = "") -> str:
    """Rows of cells; what is in them is text, never markup."""
    body = "".join(
        "<tr>" + "".join(f'<td style="{CELL}">{escape(str(cell))}</td>' for cell in row) + "</tr>" for row in rows
    )
    head = f"<b>{escape(title)}</b>" if title else ""
    return f"<div>{head}<table>{body}</table></div>"


def text(content: str, title: str = "") -> str:
    """A text as it stands."""
    head = f"<b>{escape(title)}</b>" if title else ""
    return f"<div>{head}<pre>{escape(content)}</pre></div>"


def number(value: object) -> str:
    """A number with as many digits as a reader wants."""
    return f"{value:.6g}" if isinstance(value, float) else str(value)
