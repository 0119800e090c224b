//! The thickness of a layer over its surface, in a validated scene.

use crate::rounding::RoundToF32;
use crate::texels::fnv;
use glam::DVec3;
use std::fmt;
use std::sync::Arc;

/// The thickness of a layer over its surface, nm, at the scene's time.
///
/// The result is clamped to [`limits::THICKNESS_NM`](crate::limits::THICKNESS_NM).
#[derive(Clone, Debug, PartialEq)]
pub enum Thickness {
    /// The same everywhere.
    Constant {
        /// Thickness, nm.
        nm: f64,
    },
    /// Linear in the polar angle θ from a sphere's center: `pole_nm` at θ = 0, `equator_nm` at θ = 90°, and beyond at the same rate
    /// (Suzuki, Yokoi and Toriwaki, section 4-4 (2)).
    Polar {
        /// Direction of the pole, a unit vector.
        axis: DVec3,
        /// Thickness at the pole, nm.
        pole_nm: f64,
        /// Thickness at 90° from the pole, nm.
        equator_nm: f64,
    },
    /// Linear along a line in space from `start` to `end`, constant beyond its ends.
    Linear {
        /// The point where the thickness is `start_nm`.
        start: DVec3,
        /// The point where the thickness is `end_nm`; it differs from `start`.
        end: DVec3,
        /// Thickness at and before `start`, nm.
        start_nm: f64,
        /// Thickness at and beyond `end`, nm.
        end_nm: f64,
    },
    /// Steps of equal width along a line in space; the first and the last continue beyond its ends.
    Steps {
        /// The point where the first step begins.
        start: DVec3,
        /// The point where the last step ends; it differs from `start`.
        end: DVec3,
        /// Thickness on each step, nm; at least one.
        nm: Vec<f64>,
    },
    /// A table computed from a law of growth or drainage.
    Profile(Profile),
    /// Noise advected by a flow.
    Swirls(Swirls),
    /// A picture over the surface.
    Picture(Picture),
    /// The sum of several, at least one.
    Sum(Vec<Thickness>),
    /// The product of several, at least one.
    Product(Vec<Thickness>),
}

impl Thickness {
    /// Lower and upper bound of its values, nm (for a factor or a term of a sum, in its own unit). The values need not reach the bounds.
    pub fn extent_nm(&self) -> (f64, f64) {
        let (least, most) = self.bounds();
        let high = crate::limits::THICKNESS_NM.high;
        (least.clamp(0.0, high), most.clamp(0.0, high))
    }

    fn bounds(&self) -> (f64, f64) {
        let of = |a: f64, b: f64| (a.min(b), a.max(b));
        match self {
            Self::Constant { nm } => (*nm, *nm),
            Self::Polar {
                pole_nm,
                equator_nm,
                ..
            } => of(*pole_nm, 2.0 * equator_nm - pole_nm),
            Self::Linear {
                start_nm, end_nm, ..
            } => of(*start_nm, *end_nm),
            Self::Steps { nm, .. } => extent_of(nm),
            Self::Profile(profile) => {
                let (least, most) = extent_of(&profile.squares_nm2);
                let black = profile.black.map_or(f64::INFINITY, |black| black.nm);
                (least.sqrt().min(black), most.sqrt().min(profile.most_nm))
            }
            Self::Swirls(swirls) => of(
                swirls.mean - swirls.amplitude,
                swirls.mean + swirls.amplitude,
            ),
            Self::Picture(picture) => of(picture.black_nm, picture.white_nm),
            Self::Sum(parts) => parts.iter().fold((0.0, 0.0), |sum, part| {
                let (least, most) = part.bounds();
                (sum.0 + least, sum.1 + most)
            }),
            Self::Product(parts) => parts.iter().fold((1.0, 1.0), |product, part| {
                let (least, most) = part.bounds();
                let corners = [
                    product.0 * least,
                    product.0 * most,
                    product.1 * least,
                    product.1 * most,
                ];
                extent_of(&corners)
            }),
        }
    }

    /// This thickness and, recursively, the terms of its sums and products.
    pub fn parts(&self) -> impl Iterator<Item = &Self> {
        let mut open = vec![self];
        std::iter::from_fn(move || {
            let part = open.pop()?;
            if let Self::Sum(inner) | Self::Product(inner) = part {
                open.extend(inner);
            }
            Some(part)
        })
    }
}

/// The smallest and the largest of several numbers.
fn extent_of(numbers: &[f64]) -> (f64, f64) {
    let empty = (f64::INFINITY, f64::NEG_INFINITY);
    let wider = |(least, most): (f64, f64), &x: &f64| (least.min(x), most.max(x));
    numbers.iter().fold(empty, wider)
}

/// The coordinate of a [`Profile`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Coordinate {
    /// The polar angle from the surface's center: 0 at the pole, 1 at the opposite pole.
    Polar {
        /// Direction of the pole, a unit vector.
        axis: DVec3,
    },
    /// A line in space: 0 at and before `start`, 1 at and beyond `end`.
    Line {
        /// The start of the line.
        start: DVec3,
        /// The end of the line; it differs from `start`.
        end: DVec3,
    },
}

