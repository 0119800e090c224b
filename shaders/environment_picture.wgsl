// An environment given as a picture of all directions.

/// The table of a picture by which directions are sampled.
struct DirectionTable {
    columns: u32,
    rows: u32,
    /// Density of light at the picture's mean brightness, on the scale of the density of the sampled light; 0 where all light is sampled.
    even_density: f32,
    /// First of the heights of the rows' edges, from the top.
    heights: u32,
    /// First of the cumulative probabilities of the rows.
    marginal: u32,
    /// First of the cumulative probabilities of the cells of the first row.
    conditional: u32,
}

fn direction_table(emitter: u32) -> DirectionTable {
    let picture = load_panorama(emitter_at(emitter).record);
    let heights = picture.first_number;
    let marginal = heights + picture.rows + 1u;
    return DirectionTable(picture.columns, picture.rows, picture.even_density, heights, marginal, marginal + picture.rows + 1u);
}

/// Returns the position of a direction in the picture, from its upper left corner, in units of its width and height.
fn environment_uv(emitter: u32, direction: vec3f) -> vec2f {
    let aside = dot(direction, emitter_at(emitter).tangent);
    // Straight up and down, any longitude is right.
    let angle = polar_angle(dot(direction, emitter_at(emitter).axis), max(abs(aside), 1e-30));
    let longitude = select(angle, -angle, aside < 0.0) / (2.0 * PI);
    return vec2f(0.5 + longitude, polar_angle(direction.y, length(direction.xz)) / PI);
}

/// Returns the first texel of the pixel that a path uses for a direction, chosen by a random number.
fn environment_pixel(emitter: u32, direction: vec3f, random: f32) -> u32 {
    let picture = load_panorama(emitter_at(emitter).record);
    let pixel = chosen_pixel(picture.head, environment_uv(emitter, direction), true, random);
    return picture.head + 1u + pixel * picture.per_pixel;
}

/// Returns the interval between `count` + 1 increasing numbers from 0 to 1 that contains `u`.
fn interval_of(first: u32, count: u32, u: f32) -> u32 {
    var low = 0u;
    var high = count;
    while (high - low > 1u) {
        let middle = (low + high) / 2u;
        if (number_at(first + middle) <= u) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}

/// Returns the position of a number between the edges of its interval.
fn position_in_interval(edge: u32, u: f32) -> f32 {
    let low = number_at(edge);
    return min((u - low) / (number_at(edge + 1u) - low), 1.0);
}

/// Samples a direction in proportion to the brightness of the cells of the picture's table.
fn sample_environment_picture(emitter: u32, random: vec2f) -> vec3f {
    let table = direction_table(emitter);
    let row = interval_of(table.marginal, table.rows, random.x);
    let top = number_at(table.heights + row);
    let bottom = number_at(table.heights + row + 1u);
    let height = top + (bottom - top) * position_in_interval(table.marginal + row, random.x);
    let cells = table.conditional + row * (table.columns + 1u);
    let column = interval_of(cells, table.columns, random.y);
    let turn = (f32(column) + position_in_interval(cells + column, random.y)) / f32(table.columns) - 0.5;
    let around = sqrt(max((1.0 - height) * (1.0 + height), 0.0)) * direction_of_turn(turn);
    return around.y * emitter_at(emitter).tangent + around.x * emitter_at(emitter).axis + vec3f(0.0, height, 0.0);
}

/// Returns the density of sample_environment_picture, sr⁻¹: the probability of the direction's cell over its solid angle.
fn environment_picture_pdf(emitter: u32, direction: vec3f) -> f32 {
    let table = direction_table(emitter);
    let place = environment_uv(emitter, direction);
    let row = min(u32(place.y * f32(table.rows)), table.rows - 1u);
    let column = min(u32(place.x * f32(table.columns)), table.columns - 1u);
    let cell = table.conditional + row * (table.columns + 1u) + column;
    let of_row = number_at(table.marginal + row + 1u) - number_at(table.marginal + row);
    let of_cell = number_at(cell + 1u) - number_at(cell);
    let drop = number_at(table.heights + row) - number_at(table.heights + row + 1u);
    return of_row * of_cell * f32(table.columns) / (2.0 * PI * drop);
}
