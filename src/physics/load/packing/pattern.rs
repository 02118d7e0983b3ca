//! Regular patterns of sites: triangular lattices, and rings for a drum of few large discs; the search for a good one.

use std::f64::consts::PI;

use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

use super::draws::unit;
use super::{GAP, Room};
use crate::physics::vector::{Rotation, Vec2};

/// Height of a row of a triangular lattice over its spacing, √3/2.
const ROW: f64 = 0.866_025_403_784_438_6;

/// Sites that a search may test, roughly, and the limits of the placements that this means.
const SITE_TESTS: f64 = 1e6;
const PLACEMENTS: (f64, f64) = (4.0, 2000.0);

/// Sites that any search may go through, and those beyond which none does.
const WIDE: f64 = 1e6;
const MOST_SITES: f64 = 1e9;

/// Rings are tried up to about this many spacings from axis to rim; in larger drums a lattice is denser.
const RINGS_UP_TO: f64 = 5.0;

/// Steps from the widest conceivable spacing down to the densest pattern.
const SPACINGS: u32 = 8;

/// A regular pattern without its limits.
#[derive(Debug, Clone, Copy)]
pub(super) enum Pattern {
    /// Triangular lattice: rows at distance `spacing` · √3/2, shifted (in units of spacing and row), then turned.
    Lattice { spacing: f64, shift: (f64, f64), turn: Rotation },
    /// Rings of equally spaced sites, the outermost along the rim; the first site of each at `angle` [rad].
    Rings { spacing: f64, angle: f64 },
}

/// The pattern of the closest spacing that has at least `count` sites, or the number of sites that the best one has.
///
/// It does not depend on any seed: what fits has to be one number. In a room of far more sites than bundles a wider
/// pattern is enough: going through sites by the billion, of which a baffle may cover any number, could take for ever.
pub(super) fn densest(room: &Room, count: usize) -> Result<Pattern, usize> {
    let mut most = 0;
    for spacing in spacings(room, count) {
        match search(room, spacing, count, SITE_TESTS, &mut Pcg64::seed_from_u64(0)) {
            Ok(pattern) => return Ok(pattern),
            Err(found) => most = most.max(found),
        }
    }
    Err(most)
}

/// The spacings to be tried: the discs' own, after wider ones where it makes more sites than `WIDE` or than suit `count`.
fn spacings(room: &Room, count: usize) -> Vec<f64> {
    let spacing_of = |sites: f64| room.reach * (PI / (ROW * sites)).sqrt();
    let mut spacing = spacing_of(WIDE.max(64.0 * count as f64));
    let mut spacings = Vec::new();
    while spacing > 2.0 * room.spacing && spacing > spacing_of(MOST_SITES) {
        spacings.push(spacing);
        spacing *= 0.5;
    }
    if room.spacing > 0.5 * spacing_of(MOST_SITES) {
        spacings.push(room.spacing);
    }
    spacings
}

/// The sites of a pattern that has `count` of them at a spacing about as wide as can be; `densest` if no other has.
///
/// On a wide pattern every disc can move from the start, which melts the order; `random` places it, so that seeds
/// need not share one orientation.
pub(super) fn sparsest(room: &Room, count: usize, densest: Pattern, random: &mut impl Rng) -> Vec<Vec2> {
    let sites = densest.sites(room, usize::MAX);
    let widest = (sites.len() as f64 / count as f64).sqrt();
    for step in 0..SPACINGS {
        let stretch = widest - (widest - 1.0) * f64::from(step) / f64::from(SPACINGS);
        let tests = SITE_TESTS / f64::from(SPACINGS);
        if let Ok(pattern) = search(room, densest.spacing() * stretch, count, tests, random) {
            return pattern.sites(room, usize::MAX);
        }
    }
    sites
}

/// Tries random placements until one has `count` sites; otherwise tells the most that any has.
fn search(
    room: &Room,
    spacing: f64,
    count: usize,
    tests: f64,
    random: &mut impl Rng,
) -> Result<Pattern, usize> {
    let spacings = room.reach / spacing + 1.0;
    let placements = (tests / (4.0 * spacings * spacings)).clamp(PLACEMENTS.0, PLACEMENTS.1) as u32;
    let mut most = 0;
    for _ in 0..placements {
        let shift = (unit(random), unit(random));
        let lattice = Pattern::Lattice { spacing, shift, turn: Rotation::new(unit(random) * PI / 3.0) };
        let rings = Pattern::Rings { spacing, angle: unit(random) * 2.0 * PI };
        let patterns = if spacings < RINGS_UP_TO { &[lattice, rings][..] } else { &[lattice] };
        for pattern in patterns {
            let found = pattern.sites(room, count).len();
            if found >= count {
                return Ok(*pattern);
            }
            most = most.max(found);
        }
    }
    Err(most)
}

