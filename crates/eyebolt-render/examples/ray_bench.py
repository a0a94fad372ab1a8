"""Depth images by ray_bench and by Embree (Open3D's RaycastingScene), in turns, on one thread.

    pip install open3d==0.19.0 "numpy<2"
    cargo build --release -p eyebolt-render --example ray_bench
    python ray_bench.py target/release/examples/ray_bench SHARED/bench/inputs

The folder holds ray_mesh.stl, ray_K.npy and a camera_from_base per view, ray_extrinsic_*.npy.
Prints one line of JSON per view: medians over all rounds, their ratio, and how far the depths agree.
"""
import json, statistics, subprocess, sys, tempfile, time
from pathlib import Path

import numpy as np
import open3d as o3d

ROUNDS, RUNS = 5, 15
WIDTH, HEIGHT = 640, 480


def scene_of(mesh):
    scene = o3d.t.geometry.RaycastingScene(nthreads=1)
    scene.add_triangles(o3d.t.geometry.TriangleMesh.from_legacy(mesh))
    # The tree is built with the first ray.
    scene.cast_rays(o3d.core.Tensor([[0, 0, 9, 0, 0, 1.0]], o3d.core.float32), nthreads=1)
    return scene


def rays_of(K, camera_from_base):
    """Origin and direction of every pixel, base frame; directions have z = 1 in the camera, so that
    what Embree calls t is the depth."""
    u, v = np.meshgrid(np.arange(WIDTH), np.arange(HEIGHT))
    in_camera = [(u - K[0, 2]) / K[0, 0], (v - K[1, 2]) / K[1, 1], np.ones_like(u, float)]
    directions = np.stack(in_camera, -1) @ camera_from_base[:3, :3]
    origin = -camera_from_base[:3, :3].T @ camera_from_base[:3, 3]
    rays = np.concatenate([np.broadcast_to(origin, directions.shape), directions], -1)
    return o3d.core.Tensor(rays.astype(np.float32))


def compare(binary, inputs, extrinsics, scene):
    K = np.load(inputs / "ray_K.npy")
    rays = rays_of(K, np.load(extrinsics))
    ours_ms, theirs_ms = [], []
    with tempfile.TemporaryDirectory() as folder:
        depth = Path(folder) / "depth.f32"
        command = [binary, inputs / "ray_mesh.stl", "--intrinsics", inputs / "ray_K.npy"]
        command += ["--extrinsics", extrinsics, "--depth", depth, "--runs", str(RUNS)]
        for _ in range(ROUNDS):
            line = subprocess.run(command, check=True, capture_output=True, text=True).stdout
            ours_ms.append(json.loads(line)["depth_ms"])
            for _ in range(RUNS):
                start = time.perf_counter()
                hits = scene.cast_rays(rays, nthreads=1)
                theirs_ms.append(1e3 * (time.perf_counter() - start))
        ours = np.fromfile(depth, "<f4").reshape(HEIGHT, WIDTH)
    theirs = hits["t_hit"].numpy()
    theirs[~np.isfinite(theirs)] = 0
    both = (ours > 0) & (theirs > 0)
    ours_ms, theirs_ms = statistics.median(ours_ms), statistics.median(theirs_ms)
    return {
        "view": extrinsics.stem,
        "ours_ms": round(ours_ms, 3),
        "embree_ms": round(theirs_ms, 3),
        "ratio": round(ours_ms / theirs_ms, 3),
        "both_hit": int(both.sum()),
        "only_ours": int(((ours > 0) & ~both).sum()),
        "only_embree": int(((theirs > 0) & ~both).sum()),
        "largest_difference_m": float(np.abs(ours - theirs)[both].max()),
    }


def main():
    binary, inputs = sys.argv[1], Path(sys.argv[2])
    scene = scene_of(o3d.io.read_triangle_mesh(str(inputs / "ray_mesh.stl")))
    for extrinsics in sorted(inputs.glob("ray_extrinsic_*.npy")):
        print(json.dumps(compare(binary, inputs, extrinsics, scene)), flush=True)


if __name__ == "__main__":
    main()
