//! What is recorded: the table of quantities, the series of samples, the frames.
//!
//! Flows are recorded as energies since the start, so that the mean power over any window of samples is exact.

use std::borrow::Cow;

use serde::{Deserialize, Serialize};

use super::memory;
use crate::error::Error;
use crate::physics::columns::Columns;
use crate::physics::contact::gross_work::GrossWork;
use crate::physics::contact::{Flows, Stored};
use crate::physics::energy::{EnergyLedger, StoredEnergy, SurfaceAccount};

/// What is recorded on request.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Recording {
    /// What contacts exchange, loading and unloading both counted.
    GrossWork,
    /// Every contact, from first touch to opening.
    Contacts,
    /// What contacts do along the outline of the drum.
    WallProfile,
    /// What contacts take, by pair of species, and by species and part of the drum.
    LedgerSplit,
    /// What contacts do to each disc, and its flights.
    Discs,
    /// Sums over discs and contacts in cells of the laboratory.
    Fields,
}

impl Recording {
    /// Whether what each contact does has to be added up for it.
    pub fn needs_contacts(self) -> bool {
        !matches!(self, Self::GrossWork | Self::Fields)
    }
}

/// Everything that a sample may look at.
#[derive(Debug)]
pub struct Snapshot<'a> {
    /// Time [s].
    pub time: f64,
    /// The drum's angle [rad].
    pub angle: f64,
    /// Its angular velocity [rad/s].
    pub angular_velocity: f64,
    /// The accounts.
    pub ledger: &'a EnergyLedger,
    /// Gross work, where it is recorded [J/m].
    pub gross_work: Option<GrossWork<f64>>,
    /// What is stored now.
    pub stored: StoredEnergy,
    /// Angular momentum of the load about the axis [kg m/s].
    pub angular_momentum: f64,
    /// Mass of the load [kg/m].
    pub mass: f64,
    /// Contacts between bundles, and of bundles with the drum.
    pub contacts: (usize, usize),
    /// Number of bundles.
    pub count: usize,
    /// What the last sample had seen.
    pub earlier: &'a Earlier,
}

/// What the next sample needs of the last: its time, and integrals from which means over the interval follow.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Earlier {
    /// Time of the last sample [s]; none before the first.
    pub time: Option<f64>,
    drum_work: f64,
    mass_moment: [f64; 2],
    impulses: Vec<[f64; 3]>,
}

/// How the values of a quantity are to be read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reading {
    /// The value at the time of the sample.
    Sample,
    /// The mean since the last sample.
    Mean,
    /// The integral since t = 0.
    Cumulative,
    /// The greatest value since the last sample.
    Greatest,
}

impl Reading {
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Sample => "sample",
            Self::Mean => "mean",
            Self::Cumulative => "cumulative",
            Self::Greatest => "greatest",
        }
    }
}

/// A column of the series: how it is called and what it holds, as users are told.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Column {
    /// Name.
    pub name: Cow<'static, str>,
    /// Symbol, as formulas use it.
    pub symbol: Cow<'static, str>,
    /// Unit, per meter of drum depth where it is extensive.
    pub unit: &'static str,
    /// How its values are to be read.
    pub reading: Reading,
    /// Formula, in the symbols of other columns; empty where the meaning says it all.
    pub formula: Cow<'static, str>,
    /// What it means.
    pub meaning: Cow<'static, str>,
}

/// A column that every simulation records, and its value.
type Quantity = (Column, fn(&Snapshot) -> f64);

macro_rules! quantities {
    ($list:ident: $($name:literal, $symbol:literal, $unit:literal, $reading:ident, $formula:literal, $meaning:literal, $value:expr;)*) => {
        const $list: &[Quantity] = &[$((
            Column {
                name: Cow::Borrowed($name),
                symbol: Cow::Borrowed($symbol),
                unit: $unit,
                reading: Reading::$reading,
                formula: Cow::Borrowed($formula),
                meaning: Cow::Borrowed($meaning),
            },
            $value,
        )),*];
    };
}

