//! Visits of a disc to a zone: how often, how long, and how long from one to the next.

use serde::{Deserialize, Serialize};

/// How a disc has visited a zone. Times are counted in looks, which are equally long apart.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Visits {
    /// Visits that have begun in sight.
    pub entries: u32,
    /// Looks at which it was inside.
    pub inside: u64,
    /// Whole visits that another one followed: cycles.
    pub cycles: u32,
    /// Sums over cycles: Σ W, Σ C, Σ W², Σ C², Σ W C, with the length W of the visit and that of the cycle, C.
    pub sums: [u64; 5],
    is_inside: bool,
    /// The look at which the last visit has begun, if that was in sight.
    entered: Option<u64>,
    /// Looks that it has lasted.
    lasted: u64,
}

impl Visits {
    /// A look, of this number. At the first one, a particle inside has not been seen to enter.
    pub fn note(&mut self, number: u64, is_inside: bool, is_first: bool) {
        if is_inside {
            if !self.is_inside && !is_first {
                self.enter(number);
            }
            self.inside += 1;
            self.lasted += 1;
        }
        self.is_inside = is_inside;
    }

    fn enter(&mut self, number: u64) {
        self.entries = self.entries.saturating_add(1);
        if let Some(entered) = self.entered.replace(number) {
            let (stay, cycle) = (self.lasted, number.saturating_sub(entered));
            self.cycles = self.cycles.saturating_add(1);
            let terms = [stay, cycle, stay.saturating_mul(stay), cycle.saturating_mul(cycle), stay * cycle];
            for (sum, term) in self.sums.iter_mut().zip(terms) {
                *sum = sum.saturating_add(term);
            }
        }
        self.lasted = 0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Inside from the start, then visits of 2, 5 and 3 looks: two are whole and followed by another.
    #[test]
    fn whole_visits_and_cycles_are_counted() {
        let mut visits = Visits::default();
        let path = "iii...ii.iiiii....iii..";
        for (number, place) in path.chars().enumerate() {
            visits.note(number as u64, place == 'i', number == 0);
        }
        assert_eq!((visits.entries, visits.inside, visits.cycles), (3, 13, 2));
        let ((w, c), (v, d)) = ((2, 3), (5, 9));
        assert_eq!(visits.sums, [w + v, c + d, w * w + v * v, c * c + d * d, w * c + v * d]);
    }
}
