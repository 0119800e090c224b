// The renderer: one invocation per pixel of a tile takes a run of samples, one after another, so that
// a pixel's bits do not depend on how the samples were divided among dispatches.

@group(1) @binding(0) var<uniform> batch: Batch;
/// Mean radiance so far: [group of four bands][pixel of the tile].
@group(1) @binding(1) var<storage, read_write> means: array<vec4f>;
/// Sum of squared differences from the mean so far, likewise.
@group(1) @binding(2) var<storage, read_write> deviations: array<vec4f>;
/// Mean X, Y, Z so far; w is unused: [pixel of the tile].
@group(1) @binding(3) var<storage, read_write> colors: array<vec4f>;

/// Adds a path's spectrum to the running means (Welford 1962) and returns its X, Y, Z per nm of band width.
fn accumulate(pixel: u32, count: f32, at: Wavelengths) -> vec3f {
    let pixels = batch.tile_size.x * batch.tile_size.y;
    var color = vec3f(0.0);
    for (var group = 0u; group < frame.groups; group++) {
        let radiance = path_radiance(group, at);
        let place = group * pixels + pixel;
        let before = radiance - means[place];
        let mean = means[place] + before / count;
        means[place] = mean;
        deviations[place] += before * (radiance - mean);
        color += vec3f(
            dot(radiance, spectrum_at(frame.observer, group, at)),
            dot(radiance, spectrum_at(frame.observer + 1u, group, at)),
            dot(radiance, spectrum_at(frame.observer + 2u, group, at)),
        );
    }
    return color;
}

@compute @workgroup_size(WORKGROUP_SIDE, WORKGROUP_SIDE)
fn render(@builtin(global_invocation_id) id: vec3u) {
    if (id.x >= batch.tile_size.x || id.y >= batch.tile_size.y) {
        return;
    }
    let pixel = id.y * batch.tile_size.x + id.x;
    var color = colors[pixel];
    for (var i = 0u; i < batch.sample_count; i++) {
        let index = batch.first_sample + i;
        let count = f32(index + 1u);
        let at = trace_path(Sample(batch.tile_origin + id.xy, index));
        let xyz = accumulate(pixel, count, at);
        color += (vec4f(xyz, 0.0) - color) / count;
    }
    colors[pixel] = color;
}
