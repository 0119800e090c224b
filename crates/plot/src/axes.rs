//! Two axes: their ranges, labels and grid.

use crate::picture::{Drawn, FAINT, INK, Scale};
use plotters::coord::Shift;
use plotters::coord::ranged1d::{BoldPoints, DefaultFormatting, KeyPointHint, Ranged};
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;

/// Coordinates of a drawing with two axes.
pub(crate) type Plane = Cartesian2d<RangedCoordf64, Ticked>;

/// A coordinate whose labels are at given values.
pub(crate) struct Ticked {
    coordinate: RangedCoordf64,
    ticks: Vec<f64>,
}

impl Ranged for Ticked {
    type FormatOption = DefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, limit: (i32, i32)) -> i32 {
        self.coordinate.map(value, limit)
    }

    fn key_points<Hint: KeyPointHint>(&self, _: Hint) -> Vec<f64> {
        self.ticks.clone()
    }

    fn range(&self) -> std::ops::Range<f64> {
        self.coordinate.range()
    }
}

/// An axis.
pub(crate) struct Axis<'a> {
    /// What is at its ends.
    pub(crate) range: (f64, f64),
    /// What it shows, with the unit.
    pub(crate) name: &'a str,
    /// Its labels.
    pub(crate) labels: Labels,
}

/// The labels of an axis.
pub(crate) struct Labels {
    /// Maximum number.
    pub(crate) most: usize,
    /// Minimum number of decimals.
    pub(crate) decimals: usize,
}

/// Two axes, and the space around them in units. There is always the same space at the left.
pub(crate) struct Axes<'a> {
    pub(crate) x: Axis<'a>,
    pub(crate) y: Axis<'a>,
    /// The step between the labels of the vertical axis, which starts at 0; `None` for a round one.
    pub(crate) y_step: Option<f64>,
    /// Whether the horizontal axis has its name and labels. Without them, another one stands below it.
    pub(crate) names_x: bool,
    /// Whether lines continue the ticks.
    pub(crate) grid: bool,
    /// Space above.
    pub(crate) above: f64,
    /// Space at the right.
    pub(crate) right: f64,
    /// Height of name and labels below.
    pub(crate) below: f64,
}

impl Axes<'_> {
    /// Reserves the space for the axes, without drawing them.
    pub(crate) fn on<'b, B: DrawingBackend>(
        &self,
        area: &DrawingArea<B, Shift>,
        scale: Scale,
    ) -> Result<ChartContext<'b, B, Plane>, DrawingAreaErrorKind<B::ErrorType>> {
        ChartBuilder::on(area)
            .margin_top(scale.px(self.above))
            .margin_left(scale.px(14.0))
            .margin_right(scale.px(self.right))
            .set_label_area_size(LabelAreaPosition::Left, scale.px(66.0))
            .set_label_area_size(LabelAreaPosition::Bottom, scale.px(self.below))
            .build_cartesian_2d(
                self.x.range.0..self.x.range.1,
                Ticked {
                    coordinate: (self.y.range.0..self.y.range.1).into(),
                    ticks: self.y_ticks(),
                },
            )
    }

    /// The values of the labels of the vertical axis.
    fn y_ticks(&self) -> Vec<f64> {
        let Some(step) = self.y_step else {
            return self.y.ticks();
        };
        let count = (self.y.range.1 / step + 1e-9) as u32;
        (0..=count).map(|tick| f64::from(tick) * step).collect()
    }

    /// Draws the axes with their names, labels and grid.
    pub(crate) fn draw<B: DrawingBackend>(
        &self,
        chart: &mut ChartContext<'_, B, Plane>,
        scale: Scale,
    ) -> Drawn<B> {
        let [x_decimals, y_decimals] = [(&self.x, self.x.ticks()), (&self.y, self.y_ticks())]
            .map(|(axis, ticks)| decimals(axis.range, &ticks, axis.labels.decimals));
        let x_label = |value: &f64| {
            if self.names_x {
                format!("{value:.x_decimals$}")
            } else {
                String::new()
            }
        };
        let y_label = |value: &f64| format!("{value:.y_decimals$}");
        let mut mesh = chart.configure_mesh();
        if !self.grid {
            mesh.disable_mesh();
        }
        mesh.axis_style(scale.line(INK, 1.0))
            .bold_line_style(scale.line(FAINT, 0.8))
            .light_line_style(TRANSPARENT)
            .set_all_tick_mark_size(scale.px(4.0))
            .label_style(scale.text(13.0))
            .axis_desc_style(scale.text(14.0))
            .x_desc(if self.names_x { self.x.name } else { "" })
            .y_desc(self.y.name)
            .x_labels(self.x.labels.most)
            .y_labels(self.y.labels.most)
            .x_label_formatter(&x_label)
            .y_label_formatter(&y_label)
            .draw()
    }
}

