//! Joining parts of a picture, or renders of different samples of it, that were made apart.

use crate::identity::{Identity, listed};
use picture_file::spectral_exr::{
    self, Frame, Metadata, ReadExrError, RowReader, WriteOptions, WriteRowsError,
};
use spectra::SpectralImage;
use std::ops::Range;
use std::path::{Path, PathBuf};
use thiserror::Error;

mod average;
#[cfg(test)]
mod tests;

/// Bytes of the rows that are in memory at a time, of all files together.
const STRIP: u64 = 64 << 20;

/// Why files were not joined.
#[derive(Debug, Error)]
pub enum MergeError {
    /// There is nothing to join.
    #[error("there are no files to join")]
    None,
    /// A file cannot be read, or is damaged.
    #[error(transparent)]
    Read(#[from] ReadExrError),
    /// The joined file cannot be written.
    #[error(transparent)]
    Write(#[from] spectral_exr::WriteExrError),
    /// A file does not say what it is a part of.
    #[error(
        "{path} does not say what it is a part of: only files that `pellicle render` wrote can be joined"
    )]
    Unknown {
        /// The file.
        path: PathBuf,
    },
    /// A file is of another render.
    #[error("{path} is of another render than {first}: it differs in {differences}")]
    Foreign {
        /// The file.
        path: PathBuf,
        /// The file that it was compared with.
        first: PathBuf,
        /// In what.
        differences: String,
    },
    /// A file does not go with the others.
    #[error("{path} {reason}")]
    Unfit {
        /// The file.
        path: PathBuf,
        /// Why.
        reason: String,
    },
    /// Two files have something in common.
    #[error("{path} and {other} both have {what}")]
    Overlap {
        /// A file.
        path: PathBuf,
        /// The other.
        other: PathBuf,
        /// The rows or samples.
        what: String,
    },
    /// Nothing has some rows or samples.
    #[error("{what} are missing: no file has them")]
    Missing {
        /// The rows or samples.
        what: String,
    },
}

/// A file to be joined.
struct Piece {
    path: PathBuf,
    reader: RowReader,
    identity: Identity,
    /// The numbers of its samples.
    samples: Range<u64>,
}

impl Piece {
    fn open(path: &Path) -> Result<Self, MergeError> {
        let unknown = || MergeError::Unknown {
            path: path.to_owned(),
        };
        let mut reader = RowReader::open(path)?;
        let settings = &reader.metadata().settings;
        let identity = Identity::of_settings(settings).ok_or_else(unknown)?;
        let number = |name: &str| -> Option<u64> { settings.get(name)?.parse().ok() };
        let (first, count) = number("samples_from")
            .zip(number("samples"))
            .ok_or_else(unknown)?;
        let samples = first..first.saturating_add(count);
        if !reader.verify()? {
            return Err(unknown());
        }
        Ok(Self {
            path: path.to_owned(),
            reader,
            identity,
            samples,
        })
    }

    /// The rows of the picture that it holds.
    fn rows(&self) -> Range<u64> {
        let window = self.reader.window();
        u64::from(window.origin[1])..window.end()[1]
    }

    /// Reads rows, all of whose pixels must have all samples: a render that was broken off has left others.
    fn read(&mut self, rows: Range<u32>) -> Result<SpectralImage, MergeError> {
        let image = self.reader.read(rows.clone())?;
        let (width, window) = (image.width() as usize, self.reader.window());
        let (left, count) = (
            window.origin[0] as usize,
            self.samples.end - self.samples.start,
        );
        for (row, samples) in rows.zip(image.samples().chunks(width.max(1))) {
            let own = &samples[left..left + window.size[0] as usize];
            if own.iter().any(|&samples| u64::from(samples) != count) {
                return Err(self.unfit(format!(
                    "is not finished: row {row} has pixels without its {count} samples"
                )));
            }
        }
        Ok(image)
    }

    fn unfit(&self, reason: String) -> MergeError {
        MergeError::Unfit {
            path: self.path.clone(),
            reason,
        }
    }
}

/// How files are joined.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Merged {
    /// They were rows of the picture.
    Parts,
    /// They were samples of the same pixels.
    Ranges,
}

