//! A clear sky: from the sun's height to a picture of all directions with the sun's azimuth in its middle.

use super::checks::Checks;
use super::environment_picture::{Sphere, banded};
use super::spectrum_list::SpectrumList;
use crate::description::Reflectance;
use crate::{FieldPath, limits};
use rayon::prelude::*;
use spectra::sky::{ClearSky, SUN_DIAMETER_DEG, daylight_basis};
use spectra::{BandGrid, BandTable};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Pixels around and from top to bottom; the horizon lies between two rows.
const SIZE: [u32; 2] = [256, 128];

/// Checks a sky; `sun` is its elevation and azimuth in degrees.
pub(super) fn check(
    checks: &mut Checks,
    spectra: &mut SpectrumList<'_>,
    (sun, turbidity): ([f64; 2], f64),
    ground: &Reflectance,
) -> Option<Sphere> {
    let top = FieldPath::root().key("environment");
    let elevation = checks.number(
        &top.key("sun_elevation_deg"),
        sun[0],
        &limits::SUN_ELEVATION_DEG,
    );
    let azimuth = checks.number(&top.key("sun_azimuth_deg"), sun[1], &limits::ROTATION_DEG);
    let turbidity = checks.number(&top.key("turbidity"), turbidity, &limits::TURBIDITY);
    let ground = spectra.reflectance(checks, &top.key("ground"), ground)?;
    let (elevation, _) = (elevation?, azimuth?);
    let grid = spectra.grid()?;
    let sun_angle = FRAC_PI_2 - elevation.to_radians();
    let sky = ClearSky::new(sun_angle, turbidity?);
    let sky = BandedSky::new(&sky, sun_angle, &grid);
    let ground = means(&grid, spectra.table(ground));
    Some(sky.over(&ground))
}

/// The mean over each band.
fn means(grid: &BandGrid, table: &BandTable) -> Vec<f64> {
    let steps = table.steps();
    let of_band = |band| {
        let knots = (0..=steps).map(|step| table.row(step)[band as usize]);
        let ends = table.row(0)[band as usize] + table.row(steps)[band as usize];
        (knots.sum::<f64>() - 0.5 * ends) / f64::from(steps)
    };
    (0..grid.count()).map(of_band).collect()
}

/// A sky with the sun towards the middle of its picture.
struct BandedSky<'a> {
    sky: &'a ClearSky,
    sun_angle: f64,
    grid: &'a BandGrid,
    /// The components of daylight in each band.
    components: Vec<[f64; 3]>,
}

impl<'a> BandedSky<'a> {
    fn new(sky: &'a ClearSky, sun_angle: f64, grid: &'a BandGrid) -> Self {
        // Daylight's components cover 300 to 830 nm, as bands do.
        let tables = daylight_basis().map(|component| BandTable::new(grid, &component).ok());
        let of_bands =
            tables.map(|table| table.map(|table| means(grid, &table)).unwrap_or_default());
        let components = (0..grid.count() as usize).map(|band| {
            of_bands
                .each_ref()
                .map(|of| of.get(band).copied().unwrap_or(0.0))
        });
        Self {
            sky,
            sun_angle,
            grid,
            components: components.collect(),
        }
    }

    /// The picture, with ground of a reflectance below.
    fn over(&self, ground: &[f64]) -> Sphere {
        let [width, height] = SIZE;
        let upper: Vec<Vec<f32>> = (0..width * height / 2)
            .into_par_iter()
            .map(|pixel| self.pixel(pixel % width, pixel / width))
            .collect();
        let irradiance = self.irradiance(&upper);
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
        let towards =
            self.sun_angle.cos() * angle.cos() + self.sun_angle.sin() * angle.sin() * turn.cos();
        let light = self.sky.light(angle.cos(), towards.clamp(-1.0, 1.0).acos());
        let components = self.components.iter();
        components
            .map(|&values| light.of_components(values) as f32)
            .collect()
    }

    /// Irradiance of flat ground in each band, by the sky and the sun.
    fn irradiance(&self, upper: &[Vec<f32>]) -> Vec<f64> {
        let half = (SUN_DIAMETER_DEG / 2.0).to_radians();
        let of_sun = PI * half.sin().powi(2) * self.sun_angle.cos();
        let bands = 0..self.grid.count();
        let mut sums: Vec<f64> = bands
            .map(|band| of_sun * self.sky.sun_radiance(self.grid.centre_nm(band)))
            .collect();
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

/// Angle from the zenith of a row's middle.
fn angle_of(row: u32) -> f64 {
    PI * (f64::from(row) + 0.5) / f64::from(SIZE[1])
}
