//! Fits the thickness of a layer to a measured or rendered spectrum: reflectometry on a pixel.

use crate::matching::{MatchPlace, STEP_NM, STEPS, lowest_between, minima};
use crate::{Angle, SampleError, Sampled, Stack, View};
use colorimetry::lab::delta_e_2000;
use colorimetry::{Lab, srgb};
use spectra::{BandGrid, observer_1931};

/// Light from a film: its mean over each band of a grid.
#[derive(Clone, Copy, Debug)]
pub struct Measured<'a> {
    /// The bands.
    pub bands: &'a BandGrid,
    /// Mean radiance over each band, in any unit.
    pub radiance: &'a [f64],
    /// Standard deviation of each mean, if known.
    pub deviation: Option<&'a [f64]>,
    /// XYZ as displayed, Y = 1 for the display's white.
    pub xyz: [f64; 3],
}

/// What is fitted, and in which range.
#[derive(Clone, Copy, Debug)]
pub struct FilmFitting<'a> {
    /// The stack.
    pub stack: &'a Stack,
    /// Index of the layer that varies, from 0. The other layers keep their thickness.
    pub layer: usize,
    /// Its smallest thickness, nm.
    pub from_nm: f64,
    /// Its largest thickness, nm; more than `from_nm`.
    pub to_nm: f64,
    /// The angle of incidence.
    pub angle: Angle,
    /// Side and polarization.
    pub view: View,
    /// Relative power of the lamp at each of [`FilmFitting::wavelengths_nm`].
    pub lamp: &'a [f64],
}

/// A thickness that is a local optimum: its spectrum is nearer in shape, or in color, than those of its neighbors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilmFit {
    /// Thickness of the layer that varies, nm.
    pub thickness_nm: f64,
    /// Standard deviation of the thickness due to the noise of the measurement, nm, if that noise is known. The noise is assumed
    /// independent per band. A renderer, which samples all bands together, has noise that mostly changes the scale; this value is
    /// then too large.
    pub deviation_nm: Option<f64>,
    /// Ratio of the measured light to that of the film under the lamp, by least squares: 1 where the film mirrors the lamp itself.
    pub scale: f64,
    /// Residual after scaling, √(Σ(L − a M)² / ΣL²) over the bands: 0 for the same shape.
    pub residual: f64,
    /// Color difference ΔE₀₀, with the film scaled to the brightness of the measured light.
    pub delta_e: f64,
    /// Where it is in the range.
    pub place: MatchPlace,
}

/// The result of a fit.
#[derive(Clone, Debug, PartialEq)]
pub struct FilmFits {
    /// Fits by the shape of the spectrum, best first.
    pub by_shape: Vec<FilmFit>,
    /// Fits by color regardless of brightness, best first.
    pub by_color: Vec<FilmFit>,
    /// Residual of the lamp's own spectrum, as a neutral surface reflects it.
    pub of_lamp: f64,
    /// Residual of the right film due to noise alone, if the noise is known; it assumes that the noise is independent per band.
    pub of_noise: Option<f64>,
}

/// Whether the spectrum is that of a film.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// The best thickness matches the shape of the spectrum.
    Film,
    /// A neutral surface explains the spectrum as well as any thickness does.
    Lamp,
    /// No thickness in the range matches the shape of the spectrum.
    Nothing,
}

/// Largest residual that counts as the same shape. Light that the film does not mirror, a film that varies within a pixel, and
/// noise give the right film a residual of some percent. The colored patches of the ColorChecker have 12 % and more for the
/// nearest film of water, its grays 5 to 8 %.
const SAME_SHAPE: f64 = 0.08;

