//! From colour pictures to what each configuration shows of the marker.

use super::request::{MarkerFailure, MarkerRequest};
use super::seen::together;
use crate::evenly::evenly;
use crate::progress::Progress;
use crate::record::{Group, Groups, RecordError, group_frames, most_spread};
use eyebolt_geometry::{Base, Camera, EndEffector, PinholeCamera, Transform};
use eyebolt_markers::{Detection, GreyImage, Layout, NotSeen, Sighting, Target};
use eyebolt_recording::{CameraPicture, FrameSource};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Pictures of one configuration: their mean has less noise, and more of them hardly less.
const MOST_FRAMES: usize = 8;

/// What the pictures of a recording show of a marker.
#[derive(Clone, Debug)]
pub struct MarkerObservations {
    /// What was looked for: a tag of any number has the number that was seen most.
    pub target: Target,
    /// The camera that took the pictures.
    pub camera: PinholeCamera,
    /// From its optical frame to the depth optical frame.
    pub depth_from_color: Transform<Camera, Camera>,
    /// In the order of the recording.
    pub configurations: Vec<MarkerConfiguration>,
    /// Configurations that were left out because the others differ more.
    pub spare_configurations: usize,
    /// Frames without the position of a joint that others have.
    pub untold_frames: usize,
}

/// What the pictures of one configuration show.
#[derive(Clone, Debug)]
pub struct MarkerConfiguration {
    /// Names of its frames.
    pub frames: Vec<String>,
    /// Where the robot was.
    pub base_from_end_effector: Transform<Base, EndEffector>,
    /// The marker, or why not.
    pub seen: Result<Sighting, NotSeen>,
}

/// Looks for the marker of `request` in the pictures of every configuration.
///
/// # Errors
///
/// The first thing that cannot be read or does not fit, in the order of the frames; no pictures at all.
pub fn observe(
    request: &MarkerRequest<'_>,
    progress: &dyn Progress,
) -> Result<MarkerObservations, MarkerFailure> {
    let MarkerRequest { source, arm, target, most_configurations, .. } = request;
    let Groups { groups, untold_frames } = group_frames(*source, arm, |_, _| {})?;
    if groups.is_empty() {
        return Err(RecordError::NoFrames.into());
    }
    let hand = |group: &Group| vec![as_link(&group.first.base_from_end_effector)];
    let hands: Vec<_> = groups.iter().map(hand).collect();
    let chosen = most_spread(&hands, *most_configurations);
    let view = View::find(*source, &groups, &chosen)?;
    progress.advance(0, chosen.len())?;
    let looked = chosen.par_iter().map(|group| -> Result<Vec<Look>, MarkerFailure> {
        let frames = groups.get(*group).map(|group| group.frames.as_slice()).unwrap_or_default();
        let looks = evenly(frames, MOST_FRAMES).into_iter();
        looks.filter_map(|frame| look(*source, frame, &view, target).transpose()).collect()
    });
    // Collected first: of several errors the first is reported, whichever thread met it.
    let looked: Vec<Result<Vec<Look>, MarkerFailure>> = looked.collect();
    let looked = looked.into_iter().collect::<Result<Vec<_>, _>>()?;
    progress.advance(chosen.len(), chosen.len())?;
    let target = numbered(target, &looked);
    let configuration = |(group, looks): (&usize, &Vec<Look>)| {
        let group = groups.get(*group)?;
        let names = group.frames.iter().filter_map(|frame| source.frame_names().get(*frame));
        let sightings: Vec<_> = looks.iter().map(|look| look.of(&target)).collect();
        Some(MarkerConfiguration {
            frames: names.cloned().collect(),
            base_from_end_effector: group.first.base_from_end_effector,
            seen: together(&sightings),
        })
    };
    Ok(MarkerObservations {
        configurations: chosen.iter().zip(&looked).filter_map(configuration).collect(),
        target,
        camera: view.camera,
        depth_from_color: view.depth_from_color,
        spare_configurations: groups.len() - chosen.len(),
        untold_frames,
    })
}

/// The same pose, of any link: what configurations are compared by.
fn as_link(pose: &Transform<Base, EndEffector>) -> Transform<Base, eyebolt_geometry::Link> {
    Transform::from_isometry(*pose.isometry())
}

/// The camera of all pictures.
struct View {
    camera: PinholeCamera,
    depth_from_color: Transform<Camera, Camera>,
}

impl View {
    /// That of the first picture.
    fn find(
        source: &dyn FrameSource,
        groups: &[Group],
        chosen: &[usize],
    ) -> Result<Self, MarkerFailure> {
        let frames = chosen.iter().filter_map(|group| groups.get(*group)).flat_map(|g| &g.frames);
        for frame in frames {
            if let Some(CameraPicture { camera, depth_from_color, .. }) = read(source, *frame)? {
                return Ok(Self { camera, depth_from_color });
            }
        }
        Err(MarkerFailure::NoPictures)
    }
}

fn read(source: &dyn FrameSource, frame: usize) -> Result<Option<CameraPicture>, MarkerFailure> {
    match source.read_picture(frame) {
        Err(error) if source.may_leave_out(&error) => Ok(None),
        read => Ok(read.map_err(RecordError::from)?),
    }
}

/// What one picture shows.
enum Look {
    /// Of a target whose numbers are known.
    Target(Result<Sighting, NotSeen>),
    /// Tags of any number.
    Tags(Vec<Detection>),
}

impl Look {
    fn of(&self, target: &Target) -> Result<Sighting, NotSeen> {
        match self {
            Self::Target(sighting) => sighting.clone(),
            Self::Tags(found) => target.corners_of(found),
        }
    }
}

/// What the picture of `frame` shows of `target`; `None` without a picture.
fn look(
    source: &dyn FrameSource,
    frame: usize,
    view: &View,
    target: &Target,
) -> Result<Option<Look>, MarkerFailure> {
    let Some(CameraPicture { picture, camera, .. }) = read(source, frame)? else { return Ok(None) };
    if camera != view.camera {
        let frame = source.frame_names().get(frame).cloned().unwrap_or_default();
        return Err(MarkerFailure::OtherCamera { frame });
    }
    let Ok(image) = GreyImage::from_rgb(picture.width, picture.height, &picture.rgb) else {
        return Ok(None);
    };
    let found = target.detect(&image);
    Ok(Some(match target.layout() {
        Layout::Tag { id: None } => Look::Tags(found),
        _ => Look::Target(target.sighting(&image, &found)),
    }))
}

/// `target` with the number that most pictures show, the lowest of equals, if it has none.
fn numbered(target: &Target, looked: &[Vec<Look>]) -> Target {
    let mut counts: BTreeMap<u32, usize> = BTreeMap::new();
    for look in looked.iter().flatten() {
        if let Look::Tags(found) = look {
            found.iter().for_each(|tag| *counts.entry(tag.id).or_default() += 1);
        }
    }
    let most = counts.iter().rev().max_by_key(|(_, count)| **count);
    most.map_or_else(|| target.clone(), |(id, _)| target.with_id(*id))
}