/// The square root of a table that is interpolated linearly between equally spaced knots: the laws of growth and drainage are smooth in the
/// square of the thickness.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    /// The coordinate of the table.
    pub coordinate: Coordinate,
    /// Square of the thickness at each knot, nm²; at least two, ≥ 0.
    pub squares_nm2: Vec<f64>,
    /// Upper limit of the thickness, nm.
    pub most_nm: f64,
    /// The black film that thin parts turn into, if any.
    pub black: Option<BlackFilm>,
}

/// A soap film that has thinned to a black film, with a sharp edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BlackFilm {
    /// Where the film is thinner than this, nm, it is a black film.
    pub below_nm: f64,
    /// Thickness of the black film, nm.
    pub nm: f64,
}

/// Noise advected by a flow: see `description::Swirls`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Swirls {
    /// The mean value.
    pub mean: f64,
    /// The largest deviation from the mean.
    pub amplitude: f64,
    /// Cells of the noise per scene unit, or per radius of a sphere.
    pub cells_per_unit: f64,
    /// Chooses the pattern.
    pub seed: u32,
    /// Number of octaves, at least 1.
    pub octaves: u32,
    /// Distance by which the flow carries the streaks, in cells.
    pub warp: f64,
    /// Number of cells that time has passed through.
    pub cells: u32,
    /// Time within its cell, in [0, 1).
    pub phase: f64,
}

/// A picture over a surface: see `description::Thickness::Image`.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// The picture.
    pub file: Arc<PictureFile>,
    /// Thickness where it is 0, nm.
    pub black_nm: f64,
    /// Thickness where it is 1, nm.
    pub white_nm: f64,
    /// Width and height on planes and rectangles; `None` is the whole rectangle, or a square of side 1 on a plane.
    pub size: Option<[f64; 2]>,
}

/// Numbers from 0 to 1 on a grid, between which a [`Picture`] is bilinear.
#[derive(Clone, PartialEq)]
pub struct PictureFile {
    /// Number of pixels per row.
    pub width: u32,
    /// Number of rows.
    pub height: u32,
    /// The rows from top to bottom.
    pub values: Vec<f32>,
}

/// The size and a digest: two files with the same description hold the same values.
impl fmt::Debug for PictureFile {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let digest = fnv(self.values.iter().map(|value| value.to_bits()));
        write!(
            f,
            "PictureFile({} × {}, {digest:016x})",
            self.width, self.height
        )
    }
}

impl RoundToF32 for Thickness {
    fn rounded(&self) -> Self {
        match self {
            Self::Constant { nm } => Self::Constant { nm: nm.rounded() },
            Self::Polar {
                axis,
                pole_nm,
                equator_nm,
            } => Self::Polar {
                axis: axis.rounded(),
                pole_nm: pole_nm.rounded(),
                equator_nm: equator_nm.rounded(),
            },
            Self::Linear {
                start,
                end,
                start_nm,
                end_nm,
            } => Self::Linear {
                start: start.rounded(),
                end: end.rounded(),
                start_nm: start_nm.rounded(),
                end_nm: end_nm.rounded(),
            },
            Self::Steps { start, end, nm } => Self::Steps {
                start: start.rounded(),
                end: end.rounded(),
                nm: nm.rounded(),
            },
            Self::Profile(profile) => Self::Profile(profile.rounded()),
            Self::Swirls(swirls) => Self::Swirls(swirls.rounded()),
            Self::Picture(picture) => Self::Picture(picture.rounded()),
            Self::Sum(parts) => Self::Sum(parts.rounded()),
            Self::Product(parts) => Self::Product(parts.rounded()),
        }
    }
}

impl RoundToF32 for Coordinate {
    fn rounded(&self) -> Self {
        match self {
            Self::Polar { axis } => Self::Polar {
                axis: axis.rounded(),
            },
            Self::Line { start, end } => Self::Line {
                start: start.rounded(),
                end: end.rounded(),
            },
        }
    }
}

impl RoundToF32 for Profile {
    fn rounded(&self) -> Self {
        Self {
            coordinate: self.coordinate.rounded(),
            squares_nm2: self.squares_nm2.rounded(),
            most_nm: self.most_nm.rounded(),
            black: self.black.map(|black| BlackFilm {
                below_nm: black.below_nm.rounded(),
                nm: black.nm.rounded(),
            }),
        }
    }
}

impl RoundToF32 for Swirls {
    fn rounded(&self) -> Self {
        Self {
            mean: self.mean.rounded(),
            amplitude: self.amplitude.rounded(),
            cells_per_unit: self.cells_per_unit.rounded(),
            seed: self.seed,
            octaves: self.octaves,
            warp: self.warp.rounded(),
            cells: self.cells,
            phase: self.phase.rounded(),
        }
    }
}

impl RoundToF32 for Picture {
    fn rounded(&self) -> Self {
        Self {
            file: Arc::clone(&self.file),
            black_nm: self.black_nm.rounded(),
            white_nm: self.white_nm.rounded(),
            size: self.size.map(|size| size.map(|side| side.rounded())),
        }
    }
}
