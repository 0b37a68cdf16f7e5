"""Writes a seed corpus: ordinary blocks and the shapes that geometry code fears. Run: make_corpus.py FOLDER

The bytes are those that fuzz_case.h reads: head, seed (2), then per polygon its head, and per ring its number of
points and their coordinates; options and labels follow, and default where the bytes end.
"""

import math
import pathlib
import struct
import sys

COARSE, GRID_STEP, METRES, FAR, RAW = range(5)
OPTIONS = 21  # of all strategies together; a few more or less only shift the labels
PACK = {
    COARSE: lambda v: struct.pack("<b", max(-128, min(127, round(v)))),
    GRID_STEP: lambda v: struct.pack("<h", max(-32768, min(32767, round(v * 1024)))),
    METRES: lambda v: struct.pack("<h", max(-32768, min(32767, round(v * 256)))),
    FAR: lambda v: struct.pack("<h", max(-32768, min(32767, round(v * 256)))),
    RAW: lambda v: struct.pack("<d", v),
}


def rectangle(x, y, width, height):
    return [(x, y), (x + width, y), (x + width, y + height), (x, y + height)]


def star(count, inner, outer):
    points = []
    for i in range(count):
        radius = outer if i % 2 else inner
        points.append((radius * math.cos(2 * math.pi * i / count), radius * math.sin(2 * math.pi * i / count)))
    return points


def comb(teeth, width, gap, height):
    points = [(0, 0), (teeth * (width + gap), 0)]
    for i in reversed(range(teeth)):
        left = i * (width + gap)
        points += [(left + width, height), (left, height), (left, 5)]
    return points


def rings():
    """name -> rings, the outer one first."""
    square = rectangle(0, 0, 100, 80)
    return {
        "rectangle": [square],
        "strip": [rectangle(0, 0, 120, 12)],
        "triangle": [[(0, 0), (90, 0), (30, 70)]],
        "l_shape": [[(0, 0), (120, 0), (120, 40), (50, 40), (50, 110), (0, 110)]],
        "courtyard": [square, rectangle(30, 30, 40, 20)[::-1]],
        "two_courtyards": [square, rectangle(10, 10, 30, 30)[::-1], rectangle(60, 40, 30, 30)[::-1]],
        "touching_hole": [square, rectangle(0, 30, 40, 20)[::-1]],
        "hole_corner_on_border": [square, [(0, 40), (30, 50), (30, 30)]],
        "bow_tie": [[(0, 0), (90, 90), (90, 0), (0, 90)]],
        "spike": [[(0, 0), (100, 0), (100, 80), (50.01, 80), (50, 20), (49.99, 80), (0, 80)]],
        "closed_spike": [[(0, 0), (100, 0), (100, 80), (50, 80), (50, 20), (50, 80), (0, 80)]],
        "sliver": [[(0, 0), (100, 0), (100, 0.002), (0, 0.002)]],
        "nearly_collinear": [[(0, 0), (50, 0.001), (100, 0), (100, 60), (50, 60.001), (0, 60)]],
        "star": [star(24, 20, 60)],
        "circle": [star(60, 60, 60)],
        "comb": [comb(6, 8, 6, 50)],
        "repeated_points": [[(0, 0), (0, 0), (100, 0), (100, 60), (100, 60), (0, 60)]],
        "tiny": [rectangle(0, 0, 0.01, 0.01)],
        "large": [rectangle(-125, -120, 250, 240)],
    }


def polygon_bytes(mode, shape):
    out = bytes([mode + 5 * (len(shape) - 1)])
    for ring in shape:
        out += bytes([len(ring)])
        for x, y in ring:
            out += PACK[mode](x) + PACK[mode](y)
    return out


def cases():
    for name, shape in rings().items():
        for mode in (COARSE, GRID_STEP, METRES, FAR, RAW):
            yield f"{name}_{mode}", bytes([192]) + b"\1\0" + polygon_bytes(mode, shape)
            # Default options, labels on three of four edges.
            tail = bytes([0] * OPTIONS + [7, 0, 66, 35] * 16)
            yield f"{name}_{mode}_labelled", bytes([3]) + b"\2\0" + polygon_bytes(mode, shape) + tail
    for value in (math.nan, math.inf, -math.inf, 1e300, 2097152.0, 5e-324):
        shape = [[(0, 0), (100, 0), (100, value), (0, 80)]]
        yield f"raw_{value}", bytes([192]) + b"\1\0" + polygon_bytes(RAW, shape)
    three = b"".join(polygon_bytes(METRES, [rectangle(x, 0, 60, 50)]) for x in (0, 60, 135))
    yield "three_neighbours", bytes([194]) + b"\1\0" + three


def main(folder):
    pathlib.Path(folder).mkdir(parents=True, exist_ok=True)
    count = 0
    for name, content in cases():
        (pathlib.Path(folder) / name).write_bytes(content)
        count += 1
    print(f"{folder}: {count} inputs")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: make_corpus.py FOLDER")
    main(sys.argv[1])
