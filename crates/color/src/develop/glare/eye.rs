//! Glare from light scattered in a human eye.
//!
//! G. Spencer, P. Shirley, K. Zimmerman and D. P. Greenberg, Physically-based glare effects for digital images, SIGGRAPH 95, 325.

use colorimetry::Matrix3;
use colorimetry::matrix::times;
use rayon::prelude::*;
use spectra::{BandGrid, Observer};

use super::mirror::{Mirror, Spectrum};
use super::{DevelopError, Latent};
use picture_file::LinearImage;
use relight::BandWeights;

/// The adaptation state of the eye, which determines its pupil.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Vision {
    /// Adapted to light: a small pupil, and no halo.
    Photopic,
    /// Between light and dark, as in front of a display in the evening.
    #[default]
    Mesopic,
    /// Adapted to the dark: a wide pupil, whose rim causes the lenticular halo.
    Scotopic,
}

impl Vision {
    /// The weights of f₀, f₁, f₂ and f₃; their sum is 1.
    fn shares(self) -> [f64; 4] {
        match self {
            Self::Photopic => [0.384, 0.478, 0.138, 0.0],
            Self::Mesopic => [0.368, 0.478, 0.138, 0.016],
            Self::Scotopic => [0.282, 0.478, 0.207, 0.033],
        }
    }
}

/// Glare from light scattered in a human eye that looks at the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EyeGlare {
    /// The angle of view of a pixel in the middle of the picture. The same angle is used for all pixels; in a picture with a wide
    /// view, this stretches the glare toward the corners.
    pub degrees_per_pixel: f64,
    /// The state of the eye.
    pub vision: Vision,
}

impl EyeGlare {
    /// Returns the glare for a picture of a perspective camera with the vertical field of view `fov_deg`.
    pub fn of_view(fov_deg: f64, height: u32, vision: Vision) -> Self {
        let half = (0.5 * fov_deg.to_radians()).tan();
        Self {
            degrees_per_pixel: (2.0 * half / f64::from(height.max(1))).atan().to_degrees(),
            vision,
        }
    }
}

/// Returns Spencer's four functions at θ degrees from the source, per steradian:
///
/// f₀ = 2.61·10⁶ exp(−(θ/0.02)²), f₁ = 20.91/(θ + 0.02)³, f₂ = 72.37/(θ + 0.02)² and the lenticular halo, a ring about 3° wide,
/// f₃ = 436.9 (568/λ) exp(−19.75 (θ − 3λ/568)²) with λ in nm. Each integrates to 1 over the half space in front of the eye.
pub fn point_spread(theta_deg: f64, nm: f64) -> [f64; 4] {
    let near = theta_deg + 0.02;
    [
        2.61e6 * (-(theta_deg / 0.02).powi(2)).exp(),
        20.91 / near.powi(3),
        72.37 / near.powi(2),
        436.9 * (568.0 / nm) * (-19.75 * (theta_deg - 3.0 * nm / 568.0).powi(2)).exp(),
    ]
}

/// The wavelength assumed for light of unknown wavelength: the reference wavelength of f₃.
const MEAN_NM: f64 = 568.0;

/// Scatters a picture that `rgb_from_xyz` computed from `latent`, whose XYZ are those of `observer`.
///
/// The kernel is cut at the picture's size and scaled to the sum 1, so no light is lost; beyond the picture the scene is assumed
/// to continue as in mirrors. Only the halo depends on wavelength: it is spread band by band, everything else once. Where the
/// bands do not add up to the picture's color, the remainder is spread as light of 568 nm. Pixels that are not finite do not
/// scatter.
pub(super) fn add(
    image: &mut LinearImage,
    latent: &Latent<'_>,
    rgb_from_xyz: &Matrix3,
    eye: EyeGlare,
    observer: Observer,
) -> Result<(), DevelopError> {
    let kernels = Kernels::new(image, eye);
    let has_halo = eye.vision.shares()[3] > 0.0;
    let spectra = if has_halo {
        let (grid, radiance) = latent.spectrum.ok_or(DevelopError::NoSpectrum)?;
        let bands = Bands::new(grid, radiance, rgb_from_xyz, observer);
        kernels.of_spectrum(image, &bands)
    } else {
        kernels.of_colors(image)
    };
    let planes = spectra.map(|spectrum| kernels.mirror.picture(spectrum));
    image
        .rgb_mut()
        .par_iter_mut()
        .enumerate()
        .for_each(|(i, rgb)| {
            if rgb.iter().all(|v| v.is_finite()) {
                *rgb = planes.each_ref().map(|plane| plane[i] as f32);
            }
        });
    Ok(())
}

