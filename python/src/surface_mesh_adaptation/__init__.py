# SPDX-License-Identifier: GPL-3.0-or-later
"""Adapts triangulated surfaces to metric fields, in parallel.

`adapt` does it all; `refine`, `simplify`, `swap`, `regularize` and `relocate` are its kernels alone. They take arrays
of points and triangles, `pyvista.PolyData`, `trimesh.Trimesh` or `meshio.Mesh`.
"""

from .errors import (
    Adaptation_error,
    Empty_mesh_error,
    Invalid_extent_error,
    Invalid_field_error,
    Invalid_input_error,
    Invalid_metric_error,
    Invalid_normal_error,
    Invalid_parameter_error,
    Mesh_too_large_error,
    Non_finite_coordinate_error,
    Non_manifold_vertex_error,
    Non_simplicial_edge_error,
    Non_triangular_face_error,
    Self_intersection_error,
    Tolerance_error,
)
from .functions import adapt, refine, regularize, relocate, simplify, swap
from .progress import Progress
from .report import KernelReport, MeshStatistics, Report, SelfIntersectionCounts
from .result import Result
from .tools import (
    bound,
    complexity,
    estimate_hessians,
    estimate_jets,
    exponential_map,
    gradation,
    intersection,
    scale_to_vertices,
    surface_points,
)

__version__ = "0.1.0"

__all__ = [
    "Adaptation_error",
    "Empty_mesh_error",
    "Invalid_extent_error",
    "Invalid_field_error",
    "Invalid_input_error",
    "Invalid_metric_error",
    "Invalid_normal_error",
    "Invalid_parameter_error",
    "KernelReport",
    "MeshStatistics",
    "Mesh_too_large_error",
    "Non_finite_coordinate_error",
    "Non_manifold_vertex_error",
    "Non_simplicial_edge_error",
    "Non_triangular_face_error",
    "Progress",
    "Report",
    "Result",
    "SelfIntersectionCounts",
    "Self_intersection_error",
    "Tolerance_error",
    "adapt",
    "bound",
    "complexity",
    "estimate_hessians",
    "estimate_jets",
    "exponential_map",
    "gradation",
    "intersection",
    "refine",
    "regularize",
    "relocate",
    "scale_to_vertices",
    "simplify",
    "surface_points",
    "swap",
]
