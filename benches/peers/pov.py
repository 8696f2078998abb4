"""A scene in POV-Ray's language (3.7): meshes as `mesh2`, materials as textures.

z is turned round, for its space is left-handed.
"""

FLIP = (1, 1, -1)


def write_meshes(meshes, materials, folder):
    """Everything but camera and light, into model.inc."""
    with open(folder / "model.inc", "w") as file:
        for number, material in enumerate(materials):
            file.write(texture(number, material))
        for mesh in meshes:
            file.write("mesh2 {\n")
            vectors(file, "vertex_vectors", mesh["positions"] * FLIP)
            if mesh["normals"] is not None:
                vectors(file, "normal_vectors", mesh["normals"] * FLIP)
            if mesh["uv"] is not None:
                vectors(file, "uv_vectors", mesh["uv"])
            vectors(file, "face_indices", mesh["corners"])
            file.write(f"texture {{ material_{mesh['material']} }}\n}}\n")


def vectors(file, name, values):
    """A list of vectors with its length."""
    form = "<" + ",".join(["%d" if values.dtype.kind in "iu" else "%.7g"] * values.shape[1]) + ">,\n"
    file.write(f"{name} {{ {len(values)},\n")
    # One formatting of many rows: a mesh of a million triangles is written in seconds.
    for start in range(0, len(values), 4096):
        rows = values[start : start + 4096]
        file.write((form * len(rows)) % tuple(rows.ravel().tolist()))
    file.write("}\n")


def texture(number, material):
    """Base colour, or its image, and a highlight as wide as the roughness; a mirror where it is smooth, by its factor."""
    color = ",".join(f"{c:.6g}" for c in material["base"])
    pigment = f"color rgb <{color}> transmit {1 - material['opacity']:.6g}"
    image = material["base_image"]
    if image:
        kind = "jpeg" if image.endswith("jpg") else "png"
        pigment = f'image_map {{ {kind} "{image}" gamma srgb interpolate 2 }}'
    smooth = material["roughness"] < 0.3 and not material["roughness_image"]
    mirror = f"reflection {{ {0.6 * material['metallic'] + 0.04:.3g} metallic }}" if smooth else ""
    width = max(material["roughness"] ** 2, 0.001)
    # POV-Ray's highlight at a roughness of 1 is a veil over everything.
    shine = 0.3 * (1 - material["roughness"])
    return (
        f"#declare material_{number} = texture {{ {'uv_mapping ' if image else ''}pigment {{ {pigment} }}\n"
        f" finish {{ ambient 0.3 diffuse 0.7 specular {shine:.3g} roughness {width:.4g} {mirror} }} }}\n"
    )


def scene(job):
    """What POV-Ray is started with: camera and light about model.inc. One shadow ray a light, hard."""
    point = lambda p: "<" + ",".join(f"{a * f:.9g}" for a, f in zip(p, FLIP)) + ">"
    if job.lamp:
        light = f"light_source {{ {point(job.lamp)} color rgb 1 }}"
    else:
        light = f"light_source {{ {point([a * job.radius * 1000 for a in job.sun])} color rgb 1 parallel point_at 0 }}"
    wide = job.width / job.height
    return (
        "#version 3.7;\n"
        f"global_settings {{ assumed_gamma 1 max_trace_level {job.bounces + 1} }}\n"
        "background { color rgb 0.3 }\n"
        f"camera {{ location {point(job.eye)} up y right {wide:.9g}*x\n"
        f" angle {job.horizontal_fov:.9g} look_at {point(job.target)} }}\n"
        f"{light}\n"
        '#include "model.inc"\n'
    )
