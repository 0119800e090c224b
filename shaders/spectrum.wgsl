// Spectra, read four bands at a time.

/// The wavelengths of one sample: all bands share one offset, so that a lookup reads two rows.
struct Wavelengths {
    /// Position in each band, in [0, 1).
    offset: f32,
    /// The knot at or below the offset.
    knot: u32,
    /// Fraction of the distance to the next knot, in [0, 1).
    fraction: f32,
}

fn wavelengths_at(offset: f32) -> Wavelengths {
    let position = offset * f32(frame.steps);
    let knot = min(u32(position), frame.steps - 1u);
    return Wavelengths(offset, knot, position - f32(knot));
}

/// Returns the values of a spectrum in the four bands of a group.
fn spectrum_at(spectrum: u32, group: u32, at: Wavelengths) -> vec4f {
    let here = (spectrum * (frame.steps + 1u) + at.knot) * GROUPS + group;
    return mix(spectra_row(here), spectra_row(here + GROUPS), at.fraction);
}

/// Returns 1/λ in the four bands of a group, nm⁻¹.
fn inverse_wavelengths(group: u32, at: Wavelengths) -> vec4f {
    let band = f32(4u * group) + at.offset + vec4f(0.0, 1.0, 2.0, 3.0);
    return 1.0 / (frame.band_min_nm + band * frame.band_width_nm);
}
