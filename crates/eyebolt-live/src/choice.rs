//! Which topics a session listens to.

/// Which topics a session listens to: by their types, as bags are read, where nobody named them.
#[derive(Clone, Debug, Default)]
pub struct TopicChoice {
    /// The only topic of depth: images, compressed ones, or clouds. Otherwise all images, until they turn out
    /// to be of no depth.
    pub depth: Option<String>,
    /// The only topic of intrinsics.
    pub camera_info: Option<String>,
    /// The only topic of joint states.
    pub joints: Option<String>,
    /// The only topic of the robot's description.
    pub description: Option<String>,
    /// Topics of other pictures: colour, masks, backgrounds.
    pub pictures: Vec<String>,
}

impl TopicChoice {
    /// Whether messages of the type `message_type` on `topic` are wanted.
    pub fn wants(&self, topic: &str, message_type: &str) -> bool {
        let only = |named: &Option<String>| named.as_ref().is_none_or(|named| same(named, topic));
        let last = topic.rsplit('/').next().unwrap_or_default();
        let is_other_picture = || self.pictures.iter().any(|named| same(named, topic));
        match message_type {
            "sensor_msgs/msg/JointState" => only(&self.joints),
            "sensor_msgs/msg/CameraInfo" => only(&self.camera_info),
            "sensor_msgs/msg/Image" => only(&self.depth) || is_other_picture(),
            // Many drivers offer these too; raw images are enough.
            "sensor_msgs/msg/CompressedImage" | "sensor_msgs/msg/PointCloud2" => {
                (self.depth.is_some() && only(&self.depth)) || is_other_picture()
            }
            "std_msgs/msg/String" => match &self.description {
                Some(named) => same(named, topic),
                None => last == "robot_description",
            },
            "tf2_msgs/msg/TFMessage" => last == "tf_static",
            _ => false,
        }
    }
}

fn same(a: &str, b: &str) -> bool {
    a.trim_start_matches('/') == b.trim_start_matches('/')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn topics_are_chosen_by_type_unless_they_are_named() {
        let any = TopicChoice::default();
        for (topic, kind, wanted) in [
            ("/camera/depth/image_rect_raw", "sensor_msgs/msg/Image", true),
            ("/a/b/joint_states", "sensor_msgs/msg/JointState", true),
            ("/anything", "sensor_msgs/msg/JointState", true),
            (
                "/camera/depth/image_rect_raw/compressedDepth",
                "sensor_msgs/msg/CompressedImage",
                false,
            ),
            ("/points", "sensor_msgs/msg/PointCloud2", false),
            ("/arm/robot_description", "std_msgs/msg/String", true),
            ("/chatter", "std_msgs/msg/String", false),
            ("/tf_static", "tf2_msgs/msg/TFMessage", true),
            ("/tf", "tf2_msgs/msg/TFMessage", false),
            ("/rosout", "rcl_interfaces/msg/Log", false),
        ] {
            assert_eq!(any.wants(topic, kind), wanted, "{topic}");
        }
        let named = TopicChoice {
            depth: Some("points".to_owned()),
            joints: Some("/arm/joint_states".to_owned()),
            description: Some("/text".to_owned()),
            pictures: vec!["/color".to_owned()],
            ..TopicChoice::default()
        };
        for (topic, kind, wanted) in [
            ("/points", "sensor_msgs/msg/PointCloud2", true),
            ("/camera/depth/image_rect_raw", "sensor_msgs/msg/Image", false),
            ("/color", "sensor_msgs/msg/Image", true),
            ("/arm/joint_states", "sensor_msgs/msg/JointState", true),
            ("/joint_states", "sensor_msgs/msg/JointState", false),
            ("/text", "std_msgs/msg/String", true),
            ("/robot_description", "std_msgs/msg/String", false),
        ] {
            assert_eq!(named.wants(topic, kind), wanted, "{topic}");
        }
    }
}
