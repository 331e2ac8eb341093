# SPDX-License-Identifier: GPL-3.0-or-later
"""What adapt() and the kernels do with arrays."""

import numpy as np
import pytest
from shapes import check_manifold, cube, sphere, square

import surface_mesh_adaptation as sma


def edge_lengths(points, triangles):
    sides = points[triangles] - points[np.roll(triangles, 1, axis=1)]
    return np.linalg.norm(sides, axis=2)


def test_a_uniform_size_is_reached():
    points, triangles = sphere()
    result = sma.adapt(points, triangles, size=0.1)
    check_manifold(result, 2)
    assert result.report.final.in_range > 0.98
    assert abs(edge_lengths(result.points, result.triangles).mean() - 0.1) < 0.01
    assert np.abs(np.linalg.norm(result.points, axis=1) - 1).max() < 1e-3  # on the smooth surface
    assert np.allclose(result.metric, 100 * np.eye(3))


def test_the_input_is_not_changed_and_may_be_read_only():
    points, triangles = sphere()
    copies = points.copy(), triangles.copy()
    points.setflags(write=False)
    triangles.setflags(write=False)
    sma.adapt(points, triangles, size=0.2)
    assert np.array_equal(points, copies[0]) and np.array_equal(triangles, copies[1])


@pytest.mark.parametrize("dtype", [np.int8, np.uint16, np.int32, np.uint32, np.int64, np.uint64])
def test_all_types_of_indices_give_the_same(dtype):
    points, triangles = sphere(1)
    expected = sma.adapt(points, triangles, size=0.2)
    result = sma.adapt(points, triangles.astype(dtype), size=0.2)
    assert np.array_equal(result.points, expected.points)


def test_arrays_that_are_not_contiguous_give_the_same():
    points, triangles = sphere(2)
    expected = sma.adapt(points, triangles, size=0.2)
    wide = np.zeros((len(points), 5))
    wide[:, 1:4] = points
    result = sma.adapt(wide[:, 1:4], np.asfortranarray(triangles), size=0.2)
    assert np.array_equal(result.points, expected.points)


def test_lists_are_arrays():
    points, triangles = sphere(1)
    assert len(sma.adapt(points.tolist(), triangles.tolist(), size=0.2).points) > len(points)


def test_points_without_triangles_are_left_out_and_counted():
    points, triangles = sphere(2)
    more = np.concatenate([[[9.0, 9, 9]], points])
    result = sma.adapt(more, triangles + 1, size=0.2, attributes={"id": np.arange(len(more))})
    assert np.array_equal(result.points, sma.adapt(points, triangles, size=0.2).points)
    assert result.attributes["id"].min() > 0


@pytest.mark.parametrize("reconstruction", ["patches", "flat"])
@pytest.mark.parametrize("execution", ["sequential", "tbb", "openmp"])
def test_every_policy_gives_the_same_bits(reconstruction, execution):
    if execution != "sequential" and not getattr(sma.functions._core, f"has_{execution}"):
        pytest.skip("not built in")
    points, triangles = sphere()
    options = {"curvature": 0.002, "anisotropic": True, "reconstruction": reconstruction}
    expected = sma.adapt(points, triangles, **options, threads=1)
    result = sma.adapt(
        points, triangles, **options, execution=execution, threads=None if execution == "sequential" else 2
    )
    assert np.array_equal(result.points, expected.points)
    assert np.array_equal(result.triangles, expected.triangles)
    assert result.report.execution == execution


def test_sizes_as_array_and_as_function_are_the_same():
    points, triangles = sphere()
    calls = []

    def size(p):
        calls.append(p.shape)
        return 0.1 + 0.05 * p[:, 2] ** 2

    by_function = sma.adapt(points, triangles, size=size)
    by_array = sma.adapt(points, triangles, size=size(points))
    assert np.array_equal(by_function.points, by_array.points)
    assert calls == [points.shape] * 2  # once for all points


def test_tensors_stretch_the_faces():
    points, triangles = square()
    metric = np.broadcast_to(np.diag([100.0, 25.0, 1.0]), (len(points), 3, 3))
    result = sma.adapt(points, triangles, metric=metric)
    check_manifold(result, 1)
    assert result.report.final.in_range > 0.9
    rows = [[100.0, 0, 25, 0, 0, 1]] * len(points)
    assert np.array_equal(sma.adapt(points, triangles, metric=rows).points, result.points)


