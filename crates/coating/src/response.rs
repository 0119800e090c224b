//! Response of a stack: R, T and A over wavelength at an angle.

pub(crate) use crate::angle::Angle;
use crate::model::{Model, TwoBeamFilm};
use optics::batch::{LayerOf, Media, Powers, StackBatch, StackOf, evaluate};
use optics::{Complex64, Layer, Polarized, ThicknessDerivative};
use rayon::prelude::*;

/// A stack at chosen wavelengths: only numbers, no names or tables. Thicknesses and angles are given when it is evaluated.
#[derive(Clone, Debug, PartialEq)]
pub struct Sampled {
    wavelengths_nm: Vec<f64>,
    incident: Vec<f64>,
    /// One index per wavelength for each layer.
    layers: Vec<Vec<Complex64>>,
    substrate: Vec<Complex64>,
    model: Model,
}

/// Returns the absorptance A = 1 − R − T of a whole stack.
pub fn absorptance(powers: Powers) -> Polarized {
    let (r, t) = (powers.reflectance, powers.transmittance);
    Polarized {
        s: 1.0 - r.s - t.s,
        p: 1.0 - r.p - t.p,
    }
}

/// The arrays of a [`StackBatch`] of stacks that differ only in their thicknesses.
#[derive(Clone, Debug, PartialEq)]
pub struct Batch {
    wavelengths_nm: Vec<f64>,
    cosines: Vec<f64>,
    media: Vec<Complex64>,
    layers: Vec<LayerOf>,
    stacks: Vec<StackOf>,
}

impl Batch {
    /// Returns the batch for evaluation. Indices and wavelengths are in units of the incident index.
    pub fn as_batch(&self) -> StackBatch<'_> {
        StackBatch {
            wavelengths_nm: &self.wavelengths_nm,
            cosines: &self.cosines,
            incident: 1.0,
            media: Media::Dispersive(&self.media),
            layers: &self.layers,
            stacks: &self.stacks,
        }
    }
}

impl Sampled {
    pub(crate) fn new(
        wavelengths_nm: Vec<f64>,
        incident: Vec<f64>,
        layers: Vec<Vec<Complex64>>,
        substrate: Vec<Complex64>,
    ) -> Self {
        Self {
            wavelengths_nm,
            incident,
            layers,
            substrate,
            model: Model::Exact,
        }
    }

    /// Sets the model. `Stack` has checked that two beams are defined for the stack.
    pub(crate) fn with_model(self, model: Model) -> Self {
        Self { model, ..self }
    }

    /// The formula for R and T.
    pub fn model(&self) -> Model {
        self.model
    }

    /// Returns the stack at wavelengths between its own. Each is given in nm, with the number of its own wavelength before it and the
    /// fraction of the way to the next, from 0 to 1. Indices are interpolated linearly.
    pub(crate) fn between(&self, places: impl Iterator<Item = (f64, (usize, f64))>) -> Self {
        let (wavelengths_nm, places): (Vec<f64>, Vec<(usize, f64)>) = places.unzip();
        let indices = |own: &Vec<Complex64>| {
            let at =
                |&(step, along): &(usize, f64)| own[step] + (own[step + 1] - own[step]) * along;
            places.iter().map(at).collect::<Vec<_>>()
        };
        let incident = |&(step, along): &(usize, f64)| {
            let [a, b] = [step, step + 1].map(|step| self.incident[step]);
            a + (b - a) * along
        };
        Self {
            wavelengths_nm,
            incident: places.iter().map(incident).collect(),
            layers: self.layers.iter().map(indices).collect(),
            substrate: indices(&self.substrate),
            model: self.model,
        }
    }

    /// The wavelengths, nm.
    pub fn wavelengths_nm(&self) -> &[f64] {
        &self.wavelengths_nm
    }

    /// The incident medium's real index at each wavelength.
    pub fn incident(&self) -> &[f64] {
        &self.incident
    }

    /// The index n + ik of each layer at each wavelength.
    pub fn layers(&self) -> &[Vec<Complex64>] {
        &self.layers
    }

