//! Charts of the color of a stack over the thickness of one layer and the angle, like Newton's chart, for any stack.

use crate::plot::{exposure, polarization};
use crate::response::Angle;
use crate::stack_color::{Side, StackColor};
use colorimetry::srgb;
use picture_file::RgbImage8;
use plot::{ColorMap, MapAxis};
use spectra::knot_before;

/// A chart of the color of a stack over the thickness of one layer and the angle of incidence.
#[derive(Clone, Debug)]
pub struct Chart {
    title: String,
    axis: String,
    footer: String,
    nominal_nm: f64,
    range_nm: (f64, f64),
    range_deg: (f64, f64),
    /// Linear sRGB, column by column, one thickness per column.
    cells: Vec<[f64; 3]>,
}

/// The description of a chart.
#[derive(Clone, Debug)]
pub struct ChartOf {
    /// Title above the chart: the stack.
    pub title: String,
    /// Index of the layer that varies, from 0.
    pub layer: usize,
    /// Name of the layer's material.
    pub layer_label: String,
    /// Range of its thickness, nm.
    pub range_nm: (f64, f64),
    /// Range of the angle.
    pub angles: (Angle, Angle),
    /// The colors are shown 2^EV times as bright.
    pub exposure_ev: f64,
}

/// Number of thicknesses and angles at which the color is computed. Linear RGB is interpolated linearly between them.
const COLUMNS: usize = 601;
const ROWS: usize = 86;

impl Chart {
    /// Computes the colors of a chart.
    ///
    /// # Panics
    /// If the layer does not exist, or `thicknesses_nm` does not have one thickness per layer.
    pub fn new(stack: &StackColor, thicknesses_nm: &[f64], of: &ChartOf) -> Self {
        let range_deg = (of.angles.0.degrees(), of.angles.1.degrees());
        let set = |column: usize| {
            let mut thicknesses = thicknesses_nm.to_vec();
            thicknesses[of.layer] = along(of.range_nm, share(column, COLUMNS));
            thicknesses
        };
        // A value between two valid angles is a valid angle.
        let angle = |row: usize| {
            Angle::from_degrees(along(range_deg, share(row, ROWS))).unwrap_or(of.angles.1)
        };
        let sets: Vec<Vec<f64>> = (0..COLUMNS).map(set).collect();
        let angles: Vec<Angle> = (0..ROWS).map(angle).collect();
        let colors = stack.xyz_of_all(&sets, &angles).into_iter();
        let rgb = |xyz| stack.color(xyz).linear_srgb(of.exposure_ev);
        let side = match stack.view().side {
            Side::Reflected => "reflected",
            Side::Transmitted => "transmitted",
        };
        Self {
            title: of.title.clone(),
            axis: format!(
                "thickness of layer {}, {} / nm",
                of.layer + 1,
                of.layer_label
            ),
            footer: format!(
                "{}, {side}, under {}; sRGB at exposure {}, clipped to its gamut",
                polarization(stack.view().polarization),
                stack.light().name(),
                exposure(of.exposure_ev)
            ),
            nominal_nm: thicknesses_nm[of.layer],
            range_nm: of.range_nm,
            range_deg,
            cells: colors.map(rgb).collect(),
        }
    }

    /// Draws the chart as pixels.
    pub fn pixels(&self) -> RgbImage8 {
        let map = ColorMap {
            title: &self.title,
            x: MapAxis {
                name: &self.axis,
                range: self.range_nm,
            },
            y: MapAxis {
                name: "angle of incidence / °",
                range: self.range_deg,
            },
            marked: self.nominal_nm,
            footer: &self.footer,
            color: &|x, y| self.codes(x, y),
        };
        map.pixels()
    }

    /// Codes at a position between 0 and 1 from the left and from the bottom.
    fn codes(&self, x: f64, y: f64) -> [u8; 3] {
        let (column, u) = knot_before(x.clamp(0.0, 1.0), COLUMNS);
        let (row, v) = knot_before(y.clamp(0.0, 1.0), ROWS);
        let cell = |r: usize, c: usize| self.cells[(column + c) * ROWS + row + r];
        let (c00, c01, c10, c11) = (cell(0, 0), cell(0, 1), cell(1, 0), cell(1, 1));
        std::array::from_fn(|i| {
            let low = c00[i] + u * (c01[i] - c00[i]);
            let high = c10[i] + u * (c11[i] - c10[i]);
            srgb::to_u8(low + v * (high - low))
        })
    }
}

/// Returns the position from 0 to 1 of one of several equidistant points.
fn share(index: usize, points: usize) -> f64 {
    index as f64 / (points - 1) as f64
}

fn along((from, to): (f64, f64), t: f64) -> f64 {
    from + (to - from) * t
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Light, Stack, View};

    fn soap() -> (StackColor, ChartOf) {
        let stack = Stack::parse("1 | 1.333 300nm | 1").unwrap();
        let light = Light::named("D65").unwrap();
        let color = StackColor::new(&stack, light, View::default()).unwrap();
        let of = ChartOf {
            title: stack.label_with_varied(0),
            layer: 0,
            layer_label: "1.333".to_owned(),
            range_nm: (0.0, 1200.0),
            angles: (Angle::NORMAL, Angle::from_degrees(85.0).unwrap()),
            exposure_ev: 3.0,
        };
        (color, of)
    }

    /// The color is right even between the points at which it was computed.
    #[test]
    fn every_place_has_the_color_of_its_thickness_and_angle() {
        let (color, of) = soap();
        let chart = Chart::new(&color, &[300.0], &of);
        for (nm, deg) in [
            (0.0, 0.0),
            (300.0, 0.0),
            (731.3, 42.7),
            (1200.0, 85.0),
            (401.0, 84.5),
        ] {
            let angle = Angle::from_degrees(deg).unwrap();
            let expected = color.at(&[nm], angle).srgb8(3.0);
            let [r, g, b] = chart.codes(nm / 1200.0, deg / 85.0);
            for (found, expected) in [r, g, b].into_iter().zip(expected) {
                assert!(
                    found.abs_diff(expected) <= 1,
                    "{nm} nm, {deg}°: {found} {expected}"
                );
            }
        }
    }

    #[test]
    fn the_picture_is_the_same_each_time_and_has_the_colors() {
        let (color, of) = soap();
        let chart = Chart::new(&color, &[300.0], &of);
        let picture = chart.pixels();
        assert_eq!((picture.width(), picture.height()), (1800, 1040));
        assert_eq!(picture, chart.pixels());
        let [r, g, b] = chart.codes(0.5, 0.5);
        let near = |pixel: &[u8]| pixel.iter().zip([r, g, b]).all(|(a, b)| a.abs_diff(b) <= 2);
        assert!(picture.data().chunks(3).any(near));
        assert_eq!(picture.pixel(0, 0), Some([255; 3]));
    }
}
