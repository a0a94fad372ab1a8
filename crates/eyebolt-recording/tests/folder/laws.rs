//! What holds for every recording.

use crate::sample::{HEIGHT, PIXELS, Sample, WIDTH, npy, npy_f32, npy_f64, npy_u16, png};
use crate::sample::{png_u16, png_with_palette};
use eyebolt_recording::{Folder, Frame, FrameSource, Range};
use png::{BitDepth, ColorType};
use proptest::prelude::*;

fn depths(frame: &Frame) -> Vec<f32> {
    match &frame.range {
        Range::Depth(image) => image.depth_m().to_vec(),
        Range::Cloud(_) => panic!("a cloud"),
    }
}

fn points(frame: &Frame) -> Vec<[f32; 3]> {
    match &frame.range {
        Range::Depth(_) => panic!("a depth image"),
        Range::Cloud(cloud) => cloud.points().iter().map(|p| [p.x, p.y, p.z]).collect(),
    }
}

/// `values` of shape `[rows, columns]` with the first axis fastest.
fn columns_first<T: Copy>(values: &[T], columns: usize) -> Vec<T> {
    (0..columns).flat_map(|c| values.iter().skip(c).step_by(columns).copied()).collect()
}

proptest! {
    // Every case writes a folder.
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn depth_in_any_order_and_endianness(
        depth in proptest::collection::vec(0.2_f32..9.0, PIXELS),
        fortran in any::<bool>(),
        big in any::<bool>(),
        double in any::<bool>(),
    ) {
        let sample = Sample::depth();
        let stored = if fortran { columns_first(&depth, WIDTH) } else { depth.clone() };
        let bytes: Vec<u8> = stored.iter().flat_map(|v| match (double, big) {
            (false, false) => v.to_le_bytes().to_vec(),
            (false, true) => v.to_be_bytes().to_vec(),
            (true, false) => f64::from(*v).to_le_bytes().to_vec(),
            (true, true) => f64::from(*v).to_be_bytes().to_vec(),
        }).collect();
        let order = if big { '>' } else { '<' };
        let descr = format!("{order}f{}", if double { 8 } else { 4 });
        sample.write("depth_2.npy", &npy(&descr, fortran, &[HEIGHT, WIDTH], &bytes));
        prop_assert_eq!(depths(&sample.frame().unwrap()), depth);
    }

    #[test]
    fn integer_depth_is_the_same_in_npy_and_png(
        depth_mm in proptest::collection::vec(prop_oneof![200_u16.., Just(u16::MAX)], PIXELS),
    ) {
        // A frame that saw nothing is refused.
        prop_assume!(depth_mm.iter().any(|&v| v != u16::MAX));
        let sample = Sample::depth();
        sample.describe("\"m\"", "\"mm\"");
        sample.write("depth_2.npy", &npy_u16(&[HEIGHT, WIDTH], &depth_mm));
        let from_npy = sample.frame().unwrap();
        // Whoever doubts the unit may try another: they are integers, as in a PNG.
        let unit_m = || Folder::open(sample.path()).unwrap().integer_unit_m();
        prop_assert_eq!(unit_m(), Some(1e-3));
        // The largest number is what drivers write where they saw nothing.
        let seen = |v: &u16| if *v == u16::MAX { 0.0 } else { f32::from(*v) * 1e-3 };
        let expected: Vec<f32> = depth_mm.iter().map(seen).collect();
        prop_assert_eq!(depths(&from_npy), expected.clone());
        sample.describe("depth_{}.npy", "depth_{}.png");
        for name in ["2", "10"] {
            sample.write(&format!("depth_{name}.png"), &png_u16(WIDTH, HEIGHT, &depth_mm));
        }
        prop_assert_eq!(depths(&sample.frame().unwrap()), expected.clone());
    }

    #[test]
    fn organised_clouds_in_any_order(
        xyz in proptest::collection::vec(0.2_f32..9.0, 3 * PIXELS),
        fortran in any::<bool>(),
    ) {
        let sample = Sample::cloud();
        // Plane by plane, and in a plane column by column.
        let plane = |axis: usize| xyz.iter().skip(axis).step_by(3).copied().collect::<Vec<_>>();
        let planes = (0..3).flat_map(|axis| columns_first(&plane(axis), WIDTH));
        let stored: Vec<f32> = if fortran { planes.collect() } else { xyz.clone() };
        let bytes: Vec<u8> = stored.iter().flat_map(|v| v.to_le_bytes()).collect();
        sample.write("xyz_2.npy", &npy("<f4", fortran, &[HEIGHT, WIDTH, 3], &bytes));
        let frame = sample.frame().unwrap();
        prop_assert_eq!(frame.range.size(), Some((WIDTH as u32, HEIGHT as u32)));
        prop_assert_eq!(points(&frame).concat(), xyz);
    }

    #[test]
    fn body_clouds_are_turned(x in 0.2_f32..9.0, y in -2.0_f32..2.0, z in -2.0_f32..2.0) {
        let sample = Sample::cloud();
        sample.describe("optical", "body");
        sample.write("xyz_2.npy", &npy_f32(&[HEIGHT, WIDTH, 3], &[x, y, z].repeat(PIXELS)));
        prop_assert_eq!(points(&sample.frame().unwrap()), vec![[-y, -z, x]; PIXELS]);
    }

    #[test]
    fn joints_of_every_shape_and_type(a in -3.0_f64..3.0, b in -3.0_f64..3.0, shape in 0..3) {
        let sample = Sample::depth();
        let shape = [vec![2], vec![1, 2], vec![2, 1]][shape as usize].clone();
        sample.write("joints_2.npy", &npy_f64(&shape, &[a, b]));
        let joints = sample.frame().unwrap().joints;
        prop_assert_eq!((joints.get("shoulder"), joints.get("elbow")), (Some(a), Some(b)));
        sample.write("joints_2.npy", &npy_f32(&shape, &[a as f32, b as f32]));
        let joints = sample.frame().unwrap().joints;
        prop_assert_eq!(joints.get("elbow"), Some(f64::from(b as f32)));
    }

    #[test]
    fn masks_of_every_kind_are_the_same(set in proptest::collection::vec(any::<bool>(), PIXELS)) {
        prop_assume!(set.contains(&true));
        let sample = Sample::depth();
        let data = |on: &[u8], off: &[u8]| -> Vec<u8> {
            set.iter().flat_map(|s| if *s { on.to_vec() } else { off.to_vec() }).collect()
        };
        let image = |color, depth, data: &[u8]| png(WIDTH, HEIGHT, color, depth, data);
        let (eight, sixteen) = (BitDepth::Eight, BitDepth::Sixteen);
        let palette = Some(&[0, 0, 0, 9, 0, 200][..]);
        let indexed = data(&[1], &[0]);
        for bytes in [
            image(ColorType::Grayscale, eight, &data(&[1], &[0])),
            image(ColorType::Grayscale, sixteen, &data(&[0, 1], &[0, 0])),
            image(ColorType::GrayscaleAlpha, eight, &data(&[255, 255], &[0, 255])),
            image(ColorType::Rgb, eight, &data(&[0, 0, 3], &[0, 0, 0])),
            image(ColorType::Rgba, eight, &data(&[0, 1, 0, 255], &[255, 255, 255, 0])),
            image(ColorType::Rgba, sixteen, &data(&[0, 0, 0, 1, 0, 0, 0, 1], &[0, 0, 0, 0, 0, 0, 1, 1])),
            png_with_palette(WIDTH, HEIGHT, ColorType::Indexed, eight, &indexed, palette),
        ] {
            sample.write("mask_2.png", &bytes);
            let mask = sample.frame().unwrap().mask.unwrap();
            prop_assert_eq!(mask.as_slice(), &*set);
        }
    }
}

