use super::*;
use crate::depth_from_millimetres;
use crate::in_memory::InMemory;
use eyebolt_geometry::Distortion;

fn camera() -> PinholeCamera {
    PinholeCamera::new(4, 3, 5.0, 5.0, 1.5, 1.0, Distortion::None).unwrap()
}

fn joints() -> JointPositions {
    [("a".to_owned(), 0.5), ("b".to_owned(), -1.0)].into_iter().collect()
}

fn frame<'a>(name: &str, millimetres: &'a [u16]) -> BorrowedFrame<'a> {
    BorrowedFrame {
        name: name.to_owned(),
        depth: Box::new(|| depth_from_millimetres(4, 3, millimetres)),
        mask: None,
        joints: joints(),
    }
}

fn says(result: Result<impl fmt::Debug, RecordingError>, parts: &[&str]) {
    let text = result.unwrap_err().to_string();
    assert!(parts.iter().all(|part| text.contains(part)), "not {parts:?} in: {text}");
}

#[test]
fn frames_are_those_that_would_be_handed_over() {
    let millimetres: Vec<u16> = (0..24).map(|at| 900 + 10 * at).collect();
    let mut owned = InMemory::new(camera());
    let mut borrowed = BorrowedFrames::new(camera()).of_integers(DepthUnit::MILLIMETRES);
    for (name, image) in ["0", "x"].into_iter().zip(millimetres.chunks(12)) {
        owned.push(name, depth_from_millimetres(4, 3, image).unwrap(), joints()).unwrap();
        borrowed.push(frame(name, image)).unwrap();
    }
    assert_eq!(owned.frame_names(), borrowed.frame_names());
    for index in 0..2 {
        let (a, b) = (owned.read_frame(index).unwrap(), borrowed.read_frame(index).unwrap());
        assert_eq!((a.name, a.mask, a.joints), (b.name, b.mask, b.joints));
        let (Range::Depth(a), Range::Depth(b)) = (a.range, b.range) else { panic!("no depth") };
        assert_eq!(a, b);
    }
    let background = &millimetres[12..];
    let index = borrowed.push_background(Box::new(|| depth_from_millimetres(4, 3, background)));
    let expected = depth_from_millimetres(4, 3, background).unwrap();
    assert_eq!(borrowed.read_background(index).unwrap(), expected);
    says(borrowed.read_background(1), &["background index 1", "1 backgrounds"]);
    assert_eq!(borrowed.integer_unit_m(), Some(1e-3));
    assert!(borrowed.in_millimetres() && !borrowed.has_masks());
}

#[test]
fn what_is_wrong_with_a_frame_is_said_when_it_is_read() {
    let (empty, good) = (vec![0; 12], vec![1000; 12]);
    let mut frames = BorrowedFrames::new(camera()).named("arrays");
    frames.push(frame("0", &empty)).unwrap();
    frames.push(frame("1", &good[..11])).unwrap();
    let wide = || DepthImage::new(3, 4, vec![1.0; 12]);
    frames.push(BorrowedFrame { depth: Box::new(wide), ..frame("2", &good) }).unwrap();
    let no_arm = || Mask::new(4, 3, vec![false; 12]);
    frames.push(BorrowedFrame { mask: Some(Box::new(no_arm)), ..frame("3", &good) }).unwrap();
    says(frames.read_frame(0), &["arrays", "frame 0", "no pixel has depth"]);
    says(frames.read_frame(1), &["frame 1", "depth", "Hand in whole images"]);
    says(frames.read_frame(2), &["frame 2", "3 x 4", "4 x 3"]);
    says(frames.read_frame(3), &["frame 3", "mask", "no pixel is set"]);
    says(frames.read_frame(4), &["frame index 4"]);
}

#[test]
fn depth_in_another_unit_than_told_is_refused() {
    let far = || DepthImage::new(4, 3, vec![1250.0; 12]);
    let good = vec![1000; 12];
    let mut frames = BorrowedFrames::new(camera()).of_floats(DepthUnit::METRES);
    frames.push(BorrowedFrame { depth: Box::new(far), ..frame("0", &good) }).unwrap();
    says(frames.read_frame(0), &["looks like millimetres", "`depth_unit`"]);
}

#[test]
fn names_and_joints_are_checked_at_once() {
    let good = vec![1000; 12];
    let mut frames = BorrowedFrames::new(camera());
    frames.push(frame("0", &good)).unwrap();
    says(frames.push(frame("0", &good)), &["frame 0", "there is a frame of this name"]);
    says(frames.push(frame("a/b", &good)), &["name of a file"]);
    let none = JointPositions::default();
    says(frames.push(BorrowedFrame { joints: none, ..frame("1", &good) }), &["joints", "none"]);
    assert_eq!(frames.frame_names(), ["0"]);
}
