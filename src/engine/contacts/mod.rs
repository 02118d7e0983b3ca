//! Contacts as the engine keeps them: four to a block, in the order in which they opened.
//!
//! A contact enters its list in the step in which its bodies first touch and leaves it when its last work is charged,
//! whatever the neighbor lists hold. The order of a list is an order of physics: contacts that open in one step enter by
//! key; a gap is filled by the last contact, gaps from the highest place down; a history that passes to another feature
//! keeps its place. Sums run in this order, so no list and no thread shows in a result; a checkpoint keeps it, and a sort of
//! memory carries it along.

mod event;
mod list;
mod record;

pub use event::{ContactEvent, ContactTally, EventKind, NO_BIN, Opening};
pub use list::{Block, BlockTally, ByBlock, ContactList, Ids, ListKind, ListParameters};
pub use record::{ContactRecord, Geometry, PairParameters};

/// What stands for a contact's place in the list of neighbors where that list does not hold it.
pub const NOT_LISTED: u32 = u32::MAX;
