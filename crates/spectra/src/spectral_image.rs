//! The output of a renderer: radiance per pixel and band.

use crate::{BandGrid, LightGroup};

/// Radiance per pixel and band, with variance and XYZ, in total and by light group.
///
/// Row 0 is at the top. Per-band data is pixel-major: the value of band `b` at (x, y) has the index
/// `(y·width + x)·bands + b`.
#[derive(Clone, Debug, PartialEq)]
pub struct SpectralImage {
    width: u32,
    height: u32,
    bands: BandGrid,
    radiance: Vec<f32>,
    variance: Vec<f32>,
    xyz: Vec<[f32; 3]>,
    samples: Vec<u32>,
    light_groups: Vec<LightGroup>,
    /// The contribution of each light group; empty if there is only one, which equals the total.
    shares: Vec<Share>,
}

/// The contribution of one of several light groups.
#[derive(Clone, Debug, PartialEq)]
struct Share {
    radiance: Vec<f32>,
    xyz: Vec<[f32; 3]>,
}

/// One row of an image, mutably borrowed.
#[derive(Debug)]
pub struct RowMut<'a> {
    /// As [`SpectralImage::radiance`].
    pub radiance: &'a mut [f32],
    /// As [`SpectralImage::variance`].
    pub variance: &'a mut [f32],
    /// As [`SpectralImage::xyz`].
    pub xyz: &'a mut [[f32; 3]],
    /// Radiance and XYZ of each light group; empty if there is only one, which equals the total.
    pub shares: Vec<(&'a mut [f32], &'a mut [[f32; 3]])>,
}

impl SpectralImage {
    /// Creates a black image without samples, with a single light group whose illuminant is unknown.
    pub fn new(width: u32, height: u32, bands: BandGrid) -> Self {
        Self::with_light_groups(width, height, bands, vec![LightGroup::unknown()])
    }

    /// Creates a black image without samples.
    ///
    /// # Panics
    /// When `light_groups` is empty.
    pub fn with_light_groups(
        width: u32,
        height: u32,
        bands: BandGrid,
        light_groups: Vec<LightGroup>,
    ) -> Self {
        assert!(!light_groups.is_empty(), "an image has a light group");
        let pixels = width as usize * height as usize;
        let values = pixels * bands.count() as usize;
        let kept = kept_shares(light_groups.len());
        let share = || Share {
            radiance: vec![0.0; values],
            xyz: vec![[0.0; 3]; pixels],
        };
        Self {
            width,
            height,
            bands,
            radiance: vec![0.0; values],
            variance: vec![0.0; values],
            xyz: vec![[0.0; 3]; pixels],
            samples: vec![0; pixels],
            shares: (0..kept).map(|_| share()).collect(),
            light_groups,
        }
    }

    /// Bytes of memory that an image of this size takes.
    pub fn bytes(width: u32, height: u32, bands: u32, light_groups: usize) -> u128 {
        let radiance_and_xyz = u128::from(bands) * 4 + 12;
        let variance_and_samples = u128::from(bands) * 4 + 4;
        let kept = 1 + kept_shares(light_groups) as u128;
        u128::from(width) * u128::from(height) * (kept * radiance_and_xyz + variance_and_samples)
    }

    /// Width in pixels.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Height in pixels.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// The bands of each pixel.
    pub fn bands(&self) -> &BandGrid {
        &self.bands
    }

    /// Mean radiance over each band, W m⁻² sr⁻¹ nm⁻¹ up to the scale of the scene; pixel-major.
    pub fn radiance(&self) -> &[f32] {
        &self.radiance
    }

    /// Variance of the mean for each value of [`Self::radiance`]; 0 if fewer than two samples were taken.
    pub fn variance(&self) -> &[f32] {
        &self.variance
    }

    /// CIE 1931 2° XYZ of each pixel, summed at the exact wavelengths sampled: Y in cd/m² up to the scale of the scene.
    pub fn xyz(&self) -> &[[f32; 3]] {
        &self.xyz
    }

