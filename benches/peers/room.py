"""A furnished room: walls of two triangles beside cushions, curtains and cups of thousands. x across, y up, z deep."""

import math

WIDE, HIGH, DEEP = 5.2, 2.6, 4.8


def wood(u, v):
    """Planks with a grain."""
    plank = int(v * 8)
    grain = math.sin(60 * (v * 8 % 1) + 4 * math.sin(9 * u + 2.4 * plank)) * 0.06 - 0.2 * (v * 8 % 1 < 0.03)
    return (0.55 + grain + 0.03 * (plank * 7 % 5), 0.36 + grain + 0.02 * (plank * 7 % 5), 0.2 + grain)


def plaster(u, v):
    """Nearly white, uneven."""
    rough = 0.02 * math.sin(171 * u + 40 * math.sin(57 * v)) * math.sin(191 * v + 30 * math.sin(63 * u))
    return (0.86 + rough, 0.84 + rough, 0.78 + rough)


def rug(u, v):
    """Rings in diamonds."""
    d = abs((u * 6) % 1 - 0.5) + abs((v * 4) % 1 - 0.5)
    return (0.6, 0.15, 0.12) if d < 0.25 else (0.8, 0.7, 0.5) if d < 0.4 else (0.12, 0.16, 0.35)


MATERIALS = {
    "floor": {"texture": wood, "metallic": 0.0, "roughness": 0.4},
    "wall": {"texture": plaster, "metallic": 0.0, "roughness": 0.9},
    "rug": {"texture": rug, "metallic": 0.0, "roughness": 1.0},
    "wood": {"color": (0.3, 0.17, 0.08), "metallic": 0.0, "roughness": 0.35},
    "metal": {"color": (0.8, 0.78, 0.72), "metallic": 1.0, "roughness": 0.15},
    "cloth": {"color": (0.2, 0.35, 0.4), "metallic": 0.0, "roughness": 1.0},
    "curtain": {"color": (0.75, 0.6, 0.4), "metallic": 0.0, "roughness": 0.9},
    "china": {"color": (0.85, 0.85, 0.9), "metallic": 0.0, "roughness": 0.1},
    "red book": {"color": (0.5, 0.08, 0.06), "metallic": 0.0, "roughness": 0.6},
    "blue book": {"color": (0.08, 0.15, 0.4), "metallic": 0.0, "roughness": 0.6},
    "green book": {"color": (0.1, 0.3, 0.15), "metallic": 0.0, "roughness": 0.6},
}


class Part:
    """What is made of one material: flat lists of numbers, as glTF has them."""

    def __init__(self, material):
        self.material = material
        self.positions, self.normals, self.uv, self.corners = [], [], [], []

    def grid(self, point, across, along):
        """A curved surface, from a function of (u, v) in [0, 1]: two triangles a cell, smooth normals."""
        first = len(self.positions) // 3
        step = 1e-4
        for j in range(along + 1):
            for i in range(across + 1):
                u, v = i / across, j / along
                # Differences are taken a little inside, for at a pole one direction has none.
                a, b = min(max(u, step), 1 - step), min(max(v, step), 1 - step)
                du = minus(point(a + step, b), point(a - step, b))
                dv = minus(point(a, b + step), point(a, b - step))
                self.vertex(point(u, v), unit(cross(dv, du)), (u, v))
        for j in range(along):
            for i in range(across):
                a = first + j * (across + 1) + i
                c = a + across + 1
                self.corners += (a, c, a + 1, a + 1, c, c + 1)

    def box(self, low, high):
        """A box; each side has the whole of the texture."""
        for axis in range(3):
            for end in (low, high):
                first = len(self.positions) // 3
                normal = [0.0, 0.0, 0.0]
                normal[axis] = 1.0 if end is high else -1.0
                for u, v in ((0, 0), (1, 0), (0, 1), (1, 1)):
                    corner = [0.0, 0.0, 0.0]
                    corner[axis] = end[axis]
                    for other, t in ((axis + 1) % 3, u), ((axis + 2) % 3, v):
                        corner[other] = (low, high)[t][other]
                    self.vertex(corner, normal, (u, v))
                turn = (0, 1, 2, 2, 1, 3) if end is high else (0, 2, 1, 1, 2, 3)
                self.corners += [first + k for k in turn]

    def lathe(self, foot, profile, around=32, along=24):
        """A turned body: `profile` gives radius and height of a number from 0 to 1."""

        def point(u, v):
            radius, height = profile(v)
            angle = 2 * math.pi * u
            return (foot[0] + radius * math.cos(angle), foot[1] + height, foot[2] + radius * math.sin(angle))

        self.grid(point, around, along)

    def cushion(self, centre, half, across=48):
        """A box without an edge: a superellipsoid."""
        bent = lambda a: math.copysign(abs(a) ** 0.35, a)

        def point(u, v):
            angle, rise = 2 * math.pi * u, math.pi * (v - 0.5)
            round_ = (
                bent(math.cos(rise)) * bent(math.cos(angle)),
                bent(math.sin(rise)),
                bent(math.cos(rise)) * bent(math.sin(angle)),
            )
            return tuple(c + h * r for c, h, r in zip(centre, half, round_))

        self.grid(point, across, across)

    def vertex(self, position, normal, uv):
        """One vertex."""
        self.positions += position
        self.normals += normal
        self.uv += uv


