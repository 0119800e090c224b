//! A clear sky: from the sun's elevation to a picture of all directions, with the sun's azimuth at its center, and the sun's disk.

use super::checks::Checks;
use super::environment_picture::{Sphere, banded};
use super::spectrum_list::SpectrumList;
use crate::description::Reflectance;
use crate::limits;
use document::FieldPath;
use glam::DVec3;
use rayon::prelude::*;
use scene::{EmittedPolarization, LightShape};
use spectra::sky::{ClearSky, SUN_DIAMETER_DEG, daylight_basis};
use spectra::{BandGrid, BandTable, Spectrum, Tabulated};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Width and height of the picture in pixels; the horizon is between two rows.
const SIZE: [u32; 2] = [256, 128];

/// A sky as written in a scene file.
pub(super) struct Sky<'a> {
    pub(super) sun_elevation_deg: f64,
    pub(super) sun_azimuth_deg: f64,
    pub(super) turbidity: f64,
    pub(super) ground: &'a Reflectance,
    /// The degree of polarization at 90° from the sun.
    pub(super) polarization_degree: f64,
}

/// A sky after the checks.
pub(super) struct Checked {
    /// The sky over its ground.
    pub(super) sphere: Sphere,
    /// The radiance of the sun's disk.
    pub(super) sunlight: Spectrum,
    /// The polarization of the sky.
    pub(super) polarization: Option<EmittedPolarization>,
    /// The direction and size of the sun's disk.
    pub(super) disk: LightShape,
}

impl Sky<'_> {
    pub(super) fn check(&self, checks: &mut Checks, spectra: &mut SpectrumList) -> Option<Checked> {
        let top = FieldPath::root().key("environment");
        let mut number = |name: &str, value, range| checks.number(&top.key(name), value, range);
        let elevation = number(
            "sun_elevation_deg",
            self.sun_elevation_deg,
            &limits::SUN_ELEVATION_DEG,
        );
        let azimuth = number(
            "sun_azimuth_deg",
            self.sun_azimuth_deg,
            &limits::ROTATION_DEG,
        );
        let turbidity = number("turbidity", self.turbidity, &limits::TURBIDITY);
        let most = number(
            "polarization_degree",
            self.polarization_degree,
            &limits::FRACTION,
        );
        let ground = spectra.reflectance(checks, &top.key("ground"), self.ground)?;
        let most = most?;
        let (elevation, azimuth) = (elevation?.to_radians(), azimuth?.to_radians());
        let grid = spectra.grid()?;
        let sun_angle = FRAC_PI_2 - elevation;
        let sky = ClearSky::new(sun_angle, turbidity?);
        let sunlight = sunlight(&sky);
        let sky = BandedSky::new(&sky, sun_angle, &grid);
        let of_sun = of_bands(&grid, &sunlight);
        let ground = means(&grid, spectra.table(ground));
        let (sin_a, cos_a) = azimuth.sin_cos();
        let (height, radius) = elevation.sin_cos();
        let toward = DVec3::new(radius * sin_a, height, -radius * cos_a);
        Some(Checked {
            sphere: sky.over(&ground, &of_sun),
            sunlight,
            polarization: (most > 0.0).then_some(EmittedPolarization::Sky { sun: toward, most }),
            disk: LightShape::DistantDisk {
                toward,
                height: 2.0 * (0.25 * SUN_DIAMETER_DEG.to_radians()).sin().powi(2),
            },
        })
    }
}

/// Radiance of the sun's disk at every nanometer that bands may cover.
fn sunlight(sky: &ClearSky) -> Spectrum {
    let (first, last) = BandGrid::LIMITS_NM;
    let points = (first as u32..=last as u32).map(f64::from);
    let points = points.map(|nm| (nm, sky.sun_radiance(nm)));
    Spectrum::Table(Tabulated::new(points.collect()).expect("its wavelengths increase"))
}

