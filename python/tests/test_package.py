"""Types, docstrings, pages."""

from __future__ import annotations

import doctest
import importlib
import pkgutil
import re
import subprocess
import sys
from pathlib import Path

import pytest

import coadjoint as ca

PACKAGE = Path(__file__).parents[1]
MODULES = [m.name for m in pkgutil.iter_modules(ca.__path__, "coadjoint.") if m.name != "coadjoint._core"]


@pytest.mark.parametrize("name", ["coadjoint", *MODULES])
def test_docstrings_run(name: str) -> None:
    found = doctest.testmod(importlib.import_module(name), optionflags=doctest.NORMALIZE_WHITESPACE)
    assert found.failed == 0


def test_what_is_public_is_documented() -> None:
    for name in ca.__all__:
        item = getattr(ca, name)
        assert name == "__version__" or item.__doc__, name
        for part, value in vars(item).items() if isinstance(item, type) else []:
            if not part.startswith("_") and (callable(value) or isinstance(value, (property, classmethod))):
                assert value.__doc__, f"{name}.{part}"


def test_the_types_are_those_of_the_extension(tmp_path: Path) -> None:
    # Away from the sources, which hold no extension.
    command = [sys.executable, "-m", "mypy.stubtest", "coadjoint._core"]
    found = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path)
    assert found.returncode == 0, found.stdout + found.stderr


def test_the_package_is_typed() -> None:
    command = [sys.executable, "-m", "mypy", "--config-file", "pyproject.toml", "coadjoint"]
    found = subprocess.run(command, capture_output=True, text=True, cwd=PACKAGE)
    assert found.returncode == 0, found.stdout + found.stderr


def test_types_find_the_mistakes_of_users() -> None:
    """Exactly the lines that say so are mistakes."""
    file = Path(__file__).parent / "typed.py"
    command = [sys.executable, "-m", "mypy", "--strict", "--no-error-summary", "--hide-error-context", str(file)]
    found = subprocess.run(command, capture_output=True, text=True, cwd=file.parent)
    lines = {int(line.split(":")[1]) for line in found.stdout.splitlines() if ": error: " in line}
    expected = {n for n, line in enumerate(file.read_text().splitlines(), 1) if line.endswith("# error")}
    assert lines == expected and expected, found.stdout + found.stderr


def test_the_page_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    page = "README.md"
    text = (PACKAGE / page).read_text()
    blocks = re.findall(r"^```python\n(.*?)^```$", text, re.M | re.S)
    assert blocks
    monkeypatch.chdir(tmp_path)
    names: dict[str, object] = {"__name__": "page"}
    for block in blocks:
        exec(compile(block, page, "exec"), names)