impl FilmFits {
    /// Returns whether the best thickness is an answer: its residual is at most 8 %, and less than half of that of the lamp's own
    /// spectrum. That is not a proof: some pigment may have the shape of some film.
    pub fn verdict(&self) -> Verdict {
        let best = self.residual();
        if best <= SAME_SHAPE && best < 0.5 * self.of_lamp {
            Verdict::Film
        } else if self.of_lamp <= SAME_SHAPE {
            Verdict::Lamp
        } else {
            Verdict::Nothing
        }
    }
}

impl FilmFits {
    /// The residual of the best fit by shape.
    fn residual(&self) -> f64 {
        self.by_shape
            .first()
            .map_or(f64::INFINITY, |fit| fit.residual)
    }
}

/// Fits several candidates, such as one film under each lamp that may light it. Returns the index of the candidate whose best fit by shape has
/// the smallest residual, the first of equal ones, with its fits; `None` where the measured light is black or not finite, or without candidates.
///
/// # Errors
/// If a stack has no data at some wavelength.
///
/// # Panics
/// As [`FilmFitting::fit`].
pub fn nearest_fit(
    candidates: &[FilmFitting<'_>],
    measured: &Measured<'_>,
) -> Result<Option<(usize, FilmFits)>, SampleError> {
    let mut nearest: Option<(usize, FilmFits)> = None;
    for (index, candidate) in candidates.iter().enumerate() {
        let Some(fits) = candidate.fit(measured)? else {
            continue;
        };
        let is_nearer = |(_, known): &(usize, FilmFits)| fits.residual() < known.residual();
        if nearest.as_ref().is_none_or(is_nearer) {
            nearest = Some((index, fits));
        }
    }
    Ok(nearest)
}

/// The spectrum of a film under the lamp: its mean over each band, and its XYZ in any unit.
struct Model {
    bands: Vec<f64>,
    xyz: [f64; 3],
}

impl FilmFitting<'_> {
    /// Wavelengths at which the lamp and the film are computed: equidistant in each band, at most 1 nm apart.
    pub fn wavelengths_nm(bands: &BandGrid) -> Vec<f64> {
        let per_band = per_band(bands);
        let place = |step: u32| (f64::from(step) + 0.5) / f64::from(per_band);
        (0..bands.count())
            .flat_map(|band| (0..per_band).map(move |step| bands.wavelength_nm(band, place(step))))
            .collect()
    }

    /// Returns the thicknesses whose spectra are nearest in shape and in color; `None` where the measured light is black or not finite.
    ///
    /// # Errors
    /// If the stack has no data at some wavelength.
    ///
    /// # Panics
    /// If the layer does not exist, or there is not one value per band or wavelength.
    pub fn fit(&self, measured: &Measured<'_>) -> Result<Option<FilmFits>, SampleError> {
        let power: f64 = measured.radiance.iter().map(|l| l * l).sum();
        if !(power > 0.0 && power.is_finite()) {
            return Ok(None);
        }
        let nm = Self::wavelengths_nm(measured.bands);
        assert_eq!(
            self.lamp.len(),
            nm.len(),
            "one value of the lamp per wavelength"
        );
        let sampled = self.stack.sampled(&nm)?;
        let search = Search {
            fitting: self,
            measured,
            sampled,
            power,
        };
        let of_noise = measured.deviation.map(|deviation| {
            let noise: f64 = deviation.iter().map(|d| d * d).sum();
            (noise / power).sqrt()
        });
        let of_lamp = search
            .judge(0.0, &search.model(std::iter::repeat(1.0)))
            .residual;
        let grid = search.on_grid();
        Ok(Some(FilmFits {
            by_shape: search.nearest(&grid, |fit| fit.residual),
            by_color: search.nearest(&grid, |fit| fit.delta_e),
            of_lamp,
            of_noise,
        }))
    }

    /// Returns the mean light of the film over each band, in units of the lamp.
    ///
    /// # Errors
    /// If the stack has no data at some wavelength.
    pub fn spectrum(&self, bands: &BandGrid, thickness_nm: f64) -> Result<Vec<f64>, SampleError> {
        let sampled = self.stack.sampled(&Self::wavelengths_nm(bands))?;
        let seen = self.seen(&sampled, thickness_nm);
        let lit: Vec<f64> = seen.zip(self.lamp).map(|(r, s)| r * s).collect();
        Ok(means(&lit, bands))
    }

    fn set(&self, nm: f64) -> Vec<f64> {
        let mut thicknesses = self.stack.thicknesses_nm().to_vec();
        thicknesses[self.layer] = nm;
        thicknesses
    }

    fn seen(&self, sampled: &Sampled, nm: f64) -> impl Iterator<Item = f64> {
        let view = self.view;
        let powers = sampled.powers(&self.set(nm), self.angle);
        powers
            .into_iter()
            .map(move |p| view.of(p.reflectance, p.transmittance))
    }
}