/// The mean over each band of a spectrum that covers all bands.
fn of_bands(grid: &BandGrid, spectrum: &Spectrum) -> Vec<f64> {
    let table = BandTable::new(grid, spectrum);
    table.map_or_else(|_| vec![0.0; grid.count() as usize], |t| means(grid, &t))
}

/// The mean of a table over each band.
fn means(grid: &BandGrid, table: &BandTable) -> Vec<f64> {
    let steps = table.steps();
    let of_band = |band| {
        let knots = (0..=steps).map(|step| table.row(step)[band as usize]);
        let ends = table.row(0)[band as usize] + table.row(steps)[band as usize];
        (knots.sum::<f64>() - 0.5 * ends) / f64::from(steps)
    };
    (0..grid.count()).map(of_band).collect()
}

/// A sky with the sun toward the center of its picture.
struct BandedSky<'a> {
    sky: &'a ClearSky,
    sun_angle: f64,
    /// The components of daylight in each band.
    components: Vec<[f64; 3]>,
}

impl<'a> BandedSky<'a> {
    fn new(sky: &'a ClearSky, sun_angle: f64, grid: &BandGrid) -> Self {
        // The components of daylight cover 300 to 830 nm, the range that bands may have.
        let of_bands = daylight_basis().map(|component| of_bands(grid, &component));
        let components =
            (0..grid.count() as usize).map(|band| of_bands.each_ref().map(|of| of[band]));
        Self {
            sky,
            sun_angle,
            components: components.collect(),
        }
    }

    /// The picture, with ground of the given reflectance below the horizon, lit by the sky and by the sun.
    fn over(&self, ground: &[f64], sunlight: &[f64]) -> Sphere {
        let [width, height] = SIZE;
        let upper: Vec<Vec<f32>> = (0..width * height / 2)
            .into_par_iter()
            .map(|pixel| self.pixel(pixel % width, pixel / width))
            .collect();
        let irradiance = self.irradiance(&upper, sunlight);
        let below = irradiance
            .iter()
            .zip(ground)
            .map(|(e, r)| (e * r / PI) as f32);
        let below: Vec<f32> = below.collect();
        let lower = vec![below; (width * height / 2) as usize];
        banded(width, height, &[upper, lower].concat())
    }

    /// Radiance of a pixel in each band.
    fn pixel(&self, column: u32, row: u32) -> Vec<f32> {
        let angle = angle_of(row);
        let turn = TAU * ((f64::from(column) + 0.5) / f64::from(SIZE[0]) - 0.5);
        let toward =
            self.sun_angle.cos() * angle.cos() + self.sun_angle.sin() * angle.sin() * turn.cos();
        let light = self.sky.light(angle.cos(), toward.clamp(-1.0, 1.0).acos());
        let components = self.components.iter();
        components
            .map(|&values| light.of_components(values) as f32)
            .collect()
    }

    /// Irradiance of flat ground in each band from the sky and the sun.
    fn irradiance(&self, upper: &[Vec<f32>], sunlight: &[f64]) -> Vec<f64> {
        let half = (SUN_DIAMETER_DEG / 2.0).to_radians();
        let of_sun = PI * half.sin().powi(2) * self.sun_angle.cos();
        let mut sums: Vec<f64> = sunlight.iter().map(|radiance| of_sun * radiance).collect();
        for (index, pixel) in (0_u32..).zip(upper) {
            let angle = angle_of(index / SIZE[0]);
            let solid_angle = angle.sin() * PI / f64::from(SIZE[1]) * TAU / f64::from(SIZE[0]);
            for (sum, &radiance) in sums.iter_mut().zip(pixel) {
                *sum += f64::from(radiance) * angle.cos() * solid_angle;
            }
        }
        sums
    }
}

/// Angle between the zenith and the center of a row.
fn angle_of(row: u32) -> f64 {
    PI * (f64::from(row) + 0.5) / f64::from(SIZE[1])
}
