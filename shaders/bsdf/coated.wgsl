// A diffuse body below a clear coat, smooth or rough.

fn coated_of(material: u32) -> Coated {
    return load_coated(material_at(material).record);
}

/// Returns the probability that a path is reflected by the coat rather than scattered by the body below it, from an estimate of the
/// contribution of each. It affects noise only: the weights divide by it.
fn coat_probability(material: u32, cosine: f32) -> f32 {
    let coated = coated_of(material);
    let n = vec4f(coated.coat_estimate);
    let reflected = reflectance_unpolarized(n, vec4f(0.0), max(cosine, 1e-6)).x;
    let probability = reflected / max(reflected + (1.0 - reflected) * coated.base_estimate, 1e-6);
    // Near grazing a rough coat reflects less than a smooth one: both choices need a probability well above 0.
    return select(clamp(probability, 0.1, 0.9), probability, material_at(material).facets == NONE);
}

/// Returns the probability of the specular reflection, which only a smooth coat has.
fn coated_specular_probability(material: u32, wo: vec3f) -> f32 {
    if (HAS_ROUGH_COATS && material_at(material).facets != NONE) {
        return 0.0;
    }
    return coat_probability(material, wo.z);
}

fn coated_eval(material: u32, wo: vec3f, wi: vec3f) -> BsdfEval {
    let probability = coat_probability(material, wo.z);
    let lambert = max(wi.z, 0.0) / PI;
    let head = material_at(material);
    if (!HAS_ROUGH_COATS || head.facets == NONE) {
        return BsdfEval(Lobes(0.0, 0.0, lambert, 1.0, wi.z), (1.0 - probability) * lambert);
    }
    let facets = load_facets(head.facets);
    var both = facets_eval(facets, wo, wi);
    if (wo.z > 0.0 && wi.z > 0.0) {
        both.lobes.body = coat_transmittance_scale(facets, wo) * coat_transmittance_scale(facets, wi) * lambert;
        both.pdf = mix(lambert, both.pdf, probability);
    }
    return both;
}

fn coated_sample(material: u32, wo: vec3f, random: vec4f) -> vec3f {
    let head = material_at(material);
    if (HAS_ROUGH_COATS && head.facets != NONE) {
        let probability = coat_probability(material, wo.z);
        if (random.z < probability) {
            return facets_sample(load_facets(head.facets), wo, vec4f(random.xy, random.z / probability, random.w));
        }
    }
    return sample_cosine_hemisphere(random.x, random.y);
}

/// Returns the factor by which a rough coat transmits more in a direction than its reflectances say: 1 unless it is brushed.
fn coat_transmittance_scale(facets: Facets, direction: vec3f) -> f32 {
    if (!HAS_GRAIN || facets.alpha.x == facets.alpha.y) {
        return 1.0;
    }
    return over_facets(facets.first_transmittance_scale, facets.alpha, direction);
}

fn coated_factor(object: u32, point: SurfacePoint, random: f32) -> u32 {
    let material = shape_at(object).material;
    let coated = coated_of(material);
    pending_body.material = material;
    pending_body.base = diffuse_factor(coated.base, object, point.position, random);
    let facets = material_at(material).facets;
    if (HAS_MULTIPLE_SCATTERING && facets != NONE) {
        pending_multiple.mean_energy = load_facets(facets).mean_energy;
    }
    return factor_of(FACTOR_COATED, coated.spectrum);
}

/// Returns the fraction of light that a clear coat of index n transmits from a direction into the body, or from the body into it.
fn coat_transmittance(n: vec4f, cosine: f32) -> vec4f {
    return 1.0 - reflectance_unpolarized(n, vec4f(0.0), max(cosine, 1e-6));
}

/// Returns the fraction of light that a rough coat transmits from a direction into the body, or from the body into it: 1 minus the
/// reflectance of its table, whose spectra begin with `reflectances`.
fn rough_coat_transmittance(reflectances: u32, cosine: f32, group: u32, at: Wavelengths) -> vec4f {
    let place = sqrt(clamp(cosine, 0.0, 1.0)) * f32(COAT_COSINES - 1u);
    let knot = min(u32(place), COAT_COSINES - 2u);
    let first = reflectances + knot;
    return 1.0 - mix(spectrum_at(first, group, at), spectrum_at(first + 1u, group, at), place - f32(knot));
}

