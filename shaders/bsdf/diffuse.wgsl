// Lambertian reflection: ρ / π.

fn diffuse_eval(wi: vec3f) -> BsdfEval {
    let lambert = max(wi.z, 0.0) / PI;
    return BsdfEval(Lobes(lambert, 0.0, 0.0, 1.0, wi.z), lambert);
}

fn diffuse_sample(random: vec4f) -> vec3f {
    return sample_cosine_hemisphere(random.x, random.y);
}

/// Returns the factor of a reflectance at a point: a spectrum, or a texel of its picture.
fn diffuse_factor(record: u32, object: u32, position: vec3f, random: f32) -> u32 {
    let reflectance = load_diffuse(record);
    if (HAS_TEXTURES && reflectance.picture != NONE) {
        let head = reflectance.picture;
        let place = picture_uv(texel_at(head).zw, object, position);
        let pixel = chosen_pixel(head, place, shape_at(object).kind == SHAPE_SPHERE, random);
        return factor_of(FACTOR_TEXTURE, head + 1u + pixel);
    }
    return factor_of(FACTOR_DIFFUSE, reflectance_spectrum(reflectance, object, position));
}

/// Returns the spectrum of a reflectance at a point: one of the two of a checker, or the only one.
fn reflectance_spectrum(reflectance: Diffuse, object: u32, position: vec3f) -> u32 {
    if (!HAS_CHECKERS || reflectance.spectrum == reflectance.odd_spectrum) {
        return reflectance.spectrum;
    }
    let local = (position - shape_at(object).center) / reflectance.checker_size;
    var squares = floor(local);
    if (shape_at(object).kind != SHAPE_SPHERE) {
        let axes = vec2f(dot(local, shape_at(object).tangent), dot(local, shape_at(object).bitangent));
        squares = vec3f(floor(axes), 0.0);
    }
    let half = 0.5 * (squares.x + squares.y + squares.z);
    return select(reflectance.odd_spectrum, reflectance.spectrum, half == floor(half));
}

/// Returns the value of a reflectance's factor, where `first` is the spectrum with the factor's index.
fn reflectance_at(at: At, factor: u32, first: vec4f) -> vec4f {
    if (HAS_TEXTURES && factor_tag(factor) == FACTOR_TEXTURE) {
        return smooth_value(texel_at(factor_number(factor)).xyz, at.group, at.wavelengths);
    }
    return first;
}

fn diffuse_value(at: At, vertex: Vertex, first: vec4f) -> Values {
    let reflectance = reflectance_at(at, vertex.factor, first);
    return Values(vertex.weight * reflectance, vertex.emission_weight * reflectance);
}
