// How surfaces scatter light between two directions of their local frame, whose z is the normal on the ray's side.

/// What scatters: a material, and the FACTOR_ tag of what it reflects by.
struct Scatterer {
    material: u32,
    kind: u32,
}

struct Scattering {
    /// The surface's functions times the light's cosine, without their spectra.
    lobes: Lobes,
    /// Density with which sample_scattering finds the light's direction, sr⁻¹.
    pdf: f32,
}

/// Scattering from `light` to `eye`, unit vectors.
fn scattering(scatterer: Scatterer, eye: vec3f, light: vec3f) -> Scattering {
    if (HAS_COOK && is_cook(scatterer.material)) {
        let lambert = max(light.z, 0.0) / PI;
        let facet = cook_facets(scatterer.material, eye, light);
        let body = materials[scatterer.material].base_share * lambert;
        let pdf = mix(facet.pdf, lambert, materials[scatterer.material].base_chance);
        return Scattering(Lobes(facet.reflection * light.z, 0.0, body, facet.cosine, light.z), pdf);
    }
    if (HAS_COATED_BODIES && materials[scatterer.material].surface == SURFACE_COATED_BODY) {
        let body = max(light.z, 0.0) / PI;
        let chance = 1.0 - coat_share(scatterer.material, eye.z);
        return Scattering(Lobes(0.0, 0.0, body, 1.0, light.z), chance * body);
    }
    if (HAS_ROUGH_CONDUCTORS && scatterer.kind != FACTOR_REFLECTANCE && scatterer.kind != FACTOR_SMOOTH) {
        let facet = cook_torrance(eye, light, materials[scatterer.material].roughness);
        return Scattering(Lobes(facet.reflection * light.z, 0.0, 0.0, facet.cosine, light.z), facet.pdf);
    }
    let lambert = max(light.z, 0.0) / PI;
    return Scattering(Lobes(lambert, 0.0, 0.0, 1.0, light.z), lambert);
}

/// A unit vector towards which light is scattered from `eye`, drawn from four uniform numbers.
fn sample_scattering(scatterer: Scatterer, eye: vec3f, random: vec4f) -> vec3f {
    if (HAS_COOK && is_cook(scatterer.material)) {
        if (random.z < materials[scatterer.material].base_chance) {
            return sample_cosine_hemisphere(random.x, random.y);
        }
        let facet = sample_cook_facet(scatterer.material, random.x, random.y, random.w);
        return normalize(reflect(-eye, facet));
    }
    if (HAS_COATED_BODIES && materials[scatterer.material].surface == SURFACE_COATED_BODY) {
        return sample_cosine_hemisphere(random.x, random.y);
    }
    if (HAS_ROUGH_CONDUCTORS && scatterer.kind != FACTOR_REFLECTANCE && scatterer.kind != FACTOR_SMOOTH) {
        let facet = sample_beckmann(random.x, random.y, materials[scatterer.material].roughness);
        return normalize(reflect(-eye, facet));
    }
    return sample_cosine_hemisphere(random.x, random.y);
}
