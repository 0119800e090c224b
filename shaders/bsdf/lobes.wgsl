// The results that all BSDFs return.

/// A BSDF's value between two directions as weights of the spectra that it consists of.
struct Lobes {
    /// Weight of the reflectance at `cosine`: single scattering.
    single: f32,
    /// Weight of the color of multiple scattering between the facets of a rough surface.
    multiple: f32,
    /// Weight of the color of the base below a coat, or beside facets.
    body: f32,
    /// Cosine at the facet, or at a smooth surface.
    cosine: f32,
    /// Cosine of `wi` with the normal.
    wi_cosine: f32,
}

struct BsdfEval {
    lobes: Lobes,
    /// Density with which the BSDF's sample function finds `wi`, sr⁻¹.
    pdf: f32,
}

/// Returns an evaluation without any scattering.
fn dark(wi: vec3f) -> BsdfEval {
    return BsdfEval(Lobes(0.0, 0.0, 0.0, 1.0, wi.z), 0.0);
}

/// Returns the sum of the weights.
fn lobes_sum(lobes: Lobes) -> f32 {
    return lobes.single + lobes.multiple + lobes.body;
}

/// Where a spectrum is evaluated: a vertex of the record, a group of four bands, and the sample's wavelengths.
struct At {
    vertex: u32,
    group: u32,
    wavelengths: Wavelengths,
}

/// The values of a vertex in four bands, with their weights.
struct Values {
    /// Factor of the path that continues.
    onward: vec4f,
    /// Factor of the emission that joins here.
    lit: vec4f,
}
