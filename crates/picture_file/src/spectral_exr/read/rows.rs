//! Reading some rows of a spectral image at a time.

use std::fs::File;
use std::io::BufReader;
use std::ops::Range;
use std::path::{Path, PathBuf};

use exr::block::reader::Reader;
use exr::meta::BlockDescription;
use exr::meta::header::Header;
use relight::XyzImage;
use spectra::{BandGrid, LightGroup, PixelContent, SpectralImage, Window};

use super::{Colors, Pixels, Plan, check_color_memory, check_memory, checked_plan, finish, pixels};
use crate::exr_file::digest::Progress;
use crate::exr_file::{self, Context, ReadExrError, digest, each_block, each_block_within};
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
    /// Number of rows of a block.
    block_rows: usize,
    light_groups: Vec<LightGroup>,
    metadata: Metadata,
    /// The digest of the blocks that have been read.
    progress: Option<Progress>,
}

/// Bytes of a strip that is read while colors are collected.
const STRIP_BYTES: usize = 64 << 20;

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
            block_rows: block_rows(&reader.headers()[plan.layer]),
            plan,
            light_groups: empty.light_groups().to_vec(),
            metadata,
            progress: Progress::of_headers(reader.headers()),
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

    /// What the pixels of the image hold.
    pub fn content(&self) -> PixelContent {
        self.plan.content()
    }

    /// The data of the file other than its pixels.
    pub fn metadata(&self) -> &Metadata {
        &self.metadata
    }

    /// The data of the file other than its pixels, when nothing more is read.
    pub fn into_metadata(self) -> Metadata {
        self.metadata
    }

    /// Reads these rows of the image, as an image of its width. The values are those that [`read`](super::read()) returns. Only parts
    /// of the file with such rows are read and decompressed, unless its table of contents is damaged. They are not compared with the
    /// file's digest, which is that of all pixels: [`Self::verify`] does so afterwards.
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

    /// Divides the image into strips from the top, each of at most `bytes` bytes as an image, but at least one block of the file high:
    /// no block is in two strips, so reading them one after the other decompresses each block once.
    pub fn strips(&self, bytes: usize) -> impl Iterator<Item = Range<u32>> + use<> {
        let [width, height] = self.size();
        let row = SpectralImage::bytes(width, 1, self.plan.content()).max(1);
        let rows = usize::try_from(bytes as u128 / row).unwrap_or(usize::MAX);
        let starts = self.plan.window.strips(rows, self.block_rows);
        let ends = self.plan.window.strips(rows, self.block_rows).skip(1);
        starts
            .zip(ends.chain([height]))
            .map(|(start, end)| start..end)
    }

    /// Checks that there is memory for the colors of the whole image, three floats per pixel.
    ///
    /// # Errors
    /// When there is none, or the file is far smaller than its picture.
    pub fn check_colors(&self) -> Result<(), ReadExrError> {
        check_color_memory(&self.path, &self.plan)
    }

    /// Reads the colors of the whole image without keeping its spectra, and compares the file's digest.
    ///
    /// # Errors
    /// When the pixels are damaged or missing, or memory for the colors is not available.
    pub fn read_xyz(&mut self) -> Result<XyzImage, ReadExrError> {
        self.check_colors()?;
        if !self.plan.has_xyz() {
            return self.summed_xyz();
        }
        let (context, plan) = (self.context(), &self.plan);
        let mut colors = Colors::new(plan);
        each_block(&context, self.reader()?, plan.layer, |block, channels| {
            colors.insert(plan, block, channels)
        })?;
        let missing = || context.damaged("some pixels are missing");
        colors.finish(plan).ok_or_else(missing)
    }

    /// Sums the colors of a file that has none from its bands.
    fn summed_xyz(&mut self) -> Result<XyzImage, ReadExrError> {
        let [width, height] = self.size();
        let mut xyz = Vec::with_capacity(width as usize * height as usize);
        for rows in self.strips(STRIP_BYTES) {
            xyz.extend_from_slice(self.read(rows)?.xyz());
        }
        self.verify()?;
        let missing = || self.context().damaged("some pixels are missing");
        XyzImage::new(width, height, xyz).ok_or_else(missing)
    }

    /// Compares the file's digest with its pixels. If all rows have been read from the first to the last, as [`Self::strips`] gives
    /// them, this is done at once; otherwise all of the file is read but nothing is kept. Returns false if the file has no digest.
    ///
    /// # Errors
    /// When the digest is another or the file cannot be read.
    pub fn verify(&mut self) -> Result<bool, ReadExrError> {
        let context = self.context();
        if let Some(progress) = &self.progress
            && progress.is_verified(&context)?
        {
            return Ok(true);
        }
        digest::verify(&context, self.reader()?, self.plan.layer)
    }

    fn read_by_table(&mut self, plan: Plan) -> Result<SpectralImage, ReadExrError> {
        let (reader, window) = (self.reader()?, plan.window);
        let context = Context { path: &self.path };
        let mut pixels = Pixels::new(plan);
        let (part, progress) = (self.plan.layer, self.progress.as_mut());
        each_block_within(
            &context,
            reader,
            part,
            &window,
            progress,
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

/// Number of rows of a block of a layer.
fn block_rows(header: &Header) -> usize {
    match header.blocks {
        BlockDescription::ScanLines => header.compression.scan_lines_per_block(),
        BlockDescription::Tiles(tiles) => tiles.tile_size.height(),
    }
}
