//! The drum in its own frame: a rim, handled analytically, and outlines (baffles, straight walls), queried
//! with parry2d.
//!
//! A `Drum` never moves; `rotation` says how its frame turns. What a disc can touch is counted in features:
//! the rim, and every edge and vertex of the outlines. Each contact belongs to one of them. Lengths enter by
//! comparison with each other only, so that a drum four times as large answers with the same bits, scaled.

pub mod baffle;
mod fit;
mod polygon;
pub mod rotation;
mod side;
