#!/usr/bin/env python3
"""Writes the tables of dictionaries beside this file, from OpenCV's.

    pip install opencv-contrib-python-headless==4.11.0.86
    python3 make_tables.py

A word is a marker's inner bits, row by row from its upper left corner, the first bit highest; 1 is white.
The smallest distances between words, rotations of one's own included, are printed: `dictionary.rs` has them.
"""

from pathlib import Path

import cv2
import numpy as np

TABLES = {
    "4x4": ("DICT_4X4_1000", [50, 100, 250, 1000]),
    "5x5": ("DICT_5X5_1000", [50, 100, 250, 1000]),
    "6x6": ("DICT_6X6_1000", [50, 100, 250, 1000]),
    "7x7": ("DICT_7X7_1000", [50, 100, 250, 1000]),
    "original": ("DICT_ARUCO_ORIGINAL", [1024]),
    "36h11": ("DICT_APRILTAG_36h11", [587]),
    "25h9": ("DICT_APRILTAG_25h9", [35]),
    "16h5": ("DICT_APRILTAG_16h5", [30]),
}


def distance(bits):
    """The smallest distance of any two words however turned, and of a word from itself turned."""
    turned = [np.rot90(bits, k, axes=(1, 2)).reshape(len(bits), -1).astype(int) for k in range(4)]
    flat, size = turned[0], turned[0].shape[1]
    smallest = size
    for k, other in enumerate(turned):
        apart = flat.sum(1)[:, None] + other.sum(1)[None] - 2 * flat @ other.T
        if k == 0:
            np.fill_diagonal(apart, size)
        smallest = min(smallest, int(apart.min()))
    return smallest


def main():
    for name, (opencv, counts) in TABLES.items():
        dictionary = cv2.aruco.getPredefinedDictionary(getattr(cv2.aruco, opencv))
        size = dictionary.markerSize
        bits = np.array([
            cv2.aruco.Dictionary.getBitsFromByteList(row[None], size) for row in dictionary.bytesList
        ])
        digits = (size * size + 3) // 4
        words = ["".join(map(str, marker.ravel())) for marker in bits]
        words = [f"{int(word, 2):0{digits}x}" for word in words]
        a_line = 110 // (digits + 1)
        lines = [" ".join(words[i : i + a_line]) for i in range(0, len(words), a_line)]
        Path(__file__).with_name(f"{name}.txt").write_text("\n".join(lines) + "\n")
        print(name, size, [(count, distance(bits[:count])) for count in counts])


main()
