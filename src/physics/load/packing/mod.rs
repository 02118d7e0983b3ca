//! The initial bed: discs at seeded random positions that overlap neither each other nor the drum; equal ones here, those of
//! several sizes in `mixed`.
//!
//! Random insertion serves loose beds. Where it stalls, discs start on a regular pattern that has enough sites and
//! are shuffled by random moves until the bed is as random as its density allows. A count is accepted exactly if
//! the densest pattern found has that many sites, whatever the seed, so an error can name the count that fits.
//!
//! Every length is a multiple of the drum's own lengths: scaling drum and radius by a power of two scales the
//! positions by it, bit for bit.

mod cells;
mod disorder;
mod draws;
mod grid;
mod mixed;
mod pattern;

pub use draws::unit;
pub use mixed::pack_mixed;
use rand::SeedableRng;
use rand_pcg::Pcg64;

use crate::error::{Error, require_positive};
use crate::physics::drum::Drum;
use crate::physics::vector::{Vec2, dot};

/// The relative gap kept round every disc, so that neither rounding nor a turn of the drum makes two discs overlap.
const GAP: f64 = 1e-9;

/// Tries of random insertion, for so many discs in all, after which they count as too many or too large for it.
fn tries(count: usize) -> usize {
    count.saturating_mul(30).saturating_add(1000)
}

/// Seeded random positions (drum frame) of `count` equal discs of `radius` [m] that overlap neither each other nor
/// a solid.
///
/// They come in rows from bottom to top, so that discs near each other are near each other in memory.
///
/// # Errors
/// `Error::Packing` if no pattern found has `count` sites; `Error::Config` for a drum without a rim and for a
/// radius that is not positive.
pub fn pack(drum: &Drum, count: usize, radius: f64, seed: u64) -> Result<Vec<Vec2>, Error> {
    let bound = bound_of(drum)?;
    require_positive("load.diameter", 2.0 * radius)?;
    if count == 0 {
        return Ok(Vec::new());
    }
    let room = Room::new(drum, bound, radius);
    let densest = pattern::densest(&room, count).map_err(|fits| Error::Packing {
        requested: count,
        fits,
        diameters: [2.0 * radius; 2],
    })?;
    let mut random = Pcg64::seed_from_u64(seed);
    let bed = disorder::insert(&room, count, &mut random).unwrap_or_else(|| {
        let sites = pattern::sparsest(&room, count, densest, &mut random);
        disorder::shuffled(&room, &sites, count, &mut random)
    });
    Ok(bed.into_rows())
}

/// The radius of the drum's rim [m], without which there is no end to where a bed may be.
fn bound_of(drum: &Drum) -> Result<f64, Error> {
    drum.bounding_radius()
        .ok_or_else(|| Error::config("drum.diameter", "none", "given when no initial state is"))
}

/// The space inside a drum and the size of the discs that go into it; all tests of a position happen here.
struct Room<'a> {
    drum: &'a Drum,
    /// Radius of the circle round the axis that holds every center [m]; negative if not even one disc fits.
    reach: f64,
    /// Least distance from a center to a solid [m].
    radius: f64,
    /// Least distance between two centers [m].
    spacing: f64,
}

impl<'a> Room<'a> {
    fn new(drum: &'a Drum, bound: f64, radius: f64) -> Self {
        let radius = radius * (1.0 + GAP);
        Self { drum, reach: bound - radius, radius, spacing: 2.0 * radius }
    }

    /// Whether a center may be here as far as the bounding circle goes; it costs next to nothing.
    fn bounds(&self, center: Vec2) -> bool {
        dot(center, center) <= self.reach * self.reach
    }

    /// Whether a disc centered here is clear of every solid.
    fn admits(&self, center: Vec2) -> bool {
        self.bounds(center) && self.drum.is_clear(center, self.radius)
    }
}
