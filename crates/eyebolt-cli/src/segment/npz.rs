//! Labels of all frames as arrays, for NumPy.

use super::segmented::{Segmented, Sink};
use anyhow::Result;
use eyebolt::record::FrameImages;
use eyebolt::segment::UNKNOWN;
use eyebolt_recording::{Recording, write_npy};
use std::fs::File;
use std::io::{self, BufReader, BufWriter, Seek, Write};
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

/// Writes `label` and `probability`, `(frames, rows, columns)` each, and the `name` of each frame: a damaged frame is one
/// without depth. Memory holds one frame.
pub(super) struct NpzSink<'a> {
    zip: ZipWriter<&'a mut File>,
    /// The second array: a zip takes one file after the other.
    probability: BufWriter<File>,
    names: &'a [String],
    /// Rows and columns.
    size: [usize; 2],
    /// Frames that are written.
    done: usize,
}

impl<'a> NpzSink<'a> {
    pub(super) fn new(file: &'a mut File, recording: &'a Recording<'a>) -> Result<Self> {
        let images = FrameImages::of(recording.source())?;
        let camera = images.camera();
        let size = [camera.height() as usize, camera.width() as usize];
        let names = recording.frame_names();
        let probability = BufWriter::new(tempfile::tempfile()?);
        let mut sink = Self { zip: ZipWriter::new(file), probability, names, size, done: 0 };
        sink.array("label", "|u1")?;
        Ok(sink)
    }

    /// Begins an array of all pixels of all frames.
    fn array(&mut self, name: &str, descr: &str) -> Result<()> {
        self.entry(name)?;
        let [rows, columns] = self.size;
        let head = write_npy(descr, &[self.names.len(), rows, columns], []);
        Ok(self.zip.write_all(&head)?)
    }

    fn entry(&mut self, name: &str) -> Result<()> {
        // More than 4 GB of labels compress to little.
        let options = SimpleFileOptions::default().large_file(true);
        Ok(self.zip.start_file(format!("{name}.npy"), options)?)
    }

    /// Nothing seen, up to frame `end`.
    fn fill(&mut self, end: usize) -> Result<()> {
        let pixels = self.size[0] * self.size[1];
        for _ in self.done..end {
            self.zip.write_all(&vec![UNKNOWN; pixels])?;
            self.probability.write_all(&vec![0; size_of::<f32>() * pixels])?;
        }
        self.done = self.done.max(end);
        Ok(())
    }

    pub(super) fn finish(mut self) -> Result<()> {
        self.fill(self.names.len())?;
        self.array("probability", "<f4")?;
        self.probability.rewind()?;
        io::copy(&mut BufReader::new(self.probability.get_ref()), &mut self.zip)?;
        let longest = self.names.iter().map(|name| name.chars().count()).max().unwrap_or(0).max(1);
        // NumPy has text in characters of four bytes, of one length.
        let padded = |name: &String| {
            let characters = name.chars().map(u32::from).chain(std::iter::repeat(0));
            characters.take(longest).flat_map(u32::to_le_bytes).collect::<Vec<u8>>()
        };
        let names = self.names.iter().flat_map(padded);
        let names = write_npy(&format!("<U{longest}"), &[self.names.len()], names);
        self.entry("name")?;
        self.zip.write_all(&names)?;
        self.zip.finish()?;
        Ok(())
    }
}

impl Sink for NpzSink<'_> {
    fn frame(&mut self, frame: &Segmented<'_>) -> Result<()> {
        self.fill(frame.index)?;
        self.zip.write_all(&frame.found.label)?;
        for at in 0..frame.found.label.len() {
            let sure = frame.found.probability_of_label(at).unwrap_or(0.0);
            self.probability.write_all(&sure.to_le_bytes())?;
        }
        self.done = frame.index + 1;
        Ok(())
    }
}
