//! The summary of a run: its quantities over a window of samples.

use crate::error::Error;
use crate::observe::averages;
use crate::observe::recorder::{Series, contact_energies};
use crate::physics::contact::{Flows, Stored};

/// A named statistic; none where it is not defined.
pub type Statistic = (String, Option<f64>);

/// Statistics over the window from `start` to `end` [s], which snaps to the samples nearest to it.
///
/// Powers are differences of recorded energies over the window, and so exact. Three powers are given: from the torque
/// of all wall contacts, from the ledger (dE/dt + dissipation), and from the balance of moments.
///
/// # Errors
/// `Error::Config` where the window holds fewer than two samples.
pub fn summarize(series: &Series, mass: f64, start: f64, end: f64) -> Result<Vec<Statistic>, Error> {
    let rows = averages::window(&whole_column(series, "time"), start, end).ok_or_else(|| {
        let limit = "a window that holds at least two samples of the run";
        Error::config("run.window", format!("[{start}, {end}]"), limit)
    })?;
    let table = Table { series, rows };
    let times = table.column("time");
    let sample_every = averages::mean_interval(&times);
    let rate = |name: &str| averages::rate(&times, &table.column(name));
    let mean = |name: &str| averages::mean_sampled(&table.column(name)[1..], sample_every).value;
    let ratio = |above: f64, below: f64| (below != 0.0).then(|| above / below);
    let (normal, tangential) = (rate("normal_work"), rate("tangential_work"));
    let is_recorded = series.place_of("gross_work_normal").is_some();
    let gross_work_ratio =
        is_recorded.then(|| ratio(rate("gross_work_normal"), rate("gross_work_tangential"))).flatten();
    let work = averages::mean_rate(&times, &table.column("drum_work"));
    let (power, spread) = (work.value, work.spread);
    let motion = rate("kinetic_translation") + rate("kinetic_rotation") + rate("gravitational");
    let by_ledger = motion + contact_energies().map(rate).sum::<f64>() + rate("numerical");
    let powers = [power, by_ledger, rate("moment_balance_work")];
    let (window_start, window_end) = (times[0], times[times.len() - 1]);
    let interval_mean = |column: &[f64]| Some(averages::mean_of_intervals(&times, column));
    let force = |axis| interval_mean(&series.sum_over_surfaces(axis)[rows.0..=rows.1]);
    let residual = whole_column(series, "energy_residual");
    let fixed = [
        ("window_start", Some(window_start)),
        ("window_end", Some(window_end)),
        ("drum_torque", interval_mean(&table.column("drum_torque"))),
        ("drum_force_x", force("force_x")),
        ("drum_force_y", force("force_y")),
        ("drum_power", Some(power)),
        ("drum_specific_power", Some(power / mass)),
        ("drum_specific_power_error", spread.map(|spread| spread.error / mass)),
        ("correlation_time", spread.map(|spread| spread.correlation_time)),
        ("work_ratio", ratio(normal, tangential)),
        ("gross_work_ratio", gross_work_ratio),
        ("dissipation_ratio", ratio(rate("dissipated_normal"), rate("dissipated_sliding"))),
        ("normal_power", Some(normal)),
        ("tangential_power", Some(tangential)),
        ("numerical_power", Some(rate("numerical"))),
        ("energy_balance_power", Some(powers[1])),
        ("moment_balance_power", Some(powers[2])),
        ("power_disagreement", Some(disagreement(powers, table.stored() / (window_end - window_start)))),
        ("center_of_mass_x", Some(mean("center_of_mass_x"))),
        ("center_of_mass_y", Some(mean("center_of_mass_y"))),
        ("coordination", Some(mean("coordination"))),
        ("kinetic_energy", Some(mean("kinetic_translation") + mean("kinetic_rotation"))),
        ("max_overlap_ratio", Some(table.greatest("max_overlap_ratio"))),
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

/// The rows of a window, by column.
struct Table<'a> {
    series: &'a Series,
    rows: (usize, usize),
}

impl Table<'_> {
    fn column(&self, name: &str) -> Vec<f64> {
        whole_column(self.series, name)[self.rows.0..=self.rows.1].to_vec()
    }

    /// Energy stored at the end of the window, every part with its magnitude [J/m].
    fn stored(&self) -> f64 {
        let parts = ["kinetic_translation", "kinetic_rotation", "gravitational"];
        let parts = parts.iter().chain(Stored::NAMES);
        parts.map(|part| self.column(part).last().map_or(0.0, |energy| energy.abs())).sum()
    }

    /// Greatest value since the window's first sample.
    fn greatest(&self, name: &str) -> f64 {
        self.column(name)[1..].iter().copied().fold(0.0, f64::max)
    }
}

fn whole_column(series: &Series, name: &str) -> Vec<f64> {
    let index = series.place_of(name);
    series.column(index.expect("the summary asks for recorded quantities only"))
}