    /// The substrate's index n + ik at each wavelength.
    pub fn substrate(&self) -> &[Complex64] {
        &self.substrate
    }

    /// Returns R and T at each wavelength, with these thicknesses (nm, one per layer).
    ///
    /// # Panics
    /// If there is not one thickness per layer.
    pub fn powers(&self, thicknesses_nm: &[f64], angle: Angle) -> Vec<Powers> {
        self.each(thicknesses_nm, |n0, layers, substrate, nm| {
            if let Some(film) = self.two_beams(n0, layers, nm) {
                return film.powers(angle);
            }
            let found = optics::stack(n0, layers, substrate, nm, angle.cosine());
            Powers {
                reflectance: found.reflectance,
                transmittance: found.transmittance,
            }
        })
    }

    /// Returns the stack with many sets of thicknesses at many angles, as a batch for any evaluator. The evaluation is exact, whatever
    /// the model is.
    ///
    /// # Panics
    /// If there is not one thickness per layer.
    pub fn batch(&self, sets: &[Vec<f64>], angles: &[Angle]) -> Batch {
        let count = self.layers.len();
        let layers = sets.iter().flat_map(|thicknesses_nm| {
            assert_eq!(thicknesses_nm.len(), count, "one thickness per layer");
            let numbered = (0..).zip(thicknesses_nm);
            numbered.map(|(medium, &thickness_nm)| LayerOf {
                medium,
                thickness_nm,
            })
        });
        let stack = |set: usize| StackOf {
            substrate: count as u32,
            first_layer: (set * count) as u32,
            layer_count: count as u32,
        };
        // Only ratios of indices and the phase n d / λ matter, so everything can be in units of the incident index, which a batch
        // has once for all wavelengths.
        let relative = |indices: &[Complex64]| -> Vec<Complex64> {
            let pairs = indices.iter().zip(&self.incident);
            pairs.map(|(n, n0)| n / n0).collect()
        };
        let media = self.layers.iter().chain([&self.substrate]);
        let wavelengths = self.wavelengths_nm.iter().zip(&self.incident);
        Batch {
            wavelengths_nm: wavelengths.map(|(nm, n0)| nm / n0).collect(),
            cosines: angles.iter().map(|angle| angle.cosine()).collect(),
            media: media.flat_map(|indices| relative(indices)).collect(),
            layers: layers.collect(),
            stacks: (0..sets.len()).map(stack).collect(),
        }
    }

    /// Returns R and T with many sets of thicknesses at many angles, on all cores, as `[set][angle][wavelength]`: the same
    /// numbers as [`Self::powers`], except for the last digits.
    ///
    /// # Panics
    /// If there is not one thickness per layer, finite and not negative.
    pub fn powers_of_all(&self, sets: &[Vec<f64>], angles: &[Angle]) -> Vec<Powers> {
        if self.model != Model::Exact {
            let films = sets
                .iter()
                .flat_map(|set| angles.iter().map(move |&angle| (set, angle)));
            let films: Vec<_> = films.collect();
            let powers = films
                .par_iter()
                .flat_map_iter(|&(set, angle)| self.powers(set, angle));
            return powers.collect();
        }
        match evaluate(&self.batch(sets, angles).as_batch()) {
            Ok(powers) => powers,
            // The indices of a stack and the cosine of an angle are in the batch's domain.
            Err(error) => panic!("{error}"),
        }
    }

    /// Returns the absorptance of each layer at each wavelength: R + T + ΣA = 1. It is exact, whatever the model is, since two beams
    /// have no absorptance.
    ///
    /// # Panics
    /// If there is not one thickness per layer.
    pub fn absorptances(&self, thicknesses_nm: &[f64], angle: Angle) -> Vec<Vec<Polarized>> {
        self.each(thicknesses_nm, |n0, layers, substrate, nm| {
            optics::absorptance(n0, layers, substrate, nm, angle.cosine())
        })
    }

