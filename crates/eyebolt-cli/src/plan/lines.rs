//! What is said of a plan.

use eyebolt::answer::Size;
use eyebolt::plan::{JointValue, PlanDocument};
use std::path::Path;

/// What is said of `plan`, written to `path`.
pub fn text(plan: &PlanDocument, path: Option<&Path>) -> String {
    let mut lines = vec![head(plan)];
    if let Some(why) = &plan.why_fewer {
        lines.push(why.clone());
    }
    if let Some(first) = plan.configurations.first() {
        let joints: Vec<&str> = first.joints.iter().map(|joint| joint.joint.as_str()).collect();
        lines.push(format!("degrees (mm) of {}:", joints.join(", ")));
    }
    for configuration in &plan.configurations {
        let joints: Vec<String> = configuration.joints.iter().map(position).collect();
        let error = configuration.expected_error_after.as_ref().map_or(String::new(), size);
        lines.push(format!(
            "  {}  {}   {:.0} % in view   then {error}",
            configuration.name,
            joints.join(" "),
            100.0 * configuration.in_view_share
        ));
    }
    lines.extend(plan.rules.iter().map(|rule| format!("note: {rule}")));
    if let Some(path) = path {
        lines.push(format!("written to {}", path.display()));
    }
    lines.join("\n")
}

fn head(plan: &PlanDocument) -> String {
    let camera = match plan.camera.assumed {
        true => format!(
            "for a camera that nobody knows: on average over {} places before and beside the arm",
            plan.camera.places
        ),
        false => "for the camera where it is".to_owned(),
    };
    let count = plan.configurations.len();
    let before =
        plan.expected_error_before.as_ref().map(|before| format!("{} now; ", size(before)));
    let after = plan.expected_error_after.as_ref().filter(|_| count > 0);
    let after = after.map_or(String::new(), |after| format!("{} with all of them", size(after)));
    let error = format!("{}{after}", before.unwrap_or_default());
    format!("{count} configurations {camera}, {:.0} s\nexpected error {error}", plan.duration_s)
}

fn size(size: &Size) -> String {
    format!("{:.2} mm, {:.3} deg", size.translation_mm, size.rotation_deg)
}

fn position(value: &JointValue) -> String {
    match (value.position_rad, value.position_m) {
        (Some(rad), _) => format!("{:7.1}", rad.to_degrees()),
        (None, Some(metres)) => format!("({:6.1})", 1e3 * metres),
        (None, None) => String::new(),
    }
}
