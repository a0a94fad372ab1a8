#!/usr/bin/env python3
"""Sends malformed RTPS packets to every port of a domain on this machine: noise, and packets of a real participant with
bytes turned, cut short or put together.

    rtps_rubbish.py DOMAIN SECONDS [SEED]
"""

import random
import socket
import struct
import sys
import time


def ports(domain):
    base = 7400 + 250 * domain
    yield base
    yield base + 1
    for participant in range(10):
        yield base + 10 + 2 * participant
        yield base + 11 + 2 * participant


def submessage(kind, flags, body, length=None):
    return struct.pack("<BBH", kind, flags, len(body) if length is None else length) + body


def packet(draw):
    header = b"RTPS" + bytes([2, draw.choice([1, 2, 3, 4, 255])]) + draw.choice([b"\x01\x10", draw.randbytes(2)])
    header += draw.choice([draw.randbytes(12), b"\x01\x10" + bytes(10)])
    built = header
    for _ in range(draw.randint(0, 4)):
        kind = draw.choice([0x01, 0x06, 0x07, 0x08, 0x09, 0x0C, 0x0D, 0x0E, 0x0F, 0x12, 0x13, 0x15, 0x16, draw.randint(0, 255)])
        reader = draw.choice([b"\x00\x00\x03\xc7", b"\x00\x00\x04\xc7", b"\x00\x01\x00\xc7", bytes(4), draw.randbytes(4)])
        writer = draw.choice([b"\x00\x00\x03\xc2", b"\x00\x00\x04\xc2", b"\x00\x01\x00\xc2", draw.randbytes(4)])
        number = struct.pack("<iI", draw.choice([0, 0, -1, 2**31 - 1]), draw.choice([0, 1, 2, 7, 2**32 - 1]))
        if kind == 0x16:
            # Fragments, of samples at most a few megabytes: what they claim is allocated by whoever believes it.
            body = struct.pack("<HH", 0, draw.choice([28, draw.randint(0, 65535)])) + reader + writer + number
            body += struct.pack("<IHHI", draw.choice([0, 1, 2**31]), draw.choice([0, 1, 9]), draw.choice([0, 1, 1024, 65535]), draw.choice([0, 1, 5000, 4 << 20]))
            body += draw.randbytes(draw.randint(0, 200))
        elif kind in (0x06, 0x07, 0x08, 0x09, 0x12, 0x13, 0x15):
            body = reader + writer + number + number + draw.randbytes(draw.randint(0, 40))
        else:
            body = draw.randbytes(draw.randint(0, 120))
        length = draw.choice([None, None, None, 0, draw.randint(0, 65535)])
        built += submessage(kind, draw.randint(0, 255), body, length)
    return built


def parameters(draw):
    """Discovery data whose parameters are half right."""
    names = [0x05, 0x07, 0x15, 0x16, 0x1A, 0x1B, 0x1D, 0x1E, 0x23, 0x25, 0x2C, 0x2F, 0x31, 0x32, 0x33, 0x50, 0x52, 0x58, 0x5A, 0x62, 0x73, 0x77]
    body = b""
    for _ in range(draw.randint(0, 12)):
        value = draw.choice([draw.randbytes(draw.choice([0, 4, 8, 16, 24])), struct.pack("<I", draw.choice([0, 5, 2**31, 2**32 - 1])) + b"rt/a\0\0\0\0"])
        body += struct.pack("<HH", draw.choice(names), draw.choice([len(value), len(value), draw.randint(0, 65535)])) + value
    body += draw.choice([b"\x01\x00\x00\x00", b""])
    writer = draw.choice([b"\x00\x01\x00\xc2", b"\x00\x00\x03\xc2", b"\x00\x00\x04\xc2"])
    reader = bytes([writer[0], writer[1], writer[2], 0xC7])
    data = struct.pack("<HH", 0, 16) + reader + writer + struct.pack("<iI", 0, draw.randint(1, 50)) + b"\x00\x03\x00\x00" + body
    header = b"RTPS\x02\x04\x01\x10" + draw.choice([draw.randbytes(12), b"\x01\x10" + bytes(9) + bytes([draw.randint(0, 3)])])
    return header + submessage(0x15, 0x05, data)


def main():
    domain, seconds = int(sys.argv[1]), float(sys.argv[2])
    draw = random.Random(int(sys.argv[3]) if len(sys.argv) > 3 else 1)
    sender = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    targets, sent, end = list(ports(domain)), 0, time.monotonic() + seconds
    while time.monotonic() < end:
        for port in targets:
            built = draw.choice([packet, packet, parameters])(draw)
            change = draw.random()
            if change < 0.2 and built:
                place = draw.randrange(len(built))
                built = built[:place] + draw.randbytes(1) + built[place + 1 :]
            elif change < 0.3:
                built = built[: draw.randint(0, len(built))]
            elif change < 0.35:
                built = draw.randbytes(draw.randint(0, 600))
            try:
                sender.sendto(built, ("127.0.0.1", port))
            except OSError:
                continue
            sent += 1
        time.sleep(0.002)
    print(f"sent {sent} malformed packets", flush=True)


if __name__ == "__main__":
    sys.exit(main())