// The energies that laws take (`Flows`) come between the first list and the second, those that they hold (`Stored`) between
// the second and the third.
quantities! { BEFORE_FLOWS:
    "time", "t", "s", Sample, "", "simulated time", |s| s.time;
    "drum_angle", "θ", "rad", Sample, "", "angle by which the drum has turned", |s| s.angle;
    "drum_angular_velocity", "Ω", "rad/s", Sample, "dθ/dt", "angular velocity of the drum", |s| s.angular_velocity;
    "drum_power", "P", "W/m", Mean, "ΔW/Δt", "power of the drum on the load", |s| s.drum_power();
    "drum_specific_power", "P/M", "W/kg", Mean, "P / M", "power of the drum over the mass M of the load", |s| s.drum_power() / s.mass;
    "drum_torque", "τ", "N m/m", Mean, "", "torque of the drum on the load about the axis", |s| s.drum_torque();
    "drum_work", "W", "J/m", Cumulative, "∫ τ dθ", "work of the drum on the load", |s| s.ledger.drum_work();
    "moment_balance_work", "W_L", "J/m", Cumulative, "∫ Ω (M g x_c + dL/dt) dt", "work of the drum from the balance of moments about the axis", |s| s.ledger.moments.work();
    "normal_work", "N", "J/m", Cumulative, "D_normal + ΔE_elastic_normal", "energy that normal damping took and normal springs hold", |s| s.work(is_normal);
    "tangential_work", "T", "J/m", Cumulative, "D_sliding + D_tangential + ΔE_elastic_tangential", "energy that sliding and tangential damping took and tangential springs hold", |s| s.work(is_tangential);
}

quantities! { BEFORE_STORED:
    "numerical", "D_numerical", "J/m", Cumulative, "W − ΔE − Σ D", "work of contacts that no contact law accounts for, which falls with the time step", |s| s.ledger.numerical(&s.stored);
    "kinetic_translation", "K_t", "J/m", Sample, "Σ ½ m v²", "kinetic energy of translation", |s| s.stored.kinetic_translation;
    "kinetic_rotation", "K_r", "J/m", Sample, "Σ ½ I ω²", "kinetic energy of rotation", |s| s.stored.kinetic_rotation;
    "gravitational", "V", "J/m", Sample, "−Σ m g · x", "potential energy, zero at the axis", |s| s.stored.gravitational;
}

quantities! { AFTER_STORED:
    "residual", "R", "J/m", Sample, "ΔE + Σ D + D_numerical − W", "what the energy ledger fails to account for: round-off", |s| s.ledger.residual(&s.stored);
    "energy_residual", "ε", "1", Sample, "|R| / max(|W| + Σ |D| + |D_numerical|, max E)", "the residual over all flows or the greatest stored energy", |s| s.ledger.relative_residual(&s.stored);
    "center_of_mass_x", "x_c", "m", Mean, "Σ m x / M", "horizontal position of the center of mass from the axis", |s| s.mean_center(0);
    "center_of_mass_y", "y_c", "m", Mean, "Σ m y / M", "vertical position of the center of mass from the axis", |s| s.mean_center(1);
    "angular_momentum", "L", "kg m/s", Sample, "Σ (m (x v_y − y v_x) + I ω)", "angular momentum of the load about the axis, spin included", |s| s.angular_momentum;
    "coordination", "Z", "1", Sample, "(2 n_bundle + n_drum) / N", "contacts per bundle, those with the drum included", |s| s.coordination();
    "contact_count", "n", "1", Sample, "n_bundle + n_drum", "number of contacts", |s| (s.contacts.0 + s.contacts.1) as f64;
    "max_overlap_ratio", "δ/r", "1", Greatest, "", "overlap over the smaller radius", |s| s.ledger.overlap_ratio;
}

/// The columns that every simulation records; those of rim, baffles and walls follow them.
pub fn quantities() -> impl Iterator<Item = Column> {
    let of = |list: &'static [Quantity]| list.iter().map(|(column, _)| column.clone());
    let energies = |names: &'static [&'static str], meanings: &'static [&'static str], reading| {
        let symbol = if reading == Reading::Cumulative { "D" } else { "E" };
        names.iter().zip(meanings).map(move |(&name, meaning)| Column {
            name: name.into(),
            symbol: format!("{symbol}_{}", name.trim_start_matches("dissipated_")).into(),
            unit: "J/m",
            reading,
            formula: "".into(),
            meaning: format!("energy{meaning}").into(),
        })
    };
    of(BEFORE_FLOWS)
        .chain(energies(Flows::NAMES, Flows::MEANINGS, Reading::Cumulative))
        .chain(of(BEFORE_STORED))
        .chain(energies(Stored::NAMES, Stored::MEANINGS, Reading::Sample))
        .chain(of(AFTER_STORED))
}

/// The energies that contact laws take or hold.
pub fn contact_energies() -> impl Iterator<Item = &'static str> {
    Flows::NAMES.iter().chain(Stored::NAMES).copied()
}

/// Whether an energy of contacts is exchanged along their normals.
fn is_normal(name: &str) -> bool {
    name.ends_with("normal")
}