    /// Number of samples of each pixel.
    pub fn samples(&self) -> &[u32] {
        &self.samples
    }

    /// The spectrum of pixel (x, y), one value per band.
    ///
    /// # Panics
    /// When the pixel lies outside the image.
    pub fn pixel(&self, x: u32, y: u32) -> &[f32] {
        &self.radiance[self.values_of(x, y)]
    }

    /// The light groups, at least one. Their radiances add up to the total.
    pub fn light_groups(&self) -> &[LightGroup] {
        &self.light_groups
    }

    /// Radiance due to the emitters of a group; otherwise as [`Self::radiance`].
    ///
    /// # Panics
    /// When there is no such light group.
    pub fn group_radiance(&self, light_group: usize) -> &[f32] {
        match &self.shares[..] {
            [] if light_group == 0 => &self.radiance,
            shares => &shares[light_group].radiance,
        }
    }

    /// XYZ due to the emitters of a group; otherwise as [`Self::xyz`].
    ///
    /// # Panics
    /// When there is no such light group.
    pub fn group_xyz(&self, light_group: usize) -> &[[f32; 3]] {
        match &self.shares[..] {
            [] if light_group == 0 => &self.xyz,
            shares => &shares[light_group].xyz,
        }
    }

    /// Writes pixel (x, y) of an image with one light group: the mean and the variance of the mean per band, XYZ and
    /// sample count.
    ///
    /// # Panics
    /// When the pixel lies outside the image, a slice does not have one value per band, or there are several light groups.
    pub fn set_pixel(
        &mut self,
        at: (u32, u32),
        radiance: &[f32],
        variance: &[f32],
        xyz: [f32; 3],
        samples: u32,
    ) {
        self.set_pixel_by_light(at, radiance, variance, &[xyz], samples);
    }

    /// Writes pixel (x, y): the mean radiance as `[light group][band]`, the variance of the mean of the total per band, XYZ
    /// of each light group, and the sample count. The totals are the sums over the light groups in their order.
    ///
    /// # Panics
    /// When the pixel lies outside the image, or a slice has the wrong length.
    pub fn set_pixel_by_light(
        &mut self,
        (x, y): (u32, u32),
        radiance: &[f32],
        variance: &[f32],
        xyz: &[[f32; 3]],
        samples: u32,
    ) {
        let groups = self.light_groups.len();
        let bands = self.bands.count() as usize;
        assert_eq!(radiance.len(), groups * bands, "one value per band");
        assert_eq!(xyz.len(), groups, "one color per light group");
        let (values, pixel) = (self.values_of(x, y), self.pixel_index(x, y));
        let total = &mut self.radiance[values.clone()];
        total.copy_from_slice(&radiance[..bands]);
        for more in radiance[bands..].chunks_exact(bands) {
            for (sum, value) in total.iter_mut().zip(more) {
                *sum += value;
            }
        }
        let more = xyz[1..].iter();
        self.xyz[pixel] = more.fold(xyz[0], |sum, more| {
            std::array::from_fn(|i| sum[i] + more[i])
        });
        self.variance[values.clone()].copy_from_slice(variance);
        self.samples[pixel] = samples;
        for (group, share) in self.shares.iter_mut().enumerate() {
            let own = &radiance[group * bands..(group + 1) * bands];
            share.radiance[values.clone()].copy_from_slice(own);
            share.xyz[pixel] = xyz[group];
        }
    }

    /// A light group, to be changed together with the values of [`Self::rows_mut`].
    ///
    /// # Panics
    /// When there is no such light group.
    pub fn light_group_mut(&mut self, light_group: usize) -> &mut LightGroup {
        &mut self.light_groups[light_group]
    }

