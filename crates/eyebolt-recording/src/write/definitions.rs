//! Definitions of the message types, as readers of MCAP want them (`ros2msg`).

use crate::message::types;

/// The topic of transforms that never change.
pub(super) const TF_STATIC: &str = "/tf_static";
/// The topic of transforms that do.
pub(super) const TF: &str = "/tf";
/// The topic of a posed robot's shape, which is told once.
pub(super) const ROBOT: &str = "/eyebolt/robot";

/// Whether the last message of a topic should also reach those who come late.
pub(super) fn is_latched(topic: &str, message_type: &str) -> bool {
    match message_type {
        types::STRING => true,
        types::TRANSFORMS => topic != TF,
        _ => topic == ROBOT,
    }
}

const TIME: (&str, &str) = ("builtin_interfaces/Time", "int32 sec\nuint32 nanosec\n");
const HEADER: (&str, &str) =
    ("std_msgs/Header", "builtin_interfaces/Time stamp\nstring frame_id\n");
const REGION: (&str, &str) = (
    "sensor_msgs/RegionOfInterest",
    "uint32 x_offset\nuint32 y_offset\nuint32 height\nuint32 width\nbool do_rectify\n",
);
const POINT_FIELD: (&str, &str) = (
    "sensor_msgs/PointField",
    "uint8 INT8=1\nuint8 UINT8=2\nuint8 INT16=3\nuint8 UINT16=4\nuint8 INT32=5\nuint8 UINT32=6\n\
     uint8 FLOAT32=7\nuint8 FLOAT64=8\nstring name\nuint32 offset\nuint8 datatype\nuint32 count\n",
);
const STAMPED: (&str, &str) = (
    "geometry_msgs/TransformStamped",
    "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/Transform transform\n",
);
const TRANSFORM: (&str, &str) = (
    "geometry_msgs/Transform",
    "geometry_msgs/Vector3 translation\ngeometry_msgs/Quaternion rotation\n",
);
const VECTOR: (&str, &str) = ("geometry_msgs/Vector3", "float64 x\nfloat64 y\nfloat64 z\n");
const QUATERNION: (&str, &str) =
    ("geometry_msgs/Quaternion", "float64 x 0\nfloat64 y 0\nfloat64 z 0\nfloat64 w 1\n");

const POSED: (&str, &str) =
    ("geometry_msgs/PoseWithCovariance", "geometry_msgs/Pose pose\nfloat64[36] covariance\n");
const POSE: (&str, &str) =
    ("geometry_msgs/Pose", "geometry_msgs/Point position\ngeometry_msgs/Quaternion orientation\n");
const POINT: (&str, &str) = ("geometry_msgs/Point", "float64 x\nfloat64 y\nfloat64 z\n");
const COLOR: (&str, &str) = ("std_msgs/ColorRGBA", "float32 r\nfloat32 g\nfloat32 b\nfloat32 a\n");
const DURATION: (&str, &str) = ("builtin_interfaces/Duration", "int32 sec\nuint32 nanosec\n");
const UV: (&str, &str) = ("visualization_msgs/UVCoordinate", "float32 u\nfloat32 v\n");
const MESH_FILE: (&str, &str) = ("visualization_msgs/MeshFile", "string filename\nuint8[] data\n");
const MARKER: (&str, &str) = (
    "visualization_msgs/Marker",
    "std_msgs/Header header\nstring ns\nint32 id\nint32 type\nint32 action\n\
     geometry_msgs/Pose pose\ngeometry_msgs/Vector3 scale\nstd_msgs/ColorRGBA color\n\
     builtin_interfaces/Duration lifetime\nbool frame_locked\ngeometry_msgs/Point[] points\n\
     std_msgs/ColorRGBA[] colors\nstring texture_resource\nsensor_msgs/CompressedImage texture\n\
     visualization_msgs/UVCoordinate[] uv_coordinates\nstring text\nstring mesh_resource\n\
     visualization_msgs/MeshFile mesh_file\nbool mesh_use_embedded_materials\n",
);

const IMAGE: &str = "std_msgs/Header header\nuint32 height\nuint32 width\nstring encoding\n\
                     uint8 is_bigendian\nuint32 step\nuint8[] data\n";
const COMPRESSED: &str = "std_msgs/Header header\nstring format\nuint8[] data\n";
const TEXTURE: (&str, &str) = ("sensor_msgs/CompressedImage", COMPRESSED);
const CLOUD: &str = "std_msgs/Header header\nuint32 height\nuint32 width\n\
                     sensor_msgs/PointField[] fields\nbool is_bigendian\nuint32 point_step\n\
                     uint32 row_step\nuint8[] data\nbool is_dense\n";
const CAMERA_INFO: &str = "std_msgs/Header header\nuint32 height\nuint32 width\n\
                           string distortion_model\nfloat64[] d\nfloat64[9] k\nfloat64[9] r\n\
                           float64[12] p\nuint32 binning_x\nuint32 binning_y\n\
                           sensor_msgs/RegionOfInterest roi\n";
const JOINT_STATE: &str = "std_msgs/Header header\nstring[] name\nfloat64[] position\n\
                           float64[] velocity\nfloat64[] effort\n";

/// The definition of `message_type` followed by those of the types in it; `None` for types that
/// are not written.
pub(super) fn definition(message_type: &str) -> Option<String> {
    let (own, parts): (&str, &[(&str, &str)]) = match message_type {
        types::IMAGE => (IMAGE, &[HEADER, TIME]),
        types::COMPRESSED_IMAGE => (COMPRESSED, &[HEADER, TIME]),
        types::CLOUD => (CLOUD, &[HEADER, TIME, POINT_FIELD]),
        types::CAMERA_INFO => (CAMERA_INFO, &[HEADER, TIME, REGION]),
        types::JOINT_STATE => (JOINT_STATE, &[HEADER, TIME]),
        types::POSE => (
            "std_msgs/Header header\ngeometry_msgs/PoseWithCovariance pose\n",
            &[HEADER, TIME, POSED, POSE, POINT, QUATERNION],
        ),
        types::STRING => ("string data\n", &[]),
        types::TRANSFORMS => (
            "geometry_msgs/TransformStamped[] transforms\n",
            &[STAMPED, HEADER, TIME, TRANSFORM, VECTOR, QUATERNION],
        ),
        types::MARKERS => (
            "visualization_msgs/Marker[] markers\n",
            &[
                MARKER, HEADER, TIME, POSE, POINT, QUATERNION, VECTOR, COLOR, DURATION, UV,
                MESH_FILE, TEXTURE,
            ],
        ),
        _ => return None,
    };
    let line = "=".repeat(80);
    let parts = parts.iter().map(|(name, fields)| format!("{line}\nMSG: {name}\n{fields}"));
    Some(std::iter::once(own.to_owned()).chain(parts).collect())
}
