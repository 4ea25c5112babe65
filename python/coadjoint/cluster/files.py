"""Files by path or by fsspec name: written whole or not at all."""

from __future__ import annotations

import errno
import hashlib
import os
import socket
import tempfile
import uuid
from collections.abc import Callable
from typing import IO, Any

import fsspec
from fsspec.implementations.local import LocalFileSystem

from .errors import InputError

#: Errors that trying again does not mend.
LASTING = {errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EROFS, errno.EACCES, errno.EPERM, errno.ENOTDIR}

#: Writes a file's content.
Fill = Callable[[IO[bytes]], None]

_PIECE = 1 << 20


def absolute(name: str | os.PathLike[str]) -> str:
    """Makes a local path absolute, as workers may stand in another folder; leaves fsspec names alone."""
    if not isinstance(name, (str, os.PathLike)):
        raise InputError(f"{name!r}: the name of a file or a folder is needed")
    name = os.fspath(name)
    return name if "://" in name or "::" in name else os.path.abspath(name).replace(os.sep, "/")


def locate(name: str, options: dict[str, Any] | None = None) -> tuple[Any, str]:
    """The file system that a name belongs to, and the path on it."""
    fs, path = fsspec.core.url_to_fs(name, **(options or {}))
    return fs, path


def below(folder: str, name: str) -> str:
    """The name of something in a folder."""
    return folder.rstrip("/") + "/" + name


class Folder:
    """A folder on any file system. Its files are written whole or not at all."""

    def __init__(self, name: str, options: dict[str, Any] | None = None) -> None:
        self.name = name
        self.fs, self.path = locate(name, options)
        self.local = isinstance(self.fs, LocalFileSystem)

    def at(self, name: str) -> str:
        """The path of a file in it."""
        return below(self.path, name)

    def names(self, folder: str = "") -> list[str]:
        """Names of the files in it, sorted; none where it does not exist."""
        path = self.at(folder) if folder else self.path
        self.fs.invalidate_cache()
        try:
            found = self.fs.ls(path, detail=False)
        except FileNotFoundError:
            return []
        return sorted(entry.rstrip("/").rsplit("/", 1)[-1] for entry in found)

    def size(self, name: str) -> int | None:
        """Bytes of a file, or None where there is none."""
        try:
            return int(self.fs.info(self.at(name))["size"])
        except FileNotFoundError:
            return None

    def read(self, name: str) -> bytes | None:
        """The content of a small file, or None where there is none."""
        self.fs.invalidate_cache()
        try:
            return bytes(self.fs.cat_file(self.at(name)))
        except FileNotFoundError:
            return None

    def read_all(self, names: list[str]) -> list[bytes]:
        """The contents of many small files, at once where the file system can."""
        found = self.fs.cat([self.at(name) for name in names]) if len(names) > 1 else None
        if isinstance(found, dict):
            contents = {path.rsplit("/", 1)[-1]: content for path, content in found.items()}
            return [contents[name.rsplit("/", 1)[-1]] for name in names]
        return [self.fs.cat_file(self.at(name)) for name in names]

    def remove(self, name: str) -> None:
        """Removes a file that may be missing."""
        try:
            self.fs.rm_file(self.at(name))
        except FileNotFoundError:
            pass

    def digest(self, name: str) -> str:
        """SHA-256 of a file."""
        with self.fs.open(self.at(name), "rb") as file:
            return digest(file)

    def write(self, name: str, fill: Fill) -> tuple[int, str]:
        """Writes a file whole or not at all, and returns its bytes and its SHA-256.

        On a local disk it is filled under a passing name in the folder ``_run/partial``, forced to the disk, and
        renamed. Elsewhere it is filled in a temporary file here and put as one object, which other
        machines see when it is complete.
        """
        if self.local:
            return self._rename(name, fill)
        with tempfile.TemporaryDirectory(prefix="coadjoint-") as here:
            passing = os.path.join(here, "whole")
            with open(passing, "wb") as file:
                fill(file)
            with open(passing, "rb") as again:
                found = os.path.getsize(passing), digest(again)
            self.fs.makedirs(os.path.dirname(self.at(name)), exist_ok=True)
            self.fs.put_file(passing, self.at(name))
        return found

    def put(self, name: str, content: bytes) -> tuple[int, str]:
        """Writes a small file whole or not at all."""

        def fill(file: IO[bytes]) -> None:
            file.write(content)

        return self.write(name, fill)

    def _rename(self, name: str, fill: Fill) -> tuple[int, str]:
        target = self.at(name)
        partial = self.at("_run/partial")
        os.makedirs(os.path.dirname(target), exist_ok=True)
        os.makedirs(partial, exist_ok=True)
        unique = f"{socket.gethostname()}-{os.getpid()}-{uuid.uuid4().hex[:8]}"
        passing = below(partial, f"{os.path.basename(name)}.{unique}")
        try:
            with open(passing, "xb") as file:
                fill(file)
                file.flush()
                os.fsync(file.fileno())
            with open(passing, "rb") as again:
                found = os.path.getsize(passing), digest(again)
            os.replace(passing, target)
        except BaseException:
            if os.path.exists(passing):
                os.unlink(passing)
            raise
        # The folder holds the name.
        if hasattr(os, "O_DIRECTORY"):
            folder = os.open(os.path.dirname(target), os.O_RDONLY | os.O_DIRECTORY)
            try:
                os.fsync(folder)
            finally:
                os.close(folder)
        return found

    def sweep(self, of: Callable[[str], bool]) -> None:
        """Removes what killed workers have left of the files that ``of`` names."""
        if not self.local:
            return
        partial = self.at("_run/partial")
        for name in self.names("_run/partial"):
            if of(name.split(".", 2)[0]):
                try:
                    os.unlink(below(partial, name))
                except FileNotFoundError:
                    pass
        try:
            os.rmdir(partial)
        except OSError:
            pass


def digest(file: IO[bytes]) -> str:
    """SHA-256 of what is left of a file."""
    found = hashlib.sha256()
    while piece := file.read(_PIECE):
        found.update(piece)
    return found.hexdigest()


def fingerprint(fs: Any, path: str, size: int, pieces: int) -> str:
    """SHA-256 of a file up to ``pieces`` MiB; of larger ones that many pieces of 1 MiB, the last one among them."""
    found = hashlib.sha256(str(size).encode())
    whole = size <= pieces * _PIECE
    with fs.open(path, "rb") as file:
        for number in range(min(-(-size // _PIECE), pieces)):
            file.seek(number * _PIECE if whole else (size - _PIECE) * number // (pieces - 1))
            found.update(file.read(_PIECE))
    return found.hexdigest()
