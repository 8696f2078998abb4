"""What is read of a GLB here: the bytes of its buffer, the placing of its meshes, its bounds.

Covered is what plain models need: one scene, triangles, float positions. A file that asks for more is turned away, by name.
"""

import json
import struct
from pathlib import Path

IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]
# They change neither shape nor place; peers that know them draw them.
HARMLESS = ("KHR_materials_", "KHR_texture_transform", "KHR_lights_punctual", "KHR_xmp")


class Unreadable(Exception):
    """A model that cannot serve here, and why."""


class Glb:
    """A GLB file: its document, and its binary chunk when it is asked for."""

    def __init__(self, path):
        self.path = Path(path)
        try:
            with open(path, "rb") as file:
                magic, version, _, length, kind = struct.unpack("<4sIII4s", file.read(20))
                if magic != b"glTF" or version != 2 or kind != b"JSON":
                    raise Unreadable(f"{path}: expected a GLB of glTF 2.0, found other bytes")
                self.document = json.loads(file.read(length))
                self.binary_at = 20 + length + 8
        except (OSError, struct.error, ValueError) as error:
            raise Unreadable(f"{path}: {error}") from error
        for name in self.document.get("extensionsRequired", []):
            if not name.startswith(HARMLESS):
                raise Unreadable(
                    f"{path}: needs {name}, which not every peer reads; write it without, as with `gltf-transform copy`"
                )

    def binary(self):
        """The bytes of the binary chunk."""
        return self.path.read_bytes()[self.binary_at :]

    def placed_meshes(self):
        """Every mesh with its matrix, column after column, as often as it stands in the scene."""
        document = self.document
        scene = document.get("scenes", [{}])[document.get("scene", 0)]
        todo = [(node, IDENTITY) for node in scene.get("nodes", [])]
        while todo:
            index, above = todo.pop()
            node = document["nodes"][index]
            matrix = times(above, own_matrix(node))
            if "mesh" in node:
                yield document["meshes"][node["mesh"]], matrix
            todo += [(child, matrix) for child in node.get("children", [])]

    def bounds(self):
        """The least and the greatest corner of all positions, by their accessors' own bounds; and the triangles."""
        low, high, triangles = [float("inf")] * 3, [float("-inf")] * 3, 0
        accessors = self.document.get("accessors", [])
        for mesh, matrix in self.placed_meshes():
            for primitive in mesh["primitives"]:
                if primitive.get("mode", 4) != 4:
                    continue
                positions = accessors[primitive["attributes"]["POSITION"]]
                corners = accessors[primitive["indices"]] if "indices" in primitive else positions
                triangles += corners["count"] // 3
                for corner in corners_of(positions["min"], positions["max"]):
                    point = applied(matrix, corner)
                    low = [min(a, b) for a, b in zip(low, point)]
                    high = [max(a, b) for a, b in zip(high, point)]
        if triangles == 0:
            raise Unreadable(f"{self.path}: expected triangles, found none")
        return low, high, triangles


def own_matrix(node):
    """A node's matrix, column after column, from itself or from translation, rotation and scale."""
    if "matrix" in node:
        return node["matrix"]
    tx, ty, tz = node.get("translation", [0, 0, 0])
    x, y, z, w = node.get("rotation", [0, 0, 0, 1])
    a, b, c = node.get("scale", [1, 1, 1])
    return [
        (1 - 2 * (y * y + z * z)) * a, 2 * (x * y + z * w) * a, 2 * (x * z - y * w) * a, 0,
        2 * (x * y - z * w) * b, (1 - 2 * (x * x + z * z)) * b, 2 * (y * z + x * w) * b, 0,
        2 * (x * z + y * w) * c, 2 * (y * z - x * w) * c, (1 - 2 * (x * x + y * y)) * c, 0,
        tx, ty, tz, 1,
    ]  # fmt: skip


def times(a, b):
    """The product of two matrices, column after column."""
    return [sum(a[k * 4 + row] * b[col * 4 + k] for k in range(4)) for col in range(4) for row in range(4)]


def applied(m, p):
    """A point moved by a matrix."""
    return [m[row] * p[0] + m[4 + row] * p[1] + m[8 + row] * p[2] + m[12 + row] for row in range(3)]


def corners_of(low, high):
    """The eight corners of a box."""
    return [[(low, high)[i >> axis & 1][axis] for axis in range(3)] for i in range(8)]
