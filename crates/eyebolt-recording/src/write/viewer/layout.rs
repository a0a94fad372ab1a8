//! How Foxglove and Lichtblick show such a file at once.

use super::topics::{CAPTION, OUTLINE, OVERLAY, POINTS};
use crate::write::definitions::ROBOT;
use serde_json::{Map, Value, json};

/// Names of the panels: their kind, and anything.
const SCENE: &str = "3D!eyebolt";
const PICTURE: &str = "Image!eyebolt";

/// A layout as JSON: the scene seen from `distance_m` away from `middle_in_base_m`, the picture beside it. The axes of
/// `links` are hidden, those of `base` and the camera shown.
pub fn viewer_layout(
    base: &str,
    links: &[&str],
    middle_in_base_m: [f64; 3],
    distance_m: f64,
) -> String {
    let topics = [POINTS, ROBOT, OUTLINE, CAPTION];
    let topics = topics.map(|topic| {
        let mut settings = Map::from_iter([("visible".to_owned(), Value::Bool(true))]);
        if topic == POINTS {
            settings.insert("colorMode".to_owned(), "rgb".into());
            settings.insert("colorField".to_owned(), "rgb".into());
            settings.insert("pointSize".to_owned(), 3.into());
        }
        (topic.to_owned(), Value::Object(settings))
    });
    let hidden = links.iter().map(|link| (format!("frame:{link}"), json!({ "visible": false })));
    let scene = json!({
        "followTf": base,
        "followMode": "follow-none",
        "cameraState": {
            "perspective": true,
            "distance": distance_m,
            "phi": 65,
            "thetaOffset": 45,
            "targetOffset": middle_in_base_m,
            "target": [0, 0, 0],
            "targetOrientation": [0, 0, 0, 1],
            "fovy": 45,
            "near": 0.01,
            "far": 100,
        },
        "scene": { "backgroundColor": "#16181d", "transforms": { "axisScale": 0.2, "labelSize": 0.05 } },
        "transforms": Map::from_iter(hidden),
        "topics": Map::from_iter(topics),
        "layers": {
            "grid": {
                "layerId": "foxglove.Grid", "instanceId": "grid", "label": "Grid", "visible": true,
                "frameLocked": true, "frameId": base, "size": 4, "divisions": 8, "lineWidth": 1,
                "color": "#3a3f4bff", "position": [0, 0, 0], "rotation": [0, 0, 0], "order": 1,
            },
        },
        "publish": {},
        "imageMode": {},
    });
    let layout = json!({
        "configById": { SCENE: scene, PICTURE: { "imageMode": { "imageTopic": OVERLAY } } },
        "globalVariables": {},
        "userNodes": {},
        "playbackConfig": { "speed": 1 },
        "layout": { "direction": "row", "first": SCENE, "second": PICTURE, "splitPercentage": 62 },
    });
    let mut text = serde_json::to_string_pretty(&layout).expect("a layout is plain data");
    text.push('\n');
    text
}
