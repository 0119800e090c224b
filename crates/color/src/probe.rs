//! The mean values of a pixel or a region of a spectral image.

use std::ops::Range;

use spectra::{ImageLayer, LayerKey, Quantity, SpectralImage, Stokes, Values};
use thiserror::Error;

/// A rectangle of pixels.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub struct Region {
    /// Number of columns to the left of it.
    pub x: u32,
    /// Number of rows above it.
    pub y: u32,
    /// Width in pixels, at least 1.
    pub width: u32,
    /// Height in pixels, at least 1.
    pub height: u32,
}

impl Region {
    /// A single pixel.
    pub fn pixel(x: u32, y: u32) -> Self {
        let (width, height) = (1, 1);
        Self {
            x,
            y,
            width,
            height,
        }
    }

    /// A whole image.
    pub fn all_of(image: &SpectralImage) -> Self {
        let (width, height) = (image.width(), image.height());
        Self {
            x: 0,
            y: 0,
            width,
            height,
        }
    }

    /// The position of its center, in pixels from the left and the top.
    pub fn center(&self) -> [f64; 2] {
        let middle = |start: u32, size: u32| f64::from(start) + 0.5 * f64::from(size);
        [middle(self.x, self.width), middle(self.y, self.height)]
    }
}

/// Why a region is not one of an image.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum RegionError {
    /// It has no pixels.
    #[error("a region of {}×{} has no pixels", .0.width, .0.height)]
    Empty(Region),
    /// It extends beyond the image.
    #[error("{} lies outside the image of {width}×{height} pixels, which go from 0,0 to {},{}",
        described(.region), width.saturating_sub(1), height.saturating_sub(1))]
    Outside {
        /// The region.
        region: Region,
        /// Width of the image.
        width: u32,
        /// Height of the image.
        height: u32,
    },
}

fn described(region: &Region) -> String {
    let Region {
        x,
        y,
        width,
        height,
    } = region;
    match (width, height) {
        (1, 1) => format!("pixel {x},{y}"),
        _ => format!("the region {x},{y},{width},{height}"),
    }
}

/// The means of a region.
#[derive(Clone, Debug, PartialEq)]
pub struct Probe {
    /// The region.
    pub region: Region,
    /// Mean radiance of each band.
    pub radiance: Vec<f64>,
    /// Standard deviation of that mean due to the noise of the pixels; `None` if no pixel has a variance.
    pub deviation: Option<Vec<f64>>,
    /// Mean XYZ, cd/m² up to the scene's scale.
    pub xyz: [f64; 3],
    /// The part of each of the image's light groups in radiance and XYZ, in the order of the groups.
    pub light_groups: Vec<GroupProbe>,
    /// Means of S1, S2 and S3, if the image is polarized.
    pub polarized: Option<[GroupProbe; 3]>,
    /// Number of samples of all its pixels.
    pub samples: u64,
    /// Number of pixels left out because one of their values is not finite.
    pub left_out: u64,
}

/// The light of one light group, or a component of the Stokes vector.
#[derive(Clone, Debug, PartialEq)]
pub struct GroupProbe {
    /// Mean radiance of each band.
    pub radiance: Vec<f64>,
    /// Mean XYZ.
    pub xyz: [f64; 3],
}

impl Probe {
    /// The mean Stokes vector of a band, if the image is polarized.
    ///
    /// # Panics
    /// When there is no such band.
    pub fn stokes(&self, band: usize) -> Option<[f64; 4]> {
        let of = self.polarized.as_ref()?;
        let [s1, s2, s3] = of.each_ref().map(|component| component.radiance[band]);
        Some([self.radiance[band], s1, s2, s3])
    }

    /// The mean Stokes vector of the luminance, Y of the XYZ of each component, if the image is polarized.
    pub fn stokes_of_luminance(&self) -> Option<[f64; 4]> {
        let of = self.polarized.as_ref()?;
        let [s1, s2, s3] = of.each_ref().map(|component| component.xyz[1]);
        Some([self.xyz[1], s1, s2, s3])
    }
}

