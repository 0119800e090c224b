//! Plots, color maps and contact sheets.
//!
//! A caller describes what to draw; nothing here computes optics. Every picture is drawn identically as SVG and as pixels, with a font
//! that comes with the program.
//!
//! ```text
//! PanelPlot       curves over wavelength or angle, in panels one above another, with a legend
//! SpectrumPlot    spectra of pixels: each band's mean as a step, with its noise
//! ColorMap        a color at each place of two axes
//! with_color_bar  a picture in false colors, with the scale of its colors below it
//! contact_sheet   pictures side by side, each with a label above it
//! braille         a curve as text, for a terminal
//! ```

mod axes;
pub mod braille;
mod color_bar;
mod color_map;
mod legend;
mod panel_plot;
mod picture;
mod sheet;
mod spectrum_plot;
mod title;
mod wavelengths;

pub use color_bar::{ColorBar, with_color_bar};
pub use color_map::{ColorMap, MapAxis};
pub use legend::Swatch;
pub use panel_plot::{CurveName, Over, Panel, PanelPlot, Vertical};
pub use sheet::{MAX_PICTURES, SheetColors, contact_sheet};
pub use spectrum_plot::{Series, SpectrumPlot};
