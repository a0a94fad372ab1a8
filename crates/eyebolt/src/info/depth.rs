//! What the depth of a recording is like.

use super::form::Depth;
use eyebolt_recording::{FrameSource, Range, RecordingError};

/// Frames looked at.
const FRAMES: usize = 10;
/// Pixels looked at in each.
const PIXELS: usize = 20_000;

/// Statistics over frames of `source`, evenly chosen.
pub(super) fn depth_statistics(source: &dyn FrameSource) -> Result<Depth, RecordingError> {
    let count = source.frame_names().len();
    let looked_at = count.min(FRAMES);
    let mut size = None;
    let (mut seen, mut pixels) = (Vec::new(), 0_usize);
    for i in 0..looked_at {
        let index = i * count.saturating_sub(1) / (looked_at - 1).max(1);
        let frame = match source.read_frame(index) {
            Err(error) if source.may_leave_out(&error) => continue,
            read => read?,
        };
        size = frame.range.size();
        let depth: Vec<f32> = match &frame.range {
            Range::Depth(image) => image.depth_m().to_vec(),
            Range::Cloud(cloud) => cloud.points().iter().map(|point| point.z).collect(),
        };
        let step = (depth.len() / PIXELS).max(1);
        for z in depth.into_iter().step_by(step) {
            pixels += 1;
            // NaN where a cloud has no point.
            seen.extend((z > 0.0).then_some(z));
        }
    }
    seen.sort_unstable_by(f32::total_cmp);
    let share = |percent: usize| seen.get(seen.len() * percent / 100).copied().map(f64::from);
    let range_m = match (share(5), share(50), share(95)) {
        (Some(near), Some(middle), Some(far)) => Some([near, middle, far]),
        _ => None,
    };
    Ok(Depth {
        size,
        intrinsics_px: source.camera().map(|c| [c.fx(), c.fy(), c.cx(), c.cy()]),
        frame_id: source.camera_frame_id().map(str::to_owned),
        frames_looked_at: looked_at,
        share_valid: if pixels == 0 { 0.0 } else { seen.len() as f64 / pixels as f64 },
        range_m,
        masks: source.has_masks(),
    })
}
