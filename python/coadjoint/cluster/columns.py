"""Which columns of a file are the state: ``mu_1`` … ``mu_n``, and the attitude if there is one."""

from __future__ import annotations

from collections.abc import Sequence

from .errors import InputError

_QUATERNION = ["q_w", "q_x", "q_y", "q_z"]


def choose(available: Sequence[str] | int, layouts: Sequence[Sequence[str]]) -> list[str]:
    """The columns of a state among those of a file, in the order in which the steps want them.

    ``layouts`` are what the system takes: momenta alone, with matrices, and with quaternions where these name elements.
    A file without names has a width, which says what it holds.
    """
    momentum, with_matrix, *with_quaternion = map(list, layouts)
    dimension = len(momentum)
    matrix = with_matrix[dimension:]
    if isinstance(available, int):
        for layout in layouts:
            if len(layout) == available:
                return list(layout)
        widths = " or ".join(str(len(layout)) for layout in layouts)
        raise InputError(
            f"the array has {available} columns; this system needs {widths}: {dimension} for the momentum "
            "alone, more with the attitude"
        )
    for name in available:
        index = name[3:] if name.startswith("mu_") else ""
        if index.isdigit() and not 1 <= int(index) <= dimension:
            raise InputError(
                f"column {name}: the momentum of this system has the coordinates mu_1 … mu_{dimension}; take it out "
                "or give it another name"
            )
    some_matrix = [name for name in matrix if name in available]
    some_quaternion = [name for name in _QUATERNION if name in available]
    if some_matrix and some_quaternion:
        raise InputError(f"columns {some_matrix[0]} and {some_quaternion[0]} both give the attitude: keep one kind")
    if some_quaternion and not with_quaternion:
        raise InputError(
            f"column {some_quaternion[0]}: elements of this group are no quaternions; give the attitude as a "
            f"matrix, {matrix[0]} … {matrix[-1]}"
        )
    wanted = momentum + (matrix if some_matrix else _QUATERNION if some_quaternion else [])
    for name in wanted:
        if available.count(name) != 1:
            how = "is missing" if name not in available else "is there twice"
            raise InputError(
                f"column {name} {how}: this system needs {', '.join(wanted)}; the file has {', '.join(available)}"
            )
    return wanted