impl Pattern {
    /// Distance of neighboring sites [m].
    fn spacing(self) -> f64 {
        match self {
            Self::Lattice { spacing, .. } | Self::Rings { spacing, .. } => spacing,
        }
    }

    /// The sites that the room admits, up to `limit` of them.
    fn sites(self, room: &Room, limit: usize) -> Vec<Vec2> {
        match self {
            Self::Lattice { spacing, shift, turn } => {
                let sites = lattice_sites(room.reach, spacing, shift).map(|site| turn.apply(site));
                sites.filter(|site| room.admits(*site)).take(limit).collect()
            }
            Self::Rings { spacing, angle } => {
                // Rounding must not push the outermost ring into the rim.
                let sites = ring_sites(room.reach * (1.0 - GAP), spacing, angle);
                sites.filter(|site| room.admits(*site)).take(limit).collect()
            }
        }
    }
}

/// The sites of a triangular lattice within a circle of radius `reach`, row by row.
fn lattice_sites(reach: f64, spacing: f64, shift: (f64, f64)) -> impl Iterator<Item = Vec2> {
    let height = ROW * spacing;
    between(-reach / height - shift.1, reach / height - shift.1).flat_map(move |row| {
        let y = height * (row as f64 + shift.1);
        let half = (reach * reach - y * y).max(0.0).sqrt();
        let start = shift.0 + 0.5 * (row & 1) as f64;
        between(-half / spacing - start, half / spacing - start)
            .map(move |column| Vec2::new(spacing * (column as f64 + start), y))
    })
}

/// The sites of concentric rings from radius `reach` inwards, the last one a single site in the middle where a ring
/// would be too narrow for two.
fn ring_sites(reach: f64, spacing: f64, angle: f64) -> impl Iterator<Item = Vec2> {
    between(0.0, reach / spacing).flat_map(move |ring| {
        let radius = reach - ring as f64 * spacing;
        let half_chord = 0.5 * spacing / radius;
        let (radius, count) =
            if half_chord > 1.0 { (0.0, 1) } else { (radius, (PI / libm::asin(half_chord)) as i64) };
        (0..count).map(move |site| {
            let turn = Rotation::new(angle + 2.0 * PI * site as f64 / count as f64);
            turn.apply(Vec2::new(radius, 0.0))
        })
    })
}

/// The whole numbers from `low` to `high`.
fn between(low: f64, high: f64) -> std::ops::RangeInclusive<i64> {
    low.ceil() as i64..=high.floor() as i64
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Asserts that sites lie within a unit circle at least a spacing apart, up to rounding.
    fn assert_apart(sites: &[Vec2], spacing: f64) {
        for (index, site) in sites.iter().enumerate() {
            assert!(site.norm() <= 1.0 + 1e-12);
            assert!(sites[..index].iter().all(|other| (site - other).norm() > spacing * (1.0 - 1e-12)));
        }
    }

    #[test]
    fn a_lattice_has_one_site_per_cell_of_its_area() {
        let spacing = 0.03;
        let sites: Vec<Vec2> = lattice_sites(1.0, spacing, (0.3, 0.6)).collect();
        assert_apart(&sites, spacing);
        let expected = PI / (ROW * spacing * spacing);
        assert!((sites.len() as f64 / expected - 1.0).abs() < 0.01, "{} sites for {expected}", sites.len());
    }

    #[test]
    fn rings_are_full_and_end_in_the_middle() {
        for (spacing, counts) in [(0.52, 11 + 5), (0.7, 8 + 1), (0.95, 6 + 1), (1.5, 3), (1.9, 2), (2.1, 1)] {
            let sites: Vec<Vec2> = ring_sites(1.0, spacing, 0.4).collect();
            assert_apart(&sites, spacing);
            assert_eq!(sites.len(), counts, "rings at {spacing}");
        }
    }
}
