//! Statistics of the samples of a pixel.

use super::Found;
use crate::bands::{At, Bands, Chunk, Knots, Spectrum, Tables};
use optics::wide::{Lanes, Real};
use pulp::{Arch, Simd, WithSimd};
use spectra::{PixelContent, Stokes, SumLayout};

/// The running means of a pixel's samples, and the sum of squared deviations of the light of all groups together (Welford 1962).
pub(crate) struct Pixel<'a> {
    arch: Arch,
    tables: &'a Tables,
    layout: SumLayout,
    count: u32,
    mean: Spectrum,
    deviation: Spectrum,
    /// Means of each light group; empty where there is only one.
    group_means: Vec<Spectrum>,
    /// For each light group, the mean of radiance times the observer's functions, summed over the bands.
    xyz: Vec<[f64; 3]>,
    /// For each light group, the means of S1, S2 and S3, and of these times the observer's functions; empty where they are not kept.
    polarized: Vec<[(Spectrum, [f64; 3]); 3]>,
}

impl<'a> Pixel<'a> {
    pub(crate) fn new(arch: Arch, tables: &'a Tables, content: PixelContent) -> Self {
        let light_groups = content.light_groups;
        let zero = Spectrum::zero(tables.chunks());
        let kept = if content.is_polarized {
            light_groups
        } else {
            0
        };
        let several = if light_groups > 1 { light_groups } else { 0 };
        Self {
            arch,
            tables,
            layout: SumLayout::new(content),
            count: 0,
            mean: zero.clone(),
            deviation: zero.clone(),
            group_means: vec![zero.clone(); several],
            xyz: vec![[0.0; 3]; light_groups],
            polarized: vec![std::array::from_fn(|_| (zero.clone(), [0.0; 3])); kept],
        }
    }

    /// Number of values of a pixel.
    pub(crate) fn len(&self) -> usize {
        self.layout.len()
    }

    /// Goes on with a pixel that has this number of samples. The padding of the last chunk begins at 0: nothing reads it.
    pub(crate) fn load(&mut self, values: &[f64], count: u32) {
        self.count = count;
        let (layout, bands) = (self.layout, self.tables.bands());
        let read = |spectrum: &mut Spectrum, from: &[f64]| {
            spectrum.values_mut()[..bands].copy_from_slice(from);
        };
        read(&mut self.mean, &values[layout.mean()]);
        read(&mut self.deviation, &values[layout.deviation()]);
        for (group, mean) in self.group_means.iter_mut().enumerate() {
            read(mean, &values[layout.group_mean(group)]);
        }
        for (group, xyz) in self.xyz.iter_mut().enumerate() {
            xyz.copy_from_slice(&values[layout.xyz(group)]);
        }
        for (group, components) in self.polarized.iter_mut().enumerate() {
            for (stokes, (mean, xyz)) in Stokes::POLARIZED.into_iter().zip(components) {
                read(mean, &values[layout.component(group, stokes)]);
                xyz.copy_from_slice(&values[layout.component_xyz(group, stokes)]);
            }
        }
    }

    /// Writes the pixel's values.
    pub(crate) fn save(&self, values: &mut [f64]) {
        let (layout, bands) = (self.layout, self.tables.bands());
        let mut write = |range: std::ops::Range<usize>, spectrum: &Spectrum| {
            values[range].copy_from_slice(&spectrum.values()[..bands]);
        };
        write(layout.mean(), &self.mean);
        write(layout.deviation(), &self.deviation);
        for (group, mean) in self.group_means.iter().enumerate() {
            write(layout.group_mean(group), mean);
        }
        for (group, xyz) in self.xyz.iter().enumerate() {
            values[layout.xyz(group)].copy_from_slice(xyz);
        }
        for (group, components) in self.polarized.iter().enumerate() {
            for (stokes, (mean, xyz)) in Stokes::POLARIZED.into_iter().zip(components) {
                let mean = &mean.values()[..bands];
                values[layout.component(group, stokes)].copy_from_slice(mean);
                values[layout.component_xyz(group, stokes)].copy_from_slice(xyz);
            }
        }
    }

    /// Adds a sample.
    pub(crate) fn add(&mut self, found: &Found<'_, 'a>) {
        self.count += 1;
        self.arch.dispatch(Add(self, found));
    }
}

struct Add<'c, 'b, 'a>(&'c mut Pixel<'a>, &'c Found<'b, 'a>);

impl WithSimd for Add<'_, '_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self(pixel, path) = self;
        let bands = path.wavelengths.bands(simd);
        let part = 1.0 / f64::from(pixel.count);
        let over = bands.splat(part);
        let count = bands.chunks().len();
        let mean = &mut pixel.mean.0[..count];
        let deviation = &mut pixel.deviation.0[..count];
        for chunk in bands.chunks() {
            for at in At::lanes::<S>(chunk) {
                let mut total = bands.splat(0.0);
                for radiance in path.radiance.iter() {
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
            advance(&bands, over, radiance, mean);
        }
        let observer = pixel.tables.observer().map(|row| bands.knots(row));
        for (radiance, mean) in path.radiance.iter().zip(&mut pixel.xyz) {
            advance_xyz(&bands, (&observer, part), radiance, mean);
        }
        let polarized = path.polarized.iter().zip(&mut pixel.polarized);
        for (of, to) in polarized {
            for (component, (mean, xyz)) in of.iter().zip(to) {
                advance(&bands, over, component, mean);
                advance_xyz(&bands, (&observer, part), component, xyz);
            }
        }
    }
}

/// Advances a mean by a value.
#[inline(always)]
fn advance<S: Simd>(bands: &Bands<'_, S>, over: Lanes<S>, value: &Spectrum, mean: &mut Spectrum) {
    for chunk in bands.chunks() {
        for at in At::lanes::<S>(chunk) {
            let so_far = bands.load(at, mean);
            let before = bands.load(at, value) - so_far;
            bands.store(at, before.mul_add(over, so_far), mean);
        }
    }
}

/// Advances the mean of a value times the observer's functions, summed over the bands.
#[inline(always)]
fn advance_xyz<S: Simd>(
    bands: &Bands<'_, S>,
    (observer, part): (&[Knots<'_>; 3], f64),
    value: &Spectrum,
    xyz: &mut [f64; 3],
) {
    for (seen_by, mean) in observer.iter().zip(xyz) {
        // The sums of every eighth band, whatever the width of a register.
        let mut sums = [Chunk::default()];
        for sum in At::lanes::<S>(0) {
            let mut total = bands.splat(0.0);
            for at in bands.chunks().map(|chunk| sum.in_chunk(chunk)) {
                total = bands
                    .load(at, value)
                    .mul_add(seen_by.value(bands, at), total);
            }
            sum.store(total, &mut sums);
        }
        *mean += (sums[0].sum() - *mean) * part;
    }
}
