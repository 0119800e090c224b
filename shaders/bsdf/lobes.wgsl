// What all BSDFs give.

/// A BSDF's value between two directions as weights of the spectra that it is made of.
struct Lobes {
    /// Of the reflectance at `cosine`: light that met the surface once.
    single: f32,
    /// Of the color of light that met several facets of a rough surface.
    multiple: f32,
    /// Of the color of the base below a coat, or beside facets.
    body: f32,
    /// Cosine at the facet, or at a smooth surface.
    cosine: f32,
    /// Cosine of `wi` with the normal.
    wi_cosine: f32,
}

struct BsdfEval {
    lobes: Lobes,
    /// Density with which the BSDF's sample finds `wi`, sr⁻¹.
    pdf: f32,
}

/// Nothing is scattered.
fn dark(wi: vec3f) -> BsdfEval {
    return BsdfEval(Lobes(0.0, 0.0, 0.0, 1.0, wi.z), 0.0);
}

/// Sum of the weights.
fn lobes_sum(lobes: Lobes) -> f32 {
    return lobes.single + lobes.multiple + lobes.body;
}

/// Where a spectrum is taken: a vertex of the record, a group of four bands, and the sample's wavelengths.
struct Place {
    vertex: u32,
    group: u32,
    wavelengths: Wavelengths,
}

/// The values of a vertex in four bands, with their weights.
struct Values {
    /// What the path is multiplied by.
    onward: vec4f,
    /// What the light that joins here is multiplied by.
    lit: vec4f,
}
