//! Two more real recordings: an xArm 7 before a RealSense in an ordinary room, and the LBR Med7 with a
//! tool that its description lacks, close to another, as clouds without a camera.

use crate::measures::apart;
use crate::recording::{Opened, Variant, shared_with, trusted};
use eyebolt::calibrate::{Reason, Verdict};
use eyebolt_geometry::{Base, Camera, Transform};
use nalgebra::Matrix4;
use std::path::Path;

/// A recording in the shared data, as `recording.toml` tells it.
pub struct Recorded {
    pub folder: &'static str,
    /// Files of a frame, and what each is called where the manifest looks for it.
    files: &'static [[&'static str; 2]],
    camera: Option<&'static str>,
    frames: &'static str,
    /// Its frames by their numbers.
    pub numbers: &'static [usize],
    joints: &'static str,
    robot: [&'static str; 3],
    /// `base_from_camera` of another program, row by row; see the recording's notes.
    reference: [[f64; 4]; 3],
}

pub const XARM: Recorded = Recorded {
    folder: "data/recordings/xarm7_realsense",
    files: &[
        ["depth_{}.npy", "depth_{}.npy"],
        ["mask_sam2_img_{}.png", "mask_{}.png"],
        ["joint_state_{}.npy", "joint_states_{}.npy"],
    ],
    camera: Some("camera_info.yaml"),
    frames: "depth = \"depth_{}.npy\"\ndepth_unit = \"m\"\nmask = \"mask_{}.png\"\n",
    numbers: &[0, 2, 4, 6, 8],
    joints: "joint",
    robot: ["data/robots/xarm7/xarm7.urdf", "link_base", "link7"],
    reference: [
        [0.056_879_792, 0.025_621_338, -0.998_051_882, 1.230_574_965],
        [0.997_774_899, -0.036_309_376, 0.055_932_160, -0.232_904_360],
        [-0.034_805_637, -0.999_012_053, -0.027_629_653, 0.352_675_050],
    ],
};

const LBR: Recorded = Recorded {
    folder: "data/recordings/lbr_med7_realsense",
    files: &[["xyz_{}.npy", "xyz_{}.npy"], ["joint_states_{}.npy", "joint_states_{}.npy"]],
    camera: None,
    frames: "cloud = \"xyz_{}.npy\"\ncloud_frame = \"optical\"\ndepth_unit = \"m\"\n",
    numbers: &[0, 2, 4, 6, 8, 10],
    joints: "lbr_A",
    robot: ["data/robots/lbr_med7/lbr_med7.urdf", "lbr_link_0", "lbr_link_7"],
    reference: [
        [0.493_188_872, 0.500_726_540, 0.711_363_247, -0.943_191_836],
        [-0.832_361_857, 0.033_931_721, 0.553_192_893, -0.383_747_502],
        [0.252_860_585, -0.864_940_212, 0.433_520_420, -0.137_577_649],
    ],
};

impl Recorded {
    fn reference(&self) -> Transform<Camera, Base> {
        let [x, y, z] = self.reference;
        let rows = [x, y, z, [0.0, 0.0, 0.0, 1.0]];
        let matrix = Matrix4::from_fn(|row, column| rows[row][column]);
        Transform::<Base, Camera>::from_matrix(&matrix, 1e-5).unwrap().inverse()
    }

    /// These of its frames, by their numbers, with masks if `masks`.
    pub fn open(&self, shared: &Path, numbers: &[usize], masks: bool) -> Opened {
        let joints = (1..=7).map(|joint| format!("{}{joint}", self.joints)).collect();
        let variant = Variant { joints, robot: self.robot, masks, ..Variant::default() };
        let (folder, data) = (tempfile::tempdir().unwrap(), shared.join(self.folder));
        for (index, number) in numbers.iter().enumerate() {
            for [from, to] in self.files {
                let [from, to] =
                    [from.replace("{}", &number.to_string()), to.replace("{}", &index.to_string())];
                std::fs::copy(data.join(from), folder.path().join(to)).unwrap();
            }
        }
        let camera = self.camera.map(|info| format!("[camera]\ninfo = {:?}\n", data.join(info)));
        let manifest = variant.manifest(&camera.unwrap_or_default(), self.frames);
        std::fs::write(folder.path().join("recording.toml"), manifest).unwrap();
        variant.opened(shared, folder)
    }

    /// All of it is trusted, and no farther from the reference than this.
    #[track_caller]
    fn assert_trusted(&self, shared: &Path, masks: bool, (far_mm, far_deg): (f64, f64)) {
        let pose = trusted(&self.open(shared, self.numbers, masks).run());
        let (mm, degrees) = apart(&pose, &self.reference());
        assert!(mm <= far_mm && degrees <= far_deg, "{mm} mm, {degrees} degrees");
    }

    #[track_caller]
    fn assert_one_repeated_is_refused(&self, shared: &Path, masks: bool) {
        let one = vec![self.numbers[2]; 5];
        let verdict = self.open(shared, &one, masks).run().calibration.verdict;
        let Verdict::Refused(reasons) = verdict else { panic!("one configuration is trusted") };
        let few = |reason: &Reason| matches!(reason, Reason::FewConfigurations { .. });
        assert!(reasons.iter().any(few), "{reasons:?}");
    }
}

#[test]
fn an_xarm_in_an_ordinary_room_is_trusted() {
    let Some(shared) = shared_with(XARM.folder) else { return };
    for masks in [true, false] {
        // The reference is good to a centimetre; its even and odd frames are 22 mm and 1.2 degrees apart.
        XARM.assert_trusted(&shared, masks, (25.0, 1.2));
    }
}

#[test]
fn clouds_of_an_arm_with_a_tool_that_nobody_described_are_trusted() {
    let Some(shared) = shared_with(LBR.folder) else { return };
    // Of the reference, even and odd frames are 6.8 mm and 0.34 degrees apart.
    LBR.assert_trusted(&shared, false, (12.0, 1.0));
}

#[test]
fn one_configuration_of_these_repeated_is_refused() {
    let Some(shared) = shared_with(XARM.folder) else { return };
    for masks in [true, false] {
        XARM.assert_one_repeated_is_refused(&shared, masks);
    }
    let Some(shared) = shared_with(LBR.folder) else { return };
    LBR.assert_one_repeated_is_refused(&shared, false);
}
