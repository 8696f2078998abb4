"""LuxCore, from the package pyluxcore, on CPUs. It has no glTF: the driver converts before, to PLY and its textures."""

import json
import math
import time
from pathlib import Path

from peer import Row, drawn_by


def rows(place):
    """Path tracing with the job's samples and bounces."""
    version = place.module_version("pyluxcore")
    return [Row("LuxCore", version, False, place.script("with_luxcore"), "mesh")]


def draw(job, _variant):
    import pyluxcore

    pyluxcore.Init()
    folder = Path(job.converted)
    listed = json.loads((folder / "scene.json").read_text())
    described = {
        "scene.camera.type": "perspective",
        "scene.camera.lookat.orig": job.eye,
        "scene.camera.lookat.target": job.target,
        "scene.camera.up": [0, 1, 0],
        "scene.camera.fieldofview": job.horizontal_fov,
        "scene.camera.clip.near": job.near,
        "scene.camera.clip.far": job.far,
        "scene.lights.around.type": "constantinfinite",
        "scene.lights.around.color": [0.3, 0.3, 0.3],
        **light(job),
    }
    for number, material in enumerate(listed["materials"]):
        described |= of_material(number, material, folder)
    for number, shape in enumerate(listed["shapes"]):
        described[f"scene.objects.shape{number}.ply"] = str(folder / shape["file"])
        described[f"scene.objects.shape{number}.material"] = f"material{shape['material']}"
    scene = pyluxcore.Scene()
    scene.Parse(properties(pyluxcore, described))

    wanted = {
        "renderengine.type": "PATHCPU",
        "sampler.type": "SOBOL",
        "native.threads.count": job.threads,
        # The camera's ray is counted as well.
        "path.pathdepth.total": job.bounces + 1,
        "batch.haltspp": job.samples,
        "film.width": job.width,
        "film.height": job.height,
        "film.filter.type": "NONE",
        "film.imagepipelines.0.0.type": "TONEMAP_LINEAR",
        "film.imagepipelines.0.0.scale": 1.0,
        "film.imagepipelines.0.1.type": "GAMMA_CORRECTION",
        "film.imagepipelines.0.1.value": 2.2,
        "film.outputs.0.type": "RGB_IMAGEPIPELINE",
        "film.outputs.0.index": 0,
        "film.outputs.0.filename": job.output,
    }
    session = pyluxcore.RenderSession(pyluxcore.RenderConfig(properties(pyluxcore, wanted), scene))
    session.Start()
    while not session.HasDone():
        time.sleep(0.01)
        session.UpdateStats()
    session.Stop()
    session.GetFilm().Save()


def properties(pyluxcore, named):
    """LuxCore's own dictionary."""
    found = pyluxcore.Properties()
    for name, value in named.items():
        found.Set(pyluxcore.Property(name, value))
    return found


def light(job):
    """A sun of irradiance 3, or a lamp that gives the target as much."""
    if job.lamp:
        # LuxCore divides by the whole solid angle.
        gain = [3 * 4 * math.pi * job.distance**2] * 3
        return {
            "scene.lights.light.type": "point",
            "scene.lights.light.position": job.lamp,
            "scene.lights.light.color": [1, 1, 1],
            "scene.lights.light.gain": gain,
        }
    return {
        "scene.lights.light.type": "sharpdistant",
        "scene.lights.light.direction": [-a for a in job.sun],
        "scene.lights.light.color": [3, 3, 3],
    }


def of_material(number, material, folder):
    """glTF's metal and roughness as `disney`."""
    found = {f"scene.materials.material{number}.type": "disney"}

    def image(name, gamma):
        texture = f"{name}{number}"
        found[f"scene.textures.{texture}.type"] = "imagemap"
        found[f"scene.textures.{texture}.file"] = str(folder / material[name])
        found[f"scene.textures.{texture}.gamma"] = gamma
        # LuxCore's first row is the upper one.
        found[f"scene.textures.{texture}.mapping.type"] = "uvmapping2d"
        found[f"scene.textures.{texture}.mapping.uvscale"] = [1, -1]
        return texture

    def put(name, value):
        found[f"scene.materials.material{number}.{name}"] = value

    put("basecolor", image("base_image", 2.2) if material["base_image"] else material["base"])
    for name in ("metallic", "roughness"):
        put(name, image(f"{name}_image", 1.0) if material[f"{name}_image"] else material[name])
    if material["normal_image"]:
        # Before what it is used by: in another order LuxCore speaks of a syntax error in its name.
        normals = image("normal_image", 1.0)
        found[f"scene.textures.bump{number}.type"] = "normalmap"
        found[f"scene.textures.bump{number}.texture"] = normals
        put("bumptex", f"bump{number}")
    if material["opacity"] < 1:
        put("transparency", material["opacity"])
    return found


if __name__ == "__main__":
    drawn_by(draw)
