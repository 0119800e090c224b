//! What developing needs of an image, read in strips: the image itself may be larger than memory.

use crate::image_file;
use miette::{IntoDiagnostic, WrapErr, miette};
use pellicle::color::develop::{LampLuminances, Latent, SceneWhite};
use pellicle::picture_file::spectral_exr::RowReader;
use pellicle::relight::XyzImage;
use pellicle::spectra::{BandGrid, Observer, SpectralImage};
use std::path::Path;

/// The colors of an image, and its bands if a glare needs them.
pub(super) struct Negative {
    colors: XyzImage,
    bands: Option<(BandGrid, Vec<f32>)>,
    /// The white of its brightest lamp.
    pub(super) lamp: Option<SceneWhite>,
}

/// Puts an image, or a strip of it, in another light.
pub(super) type Light<'a> = dyn Fn(&mut SpectralImage) -> miette::Result<()> + 'a;

/// What is kept while strips are read.
struct Keeping {
    /// The image without its rows.
    empty: SpectralImage,
    xyz: Vec<[f32; 3]>,
    radiance: Option<Vec<f32>>,
    luminances: LampLuminances,
}

impl Negative {
    pub(super) fn of_colors(colors: XyzImage) -> Self {
        Self {
            colors,
            bands: None,
            lamp: None,
        }
    }

    /// Reads a file in one pass, in each of these lights as `observer` sees it.
    pub(super) fn in_lights(
        path: &Path,
        rows: &mut RowReader,
        lights: &[&Light<'_>],
        observer: Observer,
        keeps_bands: bool,
    ) -> miette::Result<Vec<Self>> {
        rows.check_colors().into_diagnostic()?;
        let keeping = lights
            .iter()
            .map(|light| Keeping::new(rows, light, keeps_bands));
        let mut keeping: Vec<Keeping> = keeping.collect::<Result<_, _>>()?;
        for strip in rows.strips(image_file::STRIP_BYTES) {
            let strip = image_file::strip(path, rows, strip)?;
            let Some(((last, before), (last_light, lights))) =
                keeping.split_last_mut().zip(lights.split_last())
            else {
                break;
            };
            for (keeping, light) in before.iter_mut().zip(lights) {
                keeping.add(strip.clone(), light)?;
            }
            last.add(strip, last_light)?;
        }
        image_file::verify(path, rows)?;
        let size = rows.size();
        let finished = keeping.into_iter();
        finished
            .map(|keeping| keeping.finish(size, observer))
            .collect()
    }

    /// Height in pixels.
    pub(super) fn height(&self) -> u32 {
        self.colors.height()
    }
}

impl Keeping {
    /// Starts without rows. A light that cannot be had is reported before rows are read.
    fn new(rows: &RowReader, light: &Light<'_>, keeps_bands: bool) -> miette::Result<Self> {
        let [width, height] = rows.size();
        let (grid, groups) = (*rows.bands(), rows.light_groups().to_vec());
        let mut empty = SpectralImage::with_light_groups(width, 0, grid, groups);
        if rows.content().is_polarized {
            empty = empty.with_polarization();
        }
        light(&mut empty)?;
        let pixels = width as usize * height as usize;
        let mut radiance = Vec::new();
        if keeps_bands {
            radiance
                .try_reserve_exact(pixels.saturating_mul(grid.count() as usize))
                .into_diagnostic()
                .wrap_err("there is no memory for the bands that the glare of this eye needs")?;
        }
        Ok(Self {
            empty,
            xyz: Vec::with_capacity(pixels),
            radiance: keeps_bands.then_some(radiance),
            luminances: LampLuminances::default(),
        })
    }

    fn add(&mut self, mut strip: SpectralImage, light: &Light<'_>) -> miette::Result<()> {
        light(&mut strip)?;
        self.luminances.add(&strip);
        self.xyz.extend_from_slice(strip.xyz());
        if let Some(radiance) = &mut self.radiance {
            radiance.extend_from_slice(strip.radiance());
        }
        Ok(())
    }

    fn finish(self, [width, height]: [u32; 2], observer: Observer) -> miette::Result<Negative> {
        let colors = XyzImage::new(width, height, self.xyz);
        let grid = *self.empty.bands();
        Ok(Negative {
            colors: colors.ok_or_else(|| miette!("the strips do not make up the image"))?,
            bands: self.radiance.map(|radiance| (grid, radiance)),
            lamp: self.luminances.white(&self.empty, observer),
        })
    }
}

impl<'a> From<&'a Negative> for Latent<'a> {
    fn from(negative: &'a Negative) -> Self {
        let latent = Latent::from(&negative.colors);
        match &negative.bands {
            Some((grid, radiance)) => latent.with_bands(grid, radiance),
            None => latent,
        }
    }
}
