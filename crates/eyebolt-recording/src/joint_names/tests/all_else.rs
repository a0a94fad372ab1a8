//! Of what a source tells, only the joints change.

use super::support::robot;
use crate::Recording;
use crate::color::{CameraPicture, ColorImage};
use crate::error::RecordingError;
use crate::frame::{Frame, Range};
use crate::frame_source::FrameSource;
use crate::joint_names::{JointNotes, NotedJoints};
use crate::manifest::RobotSection;
use crate::message::StaticTransform;
use crate::provenance::Provenance;
use eyebolt_geometry::{DepthImage, Distortion, PinholeCamera, Transform};
use eyebolt_robot::JointPositions;

/// A source that tells all that can be told, nothing of which is what a source tells by default.
#[derive(Clone, Debug)]
struct TellsAll {
    camera: PinholeCamera,
    names: Vec<String>,
    robot: RobotSection,
    transforms: Vec<StaticTransform>,
    provenance: Provenance,
}

fn tells_all() -> TellsAll {
    let transform = StaticTransform {
        parent: "a".to_owned(),
        child: "b".to_owned(),
        translation_m: [1.0, 2.0, 3.0],
        rotation_xyzw: [0.0, 0.0, 0.0, 1.0],
    };
    TellsAll {
        camera: PinholeCamera::new(2, 1, 4.0, 4.0, 0.5, 0.0, Distortion::None).unwrap(),
        names: vec!["first".to_owned()],
        robot: RobotSection { base: Some("base".to_owned()), ..RobotSection::default() },
        transforms: vec![transform],
        provenance: Provenance { name: "all".to_owned(), ..Provenance::default() },
    }
}

fn depth(metres: f32) -> DepthImage {
    DepthImage::new(2, 1, vec![metres; 2]).unwrap()
}

fn picture(red: u8) -> ColorImage {
    ColorImage { width: 2, height: 1, rgb: vec![[red, 0, 0]; 2] }
}

impl FrameSource for TellsAll {
    fn camera(&self) -> Option<&PinholeCamera> {
        Some(&self.camera)
    }
    fn camera_frame_id(&self) -> Option<&str> {
        Some("optical")
    }
    fn static_transforms(&self) -> &[StaticTransform] {
        &self.transforms
    }
    fn robot(&self) -> &RobotSection {
        &self.robot
    }
    fn frame_names(&self) -> &[String] {
        &self.names
    }
    fn stamp_ns(&self, index: usize) -> Option<i64> {
        Some(7 + index as i64)
    }
    fn has_masks(&self) -> bool {
        true
    }
    fn read_frame(&self, _: usize) -> Result<Frame, RecordingError> {
        let joints = JointPositions::default();
        Ok(Frame { name: "first".to_owned(), range: Range::Depth(depth(1.0)), mask: None, joints })
    }
    fn read_joints(&self, _: usize) -> Result<JointPositions, RecordingError> {
        Ok(JointPositions::default())
    }
    fn read_color(&self, _: usize) -> Result<Option<ColorImage>, RecordingError> {
        Ok(Some(picture(3)))
    }
    fn read_picture(&self, _: usize) -> Result<Option<CameraPicture>, RecordingError> {
        let (camera, depth_from_color) = (self.camera.clone(), Transform::identity());
        Ok(Some(CameraPicture { picture: picture(4), camera, depth_from_color }))
    }
    fn background_count(&self) -> usize {
        2
    }
    fn read_background(&self, _: usize) -> Result<DepthImage, RecordingError> {
        Ok(depth(5.0))
    }
    fn may_leave_out(&self, _: &RecordingError) -> bool {
        true
    }
    fn in_millimetres(&self) -> bool {
        true
    }
    fn integer_unit_m(&self) -> Option<f64> {
        Some(0.25e-3)
    }
    fn backgrounds_in_millimetres(&self) -> bool {
        true
    }
    fn provenance(&self) -> &Provenance {
        &self.provenance
    }
}

#[test]
fn is_told_as_it_was() {
    let all = tells_all();
    let source = Recording::Other(Box::new(all.clone()));
    let noted = NotedJoints::new(source, JointNotes::default(), &robot(&["a"]));
    assert_eq!(noted.camera(), all.camera());
    assert_eq!(noted.camera_frame_id(), all.camera_frame_id());
    assert_eq!(noted.static_transforms(), all.static_transforms());
    assert_eq!(noted.robot(), all.robot());
    assert_eq!(noted.frame_names(), all.frame_names());
    assert_eq!(noted.stamp_ns(0), all.stamp_ns(0));
    assert_eq!(noted.read_color(0).unwrap(), all.read_color(0).unwrap());
    assert_eq!(noted.read_picture(0).unwrap(), all.read_picture(0).unwrap());
    assert_eq!(noted.background_count(), all.background_count());
    assert_eq!(noted.read_background(0).unwrap(), all.read_background(0).unwrap());
    assert_eq!(noted.integer_unit_m(), all.integer_unit_m());
    assert!(noted.has_masks() && noted.in_millimetres() && noted.backgrounds_in_millimetres());
    let error = crate::frame_source::check_index(&all, 9).unwrap_err();
    assert!(noted.may_leave_out(&error));
    assert_eq!(noted.provenance().name, all.provenance().name);
}
