// The wavelength-dependent factors of films and conductors, as a path records them.

/// The factor of a film or of a conductor at a point: its reflectance, or the transmittance of a film.
///
/// The thicknesses of several layers go on record where they vary over the surface; that of a film's only layer has its place
/// in the factor.
fn layered_factor(object: u32, point: SurfacePoint, reflects: bool) -> Factor {
    let material = objects[object].material;
    let kind = layered_kind(material, point.is_front, reflects);
    let on_record = is_recorded(kind);
    let first_thickness = thickness_count;
    let first = materials[material].first_layer;
    var thickness_nm = 0.0;
    for (var layer = first; layer < first + materials[material].layer_count; layer++) {
        if (!on_record || layer_varies(layer)) {
            thickness_nm = layer_thickness(layer, object, point.position);
            if (on_record) {
                push_thickness(thickness_nm);
            }
        }
    }
    return Factor(kind, factor_source(kind, material), point.cosine, thickness_nm, first_thickness);
}

/// The factor of a diffuse surface at a point: a spectrum, or a texel of its picture.
fn diffuse_factor(object: u32, position: vec3f, random: f32) -> Factor {
    let material = objects[object].material;
    let head = materials[material].picture;
    if (HAS_TEXTURES && head != NONE) {
        let place = picture_place(texel_at(head).zw, object, position);
        let pixel = chosen_pixel(head, place, objects[object].shape == SHAPE_SPHERE, random);
        return Factor(FACTOR_SMOOTH, head + 1u + pixel, 1.0, 0.0, 0u);
    }
    return Factor(FACTOR_REFLECTANCE, reflectance_spectrum(material, object, position), 1.0, 0.0, 0u);
}

/// The FACTOR_ tag of a film or conductor.
fn layered_kind(material: u32, is_front: bool, reflects: bool) -> u32 {
    if (!HAS_FILMS || materials[material].surface != SURFACE_FILM) {
        return select(FACTOR_CONDUCTOR, FACTOR_COATED, HAS_COATINGS && materials[material].layer_count > 0u);
    }
    let film = materials[material].film;
    if (HAS_STACKS && film == FILM_STACK) {
        let reflected = select(FACTOR_STACK_REFLECTS_BACK, FACTOR_STACK_REFLECTS, is_front);
        return select(FACTOR_STACK_TRANSMITS, reflected, reflects);
    }
    if (HAS_TWO_BEAM_FILMS && film >= FILM_TWO_BEAM) {
        return select(FACTOR_TWO_BEAM_TRANSMITS, FACTOR_TWO_BEAM_REFLECTS, reflects);
    }
    if (HAS_LOSSY_FILMS && film == FILM_LOSSY) {
        return select(FACTOR_LOSSY_FILM_TRANSMITS, FACTOR_LOSSY_FILM_REFLECTS, reflects);
    }
    return select(FACTOR_FILM_TRANSMITS, FACTOR_FILM_REFLECTS, reflects);
}

/// Whether a factor's thicknesses stand on record.
fn is_recorded(kind: u32) -> bool {
    return (HAS_COATINGS && kind == FACTOR_COATED)
        || (HAS_STACKS && kind >= FACTOR_STACK_REFLECTS && kind <= FACTOR_STACK_TRANSMITS);
}

/// What a factor's `spectrum` is: the spectrum, or the material that has the layers.
fn factor_source(kind: u32, material: u32) -> u32 {
    if (is_recorded(kind) || (HAS_TWO_BEAM_FILMS && kind >= FACTOR_TWO_BEAM_REFLECTS)) {
        return material;
    }
    if (HAS_FILMS && kind >= FACTOR_FILM_REFLECTS) {
        return layers[materials[material].first_layer].spectrum;
    }
    if ((HAS_COOK || HAS_BASES) && materials[material].surface >= SURFACE_COOK_D1) {
        return materials[material].coat;
    }
    return materials[material].spectrum;
}

/// Whether a surface follows Cook's model.
fn is_cook(material: u32) -> bool {
    let surface = materials[material].surface;
    return surface == SURFACE_COOK_D1 || surface == SURFACE_COOK_D2;
}
