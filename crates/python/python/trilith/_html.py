"""What notebooks show."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ._result import Result

#: Outputs that are drawn.
DRAWN = 4
#: Width of a figure beside another.
WIDTH = "min(100%, 30em)"


def table(head: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    """A table; texts to the left."""
    cells = "".join(f"<th>{escape(h)}</th>" for h in head)
    out = [f"<table><thead><tr>{cells}</tr></thead><tbody>"]
    for row in rows:
        out.append("<tr>")
        for cell in row:
            if isinstance(cell, float):
                out.append(f'<td style="text-align:right">{shown(cell)}</td>')
            else:
                out.append(f'<td style="text-align:left">{escape(str(cell))}</td>')
        out.append("</tr>")
    out.append("</tbody></table>")
    return "".join(out)


def shown(x: float) -> str:
    """A number with five digits."""
    return "–" if x != x else f"{x:.5g}"


def figures(svgs: Iterable[str]) -> str:
    """Figures beside each other."""
    one = '<div style="display:inline-block;width:{};vertical-align:top">{}</div>'
    return "".join(one.format(WIDTH, svg) for svg in svgs)


def result(r: Result) -> str:
    """Peaks, and the most telling figures."""
    title = r.summary["model"]["title"] or "run"
    parts = [
        f"<p><b>{escape(title)}</b> · case {escape(r.case)} · {escape(r.solver)} · "
        f"{escape(r.message if not r.good else r.status)}</p>"
    ]
    head = ["output", "unit", "max", "at s", "min", "at s", "final", "±"]
    parts.append(
        table(
            head,
            (
                (n, p.unit, p.max, p.t_max, p.min, p.t_min, p.final, p.error)
                for n, p in r.peaks.items()
            ),
        )
    )
    parts += [f"<p>⚠ {escape(w)}</p>" for w in r.warnings]
    if len(r.t) > 1:
        from ._native import pictures

        data = r._of(())
        links = sorted(r.links, key=lambda n: -max(map(abs, map(r.links[n].work, r.links[n].coordinates))))
        names = [*list(r)[:DRAWN], "energy", *links[:1]]
        parts.append(figures(svg for _, svg in pictures(data, names)))
    return "".join(parts)
