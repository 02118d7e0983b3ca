//! Schedules of rotation: velocities, angles as their integrals, what is refused.

use drumrs::physics::rotation::RotationSchedule;

fn program() -> RotationSchedule {
    RotationSchedule { knots: vec![[0.5, 2.0], [1.5, -1.0], [1.75, -1.0], [4.0, 6.0]] }
}

/// The angle by Simpson's rule: exact but for the few short intervals that hold a knot.
fn integrated(schedule: &RotationSchedule, from: f64, to: f64) -> f64 {
    let count = 4000;
    let width = (to - from) / f64::from(count);
    let interval = |k: i32| {
        let start = from + f64::from(k) * width;
        let [a, b, c] = [0.0, 0.5, 1.0].map(|part| schedule.angular_velocity(start + part * width));
        (a + 4.0 * b + c) * width / 6.0
    };
    (0..count).map(interval).sum()
}

#[test]
fn velocity_is_linear_between_knots_and_constant_outside() {
    let times = [0.0, 0.5, 1.0, 1.5, 1.6, 2.875, 4.0, 9.0];
    assert_eq!(times.map(|t| program().angular_velocity(t)), [2.0, 2.0, 0.5, -1.0, -1.0, 2.5, 6.0, 6.0]);
}

#[test]
fn angle_is_the_integral_of_the_velocity() {
    for time in [0.0, 0.25, 0.5, 0.875, 1.5, 1.625, 3.0, 4.0, 8.0] {
        assert!((program().angle(time) - integrated(&program(), 0.0, time)).abs() < 2e-6, "{time}");
    }
    // 0.5 s at 2, ramp to −1 in 1 s, 0.25 s at −1, ramp to 6 in 2.25 s, 1 s at 6.
    assert_eq!(program().angle(5.0), 1.0 + 0.5 - 0.25 + 5.625 + 6.0);
    assert_eq!(program().angle(0.0), 0.0);
    assert_eq!(RotationSchedule::constant(5.5).angle(1e6 + 0.25), 5.5 * (1e6 + 0.25));
}

#[test]
fn increments_are_integrals_and_add_up_to_the_angle() {
    let steps = 1 << 12;
    let step = 6.0 / f64::from(steps);
    let sum: f64 =
        (0..steps).map(|k| program().angle_increment(f64::from(k) * step, f64::from(k + 1) * step)).sum();
    assert!((sum - program().angle(6.0)).abs() < 1e-12);
    for (from, to) in [(0.25, 0.3), (0.3, 1.25), (1.0, 5.0), (4.5, 4.75)] {
        assert!((program().angle_increment(from, to) - integrated(&program(), from, to)).abs() < 2e-6);
        assert_eq!(program().angle_increment(to, from), -program().angle_increment(from, to));
    }
}

#[test]
fn late_increments_lose_no_digits() {
    let mut knots = program().knots;
    knots.push([2e6, 5.0]);
    let (start, step) = (1_048_576.0, 1.0 / 262_144.0);
    let increment = RotationSchedule { knots }.angle_increment(start, start + step);
    let rate = 6.0 - (start + 0.5 * step - 4.0) / (2e6 - 4.0);
    assert!((increment / (rate * step) - 1.0).abs() < 1e-15);
}

#[test]
fn reversed_schedule_turns_by_exactly_the_opposite_angle() {
    let reversed = RotationSchedule { knots: program().knots.iter().map(|&[t, rate]| [t, -rate]).collect() };
    for time in [0.0, 0.1, 0.7, 1.3, 1.7, 3.3, 7.7] {
        assert_eq!(reversed.angle(time), -program().angle(time));
        assert_eq!(reversed.angle_increment(0.3, time), -program().angle_increment(0.3, time));
    }
}

#[test]
fn scaled_time_gives_the_same_angle_bit_for_bit() {
    let slow =
        RotationSchedule { knots: program().knots.iter().map(|&[t, rate]| [2.0 * t, 0.5 * rate]).collect() };
    for time in [0.1, 0.7, 1.3, 1.7, 3.3, 7.7] {
        assert_eq!(slow.angle(2.0 * time).to_bits(), program().angle(time).to_bits());
        let (increment, expected) =
            (slow.angle_increment(0.6, 2.0 * time), program().angle_increment(0.3, time));
        assert_eq!(increment.to_bits(), expected.to_bits());
    }
}

