//! Means over a window of samples, with the uncertainty of the power.

use crate::error::Error;
use crate::observe::recorder::{Series, contact_energies, quantities};
use crate::physics::contact::{Flows, Stored};

/// A named statistic; none where it is not defined.
pub type Statistic = (String, Option<f64>);

/// The first and last sample of a window.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Window {
    first: usize,
    last: usize,
}

/// Statistics over the window from `start` to `end` [s], which snaps to the samples nearest to it.
///
/// Powers are differences of recorded energies over the window, and so exact. Three powers are given: from the torque
/// of all wall contacts, from the ledger (dE/dt + dissipation), and from the balance of moments.
///
/// # Errors
/// `Error::Config` where the window holds fewer than two samples.
pub fn summarize(series: &Series, mass: f64, start: f64, end: f64) -> Result<Vec<Statistic>, Error> {
    let table = Table { series };
    let window = table.window(start, end)?;
    let time = table.change("time", window);
    let rate = |name| table.change(name, window) / time;
    let ratio = |above: f64, below: f64| (below != 0.0).then(|| above / below);
    let (normal, tangential) = (rate("normal_work"), rate("tangential_work"));
    let power = rate("drum_work");
    let motion = rate("kinetic_translation") + rate("kinetic_rotation") + rate("gravitational");
    let by_ledger = motion + contact_energies().map(rate).sum::<f64>() + rate("numerical");
    let powers = [power, by_ledger, rate("moment_balance_work")];
    let spread = Spread::of(&table.interval_powers(window), table.interval(window));
    let mean = |name| table.mean(name, window);
    let residual = table.column("energy_residual");
    let fixed = [
        ("window_start", Some(table.column("time")[window.first])),
        ("window_end", Some(table.column("time")[window.last])),
        ("drum_torque", Some(table.exact_mean("drum_torque", window))),
        ("drum_power", Some(power)),
        ("drum_specific_power", Some(power / mass)),
        ("drum_specific_power_error", spread.map(|spread| spread.error / mass)),
        ("correlation_time", spread.map(|spread| spread.correlation_time)),
        ("work_ratio", ratio(normal, tangential)),
        ("dissipation_ratio", ratio(rate("dissipated_normal"), rate("dissipated_sliding"))),
        ("normal_power", Some(normal)),
        ("tangential_power", Some(tangential)),
        ("numerical_power", Some(rate("numerical"))),
        ("energy_balance_power", Some(powers[1])),
        ("moment_balance_power", Some(powers[2])),
        ("power_disagreement", Some(disagreement(powers, table.stored(window) / time))),
        ("center_of_mass_x", Some(mean("center_of_mass_x"))),
        ("center_of_mass_y", Some(mean("center_of_mass_y"))),
        ("coordination", Some(mean("coordination"))),
        ("kinetic_energy", Some(mean("kinetic_translation") + mean("kinetic_rotation"))),
        ("max_overlap_ratio", Some(table.greatest("max_overlap_ratio", window))),
        ("energy_residual", Some(residual.into_iter().fold(0.0, f64::max))),
    ];
    let taken = Flows::NAMES.iter().map(|flow| (format!("{flow}_power"), Some(rate(flow))));
    Ok(fixed.map(|(name, value)| (name.to_owned(), value)).into_iter().chain(taken).collect())
}

/// Largest difference of the three powers over the greatest of their magnitudes, or over `turnover` where that is more:
/// the power that would use up the stored energy within the window. Powers are differences of such energies, so without
/// it the quotient would be one of rounding errors where the drum does no work. 0 where all vanish.
fn disagreement(powers: [f64; 3], turnover: f64) -> f64 {
    let scale = powers.iter().fold(turnover, |most, power| most.max(power.abs()));
    let (low, high) =
        powers.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &p| (low.min(p), high.max(p)));
    if scale > 0.0 { (high - low) / scale } else { 0.0 }
}

struct Table<'a> {
    series: &'a Series,
}

