"""The package: the program that comes with it, its page of the book, its notebooks."""

import ast
import inspect
import os
import subprocess
import sys
from importlib import metadata
from pathlib import Path

import pytest

import tsubu
from tsubu import _tsubu

HERE = Path(__file__).parent.parent
NOTEBOOKS = sorted((HERE / "notebooks").glob("*.ipynb"))


def test_the_program_is_there():
    program = Path(sys.executable).with_name("tsubu")
    if not program.exists():
        pytest.skip("the package is not installed here")
    told = subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout
    assert told == f"tsubu {tsubu.__version__}\n"
    assert metadata.version("tsubu") == tsubu.__version__
    wrong = subprocess.run([program, "run", "no-such.toml"], capture_output=True, text=True, check=False)
    assert wrong.returncode == 2 and "no-such.toml" in wrong.stderr


def test_importing_needs_no_more_than_numpy():
    code = "import sys, tsubu; print({'pandas', 'matplotlib', 'xarray', 'pyvista'} & set(sys.modules))"
    told = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout
    assert told == "set()\n"


def test_everything_public_has_a_docstring():
    bare = []
    for name in tsubu.__all__:
        thing = getattr(tsubu, name)
        if not name.startswith("__") and not inspect.getdoc(thing):
            bare.append(name)
        if inspect.isclass(thing) and thing.__module__.startswith("tsubu"):
            members = {key: value for key, value in vars(thing).items() if not key.startswith("_")}
            bare += [f"{name}.{key}" for key, value in members.items() if callable(value) and not inspect.getdoc(value)]
    assert not bare


def test_stubs_and_module_agree():
    """What the stub of the compiled module names is there, and what is there is named."""
    tree = ast.parse((HERE / "python/tsubu/_tsubu.pyi").read_text())
    for item in tree.body:
        if isinstance(item, (ast.FunctionDef, ast.ClassDef)):
            thing = getattr(_tsubu, item.name)
        if isinstance(item, ast.ClassDef) and item.name != "Error":
            named = {
                member.name if isinstance(member, ast.FunctionDef) else member.target.id
                for member in item.body
                if isinstance(member, (ast.FunctionDef, ast.AnnAssign))
            }
            there = {name for name in vars(thing) if not name.startswith("_")}
            assert named == there
    functions = {item.name for item in tree.body if isinstance(item, (ast.FunctionDef, ast.ClassDef))}
    assert functions == {name for name in vars(_tsubu) if not name.startswith("_") and name != "Lease"}


def test_the_page_of_the_book_is_made_of_the_docstrings():
    subprocess.run([sys.executable, HERE / "page.py", "--check"], check=True)


@pytest.mark.parametrize("notebook", NOTEBOOKS, ids=lambda path: path.stem)
def test_notebooks_run_to_their_last_cell(notebook, tmp_path):
    nbformat = pytest.importorskip("nbformat")
    nbclient = pytest.importorskip("nbclient")
    cells = nbformat.read(notebook, as_version=4)
    client = nbclient.NotebookClient(cells, timeout=600, kernel_name="python3", resources={"metadata": {"path": str(tmp_path)}})
    os.environ["MPLBACKEND"] = "module://matplotlib_inline.backend_inline"
    client.execute()
    code = [cell for cell in cells.cells if cell.cell_type == "code"]
    assert len(code) >= 5 and all(cell.execution_count for cell in code)


def test_there_are_three_notebooks():
    assert [path.stem for path in NOTEBOOKS] == ["bedload", "damper", "silo"]
