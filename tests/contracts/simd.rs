//! Plain numbers and SIMD: the law gives the same bits, whichever it is worked out with.

use crate::common::*;
use drumrs::engine::simd::{F64x4, LANES, Vec2x4, lanes, vectors};
use drumrs::physics::columns::{Columns, Of};
use drumrs::physics::contact::law::{BodyPair, ContactLaw};
use drumrs::physics::contact::linear::Linear;
use drumrs::physics::contact::model::Terms;
use drumrs::physics::contact::parameters::{ContactParameters, Tension};
use drumrs::physics::contact::{ContactState, Flows, Kinematics, RelativeMotion, Response, Stored};
use drumrs::physics::scalar::Scalar;
use proptest::prelude::*;

/// What a contact is told: overlaps now and at the last step, rates now and at the last step, slip, roll, histories.
type Told = [f64; 12];

fn contact<S: Scalar>(told: impl Fn(usize) -> S) -> Kinematics<S> {
    let motion = RelativeMotion {
        overlap: told(0),
        separation_rate: told(2),
        slip_rate: told(4),
        rolling_rate: told(5),
    };
    let last = ContactState {
        overlap: told(1).larger(S::zero()),
        separation_rate: told(3),
        ..ContactState::build(|_| S::zero())
    };
    Kinematics::new(&motion, &last, [S::splat(TIME_STEP), S::splat(1.0 / TIME_STEP)])
}

/// All that a law answers, but for where the spring sticks.
fn columns<S: Scalar>(response: &Response<S>) -> Vec<S> {
    let mut all = vec![
        response.normal_force,
        response.tangential_force,
        response.rolling_moment,
        response.pressing_force,
        response.friction_limit,
    ];
    all.extend((0..Flows::COUNT).map(|flow| Flows::field(&response.flows, flow)));
    all
}

/// Works four contacts out with lanes and one by one.
fn compare<L: ContactLaw>(parameters: &ContactParameters, told: &[Told; LANES]) -> Result<(), TestCaseError> {
    let law = L::between(parameters, BodyPair::of_discs((mass(), RADIUS), (0.4 * mass(), 0.5 * RADIUS)));
    let history = |lane: usize, column: usize| told[lane][(6 + column).min(11)];
    let (four, next) = L::respond(
        &L::Parameters::map(&law, F64x4::splat),
        &contact(|value| lanes(|lane| told[lane][value])),
        &L::History::build(|column| lanes(|lane| history(lane, column))),
    );
    for (lane, told) in told.iter().enumerate() {
        let own: Of<L::History, f64> = L::History::build(|column| history(lane, column));
        let (one, kept) = L::respond(&law, &contact(|value| told[value]), &own);
        for (index, (lanes, number)) in columns(&four).into_iter().zip(columns(&one)).enumerate() {
            let lane = lanes.to_array()[lane];
            prop_assert_eq!(lane.to_bits(), number.to_bits(), "answer {}: {} {}", index, lane, number);
        }
        for column in 0..L::History::COUNT {
            let lane = L::History::field(&next, column).to_array()[lane];
            let number = L::History::field(&kept, column);
            prop_assert_eq!(lane.to_bits(), number.to_bits(), "history {}: {} {}", column, lane, number);
        }
    }
    Ok(())
}

fn told() -> impl Strategy<Value = Told> {
    // Overlaps of every sign and none, so that contacts open, go on, end, and are not there.
    let overlap = || prop_oneof![Just(0.0), Just(-0.0), -2e-6..5e-6_f64];
    let rate = || prop_oneof![Just(0.0), -3.0..3.0_f64];
    let stretch = || prop_oneof![Just(0.0), -3e-6..3e-6_f64];
    (overlap(), overlap(), rate(), rate(), rate(), -90.0..90.0_f64, prop::array::uniform6(stretch()))
        .prop_map(|(overlap, last, separation, last_separation, slip, roll, [a, b, c, d, e, f])| {
            [overlap, last, separation, last_separation, slip, roll, a, b, c, d, e, f]
        })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn lanes_and_numbers_give_the_same_bits(told in prop::array::uniform4(told()), clips in any::<bool>()) {
        let mut parameters = law(9.25e7);
        parameters.tension = if clips { Tension::Clipped } else { Tension::Allowed };
        compare::<Linear<false>>(&parameters, &told)?;
        compare::<Linear<true>>(&parameters, &told)?;
        compare::<(Linear<true>, Terms)>(&parameters, &told)?;
        (parameters.rolling_friction, parameters.tangential_damping_ratio, parameters.adhesion) = (0.1, 0.3, 2.0);
        compare::<(Linear<true>, Terms)>(&parameters, &told)?;
    }
}

#[test]
fn lanes_and_numbers_have_the_same_bits() {
    let values = [1.5, -0.0, f64::NAN, -2.25, 0.0, 1e-300];
    for a in values {
        for b in values {
            let (x, y) = (F64x4::splat(a), F64x4::splat(b));
            let same = |lanes: F64x4, number: f64| lanes.to_array()[2].to_bits() == number.to_bits();
            assert!(same(Scalar::larger(x, y), Scalar::larger(a, b)), "{a} {b}");
            assert!(same(Scalar::smaller(x, y), Scalar::smaller(a, b)), "{a} {b}");
            assert!(same(x.within(x.exceeds(y)), a.within(a.exceeds(b))), "{a} {b}");
        }
    }
}

#[test]
fn rows_become_columns_and_vectors_again() {
    let vector = |lane: usize| [lane as f64, 10.0 * lane as f64];
    let four = vectors(vector);
    assert_eq!(four.x.to_array(), [0.0, 1.0, 2.0, 3.0]);
    assert_eq!(four.to_array().map(wide::f64x2::to_array), [0, 1, 2, 3].map(vector));
    assert_eq!(four.cross(Vec2x4 { x: four.y, y: four.x }).to_array()[1], 1.0 - 100.0);
}

#[test]
fn records_convert_field_by_field() {
    type Both = (Stored, (Flows, ()));
    let mut record = Both::build(|index| index as f64);
    assert_eq!((record.0.elastic_normal, record.0.adhesion, record.1.0.dissipated_normal), (0.0, 3.0, 4.0));
    *Both::field_mut(&mut record, 5) = 7.0;
    assert_eq!(Both::map(&record, |value: f64| value as u8).1.0.dissipated_sliding, 7);
    assert_eq!((Flows::NAMES[1], Flows::MEANINGS[1]), ("dissipated_sliding", " taken by sliding"));
    let [one, other] = [0, 1].map(|set| Flows::build(|flow| flow == set));
    assert_eq!(one.union(other), Flows::build(|flow| flow < 2));
    assert_eq!(one.union(Flows::NONE), one);
}