/// The point spread function as convolution kernels on the pixels of a picture.
struct Kernels {
    mirror: Mirror,
    shares: [f64; 4],
    degrees_per_pixel: f64,
    /// Transform and sum of f₀, f₁ and f₂ with their weights.
    common: (Spectrum, f64),
}

impl Kernels {
    fn new(image: &LinearImage, eye: EyeGlare) -> Self {
        let mirror = Mirror::new(image.width() as usize, image.height() as usize);
        let (shares, pixel) = (eye.vision.shares(), eye.degrees_per_pixel);
        let common = mirror.of_kernel(|x, y| {
            over_pixel([x, y], pixel, core_parts([x, y], pixel), |theta| {
                let f = point_spread(theta, MEAN_NM);
                (0..3).map(|i| shares[i] * f[i]).sum()
            })
        });
        Self {
            // The first value of a transform is the sum.
            common: (common.clone(), common[0]),
            mirror,
            shares,
            degrees_per_pixel: pixel,
        }
    }

    /// Returns the weighted halo as a function of the distance in pixels.
    fn halo(&self, nm: f64) -> impl Fn(usize, usize) -> f64 + Sync {
        let (pixel, share) = (self.degrees_per_pixel, self.shares[3]);
        // Beyond eight standard deviations of the ring the halo is negligible.
        let (radius, reach) = (3.0 * nm / 568.0, 8.0 / (2.0 * 19.75_f64).sqrt() + pixel);
        move |x, y| {
            let theta = pixel * (x as f64).hypot(y as f64);
            if (theta - radius).abs() > reach {
                return 0.0;
            }
            over_pixel([x, y], pixel, halo_parts(pixel), |theta| {
                share * point_spread(theta, nm)[3]
            })
        }
    }

    /// Returns the factor on light of a wavelength that makes its whole kernel sum to 1.
    fn scale(&self, nm: f64) -> f64 {
        1.0 / (self.common.1 + self.mirror.sum_of_kernel(self.halo(nm)))
    }

    /// Returns the transforms of red, green and blue, scattered without a halo.
    fn of_colors(&self, image: &LinearImage) -> [Spectrum; 3] {
        let (kernel, sum) = &self.common;
        std::array::from_fn(|channel| {
            let plane = image.rgb().iter().map(|&rgb| finite(rgb)[channel] / sum);
            let mut spectrum = self.mirror.of_picture(plane.collect());
            add_product(None, &mut spectrum, kernel);
            spectrum
        })
    }

    /// Returns the transforms of red, green and blue, with the halo of each band scattered separately.
    fn of_spectrum(&self, image: &LinearImage, bands: &Bands<'_>) -> [Spectrum; 3] {
        // Light of a band is scaled by the sum of its own kernel; the remainder by that of the mean wavelength.
        let middle = self.mirror.of_kernel(self.halo(MEAN_NM));
        let middle_scale = self.scale(MEAN_NM);
        let scales: Vec<f64> = bands.centers_nm.iter().map(|&nm| self.scale(nm)).collect();

        let mut sums: [Spectrum; 3] = std::array::from_fn(|channel| {
            let rest = |i: usize| finite(image.rgb()[i])[channel] - bands.color(i, channel, None);
            let pixels = 0..image.rgb().len();
            let rest: Vec<f64> = pixels
                .clone()
                .into_par_iter()
                .map(|i| rest(i) * middle_scale)
                .collect();
            let all = pixels
                .into_par_iter()
                .map(|i| rest[i] + bands.color(i, channel, Some(&scales)));
            let mut sum = self.mirror.of_picture(all.collect());
            add_product(None, &mut sum, &self.common.0);
            let rest = self.mirror.of_picture(rest);
            add_product(Some(&rest), &mut sum, &middle);
            sum
        });
        for (band, (&nm, scale)) in bands.centers_nm.iter().zip(&scales).enumerate() {
            let halo = self.mirror.of_kernel(self.halo(nm));
            let spectrum = self.mirror.of_picture(bands.plane(band));
            let weights = bands.weights[band].map(|w| w * scale);
            for (sum, weight) in sums.iter_mut().zip(weights) {
                sum.par_iter_mut()
                    .zip(&spectrum)
                    .zip(&halo)
                    .with_min_len(4096)
                    .for_each(|((sum, v), k)| *sum += weight * v * k);
            }
        }
        sums
    }
}

