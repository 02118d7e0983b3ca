//! drumrs: loads tumbling in a rotating drum, simulated as discs with soft contacts.
pub mod drum;
pub mod error;
pub mod vector;
