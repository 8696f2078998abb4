"""Models that need no download: `generate.py terrain|room FILE.glb`. The same bytes on every run; lengths in metres."""

import json
import math
import struct
import sys
import zlib
from array import array

import room

# Two triangles a cell: 1,002,528 of them.
TERRAIN_CELLS = 708
MATTE = {"metallic": 0.0, "roughness": 0.8}


def main(name, path):
    write = {"terrain": terrain, "room": furnished}[name]
    with open(path, "wb") as file:
        file.write(write())


def terrain():
    """Hills of a few sines and ever smaller ones, 2 m wide."""

    def height(u, v):
        x, z, y, wide = 2 * u - 1, 2 * v - 1, 0.0, 0.12
        for octave in range(7):
            turn = 2.0**octave
            x, z = 0.8 * x - 0.6 * z, 0.6 * x + 0.8 * z
            y += wide * math.sin(2.7 * turn * x + octave) * math.cos(3.1 * turn * z - octave)
            wide *= 0.5
        return (2 * u - 1, y, 2 * v - 1)

    part = room.Part("earth")
    part.grid(height, TERRAIN_CELLS, TERRAIN_CELLS)
    return glb([part], {"earth": {"color": (0.45, 0.5, 0.3), **MATTE}})


def furnished():
    """A room with a table, chairs, shelves, curtains and a sofa; its wood, plaster and rug are textured."""
    return glb(room.parts(), room.MATERIALS)


def glb(parts, materials):
    """A GLB of one mesh with a primitive a part."""
    views, accessors, binary = [], [], bytearray()

    def view(data):
        views.append({"buffer": 0, "byteOffset": len(binary), "byteLength": len(data)})
        binary.extend(data + b"\0" * (-len(data) % 4))
        return len(views) - 1

    def accessor(values, kind, width, **more):
        numbers = array("f" if kind == 5126 else "I", values)
        if sys.byteorder == "big":
            numbers.byteswap()
        type_ = {1: "SCALAR", 2: "VEC2", 3: "VEC3"}[width]
        count = len(numbers) // width
        accessors.append(
            {"bufferView": view(numbers.tobytes()), "componentType": kind, "type": type_, "count": count, **more}
        )
        return len(accessors) - 1

    names = list(materials)
    primitives = []
    for part in parts:
        rounded = array("f", part.positions)
        bounds = {"min": [min(rounded[i::3]) for i in range(3)], "max": [max(rounded[i::3]) for i in range(3)]}
        attributes = {
            "POSITION": accessor(part.positions, 5126, 3, **bounds),
            "NORMAL": accessor(part.normals, 5126, 3),
            "TEXCOORD_0": accessor(part.uv, 5126, 2),
        }
        indices = accessor(part.corners, 5125, 1)
        primitives.append({"attributes": attributes, "indices": indices, "material": names.index(part.material)})
    images, described = [], []
    for material in materials.values():
        pbr = {"metallicFactor": material["metallic"], "roughnessFactor": material["roughness"]}
        if "texture" in material:
            images.append({"bufferView": view(png(material["texture"])), "mimeType": "image/png"})
            pbr["baseColorTexture"] = {"index": len(images) - 1}
        else:
            pbr["baseColorFactor"] = [*material["color"], 1]
        described.append({"pbrMetallicRoughness": pbr, "doubleSided": True})
    document = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": primitives}],
        "materials": [{"name": name, **one} for name, one in zip(names, described)],
        "accessors": accessors,
        "bufferViews": views,
        "buffers": [{"byteLength": len(binary)}],
    }
    if images:
        document |= {"images": images, "textures": [{"source": i} for i in range(len(images))]}
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    head = struct.pack("<4sIIII", b"glTF", 2, 28 + len(text) + len(binary), len(text), 0x4E4F534A)
    return head + text + struct.pack("<II", len(binary), 0x004E4942) + bytes(binary)


def png(color, side=512):
    """A PNG of a function from (u, v) to a colour of numbers from 0 to 1."""
    rows = bytearray()
    for y in range(side):
        rows.append(0)
        for x in range(side):
            rows.extend(min(max(int(c * 255), 0), 255) for c in color(x / side, y / side))
    chunks = [
        (b"IHDR", struct.pack(">IIBBBBB", side, side, 8, 2, 0, 0, 0)),
        (b"IDAT", zlib.compress(bytes(rows))),
        (b"IEND", b""),
    ]
    body = b"".join(struct.pack(">I", len(d)) + n + d + struct.pack(">I", zlib.crc32(n + d)) for n, d in chunks)
    return b"\x89PNG\r\n\x1a\n" + body


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2])