#[test]
fn a_folder_tells_what_it_is() {
    let sample = Sample::depth();
    let folder = sample.open().unwrap();
    assert_eq!(folder.frame_names(), ["2", "10"]);
    assert!(folder.has_masks());
    assert_eq!(folder.camera_frame_id(), Some("depth_optical"));
    assert_eq!(folder.camera().map(|c| (c.width(), c.height(), c.fx())), Some((4, 3, 5.0)));
    assert_eq!(folder.robot().urdf, Some(sample.file("arm.urdf")));
    assert_eq!(folder.robot().end_effector.as_deref(), Some("hand"));
    assert_eq!(folder.color_path(1), Some(sample.file("color_10.png")));
    assert_eq!(folder.color_path(2), None);
    let color = folder.read_color(1).unwrap().unwrap();
    assert_eq!((color.width, color.height, color.rgb), (4, 3, vec![[7; 3]; PIXELS]));
    let frame = Folder::open(&sample.file("recording.toml")).unwrap().read_frame(1).unwrap();
    assert_eq!(frame.name, "10");
    assert!(frame.mask.unwrap().at(1, 1));
}

#[test]
fn what_is_optional_may_be_absent() {
    let sample = Sample::depth();
    sample.describe("mask = \"mask_{}.png\"\n", "");
    sample.describe("color = \"color_{}.png\"\n", "");
    let folder = sample.open().unwrap();
    assert!(!folder.has_masks() && folder.color_path(0).is_none());
    assert!(folder.read_color(0).unwrap().is_none());
    assert!(folder.read_frame(0).unwrap().mask.is_none());
    let cloud = Sample::cloud().open().unwrap();
    assert!(cloud.camera().is_none() && cloud.robot().urdf.is_none());
}

