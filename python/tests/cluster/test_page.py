"""The snippets of the manual's chapter, one after the other."""

import importlib.util
import re
from pathlib import Path

import support

PAGE = Path(__file__).parents[3] / "docs" / "book" / "src" / "cluster-python.md"


def test_the_page_runs(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    support.write(tmp_path / "states.parquet", support.momenta(1000))
    names = {}
    found = re.findall(r"(?:<!-- needs: (\w+) -->\n)?```python\n(.*?)```", PAGE.read_text(), re.DOTALL)
    assert len(found) == 6
    for needs, block in found:
        if not needs or importlib.util.find_spec(needs):
            exec(compile(block, str(PAGE), "exec"), names)
    assert names["end"].num_rows == 1000
    assert "1000/1000" in capsys.readouterr().out