def test_a_field_is_resolved():
    points, triangles = square(16)
    values = np.tanh(20 * (points[:, 0] - 0.5))
    result = sma.adapt(points, triangles, field=values, vertices=400, attributes={"u": values})
    check_manifold(result, 1)
    near = np.abs(result.points[result.triangles].mean(axis=1)[:, 0] - 0.5) < 0.15
    assert near.sum() > 0.5 * len(near)
    assert 250 < len(result.points) < 600


def test_a_field_may_be_the_name_of_an_attribute():
    points, triangles = square(16)
    values = np.tanh(20 * (points[:, 0] - 0.5))
    expected = sma.adapt(points, triangles, field=values, vertices=200)
    result = sma.adapt(points, triangles, field="u", attributes={"u": values}, vertices=200)
    assert np.array_equal(result.points, expected.points)


def test_sizes_and_curvature_are_both_kept():
    points, triangles = sphere()
    coarse = np.full(len(points), 0.5)
    both = sma.adapt(points, triangles, size=coarse, curvature=0.001)
    alone = sma.adapt(points, triangles, size=coarse)
    assert len(both.points) > 2 * len(alone.points)


def test_number_of_vertices():
    points, triangles = sphere()
    result = sma.adapt(points, triangles, vertices=1500)
    assert abs(len(result.points) - 1500) < 150


def test_features_are_kept():
    points, triangles = cube()
    result = sma.adapt(points, triangles, size=0.15)
    check_manifold(result, 2)
    assert len(result.corners) == 8
    assert {tuple(p) for p in result.points[result.corners]} == {tuple(p) for p in cube(0)[0]}
    on_edges = np.isclose(result.points[result.feature_edges], 0) | np.isclose(result.points[result.feature_edges], 1)
    assert (on_edges.sum(axis=2) >= 2).all()
    total = np.linalg.norm(np.diff(result.points[result.feature_edges], axis=1)[:, 0], axis=1).sum()
    assert total == pytest.approx(12)


def test_constrained_edges_and_vertices_are_kept():
    points, triangles = square(8)
    diagonal = np.arange(0, 81, 10)
    edges = np.column_stack([diagonal[:-1], diagonal[1:]])
    inner = 12  # in the row above the bottom
    result = sma.adapt(points, triangles, size=0.07, constrained_edges=edges, constrained_vertices=[inner])
    check_manifold(result, 1)
    assert (result.points[result.constrained_vertices] == points[inner]).all()
    ends = result.points[result.feature_edges]
    on_diagonal = np.abs(ends[:, :, 0] - ends[:, :, 1]).max(axis=1) < 1e-12
    length = np.linalg.norm(ends[on_diagonal, 1] - ends[on_diagonal, 0], axis=1).sum()
    assert length == pytest.approx(np.sqrt(2))
    flags = np.zeros(len(points), dtype=bool)
    flags[inner] = True
    by_flags = sma.adapt(points, triangles, size=0.07, constrained_edges=edges, constrained_vertices=flags)
    assert np.array_equal(by_flags.points, result.points)


def test_attributes_are_interpolated():
    points, triangles = square(8)
    attributes = {
        "linear": points @ [1.0, 2.0, 3.0],
        "vector": points,
        "single": points.astype(np.float32),
        "number": np.arange(len(points)),
        "colour": np.rint(255 * points).astype(np.uint8),
        "truth": points[:, 0] > 0.5,
    }
    result = sma.adapt(points, triangles, size=0.05, attributes=attributes, reconstruction="flat")
    at = result.attributes
    assert np.allclose(at["linear"], result.points @ [1.0, 2.0, 3.0])
    assert np.allclose(at["vector"], result.points)
    assert at["single"].dtype == np.float32
    assert np.abs(at["colour"] - 255 * result.points).max() < 2
    assert (np.linalg.norm(points[at["number"]] - result.points, axis=1) < 0.1).all()
    assert at["truth"].dtype == bool and (at["truth"][result.points[:, 0] > 0.7]).all()
    assert np.allclose(result.source_weights.sum(axis=1), 1)


