//! Thicknesses as written in a scene file.

use crate::limits;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// The channel of a picture that is used as a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum PictureChannel {
    /// Red.
    R,
    /// Green.
    G,
    /// Blue.
    B,
    /// Alpha: 1 where the picture is opaque.
    A,
    /// 0.2126 r + 0.7152 g + 0.0722 b of the stored values.
    Luma,
}

/// The thickness of a layer over its surface, in nm.
///
/// The results of sums and products are clamped to 0 to 100 000 nm: where the result is 0 or less, the layer is absent. Within a product, a
/// value may be a dimensionless factor.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged, deny_unknown_fields)]
pub enum Thickness {
    /// The same everywhere.
    Constant(
        #[schemars(range(min = limits::THICKNESS_NM.low, max = limits::THICKNESS_NM.high))] f64,
    ),
    /// On spheres only: linear in the angle from an axis through the center, at the same rate from the pole to the equator and on to the
    /// opposite pole.
    Polar {
        /// Thickness where the axis leaves the sphere, nm.
        #[schemars(range(min = limits::THICKNESS_NM.low, max = limits::THICKNESS_NM.high))]
        pole: f64,
        /// Thickness at 90° from there, nm.
        #[schemars(range(min = limits::THICKNESS_NM.low, max = limits::THICKNESS_NM.high))]
        equator: f64,
        /// Direction of the pole.
        #[serde(default = "axis_default")]
        axis: [f64; 3],
    },
    /// Linear along a line in space, constant beyond its ends.
    Linear {
        /// Thickness at `from` and before, nm.
        #[schemars(range(min = limits::THICKNESS_NM.low, max = limits::THICKNESS_NM.high))]
        start: f64,
        /// Thickness at `to` and beyond, nm.
        #[schemars(range(min = limits::THICKNESS_NM.low, max = limits::THICKNESS_NM.high))]
        end: f64,
        /// The point where the thickness is `start`.
        from: [f64; 3],
        /// The point where the thickness is `end`.
        to: [f64; 3],
    },
    /// Steps of equal width along a line in space.
    Steps {
        /// The steps.
        steps: Steps,
    },
    /// A soap film that drains under gravity with time.
    Drainage {
        /// The film.
        drainage: Drainage,
    },
    /// Turbulent streaks: noise advected by a divergence-free flow.
    Swirls {
        /// The streaks.
        swirls: Swirls,
    },
    /// A picture over the surface.
    Image {
        /// A PNG file, relative to the scene file. Its stored values are used as numbers from 0 to 1, without any transfer function,
        /// whatever color space the file declares. On a sphere its center is toward +Z, its left and right edges meet toward −Z, and its
        /// upper edge is the pole +Y.
        image: PathBuf,
        /// The channel to use: one of the picture's channels, or their luma (0.2126 r + 0.7152 g + 0.0722 b of the stored values). Luma
        /// when absent, which for a gray picture is its value. glTF stores thicknesses in "g".
        #[serde(default, skip_serializing_if = "Option::is_none")]
        channel: Option<PictureChannel>,
        /// Thickness where the picture is black, nm.
        #[schemars(range(min = limits::THICKNESS_NM.low, max = limits::THICKNESS_NM.high))]
        min: f64,
        /// Thickness where the picture is white, nm.
        #[schemars(range(min = limits::THICKNESS_NM.low, max = limits::THICKNESS_NM.high))]
        max: f64,
        /// Width and height on planes and rectangles, centered on the origin of their axes; outside, the edges continue. When absent, the
        /// picture covers the whole rectangle, or a square of side 1 on a plane.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[schemars(inner(range(min = limits::LENGTH.low, max = limits::LENGTH.high)))]
        size: Option<[f64; 2]>,
    },
    /// The sum of several.
    Sum {
        /// What is added.
        sum: Vec<Thickness>,
    },
    /// The product of several: one has the unit nm, and the others are factors.
    Product {
        /// What is multiplied.
        product: Vec<Thickness>,
    },
    /// The oxide that anodizing grows.
    Anodizing {
        /// The process.
        anodizing: Anodizing,
    },
    /// The oxide that grows on steel heated in air.
    HeatTint {
        /// The process.
        heat_tint: HeatTint,
    },
}

impl Thickness {
    /// This thickness and, recursively, the terms of its sums and products.
    pub(crate) fn parts(&self) -> impl Iterator<Item = &Self> {
        let mut open = vec![self];
        std::iter::from_fn(move || {
            let part = open.pop()?;
            if let Self::Sum { sum: inner } | Self::Product { product: inner } = part {
                open.extend(inner);
            }
            Some(part)
        })
    }
}

/// Steps of equal width along a line.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Steps {
    /// Thickness on each step, nm.
    #[schemars(inner(range(min = limits::THICKNESS_NM.low, max = limits::THICKNESS_NM.high)))]
    pub values: Vec<f64>,
    /// The point where the first step begins; before it, that step continues.
    pub from: [f64; 3],
    /// The point where the last step ends; beyond it, that step continues.
    pub to: [f64; 3],
}

