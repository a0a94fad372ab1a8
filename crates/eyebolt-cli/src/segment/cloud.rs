//! Labelled points for other programs.

use super::segmented::Segmented;
use eyebolt::segment::{ARM, END_EFFECTOR, UNKNOWN};

/// A form of cloud.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum CloudForm {
    /// For MeshLab, Open3D, CloudCompare: x, y, z, red, green, blue, label
    Ply,
    /// For PCL: x, y, z, rgb, label
    Pcd,
}

/// The points of a frame, as it was recorded: optical frame, metres.
#[derive(Debug, Default)]
pub struct Points {
    pub points_m: Vec<[f32; 3]>,
    /// Of each its class.
    pub label: Vec<u8>,
    /// How likely the networks take it that it is of that class; 0 where nobody asked.
    pub probability: Vec<f32>,
}

impl Points {
    /// Of a frame whose pixels are labelled.
    pub fn of(frame: &Segmented<'_>) -> Self {
        let mut points = Self::default();
        for (point, at) in frame.images.points(&frame.image) {
            let label = frame.found.label[at];
            if label != UNKNOWN && point.iter().all(|value| value.is_finite()) {
                points.points_m.push(point.into());
                points.label.push(label);
                points.probability.push(frame.found.probability_of_label(at).unwrap_or(0.0));
            }
        }
        points
    }

    /// As in pictures: the arm blue, its end-effector yellow, all else grey.
    pub fn rgb(&self) -> Vec<[u8; 3]> {
        let colour = |label: &u8| match *label {
            ARM => [60, 140, 255],
            END_EFFECTOR => [255, 190, 40],
            _ => [130, 130, 130],
        };
        self.label.iter().map(colour).collect()
    }

    /// Each point with its colour and its label.
    fn each(&self) -> impl Iterator<Item = ([f32; 3], [u8; 3], u8)> {
        let colours = self.rgb().into_iter().zip(&self.label);
        self.points_m.iter().zip(colours).map(|(point, (rgb, label))| (*point, rgb, *label))
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

    /// The file of `points`.
    pub fn bytes(self, points: &Points) -> Vec<u8> {
        match self {
            Self::Ply => ply(points),
            Self::Pcd => pcd(points),
        }
    }
}

fn ply(points: &Points) -> Vec<u8> {
    let head = format!(
        "ply\nformat binary_little_endian 1.0\ncomment camera optical frame, metres\nelement vertex {}\n\
         property float x\nproperty float y\nproperty float z\nproperty uchar red\nproperty uchar green\n\
         property uchar blue\nproperty uchar label\nend_header\n",
        points.label.len()
    );
    let mut bytes = head.into_bytes();
    for (point, rgb, label) in points.each() {
        point.iter().for_each(|value| bytes.extend(value.to_le_bytes()));
        bytes.extend(rgb);
        bytes.push(label);
    }
    bytes
}

fn pcd(points: &Points) -> Vec<u8> {
    let count = points.label.len();
    let head = format!(
        "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z rgb label\nSIZE 4 4 4 4 4\n\
         TYPE F F F F U\nCOUNT 1 1 1 1 1\nWIDTH {count}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {count}\nDATA binary\n"
    );
    let mut bytes = head.into_bytes();
    for (point, [red, green, blue], label) in points.each() {
        point.iter().for_each(|value| bytes.extend(value.to_le_bytes()));
        // PCL packs colours into the bits of a float.
        bytes.extend([blue, green, red, 0]);
        bytes.extend(u32::from(label).to_le_bytes());
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;
    use eyebolt::record::FrameImages;
    use eyebolt::segment::Segmentation;
    use eyebolt_geometry::{DepthImage, Distortion, PinholeCamera};
    use eyebolt_recording::InMemory;

    /// Two points of a picture of four; each record is as long as the head says.
    #[test]
    fn points_with_depth_are_written_and_no_others() {
        let camera = PinholeCamera::new(2, 2, 2.0, 2.0, 0.5, 0.5, Distortion::None).unwrap();
        let mut source = InMemory::new(camera);
        let depth = DepthImage::new(2, 2, vec![1.0, 0.0, 2.0, 1.5]).unwrap();
        let joints = [("joint".to_owned(), 0.5)].into_iter().collect();
        source.push("0", depth, joints).unwrap();
        let images = FrameImages::of(&source).unwrap();
        let image = images.read(&source, 0).unwrap().unwrap();
        let label = vec![ARM, UNKNOWN, END_EFFECTOR, UNKNOWN];
        let found =
            Segmentation { width: 2, height: 2, label, whole: Vec::new(), probability: Vec::new() };
        let frame = Segmented { index: 0, name: "0", images: &images, image, found };
        for (form, record) in [(CloudForm::Ply, 16), (CloudForm::Pcd, 20)] {
            let bytes = form.bytes(&Points::of(&frame));
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
