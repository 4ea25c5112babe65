"""Which columns of a file are the state: ``mu_1`` … ``mu_n``, and the attitude if there is one."""

from __future__ import annotations

from collections.abc import Sequence

from .errors import InputError

_QUATERNION = ["q_w", "q_x", "q_y", "q_z"]


def choose(available: Sequence[str] | int, dimension: int, matrix_size: int, quaternions: bool) -> list[str]:
    """The columns of a state among those of a file, in the order in which the steps want them.

    A file without names has a width, which says what it holds.
    """
    momentum = [f"mu_{i}" for i in range(1, dimension + 1)]
    between = "_" if matrix_size > 9 else ""
    size = range(1, matrix_size + 1)
    matrix = [f"g_{i}{between}{j}" for i in size for j in size]
    layouts = [momentum, momentum + matrix] + ([momentum + _QUATERNION] if quaternions else [])
    if isinstance(available, int):
        for layout in layouts:
            if len(layout) == available:
                return layout
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
    if some_quaternion and not quaternions:
        raise InputError(
            f"column {some_quaternion[0]}: elements of this group are no quaternions; give the attitude as a "
            f"{matrix_size}×{matrix_size} matrix, {matrix[0]} …"
        )
    wanted = momentum + (matrix if some_matrix else _QUATERNION if some_quaternion else [])
    for name in wanted:
        if available.count(name) != 1:
            how = "is missing" if name not in available else "is there twice"
            raise InputError(
                f"column {name} {how}: this system needs {', '.join(wanted)}; the file has {', '.join(available)}"
            )
    return wanted
