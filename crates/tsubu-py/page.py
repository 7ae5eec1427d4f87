"""Writes `docs/src/python.md`: the text of `page.md`, and behind it what the package says of itself in its docstrings.

`python3 page.py` writes the page, `python3 page.py --check` says whether it is as it should be. It reads the sources and imports nothing.
"""

from __future__ import annotations

import ast
import inspect
import re
import sys
from pathlib import Path

HERE = Path(__file__).parent
SOURCES = HERE / "python" / "tsubu"
PAGE = HERE.parent.parent / "docs" / "src" / "python.md"

# What the page tells, in the order of use.
TOLD = {
    "_scene": ["Scene", "Verdict", "Line", "template", "templates"],
    "_simulation": ["Simulation", "Grains", "Wall", "Host"],
    "_run": ["load", "Run", "Frames", "Frame"],
    "_studies": ["sweep", "response", "compare", "verify", "report"],
}


def plain(text: str) -> str:
    """A docstring as Markdown: references become code, blocks after `::` are fenced."""
    text = re.sub(r":(?:meth|class|attr|func):`\.?([^`]+)`", r"`\1`", inspect.cleandoc(text))
    return re.sub(r"\s*\n\s*", " ", text) if "\n\n" not in text else text


def signature(function: ast.FunctionDef) -> str:
    """The head of a function without `self`, with what its types are."""
    arguments = function.args
    names = [*arguments.posonlyargs, *arguments.args]
    defaults = [None] * (len(names) - len(arguments.defaults)) + list(arguments.defaults)
    told = [
        argument.arg
        + (f": {ast.unparse(argument.annotation)}" if argument.annotation else "")
        + (f" = {ast.unparse(default)}" if default is not None else "")
        for argument, default in zip(names, defaults)
        if argument.arg != "self"
    ]
    if arguments.vararg:
        told.append(f"*{arguments.vararg.arg}: {ast.unparse(arguments.vararg.annotation)}")
    for argument, default in zip(arguments.kwonlyargs, arguments.kw_defaults):
        told.append(f"{argument.arg}: {ast.unparse(argument.annotation)} = {ast.unparse(default)}")
    back = f" -> {ast.unparse(function.returns)}" if function.returns else ""
    return f"{function.name}({', '.join(told)}){back}"


def is_property(function: ast.FunctionDef) -> bool:
    return any(ast.unparse(d) in ("property", "cached_property") for d in function.decorator_list)


def members(body: list[ast.stmt]) -> list[tuple[str, str]]:
    """Heads and docstrings of what a class has, in the order of its source."""
    found = []
    for at, item in enumerate(body):
        follows = body[at + 1] if at + 1 < len(body) else None
        if isinstance(item, ast.FunctionDef):
            text = ast.get_docstring(item)
            if item.name == "__init__":
                found += [(name.removeprefix("self."), said) for name, said in members(item.body)]
            elif not item.name.startswith("_") and text:
                back = f": {ast.unparse(item.returns)}" if item.returns else ""
                found.append((item.name + back if is_property(item) else signature(item), text))
        elif isinstance(item, (ast.AnnAssign, ast.Assign)) and isinstance(follows, ast.Expr):
            value = follows.value
            if isinstance(value, ast.Constant) and isinstance(value.value, str):
                target = item.target if isinstance(item, ast.AnnAssign) else item.targets[0]
                kind = f": {ast.unparse(item.annotation)}" if isinstance(item, ast.AnnAssign) else ""
                found.append((ast.unparse(target) + kind, value.value))
    return found


def reference() -> str:
    lines = []
    for module, names in TOLD.items():
        tree = ast.parse((SOURCES / f"{module}.py").read_text(encoding="utf-8"))
        items = {item.name: item for item in tree.body if isinstance(item, (ast.ClassDef, ast.FunctionDef))}
        for name in names:
            item = items[name]
            text = plain(ast.get_docstring(item) or "")
            if isinstance(item, ast.FunctionDef):
                lines += [f"### `tsubu.{name}`", "", "```python", signature(item), "```", "", text, ""]
                continue
            lines += [f"### `tsubu.{name}`", "", text, ""]
            for head, said in members(item.body):
                lines += [f"- **`{head}`**  ", *("  " + line if line else "" for line in plain(said).splitlines())]
            lines.append("")
    return "\n".join(lines)


def page() -> str:
    head = (HERE / "page.md").read_text(encoding="utf-8").rstrip()
    return f"{head}\n\n## Everything by name\n\n{reference().rstrip()}\n"


def main() -> None:
    if "--check" not in sys.argv:
        PAGE.write_text(page(), encoding="utf-8")
    elif not PAGE.is_file() or PAGE.read_text(encoding="utf-8") != page():
        sys.exit("error: docs/src/python.md is out of date\nhint: python3 crates/tsubu-py/page.py")


if __name__ == "__main__":
    main()
