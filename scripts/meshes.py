# SPDX-License-Identifier: GPL-3.0-or-later
"""What the scripts that check outputs of adapt_mesh share: meshes read by code of their own, and their topology."""

import struct

FORMATS = {".off", ".obj", ".ply", ".stl", ".mesh", ".meshb"}


class Unreadable(Exception):
    """A file that the checks cannot read; adapt_mesh may."""


# Reading: points and polygons

def read_off(path):
    """Colours and normals may follow the numbers of a line."""
    lines = [line.split("#", 1)[0].split() for line in path.read_text(errors="replace").splitlines()]
    rows = [words for words in lines if words]
    if rows[0][0] not in ("OFF", "COFF", "NOFF"):
        raise Unreadable
    rows = rows[1:] if len(rows[0]) == 1 else [rows[0][1:], *rows[1:]]
    n, m = int(rows[0][0]), int(rows[0][1])
    points = [tuple(map(float, row[:3])) for row in rows[1:1 + n]]
    return points, [[int(word) for word in row[1:1 + int(row[0])]] for row in rows[1 + n:1 + n + m]]


def read_obj(path):
    points, polygons = [], []
    for line in path.read_text(errors="replace").splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            points.append(tuple(map(float, words[1:4])))
        elif words[:1] == ["f"]:
            corners = [int(word.split("/")[0]) for word in words[1:]]
            polygons.append([i - 1 if i > 0 else len(points) + i for i in corners])
    return points, polygons


PLY_TYPES = {"char": "b", "int8": "b", "uchar": "B", "uint8": "B", "short": "h", "int16": "h", "ushort": "H",
             "uint16": "H", "int": "i", "int32": "i", "uint": "I", "uint32": "I", "float": "f", "float32": "f",
             "double": "d", "float64": "d"}


def ply_header(data):
    """The format, the elements as (name, number, properties), and where the body starts."""
    end = data.index(b"end_header")
    body = data.index(b"\n", end) + 1
    form, elements = "", []
    for words in (line.split() for line in data[:end].decode(errors="replace").splitlines()):
        if words[:1] == ["format"]:
            form = words[1]
        elif words[:1] == ["element"]:
            elements.append((words[1], int(words[2]), []))
        elif words[:1] == ["property"]:
            elements[-1][2].append(words[1:])
    return form, elements, body


def ply_numbers(form, data, body):
    """A function that gives the next number of a type."""
    if form == "ascii":
        words = iter(data[body:].split())
        return lambda kind: (float if PLY_TYPES[kind] in "fd" else int)(next(words))
    order, position = "<" if form == "binary_little_endian" else ">", [body]

    def number(kind):
        code = order + PLY_TYPES[kind]
        value, = struct.unpack_from(code, data, position[0])
        position[0] += struct.calcsize(code)
        return value
    return number


def read_ply(path):
    data = path.read_bytes()
    form, elements, body = ply_header(data)
    number = ply_numbers(form, data, body)
    points, polygons = [], []
    for name, count, properties in elements:
        for _ in range(count):
            values = {}
            for p in properties:
                is_list = p[0] == "list"
                values[p[-1]] = [number(p[2]) for _ in range(number(p[1]))] if is_list else number(p[0])
            if name == "vertex":
                points.append((values["x"], values["y"], values["z"]))
            elif name == "face":
                polygons.append(values.get("vertex_indices", values.get("vertex_index")))
    return points, polygons


def read_stl(path):
    data = path.read_bytes()
    if data[:5] == b"solid" and b"facet" in data[:1000]:
        lines = [line.split() for line in data.decode(errors="replace").splitlines()]
        corners = [tuple(map(float, words[1:4])) for words in lines if words[:1] == ["vertex"]]
    else:
        number, = struct.unpack_from("<I", data, 80)
        floats = [struct.unpack_from("<12f", data, 84 + 50 * i) for i in range(number)]
        corners = [f[i:i + 3] for f in floats for i in (3, 6, 9)]
    return merged(corners, [[i, i + 1, i + 2] for i in range(0, len(corners), 3)])


def merged(points, polygons):
    """The same with one point at each place."""
    first = {}
    index = [first.setdefault(p, i) for i, p in enumerate(points)]
    return points, [[index[i] for i in polygon] for polygon in polygons]


def read_mesh(path):
    readers = {".off": read_off, ".obj": read_obj, ".ply": read_ply, ".stl": read_stl}
    try:
        return readers[path.suffix.lower()](path)
    except (KeyError, ValueError, IndexError, TypeError, StopIteration, struct.error) as error:
        raise Unreadable from error


def meshes_in(paths):
    for path in paths:
        files = sorted(path.rglob("*")) if path.is_dir() else [path]
        yield from (file for file in files if file.suffix.lower() in FORMATS and file.is_file())


class Sets:
    """Disjoint sets of integers."""

    def __init__(self, n):
        self.parent = list(range(n))

    def find(self, i):
        parent = self.parent
        while parent[i] != i:
            parent[i] = i = parent[parent[i]]
        return i

    def unite(self, i, j):
        self.parent[self.find(i)] = self.find(j)

    def number(self, of):
        return len({self.find(i) for i in of})


def topology(points, polygons):
    """(components, boundary cycles, Euler characteristic), or a sentence that says why it is no manifold. Faces that
    look different ways are no matter."""
    edges, number = {}, 0  # of the corner at the start of an edge of a face, and of the next corner
    for polygon in polygons:
        if len(set(polygon)) < len(polygon):
            return "a face has a vertex twice"
        for k, v in enumerate(polygon):
            w, following = polygon[(k + 1) % len(polygon)], number + (k + 1) % len(polygon) - k
            edges.setdefault((min(v, w), max(v, w)), []).append((number, following) if v < w else (following, number))
            number += 1
    if any(len(sides) > 2 for sides in edges.values()):
        return "an edge has more than two faces"
    fans = Sets(number)
    for sides in edges.values():
        if len(sides) == 2:
            fans.unite(sides[0][0], sides[1][0])
            fans.unite(sides[0][1], sides[1][1])
    used = {v for polygon in polygons for v in polygon}
    if fans.number(range(number)) != len(used):
        return "the faces at a vertex form no single fan"
    components, cycles = Sets(len(points)), Sets(len(points))
    for v, w in edges:
        components.unite(v, w)
    border = [edge for edge, sides in edges.items() if len(sides) == 1]
    for v, w in border:
        cycles.unite(v, w)
    return (components.number(used), cycles.number(v for v, _ in border), len(used) - len(edges) + len(polygons))
