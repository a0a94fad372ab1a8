//! A calibration as MCAP for viewers of robots' data: the posed arm and what the camera saw of it.

use super::coarse::few_enough;
use super::leftovers::leftovers;
use super::picture::{Picture, Rgb};
use super::residual;
use super::seen::{Points, all_seen};
use crate::answer::{Answer, FrameOutcome};
use crate::observations::{Configuration, ImageSource, Observations};
use crate::pipeline::Outcome;
use eyebolt_geometry::{Base, Camera, CoordinateFrame, Transform};
use eyebolt_recording::{
    OPTICAL_FRAME, PaintedCloud, PointValues, StaticTransform, Viewed, ViewerWriter, WriteError,
    viewer_layout,
};
use eyebolt_registration::{Label, Posture, Refinement};
use eyebolt_render::{Raster, contour};
use eyebolt_robot::TriangleMesh;
use nalgebra::{Point3, Vector3};
use std::io::{Seek, Write};

/// Triangles of all links together.
const MOST_TRIANGLES: usize = 40_000;
/// What is not the arm.
const GREY: Rgb = [112, 116, 124];
/// Where captions stand, above the middle of the workspace, metres.
const ABOVE_M: f64 = 0.5;
/// From how far the scene is seen, in distances of the camera from the middle of the workspace.
const AWAY: f64 = 1.6;
/// Images whose axes are turned by less show what their optical frame would: a pixel of a fine camera.
const TURNED_RAD: f64 = 1e-3;
/// Between configurations whose times nobody knows.
const STEP_NS: i64 = 1_000_000_000;
/// Stamps are of 32 bits of seconds, and hold a little longer.
const LAST_STAMP_NS: i64 = (i32::MAX as i64 - 1) * 1_000_000_000;

/// An outcome with a pose, as viewers are shown it.
///
/// Frames are the base, the links (each below the base, where the answer has it) and the optical frame; what is seen is in
/// the optical frame, depth scaled by what fits best.
#[derive(Debug)]
pub struct Viewer<'a> {
    answer: &'a Answer,
    observations: &'a Observations,
    refinement: &'a Refinement,
    camera_from_base: Transform<Camera, Base>,
    postures: Vec<Posture>,
    middle_in_base_m: [f64; 3],
    camera_frame_id: String,
}

impl<'a> Viewer<'a> {
    /// What there is to see of `outcome`, of which `answer` was made; `None` without a pose.
    pub fn new(answer: &'a Answer, outcome: &'a Outcome) -> Option<Self> {
        let calibration = &outcome.calibration;
        let observations = outcome.observations.as_ref()?;
        let workspace = answer.workspace_in_base_m;
        Some(Self {
            answer,
            observations,
            refinement: calibration.refinement.as_ref()?,
            camera_from_base: calibration.camera_from_base?,
            postures: outcome.postures(),
            middle_in_base_m: workspace.unwrap_or(observations.workspace().coords.into()),
            camera_frame_id: camera_frame(answer, observations),
        })
    }

    /// Writes the file. `stamps_ns` has one stamp for each configuration, where their times are known; `pictures` are
    /// those of [`overlays`](super::overlays), or none.
    ///
    /// The same bytes on any number of threads.
    ///
    /// # Errors
    ///
    /// A failing `output`.
    pub fn write(
        &self,
        output: impl Write + Seek,
        stamps_ns: Option<&[i64]>,
        pictures: &[Picture],
    ) -> Result<(), WriteError> {
        let observations = self.observations;
        let stamps_ns = usable_stamps(stamps_ns, observations.configurations.len());
        let first_ns = stamps_ns.first().copied().unwrap_or(STEP_NS);
        let (base, camera) = (self.base(), self.camera_frame_id.as_str());
        let base_from_camera = named(base, camera, &self.camera_from_base.inverse());
        let of_a_camera = self.answer.intrinsics.is_some() && !is_turned(observations);
        let intrinsics = of_a_camera.then_some(&observations.camera);
        let caption = Point3::from(self.middle_in_base_m) + ABOVE_M * Vector3::z();
        let mut writer =
            ViewerWriter::new(output, first_ns, &base_from_camera, intrinsics, caption.into())?;
        let meshes = self.meshes();
        writer.robot(first_ns, meshes.iter().map(|(name, mesh)| (*name, mesh)))?;
        let left = leftovers(observations, self.refinement);
        let seen = all_seen(observations, &self.postures, self.refinement, &left);
        let mut raster = Raster::new(&observations.camera);
        for (index, configuration) in observations.configurations.iter().enumerate() {
            let (Some(posture), Some(stamp_ns)) = (self.postures.get(index), stamps_ns.get(index))
            else {
                break;
            };
            let png = pictures.get(index).map(Picture::encode_small_png);
            let Some(seen) = seen.get(index) else { break };
            let (points_m, rgb) = (self.in_camera(seen), colors(seen));
            writer.configuration(&Viewed {
                stamp_ns: *stamp_ns,
                base_from_link: &self.transforms(posture),
                points: PaintedCloud {
                    points_m: &points_m,
                    rgb: &rgb,
                    values: &[("residual_mm", PointValues::Real(&seen.behind_mm))],
                },
                outline_m: &self.outline(posture, &mut raster),
                caption: &self.caption(index, configuration),
                picture_png: png.as_deref(),
            })?;
        }
        writer.finish()
    }

    /// How Foxglove and Lichtblick show the file at once: a layout as JSON.
    pub fn layout(&self) -> String {
        let links: Vec<&str> = self.moving_links().map(|(_, name)| name).collect();
        let camera = self.camera_from_base.inverse().point(&Point3::origin());
        let middle = Point3::from(self.middle_in_base_m);
        let distance_m = AWAY * (camera - middle).norm();
        viewer_layout(self.base(), &links, self.middle_in_base_m, distance_m)
    }

