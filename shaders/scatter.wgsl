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
    if (HAS_ROUGH_COATS && materials[scatterer.material].surface == SURFACE_ROUGH_COATED_BODY) {
        var both = facet_scattering(scatterer.material, eye, light);
        if (eye.z > 0.0 && light.z > 0.0) {
            let passage = coat_passage(scatterer.material, eye) * coat_passage(scatterer.material, light);
            both.lobes.body = passage * light.z / PI;
            both.pdf = mix(light.z / PI, both.pdf, coat_share(scatterer.material, eye.z));
        }
        return both;
    }
    if (HAS_COATED_BODIES && materials[scatterer.material].surface == SURFACE_COATED_BODY) {
        let body = max(light.z, 0.0) / PI;
        let chance = 1.0 - coat_share(scatterer.material, eye.z);
        return Scattering(Lobes(0.0, 0.0, body, 1.0, light.z), chance * body);
    }
    if (HAS_ROUGH_CONDUCTORS && scatterer.kind != FACTOR_REFLECTANCE && scatterer.kind != FACTOR_SMOOTH) {
        return facet_scattering(scatterer.material, eye, light);
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
    if (HAS_ROUGH_COATS && materials[scatterer.material].surface == SURFACE_ROUGH_COATED_BODY) {
        let share = coat_share(scatterer.material, eye.z);
        if (random.z < share) {
            return sample_facet_scattering(scatterer.material, eye, vec4f(random.xy, random.z / share, random.w));
        }
        return sample_cosine_hemisphere(random.x, random.y);
    }
    if (HAS_COATED_BODIES && materials[scatterer.material].surface == SURFACE_COATED_BODY) {
        return sample_cosine_hemisphere(random.x, random.y);
    }
    if (HAS_ROUGH_CONDUCTORS && scatterer.kind != FACTOR_REFLECTANCE && scatterer.kind != FACTOR_SMOOTH) {
        return sample_facet_scattering(scatterer.material, eye, random);
    }
    return sample_cosine_hemisphere(random.x, random.y);
}

fn microsurface_of(material: u32) -> Microsurface {
    return Microsurface(materials[material].facets, materials[material].alpha);
}

/// Light that met one facet, and light that met several, without their colours. The latter leaves by
/// (1 − E(eye)) (1 − E(light)) / (π (1 − E mean)), so that with the former everything is there (Kelemen and Szirmay-Kalos 2001;
/// Kulla and Conty 2017).
///
/// Directions are drawn from visible facets, and with the share 1 − E(eye) evenly over the hemisphere.
fn facet_scattering(material: u32, eye: vec3f, light: vec3f) -> Scattering {
    if (eye.z <= 0.0 || light.z <= 0.0) {
        return Scattering(NO_LOBES, 0.0);
    }
    let once = reflection_between(microsurface_of(material), eye, light);
    let share = 1.0 - facet_albedo(material, eye);
    let lost = max(1.0 - materials[material].mean_energy, 1e-6);
    let again = share * (1.0 - facet_albedo(material, light)) / (PI * lost);
    let lobes = Lobes(once.value, again * light.z, 0.0, once.cosine, light.z);
    return Scattering(lobes, mix(once.pdf, 0.5 / PI, share));
}

/// A direction drawn by the density of facet_scattering.
fn sample_facet_scattering(material: u32, eye: vec3f, random: vec4f) -> vec3f {
    if (random.z < 1.0 - facet_albedo(material, eye)) {
        return sample_cone(random.x, random.y, 1.0);
    }
    let facet = sample_facet(microsurface_of(material), eye, random.x, random.y);
    return normalize(reflect(-eye, facet));
}
