//! Labelled points for other programs.

use eyebolt::segment::{ARM, END_EFFECTOR, UNKNOWN};
use eyebolt_geometry::{DepthImage, PinholeCamera, RayTable};

/// A form of cloud.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum CloudForm {
    /// For MeshLab, Open3D, CloudCompare: x, y, z, red, green, blue, label
    Ply,
    /// For PCL: x, y, z, rgb, label
    Pcd,
}

/// A point that was seen.
struct Labelled {
    point: [f32; 3],
    label: u8,
}

impl Labelled {
    /// As in pictures: the arm blue, its end-effector yellow, all else grey.
    fn rgb(&self) -> [u8; 3] {
        match self.label {
            ARM => [60, 140, 255],
            END_EFFECTOR => [255, 190, 40],
            _ => [130, 130, 130],
        }
    }
}

impl CloudForm {
    /// How its files end.
    pub fn ending(self) -> &'static str {
        match self {
            Self::Ply => "ply",
            Self::Pcd => "pcd",
        }
    }

    /// The points of `depth` that have depth, optical frame, metres, each with its label.
    pub fn bytes(self, depth: &DepthImage, camera: &PinholeCamera, label: &[u8]) -> Vec<u8> {
        let rays = RayTable::new(camera);
        let pairs = depth.depth_m().iter().zip(label).enumerate();
        let seen = pairs.filter(|(_, (z, label))| **z > 0.0 && **label != UNKNOWN);
        let points = seen
            .map(|(at, (z, label))| Labelled { point: rays.point(at, *z).into(), label: *label });
        let points: Vec<Labelled> =
            points.filter(|it| it.point.iter().all(|value| value.is_finite())).collect();
        match self {
            Self::Ply => ply(&points),
            Self::Pcd => pcd(&points),
        }
    }
}

fn ply(points: &[Labelled]) -> Vec<u8> {
    let head = format!(
        "ply\nformat binary_little_endian 1.0\ncomment camera optical frame, metres\nelement vertex {}\n\
         property float x\nproperty float y\nproperty float z\nproperty uchar red\nproperty uchar green\n\
         property uchar blue\nproperty uchar label\nend_header\n",
        points.len()
    );
    let mut bytes = head.into_bytes();
    for it in points {
        it.point.iter().for_each(|value| bytes.extend(value.to_le_bytes()));
        bytes.extend(it.rgb());
        bytes.push(it.label);
    }
    bytes
}

fn pcd(points: &[Labelled]) -> Vec<u8> {
    let count = points.len();
    let head = format!(
        "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z rgb label\nSIZE 4 4 4 4 4\n\
         TYPE F F F F U\nCOUNT 1 1 1 1 1\nWIDTH {count}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {count}\nDATA binary\n"
    );
    let mut bytes = head.into_bytes();
    for it in points {
        it.point.iter().for_each(|value| bytes.extend(value.to_le_bytes()));
        // PCL packs colours into the bits of a float.
        let [red, green, blue] = it.rgb();
        bytes.extend([blue, green, red, 0]);
        bytes.extend(u32::from(it.label).to_le_bytes());
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;
    use eyebolt_geometry::Distortion;

    /// Two points of a picture of four; each record is as long as the head says.
    #[test]
    fn points_with_depth_are_written_and_no_others() {
        let camera = PinholeCamera::new(2, 2, 2.0, 2.0, 0.5, 0.5, Distortion::None).unwrap();
        let depth = DepthImage::new(2, 2, vec![1.0, 0.0, 2.0, 1.5]).unwrap();
        let label = [ARM, UNKNOWN, END_EFFECTOR, UNKNOWN];
        for (form, record) in [(CloudForm::Ply, 16), (CloudForm::Pcd, 20)] {
            let bytes = form.bytes(&depth, &camera, &label);
            let text = String::from_utf8_lossy(&bytes);
            let head = ["end_header\n", "DATA binary\n"]
                .iter()
                .find_map(|end| Some(text.find(end)? + end.len()));
            let body = &bytes[head.unwrap()..];
            assert_eq!(body.len(), 2 * record, "{form:?}");
            let z = |at: usize| {
                f32::from_le_bytes(body[at * record + 8..at * record + 12].try_into().unwrap())
            };
            assert_eq!((z(0), z(1)), (1.0, 2.0));
            assert!(text.contains(" 2\n"), "{form:?}");
        }
    }
}
