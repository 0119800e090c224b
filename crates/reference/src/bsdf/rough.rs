//! The roughness of a boundary: its facets, and the color of multiple scattering between them.

use super::Facets;
use crate::bands::{At, Bands, Row, Tables};
use crate::layers::Coating;
use optics::MEAN_COSINES;
use optics::wide::{Lanes, Real};
use pulp::{Scalar, Simd};
use scene::Microsurface;
use scene::limits::MAX_LAYERS;

/// The facets of a rough boundary.
pub(crate) struct Rough<'a> {
    pub(crate) facets: Facets<'a>,
    /// The color of multiple scattering, where a table is accurate enough.
    color: Option<Row>,
}

impl<'a> Rough<'a> {
    pub(crate) fn new(
        tables: &mut Tables,
        coating: &Coating<'_>,
        microsurface: &'a Microsurface,
    ) -> Self {
        let facets = Facets::new(microsurface);
        let color = color_table(tables, coating, facets.mean_energy());
        Self { facets, color }
    }

    /// Returns the color of light that met several facets.
    #[inline(always)]
    pub(crate) fn color<S: Simd>(
        &self,
        coating: &Coating<'_>,
        (bands, at): (&Bands<'_, S>, At),
        nm: &[f64],
    ) -> Lanes<S> {
        match self.color {
            Some(row) => bands.spectrum(row, at),
            None => color(coating, (bands, at), nm, self.facets.mean_energy()),
        }
    }
}

/// Returns the color by its formula (see [`optics::multiple_color`]).
#[inline(always)]
fn color<S: Simd>(
    coating: &Coating<'_>,
    (bands, at): (&Bands<'_, S>, At),
    nm: &[f64],
    mean_energy: f64,
) -> Lanes<S> {
    let mut mean = bands.splat(0.0);
    for (cosine, weight) in MEAN_COSINES {
        mean = mean + coating.reflectance(bands, at, (nm, cosine)).times(weight);
    }
    optics::multiple_color(mean, mean_energy)
}

/// Tabulates the color at the tables' knots. Returns `None` where layers vary, or are so thick that the color is not linear between knots.
fn color_table(tables: &mut Tables, coating: &Coating<'_>, mean_energy: f64) -> Option<Row> {
    /// The phase of fringes then changes by 0.016 between knots of 1 nm at 400 nm, and linear interpolation is off by 3e-5 of their height.
    const THIN_NM: f64 = 200.0;
    let mut nm = [0.0; MAX_LAYERS];
    let nm = coating.layers.even_thickness_nm(&mut nm)?;
    let is_thin = coating.layers.optical_thickness_nm(tables, nm) <= THIN_NM;
    is_thin.then(|| {
        tables
            .push_from(|bands: &Bands<'_, Scalar>, at| color(coating, (bands, at), nm, mean_energy))
    })
}