/// 2 s at 3 rad/s, a jump, 1 s at −1 rad/s, a jump, from 4 rad/s to 0 in 2 s.
fn jumping() -> RotationSchedule {
    let knots = vec![[0.0, 3.0], [2.0, 3.0], [2.0, -1.0], [3.0, -1.0], [3.0, 4.0], [5.0, 0.0]];
    RotationSchedule { knots }
}

#[test]
fn a_jump_takes_no_time_and_belongs_to_what_follows() {
    let times = [1.0, 2.0, 2.5, 3.0, 4.0];
    assert_eq!(times.map(|t| jumping().angular_velocity(t)), [3.0, -1.0, -1.0, 4.0, 2.0]);
    assert_eq!(times.map(|t| jumping().angle(t)), [3.0, 6.0, 5.5, 5.0, 8.0]);
    // A step that ends at a jump knows nothing of it, one that holds it is exact.
    assert_eq!(jumping().angle_increment(1.75, 2.0), 0.75);
    assert_eq!(jumping().angle_increment(2.0, 2.25), -0.25);
    assert_eq!(jumping().angle_increment(1.75, 2.25), 0.5);
    assert_eq!(jumping().greatest_speed(), 4.0);
    assert!(!jumping().is_constant());
}

#[test]
fn a_steady_time_is_one_without_a_jump_or_ramp() {
    for (from, to, steady) in [
        (0.5, 1.0, true),
        (1.5, 2.0, false),
        (2.0, 2.5, true),
        (1.5, 2.5, false),
        (3.5, 4.0, false),
        (5.0, 9.0, true),
    ] {
        assert_eq!(jumping().is_steady(from, to), steady, "{from} to {to}");
    }
    let blip = RotationSchedule { knots: vec![[1.0, 2.0], [1.0, 9.0], [1.5, 9.0], [1.5, 2.0]] };
    assert!(!blip.is_steady(0.5, 2.0));
}

#[test]
fn the_angle_by_sums_at_knots_has_the_same_bits() {
    for schedule in [program(), jumping(), RotationSchedule::constant(5.5)] {
        let angles = schedule.angles_at_knots();
        for time in (0..700).map(|k| 0.01 * f64::from(k)).chain(schedule.knots.iter().map(|knot| knot[0])) {
            assert_eq!(schedule.angle_by(&angles, time).to_bits(), schedule.angle(time).to_bits(), "{time}");
        }
    }
}

#[test]
fn constant_schedules_are_recognized() {
    assert!(RotationSchedule::constant(3.0).is_constant());
    assert!(RotationSchedule { knots: vec![[0.0, 1.0], [2.0, 1.0]] }.is_constant());
    assert!(!program().is_constant());
}

#[test]
fn unusable_schedules_are_refused() {
    let message = |knots: Vec<[f64; 2]>| RotationSchedule { knots }.validate().unwrap_err().to_string();
    assert_eq!(
        message(vec![]),
        "rotation.program is empty, but must be a list of at least one time and speed"
    );
    assert_eq!(message(vec![[0.0, f64::NAN]]), "rotation.program is NaN, but must be a finite number");
    assert_eq!(
        message(vec![[-1.0, 2.0]]),
        "rotation.program is a list that starts at -1 s, but must be a list that starts at 0 s or later"
    );
    assert_eq!(
        message(vec![[0.0, 2.0], [4.0, 1.0], [3.0, 4.0]]),
        "rotation.program is a list with 3 s after 4 s, but must be a list of increasing times"
    );
    assert_eq!(
        message(vec![[3.0, 2.0], [3.0, 1.0], [3.0, 4.0]]),
        "rotation.program is a list with three knots at 3 s, but must be a list of at most two knots at one time, before and after a jump"
    );
    assert!(program().validate().is_ok());
}
