#!/usr/bin/env python3
"""Compares the solvers with OpenCV's on the same problems, and the refinement with all of them.

    pip install opencv-python-headless==4.11.0.86
    cargo run --release --example noise_study | python3 noise_study.py > noise_study.txt

Fails if a solver is worse than OpenCV's, or another answer than the refined one is best.
"""

import json
import sys

import cv2
import numpy as np

OPENCV = {
    "tsai_lenz": cv2.CALIB_HAND_EYE_TSAI,
    "park_martin": cv2.CALIB_HAND_EYE_PARK,
    "horaud_dornaika": cv2.CALIB_HAND_EYE_HORAUD,
    "daniilidis": cv2.CALIB_HAND_EYE_DANIILIDIS,
}


def opencv(pairs, method):
    """base_from_camera of a camera that stands still: OpenCV wants the robot's poses inverted."""
    robot = [np.linalg.inv(robot) for robot, _ in pairs]
    marker = [marker for _, marker in pairs]
    parts = lambda poses: ([p[:3, :3] for p in poses], [p[:3, 3] for p in poses])
    rotation, translation = cv2.calibrateHandEye(*parts(robot), *parts(marker), method=method)
    return rotation, translation.ravel()


def off(answer, truth):
    rotation, translation = answer
    angle = cv2.Rodrigues(rotation @ truth[:3, :3].T)[0]
    return [1e3 * np.linalg.norm(translation - truth[:3, 3]), np.degrees(np.linalg.norm(angle))]


def main():
    ours, theirs = {}, {}
    for line in sys.stdin:
        problem = json.loads(line)
        truth = np.array(problem["base_from_camera"])
        pairs = np.array(problem["pairs"])
        for name, error in problem["errors_mm_deg"].items():
            ours.setdefault(name, []).append(error)
        for name, method in OPENCV.items():
            theirs.setdefault(name, []).append(off(opencv(pairs, method), truth))
    table = {**ours, **{f"opencv {name}": errors for name, errors in theirs.items()}}
    print(f"{len(ours['refined'])} problems of 5 to 20 poses, 0.3 px; OpenCV {cv2.__version__}\n")
    print("answer                    problems   mean mm median mm    90% mm   mean deg  median deg")
    summary = {}
    for name, errors in table.items():
        errors = np.array(errors)
        mm, deg = errors.T
        summary[name] = np.array([mm.mean(), np.median(mm), deg.mean(), np.median(deg)])
        print(f"{name:<26}{len(errors):>8}{mm.mean():>10.3f}{np.median(mm):>10.3f}{np.quantile(mm, 0.9):>10.3f}"
              f"{deg.mean():>11.4f}{np.median(deg):>12.4f}")
    # What differs is rounding, where the equations are the same.
    worse = [name for name in OPENCV if (summary[name] > summary[f"opencv {name}"] * 1.001 + 1e-6).any()]
    beaten = [name for name in summary if (summary["refined"] > summary[name]).any()]
    print(f"\nworse than OpenCV's: {worse or 'none'}; better than refined: {beaten or 'none'}")
    return 1 if worse or beaten else 0


sys.exit(main())
