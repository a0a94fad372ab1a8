//! Recordings of depth and joint positions, read from what people have.
//!
//! A recording is a folder of files with a `recording.toml` that says which are what:
//!
//! ```toml
//! [camera]
//! info = "camera_info.yaml"          # of the depth, as ROS prints it
//!
//! [frames]                           # {} is the frame's number or name
//! depth = "depth_{}.npy"             # or 16-bit PNG; or: cloud = "xyz_{}.npy", PCD or PLY
//! depth_unit = "m"                   # "m", "mm", or the metres of one: 0.0001, "1/5000"
//! # cloud_frame = "optical"          # clouds only; or "body" (x forward, y left, z up)
//! color = "color_{}.png"             # optional
//! mask = "mask_{}.png"               # optional, the whole arm
//! joints = "joint_states_{}.npy"     # radians; or CSV or JSON
//! joint_names = ["joint_1", "joint_2"] # in the order of NPY; optional with CSV and JSON
//!
//! [background]                       # optional: the scene without the arm
//! depth = "background_{}.npy"        # or 16-bit PNG
//! # depth_unit = "mm"                # where it is not that of the frames
//!
//! [robot]                            # optional
//! urdf = "robot.urdf"
//! base = "base_link"
//! end_effector = "hand"
//! ```
//!
//! CSV and JSON name the joints themselves, and `joint_names` then says which of them count. Without
//! `{}`, as in `joints = "joints.csv"`, one file has the joints of all frames:
//!
//! ```csv
//! frame,joint_1,joint_2
//! 0,0.5,-1.25
//! ```
//!
//! or, as `joints.json`, `{"0": {"joint_1": 0.5, "joint_2": -1.25}}`, where the inner object may as
//! well be a `sensor_msgs/JointState` with `name` and `position`.
//!
//! Paths are relative to the file. [`Folder`] reads it, [`BagRecording`] reads bags, [`InMemory`] has
//! frames that are in no file, [`BorrowedFrames`] those that are in somebody else's memory, and all are a
//! [`FrameSource`]; everything returned is in metres, radians and the optical frame. Damaged files, and sizes, units or counts that do not agree, are errors
//! that name the file, the field and what to do.

mod bag;
mod bag_recording;
mod camera_info;
mod cloud;
mod cloud_file;
mod color;
mod depth;
mod depth_unit;
mod describe;
mod error;
mod file;
mod folder;
mod frame;
mod frame_names;
mod frame_source;
#[cfg(fuzzing)]
#[doc(hidden)]
pub mod fuzzing;
mod glimpse;
mod in_memory;
mod joint_names;
mod joints;
mod manifest;
mod mask;
mod message;
mod message_depth;
mod no_recording;
mod npy;
mod own_metadata;
mod pattern;
mod png_image;
mod progress;
mod provenance;
mod recording;
mod tf_file;
mod truth;
mod unit_check;
mod words;
mod write;

pub use bag::{BagKind, is_bag};
pub use bag_recording::{
    BagOptions, BagRecording, GrowingRecording, list_topics, static_transforms,
};
pub use camera_info::CameraInfo;
pub use cloud_file::CloudFile;
pub use color::{CameraPicture, ColorImage};
pub use depth_unit::DepthUnit;
pub use describe::{Described, describe_folder, description_of};
pub use error::RecordingError;
pub use folder::Folder;
pub use frame::{Frame, Range};
pub use frame_source::FrameSource;
pub use glimpse::{Glimpse, glimpse};
pub use in_memory::{BorrowedFrame, BorrowedFrames, InMemory, Make, depth_from_millimetres};
pub use joint_names::{JointNotes, NotedJoints};
pub use manifest::{CloudFrame, RobotSection};
pub use message::{
    Diagnostic, DiagnosticLevel, Marker, MarkerShape, PaintedCloud, PointValues, StaticTransform,
    UncertainPose, diagnostic_message, markers_message, text_message,
    write_transforms as static_transforms_message,
};
pub use message_depth::message_depth;
pub use npy::{Dtype, Npy, Number};
pub use progress::{Cancelled, Progress};
pub use provenance::{
    ClockOffset, DepthChoice, DropReason, DroppedFrame, Provenance, TopicSummary,
};
pub use recording::{OPTICAL_FRAME, Recording};
pub use tf_file::parse_static_transforms;
pub use truth::{CameraMoved, Truth, read_truth};
pub use words::counted;
pub use write::{
    McapWriter, RecordingInfo, RecordingWriter, SessionWriter, Viewed, ViewerWriter, WriteError,
    WriteRobot, viewer_layout, write_folder, write_mcap, write_npy, write_static_transforms,
};