fn coated_value(at: At, vertex: Vertex, n: vec4f) -> Values {
    let body = bodies[at.vertex];
    let coated = coated_of(body.material);
    let k = spectrum_at(coated.spectrum + 1u, at.group, at.wavelengths);
    let base = reflectance_at(at, body.base, factor_value(body.base, at));
    let outer = spectrum_at(coated.mean_reflectance, at.group, at.wavelengths);
    let inside = base * coated_albedo_factor(base, n, outer);
    var values: Values;
    var transmittance: CoatTransmittance;
    if (HAS_ROUGH_COATS && material_at(body.material).facets != NONE) {
        values = bare_value(at, vertex, n, k);
        transmittance.wo = rough_coat_transmittance(coated.coat_reflectances, body.wo_cosine, at.group, at.wavelengths);
        transmittance.wi = rough_coat_transmittance(coated.coat_reflectances, body.wi_cosine, at.group, at.wavelengths);
        transmittance.emission_wi = rough_coat_transmittance(coated.coat_reflectances, body.emission_wi_cosine, at.group, at.wavelengths);
    } else {
        values = Values(vertex.weight * reflectance_unpolarized(n, k, vertex.cosine), vec4f(0.0));
        transmittance.wo = coat_transmittance(n, body.wo_cosine);
        transmittance.wi = coat_transmittance(n, body.wi_cosine);
        transmittance.emission_wi = coat_transmittance(n, body.emission_wi_cosine);
    }
    values.onward += body.weight * (transmittance.wo * transmittance.wi * inside);
    values.lit += body.emission_weight * (transmittance.wo * transmittance.emission_wi * inside);
    return values;
}

/// Returns the matrices. A smooth coat reflects by its amplitudes, and transmits s and p each by its own part into the body, which depolarizes,
/// and out of it (Baek, Jeon, Tong and Kim 2018, section 4). Facets reflect by their amplitudes; a rough coat transmits and depolarizes.
fn coated_mueller(at: At, vertex: Vertex, n: vec4f) -> MuellerValues {
    let body = bodies[at.vertex];
    let coated = coated_of(body.material);
    let k = spectrum_at(coated.spectrum + 1u, at.group, at.wavelengths);
    let base = reflectance_at(at, body.base, factor_value(body.base, at));
    let outer = spectrum_at(coated.mean_reflectance, at.group, at.wavelengths);
    let inside = base * coated_albedo_factor(base, n, outer);
    if (HAS_ROUGH_COATS && material_at(body.material).facets != NONE) {
        let first = coated.coat_reflectances;
        let wo = rough_coat_transmittance(first, body.wo_cosine, at.group, at.wavelengths);
        let wi = rough_coat_transmittance(first, body.wi_cosine, at.group, at.wavelengths);
        let emission_wi = rough_coat_transmittance(first, body.emission_wi_cosine, at.group, at.wavelengths);
        let once = bare_mueller(at, vertex, n, k);
        return MuellerValues(
            mueller_and_depolarizer(once.onward, body.weight * (wo * wi * inside)),
            mueller_and_depolarizer(once.lit, body.emission_weight * (wo * emission_wi * inside)),
        );
    }
    let mirrored = mueller_of(interface_polarized(n, k, vertex.cosine), vertex.weight);
    let wo = interface_polarized(n, vec4f(0.0), max(body.wo_cosine, 1e-6));
    let wi = interface_polarized(n, vec4f(0.0), max(body.wi_cosine, 1e-6));
    let emission_wi = interface_polarized(n, vec4f(0.0), max(body.emission_wi_cosine, 1e-6));
    let scattered = mueller_product(1.0 - wo.s, 1.0 - wo.p, 1.0 - wi.s, 1.0 - wi.p, body.weight * inside);
    return MuellerValues(
        mueller_sum(mirrored, scattered),
        mueller_product(1.0 - wo.s, 1.0 - wo.p, 1.0 - emission_wi.s, 1.0 - emission_wi.p, body.emission_weight * inside),
    );
}

/// The transmittance of a coat toward the camera, from the path's next vertex, and from the emitter sample.
struct CoatTransmittance {
    wo: vec4f,
    wi: vec4f,
    emission_wi: vec4f,
}
