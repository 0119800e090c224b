//! Films and coatings where a path meets them.

use crate::{SurfacePoint, layer_thickness};
use optics::{Complex64, Polarised};
use scene::{Interference, Layer, PathDifference, Shape, SpectrumId};

/// Nothing is seen at a smaller cosine; the bound keeps a grazing ray finite.
const GRAZING: f64 = 1e-6;

/// Layers at a point of their surface.
pub(crate) struct LayersAt<'a> {
    layers: &'a [Layer],
    thickness_nm: Vec<f64>,
    cosine: f64,
    is_front: bool,
}

/// What a path brings: its wavelength in a band, and the indices there.
pub(crate) struct Light<F> {
    pub(crate) wavelength_nm: f64,
    pub(crate) index: F,
}

impl<'a> LayersAt<'a> {
    pub(crate) fn new(layers: &'a [Layer], shape: &Shape, point: &SurfacePoint) -> Self {
        let thickness = |layer: &Layer| layer_thickness(&layer.thickness, shape, point.position);
        Self {
            layers,
            thickness_nm: layers.iter().map(thickness).collect(),
            cosine: point.cosine.max(GRAZING),
            is_front: point.is_front,
        }
    }

    /// Hands the layers to `f` with their indices at a wavelength. Most films have one layer, which needs no list on the heap.
    fn at<F: Fn(SpectrumId, SpectrumId) -> Complex64, R>(
        &self,
        light: &Light<F>,
        f: impl FnOnce(&mut [optics::Layer]) -> R,
    ) -> R {
        let optical = |(layer, &thickness_nm): (&Layer, &f64)| optics::Layer {
            index: (light.index)(layer.n, layer.k),
            thickness_nm,
        };
        match (self.layers, self.thickness_nm.as_slice()) {
            ([layer], [thickness_nm]) => f(&mut [optical((layer, thickness_nm))]),
            (layers, nm) => f(&mut layers.iter().zip(nm).map(optical).collect::<Vec<_>>()),
        }
    }

    /// Reflectance on a conductor of index `substrate`, at the cosine of the surface or of one of its facets.
    pub(crate) fn on<F: Fn(SpectrumId, SpectrumId) -> Complex64>(
        &self,
        substrate: Complex64,
        cosine: f64,
        light: &Light<F>,
    ) -> f64 {
        let cosine = cosine.max(GRAZING);
        self.at(light, |layers| {
            let stack = optics::stack(1.0, layers, substrate, light.wavelength_nm, cosine);
            stack.reflectance.unpolarised()
        })
    }

    /// Reflectance and transmittance between air and air.
    pub(crate) fn free<F: Fn(SpectrumId, SpectrumId) -> Complex64>(
        &self,
        interference: Interference,
        light: &Light<F>,
    ) -> (f64, f64) {
        self.at(light, |layers| {
            let both = |r: Polarised, t: Polarised| (r.unpolarised(), t.unpolarised());
            if let Interference::TwoBeam(path_difference) = interference {
                let (n, nm) = (layers[0].index.re, layers[0].thickness_nm);
                let path_difference = match path_difference {
                    PathDifference::Optical => optics::PathDifference::Optical,
                    PathDifference::AsPrinted => optics::PathDifference::AsPrinted,
                };
                let beams =
                    optics::two_beam(n, nm, light.wavelength_nm, self.cosine, path_difference);
                return both(beams.reflectance, beams.transmittance);
            }
            if !self.is_front {
                layers.reverse();
            }
            let air = Complex64::ONE;
            let stack = optics::stack(1.0, layers, air, light.wavelength_nm, self.cosine);
            both(stack.reflectance, stack.transmittance)
        })
    }
}
