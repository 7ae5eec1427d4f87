"""Writes the notebooks from the texts beside it: paragraphs of Markdown, and code between lines of `%%`."""

import json
from pathlib import Path

HERE = Path(__file__).parent

for source in HERE.glob("*.txt"):
    cells = []
    for at, part in enumerate(source.read_text(encoding="utf-8").split("%%\n")):
        text = part.strip("\n")
        if not text:
            continue
        cell = {"cell_type": "code" if at % 2 else "markdown", "id": f"cell-{at}", "metadata": {}}
        cell["source"] = text.splitlines(keepends=True)
        if at % 2:
            cell |= {"execution_count": None, "outputs": []}
        cells.append(cell)
    kernel = {"display_name": "Python 3", "language": "python", "name": "python3"}
    notebook = {"cells": cells, "metadata": {"kernelspec": kernel}, "nbformat": 4, "nbformat_minor": 5}
    source.with_suffix(".ipynb").write_text(json.dumps(notebook, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
