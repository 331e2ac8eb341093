# SPDX-License-Identifier: GPL-3.0-or-later
"""Arrays as the extension module reads them, or an error that says what was expected."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from .errors import Invalid_field_error, Invalid_input_error, Invalid_metric_error, Invalid_normal_error

Array = np.ndarray[Any, Any]


def _described(array: Array) -> str:
    return f"an array of shape {array.shape} and type {array.dtype}"


def _fits(shape: tuple[int, ...], expected: tuple[int | str, ...]) -> bool:
    return len(shape) == len(expected) and all(isinstance(e, str) or s == e for s, e in zip(shape, expected))


def _shape(expected: tuple[int | str, ...]) -> str:
    return "(" + ", ".join(map(str, expected)) + ("," if len(expected) == 1 else "") + ")"


def _check(name: str, array: Array, kinds: str, what: str, *shapes: tuple[int | str, ...]) -> None:
    expected = f"{name}: expected {what} of shape {' or '.join(map(_shape, shapes))}, not {_described(array)}"
    if array.dtype.kind not in kinds:
        raise TypeError(expected)
    if not any(_fits(array.shape, s) for s in shapes):
        raise ValueError(expected)


def numbers(name: str, values: Any, *shapes: tuple[int | str, ...]) -> Array:
    """`values` as a contiguous array of doubles, the same one if it is that already."""
    array = np.asarray(values)
    _check(name, array, "fiu", "real numbers", *shapes)
    return np.ascontiguousarray(array, dtype=np.float64)


def refuse(name: str, array: Array, bad: Any, error: type[Invalid_input_error], expected: str) -> None:
    """Raises `error` for the first row that is `bad`, if there is one."""
    rows = np.flatnonzero(bad)
    if len(rows) == 0:
        return
    raised = error(f"{name}: row {rows[0]} is {array[rows[0]].tolist()}, expected {expected}")
    raised.index = int(rows[0])
    raise raised


def indices(name: str, values: Any, columns: int | None, limit: int | None) -> Array:
    """`values` as a contiguous array of indices below `limit`, the same one if it is that already."""
    array = np.asarray(values)
    shape: tuple[int | str, ...] = ("k",) if columns is None else ("k", columns)
    if array.size == 0:  # an empty list has neither type nor shape
        array = np.empty((0,) if columns is None else (0, columns), dtype=np.int64)
    _check(name, array, "iu", "integers", shape)
    if limit is not None and array.size > 0:
        _check_range(name, array, limit)
    return np.ascontiguousarray(array, dtype=np.int32 if array.dtype == np.int32 else np.int64)


def _check_range(name: str, array: Array, limit: int) -> None:
    if array.min() >= 0 and array.max() < limit:
        return
    bad = ((array < 0) | (array >= limit)).reshape(len(array), -1).any(axis=1)
    refuse(name, array, bad, Invalid_input_error, f"an index, 0 to {limit - 1}" if limit > 0 else "no index")


def tensors(name: str, values: Any, rows: int) -> Array:
    """Symmetric tensors as an array of shape (n, 3, 3), from that or from (n, 6): xx xy yy xz yz zz."""
    array = numbers(name, values, (rows, 3, 3), (rows, 6))
    if array.ndim == 2:
        return np.ascontiguousarray(array[:, [0, 1, 3, 1, 2, 4, 3, 4, 5]].reshape(-1, 3, 3))
    skew = np.abs(array - array.transpose(0, 2, 1)).max(axis=(1, 2))
    refuse(name, array, skew > 1e-9 * np.abs(array).max(axis=(1, 2)), Invalid_input_error, "a symmetric tensor")
    return array


def sizes(name: str, values: Any, rows: int) -> Array:
    """Positive numbers."""
    array = numbers(name, values, (rows,))
    refuse(name, array, ~((array > 0) & np.isfinite(array)), Invalid_metric_error, "a positive size")
    return array


def field(name: str, values: Any, rows: int) -> Array:
    """Finite numbers."""
    array = numbers(name, values, (rows,))
    refuse(name, array, ~np.isfinite(array), Invalid_field_error, "a finite number")
    return array


def normals(name: str, values: Any, rows: int) -> Array:
    """Vectors that have a direction."""
    array = numbers(name, values, (rows, 3))
    bad = ~(np.isfinite(array).all(axis=1) & array.any(axis=1))
    refuse(name, array, bad, Invalid_normal_error, "a vector that is finite and not zero")
    return array


def mask(name: str, values: Any, rows: int) -> Array:
    """Which of `rows` elements are meant: by booleans, or by their indices."""
    array = np.asarray(values)
    if array.dtype == bool:
        _check(name, array, "b", "booleans or indices", (rows,))
        return np.ascontiguousarray(array).view(np.uint8)
    result = np.zeros(rows, dtype=np.uint8)
    result[indices(name, array, None, rows)] = 1
    return result


def evaluated(values: Any | Callable[[Array], Any], points: Array) -> Any:
    """`values`, or what they are at all points if they are a function of these."""
    return values(points) if callable(values) else values
