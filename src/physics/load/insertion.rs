//! Unequal discs at random positions, the large ones first; serves loose beds.

use rand::SeedableRng;
use rand_pcg::Pcg64;

use super::packing::{pack, unit};
use crate::error::Error;
use crate::physics::drum::Drum;
use crate::physics::vector::Vec2;

const TRIES: usize = 20_000;

/// Seeded random positions (drum frame) of discs of these radii [m], in their order.
///
/// # Errors
/// `Error::Config` where one finds no place.
pub fn pack_mixed(drum: &Drum, radii: &[f64], seed: u64) -> Result<Vec<Vec2>, Error> {
    if radii.windows(2).all(|two| two[0] == two[1]) {
        return pack(drum, radii.len(), radii.first().copied().unwrap_or(1.0), seed);
    }
    let bound = drum.radius().unwrap_or(0.0);
    let mut order: Vec<usize> = (0..radii.len()).collect();
    order.sort_by(|&a, &b| radii[b].total_cmp(&radii[a]));
    let mut random = Pcg64::seed_from_u64(seed);
    let mut placed: Vec<(Vec2, f64)> = Vec::new();
    let mut positions = vec![Vec2::zeros(); radii.len()];
    for &i in &order {
        let radius = radii[i] * (1.0 + 1e-9);
        let found = (0..TRIES).find_map(|_| {
            let coordinate = |random: &mut Pcg64| bound * (2.0 * unit(random) - 1.0);
            let center = Vec2::new(coordinate(&mut random), coordinate(&mut random));
            let is_free = center.norm() + radius <= bound
                && drum.is_clear(center, radius)
                && placed.iter().all(|(other, own)| (center - other).norm() >= radius + own);
            is_free.then_some(center)
        });
        let Some(center) = found else {
            let limit = format!("fewer: {} of them found a place", placed.len());
            return Err(Error::config("load.count", radii.len(), limit));
        };
        placed.push((center, radius));
        positions[i] = center;
    }
    Ok(positions)
}
