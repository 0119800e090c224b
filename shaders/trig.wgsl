// Trigonometric functions with guaranteed accuracy.
//
// WGSL guarantees sin and cos only to 2⁻¹¹, and only inside [−π, π]; acos and atan2 only to 4096 ulp. The functions here are
// accurate to a few ulp everywhere, on any driver. Angles are in turns or in half turns, so that a caller reduces them exactly, by
// fract or round.

const PI: f32 = 3.14159265359;

/// Returns sin(πx) for |x| ≤ 1/2; odd polynomial, relative error below 1e-7 (Taylor to x¹³, remainder below 1e-8 at 1/2).
fn sin_pi4(x: vec4f) -> vec4f {
    let x2 = x * x;
    var p = 4.6630281e-4 * x2 - 7.3704309e-3;
    p = p * x2 + 8.2145887e-2;
    p = p * x2 - 5.9926453e-1;
    p = p * x2 + 2.5501640;
    p = p * x2 - 5.1677128;
    p = p * x2 + 3.1415927;
    return p * x;
}

/// Returns (cos, sin) of an angle of `t` turns, t in [−1, 1].
fn direction_of_turn(t: f32) -> vec2f {
    // In half turns, reduced to [−1/2, 1/2] for the sine; the cosine is the sine a quarter turn on.
    let sine = sine_of_half_turns(2.0 * t);
    let cosine = sine_of_half_turns(2.0 * t + 0.5);
    return vec2f(cosine, sine);
}

/// Returns sin(πh) for any h of moderate size.
fn sine_of_half_turns(h: f32) -> f32 {
    let nearest = round(h);
    let odd = abs(nearest - 2.0 * round(0.5 * nearest)) > 0.5;
    let s = sin_pi4(vec4f(h - nearest)).x;
    return select(s, -s, odd);
}

/// Returns the angle in [0, π] whose cosine and sine are proportional to the arguments; `sine` ≥ 0, not both 0.
fn polar_angle(cosine: f32, sine: f32) -> f32 {
    let a = abs(cosine);
    let small = min(a, sine);
    let large = max(a, sine);
    // Halve the angle: tan(θ/2) = tan θ / (1 + √(1 + tan²θ)), so that the argument stays below 0.4143.
    let t = small / (large + sqrt(large * large + small * small));
    let t2 = t * t;
    // atan t = t − t³/3 + t⁵/5 …; the remainder after t¹⁵ is below 2e-8 at 0.4143.
    var p = 1.0 / 13.0 - t2 * (1.0 / 15.0);
    p = 1.0 / 11.0 - t2 * p;
    p = 1.0 / 9.0 - t2 * p;
    p = 1.0 / 7.0 - t2 * p;
    p = 1.0 / 5.0 - t2 * p;
    p = 1.0 / 3.0 - t2 * p;
    let half = t * (1.0 - t2 * p);
    var angle = 2.0 * half;
    angle = select(0.5 * PI - angle, angle, sine <= a);
    return select(angle, PI - angle, cosine < 0.0);
}
