//! The links that never move, drawn somewhere before the depth that lasts.

use crate::observations::Observations;
use eyebolt_geometry::{Base, Camera, Mask, Transform};
use eyebolt_registration::{ArmModel, Posture, Start, median};
use eyebolt_render::Raster;
use nalgebra::{Point3, UnitQuaternion, Vector3};
use rayon::prelude::*;

/// Edges of moving links, and what cameras make of them, reach this far, pixels.
const CLEARANCE_PX: u32 = 8;
/// Pixels this near to the links' outline do not say that they are seen through, as in the refinement.
const RIM_PX: u32 = 4;
/// Pixels over which errors of depth are correlated, as in the refinement.
const CORRELATED_PIXELS: f64 = 400.0;
/// Pixels over which wrong matches are: the patches of gloss.
const WRONG_TOGETHER: f64 = 80.0;
/// Pixels looked at for one place, about.
const PIXELS: usize = 4000;
/// A place where less than this share of what is seen of the links is seen hides them.
const LEAST_SHARE: f64 = 0.7;
/// Depth is wrong somewhere on the arm in this share of pixels, and then anywhere within this, metres.
const WRONG: f64 = 0.1;
const ANYWHERE_M: f64 = 1.0;
/// Depth cameras have errors that are alike over all of a link, of this size, metres.
const LEAST_DEVIATION_M: f64 = 0.003;
/// Poses of a link that are the same.
const SAME_M: f64 = 1e-3;
const SAME_RAD: f64 = 2e-3;
const TAU: f64 = std::f64::consts::TAU;

/// What speaks for another place than the one described: by how much the logarithm of the likelihood grows there.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Gain {
    /// Since less of the links is seen through.
    pub seen_through: f64,
    /// Since depth is nearer to their surfaces.
    pub nearer: f64,
    /// Since more of what is seen lies on their surfaces.
    pub more: f64,
    /// Since less stands before them.
    pub uncovered: f64,
}

/// How the links fit in one place.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Fit {
    /// Pixels that say something, and at how many of them the scene behind is seen.
    pub pixels: usize,
    through: usize,
    /// At how many others something stands before the links.
    hidden: usize,
    /// By how much the logarithm of the likelihood of the others is less than if all agreed perfectly.
    less: f64,
    /// And of one that is seen through.
    less_through: f64,
}

impl Fit {
    /// Per pixel: places that show more of the links are no better for that, since what stands beside them
    /// may look like them.
    pub(super) fn misfit(&self) -> f64 {
        self.share_through() * self.less_through / WRONG_TOGETHER + self.off() / CORRELATED_PIXELS
    }

    fn share_through(&self) -> f64 {
        self.through as f64 / self.pixels.max(1) as f64
    }

    fn off(&self) -> f64 {
        self.less / self.pixels.max(1) as f64
    }

    /// Whether as good as all that is seen of the links as described is seen here too.
    pub(super) fn is_as_much_as(&self, described: &Self) -> bool {
        self.pixels as f64 >= LEAST_SHARE * described.pixels as f64
    }
}

/// The links that never move, and what is seen about them.
pub(super) struct Still<'a> {
    observations: &'a Observations,
    links: ArmModel,
    posture: Posture,
    camera_from_base: Transform<Camera, Base>,
    /// Depth of what stays, metres; 0 where nothing is known.
    seen_m: Vec<f32>,
    deviation_m: f64,
    stride: usize,
}

impl<'a> Still<'a> {
    pub(super) fn new(
        observations: &'a Observations,
        used: &[usize],
        rasters: &mut [Raster],
        at: &Start,
        deviation_m: f64,
    ) -> Option<Self> {
        let arm = &observations.arm;
        let configurations = used.iter().map(|index| &observations.configurations[*index]);
        let postures: Vec<Posture> = configurations
            .clone()
            .map(|configuration| configuration.posture.moved(arm, &at.joint_offsets))
            .collect();
        let first = postures.first()?;
        let stays = |link: &usize| {
            let carried = arm.joints().iter().any(|joint| joint.carries[*link]);
            let same = |posture: &Posture| {
                let pose = &posture.base_from_link()[*link];
                let (metres, radians) = pose.distance_to(&first.base_from_link()[*link]);
                metres < SAME_M && radians < SAME_RAD
            };
            !carried && postures.iter().all(same)
        };
        let (stay, move_): (Vec<usize>, Vec<usize>) = (0..arm.links().len()).partition(stays);
        if stay.is_empty() || move_.is_empty() {
            return None;
        }
        let links = ArmModel::new(stay.iter().map(|link| arm.links()[*link].clone()).collect());
        let poses = stay.iter().map(|link| first.base_from_link()[*link]).collect();
        let posture = Posture::new(&links, poses);
        let views: Vec<(&[f32], Mask)> = configurations
            .zip(&postures)
            .zip(rasters.iter_mut())
            .map(|((configuration, posture), raster)| {
                let meshes = posture.meshes(arm, &at.camera_from_base);
                let moving: Vec<_> = move_.iter().map(|link| meshes[*link]).collect();
                raster.draw(&observations.camera, &moving);
                let free = raster.inverse_depth().iter().map(|inverse| *inverse <= 0.0).collect();
                let (width, height) = (observations.camera.width(), observations.camera.height());
                let free =
                    Mask::new(width, height, free).expect("a raster is of its camera's size");
                (configuration.depth.depth_m(), free.eroded(CLEARANCE_PX))
            })
            .collect();
        let factor = at.depth_factor();
        let mut still = Self {
            observations,
            links,
            posture,
            camera_from_base: at.camera_from_base,
            seen_m: (0..observations.camera.pixel_count())
                .into_par_iter()
                .map(|pixel| factor * lasting(&views, pixel))
                .collect(),
            deviation_m: deviation_m.max(LEAST_DEVIATION_M),
            stride: 1,
        };
        let mut raster = Raster::new(&observations.camera);
        still.draw(&mut raster, &Vector3::zeros());
        still.stride = ((raster.pixels().count() / PIXELS) as f64).sqrt().ceil().max(1.0) as usize;
        Some(still)
    }