/// A soap film of water that drains under gravity (−Y is down) from a uniform thickness at time 0.
///
/// The liquid flows between two surfaces that do not move (rigid: Mysels, Shinoda and Frankel, Soap Films, 1959; Reynolds 1886), with a
/// flux of ρ g h³ / (12 η) down a vertical film of thickness h. With no inflow from above, a plane film has h = √(4 η z / (ρ g t)) at depth
/// z (Jeffreys 1930), or its initial thickness where that is less; a bubble of radius R has (h₀⁻² + ρ g t / (3 η R))^(−1/2) at its top.
/// Where the film becomes thinner than `black_below` it turns into a black film, with a sharp edge as in real films.
///
/// Real films of small soap molecules have mobile surfaces, and thin many times faster by exchange with their borders (marginal
/// regeneration). A smaller effective viscosity then gives the right time scale with the shape of this model. The hanging drop that gathers
/// at a bubble's lowest point is cut off at 20 µm.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged, deny_unknown_fields)]
pub enum Drainage {
    /// A bubble, on spheres only.
    Sphere {
        /// Uniform thickness at time 0, nm.
        #[schemars(range(min = limits::DRAINING_NM.low, max = limits::DRAINING_NM.high))]
        initial: f64,
        /// Radius of the real bubble, m, whatever its size in the scene.
        #[schemars(range(min = limits::FILM_SIZE_M.low, max = limits::FILM_SIZE_M.high))]
        radius_m: f64,
        /// Viscosity of the liquid, Pa s.
        #[serde(default = "viscosity_default")]
        #[schemars(range(min = limits::VISCOSITY_PA_S.low, max = limits::VISCOSITY_PA_S.high))]
        viscosity_pa_s: f64,
        /// Density of the liquid, kg/m³.
        #[serde(default = "density_default")]
        #[schemars(range(min = limits::DENSITY_KG_M3.low, max = limits::DENSITY_KG_M3.high))]
        density_kg_m3: f64,
        /// Where the film is thinner than this, nm, it is a black film.
        #[serde(default = "black_below_default")]
        #[schemars(range(min = limits::DRAINING_NM.low, max = limits::DRAINING_NM.high))]
        black_below: f64,
        /// Thickness of the black film, nm: 7 or more for common black films (IUPAC Gold Book), about 4 for Newton's.
        #[serde(default = "black_default")]
        #[schemars(range(min = limits::DRAINING_NM.low, max = limits::DRAINING_NM.high))]
        black: f64,
    },
    /// A plane film, vertical or inclined.
    Plane {
        /// Uniform thickness at time 0, nm.
        #[schemars(range(min = limits::DRAINING_NM.low, max = limits::DRAINING_NM.high))]
        initial: f64,
        /// A point of the upper edge.
        from: [f64; 3],
        /// The point straight below it on the lower edge.
        to: [f64; 3],
        /// Length of the real film from `from` to `to`, m.
        #[schemars(range(min = limits::FILM_SIZE_M.low, max = limits::FILM_SIZE_M.high))]
        height_m: f64,
        /// Viscosity of the liquid, Pa s.
        #[serde(default = "viscosity_default")]
        #[schemars(range(min = limits::VISCOSITY_PA_S.low, max = limits::VISCOSITY_PA_S.high))]
        viscosity_pa_s: f64,
        /// Density of the liquid, kg/m³.
        #[serde(default = "density_default")]
        #[schemars(range(min = limits::DENSITY_KG_M3.low, max = limits::DENSITY_KG_M3.high))]
        density_kg_m3: f64,
        /// Where the film is thinner than this, nm, it is a black film.
        #[serde(default = "black_below_default")]
        #[schemars(range(min = limits::DRAINING_NM.low, max = limits::DRAINING_NM.high))]
        black_below: f64,
        /// Thickness of the black film, nm: 7 or more for common black films (IUPAC Gold Book), about 4 for Newton's.
        #[serde(default = "black_default")]
        #[schemars(range(min = limits::DRAINING_NM.low, max = limits::DRAINING_NM.high))]
        black: f64,
    },
}

