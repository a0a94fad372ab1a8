"""Makes the files in `seeds/` that fuzzing begins with: a small one of every kind of every format.

    pip install numpy==1.26.4 rosbags==0.11.9 mcap==1.6.0 lz4==4.4.5 zstandard==0.25.0 safetensors==0.8.0
    python make_seeds.py

What the tests of the crates have as fixtures is copied from there. Check sums inside MCAP are left
out, so that a changed byte is a changed file and not a wrong sum.
"""

import json
import shutil
import sqlite3
import struct
import zlib
from pathlib import Path

import numpy as np
import zstandard
from mcap.writer import CompressionType
from mcap.writer import Writer as McapWriter
from rosbags.rosbag1 import Writer as Ros1Writer
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from safetensors.numpy import save

HERE = Path(__file__).parent
SEEDS = HERE / "seeds"
RECORDING = HERE.parent / "crates/eyebolt-recording/tests/fixtures"
ROBOT = HERE.parent / "crates/eyebolt-robot/tests/fixtures"
WIDTH, HEIGHT = 8, 6
START_NS = 1_700_000_000_000_000_000
ROS2 = get_typestore(Stores.ROS2_HUMBLE)
ROS1 = get_typestore(Stores.ROS1_NOETIC)
TRANSFORMS = "tf2_msgs/msg/TFMessage"
ROS1.register(get_types_from_msg("geometry_msgs/TransformStamped[] transforms\n", TRANSFORMS))


def put(name: str, content: bytes | str) -> None:
    path = SEEDS / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content.encode() if isinstance(content, str) else content)


def npy(array: np.ndarray) -> bytes:
    path = SEEDS / "array.npy"
    np.save(path, array)
    content = path.read_bytes()
    path.unlink()
    return content


def npz(**arrays: np.ndarray) -> bytes:
    path = SEEDS / "arrays.npz"
    np.savez(path, **arrays)
    content = path.read_bytes()
    path.unlink()
    return content


def depth_m() -> np.ndarray:
    return np.linspace(0.5, 1.5, WIDTH * HEIGHT, dtype=np.float32).reshape(HEIGHT, WIDTH)


def depth_mm() -> np.ndarray:
    return (depth_m() * 1000).astype(np.uint16)


def points() -> np.ndarray:
    v, u = np.mgrid[0:HEIGHT, 0:WIDTH].astype(np.float32)
    return np.stack([(u - 4) * depth_m() / 8, (v - 3) * depth_m() / 8, depth_m()], axis=2)


def png(color: int, bits: int, rows: list[bytes], palette: bytes = b"") -> bytes:
    """A picture of WIDTH x HEIGHT; every row with the filter of its number."""

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", WIDTH, HEIGHT, bits, color, 0, 0, 0)
    data = b"".join(bytes([number % 5]) + row for number, row in enumerate(rows))
    parts = [chunk(b"IHDR", header), chunk(b"IDAT", zlib.compress(data)), chunk(b"IEND", b"")]
    if palette:
        parts.insert(1, chunk(b"PLTE", palette))
    return b"\x89PNG\r\n\x1a\n" + b"".join(parts)


def rvl(values: np.ndarray) -> bytes:
    """A. D. Wilson's code for depth, with width and height before it."""
    nibbles: list[int] = []

    def number(value: int) -> None:
        while True:
            low, value = value & 7, value >> 3
            nibbles.append(low | (8 if value else 0))
            if not value:
                return

    flat, at, previous = values.ravel().tolist(), 0, 0
    while at < len(flat):
        for zero in (True, False):
            end = at
            while end < len(flat) and (flat[end] == 0) == zero:
                end += 1
            number(end - at)
            for value in flat[at:end] if not zero else []:
                difference = value - previous
                number((difference << 1) ^ (difference >> 31))
                previous = value
            at = end
    nibbles += [0] * (-len(nibbles) % 8)
    words = [int("".join(f"{n:x}" for n in nibbles[i : i + 8]), 16) for i in range(0, len(nibbles), 8)]
    height, width = values.shape
    return struct.pack(f"<II{len(words)}I", width, height, *words)


