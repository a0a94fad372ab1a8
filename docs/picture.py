#!/usr/bin/env python3
"""Makes docs/picture.png, the picture at the head of README.md: three overlays of the demo.

    eyebolt demo -o demo
    eyebolt calibrate demo/session.mcap --save-overlay overlays -o demo/again.json
    docs/picture.py overlays/overlay_{0,30,40}.png docs/picture.png

Half the size, and in few greys, so that it stays below 60 kB. Nothing is needed but Python.
"""

import struct
import sys
import zlib

GREYS = 40
STEPS = 6


def read(path):
    """Rows of (r, g, b) of an RGB PNG with 8 bits a channel."""
    data = open(path, "rb").read()
    at, packed = 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at : at + 8])
        body = data[at + 8 : at + 8 + length]
        if kind == b"IHDR":
            width, height, depth, color = struct.unpack(">IIBB", body[:10])
            assert (depth, color) == (8, 2), f"{path}: not RGB with 8 bits"
        packed += body if kind == b"IDAT" else b""
        at += 12 + length
    raw, stride = zlib.decompress(packed), 3 * width
    rows, before = [], bytearray(stride)
    for v in range(height):
        kind, line = raw[v * (stride + 1)], bytearray(raw[v * (stride + 1) + 1 :][:stride])
        for i in range(stride):
            a, b = (line[i - 3] if i >= 3 else 0), before[i]
            c = before[i - 3] if i >= 3 else 0
            paeth = min((abs(b - c), 0, a), (abs(a - c), 1, b), (abs(a + b - 2 * c), 2, c))[2]
            line[i] = (line[i] + [0, a, b, (a + b) // 2, paeth][kind]) & 255
        rows.append([tuple(line[i : i + 3]) for i in range(0, stride, 3)])
        before = line
    return rows


def halved(rows):
    """Means of two by two."""
    mean = lambda v, u: tuple(
        sum(rows[2 * v + y][2 * u + x][k] for y in (0, 1) for x in (0, 1)) // 4 for k in range(3)
    )
    return [[mean(v, u) for u in range(len(rows[0]) // 2)] for v in range(len(rows) // 2)]


def few(color):
    """The nearest of a few greys, or of a few colours."""
    step = lambda x, count: round(x * (count - 1) / 255) * 255 // (count - 1)
    if max(color) - min(color) < 24:
        return (step(sum(color) / 3, GREYS),) * 3
    return tuple(step(x, STEPS) for x in color)


def write(path, rows):
    """A PNG with a palette."""
    palette = sorted({color for row in rows for color in row})
    assert len(palette) <= 256
    number = {color: index for index, color in enumerate(palette)}
    raw = b"".join(b"\0" + bytes(number[color] for color in row) for row in rows)
    chunk = lambda kind, body: (
        struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
    )
    head = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 3, 0, 0, 0)
    colors = b"".join(bytes(color) for color in palette)
    parts = [(b"IHDR", head), (b"PLTE", colors), (b"IDAT", zlib.compress(raw, 9)), (b"IEND", b"")]
    open(path, "wb").write(b"\x89PNG\r\n\x1a\n" + b"".join(chunk(*part) for part in parts))


if __name__ == "__main__":
    *inputs, output = sys.argv[1:]
    pictures = [[list(map(few, row)) for row in halved(read(path))] for path in inputs]
    write(output, [sum(rows, []) for rows in zip(*pictures)])
