//! Clouds, in whatever frame and order.

use super::sample::{Bag, CLOUD, DEPTH_TOPIC, INFO_TOPIC, MS, SIZE, START_NS, assert_says};
use super::writer;
use eyebolt_recording::{CloudFrame, FrameSource, Range};

const TOPIC: &str = "/camera/points";

/// In the optical frame: a plane a metre ahead.
fn plane() -> Vec<[f32; 3]> {
    let points = (0..12).map(|i| [(i % 4) as f32 * 0.2 - 0.3, (i / 4) as f32 * 0.2 - 0.2, 1.0]);
    points.collect()
}

fn bag(frame: &str, size: (u32, u32), points: &[[f32; 3]]) -> Bag {
    let mut bag = Bag::sample().without(DEPTH_TOPIC).without(INFO_TOPIC);
    for i in 0..14 {
        let stamp = START_NS + 100 * MS * i + 5 * MS;
        bag.add(TOPIC, CLOUD, stamp, writer::cloud(stamp, frame, size, points));
    }
    bag
}

fn body(points: &[[f32; 3]]) -> Vec<[f32; 3]> {
    points.iter().map(|[x, y, z]| [*z, -x, -y]).collect()
}

fn read(bag: &Bag) -> (Vec<[f32; 3]>, Option<(u32, u32)>) {
    match bag.open().read_frame(0).unwrap().range {
        Range::Cloud(cloud) => {
            (cloud.points().iter().map(|p| [p.x, p.y, p.z]).collect(), cloud.grid())
        }
        Range::Depth(_) => panic!("it is an image"),
    }
}

#[test]
fn both_frames_are_told_by_where_the_points_lie() {
    let plane = plane();
    assert_eq!(read(&bag("camera", SIZE, &plane)), (plane.clone(), Some(SIZE)));
    assert_eq!(read(&bag("camera", SIZE, &body(&plane))), (plane.clone(), Some(SIZE)));
    assert_eq!(read(&bag("camera", (12, 1), &plane)), (plane.clone(), None));
    assert_eq!(bag("cam_optical", SIZE, &plane).open().camera_frame_id(), Some("cam_optical"));
    // The body's frame is not the optical one, and no name of it.
    assert_eq!(bag("camera", SIZE, &body(&plane)).open().camera_frame_id(), None);
}

#[test]
fn doubt_is_an_error_that_an_option_ends() {
    let corner = [[1.0, 0.1, 1.0]; 12];
    let mut doubtful = bag("camera", SIZE, &corner);
    doubtful.assert_says(&[TOPIC, "may be in the optical frame or in the body's", "`cloud_frame`"]);
    doubtful.options.cloud_frame = Some(CloudFrame::Body);
    assert_eq!(read(&doubtful).0[0], [-0.1, -1.0, 1.0]);
    doubtful.options.cloud_frame = Some(CloudFrame::Optical);
    assert_eq!(read(&doubtful).0[0], corner[0]);
    let behind: Vec<_> = plane().iter().map(|[x, y, z]| [*x, *y, -z]).collect();
    bag("camera", SIZE, &behind).assert_says(&["the points lie before no camera"]);
    bag("optical", SIZE, &body(&plane())).assert_says(&["the frame is called optical"]);
}

#[test]
fn all_clouds_are_of_one_frame() {
    let mut bag = bag("camera", SIZE, &plane());
    // A later one that could be of either does not matter any more.
    let stamp = START_NS + 105 * MS;
    bag.on(TOPIC)[1].data = writer::cloud(stamp, "camera", SIZE, &[[1.0, 0.1, 1.0]; 12]);
    let Range::Cloud(cloud) = bag.open().read_frame(1).unwrap().range else { panic!("no cloud") };
    assert_eq!(cloud.points()[0].coords.as_slice(), [1.0, 0.1, 1.0]);
}

#[test]
fn millimetres_are_refused() {
    let plane: Vec<_> = plane().iter().map(|p| p.map(|c| c * 1000.0)).collect();
    let bag = bag("camera", SIZE, &plane).open();
    assert_says(bag.read_frame(0), &[TOPIC, "looks like millimetres", "points are in metres"]);
}

#[test]
fn masks_need_rows() {
    let mut bag = bag("camera", (12, 1), &plane());
    let mask = writer::image(START_NS, "camera", "mono8", (12, 1), &[1; 12]);
    bag.add("/mask", "sensor_msgs/Image", START_NS, mask);
    bag.options.mask_topic = Some("/mask".to_owned());
    assert_says(bag.open().read_frame(0), &[TOPIC, "list of points", "rows and columns"]);
}
