//! Memory for what is recorded, which may be more than there is: asked for before it is used, so that where there is none,
//! it is an error that leaves everything whole, and no abort.

use crate::error::Error;

/// Lists longer than this grow by an eighth of their length, shorter ones to twice their length: the room that a long list
/// leaves unused is small, and the system moves its pages without copying them [bytes].
const LONG: usize = 1 << 24;

/// Reserves memory for `more` entries at the end of a list.
///
/// # Errors
/// `Error::Memory` naming `action` where there is none; the list has not changed then.
pub fn reserve<T>(list: &mut Vec<T>, more: usize, action: &'static str) -> Result<(), Error> {
    if list.capacity() - list.len() >= more {
        return Ok(());
    }
    let is_long = size_of_val(list.as_slice()) > LONG;
    let ahead = if is_long { list.len() / 8 } else { list.len() };
    // Near the end of all memory, what is needed may still be there.
    let room = list.try_reserve_exact(more.max(ahead)).or_else(|_| list.try_reserve_exact(more));
    room.map_err(|_| Error::Memory { action, bytes: more.saturating_mul(size_of::<T>()) })
}

/// Puts entries before those of a list.
///
/// # Errors
/// `Error::Memory` naming `action` where there is no room for them; the list has not changed then.
pub fn prepend<T: Copy + Default>(
    list: &mut Vec<T>,
    earlier: &[T],
    action: &'static str,
) -> Result<(), Error> {
    reserve(list, earlier.len(), action)?;
    let length = list.len();
    list.resize(length + earlier.len(), T::default());
    list.copy_within(..length, earlier.len());
    list[..earlier.len()].copy_from_slice(earlier);
    Ok(())
}