/// Whether an energy of contacts is exchanged along their tangents.
fn is_tangential(name: &str) -> bool {
    name.ends_with("tangential") || name.ends_with("sliding")
}

impl Snapshot<'_> {
    /// The values of the quantities that every simulation records.
    fn values(&self) -> impl Iterator<Item = f64> {
        let of = |list: &'static [Quantity]| list.iter().map(|(_, value)| value(self));
        of(BEFORE_FLOWS)
            .chain((0..Flows::COUNT).map(|flow| self.ledger.flow(flow)))
            .chain(of(BEFORE_STORED))
            .chain((0..Stored::COUNT).map(|part| Stored::field(&self.stored.contacts, part)))
            .chain(of(AFTER_STORED))
    }

    /// Work into contacts in one direction, as far as laws account for it: what they took and hold more than at the start.
    fn work(&self, is_meant: fn(&str) -> bool) -> f64 {
        let taken = Flows::NAMES.iter().enumerate().filter(|(_, name)| is_meant(name));
        let held = self.ledger.stored_since_start(&self.stored);
        let stored = Stored::NAMES.iter().enumerate().filter(|(_, name)| is_meant(name));
        taken.map(|(flow, _)| self.ledger.flow(flow)).sum::<f64>()
            + stored.map(|(part, _)| Stored::field(&held, part)).sum::<f64>()
    }

    /// What the next sample needs of this one.
    pub fn for_next(&self) -> Earlier {
        Earlier {
            time: Some(self.time),
            drum_work: self.ledger.drum_work(),
            mass_moment: self.ledger.moments.mass_moment_integral(),
            impulses: self.ledger.surfaces.iter().map(impulses).collect(),
        }
    }

    /// Time since the last sample [s]; 0 at the first.
    fn interval(&self) -> f64 {
        self.time - self.earlier.time.unwrap_or(self.time)
    }

    fn over_interval(&self, change: f64) -> f64 {
        let interval = self.interval();
        if interval > 0.0 { change / interval } else { 0.0 }
    }

    fn drum_power(&self) -> f64 {
        self.over_interval(self.ledger.drum_work() - self.earlier.drum_work)
    }

    fn mean_center(&self, axis: usize) -> f64 {
        let moment = self.ledger.moments.mass_moment_integral()[axis] - self.earlier.mass_moment[axis];
        let interval = self.interval();
        if interval > 0.0 {
            moment / interval / self.mass
        } else {
            self.ledger.moments.mass_moment()[axis] / self.mass
        }
    }

    fn coordination(&self) -> f64 {
        (2 * self.contacts.0 + self.contacts.1) as f64 / self.count as f64
    }

    /// Mean torque of the whole drum on the load since the last sample.
    fn drum_torque(&self) -> f64 {
        (0..self.ledger.surfaces.len()).map(|surface| self.mean_load(surface)[2]).sum()
    }

    /// Mean force (x, y) and torque of a surface on the load since the last sample.
    fn mean_load(&self, surface: usize) -> [f64; 3] {
        let earlier = self.earlier.impulses.get(surface).copied().unwrap_or_default();
        let now = impulses(&self.ledger.surfaces[surface]);
        std::array::from_fn(|part| self.over_interval(now[part] - earlier[part]))
    }
}

/// Integrals of force (x, y) and torque of a surface on the load.
fn impulses(account: &SurfaceAccount) -> [f64; 3] {
    let [x, y] = account.impulse();
    [x, y, account.angular_impulse()]
}

/// The columns of a drum with surfaces of these names, and of what is recorded on request.
pub fn columns(surfaces: &[String], record: &[Recording]) -> Vec<Column> {
    let surfaces = surfaces.iter().map(|name| name.replace(' ', "_"));
    let on_request = record.contains(&Recording::GrossWork).then(gross_work).into_iter().flatten();
    quantities().chain(on_request).chain(surfaces.flat_map(|surface| columns_of(&surface))).collect()
}

/// The columns of the gross work.
fn gross_work() -> impl Iterator<Item = Column> {
    (0..GrossWork::COUNT).map(|way| Column {
        name: GrossWork::NAMES[way].into(),
        symbol: GrossWork::SYMBOLS[way].into(),
        unit: "J/m",
        reading: Reading::Cumulative,
        formula: GrossWork::FORMULAS[way].into(),
        meaning: format!("energy{}, loading and unloading both counted", GrossWork::MEANINGS[way]).into(),
    })
}

