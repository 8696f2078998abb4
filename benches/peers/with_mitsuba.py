"""Mitsuba 3, from the package mitsuba. It has no glTF: the driver converts before, to PLY and its textures."""

import json
import os
import re
from pathlib import Path

from peer import Absent, Row, drawn_by

# LLVM 14 ends the process on machines with AVX-512 ("Cannot select: fminimum"; Mitsuba 3.9.1, November 2026).
OLDEST_LLVM = 15


def rows(place):
    """Compiled at run time by LLVM and not, direct light alone and with bounces; LLVM's kernels are cached by the warm-up."""
    version = place.module_version("mitsuba")
    environment = {}
    if "DRJIT_LIBLLVM_PATH" not in os.environ:
        environment["DRJIT_LIBLLVM_PATH"] = str(newest_llvm())
    return [
        Row(f"Mitsuba, {kind}, {how}", version, False, place.script("with_mitsuba", f"{kind} {how}"), "mesh", environment)
        for kind in ("LLVM", "scalar")
        for how in ("direct", "path")
    ]


def newest_llvm():
    """The system's newest shared library of LLVM."""
    found = [
        (int(number[1]), path)
        for path in Path("/usr/lib").glob("*/libLLVM*.so*")
        if (number := re.search(r"libLLVM(?:-|\.so\.)(\d+)", path.name))
    ]
    if not found or max(found)[0] < OLDEST_LLVM:
        raise Absent(f"mitsuba is there, but no LLVM from {OLDEST_LLVM} on; apt-get install libllvm19")
    return max(found)[1]


def draw(job, variant):
    import drjit
    import mitsuba

    kind, how = variant.split()
    mitsuba.set_variant("llvm_ad_rgb" if kind == "LLVM" else "scalar_rgb")
    drjit.set_thread_count(job.threads)
    folder = Path(job.converted)
    listed = json.loads((folder / "scene.json").read_text())
    transform = mitsuba.ScalarTransform4f()
    scene = {
        "type": "scene",
        # `direct` takes no mirror ray; `path` counts the camera's ray as well.
        "integrator": {"type": "direct"} if how == "direct" else {"type": "path", "max_depth": job.bounces + 1},
        "sensor": {
            "type": "perspective",
            "fov": job.fov,
            "fov_axis": "y",
            "near_clip": job.near,
            "far_clip": job.far,
            "to_world": transform.look_at(job.eye, job.target, [0, 1, 0]),
            "sampler": {"type": "independent", "sample_count": job.samples},
            "film": {
                "type": "hdrfilm",
                "width": job.width,
                "height": job.height,
                "pixel_format": "rgb",
                "rfilter": {"type": "box"},
            },
        },
        "around": {"type": "constant", "radiance": 0.3},
        "light": light(job),
    }
    for number, material in enumerate(listed["materials"]):
        scene[f"material-{number}"] = bsdf(material, folder)
    for number, shape in enumerate(listed["shapes"]):
        scene[f"shape-{number}"] = {
            "type": "ply",
            "filename": str(folder / shape["file"]),
            "flip_tex_coords": True,
            "bsdf": {"type": "ref", "id": f"material-{shape['material']}"},
        }
    image = mitsuba.render(mitsuba.load_dict(scene), spp=job.samples)
    mitsuba.util.write_bitmap(job.output, image, write_async=False)


def light(job):
    """A sun of irradiance 3, or a lamp that gives the target as much."""
    if job.lamp:
        return {"type": "point", "position": job.lamp, "intensity": 3 * job.distance**2}
    return {"type": "directional", "direction": [-a for a in job.sun], "irradiance": 3.0}


def bsdf(material, folder):
    """glTF's metal and roughness as `principled`, seen from both sides."""
    image = lambda name, raw: {"type": "bitmap", "filename": str(folder / material[name]), "raw": raw}
    value = lambda name: image(f"{name}_image", True) if material[f"{name}_image"] else material[name]
    color = {"type": "rgb", "value": material["base"]}
    found = {
        "type": "principled",
        "base_color": image("base_image", False) if material["base_image"] else color,
        "metallic": value("metallic"),
        "roughness": value("roughness"),
    }
    if material["normal_image"]:
        found = {"type": "normalmap", "normalmap": image("normal_image", True), "bsdf": found}
    found = {"type": "twosided", "bsdf": found}
    if material["opacity"] < 1:
        found = {"type": "mask", "opacity": material["opacity"], "bsdf": found}
    return found


if __name__ == "__main__":
    drawn_by(draw)