    /// Draws the links `shift_m` from where the description has them.
    fn draw(&self, raster: &mut Raster, shift_m: &Vector3<f64>) {
        let shift = Transform::<Base, Base>::from_parts(*shift_m, UnitQuaternion::identity());
        let meshes = self.posture.meshes(&self.links, &(self.camera_from_base * shift));
        raster.draw(&self.observations.camera, &meshes);
    }

    /// How the links fit where the description has them.
    pub(super) fn fit_as_described(&self) -> Fit {
        self.fit(&mut Raster::new(&self.observations.camera), &Vector3::zeros())
    }

    /// How the links fit there.
    pub(super) fn fit(&self, raster: &mut Raster, shift_m: &Vector3<f64>) -> Fit {
        self.draw(raster, shift_m);
        let base_from_camera = self.camera_from_base.inverse().isometry().cast::<f32>();
        let shift = shift_m.cast::<f32>();
        let width = self.observations.camera.width() as usize;
        let reach = (4.0 * self.deviation_m) as f32;
        let (mut fit, mut last) = (Fit::default(), 0);
        let (width_px, height_px) =
            (self.observations.camera.width(), self.observations.camera.height());
        let drawn = raster.inverse_depth().iter().map(|inverse| *inverse > 0.0).collect();
        let drawn =
            Mask::new(width_px, height_px, drawn).expect("a raster is of its camera's size");
        let inner = drawn.eroded(RIM_PX);
        let at_surface = (1.0 - WRONG) * ANYWHERE_M / (self.deviation_m * TAU.sqrt());
        for pixel in raster.pixels() {
            if !(pixel / width).is_multiple_of(self.stride)
                || !(pixel % width).is_multiple_of(self.stride)
            {
                continue;
            }
            let (Some(z), seen) = (raster.depth_m(pixel), self.seen_m[pixel]) else { continue };
            if seen <= 0.0 {
                continue;
            }
            let point: Point3<f32> =
                base_from_camera * self.observations.rays.point(pixel, seen) - shift;
            let nearest = self.posture.nearest_within(&self.links, &point, reach, last);
            let near =
                nearest.filter(|nearest| nearest.distance_m > -reach).map_or(0.0, |nearest| {
                    last = nearest.link;
                    let off = f64::from(nearest.distance_m) / self.deviation_m;
                    at_surface * (-0.5 * off * off).exp()
                });
            match near > 1.0 {
                true => fit.less += (at_surface + WRONG).ln() - (near + WRONG).ln(),
                false if seen >= z && inner.as_slice()[pixel] => fit.through += 1,
                // What stands before the links hides them, wherever they are.
                false if seen < z => {
                    fit.hidden += 1;
                    continue;
                }
                false => continue,
            }
            fit.pixels += 1;
        }
        fit.less_through = (at_surface + WRONG).ln() - WRONG.ln();
        fit
    }

    /// What speaks for a place that is not near, by its `fit`, against where the links are `described`.
    pub(super) fn gain(&self, described: &Fit, fit: &Fit) -> Gain {
        let pixels = (described.pixels * self.stride * self.stride) as f64;
        let through = described.share_through() - fit.share_through();
        let per_patch = (self.stride * self.stride) as f64 / CORRELATED_PIXELS;
        let patches = |pixels: usize| pixels as f64 * per_patch * described.less_through;
        let on_surface = |fit: &Fit| patches(fit.pixels - fit.through);
        Gain {
            seen_through: pixels / WRONG_TOGETHER * described.less_through * through,
            nearer: pixels / CORRELATED_PIXELS * (described.off() - fit.off()),
            more: on_surface(fit) - on_surface(described),
            uncovered: patches(described.hidden) - patches(fit.hidden),
        }
    }
}

/// Depth at `pixel` that lasts over the configurations in which it is clear of what moves; 0 if most of
/// them have none there.
fn lasting(views: &[(&[f32], Mask)], pixel: usize) -> f32 {
    let clear = || views.iter().filter(|(_, free)| free.as_slice()[pixel]);
    let mut depths: Vec<f64> =
        clear().map(|(depth, _)| f64::from(depth[pixel])).filter(|z| *z > 0.0).collect();
    if 2 * depths.len() < clear().count() {
        return 0.0;
    }
    median(&mut depths).map_or(0.0, |z| z as f32)
}
