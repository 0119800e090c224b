// The wavelength-dependent factors of films and conductors, as a path records them.

/// The factor of a film at a point: its reflectance or its transmittance.
fn film_factor(object: u32, point: SurfacePoint, reflects: bool) -> Factor {
    let material = objects[object].material;
    let film = materials[material].film;
    if (HAS_STACKS && film == FILM_STACK) {
        let reflected = select(FACTOR_STACK_REFLECTS_BACK, FACTOR_STACK_REFLECTS, point.is_front);
        return layers_factor(select(FACTOR_STACK_TRANSMITS, reflected, reflects), object, point);
    }
    let layer = materials[material].first_layer;
    let thickness_nm = layer_thickness(layer, object, point.position);
    if (HAS_TWO_BEAM_FILMS && film >= FILM_TWO_BEAM) {
        let kind = select(FACTOR_TWO_BEAM_TRANSMITS, FACTOR_TWO_BEAM_REFLECTS, reflects);
        return Factor(kind, material, point.cosine, thickness_nm, 0u);
    }
    var kind = select(FACTOR_FILM_TRANSMITS, FACTOR_FILM_REFLECTS, reflects);
    if (HAS_LOSSY_FILMS && film == FILM_LOSSY) {
        kind = select(FACTOR_LOSSY_FILM_TRANSMITS, FACTOR_LOSSY_FILM_REFLECTS, reflects);
    }
    return Factor(kind, layers[layer].spectrum, point.cosine, thickness_nm, 0u);
}

/// The factor of a conductor at a point, with the surface's own cosine.
fn conductor_factor(object: u32, point: SurfacePoint) -> Factor {
    let material = objects[object].material;
    if (HAS_COATINGS && materials[material].layer_count > 0u) {
        return layers_factor(FACTOR_COATED, object, point);
    }
    return Factor(FACTOR_CONDUCTOR, materials[material].spectrum, point.cosine, 0.0, 0u);
}

/// A factor of layers, with the thicknesses that vary over the surface put on record.
fn layers_factor(kind: u32, object: u32, point: SurfacePoint) -> Factor {
    let material = objects[object].material;
    let factor = Factor(kind, material, point.cosine, 0.0, thickness_count);
    let first = materials[material].first_layer;
    for (var layer = first; layer < first + materials[material].layer_count; layer++) {
        if (layer_varies(layer)) {
            push_thickness(layer_thickness(layer, object, point.position));
        }
    }
    return factor;
}
