# SPDX-License-Identifier: GPL-3.0-or-later
"""From the keywords of the functions to what the extension module takes."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from . import _core
from ._arrays import Array, evaluated, field, indices, mask, normals, numbers, sizes, tensors
from ._meshes import Surface
from .errors import Invalid_parameter_error

Request = dict[str, Any]

#: The keywords that are handed on as they are if they are given, with their types and what they must fulfil.
_POSITIVE = ("a positive number", lambda x: math.isfinite(x) and x > 0)
_COUNT = ("a positive whole number, below 2^31", lambda n: 0 < n < 2**31)
_AT_LEAST_1 = ("a number, at least 1", lambda x: x >= 1)
_NUMBERS: dict[str, tuple[type, str, Any]] = {
    "curvature": (float, *_POSITIVE),
    "tolerance": (float, *_POSITIVE),
    "hmin": (float, *_POSITIVE),
    "hmax": (float, *_POSITIVE),
    "max_distance": (float, *_POSITIVE),
    "vertices": (int, *_COUNT),
    "max_vertices": (int, *_COUNT),
    "threads": (int, *_COUNT),
    "iterations": (int, "a whole number, at least 0 and below 2^31", lambda n: 0 <= n < 2**31),
    "protected_gradation": (float, "a finite number, at least 0", lambda x: math.isfinite(x) and x >= 0),
    "gradation": (float, "a finite number, at least 1", lambda x: math.isfinite(x) and x >= 1),
    "max_anisotropy": (float, *_AT_LEAST_1),
    "norm": (float, *_AT_LEAST_1),
    "feature_angle": (float, "an angle in degrees, above 0 and up to 180", lambda a: 0 < a <= 180),
    "max_normal_deviation": (float, "an angle in degrees, above 0 and up to 180", lambda a: 0 < a <= 180),
    "shape_weight": (float, "a number above 0 and up to 1", lambda w: 0 < w <= 1),
}
_SWITCHES = (
    "anisotropic",
    "noisy",
    "detect_features",
    "smooth_borders",
    "fit",
    "avoid_self_intersections",
    "count_self_intersections",
    "weld",
    "repair",
)
_CHOICES = {"reconstruction": ("patches", "flat"), "execution": ("sequential", "tbb", "openmp")}
_ARRAYS = (
    "size",
    "metric",
    "field",
    "constrained_edges",
    "constrained_vertices",
    "protected_edges",
    "protected_faces",
    "faces",
    "labels",
    "size_bounds",
    "normals",
    "shape_operators",
)
_ATTRIBUTES = ("attributes", "face_attributes", "corner_attributes")
KEYWORDS = frozenset([*_NUMBERS, *_SWITCHES, *_CHOICES, *_ARRAYS, *_ATTRIBUTES, "face_origin"])


def _number(name: str, value: Any) -> Any:
    kind, expected, is_valid = _NUMBERS[name]
    wrong_type = isinstance(value, (bool, np.bool_, str, bytes)) or not np.isscalar(value)
    try:
        number = kind(value)
        wrong_type = wrong_type or (kind is int and number != value)
    except (TypeError, ValueError, OverflowError):
        wrong_type = True
    if wrong_type:
        raise TypeError(f"{name}: expected {expected}, not {value!r}")
    if not is_valid(number):
        raise Invalid_parameter_error(f"{name}: expected {expected}, not {value!r}")
    return number


def _choice(name: str, value: Any) -> str:
    if value not in _CHOICES[name]:
        known = ", ".join(map(repr, _CHOICES[name]))
        raise Invalid_parameter_error(f"{name}: expected one of {known}, not {value!r}")
    return str(value)


def surface_request(surface: Surface, options: Request) -> Request:
    """The surface, its constraints, and everything of the options that is a number or a choice."""
    unknown = set(options) - KEYWORDS
    if unknown:
        raise TypeError(f"unknown keywords: {', '.join(sorted(unknown))}; known are {', '.join(sorted(KEYWORDS))}")
    n = len(surface.points)
    given = {name: value for name, value in options.items() if value is not None}
    request: Request = {"points": surface.points}
    request.update({name: _number(name, value) for name, value in given.items() if name in _NUMBERS})
    request.update({name: bool(value) for name, value in given.items() if name in _SWITCHES})
    choices = {name: _choice(name, value) for name, value in given.items() if name in _CHOICES}
    if "execution" in choices:
        request["execution"] = choices["execution"]
    request["flat"] = choices.get("reconstruction") == "flat"
    triangles = surface.triangles
    request["triangles"] = triangles if request.get("repair") else indices("triangles", triangles, 3, n)
    request.update(_constraints(surface, given, n))
    request.update(_of_faces(surface, given, n))
    return request


def _of_faces(surface: Surface, given: Request, n: int) -> Request:
    """What is given for triangles, and for their corners."""
    m = len(surface.triangles)
    request: Request = {}
    for name, key in (("protected_faces", "protected_faces"), ("faces", "selected_faces")):
        if name in given:
            request[key] = mask(name, given[name], m)
    if "faces" in given and not request["selected_faces"].any():
        raise Invalid_parameter_error("faces: expected one at least")
    if "protected_edges" in given:
        edges = indices("protected_edges", given["protected_edges"], 2, n)
        if len(edges) > 0:
            request["protected_edges"] = edges
    if "size_bounds" in given:
        request["size_bounds"] = numbers("size_bounds", given["size_bounds"], (m, 2))
    labels = given.get("labels", surface.labels)
    if isinstance(labels, str):
        labels = _attribute_of_faces("labels", labels, surface)
    if labels is not None:
        surface.label_names, request["labels"] = _numbered_labels(labels, m)
    if surface.corner_attributes:
        flat = [v.reshape(m, 3, -1) for v in surface.corner_attributes.values()]
        request["corner_values"] = np.ascontiguousarray(np.concatenate(flat, axis=2).reshape(m, -1), dtype=np.float64)
    return request


def _attribute_of_faces(name: str, value: str, surface: Surface) -> Array:
    if value not in surface.face_attributes:
        known = ", ".join(map(repr, surface.face_attributes)) or "none"
        raise Invalid_parameter_error(f"{name}: there is no attribute {value!r}; attributes at triangles: {known}")
    return surface.face_attributes[value]


def _numbered_labels(labels: Any, m: int) -> tuple[Array, Array]:
    """The different labels, and the number of each among these."""
    array = np.asarray(labels)
    if array.shape != (m,):
        raise ValueError(f"labels: expected one for each triangle, ({m},), not an array of shape {array.shape}")
    names, number = np.unique(array, return_inverse=True)
    return names, np.ascontiguousarray(number.reshape(m), dtype=np.int32)


def _constraints(surface: Surface, given: Request, n: int) -> Request:
    request: Request = {}
    edges = [e for e in (surface.constrained_edges, given.get("constrained_edges")) if e is not None]
    checked = [e for e in (indices("constrained_edges", e, 2, n) for e in edges) if len(e) > 0]
    if checked:
        request["constrained_edges"] = np.concatenate(checked)
    chosen = [v for v in (surface.constrained_vertices, given.get("constrained_vertices")) if v is not None]
    if chosen:
        masks = [mask("constrained_vertices", v, n) for v in chosen]
        request["constrained_vertices"] = np.bitwise_or.reduce(masks)
    return request


def run_request(surface: Surface, options: Request) -> Request:
    """All that a run needs."""
    request = surface_request(surface, options)
    given = {name: value for name, value in options.items() if value is not None}
    n = len(surface.points)
    if "normals" in given:
        request["normals"] = normals("normals", given["normals"], n)
    if "shape_operators" in given:
        request["shape_operators"] = tensors("shape_operators", given["shape_operators"], n)
    request.update(_metric(surface, given, request))
    _check_consistent(given, request)
    return request


def _named(name: str, value: Any, surface: Surface) -> Any:
    """An attribute, if `value` is the name of one; a function's values at the points."""
    if not isinstance(value, str):
        return evaluated(value, surface.points)
    if value not in surface.attributes:
        known = ", ".join(map(repr, surface.attributes)) or "none"
        raise Invalid_parameter_error(f"{name}: there is no attribute {value!r}; attributes at points: {known}")
    return surface.attributes[value]


