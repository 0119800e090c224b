//! Color of a reflectance by plain sums, independent of the renderer.

/// XYZ under an illuminant, with Y = 100 for a perfect mirror, for the CIE 1931 2° observer, summed at 380, 381 … 780 nm.
///
/// # Panics
/// If there is no such illuminant.
pub fn xyz(illuminant: &str, reflectance: impl Fn(f64) -> f64) -> [f64; 3] {
    let lamp = spectra::illuminant(illuminant).unwrap().data;
    let observer = spectra::observer_1931();
    let (mut sum, mut white) = ([0.0; 3], 0.0);
    for nm in (380..=780).map(f64::from) {
        let light = lamp.at(nm).unwrap();
        let reflected = light * reflectance(nm);
        for (total, function) in sum.iter_mut().zip(observer) {
            *total += reflected * function.at(nm).unwrap();
        }
        white += light * observer[1].at(nm).unwrap();
    }
    sum.map(|total| 100.0 * total / white)
}

/// CIELAB: L*, a*, b* of XYZ relative to a white (CIE 015:2018, section 8.2.1).
pub fn lab(xyz: [f64; 3], white: [f64; 3]) -> [f64; 3] {
    let [x, y, z] = std::array::from_fn(|i| {
        let share: f64 = xyz[i] / white[i];
        if share > 216.0 / 24389.0 {
            share.cbrt()
        } else {
            (24389.0 / 27.0 * share + 16.0) / 116.0
        }
    });
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

/// Chroma C* and hue angle h, degrees from 0 to 360, of a CIELAB color.
pub fn chroma_hue([_, a, b]: [f64; 3]) -> (f64, f64) {
    (a.hypot(b), b.atan2(a).to_degrees().rem_euclid(360.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The first pair of Sharma, Wu and Dalal (2005) has L* 50, a* 2.6772, b* −79.7751; its hue lies in the blue.
    #[test]
    fn hue_and_chroma_are_polar_coordinates() {
        let (chroma, hue) = chroma_hue([50.0, 2.6772, -79.7751]);
        assert!((chroma - 79.82).abs() < 0.005 && (hue - 271.92).abs() < 0.005);
    }

    /// White has L* 100 and no chroma, a gray of 18.42 % has L* 50, and below 216/24389 L* is 903.3 Y (CIE 015:2018).
    #[test]
    fn lightness_follows_its_definition() {
        let white = xyz("D65", |_| 1.0);
        let found = lab(white, white);
        assert!((found[0] - 100.0).abs() < 1e-12 && chroma_hue(found).0 < 1e-12);
        let gray = lab(white.map(|x| 0.184_187 * x), white);
        assert!((gray[0] - 50.0).abs() < 1e-3);
        let black = lab(white.map(|x| 0.001 * x), white);
        assert!((black[0] - 0.903_296).abs() < 1e-6);
    }
}