def parts():
    """The room and what stands in it."""
    made = {name: Part(name) for name in MATERIALS}
    shell(made)
    table(made, 2.4, 1.9)
    shelves(made)
    for k in range(3):
        made["cloth"].cushion((0.55 + 0.0, 0.35, 1.5 + 0.75 * k), (0.42, 0.16, 0.37))
        made["cloth"].cushion((0.2, 0.7, 1.5 + 0.75 * k), (0.14, 0.32, 0.36))
    for left in (0.7, 3.3):
        for fold in range(2):
            start = left + 0.9 * fold
            made["curtain"].grid(
                lambda u, v, s=start: (s + 0.55 * u, 0.3 + 2.1 * v, 0.08 + 0.04 * math.sin(50 * u) * (1.2 - v)), 120, 48
            )
    return list(made.values())


def shell(made):
    """Floor and walls, thin boxes, without a ceiling: the sun shines in, the only light that all renderers can share."""
    made["floor"].box((0, -0.05, 0), (WIDE, 0, DEEP))
    wall = made["wall"]
    wall.box((-0.05, 0, 0), (0, HIGH, DEEP))
    wall.box((WIDE, 0, 0), (WIDE + 0.05, HIGH, DEEP))
    wall.box((0, 0, -0.05), (WIDE, HIGH, 0))
    wall.box((0, 0, DEEP), (WIDE, HIGH, DEEP + 0.05))
    made["rug"].box((1.2, 0.0, 0.8), (3.6, 0.012, 3.0))


def table(made, x, z):
    """A table laid for four, their chairs, and a lamp above."""
    leg = lambda v: (0.03 + 0.012 * math.sin(18 * v), 0.72 * v)
    made["wood"].box((x - 0.8, 0.72, z - 0.45), (x + 0.8, 0.76, z + 0.45))
    cup = lambda v: ((0.04 * math.sin(math.pi * min(v + 0.12, 0.75)), 0.09 * v) if v < 0.9 else (0.3 * (1 - v), 0.08))
    plate = lambda v: (0.13 * v, 0.76 + 0.02 * v**4 - 0.755)
    for sx in (-1, 1):
        for sz in (-1, 1):
            made["wood"].lathe((x + 0.72 * sx, 0, z + 0.37 * sz), leg)
            made["china"].lathe((x + 0.4 * sx, 0.755, z + 0.25 * sz), plate, 48, 16)
            made["china"].lathe((x + 0.65 * sx, 0.76, z + 0.25 * sz), cup, 40, 32)
            chair(made, x + 0.4 * sx, z + 0.75 * sz, sz)
    shade = lambda v: (0.06 + 0.2 * (1 - v) ** 0.5, 0.22 * v)
    made["metal"].lathe((x, 1.75, z), shade, 64, 32)
    made["metal"].lathe((x, 1.95, z), lambda v: (0.008, 0.65 * v), 12, 2)
    bowl = lambda v: (0.16 * math.sin(1.5 * v + 0.05), 0.1 * v * v)
    made["metal"].lathe((x, 0.765, z), bowl, 64, 32)
    for k in range(5):
        angle = 2 * math.pi * k / 5
        made["curtain"].cushion((x + 0.07 * math.cos(angle), 0.84, z + 0.07 * math.sin(angle)), (0.035,) * 3, 24)


def chair(made, x, z, back):
    """A chair with a back of spindles, which is towards -z or +z."""
    seat = 0.45
    made["wood"].box((x - 0.2, seat - 0.02, z - 0.2), (x + 0.2, seat, z + 0.2))
    made["cloth"].cushion((x, seat + 0.02, z), (0.19, 0.03, 0.19), 32)
    turned = lambda high: lambda v: (0.016 + 0.005 * math.sin(25 * v), high * v)
    for sx in (-0.17, 0.17):
        for sz in (-0.17, 0.17):
            made["wood"].lathe((x + sx, 0, z + sz), turned(seat), 16, 20)
    for k in range(6):
        made["wood"].lathe((x - 0.17 + 0.068 * k, seat, z + 0.18 * back), turned(0.45), 12, 20)
    made["wood"].box((x - 0.2, seat + 0.44, z + 0.18 * back - 0.02), (x + 0.2, seat + 0.5, z + 0.18 * back + 0.02))


def shelves(made):
    """A case of books at the right wall."""
    books = [made[name] for name in ("red book", "blue book", "green book")]
    for level in range(6):
        y = 0.1 + 0.38 * level
        made["wood"].box((WIDE - 0.32, y - 0.02, 0.4), (WIDE - 0.01, y, 2.6))
        z = 0.42
        for k in range(70):
            thick = 0.02 + 0.004 * (k * 7 % 5)
            if z + thick > 2.58 or level == 5:
                break
            tall, deep = 0.24 + 0.015 * (k * 5 % 7), 0.18 + 0.01 * (k * 3 % 6)
            books[(k * k + level) % 3].box((WIDE - 0.02 - deep, y, z), (WIDE - 0.02, y + tall, z + thick - 0.002))
            z += thick
    for side in (0.37, 2.6):
        made["wood"].box((WIDE - 0.32, 0, side), (WIDE - 0.01, 2.05, side + 0.03))


def minus(a, b):
    """The difference of two points."""
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def cross(a, b):
    """The cross product."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(v):
    """A vector of length 1, or straight up where there is none."""
    length = math.hypot(*v)
    return (v[0] / length, v[1] / length, v[2] / length) if length > 0 else (0.0, 1.0, 0.0)