def test_normals_are_taken_and_left():
    points, triangles = sphere(2)
    result = sma.adapt(points, triangles, size=0.2, normals=points)
    assert np.abs(result.normals - result.points / np.linalg.norm(result.points, axis=1)[:, None]).max() < 0.01
    again = sma.adapt(
        result.points, result.triangles, size=0.1, normals=result.normals, shape_operators=result.shape_operators
    )
    assert np.abs(np.linalg.norm(again.points, axis=1) - 1).max() < 2e-3


def test_a_tolerance_is_certified():
    points, triangles = sphere()
    result = sma.adapt(points, triangles, size=0.2, tolerance=0.01)
    diagonal = 2 * np.sqrt(3)
    assert result.report.tolerance == pytest.approx(0.01 * diagonal)
    assert 0 < result.report.certified_distance <= result.report.tolerance


def shells():
    points, triangles = sphere(4)
    return np.concatenate([points, 0.98 * points]), np.concatenate([triangles, triangles[:, ::-1] + len(points)])


def test_self_intersections_are_counted_on_request():
    assert sma.adapt(*shells(), size=0.3).report.self_intersections is None
    counts = sma.adapt(*shells(), size=0.4, count_self_intersections=True).report.self_intersections
    assert counts.before == 0 and counts.after > 100 and counts.seconds > 0


def test_self_intersections_are_avoided_on_request():
    result = sma.adapt(*shells(), size=0.4, avoid_self_intersections=True, count_self_intersections=True)
    assert result.report.self_intersections.after == 0
    radii = np.linalg.norm(result.points, axis=1)
    assert np.abs(np.minimum(abs(radii - 1), abs(radii - 0.98))).max() < 0.02 / 8  # of the gap
    assert sma.Report.from_json(result.report.to_json()).self_intersections.after == 0


def test_fit_is_nearer_to_the_surface():
    points, triangles = sphere(4)
    plain = sma.adapt(points, triangles, size=0.3)
    fitted = sma.adapt(points, triangles, size=0.3, fit=True)
    middle = [np.linalg.norm(r.points[r.triangles].mean(axis=1), axis=1).mean() for r in (plain, fitted)]
    assert abs(middle[1] - 1) < abs(middle[0] - 1)


def test_seams_are_welded_on_request():
    points, triangles = sphere(2)
    soup, corners = points[triangles].reshape(-1, 3), np.arange(3 * len(triangles)).reshape(-1, 3)
    check_manifold(sma.adapt(soup, corners, size=0.3, weld=True), 2)


def test_repair_leaves_out_what_makes_no_sense():
    points, triangles = sphere(2)
    broken = np.concatenate([triangles, [[0, 1, 9999], [3, 3, 4]]])
    with pytest.raises(sma.Invalid_input_error):
        sma.adapt(points, broken, size=0.3)
    result = sma.adapt(points, broken, size=0.3, repair=True)
    check_manifold(result, 2)
    assert len(result.report.repairs) == 2


@pytest.mark.parametrize("kernel", ["refine", "simplify", "swap", "regularize", "relocate"])
@pytest.mark.parametrize("reconstruction", ["patches", "flat"])
def test_each_kernel_alone(kernel, reconstruction):
    irregular = sma.refine(*sphere(), size=0.13)
    points, triangles = irregular.points, irregular.triangles
    size = {"refine": 0.06, "simplify": 0.3}.get(kernel, 0.13)
    result = getattr(sma, kernel)(points, triangles, size=size, reconstruction=reconstruction)
    check_manifold(result, 2)
    assert result.operations > 0
    more = len(result.points) - len(points)
    assert {"refine": more > 0, "simplify": more < 0, "regularize": more <= 0}.get(kernel, more == 0)


def test_simplify_within_limits():
    points, triangles = sphere(4)
    result = sma.simplify(points, triangles, size=10.0, max_distance=0.02)
    check_manifold(result, 2)
    assert len(result.points) < len(points) / 3
    centers = result.points[result.triangles].mean(axis=1)
    assert np.abs(np.linalg.norm(centers, axis=1) - 1).max() < 0.03
    finer = sma.simplify(points, triangles, size=10.0, max_normal_deviation=8)
    assert len(finer.points) > len(result.points)


def test_results_outlive_each_other():
    points, triangles = sphere(2)
    array = sma.adapt(points, triangles, size=0.2).points
    for _ in range(3):
        sma.adapt(points, triangles, size=0.15)
    assert np.isfinite(array).all() and array.flags.writeable
