// A diffuse body below a clear coat, smooth or rough.

override HAS_COATED_BODIES: bool = true;
override HAS_ROUGH_COATS: bool = true;

fn coated_of(material: u32) -> Coated {
    return load_coated(material_at(material).record);
}

/// Share of the paths that are mirrored by a smooth coat rather than sent on by the body below it: by an estimate of what either
/// brings. It steers noise only: the weights undo it.
fn coat_share(material: u32, cosine: f32) -> f32 {
    let coated = coated_of(material);
    let n = vec4f(coated.coat_estimate);
    let reflected = reflectance_unpolarized(n, vec4f(0.0), max(cosine, 1e-6)).x;
    let share = reflected / max(reflected + (1.0 - reflected) * coated.base_estimate, 1e-6);
    // A rough coat reflects less near grazing than a smooth one: both must stay within reach.
    return select(clamp(share, 0.1, 0.9), share, material_at(material).facets == NONE);
}

/// A smooth coat mirrors.
fn coated_specular_probability(material: u32, wo: vec3f) -> f32 {
    if (HAS_ROUGH_COATS && material_at(material).facets != NONE) {
        return 0.0;
    }
    return coat_share(material, wo.z);
}

fn coated_eval(material: u32, wo: vec3f, wi: vec3f) -> BsdfEval {
    let share = coat_share(material, wo.z);
    let lambert = max(wi.z, 0.0) / PI;
    let head = material_at(material);
    if (!HAS_ROUGH_COATS || head.facets == NONE) {
        return BsdfEval(Lobes(0.0, 0.0, lambert, 1.0, wi.z), (1.0 - share) * lambert);
    }
    let facets = load_facets(head.facets);
    var both = facets_eval(facets, wo, wi);
    if (wo.z > 0.0 && wi.z > 0.0) {
        both.lobes.body = coat_passage(facets, wo) * coat_passage(facets, wi) * lambert;
        both.pdf = mix(lambert, both.pdf, share);
    }
    return both;
}

fn coated_sample(material: u32, wo: vec3f, random: vec4f) -> vec3f {
    let head = material_at(material);
    if (HAS_ROUGH_COATS && head.facets != NONE) {
        let share = coat_share(material, wo.z);
        if (random.z < share) {
            return facets_sample(load_facets(head.facets), wo, vec4f(random.xy, random.z / share, random.w));
        }
    }
    return sample_cosine_hemisphere(random.x, random.y);
}

/// By how much more a rough coat lets through in a direction than its reflectances tell: 1 but for a brushed one.
fn coat_passage(facets: Facets, direction: vec3f) -> f32 {
    if (!HAS_GRAIN || facets.alpha.x == facets.alpha.y) {
        return 1.0;
    }
    return over_facets(facets.first_passage, facets.alpha, direction);
}

fn coated_factor(object: u32, point: SurfacePoint, random: f32) -> u32 {
    let material = shape_at(object).material;
    let coated = coated_of(material);
    pending_body.material = material;
    pending_body.base = diffuse_factor(coated.base, object, point.position, random);
    let facets = material_at(material).facets;
    if (HAS_SHEENS && facets != NONE) {
        pending_sheen.mean_energy = load_facets(facets).mean_energy;
    }
    return factor_of(FACTOR_COATED, coated.spectrum);
}

/// The part of light in a direction that a clear coat of index n lets in, or out of the body that way.
fn coat_passes(n: vec4f, cosine: f32) -> vec4f {
    return 1.0 - reflectance_unpolarized(n, vec4f(0.0), max(cosine, 1e-6));
}

/// The part of light in a direction that a rough coat lets in, or out of the body that way: 1 less the reflectance of its table, whose
/// spectra begin with `reflectances`.
fn rough_coat_passes(reflectances: u32, cosine: f32, group: u32, at: Wavelengths) -> vec4f {
    let place = sqrt(clamp(cosine, 0.0, 1.0)) * f32(COAT_COSINES - 1u);
    let knot = min(u32(place), COAT_COSINES - 2u);
    let first = reflectances + knot;
    return 1.0 - mix(spectrum_at(first, group, at), spectrum_at(first + 1u, group, at), place - f32(knot));
}

/// P/ρ of a body of reflectance ρ below a coat of index n whose reflectance for diffuse light is `outer`:
/// 1 / (n² − ρ (n² − 1 + Ē)).
fn coated_albedo_factor(base: vec4f, n: vec4f, outer: vec4f) -> vec4f {
    let n2 = n * n;
    return 1.0 / (n2 - base * (n2 - 1.0 + outer));
}

fn coated_spectrum(at: Place, vertex: Vertex, n: vec4f) -> Values {
    let body = bodies[at.vertex];
    let coated = coated_of(body.material);
    let k = spectrum_at(coated.spectrum + 1u, at.group, at.wavelengths);
    let base = reflectance_value(at, body.base, number_spectrum(body.base, at));
    let outer = spectrum_at(coated.mean_reflectance, at.group, at.wavelengths);
    let inside = base * coated_albedo_factor(base, n, outer);
    var values: Values;
    var passes: Passes;
    if (HAS_ROUGH_COATS && material_at(body.material).facets != NONE) {
        values = conductor_spectrum(at, vertex, n, k);
        passes.wo = rough_coat_passes(coated.coat_reflectances, body.wo_cosine, at.group, at.wavelengths);
        passes.wi = rough_coat_passes(coated.coat_reflectances, body.wi_cosine, at.group, at.wavelengths);
        passes.light_wi = rough_coat_passes(coated.coat_reflectances, body.light_wi_cosine, at.group, at.wavelengths);
    } else {
        values = Values(vertex.weight * reflectance_unpolarized(n, k, vertex.cosine), vec4f(0.0));
        passes.wo = coat_passes(n, body.wo_cosine);
        passes.wi = coat_passes(n, body.wi_cosine);
        passes.light_wi = coat_passes(n, body.light_wi_cosine);
    }
    values.onward += body.weight * (passes.wo * passes.wi * inside);
    values.lit += body.light_weight * (passes.wo * passes.light_wi * inside);
    return values;
}

/// What a coat lets through toward the camera, from the path's next vertex, and from the light that joins.
struct Passes {
    wo: vec4f,
    wi: vec4f,
    light_wi: vec4f,
}
