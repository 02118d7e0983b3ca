//! Bundles: mass and inertia, states that are refused.

use drumrs::physics::particles::Particles;
use drumrs::physics::vector::Vec2;

#[test]
fn a_bundle_of_table_1_has_its_mass_and_the_inertia_of_a_disc() {
    let particles = Particles::at_rest(vec![Vec2::zeros()], vec![0.011_875], vec![0], |_| 1000.0, false);
    assert!((particles.masses[0] - 0.4430).abs() < 1e-4);
    assert_eq!(particles.inertias[0], 0.5 * particles.masses[0] * 0.011_875 * 0.011_875);
}

#[test]
fn bad_states_are_named() {
    let mut particles =
        Particles::at_rest(vec![Vec2::zeros(); 2], vec![0.1, -0.1], vec![0; 2], |_| 1.0, false);
    assert!(particles.validate().unwrap_err().to_string().starts_with("state.radii[1] is -0.1"));
    particles.radii.pop();
    assert!(particles.validate().unwrap_err().to_string().starts_with("state.radii is of length 1"));
    particles.positions.pop();
    assert!(particles.validate().unwrap_err().to_string().starts_with("state.positions is of length 1"));
}