    /// All rows from the top, to be changed independently. A caller that changes `shares` must keep their sum equal to the total.
    pub fn rows_mut(&mut self) -> Vec<RowMut<'_>> {
        let width = (self.width as usize).max(1);
        let values = width * self.bands.count() as usize;
        let radiance = self.radiance.chunks_mut(values);
        let others = self
            .variance
            .chunks_mut(values)
            .zip(self.xyz.chunks_mut(width));
        let mut rows: Vec<_> = radiance
            .zip(others)
            .map(|(radiance, (variance, xyz))| RowMut {
                radiance,
                variance,
                xyz,
                shares: Vec::new(),
            })
            .collect();
        for share in &mut self.shares {
            let radiance = share.radiance.chunks_mut(values);
            let own = radiance.zip(share.xyz.chunks_mut(width));
            for (row, own) in rows.iter_mut().zip(own) {
                row.shares.push(own);
            }
        }
        rows
    }

    fn pixel_index(&self, x: u32, y: u32) -> usize {
        assert!(
            x < self.width && y < self.height,
            "pixel ({x}, {y}) lies outside the image of {}×{}",
            self.width,
            self.height
        );
        y as usize * self.width as usize + x as usize
    }

    fn values_of(&self, x: u32, y: u32) -> std::ops::Range<usize> {
        let bands = self.bands.count() as usize;
        let start = self.pixel_index(x, y) * bands;
        start..start + bands
    }
}

/// Number of light groups that are stored in addition to the total: 0 if there is only one.
fn kept_shares(light_groups: usize) -> usize {
    if light_groups > 1 { light_groups } else { 0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image(names: &[&str]) -> SpectralImage {
        let group = |name: &&str| LightGroup {
            name: (*name).to_owned(),
            lamp: None,
        };
        let groups = names.iter().map(group).collect();
        SpectralImage::with_light_groups(3, 2, BandGrid::visible(2).unwrap(), groups)
    }

    #[test]
    fn the_total_is_the_sum_of_the_light_groups() {
        let mut image = image(&["key", "sky"]);
        let xyz = [[1.0, 2.0, 3.0], [0.5, 0.25, 0.125]];
        image.set_pixel_by_light((2, 1), &[1.0, 2.0, 0.5, 4.0], &[0.1, 0.2], &xyz, 7);
        assert_eq!(image.pixel(2, 1), [1.5, 6.0]);
        assert_eq!(image.xyz()[5], [1.5, 2.25, 3.125]);
        assert_eq!(image.group_radiance(1)[10..], [0.5, 4.0]);
        assert_eq!(image.group_xyz(0)[5], xyz[0]);
        assert_eq!((image.variance()[11], image.samples()[5]), (0.2, 7));
        let rows = image.rows_mut();
        assert_eq!(rows.len(), 2);
        assert_eq!(rows[1].shares[1].0, [0.0, 0.0, 0.0, 0.0, 0.5, 4.0]);
    }

    #[test]
    fn one_light_group_is_the_total_and_is_kept_once() {
        let mut image = SpectralImage::new(3, 2, BandGrid::visible(2).unwrap());
        image.set_pixel((0, 0), &[1.0, -0.0], &[0.0; 2], [1.0; 3], 1);
        assert_eq!(image.group_radiance(0).as_ptr(), image.radiance().as_ptr());
        assert_eq!(image.group_xyz(0), image.xyz());
        assert!(image.shares.is_empty() && image.rows_mut()[0].shares.is_empty());
        assert_eq!(image.pixel(0, 0)[1].to_bits(), (-0.0_f32).to_bits());
    }

    #[test]
    fn the_bytes_are_those_of_the_lists() {
        for names in [&["a"][..], &["a", "b", "c"]] {
            let image = image(names);
            let of_share = |s: &Share| 4 * s.radiance.len() + 12 * s.xyz.len();
            let lists = 4 * (image.radiance.len() + image.variance.len() + image.samples.len())
                + 12 * image.xyz.len()
                + image.shares.iter().map(of_share).sum::<usize>();
            assert_eq!(SpectralImage::bytes(3, 2, 2, names.len()), lists as u128);
        }
    }
}
