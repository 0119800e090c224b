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

/// Returns the radiance by light group that the camera measures of a path in the four bands of a group. Adds S1, S2 and S3 to the running
/// means and to the colors of the sample.
fn polarized_radiance(pixel: u32, pixels: u32, count: f32, group: u32, at: Wavelengths, dimmed: f32) -> array<vec4f, LIGHT_GROUPS> {
    let light = path_stokes(group, at);
    var radiance: array<vec4f, LIGHT_GROUPS>;
    for (var light_group = 0u; light_group < LIGHT_GROUPS; light_group++) {
        radiance[light_group] = sensed(light[light_group], group, at);
        if (KEEPS_STOKES) {
            let found = light[light_group];
            for (var component = 0u; component < 3u; component++) {
                let kept = select(select(found.s3, found.s2, component == 1u), found.s1, component == 0u);
                let place = component * LIGHT_GROUPS + light_group;
                add_component(place, ((FIRST_POLARIZED + place * GROUPS) + group) * pixels + pixel, count, dimmed * kept, group, at);
            }
        }
    }
    return radiance;
}

/// Adds a value of a component of the Stokes vector to its running mean and to its color.
fn add_component(color: u32, place: u32, count: f32, value: vec4f, group: u32, at: Wavelengths) {
    let so_far = sums[place];
    sums[place] = so_far + (value - so_far) / count;
    let x = spectrum_at(frame.observer, group, at);
    let y = spectrum_at(frame.observer + 1u, group, at);
    let z = spectrum_at(frame.observer + 2u, group, at);
    polarized_color[color] += vec3f(dot(value, x), dot(value, y), dot(value, z));
}

/// Adds a path's spectrum to the running means (Welford 1962) and returns its X, Y, Z per nm of band width, by light group.
fn accumulate(pixel: u32, pixels: u32, count: f32, at: Wavelengths) -> array<vec3f, LIGHT_GROUPS> {
    var color: array<vec3f, LIGHT_GROUPS>;
    let dimmed = dimming(at);
    var group = 0u;
    loop {
        var radiance: array<vec4f, LIGHT_GROUPS>;
        if (HAS_POLARIZATION) {
            radiance = polarized_radiance(pixel, pixels, count, group, at, dimmed);
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
        if (KEEPS_STOKES) {
            for (var k = 0u; k < POLARIZED_COLORS; k++) {
                polarized_color[k] = vec3f(0.0);
            }
        }
        let xyz = accumulate(pixel, pixels, count, at);
        if (KEEPS_STOKES) {
            for (var k = 0u; k < POLARIZED_COLORS; k++) {
                let place = (FIRST_POLARIZED_COLOR + k) * pixels + pixel;
                let so_far = sums[place].xyz;
                sums[place] = vec4f(so_far + (polarized_color[k] - so_far) / count, 0.0);
            }
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