/// The columns of a surface, in the order in which `Series::push` writes them.
fn columns_of(surface: &str) -> [Column; 4] {
    use Reading::{Cumulative, Mean};
    let words = if surface == "rim" { "the rim".into() } else { surface.replace('_', " ") };
    [
        ("work", "W", "", "J/m", Cumulative, format!("work of {words} on the load")),
        ("torque", "τ", "", "N m/m", Mean, format!("torque of {words} on the load about the axis")),
        ("force_x", "F", ",x", "N/m", Mean, format!("horizontal force of the load on {words}")),
        ("force_y", "F", ",y", "N/m", Mean, format!("vertical force of the load on {words}")),
    ]
    .map(|(name, letter, axis, unit, reading, meaning)| Column {
        name: format!("{surface}_{name}").into(),
        symbol: format!("{letter}_{surface}{axis}").into(),
        unit,
        reading,
        formula: if reading == Cumulative { format!("∫ τ_{surface} dθ").into() } else { "".into() },
        meaning: meaning.into(),
    })
}

/// Samples, one row each.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Series {
    columns: Vec<Column>,
    values: Vec<f64>,
}

impl Series {
    /// An empty series of these columns.
    pub fn new(columns: Vec<Column>) -> Self {
        Self { columns, values: Vec::new() }
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.values.len().checked_div(self.width()).unwrap_or(0)
    }

    /// Whether nothing has been recorded.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    /// The columns.
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// Number of columns.
    pub fn width(&self) -> usize {
        self.columns.len()
    }

    /// The values from a row on, row after row.
    pub fn rows_from(&self, row: usize) -> &[f64] {
        &self.values[row * self.width()..]
    }

    /// Puts whole rows before those that are there.
    ///
    /// # Errors
    /// `Error::Memory` where there is no room for them; nothing has changed then.
    pub fn prepend(&mut self, rows: &[f64]) -> Result<(), Error> {
        memory::prepend(&mut self.values, rows, "putting samples back")
    }

    /// Reserves memory for a row, so that `push` cannot fail.
    ///
    /// # Errors
    /// `Error::Memory` where there is none.
    pub fn reserve(&mut self) -> Result<(), Error> {
        memory::reserve(&mut self.values, self.columns.len(), "recording a sample")
    }

    /// Appends a row.
    pub fn push(&mut self, snapshot: &Snapshot) {
        self.values.extend(snapshot.values());
        let gross_work = snapshot.gross_work.iter();
        self.values
            .extend(gross_work.flat_map(|sums| (0..GrossWork::COUNT).map(|way| GrossWork::field(sums, way))));
        for (surface, account) in snapshot.ledger.surfaces.iter().enumerate() {
            // Forces are those of the load on the surface, as bearings feel them; torque is that of the drive.
            let [x, y, torque] = snapshot.mean_load(surface);
            self.values.extend([account.work(), torque, 0.0 - x, 0.0 - y]);
        }
    }

    /// One column, a value for each row.
    pub fn column(&self, index: usize) -> Vec<f64> {
        self.values.iter().skip(index).step_by(self.width().max(1)).copied().collect()
    }

    /// The place of a column.
    pub fn place_of(&self, name: &str) -> Option<usize> {
        self.columns.iter().position(|column| column.name == name)
    }

    /// The sum over rim, baffles and walls of a quantity that each of them has, a value for each row.
    pub fn sum_over_surfaces(&self, quantity: &str) -> Vec<f64> {
        let ending = format!("_{quantity}");
        let is_meant = |column: &Column| column.name.ends_with(&ending);
        let places: Vec<_> = (0..self.width()).filter(|&place| is_meant(&self.columns[place])).collect();
        let sum = |row: &[f64]| places.iter().map(|&place| row[place]).sum();
        self.values.chunks_exact(self.width().max(1)).map(sum).collect()
    }

    /// One column, where there may be no memory for it.
    ///
    /// # Errors
    /// `Error::Memory` where there is none.
    pub fn try_column(&self, index: usize) -> Result<Vec<f64>, Error> {
        let mut column = Vec::new();
        memory::reserve(&mut column, self.len(), "reading the series")?;
        column.extend(self.values.iter().skip(index).step_by(self.width().max(1)));
        Ok(column)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_column_has_a_name_of_its_own_and_a_unit() {
        let surfaces = ["rim", "baffle 1", "high lifter 1", "wall 1", "wall 2"].map(String::from);
        let columns = columns(&surfaces, &[Recording::GrossWork]);
        let mut names: Vec<_> = columns.iter().map(|column| &column.name).collect();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), quantities().count() + GrossWork::COUNT + 4 * 5);
        assert!(columns.iter().all(|column| !column.unit.is_empty() && !column.meaning.is_empty()));
    }
}
