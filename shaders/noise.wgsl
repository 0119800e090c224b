// Gradient noise, and the streaks that a flow makes of it.

/// Gain before the noise is bounded: the root mean square of the noise is about a fifth.
const NOISE_GAIN: f32 = 5.0;
/// Offset of the seed that separates the noise of the stream function from the noise of the streaks.
const STREAM: u32 = 0x9e3779b9u;

/// Returns gradient noise with a quintic blend (Perlin, Improving Noise, 2002): at each point of the integer lattice it is 0 and
/// has a gradient drawn from the cube [−1, 1)³. `cells` is added to the third coordinate of the lattice, and `seed` selects the
/// gradients. The result is the derivatives and, in w, the value.
fn gradient_noise(place: vec3f, cells: u32, seed: u32) -> vec4f {
    let corner = bitcast<vec3u>(vec3i(floor(place))) + vec3u(0u, 0u, cells);
    let within = place - floor(place);
    var sum = vec4f(0.0);
    for (var index = 0u; index < LATTICE_CORNERS; index++) {
        let step = vec3u(index & 1u, (index >> 1u) & 1u, index >> 2u);
        let slope = 2.0 * unit_interval(pcg4d(vec4u(corner + step, seed))).xyz - 1.0;
        let distance = within - vec3f(step);
        // Distance from the corner along each axis, in [0, 1]; its blend falls from 1 to 0.
        let away = abs(distance);
        let w = 1.0 - away * away * away * (away * (6.0 * away - 15.0) + 10.0);
        let falls = (2.0 * vec3f(step) - 1.0) * (30.0 * away * away * (1.0 - away) * (1.0 - away));
        let weight = w.x * w.y * w.z;
        let ramp = dot(slope, distance);
        let weight_gradient = falls * vec3f(w.y * w.z, w.x * w.z, w.x * w.y);
        sum += vec4f(weight * slope + weight_gradient * ramp, weight * ramp);
    }
    return sum;
}

/// Returns the value of swirls at a point of an object's surface.
fn swirls(field: u32, object: u32, position: vec3f) -> f32 {
    let size = load_field(field).cells_per_unit;
    let cells = load_field(field).cells;
    let seed = load_field(field).seed;
    let time = vec3f(0.0, 0.0, load_field(field).phase);
    let local = position - shape_at(object).center;
    let is_sphere = HAS_SPHERES && shape_at(object).kind == SHAPE_SPHERE;
    var normal = vec3f(0.0, 0.0, 1.0);
    var place = size * vec3f(dot(local, shape_at(object).tangent), dot(local, shape_at(object).bitangent), 0.0);
    if (is_sphere) {
        normal = normalize(local);
        place = size * normal;
    }
    for (var i = 0u; i < WARP_STEPS; i++) {
        let stream = gradient_noise(place + time, cells, seed ^ STREAM).xyz;
        // n × ∇ψ runs along the lines of equal ψ, so the flow is free of divergence on the surface.
        place -= load_field(field).warp / f32(WARP_STEPS) * cross(normal, stream);
        if (is_sphere) {
            normal = normalize(place);
            place = size * normal;
        }
    }
    var sum = 0.0;
    var finer = 1.0;
    for (var octave = 0u; octave < load_field(field).octaves; octave++) {
        sum += gradient_noise(finer * place + time, cells, seed + octave).w / finer;
        finer *= 2.0;
    }
    // Bounded by ±1 and smooth.
    let x = NOISE_GAIN * sum;
    return load_field(field).base + load_field(field).swing * (x / sqrt(1.0 + x * x));
}
