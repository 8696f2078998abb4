"""Makes of a GLB what peers without glTF read: a PLY a primitive and a list of materials; for POV-Ray, text.

Run in the virtual environment (it needs numpy and Pillow): `convert.py MODEL.glb FOLDER mesh|pov`.
Kept: triangles, normals, the first texture coordinates, base colour, metalness, roughness, the normal map. Left out:
emission, occlusion, extensions of materials, the alpha in textures; nothing moves.
"""

import io
import json
import sys
from pathlib import Path

import numpy
from gltf import Glb
from PIL import Image

NUMBERS = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}


def main(model, folder, form):
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    glb = Glb(model)
    reader = Reader(glb)
    meshes = [mesh for mesh in reader.meshes()]
    if form == "pov":
        import pov

        pov.write_meshes(meshes, [pov_material(m, folder) for m in reader.materials(folder)], folder)
        return
    shapes = []
    for number, mesh in enumerate(meshes):
        write_ply(folder / f"{number}.ply", mesh)
        shapes.append({"file": f"{number}.ply", "material": mesh["material"], "textured": mesh["uv"] is not None})
    listed = {"shapes": shapes, "materials": reader.materials(folder)}
    (folder / "scene.json").write_text(json.dumps(listed, indent=1))


def pov_material(material, folder):
    """A material whose image's path is whole."""
    image = material["base_image"]
    return {**material, "base_image": image and str((folder / image).resolve())}


class Reader:
    """A GLB's arrays, primitives and materials."""

    def __init__(self, glb):
        self.glb = glb
        self.document = glb.document
        self.binary = glb.binary()

    def array(self, index):
        """An accessor's elements, a row each; whole numbers that are normalised become fractions."""
        accessor = self.document["accessors"][index]
        if "sparse" in accessor or "bufferView" not in accessor:
            sys.exit(f"{self.glb.path}: accessor {index} is sparse or empty, which is not converted here")
        view = self.document["bufferViews"][accessor["bufferView"]]
        kind = numpy.dtype(NUMBERS[accessor["componentType"]])
        width, count = WIDTHS[accessor["type"]], accessor["count"]
        start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        stride = view.get("byteStride", width * kind.itemsize)
        array = numpy.ndarray((count, width), kind, self.binary, start, (stride, kind.itemsize))
        if accessor.get("normalized"):
            return numpy.maximum(array.astype("<f4") / numpy.iinfo(kind).max, -1)
        return array

    def meshes(self):
        """Every primitive of triangles in the world, as often as it is placed."""
        for mesh, matrix in self.glb.placed_meshes():
            m = numpy.array(matrix, float).reshape(4, 4).T
            for primitive in mesh["primitives"]:
                if primitive.get("mode", 4) == 4:
                    yield self.mesh(primitive, m)

    def mesh(self, primitive, m):
        attributes = primitive["attributes"]
        positions = self.array(attributes["POSITION"]).astype(float) @ m[:3, :3].T + m[:3, 3]
        indexed = "indices" in primitive
        corners = self.array(primitive["indices"]) if indexed else numpy.arange(len(positions))
        normals = None
        if "NORMAL" in attributes:
            normals = self.array(attributes["NORMAL"]).astype(float) @ numpy.linalg.inv(m[:3, :3])
            normals /= numpy.maximum(numpy.linalg.norm(normals, axis=1, keepdims=True), 1e-30)
        uv = self.array(attributes["TEXCOORD_0"]).astype(float) if "TEXCOORD_0" in attributes else None
        return {
            "positions": positions,
            "normals": normals,
            # The row that glTF calls first is the last one to the others.
            "uv": None if uv is None else uv * (1, -1) + (0, 1),
            "corners": corners.reshape(-1, 3),
            "material": primitive.get("material", -1) % (len(self.document.get("materials", [])) + 1),
        }

    def materials(self, folder):
        """The materials and, last, glTF's own for what has none; images are written to the folder."""
        return [self.material(m, folder) for m in [*self.document.get("materials", []), {}]]

    def material(self, material, folder):
        pbr = material.get("pbrMetallicRoughness", {})
        color = pbr.get("baseColorFactor", [1, 1, 1, 1])
        both = self.image(pbr.get("metallicRoughnessTexture"))
        described = {
            "base": color[:3],
            "opacity": color[3] if material.get("alphaMode", "OPAQUE") == "BLEND" else 1,
            "metallic": pbr.get("metallicFactor", 1),
            "roughness": pbr.get("roughnessFactor", 1),
            "base_image": self.kept(pbr.get("baseColorTexture"), folder),
            "normal_image": self.kept(material.get("normalTexture"), folder),
            "metallic_image": None,
            "roughness_image": None,
        }
        if both is not None:
            number, data, _ = both
            picture = Image.open(io.BytesIO(data)).convert("RGB")
            for channel, name in ((1, "roughness"), (2, "metallic")):
                described[f"{name}_image"] = f"{number}-{name}.png"
                picture.getchannel(channel).save(folder / f"{number}-{name}.png", compress_level=1)
        return described

    def image(self, use):
        """The number, bytes and ending of a texture's image."""
        source = self.document["textures"][use["index"]].get("source") if use else None
        if source is None:
            return None
        image = self.document["images"][source]
        if "bufferView" not in image:
            sys.exit(f"{self.glb.path}: image {source} is not in the GLB, which is not converted here")
        view = self.document["bufferViews"][image["bufferView"]]
        start = view.get("byteOffset", 0)
        ending = {"image/jpeg": "jpg", "image/png": "png"}.get(image["mimeType"])
        if ending is None:
            sys.exit(f"{self.glb.path}: image {source} is of {image['mimeType']}, which is not converted here")
        return source, self.binary[start : start + view["byteLength"]], ending

    def kept(self, use, folder):
        """The name of a texture's image, written as it is."""
        found = self.image(use)
        if found is None:
            return None
        number, data, ending = found
        (folder / f"{number}.{ending}").write_bytes(data)
        return f"{number}.{ending}"


def write_ply(path, mesh):
    """A binary PLY with what the mesh has."""
    named = [("xyz", mesh["positions"]), (("nx", "ny", "nz"), mesh["normals"]), ("st", mesh["uv"])]
    present = [(names, values) for names, values in named if values is not None]
    names = [name for group, _ in present for name in group]
    vertices = numpy.hstack([values for _, values in present]).astype("<f4")
    faces = numpy.empty(len(mesh["corners"]), [("count", "u1"), ("corners", "<i4", 3)])
    faces["count"], faces["corners"] = 3, mesh["corners"]
    header = ["ply", "format binary_little_endian 1.0", f"element vertex {len(vertices)}"]
    header += [f"property float {name}" for name in names]
    header += [f"element face {len(faces)}", "property list uchar int vertex_indices", "end_header", ""]
    with open(path, "wb") as file:
        file.write("\n".join(header).encode())
        file.write(vertices.tobytes())
        file.write(faces.tobytes())


if __name__ == "__main__":
    main(*sys.argv[1:4])
