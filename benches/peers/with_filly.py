"""filly: Google's Filament, a rasteriser, by OpenGL without a display; on CPUs by Mesa's llvmpipe. It reads the GLB itself."""

from peer import Row, drawn_by


def rows(place):
    """One way: shadow maps, multisampling with the job's samples."""
    version = place.module_version("filly")
    return [Row("filly, raster", version, True, place.script("with_filly"))]


def draw(job, _variant):
    import filly
    import numpy
    from PIL import Image

    with filly.Renderer() as renderer:
        scene = renderer.create_scene()
        scene.load(job.model)
        camera = renderer.create_camera()
        camera.set_perspective(fov_y_deg=job.fov, aspect=job.width / job.height, near=job.near, far=job.far)
        camera.position = job.eye
        camera.look_at(job.target)
        scene.camera = camera
        if job.lamp:
            # Candela that give the target the light of the sun below.
            scene.add_point_light(position=job.lamp, intensity=100_000 * job.distance**2, range=job.far)
        else:
            scene.add_directional_light(direction=[-a for a in job.sun], intensity=100_000)
        scene.environment = renderer.create_environment(numpy.full((32, 64, 3), 0.3, numpy.float32))
        scene.environment_visible = False
        scene.background = [0.2, 0.2, 0.2, 1.0]
        scene.shadows = True
        scene.msaa = job.samples
        target = renderer.create_render_target(width=job.width, height=job.height)
        renderer.render(scene, target)
        Image.fromarray(target.read()).save(job.output, compress_level=1)


if __name__ == "__main__":
    drawn_by(draw)