    /// Returns ∂R/∂d and ∂T/∂d of each layer at each wavelength, per nm.
    ///
    /// # Panics
    /// If there is not one thickness per layer.
    pub fn derivatives(
        &self,
        thicknesses_nm: &[f64],
        angle: Angle,
    ) -> Vec<Vec<ThicknessDerivative>> {
        self.each(thicknesses_nm, |n0, layers, substrate, nm| {
            if let Some(film) = self.two_beams(n0, layers, nm) {
                return vec![film.derivative(angle)];
            }
            optics::thickness_derivatives(n0, layers, substrate, nm, angle.cosine())
        })
    }

    /// The film for the two-beam model, if that is the model.
    fn two_beams(&self, around: f64, layers: &[Layer], wavelength_nm: f64) -> Option<TwoBeamFilm> {
        let (Model::TwoBeam(path), [film]) = (self.model, layers) else {
            return None;
        };
        Some(TwoBeamFilm {
            path,
            around,
            index: film.index.re,
            thickness_nm: film.thickness_nm,
            wavelength_nm,
        })
    }

    /// Evaluates a function of the incident index, layers, substrate and wavelength at each wavelength.
    pub(crate) fn each<T>(
        &self,
        thicknesses_nm: &[f64],
        of: impl Fn(f64, &[Layer], Complex64, f64) -> T,
    ) -> Vec<T> {
        let (given, needed) = (thicknesses_nm.len(), self.layers.len());
        assert_eq!(given, needed, "one thickness per layer");
        let layer = |&thickness_nm: &f64| Layer {
            index: Complex64::ONE,
            thickness_nm,
        };
        let mut layers: Vec<Layer> = thicknesses_nm.iter().map(layer).collect();
        let at = |(w, &nm): (usize, &f64)| {
            for (layer, indices) in layers.iter_mut().zip(&self.layers) {
                layer.index = indices[w];
            }
            of(self.incident[w], &layers, self.substrate[w], nm)
        };
        self.wavelengths_nm.iter().enumerate().map(at).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Stack;

    #[test]
    fn many_at_once_are_the_same_as_each_alone() {
        let stack = Stack::parse("air | titania 60nm | silica 90nm | gold 8nm | bk7").unwrap();
        let nm: Vec<f64> = (380..=780).step_by(25).map(f64::from).collect();
        let sampled = stack.sampled(&nm).unwrap();
        let sets = [
            vec![60.0, 90.0, 8.0],
            vec![0.0, 1000.0, 30.0],
            vec![3.0, 0.0, 0.0],
        ];
        let angles = [0.0, 45.0, 89.0].map(|deg| Angle::from_degrees(deg).unwrap());
        let all = sampled.powers_of_all(&sets, &angles);
        let each = sets
            .iter()
            .flat_map(|set| angles.map(|angle| sampled.powers(set, angle)));
        for (at_once, alone) in all.iter().zip(each.flatten()) {
            for (a, b) in [
                (at_once.reflectance.s, alone.reflectance.s),
                (at_once.reflectance.p, alone.reflectance.p),
                (at_once.transmittance.s, alone.transmittance.s),
                (at_once.transmittance.p, alone.transmittance.p),
            ] {
                assert!((a - b).abs() < 1e-12, "{a} {b}");
            }
        }
        assert_eq!(all.len(), 3 * 3 * nm.len());
    }

    #[test]
    fn absorptances_of_the_layers_make_up_that_of_the_stack() {
        let stack = Stack::parse("1 | 2.0+0.1i 60nm | gold 8nm | 1.5").unwrap();
        let sampled = stack.sampled(&[450.0, 650.0]).unwrap();
        let angle = Angle::from_degrees(50.0).unwrap();
        let powers = sampled.powers(stack.thicknesses_nm(), angle);
        let layers = sampled.absorptances(stack.thicknesses_nm(), angle);
        for (powers, layers) in powers.into_iter().zip(layers) {
            let sum: f64 = layers.iter().map(|a| a.p).sum();
            assert!((absorptance(powers).p - sum).abs() < 1e-14 && sum > 0.1);
        }
    }
}