impl Table<'_> {
    fn column(&self, name: &str) -> Vec<f64> {
        let index = quantities().position(|column| column.name == name);
        self.series.column(index.expect("the summary asks for recorded quantities only"))
    }

    fn window(&self, start: f64, end: f64) -> Result<Window, Error> {
        let times = self.column("time");
        let nearest = |time: f64| {
            let after = times.partition_point(|&sample| sample < time).min(times.len().saturating_sub(1));
            match after.checked_sub(1) {
                Some(before) if time - times[before] < times[after] - time => before,
                Some(before) if times[after] < time => before + 1,
                _ => after,
            }
        };
        if times.len() < 2 || start.is_nan() || nearest(start) >= nearest(end) {
            let limit = "a window that holds at least two samples of the run";
            return Err(Error::config("run.window", format!("[{start}, {end}]"), limit));
        }
        Ok(Window { first: nearest(start), last: nearest(end) })
    }

    fn change(&self, name: &str, window: Window) -> f64 {
        let column = self.column(name);
        column[window.last] - column[window.first]
    }

    /// Energy stored at the end of the window, every part with its magnitude [J/m].
    fn stored(&self, window: Window) -> f64 {
        let parts = ["kinetic_translation", "kinetic_rotation", "gravitational"];
        let parts = parts.iter().chain(Stored::NAMES);
        parts.map(|part| self.column(part)[window.last].abs()).sum()
    }

    /// Mean of the samples after the window's first, which close the intervals within it.
    fn mean(&self, name: &str, window: Window) -> f64 {
        let column = self.column(name);
        let values = &column[window.first + 1..=window.last];
        values.iter().sum::<f64>() / values.len() as f64
    }

    /// Mean over the window's time of what is a mean over each interval: exact where intervals differ in length.
    fn exact_mean(&self, name: &str, window: Window) -> f64 {
        let (column, times) = (self.column(name), self.column("time"));
        let total: f64 =
            (window.first + 1..=window.last).map(|k| column[k] * (times[k] - times[k - 1])).sum();
        total / (times[window.last] - times[window.first])
    }

    fn greatest(&self, name: &str, window: Window) -> f64 {
        self.column(name)[window.first + 1..=window.last].iter().copied().fold(0.0, f64::max)
    }

    fn interval_powers(&self, window: Window) -> Vec<f64> {
        self.column("drum_power")[window.first + 1..=window.last].to_vec()
    }

    fn interval(&self, window: Window) -> f64 {
        self.change("time", window) / (window.last - window.first) as f64
    }
}

/// The uncertainty of a mean over correlated samples.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spread {
    /// Standard error of the mean.
    pub error: f64,
    /// Integrated correlation time, in the unit of the interval.
    pub correlation_time: f64,
}

/// Fewest blocks from which a standard error is taken.
const FEWEST_BLOCKS: usize = 8;

impl Spread {
    /// The standard error from block averages (Flyvbjerg & Petersen, J. Chem. Phys. 91 (1989) 461): blocks are doubled
    /// in length while at least eight remain, and the greatest error found is kept, since short blocks are correlated
    /// and tell too little. None with fewer than eight values.
    pub fn of(values: &[f64], interval: f64) -> Option<Self> {
        let mut blocks = values.to_vec();
        let plain = squared_error(&blocks)?;
        let mut greatest = plain;
        while blocks.len() / 2 >= FEWEST_BLOCKS {
            blocks = blocks.chunks_exact(2).map(|pair| 0.5 * (pair[0] + pair[1])).collect();
            greatest = greatest.max(squared_error(&blocks)?);
        }
        let inflation = if plain > 0.0 { greatest / plain } else { 1.0 };
        Some(Self { error: greatest.sqrt(), correlation_time: 0.5 * inflation * interval })
    }
}

/// The squared standard error of the mean of independent values.
fn squared_error(values: &[f64]) -> Option<f64> {
    if values.len() < FEWEST_BLOCKS {
        return None;
    }
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    let variance = values.iter().map(|value| (value - mean) * (value - mean)).sum::<f64>() / (count - 1.0);
    Some(variance / count)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Uniform in [0, 1), from a multiplicative congruential sequence.
    fn noise(count: usize) -> Vec<f64> {
        let mut state = 1_u64;
        let mut next = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        (0..count).map(|_| next()).collect()
    }

    #[test]
    fn independent_values_have_their_textbook_error() {
        let spread = Spread::of(&noise(8192), 1.0).unwrap();
        let expected = (1.0_f64 / 12.0 / 8192.0).sqrt();
        assert!(
            spread.error > 0.9 * expected && spread.error < 1.9 * expected,
            "{}",
            spread.error / expected
        );
    }

    #[test]
    fn correlated_values_have_a_larger_error() {
        let held: Vec<f64> = noise(256).into_iter().flat_map(|value| [value; 32]).collect();
        let spread = Spread::of(&held, 0.5).unwrap();
        let expected = (1.0_f64 / 12.0 / 256.0).sqrt();
        assert!(spread.error > 0.8 * expected && spread.error < 2.0 * expected);
        assert!(spread.correlation_time > 4.0 && spread.correlation_time < 32.0);
    }

    #[test]
    fn few_values_have_no_error() {
        assert_eq!(Spread::of(&[1.0; 7], 1.0), None);
    }
}