#[test]
fn absent_depths_and_points_are_marked() {
    let sample = Sample::depth();
    let mut depth = [f32::NAN, f32::INFINITY, -1.0, 0.0].repeat(3);
    depth[4] = 2.0;
    sample.write("depth_2.npy", &npy_f32(&[HEIGHT, WIDTH], &depth));
    let mut read = [0.0; PIXELS];
    read[4] = 2.0;
    assert_eq!(depths(&sample.frame().unwrap()), read);

    let sample = Sample::cloud();
    sample.describe("mask = \"mask_{}.png\"\n", "");
    let rows = [[0.0; 3], [1.0, f32::NAN, 1.0], [f32::INFINITY, 1.0, 1.0], [0.0, 0.0, 1.0]];
    for shape in [&[4, 3][..], &[1, 4, 3]] {
        sample.write("xyz_2.npy", &npy_f32(shape, &rows.concat()));
        let frame = sample.frame().unwrap();
        assert_eq!(frame.range.size(), None);
        let points = points(&frame);
        assert!(points[..3].as_flattened().iter().all(|c| c.is_nan()));
        assert_eq!(points[3], [0.0, 0.0, 1.0]);
    }
}

#[test]
fn clouds_in_millimetres_are_scaled() {
    let sample = Sample::cloud();
    sample.describe("\"m\"", "\"mm\"");
    sample.write("xyz_2.npy", &npy_f64(&[HEIGHT, WIDTH, 3], &[500.0; 3 * PIXELS]));
    assert_eq!(points(&sample.frame().unwrap()), vec![[0.5; 3]; PIXELS]);
}

#[test]
fn headers_of_python_2_and_of_later_versions() {
    let sample = Sample::depth();
    let data: Vec<u8> = [1.5_f32; PIXELS].iter().flat_map(|v| v.to_le_bytes()).collect();
    let header = "{\"shape\": (3L, 4L), 'fortran_order': False, 'descr': '<f4'}";
    sample.write("depth_2.npy", &crate::sample::npy_with_header(header, &data));
    assert_eq!(depths(&sample.frame().unwrap()), [1.5; PIXELS]);
    let mut later = b"\x93NUMPY\x02\x00".to_vec();
    later.extend(u32::try_from(header.len()).unwrap().to_le_bytes());
    later.extend(header.bytes().chain(data));
    sample.write("depth_2.npy", &later);
    assert_eq!(depths(&sample.frame().unwrap()), [1.5; PIXELS]);
}

#[test]
fn a_folder_serves_many_threads() {
    fn shared<T: Send + Sync>(_: &T) {}
    let sample = Sample::depth();
    let folder = sample.open().unwrap();
    shared(&folder);
    let names: Vec<_> = std::thread::scope(|scope| {
        let threads = [0, 1].map(|i| {
            let folder = &folder;
            scope.spawn(move || folder.read_frame(i).unwrap().name)
        });
        threads.map(|t| t.join().unwrap()).to_vec()
    });
    assert_eq!(names, ["2", "10"]);
}

proptest! {
    // Every case writes a folder.
    #![proptest_config(ProptestConfig::with_cases(16))]

    /// Tenths, quarters and eighths of a millimetre, and whatever else a driver has.
    #[test]
    fn integers_are_so_many_of_the_unit(
        stored in proptest::collection::vec(2000_u16..60_000, PIXELS),
        unit in prop_oneof![
            Just(("0.0001", 1e-4)),
            Just(("0.00025", 2.5e-4)),
            Just(("0.000125", 1.25e-4)),
            Just(("\"1/5000\"", 2e-4)),
        ],
    ) {
        let sample = Sample::depth();
        sample.describe("\"m\"", unit.0);
        sample.write("depth_2.npy", &npy_u16(&[HEIGHT, WIDTH], &stored));
        let read = depths(&sample.frame().unwrap());
        for (read, stored) in read.iter().zip(stored) {
            let depth = unit.1 * f64::from(stored);
            prop_assert!((f64::from(*read) - depth).abs() < 1e-6 * depth);
        }
    }
}
