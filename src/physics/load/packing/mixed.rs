//! The initial bed of discs of several sizes.
//!
//! Discs are inserted at random points, the largest first. Where that stalls they are inserted smaller and swell: at a
//! greater size they overlap, and are pushed apart, pair by pair and sweep by sweep, until they are free (projected
//! Gauss–Seidel, as for the constraints of rigid bodies). Where that does not happen soon, half the step in size is tried.
//! Before each step discs are shaken, which opens jams: beds become 1 % denser.
//!
//! No lattice serves here as for equal discs, so the densest bed is a random one: it covers up to 0.84 of a large drum where
//! the largest disc is 1.4 times the smallest, more where small ones fill the pores between large ones, less near a rim.

use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

use super::draws::in_square;
use super::grid::Grid;
use super::{GAP, Room, bound_of, pack, pattern, tries};
use crate::error::{Error, require_positive};
use crate::physics::drum::Drum;
use crate::physics::sorting::sort;
use crate::physics::vector::{Vec2, dot};

/// What the size of discs that are too large for random insertion is multiplied by.
const SHRINKAGE: f64 = 0.8;

/// The least step between two sizes, in parts of the full one.
const FINEST_STEP: f64 = 2e-3;

/// How far discs are shaken along x and y, in radii.
const SHAKE: f64 = 0.3;

/// Moves that getting free may take, in all, and the limits of the sweeps that this means.
const MOVES: usize = 3_000_000;
const SWEEPS: (usize, usize) = (300, 3000);

/// Two discs are pushed apart by so many times their overlap (over-relaxation): a quarter of the sweeps of 1, and from 2 on
/// discs do not come to rest.
const RELAXATION: f64 = 1.8;

/// Discs are pushed apart as if they were larger by this part. They are free in the limit only; of the margin they are
/// soon rid but for a small part.
const MARGIN: f64 = 1e-4;

/// Seeded random positions (drum frame) of discs with these `radii` [m], in the same order, that overlap neither each other
/// nor a solid. For equal radii those of `pack`.
///
/// # Errors
/// `Error::Packing` if they do not get free of each other, naming about how many discs of such a mix do; `Error::Config`
/// for a drum without a rim and for a radius that is not positive.
pub fn pack_mixed(drum: &Drum, radii: &[f64], seed: u64) -> Result<Vec<Vec2>, Error> {
    let bound = bound_of(drum)?;
    radii.iter().try_for_each(|radius| require_positive("load.diameter", 2.0 * radius))?;
    let extreme = |choose: fn(f64, f64) -> f64| radii.iter().copied().reduce(choose);
    let (Some(smallest), Some(largest)) = (extreme(f64::min), extreme(f64::max)) else {
        return Ok(Vec::new());
    };
    if smallest == largest {
        return pack(drum, radii.len(), largest, seed);
    }
    let diameters = [2.0 * smallest, 2.0 * largest];
    let too_many = |fits| Error::Packing { requested: radii.len(), fits, diameters };
    // Otherwise no size would do at which the largest disc has no room even by itself.
    pattern::densest(&Room::new(drum, bound, largest), 1).map_err(too_many)?;
    let mut random = Pcg64::seed_from_u64(seed);
    let mut bed = Bed::inserted(drum, bound, radii, &mut random);
    bed.swell(&mut random);
    if bed.scale < 1.0 {
        return Err(too_many((bed.scale * bed.scale * radii.len() as f64) as usize));
    }
    let mut positions = vec![Vec2::zeros(); radii.len()];
    bed.discs.iter().for_each(|disc| positions[disc.index] = disc.center);
    Ok(positions)
}

/// A disc on the way to its place.
#[derive(Debug, Clone, Copy)]
struct Disc {
    center: Vec2,
    /// At full size [m].
    radius: f64,
    /// Its place in the list of radii.
    index: usize,
}

/// Discs that are free of each other at a part of their size. Of the drum they are always free at full size: otherwise they
/// would be caught where there is no room for them to swell, such as between two baffles.
struct Bed<'a> {
    drum: &'a Drum,
    bound: f64,
    discs: Vec<Disc>,
    /// The size of the discs, in parts of the full one.
    scale: f64,
    /// Of all discs, over π, at full size [m²].
    area: f64,
}

impl<'a> Bed<'a> {
    /// Discs at random points, at the largest size for which insertion does not stall.
    fn inserted(drum: &'a Drum, bound: f64, radii: &[f64], random: &mut impl Rng) -> Self {
        let indexed = radii.iter().enumerate();
        let mut discs: Vec<Disc> =
            indexed.map(|(index, &radius)| Disc { center: Vec2::zeros(), radius, index }).collect();
        sort(&mut discs, &|one, other| other.radius.total_cmp(&one.radius));
        let area = radii.iter().map(|radius| radius * radius).sum();
        let mut bed = Self { drum, bound, discs, scale: 1.0, area };
        while !bed.insert(random) {
            bed.scale *= SHRINKAGE;
        }
        bed
    }

    /// Inserts the discs one by one at random points that have room for them, and tells whether that did not stall.
    fn insert(&mut self, random: &mut impl Rng) -> bool {
        let mut grid = self.grid(self.scale);
        let mut tries = tries(self.discs.len());
        for index in 0..self.discs.len() {
            let full_radius = self.discs[index].radius * (1.0 + GAP);
            let radius = full_radius * self.scale;
            let is_far = |other: u32, center: Vec2| {
                let other = self.discs[other as usize];
                let (apart, reach) =
                    (other.center - center, radius + other.radius * self.scale * (1.0 + GAP));
                dot(apart, apart) >= reach * reach
            };
            let center = loop {
                if tries == 0 {
                    return false;
                }
                tries -= 1;
                let center = in_square(self.bound - full_radius, random);
                if grid.near(center, radius).all(|other| is_far(other, center))
                    && self.drum.is_clear(center, full_radius)
                {
                    break center;
                }
            };
            self.discs[index].center = center;
            grid.push(index as u32, center, radius);
        }
        true
    }