/// Multiplies `sum` by `kernel`; if there is another spectrum, adds the product of it and `kernel` instead.
fn add_product(other: Option<&Spectrum>, sum: &mut Spectrum, kernel: &Spectrum) {
    match other {
        None => sum.iter_mut().zip(kernel).for_each(|(v, k)| *v *= k),
        Some(other) => {
            let products = other.iter().zip(kernel).map(|(v, k)| v * k);
            sum.iter_mut().zip(products).for_each(|(v, p)| *v += p);
        }
    }
}

/// A color, or black if it is not finite.
fn finite(rgb: [f32; 3]) -> [f64; 3] {
    if rgb.iter().all(|v| v.is_finite()) {
        rgb.map(f64::from)
    } else {
        [0.0; 3]
    }
}

/// Number of parts into which each side of a pixel is divided for f₀, f₁ and f₂. A part is an eighth of the angle over which they
/// change, which is 0.02° at the source and grows with the distance from it. Far from the source one part is the whole pixel.
fn core_parts([x, y]: [usize; 2], degrees_per_pixel: f64) -> usize {
    let [x, y] = [x, y].map(|v| v as f64);
    let nearest = degrees_per_pixel * (x - 0.5).max(0.0).hypot((y - 0.5).max(0.0));
    let parts = (4.0 * degrees_per_pixel / (nearest + 0.02)).ceil();
    if parts <= 1.0 {
        1
    } else {
        2 * (parts as usize).min(64)
    }
}

/// Number of parts for f₃: a part is a quarter of the angle over which it changes, 0.16° at every distance.
fn halo_parts(degrees_per_pixel: f64) -> usize {
    // Pixels reach the bound at 10°; a picture has few of those.
    ((4.0 * degrees_per_pixel / 0.16).ceil() as usize).clamp(1, 256)
}

/// Returns the mean of a function of the angle over the square of a pixel, from the midpoints of its parts.
fn over_pixel(
    [x, y]: [usize; 2],
    degrees_per_pixel: f64,
    parts: usize,
    f: impl Fn(f64) -> f64,
) -> f64 {
    let [x, y] = [x, y].map(|v| v as f64);
    let place = |v: f64, i: usize| degrees_per_pixel * (v - 0.5 + (i as f64 + 0.5) / parts as f64);
    let mut sum = 0.0;
    for i in 0..parts {
        for j in 0..parts {
            sum += f(place(x, i).hypot(place(y, j)));
        }
    }
    sum / (parts * parts) as f64
}

/// The bands of an image and the red, green and blue that each contributes.
struct Bands<'a> {
    radiance: &'a [f32],
    centers_nm: Vec<f64>,
    weights: Vec<[f64; 3]>,
}

impl<'a> Bands<'a> {
    /// The bands for a picture that `rgb_from_xyz` computes from the XYZ of `observer`.
    fn new(
        grid: &BandGrid,
        radiance: &'a [f32],
        rgb_from_xyz: &Matrix3,
        observer: Observer,
    ) -> Self {
        let observer = BandWeights::observed(grid, observer);
        let rgb = |&xyz: &[f64; 3]| times(rgb_from_xyz, xyz);
        Self {
            radiance,
            centers_nm: (0..grid.count()).map(|band| grid.center_nm(band)).collect(),
            weights: observer.weights().iter().map(rgb).collect(),
        }
    }

    /// Returns the sum of the bands for a channel of a pixel, each band times its scale.
    fn color(&self, pixel: usize, channel: usize, scales: Option<&[f64]>) -> f64 {
        let bands = self.weights.len();
        let values = &self.radiance[pixel * bands..(pixel + 1) * bands];
        let scale = |band: usize| scales.map_or(1.0, |scales| scales[band]);
        (0..bands)
            .map(|b| lit(values[b]) * self.weights[b][channel] * scale(b))
            .sum()
    }

    /// Returns a band of every pixel.
    fn plane(&self, band: usize) -> Vec<f64> {
        let pixels = self.radiance.par_chunks_exact(self.weights.len());
        pixels.map(|values| lit(values[band])).collect()
    }
}

/// A radiance, or 0 if it is not finite.
fn lit(radiance: f32) -> f64 {
    if radiance.is_finite() {
        f64::from(radiance)
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests;