/// Turbulent streaks: gradient noise (Perlin 2002) of several octaves, advected along the surface by a flow whose stream function is also
/// noise, which makes it divergence-free (curl noise: Bridson, Houriham and Nordenstam 2007).
///
/// On spheres it is solid noise of the direction from the center; on planes it is noise of the two surface axes, with time as the third. It
/// imitates the look of a stirred film; no equation of motion is solved.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Swirls {
    /// The mean value, nm, or a number such as 1 within a product.
    #[serde(default)]
    #[schemars(range(min = limits::THICKNESS_NM.low, max = limits::THICKNESS_NM.high))]
    pub mean: f64,
    /// The largest deviation from the mean; on half of the surface the deviation is more than roughly half of this.
    #[schemars(range(min = limits::THICKNESS_NM.low, max = limits::THICKNESS_NM.high))]
    pub amplitude: f64,
    /// Size of the largest streaks, in scene units on planes, in radii on spheres.
    #[schemars(range(min = limits::SWIRL_SCALE.low, max = limits::SWIRL_SCALE.high))]
    pub scale: f64,
    /// Chooses the pattern. The octaves use consecutive seeds from this one on, so patterns of neighboring seeds have lattices in common:
    /// leave `octaves` between the seeds of patterns that should be independent.
    #[serde(default)]
    pub seed: u32,
    /// Number of octaves; each is half as large and half as strong as the one before.
    #[serde(default = "octaves_default")]
    #[schemars(range(min = limits::OCTAVES.low, max = limits::OCTAVES.high))]
    pub octaves: u32,
    /// How far the flow has carried the streaks, relative to their size: 0 gives clouds, 1 streaks, 3 thin filaments.
    #[serde(default = "warp_default")]
    #[schemars(range(min = limits::WARP.low, max = limits::WARP.high))]
    pub warp: f64,
    /// How many times per second the pattern changes into another one.
    #[serde(default)]
    #[schemars(range(min = limits::SWIRL_RATE.low, max = limits::SWIRL_RATE.high))]
    pub rate: f64,
}

/// A number that is constant, or linear along a line in space.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged, deny_unknown_fields)]
pub enum Quantity {
    /// The same everywhere.
    Constant(f64),
    /// Linear along a line in space, constant beyond its ends.
    Linear {
        /// Value at `from` and before.
        start: f64,
        /// Value at `to` and beyond.
        end: f64,
        /// The point where the value is `start`.
        from: [f64; 3],
        /// The point where the value is `end`.
        to: [f64; 3],
    },
}

/// Anodizing: an oxide that grows in proportion to the voltage, d = `native` + `nm_per_volt` · V.
///
/// On titanium, 2.4 to 2.8 nm/V, depending on the electrolyte, were measured by ellipsometry up to 7.5 V (Ohtsuka, Masuda and Sato, J.
/// Electrochem. Soc. 132, 787, 1985). The sequence of colors up to about 120 V follows the same line, but above about 10 V rougher and
/// partly crystalline films deviate from it, depending on electrolyte and current.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Anodizing {
    /// The metal.
    pub metal: AnodizedMetal,
    /// The voltage, V, from 0 to 150: a number, or linear along a line.
    pub volts: Quantity,
    /// Growth of the oxide, nm/V.
    #[serde(default = "nm_per_volt_default")]
    #[schemars(range(min = limits::NM_PER_VOLT.low, max = limits::NM_PER_VOLT.high))]
    pub nm_per_volt: f64,
    /// The native oxide of the metal, nm: 0.5 to 7 on titanium (Aladjem, J. Mater. Sci. 8, 688, 1973).
    #[serde(default = "native_default")]
    #[schemars(range(min = 0.0, max = limits::THICKNESS_NM.high))]
    pub native: f64,
}

/// A metal that takes on colors when anodized.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum AnodizedMetal {
    /// Titanium.
    Titanium,
}

/// Heat tint: polished steel heated in air. The oxide grows by the parabolic law d² = k t (Wagner 1933; found on iron below
/// 570 °C by del Campo, Pérez-Sáez and Tello, Corros. Sci. 50, 194, 2008) with k = k₀ exp(−E / (R T)).
///
/// k₀ = 1.06e6 nm²/s and E = 60 kJ/mol are not material constants: they are fitted, for ten minutes, so that magnetite (Querry 1985) on
/// iron (Johnson and Christy 1974) goes through the temper colors of carbon steel at their temperatures (Machinery's Handbook: straw 230,
/// brown-yellow 260, purple 282, blue 293 to 299, light blue 338 °C). The thinnest oxides grow more slowly than this law (McAdam and Geil,
/// J. Res. Natl. Bur. Stand. 23, 63, 1939), so trust it from a few minutes to an hour. Alloyed and stainless steels need other
/// temperatures.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HeatTint {
    /// Temperature, °C, from 150 to 400: a number, or linear along a line.
    pub temperature_c: Quantity,
    /// How long the temperature is held, min.
    #[schemars(range(min = limits::MINUTES.low, max = limits::MINUTES.high))]
    pub minutes: f64,
    /// The steel.
    #[serde(default)]
    pub steel: Steel,
}

/// A steel that can be heat tinted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Steel {
    /// Plain carbon steel.
    #[default]
    Carbon,
}

fn axis_default() -> [f64; 3] {
    [0.0, 1.0, 0.0]
}

/// Water at 20 °C.
fn viscosity_default() -> f64 {
    1.002e-3
}

/// Water at 20 °C.
fn density_default() -> f64 {
    998.2
}

fn black_below_default() -> f64 {
    30.0
}

fn black_default() -> f64 {
    7.0
}

fn octaves_default() -> u32 {
    3
}

fn warp_default() -> f64 {
    1.0
}

fn nm_per_volt_default() -> f64 {
    2.5
}

fn native_default() -> f64 {
    2.0
}
