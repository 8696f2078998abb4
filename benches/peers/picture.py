"""Whether a PNG shows anything: how many colours it has. Reads what renderers write: 8 or 16 bits, not interlaced."""

import struct
import sys
import zlib

CHANNELS = {0: 1, 2: 3, 3: 1, 4: 2, 6: 4}


class NoPicture(Exception):
    """A file that is no PNG of the size that was asked for."""


def colours(path, width, height, step=3):
    """The number of different colours among every `step`th pixel of every `step`th row."""
    header, data = chunks(path)
    w, h, depth, kind, _, _, interlaced = struct.unpack(">IIBBBBB", header)
    if (w, h) != (width, height):
        raise NoPicture(f"{path}: expected {width} x {height} pixels, found {w} x {h}")
    if depth not in (8, 16) or interlaced:
        raise NoPicture(f"{path}: expected 8 or 16 bits, not interlaced; found {depth} bits, interlacing {interlaced}")
    pixel = CHANNELS[kind] * depth // 8
    rows = unfiltered(zlib.decompress(data), w * pixel, pixel)
    seen = set()
    for y, row in enumerate(rows):
        if y % step == 0:
            seen.update(row[x : x + pixel] for x in range(0, len(row), pixel * step))
    return len(seen)


def chunks(path):
    """The header's bytes and the compressed pixels."""
    try:
        file = open(path, "rb").read()
    except OSError as error:
        raise NoPicture(f"{path}: no picture was written ({error.strerror})") from error
    if file[:8] != b"\x89PNG\r\n\x1a\n":
        raise NoPicture(f"{path}: expected a PNG, found other bytes")
    at, header, data = 8, b"", b""
    while at + 8 <= len(file):
        length, name = struct.unpack(">I4s", file[at : at + 8])
        body = file[at + 8 : at + 8 + length]
        header = body if name == b"IHDR" else header
        data += body if name == b"IDAT" else b""
        at += 12 + length
    return header, data


def unfiltered(data, length, pixel):
    """The rows of a picture without PNG's filters (ISO/IEC 15948, clause 9)."""
    above = bytes(length)
    for start in range(0, len(data), length + 1):
        kind, row = data[start], bytearray(data[start + 1 : start + 1 + length])
        if kind == 1:
            for i in range(pixel, length):
                row[i] = (row[i] + row[i - pixel]) & 255
        elif kind == 2:
            row = bytearray((a + b) & 255 for a, b in zip(row, above))
        elif kind in (3, 4):
            for i in range(length):
                left = row[i - pixel] if i >= pixel else 0
                corner = above[i - pixel] if i >= pixel else 0
                guess = (left + above[i]) // 2 if kind == 3 else paeth(left, above[i], corner)
                row[i] = (row[i] + guess) & 255
        above = bytes(row)
        yield above


def paeth(left, above, corner):
    """The neighbour nearest to left + above - corner."""
    guess = left + above - corner
    return min((left, above, corner), key=lambda value: abs(guess - value))


if __name__ == "__main__":
    try:
        print(colours(sys.argv[1], int(sys.argv[2]), int(sys.argv[3])))
    except (NoPicture, KeyError, struct.error, zlib.error) as error:
        sys.exit(f"{error}")
