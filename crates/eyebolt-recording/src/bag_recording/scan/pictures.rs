//! Pictures as a scan meets them: of which kind they are, and which of them are of use.

use crate::bag::Locator;
use crate::message::{
    CloudMessage, CompressedImageMessage, ImageMessage, WireProblem, WireReader, is_depth_encoding,
    types,
};

/// Pictures of one topic.
#[derive(Clone, Debug)]
pub(crate) struct Pictures {
    pub(crate) kind: PictureKind,
    /// All, whether of use or not, in the order of the bag.
    pub(crate) frames: Vec<FrameEntry>,
    /// Width and height of the first one that is compressed, where it tells.
    pub(crate) compressed_size: Option<(u32, u32)>,
    /// Some pixels of the last depth image.
    samples: Vec<f32>,
    /// How many of them differ from those before, until it is noted.
    change: f32,
}

/// How pictures are stored, told by the first one that can be read.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) enum PictureKind {
    Image {
        encoding: String,
        size: (u32, u32),
    },
    CompressedDepth,
    Cloud {
        size: (u32, u32),
    },
    /// Compressed, and no depth.
    CompressedColor,
    #[default]
    Unknown,
}

impl PictureKind {
    /// Whether distances can be read from it, the best kind first.
    pub(crate) fn range_rank(&self) -> Option<u8> {
        match self {
            // Infrared pictures are grey of 16 bits too.
            Self::Image { encoding, .. } if encoding == "mono16" => Some(3),
            Self::Image { encoding, .. } if is_depth_encoding(encoding) => Some(0),
            Self::CompressedDepth => Some(0),
            Self::Cloud { .. } => Some(2),
            _ => None,
        }
    }
}

/// When and where a picture was recorded.
#[derive(Clone, Debug)]
pub(crate) struct FrameEntry {
    pub(crate) stamp_ns: i64,
    /// Nobody set its stamp; the time of recording, which is of another clock, stands in.
    pub(crate) stands_in: bool,
    pub(crate) locator: Locator,
    /// Why it is of no use, if the scan could see that.
    pub(crate) unfit: Option<Unfit>,
    /// Share of the pixels whose depth differs from the last image's; NaN where nobody knows.
    pub(crate) change: f32,
}

/// Why a picture is of no use.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Unfit {
    /// Its message is damaged, or not like the first one.
    Unreadable(Box<WireProblem>),
    /// It is of depth, and has none.
    Empty,
}

/// Pixels that tell whether something moves.
const SAMPLES: usize = 4096;
/// Depth that differs by this share is another thing's, and not noise.
const DIFFERENT: f32 = 0.03;
/// More pictures on one topic are not read: nine hours of 30 a second.
const MOST_FRAMES: usize = 1 << 20;

impl Default for Pictures {
    fn default() -> Self {
        let kind = PictureKind::Unknown;
        let (frames, samples) = (Vec::new(), Vec::new());
        Self { kind, frames, compressed_size: None, samples, change: f32::NAN }
    }
}

impl Pictures {
    /// Takes in the message that `reader` is at the beginning of; the error says what is wrong.
    pub(super) fn add(
        &mut self,
        message_type: &str,
        reader: Result<WireReader<'_>, WireProblem>,
        (stamp_ns, stands_in): (i64, bool),
        locator: Locator,
    ) -> Result<(), WireProblem> {
        if self.frames.len() >= MOST_FRAMES {
            let problem = format!("the topic has more than {MOST_FRAMES} pictures");
            return Err(WireProblem::new("data", problem));
        }
        let read = reader.and_then(|mut reader| self.has_something(message_type, &mut reader));
        let unfit = match &read {
            Ok(true) => None,
            Ok(false) => Some(Unfit::Empty),
            Err(problem) => Some(Unfit::Unreadable(Box::new(problem.clone()))),
        };
        let change = std::mem::replace(&mut self.change, f32::NAN);
        self.frames.push(FrameEntry { stamp_ns, stands_in, locator, unfit, change });
        read.map(drop)
    }

    /// Share of `samples` that differ from the last ones, which they replace.
    fn changed(&mut self, samples: Vec<f32>) -> f32 {
        let last = std::mem::replace(&mut self.samples, samples);
        if last.len() != self.samples.len() {
            return f32::NAN;
        }
        let known = last.iter().zip(&self.samples).filter(|(a, b)| **a > 0.0 && **b > 0.0);
        let (count, changed) = known.fold((0_u32, 0_u32), |(count, changed), (a, b)| {
            (count + 1, changed + u32::from((a - b).abs() > DIFFERENT * a))
        });
        changed as f32 / count as f32
    }

    /// Checks a message, without looking at all its pixels; whether there is something to see.
    fn has_something(
        &mut self,
        message_type: &str,
        reader: &mut WireReader<'_>,
    ) -> Result<bool, WireProblem> {
        let (kind, seen) = match message_type {
            types::IMAGE => {
                let image = ImageMessage::read(reader)?;
                image.check()?;
                let depth = is_depth_encoding(image.encoding);
                let kind = PictureKind::Image {
                    encoding: image.encoding.to_owned(),
                    size: (image.width, image.height),
                };
                if depth {
                    self.change = self.changed(image.depth_samples(SAMPLES)?);
                }
                (kind, !depth || image.has_depth()?)
            }
            types::CLOUD => {
                let cloud = CloudMessage::read(reader)?;
                (PictureKind::Cloud { size: (cloud.width, cloud.height) }, cloud.has_point()?)
            }
            _ => {
                let picture = CompressedImageMessage::read(reader)?;
                if self.compressed_size.is_none() {
                    self.compressed_size = picture.size();
                }
                match picture.is_depth() {
                    true => (PictureKind::CompressedDepth, true),
                    false => (PictureKind::CompressedColor, true),
                }
            }
        };
        match &self.kind {
            PictureKind::Unknown => self.kind = kind,
            // Clouds without order have as many points as were seen.
            PictureKind::Cloud { .. } => {}
            first if *first == kind => {}
            first => {
                let problem = format!("the picture is {}, the first {}", kind.text(), first.text());
                return Err(WireProblem::new("encoding", problem));
            }
        }
        Ok(seen)
    }
}

impl PictureKind {
    /// What it is, for messages.
    pub(super) fn text(&self) -> String {
        match self {
            Self::Image { encoding, size } => format!("{} x {} in {encoding}", size.0, size.1),
            Self::CompressedDepth => "compressed depth".to_owned(),
            Self::CompressedColor => "a compressed picture".to_owned(),
            Self::Cloud { size } => format!("a cloud of {} x {} points", size.0, size.1),
            Self::Unknown => "nothing known".to_owned(),
        }
    }
}
