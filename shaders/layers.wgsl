// Thin layers: free films, and layers on conductors. Their data at a hit is recorded; their powers are computed later, band by band.

/// The layers of a film or of a coating at a point.
struct Layers {
    /// Row of the outermost layer.
    first: u32,
    count: u32,
    /// Number of layers whose thickness varies over the surface, and the first of their recorded thicknesses.
    varying_count: u32,
    first_thickness: u32,
}

/// A film at the point where a path meets it.
struct FilmAt {
    factor: u32,
    cosine: f32,
    /// Thickness of a film's only layer, nm.
    thickness_nm: f32,
    /// For several layers, the first of the recorded thicknesses.
    first_thickness: u32,
}

/// Records the thicknesses of layers where they vary over the surface, and returns the index of the first.
fn record_layers(first: u32, count: u32, object: u32, position: vec3f) -> u32 {
    let place = thickness_count;
    if (RECORDS_THICKNESSES) {
        for (var layer = first; layer < first + count; layer++) {
            if (layer_varies(layer)) {
                push_thickness(layer_thickness(layer, object, position));
            }
        }
    }
    return place;
}

/// Returns the film at a point.
fn film_at(object: u32, point: SurfacePoint) -> FilmAt {
    let record = material_at(shape_at(object).material).record;
    let film = load_film(record);
    if (HAS_STACKS && film.factor == FACTOR_STACK) {
        let tag = select(FACTOR_STACK_BACK, FACTOR_STACK, point.is_front);
        let first_thickness = record_layers(film.first_layer, film.layer_count, object, point.position);
        return FilmAt(factor_of(tag, record), point.cosine, 0.0, first_thickness);
    }
    let factor = factor_of(film.factor, load_layer(film.first_layer).spectrum);
    return FilmAt(factor, point.cosine, layer_thickness(film.first_layer, object, point.position), 0u);
}

/// Returns air at a cosine, as the incident medium.
fn air_above(cosine_in: f32) -> Incident {
    let cosine = max(cosine_in, GRAZING);
    return Incident(1.0, cosine * cosine);
}

/// Adds all layers to the stack below them, the last one first or the first one first.
fn with_layers(below: Stack, layers: Layers, incident: Incident, last_first: bool, at: At) -> Stack {
    let inverse = inverse_wavelengths(at.group, at.wavelengths);
    var stack = below;
    var place = layers.first_thickness;
    if (last_first) {
        place += layers.varying_count;
    }
    for (var i = 0u; i < layers.count; i++) {
        let layer = load_layer(layers.first + select(i, layers.count - 1u - i, last_first));
        var thickness_nm = layer.thickness_nm;
        if (RECORDS_THICKNESSES && layer.field_count > 0u) {
            place -= select(0u, 1u, last_first);
            thickness_nm = thicknesses[place];
            place += select(1u, 0u, last_first);
        }
        let n = spectrum_at(layer.spectrum, at.group, at.wavelengths);
        let k = spectrum_at(layer.spectrum + 1u, at.group, at.wavelengths);
        stack = stack_layer(stack, n, k, thickness_nm * inverse, incident);
    }
    return stack;
}

/// Returns the reflectance and transmittance of a free film, in the four bands of a group; `first` is the spectrum with the factor's index.
fn film_value(film: FilmAt, first: vec4f, at: At) -> FilmPowers {
    let tag = factor_tag(film.factor);
    if (HAS_STACKS && tag >= FACTOR_STACK) {
        return stack_value(film, at);
    }
    let inverse = inverse_wavelengths(at.group, at.wavelengths);
    if (HAS_TWO_BEAM_FILMS && tag >= FACTOR_TWO_BEAM) {
        let as_printed = tag == FACTOR_TWO_BEAM_AS_PRINTED;
        return FilmPowers(
            two_beam_reflectance(first, film.thickness_nm, inverse, film.cosine, as_printed),
            two_beam_transmittance(first, film.cosine),
        );
    }
    if (HAS_LOSSY_FILMS && tag == FACTOR_LOSSY_FILM) {
        let k = spectrum_at(factor_number(film.factor) + 1u, at.group, at.wavelengths);
        return film_powers(first, k, film.thickness_nm, inverse, film.cosine);
    }
    let reflectance = clear_film_reflectance(first, film.thickness_nm, inverse, film.cosine);
    return FilmPowers(reflectance, 1.0 - reflectance);
}

/// Returns the powers of a free film of several layers. Its transmittance is the same from both sides.
fn stack_value(film: FilmAt, at: At) -> FilmPowers {
    let record = load_film(factor_number(film.factor));
    let layers = Layers(record.first_layer, record.layer_count, record.varying_layers, film.first_thickness);
    let incident = air_above(film.cosine);
    let substrate = substrate_admittances(vec4f(1.0), vec4f(0.0), incident);
    let from_front = factor_tag(film.factor) == FACTOR_STACK;
    let stack = with_layers(stack_on(substrate), layers, incident, from_front, at);
    let powers = stack_powers(stack, substrate, incident);
    return FilmPowers(
        0.5 * (powers.reflectance_s + powers.reflectance_p),
        0.5 * (powers.transmittance_s + powers.transmittance_p),
    );
}
