"""The manifest of a run: everything that its bytes depend on, in a file beside them."""

from __future__ import annotations

import json
import zlib
from typing import Any

from .errors import ManifestError
from .files import Folder

NAME = "_run/manifest.json"


def encode(value: Any) -> bytes:
    """JSON with keys in order, the same bytes for the same value."""
    return (json.dumps(value, indent=1, sort_keys=True, ensure_ascii=False) + "\n").encode()


def seal(value: dict[str, Any]) -> bytes:
    """JSON as by ``encode``, with a checksum of the rest."""
    return encode(value | {"crc32": f"{zlib.crc32(encode(value)):08x}"})


def unseal(raw: bytes) -> dict[str, Any]:
    """The value of what ``seal`` has made; ValueError where a byte of it is another."""
    found = json.loads(raw)
    if not isinstance(found, dict):
        raise ValueError("it is no object")
    found.pop("crc32", None)
    if seal(found) != raw:
        raise ValueError("its checksum is not that of its content")
    return found


def read(folder: Folder) -> dict[str, Any] | None:
    """The manifest in a folder, or None where there is none."""
    raw = folder.read(NAME)
    if raw is None:
        return None
    try:
        return unseal(raw)
    except ValueError as error:
        raise ManifestError(
            f"{folder.name}/{NAME} cannot be read ({error}): it does not say which files are of the run; give another "
            "folder as out, or remove this one"
        ) from error


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
        folder.put(NAME, seal(wanted))
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
    """The differences, in words."""
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
