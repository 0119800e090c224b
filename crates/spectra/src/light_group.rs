//! Light groups: emitters whose light an image keeps apart.

use crate::{BandGrid, BandTable, Spectrum, Tabulated};

/// A named set of emitters whose light an image keeps apart, so that their illuminant can be changed.
#[derive(Clone, Debug, PartialEq)]
pub struct LightGroup {
    /// The name of the group.
    pub name: String,
    /// Illuminant of the group: the spectrum at scale 1, over the bands, that all its emitters share up to a factor, as
    /// returned by [`BandGrid::lamp`]. `None` if they differ, or if it is unknown.
    pub lamp: Option<Tabulated>,
}

/// Words with other meanings in files of spectral images: components of polarized light, transmission, Pellicle's own layer.
const RESERVED: [&str; 6] = ["S0", "S1", "S2", "S3", "T", "pellicle"];

impl LightGroup {
    /// The longest name, in bytes.
    pub const MAX_NAME: usize = 32;

    /// Whether a light group may have this name: 1 to 32 ASCII letters, digits, `_` or `-`, so that it can name a layer of an
    /// image file, but not one of the few words with another meaning there (`S0` to `S3`, `T`, `pellicle`).
    pub fn is_name(name: &str) -> bool {
        let is_short = (1..=Self::MAX_NAME).contains(&name.len());
        is_short && name.bytes().all(Self::is_in_names) && !RESERVED.contains(&name)
    }

    /// Whether names may contain this byte.
    pub fn is_in_names(byte: u8) -> bool {
        byte.is_ascii_alphanumeric() || byte == b'_' || byte == b'-'
    }

    /// The only light group of an image that does not record any.
    pub fn unknown() -> Self {
        Self {
            name: "all".to_owned(),
            lamp: None,
        }
    }
}

impl BandGrid {
    /// Returns an illuminant as a render over the bands uses it: its values at the knots of a [`BandTable`], linear between them.
    /// A render does not see features between two knots. A constant becomes 1, because its value is a factor.
    ///
    /// `None` if the spectrum does not cover the bands, or is a formula, which an illuminant never is.
    pub fn lamp(&self, spectrum: &Spectrum) -> Option<Tabulated> {
        let points = match spectrum {
            Spectrum::Constant(_) => [self.min_nm(), self.max_nm()].map(|nm| (nm, 1.0)).to_vec(),
            Spectrum::Table(_) | Spectrum::ClampedTable(_) => {
                let knot = |nm| Some((nm, spectrum.at(nm).ok()?));
                let points: Option<Vec<_>> = self.knots_nm().map(knot).collect();
                without_collinear(&points?)
            }
            Spectrum::Formula(_) | Spectrum::ClampedFormula(_) => return None,
        };
        Tabulated::new(points).ok()
    }

    /// The knots of a [`BandTable`] in rising order; neighboring bands share one.
    fn knots_nm(&self) -> impl Iterator<Item = f64> + '_ {
        let steps = BandTable::steps_of(self);
        let offset = move |step| f64::from(step) / f64::from(steps);
        let of_band = move |band| (0..steps).map(move |step| (band, offset(step)));
        let inner = (0..self.count()).flat_map(of_band);
        inner
            .chain([(self.count() - 1, 1.0)])
            .map(|(band, offset)| self.wavelength_nm(band, offset))
    }
}

/// Removes the points that lie on the line between their neighbors, up to rounding, so that a table at 5 nm keeps its size.
fn without_collinear(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let peak = points.iter().fold(0.0_f64, |peak, p| peak.max(p.1.abs()));
    let mut kept: Vec<(f64, f64)> = Vec::new();
    for (index, &(nm, value)) in points.iter().enumerate() {
        if let (Some(&(low_nm, low)), Some(&(high_nm, high))) = (kept.last(), points.get(index + 1))
        {
            let line = low + (high - low) * (nm - low_nm) / (high_nm - low_nm);
            if (value - line).abs() <= 1e-13 * peak {
                continue;
            }
        }
        kept.push((nm, value));
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A spectral line at 450.2 nm, between knots 0.9375 nm apart, on a slope.
    fn line() -> Spectrum {
        let points = vec![
            (400.0, 0.5),
            (449.5, 1.0),
            (450.2, 9.0),
            (451.3, 1.0),
            (600.0, 2.0),
        ];
        Spectrum::Table(Tabulated::new(points).unwrap())
    }

    #[test]
    fn a_lamp_is_what_a_render_samples() {
        let grid = BandGrid::new(402.5, 500.0, 4).unwrap();
        let lamp = grid.lamp(&line()).unwrap();
        assert_eq!(lamp.range_nm(), (402.5, 500.0));
        let table = BandTable::new(&grid, &line()).unwrap();
        for (band, i) in (0..4).flat_map(|band| (0..=1000).map(move |i| (band, i))) {
            let offset = f64::from(i) / 1000.0;
            let nm = grid.wavelength_nm(band, offset);
            let found = lamp.clamped_at(nm);
            assert!((found - table.at(band, offset)).abs() < 1e-10, "{nm}");
        }
        // The line's peak is not among the knots, and no knot is needed on the slopes.
        assert!((lamp.at(450.2).unwrap() - line().at(450.2).unwrap()).abs() > 0.5);
        assert!(lamp.points().len() < 10, "{lamp:?}");
        assert_eq!(grid.lamp(&Spectrum::Table(lamp.clone())), Some(lamp));
    }

    #[test]
    fn a_table_whose_points_are_knots_keeps_them() {
        let grid = BandGrid::visible(40).unwrap();
        let fl11 = crate::illuminant("FL11").unwrap().data;
        let lamp = grid.lamp(&fl11).unwrap();
        assert!(lamp.points().len() <= 81, "{}", lamp.points().len());
        for nm in (380..=780).map(f64::from) {
            assert!((lamp.at(nm).unwrap() - fl11.at(nm).unwrap()).abs() < 1e-12);
        }
    }

    #[test]
    fn constants_are_ones_and_short_tables_no_lamps() {
        let grid = BandGrid::new(402.5, 500.0, 4).unwrap();
        let ones = grid.lamp(&Spectrum::Constant(0.2)).unwrap();
        assert_eq!(ones.at(450.0), Ok(1.0));
        let short = Tabulated::new(vec![(450.0, 1.0), (600.0, 1.0)]).unwrap();
        assert_eq!(grid.lamp(&Spectrum::Table(short)), None);
    }
}
