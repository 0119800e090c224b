//! How the color changes with the thickness of each layer.

use crate::response::Angle;
use crate::stack_color::{Color, StackColor};
use colorimetry::Lab;
use colorimetry::lab::delta_e_2000_rate;
use optics::ThicknessDerivative;

/// Dependence of the color of a stack on its thicknesses, to first order.
#[derive(Clone, Debug, PartialEq)]
pub struct Sensitivity {
    /// The color itself.
    pub color: Color,
    /// One entry per layer.
    pub layers: Vec<LayerSensitivity>,
}

/// Change of the color per nanometer of a layer, to first order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LayerSensitivity {
    /// Change of XYZ per nm.
    pub xyz_per_nm: [f64; 3],
    /// Change of CIELAB per nm.
    pub lab_per_nm: Lab,
    /// Color difference ΔE₀₀ per nm.
    pub delta_e_per_nm: f64,
}

/// Returns the derivative of the color with respect to each thickness: via XYZ, a sum over wavelength, CIELAB, and the
/// form of ΔE₀₀ for small differences.
///
/// # Panics
/// If there is not one thickness per layer.
pub fn sensitivity(stack: &StackColor, thicknesses_nm: &[f64], angle: Angle) -> Sensitivity {
    let color = stack.at(thicknesses_nm, angle);
    let share = |d: &ThicknessDerivative| stack.view().of(d.reflectance, d.transmittance);
    // For each wavelength and layer.
    let positions = stack.positions(thicknesses_nm, angle);
    let derivatives = positions.sampled.derivatives(thicknesses_nm, angle);
    let of_layer = |layer: usize| {
        let shares = derivatives.iter().map(|layers| share(&layers[layer]));
        let mut xyz_per_nm = [0.0; 3];
        for (share, weight) in shares.zip(&positions.weights) {
            xyz_per_nm = std::array::from_fn(|i| xyz_per_nm[i] + share * weight[i]);
        }
        let lab_per_nm = Lab::derivative(color.xyz, color.white, xyz_per_nm);
        LayerSensitivity {
            xyz_per_nm,
            lab_per_nm,
            delta_e_per_nm: delta_e_2000_rate(color.lab(), lab_per_nm),
        }
    };
    Sensitivity {
        color,
        layers: (0..thicknesses_nm.len()).map(of_layer).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Light, Side, Stack, View};
    use colorimetry::lab::delta_e_2000;

    /// The derivative agrees with differences of colors.
    #[test]
    fn a_nanometer_more_moves_the_color_as_predicted() {
        let line = "1 | 2.4 60nm | silica 90nm | 2.1+0.01i 40nm | bk7";
        let stack = Stack::parse(line).unwrap();
        for (side, angle_deg) in [
            (Side::Reflected, 0.0),
            (Side::Reflected, 55.0),
            (Side::Transmitted, 30.0),
        ] {
            let color = {
                let view = View {
                    side,
                    ..View::default()
                };
                StackColor::new(&stack, Light::named("D65").unwrap(), view).unwrap()
            };
            let angle = Angle::from_degrees(angle_deg).unwrap();
            let found = sensitivity(&color, stack.thicknesses_nm(), angle);
            for (layer, found) in found.layers.iter().enumerate() {
                let at = |by_nm: f64| {
                    let mut thicknesses = stack.thicknesses_nm().to_vec();
                    thicknesses[layer] += by_nm;
                    color.at(&thicknesses, angle).lab()
                };
                let h = 1e-4;
                let (up, down) = (at(h), at(-h));
                let rate = delta_e_2000(down, up) / (2.0 * h);
                assert!(
                    (found.delta_e_per_nm / rate - 1.0).abs() < 1e-5,
                    "{layer}: {} {rate}",
                    found.delta_e_per_nm
                );
                assert!((found.lab_per_nm.l - (up.l - down.l) / (2.0 * h)).abs() < 1e-6);
                assert!(rate > 1e-3, "the layer has an effect");
            }
        }
    }
}