    fn base(&self) -> &str {
        &self.answer.frames.base
    }

    /// Numbers and names of the links that have a frame of their own: all but the base.
    fn moving_links(&self) -> impl Iterator<Item = (usize, &str)> {
        let links = self.observations.arm.links().iter().enumerate();
        links
            .map(|(index, link)| (index, link.name.as_str()))
            .filter(move |(_, name)| *name != self.base())
    }

    /// The links' meshes by the frame that they are in.
    fn meshes(&self) -> Vec<(&str, TriangleMesh)> {
        let links = self.observations.arm.links();
        let meshes: Vec<&TriangleMesh> = links.iter().map(|link| &link.model.mesh).collect();
        let few = few_enough(&meshes, MOST_TRIANGLES);
        let named = links.iter().zip(few).enumerate();
        named
            .map(|(index, (link, mut mesh))| {
                // The base frame is that of the joints, against which the base link may be turned, always alike.
                if link.name == self.base()
                    && let Some(posture) = self.postures.first()
                    && let Some(pose) = posture.base_from_link().get(index)
                {
                    let pose = pose.isometry().cast::<f32>();
                    mesh.vertices.iter_mut().for_each(|vertex| *vertex = pose * *vertex);
                }
                (link.name.as_str(), mesh)
            })
            .collect()
    }

    fn transforms(&self, posture: &Posture) -> Vec<StaticTransform> {
        let poses = posture.base_from_link();
        let links = self.moving_links();
        let placed = links.filter_map(|(index, name)| Some((name, poses.get(index)?)));
        placed.map(|(name, pose)| named(self.base(), name, pose)).collect()
    }

    /// Points of the optical frame.
    fn in_camera(&self, seen: &Points) -> Vec<[f32; 3]> {
        let camera_from_base = self.camera_from_base.isometry().cast::<f32>();
        seen.points.iter().map(|point| (camera_from_base * point).coords.into()).collect()
    }

    /// The drawn arm's contour on its surface: at each place a piece of it, one pixel long.
    fn outline(&self, posture: &Posture, raster: &mut Raster) -> Vec<[[f32; 3]; 2]> {
        let observations = self.observations;
        let camera = &observations.camera;
        raster.draw(camera, &posture.meshes(&observations.arm, &self.refinement.camera_from_base));
        let turn = observations.optical_from_camera.isometry().cast::<f32>();
        let pixel = [camera.fx(), camera.fy()].map(|focal_px| 0.5 / focal_px as f32);
        let pieces = contour(raster, camera).into_iter().map(|place| {
            let (at, out) = (place.point_in_camera, place.outward);
            let along = at.z * Vector3::new(-out.y * pixel[0], out.x * pixel[1], 0.0);
            [at - along, at + along].map(|end| (turn * end).coords.into())
        });
        pieces.collect()
    }

    fn caption(&self, index: usize, configuration: &Configuration) -> String {
        let count = self.observations.configurations.len();
        let name = configuration.frames.first().map_or("", String::as_str);
        let said = self.answer.configurations.iter().find(|frame| frame.name == name);
        let mut text = format!("{} of {count}: frame {name}", index + 1);
        if let Some(FrameOutcome { residual_mm, reason, .. }) = said {
            text.extend(residual_mm.map(|mm| format!(", residual {mm:.1} mm")));
            text.extend(reason.iter().map(|reason| format!(", {reason}")));
        }
        text
    }
}

/// Of each point: grey for what is not the arm.
fn colors(seen: &Points) -> Vec<Rgb> {
    let told = seen.labels.iter().zip(&seen.behind_mm);
    told.map(|(label, behind_mm)| match label {
        Label::Background => GREY,
        _ if behind_mm.is_nan() => GREY,
        _ => residual::color(*behind_mm),
    })
    .collect()
}

/// Whether the axes of the images are turned in the frame of the points, or the camera is made up.
fn is_turned(observations: &Observations) -> bool {
    observations.source == ImageSource::DrawnClouds
        || observations.optical_from_camera.rotation().angle() > TURNED_RAD
}

/// A name that no other frame has.
fn camera_frame(answer: &Answer, observations: &Observations) -> String {
    let mut name = answer.frames.camera.clone().unwrap_or_else(|| OPTICAL_FRAME.to_owned());
    let links = observations.arm.links();
    while name == answer.frames.base || links.iter().any(|link| link.name == name) {
        name += "_camera";
    }
    name
}

fn named<To: CoordinateFrame, From: CoordinateFrame>(
    parent: &str,
    child: &str,
    parent_from_child: &Transform<To, From>,
) -> StaticTransform {
    StaticTransform {
        parent: parent.to_owned(),
        child: child.to_owned(),
        translation_m: parent_from_child.translation_m().into(),
        rotation_xyzw: parent_from_child.rotation_xyzw(),
    }
}

/// The stamps, if they rise and messages can hold them; else one a second.
fn usable_stamps(stamps_ns: Option<&[i64]>, count: usize) -> Vec<i64> {
    let legal = |stamps: &&[i64]| {
        stamps.len() == count
            && stamps.iter().all(|stamp| (1..=LAST_STAMP_NS).contains(stamp))
            && stamps.windows(2).all(|pair| pair[0] < pair[1])
    };
    let counted = || (1..).map(|second| second * STEP_NS).take(count).collect();
    stamps_ns.filter(legal).map_or_else(counted, <[i64]>::to_vec)
}
