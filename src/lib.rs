//! drumrs: loads tumbling in a rotating drum, simulated as discs with soft contacts.
pub mod error;
pub mod packing;
pub mod vector;