def _metric(surface: Surface, given: Request, request: Request) -> Request:
    n = len(surface.points)
    wanted: Request = {}
    if "field" in given:
        wanted["field"] = field("field", _named("field", given["field"], surface), n)
    for name in ("size", "metric"):
        if name not in given:
            continue
        value = _named(name, given[name], surface)
        if np.ndim(value) == 0:
            wanted["size"] = _uniform(name, value)
        else:
            wanted.update(metric_arrays(name, value, n, request.get("hmin"), request.get("hmax")))
    return wanted


def _uniform(name: str, value: Any) -> float:
    if isinstance(value, (bool, np.bool_)) or not np.issubdtype(np.asarray(value).dtype, np.number):
        raise TypeError(f"{name}: expected a number, an array or a function of points, not {value!r}")
    if not (math.isfinite(value) and value > 0):
        raise Invalid_parameter_error(f"{name}: expected a positive number, not {value!r}")
    return float(value)


def metric_arrays(name: str, value: Any, rows: int, hmin: float | None = None, hmax: float | None = None) -> Request:
    """Sizes or tensors within bounds, under the names that the extension module has for them."""
    array = np.asarray(value)
    if array.ndim == 1:
        given = sizes(name, array, rows)
        return {"sizes": given if hmin is None and hmax is None else np.clip(given, hmin, hmax)}
    if array.ndim not in (2, 3):
        numbers(name, array, (rows,), (rows, 3, 3), (rows, 6))
    return {"tensors": bounded(tensors(name, array, rows), hmin, hmax)}


