"""Where everyone looks from: one camera and one light for all peers, so that their pictures can be laid side by side."""

import math


def framed(low, high):
    """A three-quarter view from above of a box, by its bounding sphere: eye, target, field of view, radius."""
    target = [(a + b) / 2 for a, b in zip(low, high)]
    radius = math.dist(low, high) / 2
    yaw, pitch, fov = math.radians(30), math.radians(25), 35.0
    towards = [math.sin(yaw) * math.cos(pitch), math.sin(pitch), math.cos(yaw) * math.cos(pitch)]
    # Boxes fill little of their sphere: a little nearer than where it fits.
    distance = 0.85 * radius / math.sin(math.radians(fov / 2))
    return [t + distance * d for t, d in zip(target, towards)], target, fov, radius


def sun_for(eye, target):
    """The unit vector towards a sun at the viewer's upper left."""
    back = unit([a - b for a, b in zip(eye, target)])
    left = unit([-back[2], 0.0, back[0]])
    return unit([b + 0.8 * s + 1.2 * u for b, s, u in zip(back, left, (0.0, 1.0, 0.0))])


def unit(v):
    """A vector of length 1."""
    length = math.hypot(*v)
    return [a / length for a in v]


def lamp_for(eye, target):
    """A lamp at the viewer's upper left, near enough to be in the same room."""
    distance = math.dist(eye, target)
    back = unit([a - b for a, b in zip(eye, target)])
    left = unit([-back[2], 0.0, back[0]])
    return [e + 0.1 * distance * (s + u) for e, s, u in zip(eye, left, (0.0, 1.0, 0.0))]
