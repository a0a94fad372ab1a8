//! Numbers that look random.

/// Numbers from -1 to 1 by place: the same for a seed, whatever is drawn in between.
pub fn noise(seed: u64, place: u64) -> f64 {
    let mut x =
        seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ place.wrapping_mul(0xd134_2543_de82_ef95);
    for _ in 0..2 {
        x = (x ^ (x >> 32)).wrapping_mul(0xd6e8_feb8_6659_fd93);
    }
    ((x ^ (x >> 32)) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}

/// About a normal deviate with a standard deviation of 1: the sum of twelve uniform ones.
pub fn normal(seed: u64, place: u64) -> f64 {
    (0..12).map(|i| 0.5 * noise(seed, 12 * place + i)).sum()
}
