"""F3D: VTK, a rasteriser, on CPUs by Mesa's llvmpipe. The system's program needs a display; the package f3d none."""

import os

from peer import Absent, Row, drawn_by, first_line_with


def rows(place):
    """The system's F3D and the package's, whichever is there. Neither casts shadows."""
    found, missing = [], []
    for look in (of_the_system, of_the_package):
        try:
            found.append(look(place))
        except Absent as absent:
            missing.append(str(absent))
    if not found:
        raise Absent("; ".join(missing))
    return found


def of_the_system(place):
    program = place.program("f3d")
    if not os.environ.get("DISPLAY"):
        # The driver starts one where there is none and Xvfb is.
        raise Absent("f3d is there, but no display; apt-get install xvfb")
    version = first_line_with([program, "--version"], "Version:").removeprefix("Version: ").rstrip(".")
    return Row(f"F3D {version[:1]}, raster", version, True, lambda job, path: command(program, job))


def of_the_package(place):
    version = place.module_version("f3d")
    return Row(f"F3D {version[:1]}, raster", version, True, place.script("with_f3d"))


def command(program, job):
    """The command line of F3D 1; its edges are smoothed by VTK's multisampling."""
    point = lambda p: ",".join(f"{a:.9g}" for a in p)
    return [
        program, job.model, f"--output={job.output}", f"--resolution={job.width},{job.height}", "--dry-run",
        f"--camera-position={point(job.eye)}", f"--camera-focal-point={point(job.target)}", "--camera-view-up=0,1,0",
        f"--camera-view-angle={job.fov}",
    ]  # fmt: skip


def draw(job, _variant):
    import f3d

    engine = f3d.Engine.create_egl()
    # Four pictures' worth of pixels, which is F3D's own way to more samples.
    engine.options["render.effect.antialiasing.mode"] = "ssaa" if job.samples > 1 else "none"
    engine.window.size = job.width, job.height
    engine.scene.add(job.model)
    camera = engine.window.camera
    camera.position, camera.focal_point, camera.view_up = job.eye, job.target, (0.0, 1.0, 0.0)
    camera.view_angle = job.fov
    engine.window.render_to_image().save(job.output)


if __name__ == "__main__":
    drawn_by(draw)
