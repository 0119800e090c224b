// The boundary of a conductor, bare or below thin layers: smooth, or made of specular facets.

fn interface_specular_probability(head: Material) -> f32 {
    return select(0.0, 1.0, head.facets == NONE);
}

fn interface_eval(material: u32, wo: vec3f, wi: vec3f) -> BsdfEval {
    return facets_eval(load_facets(material_at(material).facets), wo, wi);
}

fn interface_sample(material: u32, wo: vec3f, random: vec4f) -> vec3f {
    return facets_sample(load_facets(material_at(material).facets), wo, random);
}

fn interface_factor(object: u32, point: SurfacePoint) -> u32 {
    let head = material_at(shape_at(object).material);
    let boundary = load_interface(head.record);
    if (HAS_MULTIPLE_SCATTERING && head.facets != NONE) {
        pending_multiple.mean_energy = load_facets(head.facets).mean_energy;
    }
    if (HAS_COATINGS && boundary.layer_count > 0u) {
        pending_thickness = record_layers(boundary.first_layer, boundary.layer_count, object, point.position);
        return factor_of(FACTOR_COATING, head.record);
    }
    return factor_of(FACTOR_INTERFACE, boundary.spectrum);
}

fn interface_value(at: At, vertex: Vertex, first: vec4f) -> Values {
    if (HAS_COATINGS && factor_tag(vertex.factor) == FACTOR_COATING) {
        return coating_value(at, vertex);
    }
    return bare_value(at, vertex, first, spectrum_at(factor_number(vertex.factor) + 1u, at.group, at.wavelengths));
}

/// Returns the values of a bare conductor of index n + ik.
fn bare_value(at: At, vertex: Vertex, n: vec4f, k: vec4f) -> Values {
    var values = Values(vertex.weight * reflectance_unpolarized(n, k, vertex.cosine), vec4f(0.0));
    if (HAS_SCATTERING) {
        values.lit = vertex.emission_weight * reflectance_unpolarized(n, k, vertex.emission_cosine);
    }
    if (HAS_MULTIPLE_SCATTERING) {
        var mean = MEAN_WEIGHTS.x * reflectance_unpolarized(n, k, MEAN_COSINES.x);
        mean += MEAN_WEIGHTS.y * reflectance_unpolarized(n, k, MEAN_COSINES.y);
        mean += MEAN_WEIGHTS.z * reflectance_unpolarized(n, k, MEAN_COSINES.z);
        return with_multiple(values, multiples[at.vertex], mean);
    }
    return values;
}

/// Adds multiple scattering to the values, by the mean of the reflectance over a hemisphere.
fn with_multiple(once: Values, multiple: MultipleScattering, mean: vec4f) -> Values {
    let several = multiple_color(mean, multiple.mean_energy);
    return Values(once.onward + multiple.weight * several, once.lit + multiple.emission_weight * several);
}

/// Returns the values of layers on a conductor, one cosine after the other, so that their code occurs only once.
fn coating_value(at: At, vertex: Vertex) -> Values {
    let boundary = load_interface(factor_number(vertex.factor));
    let n = spectrum_at(boundary.spectrum, at.group, at.wavelengths);
    let k = spectrum_at(boundary.spectrum + 1u, at.group, at.wavelengths);
    var first_thickness = 0u;
    if (RECORDS_THICKNESSES) {
        first_thickness = first_thicknesses[at.vertex];
    }
    let layers = Layers(boundary.first_layer, boundary.layer_count, boundary.varying_layers, first_thickness);
    var values = Values(vec4f(0.0), vec4f(0.0));
    var mean = vec4f(0.0);
    let count = coating_cosines(at);
    var i = 0u;
    loop {
        var cosine = select(vertex.emission_cosine, vertex.cosine, i == 0u);
        if (HAS_MULTIPLE_SCATTERING && i >= 2u) {
            cosine = MEAN_COSINES[i - 2u];
        }
        let incident = air_above(cosine);
        let substrate = substrate_admittances(n, k, incident);
        let stack = with_layers(stack_on(substrate), layers, incident, true, at);
        let powers = stack_powers(stack, substrate, incident);
        let reflectance = 0.5 * (powers.reflectance_s + powers.reflectance_p);
        if (i == 0u) {
            values.onward = vertex.weight * reflectance;
        } else if (i == 1u) {
            values.lit = vertex.emission_weight * reflectance;
        } else if (HAS_MULTIPLE_SCATTERING) {
            mean += MEAN_WEIGHTS[i - 2u] * reflectance;
        }
        continuing {
            i++;
            break if i >= count;
        }
    }
    if (HAS_MULTIPLE_SCATTERING) {
        return with_multiple(values, multiples[at.vertex], mean);
    }
    return values;
}

