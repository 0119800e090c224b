// Many stacks at many angles and wavelengths: each invocation evaluates one stack at one angle and four wavelengths.

@group(0) @binding(0) var<uniform> stack_run: StackRun;
/// Wavelengths, four at a time, nm; the last group is padded.
@group(0) @binding(1) var<storage, read> run_wavelengths: array<vec4f>;
/// Cosines in the incident medium.
@group(0) @binding(2) var<storage, read> run_cosines: array<f32>;
/// Indices: n of a medium for each group of wavelengths, then k in the same way; a single group where they are constant.
@group(0) @binding(3) var<storage, read> run_media: array<vec4f>;
@group(0) @binding(4) var<storage, read> run_layers: array<RunLayer>;
@group(0) @binding(5) var<storage, read> run_stacks: array<RunStack>;
/// R_s, R_p, T_s, T_p: [stack of this run][angle][wavelength].
@group(0) @binding(6) var<storage, read_write> run_powers: array<vec4f>;

/// Returns the index of a medium in a group of wavelengths.
fn run_index(medium: u32, group: u32) -> Complex4 {
    let groups = stack_run.media_groups;
    let place = 2u * medium * groups + min(group, groups - 1u);
    return Complex4(run_media[place], run_media[place + groups]);
}

/// Returns the powers of a stack of the batch at one angle and four wavelengths.
fn run_stack(stack: RunStack, cosine: f32, group: u32) -> StackPowers {
    let index2 = stack_run.incident * stack_run.incident;
    let incident = Incident(index2, index2 * cosine * cosine);
    let inverse = 1.0 / run_wavelengths[group];
    let below = run_index(stack.substrate, group);
    let substrate = substrate_admittances(below.re, below.im, incident);
    var built = stack_on(substrate);
    for (var i = stack.layer_count; i > 0u; i--) {
        let layer = run_layers[stack.first_layer + i - 1u];
        let index = run_index(layer.medium, group);
        built = stack_layer(built, index.re, index.im, layer.thickness_nm * inverse, incident);
    }
    return stack_powers(built, substrate, incident);
}

@compute @workgroup_size(64)
fn evaluate_stacks(@builtin(global_invocation_id) id: vec3u, @builtin(num_workgroups) size: vec3u) {
    let item = id.x + id.y * size.x * 64u;
    let groups = arrayLength(&run_wavelengths);
    let angles = arrayLength(&run_cosines);
    if (item >= stack_run.stack_count * angles * groups) {
        return;
    }
    let group = item % groups;
    let row = item / groups;
    let powers = run_stack(
        run_stacks[stack_run.first_stack + row / angles],
        run_cosines[row % angles],
        group,
    );
    let first = row * stack_run.wavelength_count + 4u * group;
    let last = min(4u, stack_run.wavelength_count - 4u * group);
    for (var lane = 0u; lane < last; lane++) {
        run_powers[first + lane] = vec4f(
            powers.reflectance_s[lane],
            powers.reflectance_p[lane],
            powers.transmittance_s[lane],
            powers.transmittance_p[lane],
        );
    }
}
