// How surfaces scatter light: one file per BSDF, with its geometry (`eval`, `sample`, a specular part) and its value over the
// spectrum (`value`). This file dispatches on the tags of materials.
//
// `wo` points to the camera's side of a path and `wi` to the light's. They are unit vectors of the surface's local frame, whose z is the
// normal on the side of `wo` and whose x runs along the grain of a brushed surface. Values are those of the BSDF times |cos θi|.

/// Returns the probability with which a path takes the specular part: 1 for purely specular BSDFs, 0 for those without a specular part.
fn bsdf_specular_probability(material: u32, wo: vec3f) -> f32 {
    let head = material_at(material);
    if (HAS_MIRRORS && head.surface == SURFACE_INTERFACE) {
        return interface_specular_probability(head);
    }
    if (HAS_COATED_BODIES && head.surface == SURFACE_COATED) {
        return coated_specular_probability(material, wo);
    }
    return 0.0;
}

/// Returns the value from `wi` to `wo` without the specular part, and the density of bsdf_sample.
fn bsdf_eval(material: u32, wo: vec3f, wi: vec3f) -> BsdfEval {
    let surface = material_at(material).surface;
    if (HAS_COOK && surface == SURFACE_COOK) {
        return cook_eval(material, wo, wi);
    }
    if ((HAS_COATED_BODIES || HAS_ROUGH_COATS) && surface == SURFACE_COATED) {
        return coated_eval(material, wo, wi);
    }
    if (HAS_ROUGH_CONDUCTORS && surface == SURFACE_INTERFACE) {
        return interface_eval(material, wo, wi);
    }
    return diffuse_eval(wi);
}

/// Samples a direction `wi` from numbers in [0, 1): the first two determine the direction, the third and the fourth choose between parts.
fn bsdf_sample(material: u32, wo: vec3f, random: vec4f) -> vec3f {
    let surface = material_at(material).surface;
    if (HAS_COOK && surface == SURFACE_COOK) {
        return cook_sample(material, wo, random);
    }
    if ((HAS_COATED_BODIES || HAS_ROUGH_COATS) && surface == SURFACE_COATED) {
        return coated_sample(material, wo, random);
    }
    if (HAS_ROUGH_CONDUCTORS && surface == SURFACE_INTERFACE) {
        return interface_sample(material, wo, random);
    }
    return diffuse_sample(random);
}

/// Returns the factor of a surface at a point; other data for its spectrum is written to the pending vertex. `random` in [0, 1)
/// chooses between the texels of a picture.
fn bsdf_factor(object: u32, point: SurfacePoint, random: f32) -> u32 {
    let material = shape_at(object).material;
    let head = material_at(material);
    if ((HAS_COATED_BODIES || HAS_ROUGH_COATS) && head.surface == SURFACE_COATED) {
        return coated_factor(object, point, random);
    }
    if (HAS_COOK && head.surface == SURFACE_COOK) {
        return cook_factor(material);
    }
    if (HAS_INTERFACES && head.surface == SURFACE_INTERFACE) {
        return interface_factor(object, point);
    }
    return diffuse_factor(head.record, object, point.position, random);
}

/// The reference axes of light that leaves a surface toward the camera, and of light that arrives.
struct ScatteringAxes {
    toward_camera: vec3f,
    toward_light: vec3f,
}

/// Returns the axes across the plane of incidence at the facet, or across the planes in which light leaves and enters the body below a smooth
/// coat. Directions are in world space.
fn scattering_axes(material: u32, wo: vec3f, wi: vec3f, normal: vec3f) -> ScatteringAxes {
    let head = material_at(material);
    if (HAS_COATED_BODIES && head.surface == SURFACE_COATED && (!HAS_ROUGH_COATS || head.facets == NONE)) {
        return ScatteringAxes(axis_across(wo, normal), axis_across(wi, normal));
    }
    let across = axis_across(wo, wi);
    return ScatteringAxes(across, across);
}

/// Returns the matrices at a vertex in four bands; `first` is the spectrum with the factor's index.
fn bsdf_mueller(at: At, vertex: Vertex, first: vec4f) -> MuellerValues {
    let tag = factor_tag(vertex.factor);
    if ((HAS_COATED_BODIES || HAS_ROUGH_COATS) && tag == FACTOR_COATED) {
        return coated_mueller(at, vertex, first);
    }
    if (HAS_COOK && tag == FACTOR_COOK) {
        return cook_mueller(at, vertex, first);
    }
    if (HAS_INTERFACES && (tag == FACTOR_INTERFACE || tag == FACTOR_COATING)) {
        return interface_mueller(at, vertex, first);
    }
    let values = diffuse_value(at, vertex, first);
    return MuellerValues(mueller_depolarizer(values.onward), mueller_depolarizer(values.lit));
}

/// Returns the spectrum at a vertex in four bands; `first` is the spectrum with the factor's index.
fn bsdf_value(at: At, vertex: Vertex, first: vec4f) -> Values {
    let tag = factor_tag(vertex.factor);
    if ((HAS_COATED_BODIES || HAS_ROUGH_COATS) && tag == FACTOR_COATED) {
        return coated_value(at, vertex, first);
    }
    if (HAS_COOK && tag == FACTOR_COOK) {
        return cook_value(at, vertex, first);
    }
    if (HAS_INTERFACES && (tag == FACTOR_INTERFACE || tag == FACTOR_COATING)) {
        return interface_value(at, vertex, first);
    }
    return diffuse_value(at, vertex, first);
}