/// Joins files into one: rows of a picture to its bits, or different samples of the same pixels to their mean, with the variance of all.
///
/// The files must have been rendered from the same scene with the same settings by the same version and backend. All are checked before
/// anything is written, but for the samples of each pixel, which are checked while the file is written; it appears only if all are right.
///
/// # Errors
/// When a file is damaged, of another render, missing or there twice, or the result cannot be written. The message names the file.
pub fn merge(paths: &[PathBuf], output: &Path) -> Result<Merged, MergeError> {
    let pieces: Result<Vec<Piece>, MergeError> =
        paths.iter().map(|path| Piece::open(path)).collect();
    let mut pieces = pieces?;
    let Some(first) = pieces.first() else {
        return Err(MergeError::None);
    };
    for piece in &pieces {
        check_identity(first, piece)?;
    }
    let is_range = pieces.iter().all(|piece| piece.rows() == first.rows());
    let merged = if is_range && pieces.iter().any(|piece| piece.samples != first.samples) {
        check_ranges(&mut pieces)?;
        Merged::Ranges
    } else {
        check_parts(&mut pieces)?;
        Merged::Parts
    };
    let metadata = metadata(&pieces, merged);
    let frame = Frame {
        picture: pieces[0].reader.size(),
        window: match merged {
            Merged::Ranges => pieces[0].reader.window(),
            Merged::Parts => spectra::Window::whole(pieces[0].reader.size()),
        },
    };
    let mut strips = Strips::new(pieces, merged, frame);
    let mut next = || strips.next();
    match spectral_exr::write_rows(output, frame, &metadata, WriteOptions::default(), &mut next) {
        Ok(()) => Ok(merged),
        Err(WriteRowsError::Source(error)) => Err(error),
        Err(WriteRowsError::Write(error)) => Err(error.into()),
        Err(_) => Err(MergeError::None),
    }
}

fn check_identity(first: &Piece, piece: &Piece) -> Result<(), MergeError> {
    let differences = piece.identity.differences(&first.identity);
    if !differences.is_empty() {
        return Err(MergeError::Foreign {
            path: piece.path.clone(),
            first: first.path.clone(),
            differences: listed(&differences),
        });
    }
    if piece.identity.is_adaptive() {
        let reason = "has other numbers of samples in each tile, as --adaptive asks for";
        return Err(piece.unfit(reason.to_owned()));
    }
    let exposure = |piece: &Piece| piece.reader.metadata().exposure_ev;
    if piece.reader.content().is_polarized != first.reader.content().is_polarized {
        let (some, others) = ("S1, S2 and S3", first.path.display());
        return Err(piece.unfit(if piece.reader.content().is_polarized {
            format!("has {some} of polarized light, but {others} does not")
        } else {
            format!("does not have {some} of polarized light, but {others} does")
        }));
    }
    if piece.reader.light_groups() != first.reader.light_groups()
        || exposure(piece) != exposure(first)
    {
        return Err(piece.unfit(format!(
            "has other light groups or another exposure than {}",
            first.path.display()
        )));
    }
    Ok(())
}

/// Sorts pieces by a range of each, and checks that the ranges follow one another.
fn check_sequence(
    pieces: &mut [Piece],
    range: impl Fn(&Piece) -> Range<u64>,
    name: &str,
) -> Result<(), MergeError> {
    pieces.sort_by_key(|piece| (range(piece).start, range(piece).end));
    for pair in pieces.windows(2) {
        let (before, after) = (range(&pair[0]), range(&pair[1]));
        if after.start < before.end {
            let common = after.start..after.end.min(before.end);
            return Err(MergeError::Overlap {
                path: pair[1].path.clone(),
                other: pair[0].path.clone(),
                what: shown(name, &common),
            });
        }
        if after.start > before.end {
            let what = shown(name, &(before.end..after.start));
            return Err(MergeError::Missing { what });
        }
    }
    Ok(())
}

/// `rows 10 to 19`.
fn shown(name: &str, range: &Range<u64>) -> String {
    format!("{name} {} to {}", range.start, range.end.saturating_sub(1))
}

fn check_ranges(pieces: &mut [Piece]) -> Result<(), MergeError> {
    let first = pieces[0].reader.window();
    if let Some(other) = pieces.iter().find(|piece| piece.reader.window() != first) {
        return Err(other.unfit(format!(
            "holds other pixels than {}",
            pieces[0].path.display()
        )));
    }
    check_sequence(pieces, |piece| piece.samples.clone(), "samples")
}

