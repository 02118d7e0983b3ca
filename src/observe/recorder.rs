//! What is recorded: the table of quantities, the series of samples, the frames.
//!
//! Flows are recorded as energies since the start, so that the mean power over any window of samples is exact.

use serde::{Deserialize, Serialize};

use super::memory;
use crate::error::Error;
use crate::physics::columns::Columns;
use crate::physics::contact::{Flows, Stored};
use crate::physics::energy::{EnergyLedger, StoredEnergy, SurfaceAccount};

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

/// One recorded quantity.
#[derive(Debug, Clone, Copy)]
pub struct Quantity {
    /// Column name.
    pub name: &'static str,
    /// Unit, per metre of drum depth where it is extensive.
    pub unit: &'static str,
    /// What it means.
    pub meaning: &'static str,
    value: fn(&Snapshot) -> f64,
}

macro_rules! quantities {
    ($list:ident: $($name:literal, $unit:literal, $meaning:literal, $value:expr;)*) => {
        const $list: &[Quantity] =
            &[$(Quantity { name: $name, unit: $unit, meaning: $meaning, value: $value }),*];
    };
}

// The energies that laws take (`Flows`) come between the first list and the second, those that they hold (`Stored`) between
// the second and the third.
quantities! { BEFORE_FLOWS:
    "time", "s", "time of the sample", |s| s.time;
    "drum_angle", "rad", "angle of the drum", |s| s.angle;
    "drum_angular_velocity", "rad/s", "angular velocity of the drum", |s| s.angular_velocity;
    "drum_power", "W/m", "mean power of the drum on the load since the last sample", |s| s.drum_power();
    "specific_power", "W/kg", "drum power over the mass of the load", |s| s.drum_power() / s.mass;
    "drum_torque", "N m/m", "mean torque of the drum on the load about the axis since the last sample", |s| s.drum_torque();
    "work_drum", "J/m", "work of the drum on the load since t = 0", |s| s.ledger.drum_work();
    "balance_work", "J/m", "the same from the balance of moments, integral of angular velocity x (M g x + dL/dt)", |s| s.ledger.moments.work();
    "work_normal", "J/m", "energy taken by normal dashpots, and held by normal springs, since t = 0", |s| s.work(is_normal);
    "work_tangential", "J/m", "energy taken by sliding, and held by tangential springs, since t = 0", |s| s.work(is_tangential);
}

quantities! { BEFORE_STORED:
    "numerical", "J/m", "contact work that contact laws do not account for since t = 0", |s| s.ledger.numerical(&s.stored);
    "kinetic_translation", "J/m", "kinetic energy of translation", |s| s.stored.kinetic_translation;
    "kinetic_rotation", "J/m", "kinetic energy of rotation", |s| s.stored.kinetic_rotation;
    "gravitational", "J/m", "potential energy, zero at the axis", |s| s.stored.gravitational;
}

quantities! { AFTER_STORED:
    "residual", "J/m", "stored + dissipated - work of the drum - initial energy: round-off", |s| s.ledger.residual(&s.stored);
    "energy_residual", "1", "the residual over the sum of all flows or the greatest stored energy", |s| s.ledger.relative_residual(&s.stored);
    "center_of_mass_x", "m", "mean horizontal position of the center of mass since the last sample", |s| s.mean_center(0);
    "center_of_mass_y", "m", "mean vertical position of the center of mass since the last sample", |s| s.mean_center(1);
    "angular_momentum", "kg m/s", "angular momentum of the load about the axis, spin included", |s| s.angular_momentum;
    "coordination", "1", "contacts per bundle, those with the drum included", |s| s.coordination();
    "contact_count", "1", "number of contacts", |s| (s.contacts.0 + s.contacts.1) as f64;
    "max_overlap_ratio", "1", "greatest overlap since the last sample over the smaller radius", |s| s.ledger.overlap_ratio;
}

/// The quantities that every simulation records, by name, unit and meaning; those of rim, baffles and walls follow them.
pub fn quantities() -> impl Iterator<Item = (&'static str, &'static str, String)> {
    let of = |list: &'static [Quantity]| list.iter().map(|q| (q.name, q.unit, q.meaning.to_owned()));
    let energies =
        |names: &'static [&'static str], meanings: &'static [&'static str], since: &'static str| {
            names
                .iter()
                .zip(meanings)
                .map(move |(&name, meaning)| (name, "J/m", format!("energy{meaning}{since}")))
        };
    of(BEFORE_FLOWS)
        .chain(energies(Flows::NAMES, Flows::MEANINGS, " since t = 0"))
        .chain(of(BEFORE_STORED))
        .chain(energies(Stored::NAMES, Stored::MEANINGS, ""))
        .chain(of(AFTER_STORED))
}