def messages(store, stamp_ns: int = START_NS) -> dict[str, tuple[str, object]]:
    """A message of every kind by its topic, with its type."""
    types, ros1 = store.types, store is ROS1
    stamp = types["builtin_interfaces/msg/Time"](stamp_ns // 10**9, stamp_ns % 10**9)

    def header(frame: str):
        sequence = [7] if ros1 else []
        return types["std_msgs/msg/Header"](*sequence, stamp, frame)

    def image(encoding: str, array: np.ndarray):
        data = np.frombuffer(array.tobytes(), np.uint8)
        step = len(data) // HEIGHT
        kind = types["sensor_msgs/msg/Image"]
        return "sensor_msgs/msg/Image", kind(header("optical"), HEIGHT, WIDTH, encoding, 0, step, data)

    def compressed(fmt: str, picture: bytes, config=(0, 0.0, 0.0)):
        data = np.frombuffer(struct.pack("<iff", *config) + picture, np.uint8)
        kind = types["sensor_msgs/msg/CompressedImage"]
        return "sensor_msgs/msg/CompressedImage", kind(header("optical"), fmt, data)

    def cloud(width: int, height: int, dtype: str, code: int):
        xyz = points().astype(dtype).reshape(-1, 3)
        field = types["sensor_msgs/msg/PointField"]
        size = xyz.dtype.itemsize
        fields = [field(name, i * size, code, 1) for i, name in enumerate("xyz")]
        data = np.frombuffer(xyz.tobytes(), np.uint8)
        kind = types["sensor_msgs/msg/PointCloud2"]
        return "sensor_msgs/msg/PointCloud2", kind(
            header("optical"), height, width, fields, False, 3 * size, 3 * size * width, data, False
        )

    def camera_info():
        k = np.array([8.0, 0, 3.5, 0, 8, 2.5, 0, 0, 1])
        p = np.array([8.0, 0, 3.5, 0, 0, 8, 2.5, 0, 0, 0, 1, 0])
        roi = types["sensor_msgs/msg/RegionOfInterest"](0, 0, 0, 0, False)
        kind = types["sensor_msgs/msg/CameraInfo"]
        return "sensor_msgs/msg/CameraInfo", kind(
            header("optical"), HEIGHT, WIDTH, "plumb_bob", np.array([0.1, -0.2, 0, 0, 0.01]),
            k, np.eye(3).ravel(), p, 0, 0, roi,
        )

    def transforms():
        vector, turn = types["geometry_msgs/msg/Vector3"], types["geometry_msgs/msg/Quaternion"]
        pose = types["geometry_msgs/msg/Transform"](vector(0.1, 0.2, 0.3), turn(0.0, 0.0, 0.6, 0.8))
        one = types["geometry_msgs/msg/TransformStamped"](header("base"), "camera", pose)
        return TRANSFORMS, types[TRANSFORMS]([one])

    states = types["sensor_msgs/msg/JointState"](
        header(""), ["joint_1", "joint_2"], np.array([0.5, -1.25]), np.array([]), np.array([])
    )
    grey = png(0, 16, [row.astype(">u2").tobytes() for row in depth_mm()])
    inverse = (100 / depth_m()).astype(">u2")
    mask = np.eye(HEIGHT, WIDTH, dtype=np.uint8) * 255
    color = np.arange(WIDTH * HEIGHT * 3, dtype=np.uint8)
    return {
        "/depth/image": image("16UC1", depth_mm()),
        "/depth/metres": image("32FC1", depth_m()),
        "/depth/camera_info": camera_info(),
        "/depth/mask": image("mono8", mask),
        "/color/image": image("rgb8", color),
        "/depth/image/compressedDepth": compressed("16UC1; compressedDepth png", grey),
        "/depth/inverse/compressedDepth": compressed(
            "32FC1; compressedDepth png", png(0, 16, [row.tobytes() for row in inverse]), (0, 100.0, 0.0)
        ),
        "/depth/rvl/compressedDepth": compressed("16UC1; compressedDepth rvl", rvl(depth_mm())),
        "/color/image/compressed": compressed("jpeg", b"\xff\xd8"),
        "/points": cloud(WIDTH, HEIGHT, "<f4", 7),
        "/points/list": cloud(WIDTH * HEIGHT, 1, "<f8", 8),
        "/joint_states": ("sensor_msgs/msg/JointState", states),
        "/robot_description": ("std_msgs/msg/String", types["std_msgs/msg/String"]('<robot name="a"/>')),
        "/tf_static": transforms(),
    }


def serialize(store, kind: str, message, little_endian: bool = True) -> bytes:
    if store is ROS1:
        return bytes(store.serialize_ros1(message, kind))
    return bytes(store.serialize_cdr(message, kind, little_endian=little_endian))


DEPTH = [
    "/depth/image", "/depth/camera_info", "/depth/mask", "/color/image", "/joint_states",
    "/robot_description", "/tf_static",
]
COMPRESSED = ["/depth/rvl/compressedDepth", "/depth/camera_info", "/joint_states"]
CLOUD = ["/points", "/joint_states"]
BACKGROUND = "/depth/metres"


def recorded(store, topics: list[str]):
    """(topic, type, time, bytes) of two frames, with the joints at rest around them."""
    for step in range(4):
        stamp_ns = START_NS + step * 50_000_000
        for topic, (kind, message) in messages(store, stamp_ns).items():
            if topic in topics and (step in (1, 2) or topic == "/joint_states"):
                yield topic, kind, stamp_ns + 1_000_000, serialize(store, kind, message)


def mcap(topics, store=ROS2, chunked=True, compression=CompressionType.NONE, simulated=False) -> bytes:
    path = SEEDS / "bag.mcap"
    with path.open("wb") as stream:
        writer = McapWriter(
            stream, chunk_size=2000, compression=compression, enable_crcs=False,
            enable_data_crcs=False, use_chunking=chunked,
        )
        writer.start(profile="ros2" if store is ROS2 else "ros1", library="eyebolt")
        schemas, channels = {}, {}
        how = "cdr" if store is ROS2 else "ros1"
        for topic, kind, time_ns, data in recorded(store, topics):
            name = kind if store is ROS2 else kind.replace("/msg/", "/")
            if kind not in schemas:
                schemas[kind] = writer.register_schema(name=name, encoding="ros2msg", data=b"")
            if topic not in channels:
                channels[topic] = writer.register_channel(topic, how, schemas[kind])
            writer.add_message(channels[topic], time_ns, data, time_ns)
        known = {"base": "base", "end_effector": "hand"}
        if simulated:
            known["background_topic"] = BACKGROUND
            writer.add_metadata("eyebolt.truth", {"json": json.dumps(truth())})
        writer.add_metadata("eyebolt", known)
        writer.finish()
    content = path.read_bytes()
    path.unlink()
    return content


def ros1_bag(topics, compression: str) -> bytes:
    path = SEEDS / "recording.bag"
    writer = Ros1Writer(path)
    writer.chunk_threshold = 2000
    if compression != "none":
        writer.set_compression(Ros1Writer.CompressionFormat[compression.upper()])
    with writer:
        connections = {}
        for topic, kind, time_ns, data in recorded(ROS1, topics):
            if topic not in connections:
                connections[topic] = writer.add_connection(topic, kind, typestore=ROS1)
            writer.write(connections[topic], time_ns, data)
    content = path.read_bytes()
    path.unlink()
    return content


def db3(topics, compressed: bool = False) -> bytes:
    path = SEEDS / "bag.db3"
    path.unlink(missing_ok=True)
    database = sqlite3.connect(path)
    # Small pages, so that the file is one that can be mutated whole.
    database.execute("PRAGMA page_size = 512")
    database.execute(
        "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, "
        "serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL)"
    )
    database.execute(
        "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, "
        "timestamp INTEGER NOT NULL, data BLOB NOT NULL)"
    )
    database.execute("CREATE INDEX timestamp_idx ON messages (timestamp ASC)")
    ids: dict[str, int] = {}
    for topic, kind, time_ns, data in recorded(ROS2, topics):
        if topic not in ids:
            ids[topic] = len(ids) + 1
            database.execute("INSERT INTO topics VALUES(?, ?, ?, 'cdr', '')", (ids[topic], topic, kind))
        data = zstandard.compress(data) if compressed else data
        row = (ids[topic], time_ns, data)
        database.execute("INSERT INTO messages(topic_id, timestamp, data) VALUES(?, ?, ?)", row)
    database.commit()
    database.close()
    content = path.read_bytes()
    path.unlink()
    return content


def dataset() -> None:
    """A frame of a data set of one joint and four keypoints."""
    put("dataset/dataset.toml", DATASET_TOML)
    classes = np.arange(WIDTH * HEIGHT, dtype=np.uint8).reshape(HEIGHT, WIDTH)
    frame = npz(
        depth_m=depth_m(),
        label=classes % 3,
        keypoint=classes % 5,
        camera_matrix=np.array([[9.0, 0, 4], [0, 9, 3], [0, 0, 1]]),
        distortion=np.zeros(8),
        camera_from_end_effector=np.eye(4),
        keypoints_in_camera_m=np.ones((4, 3)),
        joint_positions=np.array([0.5]),
    )
    put("dataset/frame.npz", frame)


DATASET_TOML = """\
schema = "eyebolt.dataset/1"
convention = ""
units = ""
recordings = "recordings/*.toml"
keypoints = [
    { class = 1, link = "hand", point_in_link_m = [0.0, 0.0, 0.1] },
    { class = 2, link = "hand", point_in_link_m = [0.0, 0.1, 0.0] },
    { class = 3, link = "hand", point_in_link_m = [0.1, 0.0, 0.0] },
    { class = 4, link = "hand", point_in_link_m = [0.0, 0.0, 0.0] },
]

[robot]
name = "arm"
urdf_hash = "0"
base = "base"
end_effector = "hand"
joints = ["turn"]

[classes]
background = 0
arm = 1
end_effector = 2
ignore = 255

[symmetry]
kind = "none"
"""


def arrays_and_pictures() -> None:
    put("npy/depth.npy", npy(depth_m()))
    put("npy/millimetres.npy", npy(depth_mm()))
    put("npy/cloud.npy", npy(points()))
    put("npy/list_big_endian.npy", npy(points().reshape(-1, 3).astype(">f8")))
    put("npy/fortran.npy", npy(np.asfortranarray(points())))
    put("npy/joints.npy", npy(np.array([0.5, -1.25])))
    put("png_depth/depth.png", png(0, 16, [row.astype(">u2").tobytes() for row in depth_mm()]))
    put("png_depth/mask.png", png(0, 8, [bytes(range(8))] * HEIGHT))
    put("png_depth/bits.png", png(0, 1, [b"\xaa"] * HEIGHT))
    put("png_depth/palette.png", png(3, 2, [b"\x1b\x1b"] * HEIGHT, bytes(range(12))))
    put("png_depth/grey_alpha.png", png(4, 8, [bytes(range(16))] * HEIGHT))
    put("png_depth/rgb.png", png(2, 8, [bytes(range(24))] * HEIGHT))
    put("png_depth/rgba.png", png(6, 16, [bytes(range(64))] * HEIGHT))


def bags() -> None:
    put("mcap/plain.mcap", mcap(DEPTH, chunked=False))
    put("mcap/chunked.mcap", mcap(DEPTH))
    put("mcap/compressed_depth.mcap", mcap(COMPRESSED))
    put("mcap/cloud.mcap", mcap(CLOUD, chunked=False))
    put("mcap/simulated.mcap", mcap([*DEPTH, BACKGROUND], simulated=True))
    put("mcap/zstd.mcap", mcap(DEPTH, compression=CompressionType.ZSTD))
    put("mcap/lz4.mcap", mcap(CLOUD, compression=CompressionType.LZ4))
    put("mcap/ros1.mcap", mcap(CLOUD, store=ROS1))
    put("mcap/whole.mcap.zst", zstandard.compress(mcap(CLOUD)))
    for compression in ["none", "bz2", "lz4"]:
        put(f"ros1_bag/depth_{compression}.bag", ros1_bag(CLOUD, compression))
    for path in sorted(RECORDING.glob("*.bag")):
        put(f"ros1_bag/{path.name}", path.read_bytes())
    for path in sorted((RECORDING / "bags").rglob("*.*")):
        kind = "mcap" if ".mcap" in path.suffixes else "db3" if ".db3" in path.suffixes else ""
        if kind:
            put(f"{kind}/fixture_{path.name}", path.read_bytes())
    put("db3/depth.db3", db3(DEPTH))
    put("db3/cloud.db3", db3(CLOUD))
    put("db3/zstd.db3", db3(COMPRESSED, compressed=True))
    for topic, (kind, message) in messages(ROS2).items():
        name = topic.strip("/").replace("/", "_")
        put(f"messages/{name}.little", serialize(ROS2, kind, message))
        if name in ("depth_image", "joint_states", "points", "tf_static"):
            put(f"messages/{name}.big", serialize(ROS2, kind, message, little_endian=False))
    for topic, (kind, message) in messages(ROS1).items():
        name = topic.strip("/").replace("/", "_")
        put(f"messages/{name}.ros1", serialize(ROS1, kind, message))


METADATA = """rosbag2_bagfile_information:
  version: 5
  storage_identifier: mcap
  duration: {nanoseconds: 150000000}
  starting_time: {nanoseconds_since_epoch: 1700000000000000000}
  message_count: 12
  topics_with_message_count: []
  compression_format: ""
  compression_mode: ""
  relative_file_paths:
    - bag_0.mcap
  files:
    - path: bag_0.mcap
      message_count: 12
"""
CAMERA_ROS2 = """header:
  stamp: {sec: 1, nanosec: 2}
  frame_id: optical
height: 6
width: 8
distortion_model: plumb_bob
d:
- 0.1
- -0.2
- 0.0
- 0.0
- 0.01
k: [8.0, 0.0, 3.5, 0.0, 8.0, 2.5, 0.0, 0.0, 1.0]
r: [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]
---
"""
CAMERA_ROS1 = """header: {seq: 1, frame_id: "optical"}
height: 6
width: 8
distortion_model: "rational_polynomial"
D: [0.1, 0.2, 0.0, 0.0, 0.3, 0.4, 0.5, 0.6]
K: [8.0, 0.0, 3.5, 0.0, 8.0, 2.5, 0.0, 0.0, 1.0]
"""
CAMERA_FILE = """%YAML 1.2
---
image_width: 8
image_height: 6
camera_name: "depth"
camera_matrix: {rows: 3, cols: 3, data: [8, 0, 3.5, 0, 8, 2.5, 0, 0, 1]}
distortion_model: plumb_bob
distortion_coefficients: &d
  rows: 1
  cols: 5
  data: [.1, -2e-1, 0, 0, 0.01]
"""
TOML_DEPTH = """[camera]
info = "camera_info.yaml"

[frames]
depth = "depth_{}.npy"
depth_unit = "m"
color = "color_{}.png"
mask = "mask_{}.png"
joints = "joints_{}.npy"
joint_names = ["joint_1", "joint_2"]

[robot]
urdf = "robot.urdf"
base = "base_link"
end_effector = "hand"
"""
TOML_BACKGROUND = """camera.info = "camera_info.yaml"
background = { depth = "background_{}.npy", depth_unit = "m" }
[frames]
depth = "depth_{}.png"
depth_unit = "mm"
joints = "joints.csv"
"""
TOML_PNG = """camera.info = 'camera_info.yaml'
[frames]
depth = '''depth_{}.png'''
depth_unit = "mm"
joints = "joints.csv"
"""
TOML_CLOUD = """frames = { cloud = "cloud_{}.npy", cloud_frame = "optical", depth_unit = "m", joints = "joints.csv" }
"""
TOML_PCD = """[frames]
cloud = "cloud_{}.pcd"
cloud_frame = "body"
depth_unit = "mm"
joints = "joints_{}.npy"
joint_names = ["a", "b"]
"""


def texts() -> None:
    put("metadata/metadata.yaml", METADATA)
    put("camera_info/ros2.yaml", CAMERA_ROS2)
    put("camera_info/ros1.yaml", CAMERA_ROS1)
    put("camera_info/file.yaml", CAMERA_FILE)
    for name in ["depth", "png", "cloud", "pcd", "background"]:
        put(f"toml/{name}.toml", globals()[f"TOML_{name.upper()}"])
    put("joints/frame.csv", "joint_1,joint_2\n0.5,-1.25\n")
    put("joints/table.csv", "frame,stamp,joint_1,joint_2\n0,1.5,0.5,-1.25\n1,2.5,1e-1,2\nstart,3,0,\"1\"\n")
    put("joints/frame.json", '{"joint_1": 0.5, "joint_2": -1.25}')
    state = {"name": ["joint_1", "joint_2"], "position": [0.5, -1.25], "velocity": []}
    put("joints/state.json", json.dumps({"header": {"stamp": {"sec": 1}}, **state}))
    put("joints/table.json", json.dumps({"0": {"joint_1": 0.5, "joint_2": 1}, "1": state, "start": state}))
    put("joints/list.json", json.dumps([{"frame": frame, **state} for frame in (0, "1", "start")]))


URDF = """<?xml version="1.0"?>
<robot name="a" version="1.1">
  <link name="base"><visual><origin xyz="0 0 .1" rpy="0 0 1.5"/><geometry><cylinder radius="0.1" length="0.2"/></geometry></visual></link>
  <link name="arm">
    <visual><geometry><mesh filename="package://robot/mesh.stl" scale="1 1 -1"/></geometry></visual>
    <collision><geometry><box size="1 2 3"/></geometry></collision>
  </link>
  <link name="hand"><visual><origin quat_xyzw="0 0 0.6 0.8"/><geometry><sphere radius="0.05"/></geometry></visual></link>
  <link name="finger"><visual><geometry><capsule radius="0.01" length="0.05"/></geometry></visual></link>
  <joint name="j1" type="revolute"><parent link="base"/><child link="arm"/><axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
  <joint name="j2" type="continuous"><parent link="arm"/><child link="hand"/><axis xyz="0 1 0"/></joint>
  <joint name="j3" type="prismatic"><parent link="hand"/><child link="finger"/><mimic joint="j2" multiplier="0.1" offset="0.02"/></joint>
</robot>
"""
TRIANGLES = [[[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 0, 0], [0, 1, 0], [0, 0, 1]]]
OBJ = "# o\nmtllib a.mtl\nv 0 0 0\nv 1 0 0 1\nv 0 1 0\nv 0 0 1e0\nvn 0 0 1\ng one\nf 1//1 2//1 3//1\nf -4 -2 -1\nf 1 2 3 4\n"
DAE = """<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset><unit name="mm" meter="0.001"/><up_axis>Z_UP</up_axis></asset>
  <library_geometries><geometry id="g"><mesh>
    <source id="p"><float_array id="a" count="12">0 0 0 100 0 0 0 100 0 0 0 100</float_array>
      <technique_common><accessor source="#a" count="4" stride="3"/></technique_common></source>
    <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
    <triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><input semantic="NORMAL" source="#p" offset="1"/><p>0 0 1 0 2 0</p></triangles>
    <polylist count="1"><input semantic="VERTEX" source="#v" offset="0"/><vcount>4</vcount><p>0 1 2 3</p></polylist>
    <tristrips><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2 3</p></tristrips>
  </mesh></geometry></library_geometries>
  <library_nodes><node id="n"><rotate>0 0 1 90</rotate><instance_geometry url="#g"/></node></library_nodes>
  <library_visual_scenes><visual_scene id="s"><node>
    <matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</matrix><translate>1 2 3</translate><scale>1 1 -1</scale>
    <instance_geometry url="#g"/><instance_node url="#n"/></node></visual_scene></library_visual_scenes>
  <scene><instance_visual_scene url="#s"/></scene>
</COLLADA>
"""


def robots() -> None:
    put("urdf/all.urdf", URDF)
    put("urdf/small_arm.urdf", (ROBOT / "small_arm.urdf").read_bytes())
    binary = bytes(80) + struct.pack("<I", len(TRIANGLES))
    text = "solid a\n"
    for corners in TRIANGLES:
        binary += struct.pack("<12fH", 0, 0, 1, *np.ravel(corners), 0)
        text += "facet normal 0 0 1\n outer loop\n"
        text += "".join(f"  vertex {x} {y} {z}\n" for x, y, z in corners) + " endloop\nendfacet\n"
    put("meshes/binary.stl", binary)
    put("meshes/text.stl", text + "endsolid a\n")
    put("meshes/mesh.obj", OBJ)
    put("meshes/mesh.dae", DAE)


def clouds() -> None:
    for path in sorted((RECORDING / "clouds").iterdir()):
        if path.suffix in (".pcd", ".ply"):
            put(f"{path.suffix[1:]}/{path.name}", path.read_bytes())


def pose(matrix: np.ndarray, rotation_xyzw: list[float]) -> dict:
    translation = matrix[:3, 3].tolist()
    return {"translation_m": translation, "rotation_xyzw": rotation_xyzw, "matrix": matrix.tolist()}


def calibrations() -> None:
    base_from_camera = np.eye(4)
    # A turn of 2 atan2(0.6, 0.8) about z.
    base_from_camera[:2, :2] = [[0.28, -0.96], [0.96, 0.28]]
    base_from_camera[:3, 3] = [0.5, -0.25, 1.5]
    content = {
        "schema": "eyebolt.calibration/1",
        "verdict": "trusted",
        "reasons": [],
        "frames": {"camera": "optical", "base": "base", "end_effector": "hand"},
        "base_from_camera": pose(base_from_camera, [0.0, 0.0, 0.6, 0.8]),
        "camera_from_base": pose(np.linalg.inv(base_from_camera), [0.0, 0.0, -0.6, 0.8]),
    }
    put("calibration/trusted.json", json.dumps(content))
    refused = {**content, "verdict": "refused", "reasons": ["few frames"]}
    put("calibration/refused.json", json.dumps({**refused, "frames": {**content["frames"], "camera": None}}))
    put("calibration/tree.yaml", TREE)
    put("calibration/tree.json", json.dumps({"transforms": [
        {
            "header": {"frame_id": parent, "stamp": {"sec": 0}},
            "child_frame_id": child,
            "transform": {
                "translation": {"x": 0.1, "y": 0.2, "z": 0.3},
                "rotation": {"x": 0.0, "y": 0.0, "z": 0.6, "w": 0.8},
            },
        }
        for parent, child in [("link", "optical"), ("mount", "link")]
    ]}))


def truth() -> dict:
    """As a simulation with a camera that is bumped knows it."""
    camera_from_base = np.eye(4)
    camera_from_base[:3, :3] = [[0.28, -0.96, 0.0], [0.0, 0.0, -1.0], [0.96, 0.28, 0.0]]
    camera_from_base[:3, 3] = [0.5, -0.25, 1.5]
    moved = camera_from_base.copy()
    moved[0, 3] = 0.51
    return {
        "schema": "eyebolt.truth/1",
        "robot": "a",
        "base": "b",
        "sensor": "stereo",
        "preset": None,
        "seed": 2**64 - 1,
        "camera_from_base": camera_from_base.tolist(),
        "camera_from_base_after": [{"stamp_ns": START_NS, "camera_from_base": moved.tolist()}],
        "faults": {"clock_offset_s": 0.02, "noise": {"sigma_px": 0.1}},
    }


def truths() -> None:
    put("truth/full.json", json.dumps(truth(), indent=2))
    least = {name: truth()[name] for name in ("schema", "robot", "base", "sensor", "seed", "camera_from_base")}
    put("truth/least.json", json.dumps(least))


def tensors(norm: str = "norm.", dtype: type = np.float32) -> dict:
    """Of the network in `src/lib.rs`; `norm` is how the parameters of its batch norm begin."""
    named = {"convolution.kernel": (27, 1, 1), "convolution.bias": (1,), "linear.weight": (1, 1), "linear.bias": (1,)}
    named |= {norm + part: (1,) for part in ("weight", "bias", "running_mean", "running_var")}
    return {name: np.full(shape, 0.5, dtype) for name, shape in named.items()}


RULE = """schedule = { constant = { rate = 0.01 } }
seed = "18446744073709551615"
step = 3
updates = 3
"""
RULES = {
    "sgd": "rule = { sgd = { momentum = 0.9, weight_decay = 0.0001 } }",
    "adam": "rule = { adam = { beta1 = 0.9, beta2 = 0.999, epsilon = 1e-8, weight_decay = 0.0, decoupled = true } }",
}


def weights() -> None:
    put("weights/float32.safetensors", save(tensors()))
    put("weights/float16.safetensors", save(tensors(dtype=np.float16)))
    minkowski = tensors("norm.bn.") | {"convolution.bias": np.zeros((1, 1), np.float32)}
    put("weights/minkowski.safetensors", save(minkowski | {"norm.bn.num_batches_tracked": np.array(7)}))
    for name, rule in RULES.items():
        memory = {"sgd": ("", "first."), "adam": ("", "first.", "second.")}[name]
        all_of_it = {part + key: value for part in memory for key, value in tensors().items()}
        put(f"weights/{name}.safetensors", save(all_of_it, {"trainer": rule + "\n" + RULE}))


MODEL = """features = ["height", "one"]
classes = ["scene", "arm", "hand"]
frame = "camera_optical"
trained_on = "simulation"
commit = "0"
"""
ENCODER = """block = "bottleneck"
layers = [1, 1, 1, 1%s]
channels = [2, 2, 2, 2%s]
stem_channels = 2
stem_kernel = 3
inputs = 2
"""
POINTNET = """inputs = 2
outputs = 3
head = [4, 5]
dropout = 0.5
task = { segmentation = [[3, 3]] }
[[architecture.pointnet2.abstractions]]
samples = 8
scales = [{ radius = 0.1, neighbours = 4, channels = [3, 4] }]
"""


def models() -> None:
    voxels = "voxel_m = 0.005\n" + MODEL + "[metrics]\niou = 0.5\n"
    whole = ENCODER % (", 1, 1, 1, 1", ", 2, 2, 2, 2") + "outputs = 3\nhead = { hidden = [256, 1024] }\n"
    put("model/minkunet.toml", voxels + "[architecture.minkunet]\n" + whole)
    regression = ENCODER % ("", "") + "widths = [2048, 3]\n"
    put("model/regression.toml", voxels + "[architecture.minkunet_regression]\n" + regression)
    put("model/pointnet2.toml", MODEL + "[metrics]\n[architecture.pointnet2]\n" + POINTNET)


TREE = """transforms:
- header:
    stamp: {sec: 1, nanosec: 2}
    frame_id: link
  child_frame_id: optical
  transform:
    translation: {x: 0.1, y: 0.2, z: 0.3}
    rotation: {x: -0.5, y: 0.5, z: -0.5, w: 0.5}
---
transforms: []
---
"""


def main() -> None:
    shutil.rmtree(SEEDS, ignore_errors=True)
    SEEDS.mkdir()
    arrays_and_pictures()
    dataset()
    bags()
    texts()
    robots()
    clouds()
    calibrations()
    truths()
    weights()
    models()
    sizes = [path.stat().st_size for path in SEEDS.rglob("*") if path.is_file()]
    assert max(sizes) < 20_000 and sum(sizes) < 300_000, (max(sizes), sum(sizes))
    print(f"{len(sizes)} seeds, {sum(sizes)} bytes")


if __name__ == "__main__":
    main()