/// Returns the matrices: facets and smooth surfaces act by their amplitudes; light that met several facets is unpolarized.
fn interface_mueller(at: At, vertex: Vertex, first: vec4f) -> MuellerValues {
    if (HAS_COATINGS && factor_tag(vertex.factor) == FACTOR_COATING) {
        return coating_mueller(at, vertex);
    }
    return bare_mueller(at, vertex, first, spectrum_at(factor_number(vertex.factor) + 1u, at.group, at.wavelengths));
}

/// Returns the matrices of a bare conductor of index n + ik.
fn bare_mueller(at: At, vertex: Vertex, n: vec4f, k: vec4f) -> MuellerValues {
    let onward = mueller_of(interface_polarized(n, k, vertex.cosine), vertex.weight);
    var values = MuellerValues(onward, onward);
    if (HAS_SCATTERING) {
        values.lit = mueller_of(interface_polarized(n, k, vertex.emission_cosine), vertex.emission_weight);
    }
    if (HAS_MULTIPLE_SCATTERING) {
        var mean = MEAN_WEIGHTS.x * reflectance_unpolarized(n, k, MEAN_COSINES.x);
        mean += MEAN_WEIGHTS.y * reflectance_unpolarized(n, k, MEAN_COSINES.y);
        mean += MEAN_WEIGHTS.z * reflectance_unpolarized(n, k, MEAN_COSINES.z);
        return mueller_with_multiple(values, multiples[at.vertex], mean);
    }
    return values;
}

/// Adds multiple scattering to the matrices, by the mean of the reflectance over a hemisphere.
fn mueller_with_multiple(once: MuellerValues, multiple: MultipleScattering, mean: vec4f) -> MuellerValues {
    let several = multiple_color(mean, multiple.mean_energy);
    return MuellerValues(
        mueller_and_depolarizer(once.onward, multiple.weight * several),
        mueller_and_depolarizer(once.lit, multiple.emission_weight * several),
    );
}

/// Returns the matrices of layers on a conductor, one cosine after the other, so that their code occurs only once.
fn coating_mueller(at: At, vertex: Vertex) -> MuellerValues {
    let boundary = load_interface(factor_number(vertex.factor));
    let n = spectrum_at(boundary.spectrum, at.group, at.wavelengths);
    let k = spectrum_at(boundary.spectrum + 1u, at.group, at.wavelengths);
    var first_thickness = 0u;
    if (RECORDS_THICKNESSES) {
        first_thickness = first_thicknesses[at.vertex];
    }
    let layers = Layers(boundary.first_layer, boundary.layer_count, boundary.varying_layers, first_thickness);
    var values: MuellerValues;
    var mean = vec4f(0.0);
    let count = coating_cosines(at);
    var i = 0u;
    loop {
        var cosine = select(vertex.emission_cosine, vertex.cosine, i == 0u);
        if (HAS_MULTIPLE_SCATTERING && i >= 2u) {
            cosine = MEAN_COSINES[i - 2u];
        }
        let incident = air_above(cosine);
        let substrate = substrate_admittances(n, k, incident);
        let stack = with_layers(stack_on(substrate), layers, incident, true, at);
        let reflected = stack_polarized(stack, substrate, incident).reflected;
        if (i == 0u) {
            values.onward = mueller_of(reflected, vertex.weight);
        } else if (i == 1u) {
            values.lit = mueller_of(reflected, vertex.emission_weight);
        } else if (HAS_MULTIPLE_SCATTERING) {
            mean += MEAN_WEIGHTS[i - 2u] * 0.5 * (reflected.s + reflected.p);
        }
        continuing {
            i++;
            break if i >= count;
        }
    }
    if (HAS_MULTIPLE_SCATTERING) {
        return mueller_with_multiple(values, multiples[at.vertex], mean);
    }
    return values;
}

/// Returns the number of cosines at which layers on a conductor are evaluated: of the path, of the emission, and for multiple scattering.
fn coating_cosines(at: At) -> u32 {
    if (HAS_MULTIPLE_SCATTERING && multiples[at.vertex].weight + multiples[at.vertex].emission_weight > 0.0) {
        return COATING_COSINES;
    }
    return select(1u, 2u, HAS_SCATTERING);
}
