//! The linear law's damping: restitution, times of collision, losses, what is refused.

use drumrs::physics::columns::Columns;
use drumrs::physics::contact::law::{BodyPair, ContactLaw};
use drumrs::physics::contact::linear::{Linear, SpringHistory, collision_time, damping, damping_ratio};
use drumrs::physics::contact::parameters::{ContactParameters, Tension};
use drumrs::physics::contact::{ContactState, Kinematics, RelativeMotion};

use crate::common::{law, mass};

fn table_1(tension: Tension) -> ContactParameters {
    ContactParameters { tension, ..law(9.25e7) }
}

#[test]
fn table_1_damping_and_collision_time_follow_from_the_restitution() {
    let bundle = table_1(Tension::Allowed);
    assert!((damping(&bundle, 0.5 * mass()) - 5.35e3).abs() < 5.0);
    assert!((collision_time(&bundle, 0.5 * mass()) - 1.906e-4).abs() < 1e-7);
    let drum = ContactParameters { normal_stiffness: 9.70e7, ..bundle };
    assert!((damping(&drum, mass()) - 7.75e3).abs() < 5.0);
}

/// e = exp(−2 φ / tan φ) with φ = acos ζ, against the numbers that were published for it; and ζ comes back from e.
#[test]
fn clipped_restitution_matches_schwager_and_poschel() {
    let ratio_for = |restitution: f64| {
        let parameters = ContactParameters { restitution: Some(restitution), ..table_1(Tension::Clipped) };
        damping_ratio(&parameters, mass())
    };
    for (ratio, published) in [(0.1, 0.7441), (0.3, 0.4510), (0.6, 0.2488), (0.8, 0.1798)] {
        let phase = libm::acos(ratio);
        let restitution = libm::exp(-2.0 * phase / libm::tan(phase));
        assert!((restitution - published).abs() < 5e-5);
        assert!((ratio_for(restitution) / ratio - 1.0).abs() < 1e-12);
        assert!((ratio_for(published) - ratio).abs() < 3e-4);
    }
    assert!(ratio_for(0.1) > 1.0, "0.1 lies beyond critical damping");
}

#[test]
fn losses_are_never_negative() {
    let bodies = BodyPair { effective_mass: 0.2, effective_radius: 0.006, layer: 0.024 };
    for tension in [Tension::Allowed, Tension::Clipped] {
        let law = Linear::<true>::between(&table_1(tension), bodies);
        for k in 0..2000_i32 {
            let wave = |n: i32| f64::from((k * n) % 17 - 8) * 1e-6;
            let last = ContactState {
                overlap: wave(3).max(0.0),
                separation_rate: wave(2) * 1e5,
                ..ContactState::build(|_| 0.0)
            };
            let stretch = if last.overlap > 0.0 { wave(5) } else { 0.0 };
            let motion = RelativeMotion {
                overlap: wave(7),
                separation_rate: wave(11) * 1e5,
                slip_rate: wave(13) * 1e5,
                rolling_rate: 0.0,
            };
            let contact = Kinematics::new(&motion, &last, [3.7e-6, 1.0 / 3.7e-6]);
            let history = SpringHistory { tangential_displacement: stretch };
            let (response, _) = Linear::<true>::respond(&law, &contact, &history);
            assert!(response.flows.dissipated_normal >= 0.0, "{k}");
            assert!(response.flows.dissipated_sliding >= 0.0, "{k}");
        }
    }
}

#[test]
fn bad_parameters_are_named() {
    let both = ContactParameters { normal_damping: Some(1.0), ..table_1(Tension::Allowed) };
    let text = both.validate("contact.drum").unwrap_err().to_string();
    assert!(text.starts_with("contact.drum.restitution is given beside normal_damping"), "{text}");
    let elastic_plus = ContactParameters { restitution: Some(1.5), ..table_1(Tension::Allowed) };
    let text = elastic_plus.validate("contact.bundle").unwrap_err().to_string();
    assert_eq!(text, "contact.bundle.restitution is 1.5, but must be above 0 and at most 1");
}
