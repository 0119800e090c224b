// The renderer: one invocation per pixel of a tile takes a run of samples, one after another, so that a pixel's bits do not depend
// on how the samples were divided among dispatches.

/// The first of the deviations and of the colors, in sets of all pixels.
const FIRST_DEVIATION: u32 = LIGHT_GROUPS * GROUPS;
const FIRST_COLOR: u32 = FIRST_DEVIATION + GROUPS;

/// Whether S1, S2 and S3 are kept.
const KEEPS_STOKES: bool = HAS_POLARIZATION && !HAS_POLARIZER;
/// The first of the means of S1, S2 and S3, `[component][light group][group]`, and of their colors, `[component][light group]`.
const FIRST_POLARIZED: u32 = FIRST_COLOR + LIGHT_GROUPS;
const FIRST_POLARIZED_COLOR: u32 = FIRST_POLARIZED + 3u * LIGHT_GROUPS * GROUPS;
const POLARIZED_COLORS: u32 = 3u * LIGHT_GROUPS;

/// X, Y, Z per nm of band width of S1, S2 and S3 of a sample, `[component][light group]`.
var<private> polarized_color: array<vec3f, POLARIZED_COLORS>;

/// The observer's functions in four bands.
struct Observed {
    x: vec4f,
    y: vec4f,
    z: vec4f,
}

/// Returns X, Y, Z of four bands, per nm of band width.
fn observed_color(value: vec4f, by: Observed) -> vec3f {
    return vec3f(dot(value, by.x), dot(value, by.y), dot(value, by.z));
}

/// Adds S1, S2 and S3 of a light group to the running means and to the colors of the sample. `place` is the group's mean of S1.
fn add_components(light_group: u32, place: u32, pixels: u32, count: f32, dimmed: f32, light: Stokes4, by: Observed) {
    let next = LIGHT_GROUPS * GROUPS * pixels;
    let s1 = dimmed * light.s1;
    let s2 = dimmed * light.s2;
    let s3 = dimmed * light.s3;
    let over = 1.0 / count;
    sums[place] += (s1 - sums[place]) * over;
    sums[place + next] += (s2 - sums[place + next]) * over;
    sums[place + 2u * next] += (s3 - sums[place + 2u * next]) * over;
    polarized_color[light_group] += observed_color(s1, by);
    polarized_color[LIGHT_GROUPS + light_group] += observed_color(s2, by);
    polarized_color[2u * LIGHT_GROUPS + light_group] += observed_color(s3, by);
}

/// Adds the colors of S1, S2 and S3 of a sample to the running means.
fn add_polarized_colors(pixel: u32, pixels: u32, count: f32) {
    for (var k = 0u; k < POLARIZED_COLORS; k++) {
        let place = (FIRST_POLARIZED_COLOR + k) * pixels + pixel;
        let so_far = sums[place].xyz;
        sums[place] = vec4f(so_far + (polarized_color[k] - so_far) / count, 0.0);
        polarized_color[k] = vec3f(0.0);
    }
}

/// Adds a path's spectrum to the running means (Welford 1962) and returns its X, Y, Z per nm of band width, by light group.
fn accumulate(pixel: u32, pixels: u32, count: f32, at: Wavelengths) -> array<vec3f, LIGHT_GROUPS> {
    var color: array<vec3f, LIGHT_GROUPS>;
    let dimmed = dimming(at);
    var group = 0u;
    loop {
        var radiance: array<vec4f, LIGHT_GROUPS>;
        if (HAS_POLARIZATION) {
            let light = path_stokes(group, at);
            for (var k = 0u; k < LIGHT_GROUPS; k++) {
                radiance[k] = sensed(light[k], group, at);
            }
            if (KEEPS_STOKES) {
                let by = Observed(
                    spectrum_at(frame.observer, group, at),
                    spectrum_at(frame.observer + 1u, group, at),
                    spectrum_at(frame.observer + 2u, group, at),
                );
                for (var k = 0u; k < LIGHT_GROUPS; k++) {
                    add_components(k, ((FIRST_POLARIZED + k * GROUPS) + group) * pixels + pixel, pixels, count, dimmed, light[k], by);
                }
            }
        } else {
            radiance = path_radiance(group, at);
        }
        let x = spectrum_at(frame.observer, group, at);
        let y = spectrum_at(frame.observer + 1u, group, at);
        let z = spectrum_at(frame.observer + 2u, group, at);
        // The deviations of the total from its mean, before and after: the sums of those of the light groups.
        var before = vec4f(0.0);
        var after = vec4f(0.0);
        for (var light_group = 0u; light_group < LIGHT_GROUPS; light_group++) {
            let value = dimmed * radiance[light_group];
            let place = (light_group * GROUPS + group) * pixels + pixel;
            let so_far = sums[place];
            let difference = value - so_far;
            let mean = so_far + difference / count;
            sums[place] = mean;
            before += difference;
            after += value - mean;
            color[light_group] += vec3f(dot(value, x), dot(value, y), dot(value, z));
        }
        sums[(FIRST_DEVIATION + group) * pixels + pixel] += before * after;
        continuing {
            group++;
            break if group >= GROUPS;
        }
    }
    return color;
}

/// Whether loops still run to their end. Some drivers silently end every loop of an invocation after a certain total number of passes
/// (llvmpipe: 65535). The samples of such an invocation must not count.
fn loops_run(wanted: u32) -> bool {
    var passes = 0u;
    for (var i = 0u; i < wanted; i++) {
        passes += 1u;
    }
    return passes == wanted;
}

@compute @workgroup_size(WORKGROUP_SIDE, WORKGROUP_SIDE)
fn render(@builtin(global_invocation_id) id: vec3u) {
    let batch = batches[min(id.z, BATCH_COPIES - 1u)];
    if (id.x >= batch.tile_size.x || id.y >= batch.tile_size.y) {
        return;
    }
    let pixel = id.y * batch.tile_size.x + id.x;
    let pixels = batch.tile_size.x * batch.tile_size.y;
    var color: array<vec4f, LIGHT_GROUPS>;
    for (var light_group = 0u; light_group < LIGHT_GROUPS; light_group++) {
        color[light_group] = sums[(FIRST_COLOR + light_group) * pixels + pixel];
    }
    for (var i = 0u; i < batch.sample_count; i++) {
        let index = batch.first_sample + i;
        let count = f32(batch.taken + i + 1u);
        let at = trace_path(Sample(batch.tile_origin + id.xy, index));
        let xyz = accumulate(pixel, pixels, count, at);
        if (KEEPS_STOKES) {
            add_polarized_colors(pixel, pixels, count);
        }
        for (var light_group = 0u; light_group < LIGHT_GROUPS; light_group++) {
            color[light_group] += vec4f((xyz[light_group] - color[light_group].xyz) / count, 0.0);
        }
    }
    if (loops_run(batch.passes)) {
        color[0].w += f32(batch.sample_count);
    }
    for (var light_group = 0u; light_group < LIGHT_GROUPS; light_group++) {
        sums[(FIRST_COLOR + light_group) * pixels + pixel] = color[light_group];
    }
}