def bounded(metric: Array, hmin: float | None, hmax: float | None) -> Array:
    """Tensors with their sizes within bounds; they must be positive definite."""
    if hmin is None and hmax is None:
        _core.check_tensors(metric)
        return metric
    return _core.bounded(metric, hmin or 0.0, hmax or math.inf)


def _check_consistent(given: Request, request: Request) -> None:
    def refuse_if(condition: bool, why: str) -> None:
        if condition:
            raise Invalid_parameter_error(why)

    has = {name: name in given for name in KEYWORDS}
    is_uniform = "size" in request
    has_metric = "sizes" in request or "tensors" in request
    refuse_if(has["size"] and has["metric"], "size contradicts metric: give one of them")
    refuse_if((is_uniform or has_metric) and has["field"], "field contradicts size and metric")
    refuse_if(
        not (is_uniform or has_metric or has["field"] or has["curvature"] or has["vertices"] or has["tolerance"]),
        "one of size, curvature, metric, field, vertices and tolerance is required",
    )
    refuse_if(has["field"] and not has["vertices"], "field needs vertices")
    refuse_if(
        has["curvature"] and has["vertices"] and not (has_metric or has["field"]),
        "vertices contradicts curvature: both say how fine the mesh is to be",
    )
    refuse_if(has["norm"] and not has["field"], "norm needs field")
    refuse_if(
        bool(given.get("anisotropic")) and (is_uniform or has_metric) and not has["curvature"],
        "anisotropic needs curvature, field, vertices or tolerance",
    )
    refuse_if(
        is_uniform and any(has[name] for name in ("hmin", "hmax", "vertices", "gradation", "curvature")),
        "hmin, hmax, vertices, gradation and curvature contradict a uniform size",
    )
    refuse_if("hmin" in request and "hmax" in request and request["hmin"] > request["hmax"], "hmin is larger than hmax")
    refuse_if(
        has["feature_angle"] and given.get("detect_features") is False,
        "feature_angle contradicts detect_features=False",
    )
    refuse_if(has["shape_weight"] and not given.get("fit"), "shape_weight needs fit")
    refuse_if(
        given.get("execution") == "sequential" and given.get("threads", 1) > 1, "threads needs a parallel execution"
    )
