//! Statistics of the samples of a pixel.

use super::SpectralPath;
use crate::bands::{At, Spectrum, Tables};
use optics::wide::Real;
use pulp::{Arch, Simd, WithSimd};
use spectra::KM_LUMENS_PER_WATT;

/// The running means of a pixel's samples, and the sum of squared deviations of the light of all groups together (Welford 1962).
pub(crate) struct Pixel<'a> {
    arch: Arch,
    tables: &'a Tables,
    count: u32,
    mean: Spectrum,
    deviation: Spectrum,
    /// Means of each light group; empty where there is only one.
    group_means: Vec<Spectrum>,
    /// For each light group, the sums of radiance times the observer's functions.
    xyz: Vec<[Spectrum; 3]>,
}

/// The values of pixels one after the other, in the layout of a `SpectralImage`.
#[derive(Default)]
pub(crate) struct PixelValues {
    /// Mean radiance, `[pixel][light group][band]`.
    pub(crate) radiance: Vec<f32>,
    /// Variance of the mean of the light of all groups, `[pixel][band]`.
    pub(crate) variance: Vec<f32>,
    /// Mean XYZ, `[pixel][light group]`.
    pub(crate) xyz: Vec<[f32; 3]>,
}

impl<'a> Pixel<'a> {
    pub(crate) fn new(arch: Arch, tables: &'a Tables, light_groups: usize) -> Self {
        let zero = Spectrum::zero(tables.chunks());
        let several = if light_groups > 1 { light_groups } else { 0 };
        Self {
            arch,
            tables,
            count: 0,
            mean: zero.clone(),
            deviation: zero.clone(),
            group_means: vec![zero.clone(); several],
            xyz: vec![std::array::from_fn(|_| zero.clone()); light_groups],
        }
    }

    /// Begins the next pixel.
    pub(crate) fn clear(&mut self) {
        self.count = 0;
        let own = [&mut self.mean, &mut self.deviation].into_iter();
        let of_groups = self
            .group_means
            .iter_mut()
            .chain(self.xyz.as_flattened_mut());
        own.chain(of_groups).for_each(|spectrum| spectrum.fill(0.0));
    }

    /// Adds a sample.
    pub(crate) fn add(&mut self, path: &SpectralPath<'a>) {
        self.count += 1;
        self.arch.dispatch(Add(self, path));
    }

    /// Appends the pixel to the values.
    pub(crate) fn write(&self, values: &mut PixelValues) {
        let (bands, n) = (self.tables.bands(), f64::from(self.count));
        let to_variance = if n > 1.0 { 1.0 / (n * (n - 1.0)) } else { 0.0 };
        let to_xyz = KM_LUMENS_PER_WATT * self.tables.grid().width_nm() / n;
        let means = if self.group_means.is_empty() {
            std::slice::from_ref(&self.mean)
        } else {
            &self.group_means
        };
        for mean in means {
            let mean = mean.values()[..bands].iter();
            values.radiance.extend(mean.map(|&v| v as f32));
        }
        let deviation = self.deviation.values()[..bands].iter();
        values
            .variance
            .extend(deviation.map(|&v| (v * to_variance) as f32));
        let sum = |spectrum: &Spectrum| spectrum.values()[..bands].iter().sum::<f64>();
        let xyz = self
            .xyz
            .iter()
            .map(|xyz| xyz.each_ref().map(|of| (sum(of) * to_xyz) as f32));
        values.xyz.extend(xyz);
    }
}

struct Add<'b, 'a>(&'b mut Pixel<'a>, &'b SpectralPath<'a>);

impl WithSimd for Add<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self(pixel, path) = self;
        let bands = path.bands(simd);
        let over = bands.splat(1.0 / f64::from(pixel.count));
        let count = bands.chunks().len();
        let mean = &mut pixel.mean.0[..count];
        let deviation = &mut pixel.deviation.0[..count];
        for chunk in bands.chunks() {
            for at in At::lanes::<S>(chunk) {
                let mut total = bands.splat(0.0);
                for radiance in &path.radiance {
                    total = total + at.load(simd, &radiance.0);
                }
                let before = total - at.load(simd, mean);
                let mean_now = before.mul_add(over, at.load(simd, mean));
                let sum = before.mul_add(total - mean_now, at.load(simd, deviation));
                at.store(mean_now, mean);
                at.store(sum, deviation);
            }
        }
        for (radiance, mean) in path.radiance.iter().zip(&mut pixel.group_means) {
            let (radiance, mean) = (&radiance.0[..count], &mut mean.0[..count]);
            for chunk in bands.chunks() {
                for at in At::lanes::<S>(chunk) {
                    let before = at.load(simd, radiance) - at.load(simd, mean);
                    at.store(before.mul_add(over, at.load(simd, mean)), mean);
                }
            }
        }
        let [x_bar, y_bar, z_bar] = pixel.tables.observer();
        let (x_bar, y_bar) = (bands.knots(x_bar), bands.knots(y_bar));
        let z_bar = bands.knots(z_bar);
        for (radiance, [x, y, z]) in path.radiance.iter().zip(&mut pixel.xyz) {
            let radiance = &radiance.0[..count];
            let (x, y, z) = (&mut x.0[..count], &mut y.0[..count], &mut z.0[..count]);
            for chunk in bands.chunks() {
                for at in At::lanes::<S>(chunk) {
                    let value = at.load(simd, radiance);
                    at.store(value.mul_add(x_bar.value(&bands, at), at.load(simd, x)), x);
                    at.store(value.mul_add(y_bar.value(&bands, at), at.load(simd, y)), y);
                    at.store(value.mul_add(z_bar.value(&bands, at), at.load(simd, z)), z);
                }
            }
        }
    }
}
