# SPDX-License-Identifier: GPL-3.0-or-later
"""What goes wrong, one class per cause, with the names that the C++ library uses."""

from __future__ import annotations


class Adaptation_error(Exception):
    """Base of every exception of the package."""


class Invalid_input_error(Adaptation_error, ValueError):
    """An input that was rejected before anything was done.

    Attributes
    ----------
    index : int or None
        The first offending element, as the input lists its elements, from 0.
    """

    index: int | None = None


class Non_triangular_face_error(Invalid_input_error):
    """A face with other than three corners."""


class Non_manifold_vertex_error(Invalid_input_error):
    """A vertex whose faces do not form one fan."""


class Non_simplicial_edge_error(Invalid_input_error):
    """Two faces share two vertices but are not neighbours across them."""


class Non_finite_coordinate_error(Invalid_input_error):
    """A coordinate that is NaN or infinite."""


class Invalid_metric_error(Invalid_input_error):
    """A size that is not positive and finite, or a tensor that is not positive definite."""


class Invalid_field_error(Invalid_input_error):
    """A value of a field that is NaN or infinite."""


class Invalid_normal_error(Invalid_input_error):
    """A normal that is zero, or a normal or shape operator that is not finite."""


class Empty_mesh_error(Adaptation_error, ValueError):
    """An input with no face."""


class Invalid_extent_error(Adaptation_error, ValueError):
    """An input that is so large, or so small, that squares of lengths overflow or underflow.

    Attributes
    ----------
    extent : float
        Largest side of the bounding box, or largest coordinate.
    """

    extent: float


class Invalid_parameter_error(Adaptation_error, ValueError):
    """A parameter outside its domain, or parameters that contradict each other."""


class Mesh_too_large_error(Adaptation_error, RuntimeError):
    """The metric asks for more vertices than are possible: check its units.

    Attributes
    ----------
    vertices : float
        How many the metric asks for.
    largest : int
        How many are possible.
    """

    vertices: float
    largest: int


class Tolerance_error(Adaptation_error, RuntimeError):
    """The distance between input and output could not be kept below the tolerance.

    Attributes
    ----------
    distance, tolerance : float
        What was reached, and what was asked for, in the unit of the coordinates.
    """

    distance: float
    tolerance: float


class Self_intersection_error(Adaptation_error, RuntimeError):
    """Triangles that meet where those of the input do not could not be avoided.

    Attributes
    ----------
    pairs : int
        The number of pairs of such triangles.
    """

    pairs: int
