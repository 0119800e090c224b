//! Lights that an image keeps apart.

use crate::{BandGrid, Spectrum, Tabulated};

/// A named set of lights whose light an image keeps apart from that of others, so that their lamp can be changed.
#[derive(Clone, Debug, PartialEq)]
pub struct LightGroup {
    /// Its name.
    pub name: String,
    /// What its lights burn with: the spectrum at scale 1 that all of them share up to a factor, over the bands. `None` where
    /// they differ, or where nothing is known of it.
    pub lamp: Option<Tabulated>,
}

/// Words that name other things in files of spectral images: components of polarised light, transmission, our own layer.
const RESERVED: [&str; 6] = ["S0", "S1", "S2", "S3", "T", "pellicle"];

impl LightGroup {
    /// The longest name, in bytes.
    pub const MAX_NAME: usize = 32;

    /// Whether a light group may have this name: 1 to 32 ASCII letters, digits, `_` or `-`, so that it can name a layer of an
    /// image file, and none of the few words that have another meaning there (`S0` to `S3`, `T`, `pellicle`).
    pub fn is_name(name: &str) -> bool {
        let is_short = (1..=Self::MAX_NAME).contains(&name.len());
        is_short && name.bytes().all(Self::is_in_names) && !RESERVED.contains(&name)
    }

    /// Whether names may contain this byte.
    pub fn is_in_names(byte: u8) -> bool {
        byte.is_ascii_alphanumeric() || byte == b'_' || byte == b'-'
    }

    /// The only light group of an image that does not tell.
    pub fn unknown() -> Self {
        Self {
            name: "all".to_owned(),
            lamp: None,
        }
    }
}

impl BandGrid {
    /// The part of a lamp's spectrum that lies in the bands, as a table. A constant is a lamp of 1: its value is a factor.
    ///
    /// `None` where the spectrum does not cover the bands, or is a formula, which no lamp is.
    pub fn lamp(&self, spectrum: &Spectrum) -> Option<Tabulated> {
        let ends = [self.min_nm(), self.max_nm()];
        let points = match spectrum {
            Spectrum::Constant(_) => ends.map(|nm| (nm, 1.0)).to_vec(),
            Spectrum::Table(table) | Spectrum::ClampedTable(table) => {
                let inner = table
                    .points()
                    .filter(|&(nm, _)| ends[0] < nm && nm < ends[1]);
                let mut points = vec![(ends[0], spectrum.at(ends[0]).ok()?)];
                points.extend(inner);
                points.push((ends[1], spectrum.at(ends[1]).ok()?));
                points
            }
            Spectrum::Formula(_) | Spectrum::ClampedFormula(_) => return None,
        };
        Tabulated::new(points).ok()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lamp_is_the_part_of_its_table_in_the_bands() {
        let grid = BandGrid::new(402.5, 500.0, 4).unwrap();
        let table = Tabulated::new(vec![(400.0, 0.0), (405.0, 1.0), (600.0, 2.0)]).unwrap();
        let lamp = grid.lamp(&Spectrum::Table(table.clone())).unwrap();
        assert_eq!(lamp.range_nm(), (402.5, 500.0));
        for nm in [402.5, 404.0, 405.0, 450.0, 500.0] {
            assert!((lamp.at(nm).unwrap() - table.at(nm).unwrap()).abs() < 1e-12);
        }
        let ones = grid.lamp(&Spectrum::Constant(0.2)).unwrap();
        assert_eq!(ones.at(450.0), Ok(1.0));
        let short = Tabulated::new(vec![(450.0, 1.0), (600.0, 1.0)]).unwrap();
        assert_eq!(grid.lamp(&Spectrum::Table(short)), None);
    }
}