/// Returns the means of a region; they are NaN if no pixel of the region is finite.
///
/// # Errors
/// When the region is empty or extends beyond the image.
pub fn probe(image: &SpectralImage, region: Region) -> Result<Probe, RegionError> {
    let mut probing = Probing::new([image.width(), image.height()], region)?;
    probing.add(image, 0);
    Ok(probing.finish())
}

/// A [`probe()`] of an image that comes in strips of rows, from the top. The means are those of the whole image to the last bit.
#[derive(Clone, Debug)]
pub struct Probing {
    region: Region,
    sums: Option<Sums>,
}

impl Probing {
    /// Starts without any rows of an image of this width and height.
    ///
    /// # Errors
    /// When the region is empty or extends beyond the image.
    pub fn new([width, height]: [u32; 2], region: Region) -> Result<Self, RegionError> {
        if region.width == 0 || region.height == 0 {
            return Err(RegionError::Empty(region));
        }
        let reaches =
            |start: u32, size: u32, end: u32| start.checked_add(size).is_none_or(|e| e > end);
        if reaches(region.x, region.width, width) || reaches(region.y, region.height, height) {
            return Err(RegionError::Outside {
                region,
                width,
                height,
            });
        }
        Ok(Self { region, sums: None })
    }

    /// Returns those of some rows of the image that the region needs; an empty range if it needs none.
    pub fn rows_within(&self, rows: &Range<u32>) -> Range<u32> {
        let (top, bottom) = (self.region.y, self.region.y + self.region.height);
        let start = rows.start.max(top).min(rows.end);
        start..rows.end.min(bottom).max(start)
    }

    /// Adds a strip of the image, whose first row is row `top` of the image. Rows that the region does not need are left out.
    pub fn add(&mut self, strip: &SpectralImage, top: u32) {
        let rows = self.rows_within(&(top..top.saturating_add(strip.height())));
        let region = self.region;
        let sums = self.sums.get_or_insert_with(|| Sums::new(strip));
        for y in rows {
            let row = (y - top) as usize * strip.width() as usize;
            for x in region.x..region.x + region.width {
                sums.add(strip, row + x as usize);
            }
        }
    }

    /// Returns the means of the region, after all rows that it needs. Without any strip there are no bands.
    pub fn finish(self) -> Probe {
        let sums = self.sums.unwrap_or_default();
        sums.means(self.region)
    }
}

/// Sums over pixels of the values of each layer of an image.
#[derive(Clone, Debug, Default)]
struct Sums {
    layers: Vec<(LayerKey, Vec<f64>)>,
    /// The radiance and the XYZ of each light group.
    light_groups: Vec<[LayerKey; 2]>,
    count: u64,
    left_out: u64,
}

impl Sums {
    fn new(image: &SpectralImage) -> Self {
        let zeros = |layer: &ImageLayer| (layer.key(), vec![0.0; layer.values_per_pixel()]);
        Self {
            layers: image.layers().iter().map(zeros).collect(),
            light_groups: (0..image.light_groups().len())
                .map(|group| [Quantity::Radiance, Quantity::Xyz].map(|q| image.key_of(q, group)))
                .collect(),
            count: 0,
            left_out: 0,
        }
    }

    fn add(&mut self, image: &SpectralImage, pixel: usize) {
        let bands = image.bands().count() as usize;
        let radiance = &image.radiance()[pixel * bands..(pixel + 1) * bands];
        let xyz = &image.xyz()[pixel];
        if !radiance.iter().chain(xyz).all(|v| v.is_finite()) {
            self.left_out += 1;
            return;
        }
        self.count += 1;
        for ((_, sums), layer) in self.layers.iter_mut().zip(image.layers()) {
            let own = layer.values_of(pixel);
            match layer.values() {
                Values::Floats(values) => add(sums, &values[own]),
                Values::Counts(values) => add(sums, &values[own]),
            }
        }
    }

