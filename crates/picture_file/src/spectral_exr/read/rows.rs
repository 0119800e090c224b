//! Reading some rows of a spectral image at a time.

use std::fs::File;
use std::io::BufReader;
use std::ops::Range;
use std::path::{Path, PathBuf};

use exr::block::reader::Reader;
use spectra::{BandGrid, LightGroup, SpectralImage, Window};

use super::{Pixels, Plan, check_memory, checked_plan, finish, pixels};
use crate::exr_file::{self, Context, ReadExrError, digest, each_block_within};
use crate::spectral_exr::frame::Frame;
use crate::spectral_exr::metadata::Metadata;

/// A spectral file whose header has been read and checked, and whose rows are read when they are needed: an image that does not fit
/// into memory can be read in strips.
///
/// The file stays open, so a file that takes its name meanwhile is not mixed in.
#[derive(Debug)]
pub struct RowReader {
    path: PathBuf,
    file: File,
    plan: Plan,
    light_groups: Vec<LightGroup>,
    metadata: Metadata,
}

impl RowReader {
    /// Opens a file that [`read`](super::read()) accepts, of any size.
    ///
    /// # Errors
    /// As [`read`](super::read()), except errors in pixels and a lack of memory.
    pub fn open(path: &Path) -> Result<Self, ReadExrError> {
        let context = Context { path };
        let (file, length) = exr_file::open_file(path)?;
        let handle = file.try_clone().map_err(|error| context.file(error))?;
        let reader = exr_file::reader(&context, handle)?;
        let (plan, metadata) = checked_plan(&context, &reader, length)?;
        // The lamp of reflectances is that of the finished image.
        let empty = finish(&context, Pixels::new(plan.of_rows(&(0..0))))?;
        Ok(Self {
            path: path.to_owned(),
            file,
            plan,
            light_groups: empty.light_groups().to_vec(),
            metadata,
        })
    }

    /// Width and height of the image in pixels.
    pub fn size(&self) -> [u32; 2] {
        let (width, height) = self.plan.window.size();
        // The numbers of a file have 32 bits.
        [width, height].map(|side| u32::try_from(side).unwrap_or(u32::MAX))
    }

    /// The part of the image that the file holds; the other pixels are black. A file that holds none of it has a window of 0×0 pixels.
    pub fn window(&self) -> Window {
        let (origin, size) = self.plan.window.held();
        Window { origin, size }
    }

    /// The image, and the part of it that the file holds, as for [`write_rows`](crate::spectral_exr::write_rows).
    pub fn frame(&self) -> Frame {
        Frame {
            picture: self.size(),
            window: self.window(),
        }
    }

    /// The bands of the image.
    pub fn bands(&self) -> &BandGrid {
        &self.plan.grid
    }

    /// The light groups of the image, at least one.
    pub fn light_groups(&self) -> &[LightGroup] {
        &self.light_groups
    }

    /// The data of the file other than its pixels.
    pub fn metadata(&self) -> &Metadata {
        &self.metadata
    }

    /// Reads these rows of the image, as an image of its width. The values are those that [`read`](super::read()) returns. Only parts
    /// of the file with such rows are read and decompressed, unless its table of contents is damaged. They are not compared with the
    /// file's digest, which is that of all pixels ([`Self::verify`]).
    ///
    /// # Errors
    /// When there are no such rows, their pixels are damaged or missing, or memory for them is not available.
    pub fn read(&mut self, rows: Range<u32>) -> Result<SpectralImage, ReadExrError> {
        let height = self.size()[1];
        if rows.start > rows.end || rows.end > height {
            return Err(ReadExrError::Rows {
                path: self.path.clone(),
                start: rows.start,
                end: rows.end,
                height,
            });
        }
        let plan = self.plan.of_rows(&rows);
        check_memory(&self.path, &plan)?;
        // Reading all of the file needs no table, and names the damage if there is other damage.
        match self.read_by_table(plan.clone()) {
            Ok(image) => Ok(image),
            Err(_) => pixels(&self.context(), self.reader()?, plan),
        }
    }

    /// Compares the file's digest with its pixels, reading all of them but keeping none. Returns false if the file has no digest.
    ///
    /// # Errors
    /// When the digest is another or the file cannot be read.
    pub fn verify(&mut self) -> Result<bool, ReadExrError> {
        digest::verify(&self.context(), self.reader()?, self.plan.layer)
    }

    fn read_by_table(&self, plan: Plan) -> Result<SpectralImage, ReadExrError> {
        let (context, window) = (self.context(), plan.window);
        let mut pixels = Pixels::new(plan);
        let part = self.plan.layer;
        each_block_within(
            &context,
            self.reader()?,
            part,
            &window,
            |block, channels| pixels.insert(block, channels),
        )?;
        finish(&context, pixels)
    }

    /// A reader at the start of the file. All readers share the position in it.
    fn reader(&self) -> Result<Reader<BufReader<File>>, ReadExrError> {
        let context = self.context();
        let file = self.file.try_clone().map_err(|error| context.file(error))?;
        exr_file::reader(&context, file)
    }

    fn context(&self) -> Context<'_> {
        Context { path: &self.path }
    }
}
