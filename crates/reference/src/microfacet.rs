//! Rough reflection between two directions of a local frame, from the crate `optics`.

use glam::DVec3;

/// A rough mirror's reflection between two directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Microfacet {
    /// D G / (4 (N·E)(N·L)): the reflection function without its Fresnel factor, sr⁻¹.
    pub reflection: f64,
    /// Density with which a drawn facet mirrors `eye` to `light`, sr⁻¹.
    pub pdf: f64,
    /// Cosine at the facet.
    pub cosine: f64,
}

/// The reflection function of a rough mirror from `light` to `eye`; black when either is below the surface.
pub fn cook_torrance(eye: DVec3, light: DVec3, slope: f64) -> Microfacet {
    const BLACK: Microfacet = Microfacet {
        reflection: 0.0,
        pdf: 0.0,
        cosine: 1.0,
    };
    if eye.z <= 0.0 || light.z <= 0.0 {
        return BLACK;
    }
    let facet = (eye + light).normalize();
    let cosine = eye.dot(facet);
    if cosine <= 0.0 {
        return BLACK;
    }
    Microfacet {
        reflection: optics::cook_torrance(eye.to_array(), light.to_array(), slope),
        pdf: optics::reflected_pdf(facet.z, cosine, slope),
        cosine,
    }
}
