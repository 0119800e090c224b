//! Renders a picture that does not fit into memory: strips of rows one after the other, each written when it is finished.

use super::rounds::session;
use super::{Job, Outcome, advance};
use crate::output::write_rows;
use crate::progress::Progress;
use crate::{interrupt, print};
use miette::{IntoDiagnostic, miette};
use pellicle::relight::XyzImage;
use pellicle::spectra::SpectralImage;
use pellicle::{RenderError, Session};
use std::time::Instant;

/// The strips of a picture, rendered on demand.
struct Strips<'a, 'b> {
    job: &'b Job<'a>,
    session: Session<'a>,
    rows: u32,
    next_row: u32,
    progress: &'b mut Progress,
    done: u64,
    /// The colors of all rows, if pictures are wanted.
    xyz: Vec<[f32; 3]>,
    /// The row before which a signal came or the device failed: the rows from there on are black.
    broken_off: Option<u32>,
    /// Why the device failed.
    error: Option<RenderError>,
}

impl Strips<'_, '_> {
    /// Renders the next strip; `None` after the last. After a signal or a failure the rows are black and have no samples.
    fn next(&mut self) -> miette::Result<Option<SpectralImage>> {
        let (first, height) = (self.next_row, self.job.window.size[1]);
        if first == height {
            return Ok(None);
        }
        self.next_row = (first + self.rows).min(height);
        let window = self.job.window.rows(first..self.next_row);
        let mut all = self.job.empty(window);
        if first > 0 && interrupt::signal().is_some() {
            self.broken_off.get_or_insert(first);
        }
        if self.broken_off.is_none() {
            let rounds = all.rounds_to(window, self.job.goal.samples);
            let (before, progress) = (self.done, &mut *self.progress);
            let mut update = |more| progress.update(before + more);
            match advance(&mut self.session, &mut all, &rounds, &mut update) {
                Ok(()) => self.done += window.pixels() as u64 * u64::from(self.job.goal.samples),
                // Nothing is worth keeping.
                Err(error) if first == 0 => return Err(error).into_diagnostic(),
                Err(error) => {
                    all = self.job.empty(window);
                    (self.broken_off, self.error) = (Some(first), Some(error));
                }
            }
        }
        let image = all.whole_image();
        if !self.job.outputs.pictures().is_empty() {
            self.xyz.extend_from_slice(image.xyz());
        }
        Ok(Some(image))
    }
}

/// Renders and writes strip by strip.
pub(super) fn run(job: &Job<'_>, rows: u32) -> miette::Result<Outcome> {
    let _awaited = interrupt::Awaited::new();
    let (goal, height) = (job.goal.samples, job.window.size[1]);
    print::note(format_args!(
        "{}the picture does not fit into memory at once: it is rendered {rows} of {height} rows at a time",
        job.heading
    ));
    let mut progress = Progress::new(job.heading);
    progress.set_total(job.window.pixels() as u64 * u64::from(goal));
    // The file says at its beginning which renderer made it, so no other may go on.
    let session = session(job, job.scene, &mut progress)?.allow_cpu(false);
    let mut metadata = job.metadata(false);
    metadata
        .settings
        .insert("samples".to_owned(), goal.to_string());
    let started = Instant::now();
    let mut strips = Strips {
        job,
        session,
        rows,
        next_row: 0,
        progress: &mut progress,
        done: 0,
        xyz: Vec::new(),
        broken_off: None,
        error: None,
    };
    match job.outputs.spectral().first() {
        Some(path) => {
            let mut next = || strips.next();
            write_rows(path, job.frame(), &metadata, &mut next)?;
        }
        None => while strips.next()?.is_some() {},
    }
    let (done, xyz) = (strips.done, strips.xyz);
    let (broken_off, error) = (strips.broken_off, strips.error);
    progress.clear();
    let seconds = started.elapsed().as_secs_f64();
    job.print_pace(&format!("{goal} samples per pixel"), done, seconds);
    if !job.outputs.pictures().is_empty() {
        let [width, height] = job.window.size;
        let colors = XyzImage::new(width, height, xyz);
        let colors = colors.ok_or_else(|| miette!("the strips do not make up the picture"))?;
        job.write_colors(&colors, false)?;
    }
    if let Some(row) = broken_off {
        let ([x, y], [width, height]) = (job.window.origin, job.window.size);
        print::note(format_args!(
            "stopped before row {row}: the rows from there on are black; render them with --crop {x},{},{width},{}",
            y + row,
            height - row
        ));
    }
    match (error, interrupt::signal()) {
        (Some(error), _) => Err(error).into_diagnostic(),
        (None, Some(signal)) if broken_off.is_some() => Ok(Outcome::Interrupted(signal)),
        _ => Ok(Outcome::Finished),
    }
}
