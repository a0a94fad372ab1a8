//! What a caller hands in, by names that no kind of caller owns.

use std::fmt;

/// Something that a caller hands in: a flag of a program, an argument in Python, a field of a form.
///
/// Errors of the libraries say which input is at fault, or which would help, by this; in their
/// texts it stands as ``argument `depth_topic` ``, which no name from outside is taken for. Whoever talks to a person has names of their own for
/// them: `--depth-topic` for `depth_topic`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Input(&'static str);

macro_rules! inputs {
    ($($(#[$doc:meta])* $constant:ident = $name:literal;)*) => {
        impl Input {
            $($(#[$doc])* pub const $constant: Self = Self($name);)*

            /// All of them.
            pub const ALL: &'static [Self] = &[$(Self::$constant),*];
        }
    };
}

inputs! {
    /// The robot description.
    ROBOT = "robot";
    /// The base link.
    BASE = "base";
    /// The end-effector link.
    END_EFFECTOR = "end_effector";
    /// Position of a joint that is not recorded.
    JOINT = "joint";
    /// What the recording's names of joints have before the robot's.
    JOINT_PREFIX = "joint_prefix";
    /// Value of an argument of a xacro file.
    XACRO_ARGUMENT = "xacro_argument";
    /// Where `package://` leads.
    PACKAGE_PATH = "package_path";
    /// Whether a recording's robot description may name files outside the package folders.
    OUTSIDE_FILES = "outside_files";
    /// Topic of the depth.
    DEPTH_TOPIC = "depth_topic";
    /// Topic of the depth's intrinsics.
    CAMERA_INFO_TOPIC = "camera_info_topic";
    /// File of the depth's intrinsics.
    CAMERA_INFO = "camera_info";
    /// Topic of the joint states.
    JOINT_TOPIC = "joint_topic";
    /// Topic of the robot description.
    DESCRIPTION_TOPIC = "description_topic";
    /// Topic of colour pictures.
    COLOR_TOPIC = "color_topic";
    /// Topic of masks.
    MASK_TOPIC = "mask_topic";
    /// Topic of depth without the robot.
    BACKGROUND_TOPIC = "background_topic";
    /// Frame of the points of clouds.
    CLOUD_FRAME = "cloud_frame";
    /// What one of the numbers that depth is stored in is.
    DEPTH_UNIT = "depth_unit";
    /// How far a joint may move while a frame is taken.
    MAX_MOTION = "max_motion";
    /// Whether to use what can be read of a damaged bag.
    PARTIAL = "partial";
    /// Expected error of a trusted answer: translation.
    MAX_ERROR_TRANSLATION = "max_error_translation";
    /// Expected error of a trusted answer: rotation.
    MAX_ERROR_ROTATION = "max_error_rotation";
    /// A calibration that was made before.
    CALIBRATION = "calibration";
    /// Where to write.
    OUTPUT = "output";
    /// Whether existing files are replaced.
    FORCE = "force";
    /// Static transforms of the camera.
    CAMERA_TREE = "camera_tree";
    /// Name of the depth optical frame.
    OPTICAL_FRAME = "optical_frame";
    /// Whether a refused answer is exported.
    EVEN_IF_REFUSED = "even_if_refused";
    /// Where a simulated camera stands, by name.
    PRESET = "preset";
    /// How far away a simulated camera stands.
    DISTANCE = "distance";
    /// In which direction a simulated camera stands.
    AZIMUTH = "azimuth";
    /// How high a simulated camera stands.
    ELEVATION = "elevation";
    /// Number of simulated configurations.
    CONFIGURATIONS = "configurations";
    /// How far a simulated camera is bumped.
    BUMP = "bump";
    /// By what factor a simulated focal length is wrong.
    FOCAL_SCALE = "focal_scale";
    /// By how much a simulated principal point is wrong.
    CENTRE = "centre";
}

impl Input {
    /// Its name, in snake case.
    pub const fn name(self) -> &'static str {
        self.0
    }

    /// `text` with each input that it names called what `call` calls it.
    ///
    /// ```
    /// use eyebolt_robot::Input;
    ///
    /// let said = Input::in_words("Give argument `depth_topic`", |input| format!("--{}", input.name()));
    /// assert_eq!(said, "Give --depth_topic");
    /// ```
    pub fn in_words(text: &str, call: impl Fn(Self) -> String) -> String {
        Self::ALL.iter().fold(text.to_owned(), |text, input| {
            let name = input.to_string();
            if text.contains(&name) { text.replace(&name, &call(*input)) } else { text }
        })
    }
}

impl fmt::Display for Input {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "argument `{}`", self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn names_are_distinct() {
        let names: BTreeSet<_> = Input::ALL.iter().map(|input| input.name()).collect();
        assert_eq!(names.len(), Input::ALL.len());
    }

    #[test]
    fn only_inputs_are_renamed() {
        let text =
            "link `base` of `robot`: name another with argument `base` or argument `end_effector`";
        let said = Input::in_words(text, |input| input.name().to_uppercase());
        assert_eq!(said, "link `base` of `robot`: name another with BASE or END_EFFECTOR");
    }
}