/// The energies that contact laws take or hold.
pub fn contact_energies() -> impl Iterator<Item = &'static str> {
    Flows::NAMES.iter().chain(Stored::NAMES).copied()
}

/// Whether an energy of contacts is exchanged along their normals.
pub fn is_normal(name: &str) -> bool {
    name.ends_with("normal")
}

/// Whether an energy of contacts is exchanged along their tangents.
pub fn is_tangential(name: &str) -> bool {
    name.ends_with("tangential") || name.ends_with("sliding")
}

impl Snapshot<'_> {
    /// The values of the quantities that every simulation records.
    fn values(&self) -> impl Iterator<Item = f64> {
        let of = |list: &'static [Quantity]| list.iter().map(|quantity| (quantity.value)(self));
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

/// A column of the series: (name, unit, meaning).
pub type Column = (String, String, String);

/// The columns of a drum with so many baffles and walls.
pub fn columns(baffles: usize, walls: usize) -> Vec<Column> {
    let fixed = quantities().map(|(name, unit, meaning)| (name.into(), unit.into(), meaning));
    let parts = surface_names(baffles, walls).into_iter().flat_map(|part| {
        let words = part.replace('_', " ");
        [
            (format!("work_{part}"), "J/m".into(), format!("work of the {words} on the load since t = 0")),
            (
                format!("torque_{part}"),
                "N m/m".into(),
                format!("mean torque of the {words} on the load about the axis since the last sample"),
            ),
            (
                format!("force_{part}_x"),
                "N/m".into(),
                format!("mean horizontal force of the load on the {words} since the last sample"),
            ),
            (
                format!("force_{part}_y"),
                "N/m".into(),
                format!("mean vertical force of the load on the {words} since the last sample"),
            ),
        ]
    });
    fixed.chain(parts).collect()
}

fn surface_names(baffles: usize, walls: usize) -> Vec<String> {
    std::iter::once("rim".to_owned())
        .chain((1..=baffles).map(|k| format!("baffle_{k}")))
        .chain((1..=walls).map(|k| format!("wall_{k}")))
        .collect()
}

/// Samples, one row each.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Series {
    width: usize,
    values: Vec<f64>,
}

impl Series {
    /// An empty series of `width` columns.
    pub fn new(width: usize) -> Self {
        Self { width, values: Vec::new() }
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.values.len().checked_div(self.width).unwrap_or(0)
    }

    /// Whether nothing has been recorded.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    /// Number of columns.
    pub fn width(&self) -> usize {
        self.width
    }

    /// The values from a row on, row after row.
    pub fn rows_from(&self, row: usize) -> &[f64] {
        &self.values[row * self.width..]
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
        memory::reserve(&mut self.values, self.width, "recording a sample")
    }

    /// Appends a row.
    pub fn push(&mut self, snapshot: &Snapshot) {
        self.values.extend(snapshot.values());
        for (surface, account) in snapshot.ledger.surfaces.iter().enumerate() {
            // Forces are those of the load on the surface, as bearings feel them; torque is that of the drive.
            let [x, y, torque] = snapshot.mean_load(surface);
            self.values.extend([account.work(), torque, 0.0 - x, 0.0 - y]);
        }
    }

    /// One column, a value for each row.
    pub fn column(&self, index: usize) -> Vec<f64> {
        self.values.iter().skip(index).step_by(self.width.max(1)).copied().collect()
    }

    /// One column, where there may be no memory for it.
    ///
    /// # Errors
    /// `Error::Memory` where there is none.
    pub fn try_column(&self, index: usize) -> Result<Vec<f64>, Error> {
        let mut column = Vec::new();
        memory::reserve(&mut column, self.len(), "reading the series")?;
        column.extend(self.values.iter().skip(index).step_by(self.width.max(1)));
        Ok(column)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_column_has_a_name_of_its_own_and_a_unit() {
        let columns = columns(3, 1);
        let mut names: Vec<_> = columns.iter().map(|column| &column.0).collect();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), quantities().count() + 4 * 5);
        assert!(columns.iter().all(|(_, unit, meaning)| !unit.is_empty() && !meaning.is_empty()));
    }
}
