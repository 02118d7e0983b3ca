//! Random numbers made here from raw 64-bit draws, so that no library's version can change a bed.

use rand::Rng;

use crate::physics::vector::Vec2;

/// A random number of [0, 1), a multiple of 2⁻⁵³.
pub fn unit(random: &mut impl Rng) -> f64 {
    (random.next_u64() >> 11) as f64 * (f64::EPSILON / 2.0)
}

/// A random number of 0 … `limit` − 1.
pub(super) fn below(limit: usize, random: &mut impl Rng) -> usize {
    ((u128::from(random.next_u64()) * limit as u128) >> 64) as usize
}

/// A random point of the square |x|, |y| ≤ `half`.
pub(super) fn in_square(half: f64, random: &mut impl Rng) -> Vec2 {
    let x = 2.0 * unit(random) - 1.0;
    let y = 2.0 * unit(random) - 1.0;
    Vec2::new(x * half, y * half)
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_pcg::Pcg64;

    use super::*;

    #[test]
    fn draws_fill_their_ranges_evenly() {
        let mut random = Pcg64::seed_from_u64(1);
        let mut quarters = [[0; 4]; 4];
        for _ in 0..4000 {
            quarters[0][(4.0 * unit(&mut random)) as usize] += 1;
            quarters[1][below(4, &mut random)] += 1;
            let point = in_square(3.0, &mut random) / 1.5;
            quarters[2][(point.x + 2.0) as usize] += 1;
            quarters[3][(point.y + 2.0) as usize] += 1;
        }
        assert!(quarters.as_flattened().iter().all(|count| (900..1100).contains(count)), "{quarters:?}");
    }
}
