"""Plots in the style of the report."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from tsubu import _tables, _tsubu

if TYPE_CHECKING:
    from tsubu._run import Run

COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#7a5195", "#6b6b6b"]
INK, FAINT, AXIS = "#24292f", "#e3e6ea", "#6e7781"
STYLE = {
    "axes.edgecolor": AXIS,
    "axes.grid": True,
    "axes.labelcolor": INK,
    "axes.spines.right": False,
    "axes.spines.top": False,
    "axes.titlecolor": INK,
    "figure.facecolor": "white",
    "font.size": 10.0,
    "grid.color": FAINT,
    "legend.frameon": False,
    "lines.linewidth": 1.5,
    "xtick.color": AXIS,
    "ytick.color": AXIS,
}


def run(run: Run, columns: Sequence[str], ax: Any) -> Any:
    """Curves of a run against time, or of a response against frequency."""
    matplotlib = _tables.need("matplotlib", "plots")
    import matplotlib.pyplot as pyplot
    from cycler import cycler

    if (run.folder / "history.csv").is_file():
        table, x = run.history, "time"
    elif "response" in run.tables:
        table, x = run.tables["response"], "frequency"
        columns = columns or ["rms displacement"]
    else:
        raise _tsubu.Error(f"error: {run.folder} has neither a history nor a response to draw")
    units = table.attrs["units"]
    if not columns:
        columns = [name for name in table.columns if name.endswith(" energy") and table[name].abs().max() > 0]
    lost = [name for name in columns if name not in table.columns]
    if lost:
        raise _tsubu.Error(f"error: there is no column `{lost[0]}`\nhint: there are {', '.join(table.columns)}")
    with matplotlib.rc_context({**STYLE, "axes.prop_cycle": cycler(color=COLOURS)}):
        if ax is None:
            _, ax = pyplot.subplots(figsize=(7, 4), layout="constrained")
        cases: list[tuple[Any, Any]] = [(None, table)]
        if x == "frequency" and "case" in table.columns:
            cases = list(table.groupby("case", sort=False))
        for case, rows in cases:
            for name in columns:
                label = name if case is None else f"{case}" + (f" {name}" if len(columns) > 1 else "")
                ax.plot(rows[x], rows[name], label=label)
        ax.set_xlabel(f"{x} [{units[x]}]")
        shared = {units.get(name, "-") for name in columns}
        unit = f" [{shared.pop()}]" if len(shared) == 1 else ""
        ax.set_ylabel((columns[0] if len(columns) == 1 else "energy" if not lost and unit == " [J]" else "") + unit)
        if len(columns) > 1 or len(cases) > 1:
            ax.legend(fontsize="small")
    return ax