fn check_parts(pieces: &mut [Piece]) -> Result<(), MergeError> {
    let samples = pieces[0].samples.clone();
    for piece in pieces.iter() {
        let ([width, _], window) = (piece.reader.size(), piece.reader.window());
        if window.origin[0] != 0 || window.size[0] != width {
            return Err(piece.unfit("does not hold whole rows of the picture".to_owned()));
        }
        if piece.samples != samples {
            return Err(piece.unfit(format!(
                "has {}, but {} has {}; was one of them stopped? (Of parts with ranges of samples, join the ranges of each part first.)",
                shown("samples", &piece.samples),
                pieces[0].path.display(),
                shown("samples", &samples)
            )));
        }
    }
    check_sequence(pieces, Piece::rows, "rows")?;
    let height = u64::from(pieces[0].reader.size()[1]);
    let (start, end) = (pieces[0].rows().start, pieces[pieces.len() - 1].rows().end);
    let missing = [0..start, end..height]
        .into_iter()
        .find(|rows| !rows.is_empty());
    match missing {
        Some(rows) => Err(MergeError::Missing {
            what: shown("rows", &rows),
        }),
        None => Ok(()),
    }
}

/// The settings that all pieces share, and the samples of the whole. The noise of parts is not that of the picture.
fn metadata(pieces: &[Piece], merged: Merged) -> Metadata {
    let mut metadata = pieces[0].reader.metadata().clone();
    metadata.notes.clear();
    let is_shared = |name: &String, value: &mut String| {
        let others = pieces[1..]
            .iter()
            .map(|piece| &piece.reader.metadata().settings);
        name == "renderer"
            || others
                .map(|settings| settings.get(name))
                .all(|other| other == Some(value))
    };
    metadata.settings.retain(is_shared);
    metadata.settings.remove("noise");
    let first = pieces[0].samples.start;
    let count: u64 = match merged {
        Merged::Parts => pieces[0].samples.end - first,
        Merged::Ranges => pieces[pieces.len() - 1].samples.end - first,
    };
    for (name, value) in [("samples_from", first), ("samples", count)] {
        metadata.settings.insert(name.to_owned(), value.to_string());
    }
    metadata
}

/// The rows of the joined picture, some at a time.
struct Strips {
    pieces: Vec<Piece>,
    merged: Merged,
    next: u32,
    end: u32,
    at_a_time: u32,
}

impl Strips {
    fn new(pieces: Vec<Piece>, merged: Merged, frame: Frame) -> Self {
        let content = pieces[0].reader.content();
        let at_once = match merged {
            Merged::Parts => 1,
            Merged::Ranges => pieces.len() as u64 + 1,
        };
        let row = SpectralImage::bytes(frame.picture[0], 1, content) as u64 * at_once;
        let (top, rows) = (frame.window.origin[1], frame.window.size[1]);
        Self {
            pieces,
            merged,
            next: top,
            end: top + rows,
            at_a_time: (STRIP / row.max(1)).clamp(1, u64::from(rows)) as u32,
        }
    }

    fn next(&mut self) -> Result<Option<SpectralImage>, MergeError> {
        if self.next == self.end {
            return Ok(None);
        }
        let mut end = (self.next + self.at_a_time).min(self.end);
        let image = match self.merged {
            Merged::Parts => {
                let row = u64::from(self.next);
                let piece = self
                    .pieces
                    .iter_mut()
                    .find(|piece| piece.rows().contains(&row));
                // All rows are in a piece.
                let Some(piece) = piece else { return Ok(None) };
                end = end.min(piece.rows().end as u32);
                piece.read(self.next..end)?
            }
            Merged::Ranges => {
                let rows = self.next..end;
                let read = |piece: &mut Piece| piece.read(rows.clone());
                let images: Result<Vec<_>, _> = self.pieces.iter_mut().map(read).collect();
                self.within_window(average::mean(&images?))
            }
        };
        self.next = end;
        Ok(Some(image))
    }

    /// Cuts rows of the picture to the window that the pieces hold.
    fn within_window(&self, image: SpectralImage) -> SpectralImage {
        let window = self.pieces[0].reader.window();
        if window.size[0] == image.width() {
            return image;
        }
        average::columns(&image, window.origin[0]..window.origin[0] + window.size[0])
    }
}