    fn of(&self, key: LayerKey) -> &[f64] {
        let found = self.layers.iter().find(|(own, _)| *own == key);
        found.map_or(&[], |(_, sums)| sums)
    }

    fn means(&self, region: Region) -> Probe {
        let count = self.count as f64;
        let mean = |key| self.of(key).iter().map(|sum| sum / count);
        let mean_xyz = |key| {
            let mut mean = mean(key);
            std::array::from_fn(|_| mean.next().unwrap_or(0.0))
        };
        let variance = self.of(LayerKey::VARIANCE);
        let knows_noise = variance.iter().any(|&v| v > 0.0);
        let deviation = |variance: &f64| variance.sqrt() / count;
        let of_light = |&[radiance, xyz]: &[LayerKey; 2]| GroupProbe {
            radiance: mean(radiance).collect(),
            xyz: mean_xyz(xyz),
        };
        let is_polarized = Stokes::POLARIZED.iter().all(|stokes| {
            let key = LayerKey::RADIANCE.component(*stokes);
            !self.of(key).is_empty()
        });
        Probe {
            region,
            deviation: knows_noise.then(|| variance.iter().map(deviation).collect()),
            radiance: mean(LayerKey::RADIANCE).collect(),
            xyz: mean_xyz(LayerKey::XYZ),
            light_groups: self.light_groups.iter().map(of_light).collect(),
            polarized: is_polarized.then(|| {
                Stokes::POLARIZED.map(|stokes| {
                    let totals = [LayerKey::RADIANCE, LayerKey::XYZ];
                    of_light(&totals.map(|key| key.component(stokes)))
                })
            }),
            // Sums of counts are exact up to 2⁵³.
            samples: self.of(LayerKey::SAMPLES).iter().sum::<f64>() as u64,
            left_out: self.left_out,
        }
    }
}

