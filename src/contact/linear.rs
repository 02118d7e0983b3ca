//! The linear spring–dashpot with a Coulomb-limited tangential spring (the paper's Eqs. 1 and 2).
