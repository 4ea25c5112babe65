"""What a run is: everything that its bytes depend on, in a file beside them."""

from __future__ import annotations

import json
from typing import Any

from .errors import ManifestError
from .files import Folder

NAME = "_run/manifest.json"


def encode(value: Any) -> bytes:
    """JSON with keys in order, the same bytes for the same value."""
    return (json.dumps(value, indent=1, sort_keys=True, ensure_ascii=False) + "\n").encode()


def read(folder: Folder) -> dict[str, Any] | None:
    """The manifest in a folder, or None where there is none."""
    raw = folder.read(NAME)
    if raw is None:
        return None
    try:
        found = json.loads(raw)
        if not isinstance(found, dict):
            raise ValueError("it is no object")
    except ValueError as error:
        raise ManifestError(
            f"{folder.name}/{NAME} cannot be read ({error}); begin anew with restart=True"
        ) from error
    return found


def settle(folder: Folder, wanted: dict[str, Any]) -> bool:
    """Writes the manifest, or compares with the one that is there; whether an earlier run is gone on with.

    Raises ManifestError where the one that is there is of another run, with all differences.
    """
    known = read(folder)
    fresh = known is None
    if fresh:
        if any(name.startswith("part-") for name in folder.names()):
            raise ManifestError(
                f"{folder.name} has parts of another run and no manifest; give another folder as out"
            )
        folder.put(NAME, encode(wanted))
        # Of several that begin at once the last one has written: all must want the same.
        known = read(folder) or {}
    wanted = json.loads(encode(wanted))
    found = differences(known, wanted)
    if found:
        some = "; ".join(found[:8]) + (f"; and {len(found) - 8} more" if len(found) > 8 else "")
        raise ManifestError(
            f"{folder.name} holds another run: {some}. Go on as then, give another folder as "
            "out, or begin anew with restart=True"
        )
    return not fresh


def differences(then: Any, now: Any, name: str = "") -> list[str]:
    """What differs, in words."""
    if isinstance(then, dict) and isinstance(now, dict):
        found = []
        for key in sorted(then.keys() | now.keys()):
            label = f"{name}.{key}" if name else key
            found += differences(then.get(key), now.get(key), label)
        return found
    if isinstance(then, list) and isinstance(now, list) and len(then) == len(now):
        return [text for i, pair in enumerate(zip(then, now)) for text in differences(*pair, f"{name}[{i}]")]
    return [] if then == now else [f"{name} was {_short(then)} and is {_short(now)} now"]


def _short(value: Any) -> str:
    text = "not given" if value is None else json.dumps(value, ensure_ascii=False)
    return text if len(text) <= 200 else text[:197] + "..."


def forget(folder: Folder) -> None:
    """Removes a run: the manifest last, so that what is left is never taken for whole."""
    for name in folder.names():
        if name.startswith("part-") and name.endswith(".parquet"):
            folder.remove(name)
    for name in folder.names("_run"):
        if name.startswith(("shard-", "bad-", "summary")):
            folder.remove(f"_run/{name}")
    folder.sweep(lambda _: True)
    folder.remove(NAME)