fn add<T: Copy + Into<f64>>(sums: &mut [f64], values: &[T]) {
    for (sum, &value) in sums.iter_mut().zip(values) {
        *sum += value.into();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use spectra::{BandGrid, LightGroup};

    fn image() -> SpectralImage {
        let mut image = SpectralImage::new(3, 2, BandGrid::visible(2).unwrap());
        for y in 0..2 {
            for x in 0..3 {
                let value = (10 * y + x) as f32;
                let xyz = [value, 2.0 * value, 0.0];
                image.set_pixel((x, y), &[value, 1.0], &[0.04, 0.01], xyz, 8);
            }
        }
        image
    }

    #[test]
    fn a_pixel_is_itself() {
        let found = probe(&image(), Region::pixel(2, 1)).unwrap();
        assert_eq!(found.radiance, [12.0, 1.0]);
        assert_eq!((found.xyz, found.samples), ([12.0, 24.0, 0.0], 8));
        let deviation = found.deviation.unwrap();
        assert!((deviation[0] - 0.2).abs() < 1e-6 && (deviation[1] - 0.1).abs() < 1e-6);
    }

    #[test]
    fn a_region_is_its_mean_with_less_noise() {
        let region = Region {
            x: 1,
            y: 0,
            width: 2,
            height: 2,
        };
        let found = probe(&image(), region).unwrap();
        assert_eq!(found.radiance, [6.5, 1.0]);
        assert_eq!((found.samples, found.left_out), (32, 0));
        assert!((found.deviation.unwrap()[0] - 0.1).abs() < 1e-6);
        assert_eq!(region.center(), [2.0, 1.0]);
    }

    #[test]
    fn light_groups_are_distinguished() {
        let group = |name: &str| LightGroup {
            name: name.to_owned(),
            lamp: None,
        };
        let grid = BandGrid::visible(2).unwrap();
        let groups = vec![group("key"), group("sky")];
        let mut image = SpectralImage::with_light_groups(2, 1, grid, groups);
        for x in 0..2 {
            let both = [x as f32, 1.0, 4.0, 5.0];
            image.set_pixel_by_light((x, 0), &both, &[0.1; 2], &[[1.0; 3], [3.0; 3]], 4);
        }
        let found = probe(&image, Region::all_of(&image)).unwrap();
        assert_eq!(found.light_groups[0].radiance, [0.5, 1.0]);
        assert_eq!(found.light_groups[1].radiance, [4.0, 5.0]);
        assert_eq!((found.light_groups[1].xyz, found.xyz), ([3.0; 3], [4.0; 3]));
        assert_eq!(found.radiance, [4.5, 6.0]);
    }

    #[test]
    fn components_are_averaged_too() {
        let mut image = image().with_polarization();
        assert_eq!(
            probe(&super::tests::image(), Region::pixel(0, 0))
                .unwrap()
                .polarized,
            None
        );
        for (stokes, value) in Stokes::POLARIZED.into_iter().zip([1.0, -2.0, 3.0]) {
            for x in 0..2 {
                let values = [value + x as f32, 0.5];
                image.set_component_by_light((x, 1), stokes, &values, &[[value; 3]]);
            }
        }
        let region = Region {
            x: 0,
            y: 1,
            width: 2,
            height: 1,
        };
        let found = probe(&image, region).unwrap();
        assert_eq!(found.stokes(0), Some([10.5, 1.5, -1.5, 3.5]));
        assert_eq!(found.stokes(1), Some([1.0, 0.5, 0.5, 0.5]));
        assert_eq!(found.stokes_of_luminance(), Some([21.0, 1.0, -2.0, 3.0]));
    }

    #[test]
    fn what_is_not_a_number_is_left_out() {
        let mut image = image();
        image.set_pixel((0, 0), &[f32::NAN, 1.0], &[0.0; 2], [1.0; 3], 8);
        let found = probe(&image, Region::all_of(&image)).unwrap();
        assert_eq!((found.left_out, found.radiance[0]), (1, 36.0 / 5.0));
    }

    #[test]
    fn strips_have_the_means_of_the_whole() {
        let whole = image();
        let strip = |y: u32| {
            let mut strip = SpectralImage::new(3, 1, *whole.bands());
            for x in 0..3 {
                let index = (3 * y + x) as usize;
                let (xyz, samples) = (whole.xyz()[index], whole.samples()[index]);
                strip.set_pixel((x, 0), whole.pixel(x, y), &[0.04, 0.01], xyz, samples);
            }
            strip
        };
        let lower = Region {
            x: 1,
            y: 1,
            width: 2,
            height: 1,
        };
        for region in [Region::all_of(&whole), Region::pixel(2, 0), lower] {
            let mut probing = Probing::new([3, 2], region).unwrap();
            for y in 0..2 {
                probing.add(&strip(y), y);
            }
            assert_eq!(probing.finish(), probe(&whole, region).unwrap());
        }
        let probing = Probing::new([3, 2], lower).unwrap();
        assert_eq!(probing.rows_within(&(0..2)), 1..2);
        assert!(probing.rows_within(&(0..1)).is_empty() && probing.rows_within(&(2..9)).is_empty());
    }

    #[test]
    fn regions_end_where_the_image_does() {
        let of = |x, y, width, height| {
            let region = Region {
                x,
                y,
                width,
                height,
            };
            probe(&image(), region).map_err(|error| error.to_string())
        };
        assert!(of(0, 0, 3, 2).is_ok());
        assert_eq!(
            of(3, 0, 1, 1).unwrap_err(),
            "pixel 3,0 lies outside the image of 3×2 pixels, which go from 0,0 to 2,1"
        );
        assert!(of(0, 0, 3, 3).unwrap_err().contains("the region 0,0,3,3"));
        assert!(of(0, 0, 0, 1).unwrap_err().contains("no pixels"));
        assert!(of(1, 0, u32::MAX, 1).is_err());
    }
}
