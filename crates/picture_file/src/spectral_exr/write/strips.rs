//! Rows of an image that arrive in strips from the top.

use std::borrow::Borrow;
use std::path::Path;

use spectra::{BandGrid, ImageLayer, LayerKey, LightGroup, SpectralImage, Window};

use super::{WriteExrError, WriteRowsError};
use crate::spectral_exr::lights;

/// The strips of a window that are still to come.
pub(super) struct Strips<'a, S, E> {
    path: &'a Path,
    window: Window,
    source: &'a mut dyn FnMut() -> Result<Option<S>, E>,
    /// What the first strip holds.
    form: Form,
    /// Number of rows so far.
    rows: u32,
}

/// What all strips have in common.
#[derive(PartialEq)]
struct Form {
    bands: BandGrid,
    light_groups: Vec<LightGroup>,
    layers: Vec<LayerKey>,
}

impl Form {
    fn of(image: &SpectralImage) -> Self {
        let layers = image.layers().iter();
        Self {
            bands: *image.bands(),
            light_groups: image.light_groups().to_vec(),
            layers: layers.map(ImageLayer::key).collect(),
        }
    }
}

impl<'a, S: Borrow<SpectralImage>, E> Strips<'a, S, E> {
    /// Takes the first strip.
    pub(super) fn start(
        path: &'a Path,
        window: Window,
        source: &'a mut dyn FnMut() -> Result<Option<S>, E>,
    ) -> Result<(S, Self), WriteRowsError<E>> {
        let Some(first) = source().map_err(WriteRowsError::Source)? else {
            return Err(rows_error(path, "there are no rows".to_owned()).into());
        };
        let image: &SpectralImage = first.borrow();
        if let Some(name) = lights::bad_name(image.light_groups()) {
            return Err(WriteRowsError::Write(WriteExrError::LightGroup {
                path: path.to_owned(),
                name: name.to_owned(),
            }));
        }
        let mut strips = Self {
            path,
            window,
            source,
            form: Form::of(image),
            rows: 0,
        };
        strips.count(image)?;
        Ok((first, strips))
    }

    /// The file that is written.
    pub(super) fn path(&self) -> &'a Path {
        self.path
    }

    /// Takes the next strip; `None` after the last row.
    pub(super) fn next(&mut self) -> Result<Option<S>, WriteRowsError<E>> {
        let strip = (self.source)().map_err(WriteRowsError::Source)?;
        match &strip {
            Some(image) => self.count(image.borrow())?,
            None => self.check_end()?,
        }
        Ok(strip)
    }

    /// Adds a strip, if it fits below the others.
    fn count(&mut self, image: &SpectralImage) -> Result<(), WriteExrError> {
        let [width, height] = self.window.size;
        if image.width() != width {
            let reason = format!(
                "its rows have {} pixels, and one of its strips has {}",
                width,
                image.width()
            );
            return Err(rows_error(self.path, reason));
        }
        if Form::of(image) != self.form {
            let reason = "its strips do not have the same bands, light groups and layers";
            return Err(rows_error(self.path, reason.to_owned()));
        }
        let rows = self.rows.checked_add(image.height());
        let Some(rows) = rows.filter(|&rows| rows <= height) else {
            let reason = format!("its strips have more than its {height} rows");
            return Err(rows_error(self.path, reason));
        };
        self.rows = rows;
        Ok(())
    }

    fn check_end(&self) -> Result<(), WriteExrError> {
        let (rows, height) = (self.rows, self.window.size[1]);
        if rows == height {
            return Ok(());
        }
        let reason = format!("its strips end after {rows} of its {height} rows");
        Err(rows_error(self.path, reason))
    }
}

fn rows_error(path: &Path, reason: String) -> WriteExrError {
    WriteExrError::Rows {
        path: path.to_owned(),
        reason,
    }
}