    /// Makes the discs larger as long as they get free, up to their full size.
    fn swell(&mut self, random: &mut impl Rng) {
        // Neighbors in rows of the drum are then neighbors in memory.
        let row_height = self.diameter();
        sort(&mut self.discs, &|one, other| {
            let row = |disc: &Disc| (disc.center.y / row_height).floor();
            row(one).total_cmp(&row(other)).then(one.center.x.total_cmp(&other.center.x))
        });
        // The size is 1 − steps · step: exactly 1 in the end.
        let (mut step, mut steps) = (1.0 - self.scale, 1_u32);
        while self.scale < 1.0 && step > FINEST_STEP {
            let scale = 1.0 - f64::from(steps - 1) * step;
            let before = self.discs.clone();
            self.shake(random);
            if self.get_free(scale) {
                self.scale = scale;
                steps -= 1;
            } else {
                self.discs = before;
                (step, steps) = (0.5 * step, 2 * steps);
            }
        }
    }

    /// Moves each disc a little at random.
    fn shake(&mut self, random: &mut impl Rng) {
        for disc in &mut self.discs {
            let center = disc.center + in_square(SHAKE * self.scale * disc.radius, random);
            if self.drum.solid_at(center).is_none() {
                disc.center = center;
            }
        }
    }

    /// Pushes the discs apart until none overlaps another at this size, or a solid; tells whether that came about.
    fn get_free(&mut self, scale: f64) -> bool {
        if self.area * scale * scale > self.bound * self.bound {
            return false;
        }
        let mut grid = self.grid(scale);
        let sweeps = (MOVES / self.discs.len()).clamp(SWEEPS.0, SWEEPS.1);
        (0..sweeps)
            .any(|_| self.push_apart(scale * (1.0 + MARGIN), &mut grid) && self.is_free(scale, &mut grid))
    }

    /// Pushes every two discs that overlap apart, then each disc out of solids; tells whether all that was within the margin.
    fn push_apart(&mut self, scale: f64, grid: &mut Grid) -> bool {
        self.list(scale, grid);
        let before: Vec<Vec2> = self.discs.iter().map(|disc| disc.center).collect();
        let mut deepest: f64 = 0.0;
        for (one, other) in grid.pairs() {
            let [Disc { center: a, radius: r, .. }, Disc { center: b, radius: s, .. }] =
                [one, other].map(|index| self.discs[index as usize]);
            let (apart, reach) = (a - b, (r + s) * scale);
            let square = dot(apart, apart);
            if square < reach * reach {
                let distance = square.sqrt();
                let overlap = reach - distance;
                deepest = deepest.max(overlap / reach);
                // As by equal pressures on masses: a small disc gives way to a large one.
                let push = apart * (RELAXATION * overlap / distance.max(MARGIN * reach) / (r * r + s * s));
                self.discs[one as usize].center += push * (s * s);
                self.discs[other as usize].center -= push * (r * r);
            }
        }
        for (index, before) in before.into_iter().enumerate() {
            let disc = self.discs[index];
            let radius = disc.radius * (1.0 + MARGIN);
            let (center, overlap) = self.out_of_solids(disc.center, radius);
            let is_inside = self.drum.solid_at(center).is_some();
            self.discs[index].center = if is_inside { before } else { center };
            deepest = deepest.max(if is_inside { 1.0 } else { overlap / radius });
        }
        deepest < 0.5 * MARGIN
    }

    /// The center of a disc after it was pushed out of the rim and of what it overlaps of baffles and walls; how far [m].
    fn out_of_solids(&self, mut center: Vec2, radius: f64) -> (Vec2, f64) {
        let outwards = dot(center, center).sqrt();
        let mut deepest = outwards + radius - self.bound;
        if deepest > 0.0 {
            center *= 1.0 - deepest / outwards;
        }
        let mut features = Vec::new();
        self.drum.features_near(center, radius, &mut features);
        for feature in features {
            let Some(near) = self.drum.proximity(feature, center) else { continue };
            let overlap = (radius - near.distance).max(0.0);
            center -= near.direction * overlap;
            deepest = deepest.max(overlap);
        }
        (center, deepest)
    }

    /// Whether no disc overlaps another at this size, or a solid.
    fn is_free(&self, scale: f64, grid: &mut Grid) -> bool {
        let scale = scale * (1.0 + GAP);
        self.list(scale, grid);
        let are_apart = |(one, other): (u32, u32)| {
            let (one, other) = (self.discs[one as usize], self.discs[other as usize]);
            let (apart, reach) = (one.center - other.center, (one.radius + other.radius) * scale);
            dot(apart, apart) >= reach * reach
        };
        grid.pairs().all(are_apart)
            && self.discs.iter().all(|disc| self.drum.is_clear(disc.center, disc.radius * (1.0 + GAP)))
    }

    /// Lists all discs in the grid.
    fn list(&self, scale: f64, grid: &mut Grid) {
        grid.clear();
        for (index, disc) in (0..).zip(&self.discs) {
            grid.push(index, disc.center, disc.radius * scale);
        }
    }

    /// An empty grid for discs of this size.
    fn grid(&self, scale: f64) -> Grid {
        Grid::new(self.bound, scale * self.diameter(), self.discs.len())
    }

    /// Of a disc of mean area [m].
    fn diameter(&self) -> f64 {
        2.0 * (self.area / self.discs.len() as f64).sqrt()
    }
}
