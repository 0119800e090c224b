//! Cook's model between two directions of a local frame, from the crate `optics`.

use glam::DVec3;
use scene::{Cook1981, CookDistribution};

/// How the facets of Cook's model reflect between two directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CookFacets {
    /// G Σ wⱼ Dⱼ / ((N·L) (N·E)): the reflection function without its Fresnel factor, sr⁻¹.
    pub reflection: f64,
    /// Density with which a drawn facet mirrors `eye` to `light`, sr⁻¹.
    pub pdf: f64,
    /// Cosine at the facet.
    pub cosine: f64,
}

/// From `light` to `eye`, with the density of [`sample_cook_facet`] and a mirror; black when either is below the surface.
pub fn cook_facets(surface: &Cook1981, eye: DVec3, light: DVec3) -> CookFacets {
    let facet = (eye + light).normalize();
    let cosine = eye.dot(facet);
    if eye.z <= 0.0 || light.z <= 0.0 || cosine <= 0.0 {
        return CookFacets {
            reflection: 0.0,
            pdf: 0.0,
            cosine: 1.0,
        };
    }
    let (mut distribution, mut density) = (0.0, 0.0);
    for facets in &surface.facets {
        let (d, pdf) = match surface.distribution {
            CookDistribution::Gaussian => (
                optics::gaussian_d1(facet.z, facets.slope),
                optics::gaussian_pdf(facet.z, facets.slope),
            ),
            CookDistribution::Beckmann => (
                optics::beckmann_d2(facet.z, facets.slope),
                optics::half_vector_pdf(facet.z, facets.slope),
            ),
        };
        distribution += facets.weight * d;
        density += facets.part * pdf;
    }
    let g = optics::v_groove_g(facet.z, eye.z, light.z, cosine);
    CookFacets {
        reflection: distribution * g / (eye.z * light.z),
        pdf: density / (4.0 * cosine),
        cosine,
    }
}

/// A facet normal drawn from two uniform numbers, of the slope that `pick` in [0, 1) chooses.
pub fn sample_cook_facet(surface: &Cook1981, [u, v, pick]: [f64; 3]) -> DVec3 {
    let mut below = 0.0;
    let chosen = surface.facets.iter().find(|facets| {
        below += facets.part;
        pick < below
    });
    let slope = chosen.or(surface.facets.last()).map_or(1.0, |f| f.slope);
    DVec3::from_array(match surface.distribution {
        CookDistribution::Gaussian => optics::sample_gaussian(u, v, slope),
        CookDistribution::Beckmann => optics::sample_beckmann(u, v, slope),
    })
}