impl Axis<'_> {
    /// The values of its labels, in round steps.
    fn ticks(&self) -> Vec<f64> {
        round_ticks(self.range, self.labels.most)
    }
}

/// Returns a range of round numbers around `low` to `high`, from 0 if the values come near it.
pub(crate) fn round_range(low: f64, high: f64) -> (f64, f64) {
    let low = if low < 0.4 * high { 0.0 } else { low };
    let span = (high - low).max(1e-3);
    let size = 10.0_f64.powf((span / 5.0).log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0]
        .map(|m| m * size)
        .into_iter()
        .find(|step| span / step <= 5.0)
        .unwrap_or(10.0 * size);
    let first = (low / step + 1e-9).floor() * step;
    let last = (high / step - 1e-9).ceil() * step;
    (first, last.max(first + step))
}

/// Returns at most `most` values for the labels of an axis, in round steps.
fn round_ticks((from, to): (f64, f64), most: usize) -> Vec<f64> {
    RangedCoordf64::from(from..to).key_points(BoldPoints(most))
}

/// Returns the number of decimals for the labels of an axis, at least `least`: as many as their steps have.
fn decimals((from, to): (f64, f64), ticks: &[f64], least: usize) -> usize {
    let step = ticks
        .windows(2)
        .map(|pair| pair[1] - pair[0])
        .fold(to - from, f64::min);
    let is_distinct = |decimals: &usize| {
        let unit = 10.0_f64.powi(*decimals as i32);
        let is_exact = |tick: &f64| ((tick * unit).round() / unit - tick).abs() < 1e-3 * step;
        ticks.iter().all(is_exact)
    };
    (least..12).find(is_distinct).unwrap_or(12)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_differ() {
        let least = |range, most, least| decimals(range, &round_ticks(range, most), least);
        assert_eq!(least((380.0, 780.0), 9, 0), 0);
        assert_eq!(least((0.0, 1.0), 6, 2), 2);
        for range in [(500.0, 502.0), (0.0, 1e-3), (0.92, 0.93), (380.0, 380.001)] {
            let ticks = round_ticks(range, 6);
            let decimals = decimals(range, &ticks, 0);
            let labels: std::collections::BTreeSet<String> = ticks
                .iter()
                .map(|tick| format!("{tick:.decimals$}"))
                .collect();
            assert!(labels.len() == ticks.len() && ticks.len() > 2, "{labels:?}");
        }
    }

    #[test]
    fn ranges_are_round_and_hold_their_values() {
        assert_eq!(round_range(0.0, 0.078), (0.0, 0.08));
        assert_eq!(round_range(0.921, 1.0), (0.92, 1.0));
        assert_eq!(round_range(0.0, 0.0).0, 0.0);
        for (low, high) in [(0.3, 0.31), (0.0, 1e-6), (0.5, 0.5), (0.02, 0.97)] {
            let (first, last) = round_range(low, high);
            assert!(
                first <= low && high <= last && first < last,
                "{first} {last}"
            );
        }
    }
}