fn per_band(bands: &BandGrid) -> u32 {
    bands.width_nm().ceil().max(1.0) as u32
}

fn means(values: &[f64], bands: &BandGrid) -> Vec<f64> {
    let per_band = per_band(bands) as usize;
    let mean = |values: &[f64]| values.iter().sum::<f64>() / per_band as f64;
    values.chunks(per_band).map(mean).collect()
}

/// A search through the thicknesses.
struct Search<'a> {
    fitting: &'a FilmFitting<'a>,
    measured: &'a Measured<'a>,
    sampled: Sampled,
    /// ΣL².
    power: f64,
}

impl Search<'_> {
    /// Makes a model from the reflectance at each wavelength.
    fn model(&self, seen: impl Iterator<Item = f64>) -> Model {
        let lit: Vec<f64> = seen.zip(self.fitting.lamp).map(|(r, s)| r * s).collect();
        let mut xyz = [0.0; 3];
        for (value, &nm) in lit.iter().zip(self.sampled.wavelengths_nm()) {
            for (sum, curve) in xyz.iter_mut().zip(observer_1931()) {
                *sum += value * curve.clamped_at(nm);
            }
        }
        Model {
            bands: means(&lit, self.measured.bands),
            xyz,
        }
    }

    fn judge(&self, nm: f64, model: &Model) -> FilmFit {
        let scale = self.scale(model);
        let pairs = self.measured.radiance.iter().zip(&model.bands);
        let left: f64 = pairs.map(|(l, m)| (l - scale * m).powi(2)).sum();
        let wanted = self.measured.xyz;
        // Scaled to the brightness of the measured light; black stays black.
        let brightness = if model.xyz[1] > 0.0 {
            wanted[1] / model.xyz[1]
        } else {
            0.0
        };
        let lab = |xyz| Lab::from_xyz(xyz, srgb::white_xyz());
        FilmFit {
            thickness_nm: nm,
            deviation_nm: None,
            scale,
            residual: (left / self.power).sqrt(),
            delta_e: delta_e_2000(lab(wanted), lab(model.xyz.map(|v| v * brightness))),
            place: MatchPlace::Within,
        }
    }

    /// Returns the a ≥ 0 with the smallest Σ(L − a M)².
    fn scale(&self, model: &Model) -> f64 {
        let pairs = self.measured.radiance.iter().zip(&model.bands);
        let common: f64 = pairs.map(|(l, m)| l * m).sum();
        let own: f64 = model.bands.iter().map(|m| m * m).sum();
        if own > 0.0 {
            (common / own).max(0.0)
        } else {
            0.0
        }
    }

    fn at(&self, nm: f64) -> FilmFit {
        self.judge(nm, &self.model(self.fitting.seen(&self.sampled, nm)))
    }

    fn on_grid(&self) -> Vec<FilmFit> {
        /// Number of spectra in memory at a time.
        const AT_ONCE: usize = 256;
        let (from_nm, to_nm) = (self.fitting.from_nm, self.fitting.to_nm);
        let steps = ((to_nm - from_nm) / STEP_NM).ceil().clamp(STEPS.0, STEPS.1) as usize;
        let nm = |step: usize| from_nm + step as f64 / steps as f64 * (to_nm - from_nm);
        let thicknesses: Vec<f64> = (0..=steps).map(nm).collect();
        let wavelengths = self.sampled.wavelengths_nm().len();
        let mut found = Vec::with_capacity(thicknesses.len());
        for some in thicknesses.chunks(AT_ONCE) {
            let sets: Vec<Vec<f64>> = some.iter().map(|&nm| self.fitting.set(nm)).collect();
            let powers = self.sampled.powers_of_all(&sets, &[self.fitting.angle]);
            for (&nm, powers) in some.iter().zip(powers.chunks(wavelengths)) {
                let view = self.fitting.view;
                let seen = powers
                    .iter()
                    .map(|p| view.of(p.reflectance, p.transmittance));
                found.push(self.judge(nm, &self.model(seen)));
            }
        }
        found
    }

    /// Returns the local minima of a figure of merit, best first.
    fn nearest(&self, grid: &[FilmFit], figure: impl Fn(&FilmFit) -> f64) -> Vec<FilmFit> {
        let values: Vec<f64> = grid.iter().map(&figure).collect();
        let refined = |(step, place): (usize, MatchPlace)| {
            let on_grid = FilmFit {
                place,
                ..grid[step]
            };
            let next = (step + 1).min(grid.len() - 1);
            let between = (
                grid[step.saturating_sub(1)].thickness_nm,
                grid[next].thickness_nm,
            );
            let inside = self.at(lowest_between(between, |nm| figure(&self.at(nm))));
            let is_better = place != MatchPlace::Anywhere && figure(&inside) < figure(&on_grid);
            let best = if is_better { inside } else { on_grid };
            FilmFit {
                deviation_nm: self.deviation_nm(&best),
                ..best
            }
        };
        let mut found: Vec<FilmFit> = minima(&values).into_iter().map(refined).collect();
        found.sort_by(|a, b| figure(a).total_cmp(&figure(b)));
        found
    }

    /// Propagates the noise of each band linearly to the thickness, with the scale fitted too.
    fn deviation_nm(&self, fit: &FilmFit) -> Option<f64> {
        const H_NM: f64 = 0.01;
        let deviation = self.measured.deviation?;
        let model = |nm| self.model(self.fitting.seen(&self.sampled, nm)).bands;
        let here = model(fit.thickness_nm);
        let (thin, thick) = ((fit.thickness_nm - H_NM).max(0.0), fit.thickness_nm + H_NM);
        let (low, high) = (model(thin), model(thick));
        let slope: Vec<f64> = (low.iter().zip(&high))
            .map(|(low, high)| fit.scale * (high - low) / (thick - thin))
            .collect();
        // The component of the slope that a change of scale cannot explain.
        let dot = |a: &[f64], b: &[f64]| -> f64 { a.iter().zip(b).map(|(a, b)| a * b).sum() };
        let along = dot(&slope, &here) / dot(&here, &here);
        let across: Vec<f64> = slope
            .iter()
            .zip(&here)
            .map(|(s, m)| s - along * m)
            .collect();
        let noise: f64 = across
            .iter()
            .zip(deviation)
            .map(|(g, d)| (g * d).powi(2))
            .sum();
        let nm = noise.sqrt() / dot(&across, &across);
        nm.is_finite().then_some(nm)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand_chacha::ChaCha8Rng;
    use rand_chacha::rand_core::SeedableRng;
    use rand_distr::{Distribution, StandardNormal};

    fn lamp(bands: &BandGrid) -> Vec<f64> {
        let d65 = spectra::illuminant("D65").unwrap().data;
        let nm = FilmFitting::wavelengths_nm(bands);
        nm.into_iter().map(|nm| d65.at(nm).unwrap()).collect()
    }

    fn fitting<'a>(stack: &'a Stack, lamp: &'a [f64], angle_deg: f64) -> FilmFitting<'a> {
        FilmFitting {
            stack,
            layer: 0,
            from_nm: 0.0,
            to_nm: 2000.0,
            angle: Angle::from_degrees(angle_deg).unwrap(),
            view: View::default(),
            lamp,
        }
    }

    /// XYZ of band values, accurate enough to compare colors.
    fn xyz(bands: &BandGrid, radiance: &[f64]) -> [f64; 3] {
        let mut xyz = [0.0; 3];
        for (band, value) in (0..).zip(radiance) {
            for (sum, curve) in xyz.iter_mut().zip(observer_1931()) {
                *sum += value * curve.clamped_at(bands.center_nm(band));
            }
        }
        xyz.map(|v| 0.2 * v / xyz[1])
    }

    fn found(
        fitting: &FilmFitting<'_>,
        bands: &BandGrid,
        radiance: &[f64],
        deviation: Option<&[f64]>,
    ) -> FilmFits {
        let measured = Measured {
            bands,
            radiance,
            deviation,
            xyz: xyz(bands, radiance),
        };
        fitting.fit(&measured).unwrap().unwrap()
    }

    #[test]
    fn the_thickness_of_a_known_film_is_found_at_any_angle_and_scale() {
        let stack = Stack::parse("1 | water 0nm | 1").unwrap();
        let bands = BandGrid::visible(40).unwrap();
        let lamp = lamp(&bands);
        for (nm, deg) in [(60.0, 0.0), (412.3, 0.0), (888.8, 40.0), (1500.0, 65.0)] {
            let fitting = fitting(&stack, &lamp, deg);
            let spectrum = fitting.spectrum(&bands, nm).unwrap();
            let radiance: Vec<f64> = spectrum.iter().map(|v| 3.5 * v).collect();
            let fits = found(&fitting, &bands, &radiance, None);
            let best = fits.by_shape[0];
            assert!((best.thickness_nm - nm).abs() < 1e-2, "{nm}: {best:?}");
            assert!((best.scale - 3.5).abs() < 1e-4 && best.residual < 1e-4);
            assert_eq!(fits.verdict(), Verdict::Film);
            // By color alone, other orders are near too; the right one is among the nearest.
            let by_color = fits.by_color.iter().take(3);
            assert!(
                by_color
                    .clone()
                    .any(|fit| (fit.thickness_nm - nm).abs() < 8.0),
                "{nm}: {:?}",
                fits.by_color
            );
        }
    }

    #[test]
    fn the_lamp_of_a_known_film_is_found() {
        let stack = Stack::parse("1 | water 0nm | 1").unwrap();
        let bands = BandGrid::visible(40).unwrap();
        let nm = FilmFitting::wavelengths_nm(&bands);
        let lamps = ["A", "D65", "FL11"].map(|name| {
            let table = spectra::illuminant(name).unwrap().data;
            nm.iter()
                .map(|&nm| table.at(nm).unwrap())
                .collect::<Vec<_>>()
        });
        let fittings = lamps.each_ref().map(|lamp| fitting(&stack, lamp, 20.0));
        for (right, lit) in fittings.iter().enumerate() {
            let radiance = lit.spectrum(&bands, 412.3).unwrap();
            let measured = Measured {
                bands: &bands,
                radiance: &radiance,
                deviation: None,
                xyz: xyz(&bands, &radiance),
            };
            let (lamp, fits) = nearest_fit(&fittings, &measured).unwrap().unwrap();
            assert_eq!(lamp, right);
            assert!((fits.by_shape[0].thickness_nm - 412.3).abs() < 1e-2);
            // The first of equal ones.
            let twice = [fittings[right], fittings[right]];
            assert_eq!(nearest_fit(&twice, &measured).unwrap(), Some((0, fits)));
        }
        let black = Measured {
            bands: &bands,
            radiance: &[0.0; 40],
            deviation: None,
            xyz: [0.0; 3],
        };
        assert_eq!(nearest_fit(&fittings, &black).unwrap(), None);
        assert_eq!(nearest_fit(&[], &black).unwrap(), None);
    }

    #[test]
    fn what_is_no_film_is_reported() {
        let stack = Stack::parse("1 | water 0nm | 1").unwrap();
        let bands = BandGrid::visible(40).unwrap();
        let lamp = lamp(&bands);
        let fitting = fitting(&stack, &lamp, 0.0);
        // A gray surface under the lamp.
        let gray: Vec<f64> = means(&lamp, &bands).iter().map(|v| 0.2 * v).collect();
        assert_eq!(
            found(&fitting, &bands, &gray, None).verdict(),
            Verdict::Lamp
        );
        // A saturated red, like a pigment.
        let red: Vec<f64> = (0..40)
            .map(|band| if band < 22 { 0.02 } else { 0.9 })
            .collect();
        let fits = found(&fitting, &bands, &red, None);
        assert_eq!(fits.verdict(), Verdict::Nothing, "{:?}", fits.by_shape[0]);
        // Black.
        let measured = Measured {
            bands: &bands,
            radiance: &[0.0; 40],
            deviation: None,
            xyz: [0.0; 3],
        };
        assert_eq!(fitting.fit(&measured).unwrap(), None);
    }

    /// The 24 patches of the ColorChecker in D65 are paints, not films.
    #[test]
    fn pigments_are_not_taken_for_films() {
        let stack = Stack::parse("1 | water 0nm | 1").unwrap();
        let bands = BandGrid::visible(40).unwrap();
        let lamp = lamp(&bands);
        let fitting = fitting(&stack, &lamp, 0.0);
        let nm = FilmFitting::wavelengths_nm(&bands);
        let mut films = Vec::new();
        let names = spectra::reflectance_names();
        for name in &names {
            let patch = spectra::reflectance(name).unwrap().data.clamped();
            let lit: Vec<f64> = (nm.iter().zip(&lamp))
                .map(|(&nm, power)| patch.at(nm).unwrap() * power)
                .collect();
            let fits = found(&fitting, &bands, &means(&lit, &bands), None);
            if fits.verdict() == Verdict::Film {
                films.push(*name);
            }
        }
        assert!(names.len() >= 24 && films.is_empty(), "{films:?}");
    }

    /// Noise of 1 % moves the thickness by as much as predicted.
    #[test]
    fn noise_moves_the_thickness_by_its_deviation() {
        let stack = Stack::parse("1 | water 0nm | 1").unwrap();
        let bands = BandGrid::visible(40).unwrap();
        let lamp = lamp(&bands);
        let fitting = FilmFitting {
            from_nm: 350.0,
            to_nm: 450.0,
            ..fitting(&stack, &lamp, 0.0)
        };
        let clean = fitting.spectrum(&bands, 400.0).unwrap();
        let deviation: Vec<f64> = clean.iter().map(|v| 0.01 * v + 1e-4).collect();
        let mut random = ChaCha8Rng::seed_from_u64(1);
        let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
        let (mut squares, mut foretold) = (0.0, 0.0);
        for _ in 0..40 {
            let noisy: Vec<f64> = clean
                .iter()
                .zip(&deviation)
                .map(|(v, d)| v + d * normal())
                .collect();
            let fits = found(&fitting, &bands, &noisy, Some(&deviation));
            let best = fits.by_shape[0];
            squares += (best.thickness_nm - 400.0).powi(2) / 40.0;
            foretold = best.deviation_nm.unwrap();
            assert_eq!(fits.verdict(), Verdict::Film);
            assert!((best.residual / fits.of_noise.unwrap() - 1.0).abs() < 0.5);
        }
        let ratio = squares.sqrt() / foretold;
        assert!((0.7..1.4).contains(&ratio), "{ratio}");
    }
}
