// Many stacks at many angles and wavelengths: each invocation evaluates one stack at one angle and four wavelengths.

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

@compute @workgroup_size(STACK_WORKGROUP)
fn evaluate_stacks(@builtin(global_invocation_id) id: vec3u, @builtin(num_workgroups) size: vec3u) {
    let item = id.x + id.y * size.x * STACK_WORKGROUP;
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
