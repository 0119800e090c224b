// Points that fill the unit cube uniformly, as a function of (pixel, sample, dimension, seed): integer arithmetic, the same bits in
// Rust and on every device.
//
// Four dimensions of Sobol's sequence (direction numbers of Joe and Kuo, SIAM J. Sci. Comput. 30, 2008) with Owen scrambling (1995)
// by hashing (Burley, Practical Hash-based Owen Scrambling, JCGT 9(4), 2020). Each group of four dimensions of a path has its own
// points, in another order. Numbers have their bits reversed, the most significant digit in bit 0, as the hash requires.

/// Returns Owen's scrambling of numbers with their bits reversed: a bit is flipped by a hash of the bits below it (Laine and
/// Karras, Comput. Graph. Forum 30, 2011, with the steps of Vegdahl, 2021).
fn scrambled(reversed: vec4u, seed: vec4u) -> vec4u {
    var x = reversed;
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> vec4u(16u)) | vec4u(1u);
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

/// Returns all bits set where the bit of the index is set, none elsewhere.
fn bit_of(index: u32, bit: u32) -> vec4u {
    return vec4u(0u - ((index >> bit) & 1u));
}

/// Returns a point of the sequence: the sum (XOR) of the direction numbers of the index's bits. Both have their bits reversed. A
/// pixel has at most 2²⁴ samples; higher bits would move all its points alike, which the scrambling does anyway. The loop is
/// unrolled by hand: some drivers count the passes of loops.
fn sobol_point(index: u32) -> vec4u {
    var point = vec4u(0u);
    point ^= bit_of(index, 31u) & vec4u(0x000001u, 0x000001u, 0x000001u, 0x000001u);
    point ^= bit_of(index, 30u) & vec4u(0x000002u, 0x000003u, 0x000003u, 0x000003u);
    point ^= bit_of(index, 29u) & vec4u(0x000004u, 0x000005u, 0x000006u, 0x000004u);
    point ^= bit_of(index, 28u) & vec4u(0x000008u, 0x00000fu, 0x000009u, 0x00000au);
    point ^= bit_of(index, 27u) & vec4u(0x000010u, 0x000011u, 0x000017u, 0x00001fu);
    point ^= bit_of(index, 26u) & vec4u(0x000020u, 0x000033u, 0x00003au, 0x00002eu);
    point ^= bit_of(index, 25u) & vec4u(0x000040u, 0x000055u, 0x000071u, 0x000045u);
    point ^= bit_of(index, 24u) & vec4u(0x000080u, 0x0000ffu, 0x0000a3u, 0x0000c9u);
    point ^= bit_of(index, 23u) & vec4u(0x000100u, 0x000101u, 0x000116u, 0x00011bu);
    point ^= bit_of(index, 22u) & vec4u(0x000200u, 0x000303u, 0x000339u, 0x0002a4u);
    point ^= bit_of(index, 21u) & vec4u(0x000400u, 0x000505u, 0x000677u, 0x00079au);
    point ^= bit_of(index, 20u) & vec4u(0x000800u, 0x000f0fu, 0x0009aau, 0x000b67u);
    point ^= bit_of(index, 19u) & vec4u(0x001000u, 0x001111u, 0x001601u, 0x00101eu);
    point ^= bit_of(index, 18u) & vec4u(0x002000u, 0x003333u, 0x003903u, 0x00302du);
    point ^= bit_of(index, 17u) & vec4u(0x004000u, 0x005555u, 0x007706u, 0x004041u);
    point ^= bit_of(index, 16u) & vec4u(0x008000u, 0x00ffffu, 0x00aa09u, 0x00a0c3u);
    point ^= bit_of(index, 15u) & vec4u(0x010000u, 0x010001u, 0x010117u, 0x01f104u);
    point ^= bit_of(index, 14u) & vec4u(0x020000u, 0x030003u, 0x03033au, 0x02e28au);
    point ^= bit_of(index, 13u) & vec4u(0x040000u, 0x050005u, 0x060671u, 0x0457dfu);
    point ^= bit_of(index, 12u) & vec4u(0x080000u, 0x0f000fu, 0x0909a3u, 0x0c9baeu);
    point ^= bit_of(index, 11u) & vec4u(0x100000u, 0x110011u, 0x171616u, 0x11a105u);
    point ^= bit_of(index, 10u) & vec4u(0x200000u, 0x330033u, 0x3a3939u, 0x2a7289u);
    point ^= bit_of(index, 9u) & vec4u(0x400000u, 0x550055u, 0x717777u, 0x79e7dbu);
    point ^= bit_of(index, 8u) & vec4u(0x800000u, 0xff00ffu, 0xa3aaaau, 0xb6dba4u);
    return point;
}

/// Returns four numbers in [0, 1) for a pixel of the whole picture, a sample and a dimension.
fn sobol4(pixel: vec2u, sample: u32, dimension: u32, seed: u32) -> vec4f {
    let key = pcg4d(vec4u(pixel.x | (pixel.y << 16u), dimension, seed, 0x50b01u));
    let index = scrambled(vec4u(reverseBits(sample)), key).x;
    return unit_interval(reverseBits(scrambled(sobol_point(index), pcg4d(key))));
}
