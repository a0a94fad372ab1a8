//! Names of ROS 2 as DDS has them.
//!
//! "Topic and Service name mapping to DDS", <https://design.ros2.org/articles/topic_and_service_names.html>:
//! topics are behind `rt`, and types of messages have the namespace `dds_` and a line at their end.

const TOPIC_PREFIX: &str = "rt";

/// The name in DDS of a topic of ROS 2: `rt/joint_states` of `/joint_states`.
pub fn dds_topic(ros: &str) -> String {
    format!("{TOPIC_PREFIX}/{}", ros.trim_start_matches('/'))
}

/// The topic of ROS 2 that a topic of DDS is; `None` of one that is no topic of ROS (a service, a parameter).
pub fn ros_topic(dds: &str) -> Option<String> {
    let name = dds.strip_prefix(TOPIC_PREFIX)?.strip_prefix('/')?;
    (!name.is_empty()).then(|| format!("/{name}"))
}

/// The name in DDS of a message type: `sensor_msgs::msg::dds_::Image_` of `sensor_msgs/msg/Image`.
pub fn dds_type(ros: &str) -> String {
    match ros.split('/').collect::<Vec<_>>().as_slice() {
        [package, kind, name] => format!("{package}::{kind}::dds_::{name}_"),
        _ => ros.to_owned(),
    }
}

/// The message type that a type of DDS is; `None` of one that is not of ROS.
pub fn ros_type(dds: &str) -> Option<String> {
    match dds.split("::").collect::<Vec<_>>().as_slice() {
        [package, kind, "dds_", name] => {
            let name = name.strip_suffix('_').filter(|name| !name.is_empty())?;
            Some(format!("{package}/{kind}/{name}"))
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn names_are_those_of_the_article() {
        assert_eq!(dds_topic("/arm/joint_states"), "rt/arm/joint_states");
        assert_eq!(ros_topic("rt/robot_description").as_deref(), Some("/robot_description"));
        assert_eq!(dds_type("sensor_msgs/msg/Image"), "sensor_msgs::msg::dds_::Image_");
        assert_eq!(
            ros_type("tf2_msgs::msg::dds_::TFMessage_").as_deref(),
            Some("tf2_msgs/msg/TFMessage")
        );
        for other in ["rq/add_two_intsRequest", "rt", "rt/", "rta/b", "ros_discovery_info", ""] {
            assert_eq!(ros_topic(other), None, "{other}");
        }
        for other in ["HelloWorldData_Msg", "a::msg::dds_::_", "a::msg::B", ""] {
            assert_eq!(ros_type(other), None, "{other}");
        }
    }

    proptest! {
        #[test]
        fn there_and_back(topic in "(/[a-z][a-z0-9_]{0,9}){1,4}", name in "[a-z_]{1,9}/msg/[A-Z][A-Za-z0-9]{0,9}") {
            prop_assert_eq!(ros_topic(&dds_topic(&topic)), Some(topic));
            prop_assert_eq!(ros_type(&dds_type(&name)), Some(name));
        }

        #[test]
        fn nothing_from_outside_is_too_strange(text in "\\PC{0,40}") {
            let _ = (ros_topic(&text), ros_type(&text));
        }
    }
}
