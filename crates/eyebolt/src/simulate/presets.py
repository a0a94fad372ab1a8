"""Camera poses as far apart as those of the paper (its table of relative camera poses), which prints no poses.

Where each camera is and where it looks is free but for the nine distances and nine angles between training and test
poses; of what fits, the poses are taken that look at the workspace from P1 on one side, P2 in front and P3 on the
other side, as the paper says. Needs numpy and scipy; prints the rows of viewpoint.rs.
"""
import numpy as np
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

# Rows: training P1..P3; columns: test P1..P3.
APART_M = np.array([[5.15, 95.12, 173.49], [102.7, 5.88, 88.12], [175.35, 86.44, 6.2]]) / 100
APART_DEG = np.array([[14, 71.33, 119.07], [96.32, 18.31, 95.37], [170.16, 112.66, 42.5]])
WORKSPACE = np.array([0.42, 0.0, 0.32])
# x, y, z of training P1..P3, metres: close on the right, in front, far on the left.
GUESS = np.array([[0.55, -0.90, 0.75], [1.25, -0.15, 0.80], [0.95, 0.85, 0.95]])


def rotation(position, turn):
    """The optical frame of a camera that looks at the workspace, then turned in its own frame."""
    z = WORKSPACE - position
    z /= np.linalg.norm(z)
    x = np.cross(z, [0, 0, 1])
    x /= np.linalg.norm(x)
    return Rotation.from_matrix(np.column_stack([x, np.cross(z, x), z])) * Rotation.from_rotvec(turn)


def misfit(unknowns):
    positions, turns = unknowns.reshape(2, 6, 3)
    cameras = [rotation(p, t) for p, t in zip(positions, turns)]
    rows = []
    for i in range(3):
        for j in range(3):
            rows.append((np.linalg.norm(positions[i] - positions[3 + j]) - APART_M[i, j]) / 0.003)
            angle = (cameras[i].inv() * cameras[3 + j]).magnitude()
            rows.append((np.degrees(angle) - APART_DEG[i, j]) / 2.0)
    # Toward the workspace with little roll, and about where the paper's pictures show them.
    rows.extend((turns / np.radians([12, 12, 25])).ravel())
    rows.extend(((positions - np.vstack([GUESS, GUESS])) / 0.25).ravel())
    return np.array(rows)


rng = np.random.default_rng(0)
best = None
for _ in range(8):
    start = np.concatenate([np.vstack([GUESS, GUESS]).ravel() + rng.normal(0, 0.05, 18), rng.normal(0, 0.3, 18)])
    fit = least_squares(misfit, start)
    if best is None or fit.cost < best.cost:
        best = fit
positions, turns = best.x.reshape(2, 6, 3)
for k in range(6):
    q = rotation(positions[k], turns[k]).as_quat()
    q *= np.sign(q[3])
    name = f"paper-{'train' if k < 3 else 'test'}-p{k % 3 + 1}"
    print(name, np.round(positions[k], 4).tolist(), np.round(q, 6).tolist())
cameras = [rotation(p, t) for p, t in zip(positions, turns)]
for i in range(3):
    print(*(f"{100 * np.linalg.norm(positions[i] - positions[3 + j]):7.2f} cm"
            f" {np.degrees((cameras[i].inv() * cameras[3 + j]).magnitude()):6.1f} deg" for j in range(3)))
print("distance to the workspace, roll-free turn:", np.linalg.norm(positions - WORKSPACE, axis=1).round(2),
      np.degrees(turns).round(0).tolist())
