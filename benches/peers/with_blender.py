"""Blender's Cycles by the package bpy, on CPUs. Blender reads the GLB itself."""

import math

from peer import Row, drawn_by


def rows(place):
    """Path tracing with the job's samples and bounces, neither denoised nor adaptive."""
    version = place.module_version("bpy")
    return [Row("Cycles", version, False, place.script("with_blender"))]


def draw(job, _variant):
    import bpy
    from mathutils import Vector

    # The importer turns y up into z up.
    turned = lambda p: Vector((p[0], -p[2], p[1]))
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=job.model)
    scene = bpy.context.scene

    def added(name, data):
        thing = bpy.data.objects.new(name, data)
        scene.collection.objects.link(thing)
        return thing

    camera = added("view", bpy.data.cameras.new("view"))
    camera.location = turned(job.eye)
    towards = turned(job.target) - turned(job.eye)
    camera.rotation_euler = towards.to_track_quat("-Z", "Y").to_euler()
    camera.data.sensor_fit = "VERTICAL"
    camera.data.angle = math.radians(job.fov)
    camera.data.clip_start, camera.data.clip_end = job.near, job.far
    scene.camera = camera

    kind = "POINT" if job.lamp else "SUN"
    light = added("light", bpy.data.lights.new("light", kind))
    if job.lamp:
        light.location = turned(job.lamp)
        # Watts of a point light that gives the sun's irradiance at the target's distance.
        light.data.energy = 3 * 4 * math.pi * job.distance**2
        light.data.shadow_soft_size = 0
    else:
        light.rotation_euler = (-turned(job.sun)).to_track_quat("-Z", "Y").to_euler()
        light.data.energy = 3
        light.data.angle = 0
    scene.world = bpy.data.worlds.new("grey")
    scene.world.color = (0.3, 0.3, 0.3)

    render = scene.render
    render.engine = "CYCLES"
    render.resolution_x, render.resolution_y, render.resolution_percentage = job.width, job.height, 100
    render.threads_mode, render.threads = "FIXED", job.threads
    render.filepath = job.output
    scene.view_settings.view_transform = "Standard"
    scene.cycles.device = "CPU"
    scene.cycles.samples = job.samples
    scene.cycles.use_adaptive_sampling = False
    scene.cycles.use_denoising = False
    scene.cycles.max_bounces = job.bounces
    bpy.ops.render.render(write_still=True)


if __name__ == "__main__":
    drawn_by(draw)
