//! Maps of colors over two axes.

use crate::axes::{Axes, Axis, Labels};
use crate::picture::{self, Drawing, Drawn, INK, Scale};
use crate::title::draw_title;
use picture_file::RgbImage8;
use plotters::coord::Shift;
use plotters::prelude::*;

/// A map of colors over two axes.
pub struct ColorMap<'a> {
    /// Title above the map.
    pub title: &'a str,
    /// The horizontal axis.
    pub x: MapAxis<'a>,
    /// The vertical axis.
    pub y: MapAxis<'a>,
    /// A value on the horizontal axis that is marked above the map, if it is in the range.
    pub marked: f64,
    /// Text below the map.
    pub footer: &'a str,
    /// Codes of the color at a position between 0 and 1 from the left and from the bottom.
    pub color: &'a dyn Fn(f64, f64) -> [u8; 3],
}

/// An axis of a map.
#[derive(Clone, Copy, Debug)]
pub struct MapAxis<'a> {
    /// What it shows, with the unit.
    pub name: &'a str,
    /// What is at its ends.
    pub range: (f64, f64),
}

impl<'a> MapAxis<'a> {
    fn with_labels(self, most: usize) -> Axis<'a> {
        Axis {
            range: self.range,
            name: self.name,
            labels: Labels { most, decimals: 0 },
        }
    }
}

impl ColorMap<'_> {
    /// Draws the map as pixels.
    pub fn pixels(&self) -> RgbImage8 {
        picture::pixels(self)
    }

    fn axes(&self) -> Axes<'_> {
        Axes {
            x: self.x.with_labels(11),
            y: self.y.with_labels(10),
            y_step: None,
            names_x: true,
            grid: false,
            above: 14.0,
            right: 24.0,
            below: 48.0,
        }
    }

    /// Paints the colors in squares of half a unit, which are the pixels of a PNG.
    fn paint<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>, scale: Scale) -> Drawn<B> {
        let (width, height) = area.dim_in_pixel();
        let side = scale.px(0.5).max(1);
        let middle = |at: i32, size: u32| (f64::from(at) + 0.5 * f64::from(side)) / f64::from(size);
        for y in (0..height as i32).step_by(side as usize) {
            for x in (0..width as i32).step_by(side as usize) {
                let [r, g, b] = (self.color)(middle(x, width), 1.0 - middle(y, height));
                let corner = |at: i32, size: u32| (at + side).min(size as i32);
                let square = [(x, y), (corner(x, width), corner(y, height))];
                area.draw(&Rectangle::new(square, RGBColor(r, g, b).filled()))?;
            }
        }
        Ok(())
    }
}

impl Drawing for ColorMap<'_> {
    fn size(&self) -> (u32, u32) {
        (900, 520)
    }

    fn draw<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>, scale: Scale) -> Drawn<B> {
        area.fill(&WHITE)?;
        let (head, rest) = area.split_vertically(scale.px(38.0));
        draw_title(&head, scale, self.title)?;
        let (body, foot) = rest.split_vertically(scale.px(446.0));
        let axes = self.axes();
        let mut chart = axes.on(&body, scale)?;
        self.paint(&chart.plotting_area().strip_coord_spec(), scale)?;
        axes.draw(&mut chart, scale)?;
        if (self.x.range.0..=self.x.range.1).contains(&self.marked) {
            let place = chart.backend_coord(&(self.marked, self.y.range.1));
            mark(area, scale, place)?;
        }
        let style = scale.text_from(12.0);
        foot.draw(&Text::new(self.footer, scale.at(80.0, 16.0), style))
    }
}

/// Draws a small triangle above the map.
fn mark<B: DrawingBackend>(
    area: &DrawingArea<B, Shift>,
    scale: Scale,
    (x, y): (i32, i32),
) -> Drawn<B> {
    let (half, high) = (scale.px(5.0), scale.px(8.0));
    let corners = vec![(x, y), (x - half, y - high), (x + half, y - high)];
    area.draw(&Polygon::new(corners, INK.filled()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colors_are_at_their_places() {
        let axis = |name| MapAxis {
            name,
            range: (0.0, 10.0),
        };
        let code = |share: f64| (255.0 * share).round() as u8;
        let map = ColorMap {
            title: "a map",
            x: axis("thickness"),
            y: axis("angle"),
            marked: 20.0,
            footer: "below",
            color: &|x, y| [code(x), code(y), 128],
        };
        let picture = map.pixels();
        assert_eq!((picture.width(), picture.height()), (1800, 1040));
        // Inside the axes: from left to right red rises, from top to bottom green falls.
        let at = |x, y| picture.pixel(x, y).unwrap();
        let (left, right, low) = (at(300, 400), at(1500, 400), at(300, 700));
        assert!(left[0] + 100 < right[0] && left[1] == right[1]);
        assert!(low[1] + 50 < left[1] && low[0] == left[0]);
        assert_eq!(left[2], 128);
        assert_eq!(picture.pixel(0, 0), Some([255; 3]));
    }
}
