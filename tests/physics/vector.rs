//! Rotations and products in the plane.

use drumrs::physics::vector::{Rotation, Vec2, cross, perpendicular};

#[test]
fn rotation_and_its_inverse_cancel() {
    let rotation = Rotation::new(0.7);
    let v = Vec2::new(1.0, 2.0);
    assert!((rotation.apply_inverse(rotation.apply(v)) - v).norm() < 1e-15);
    assert!((rotation.apply(Vec2::new(1.0, 0.0)).y - libm::sin(0.7)).abs() < 1e-16);
}

#[test]
fn perpendicular_turns_counter_clockwise() {
    assert_eq!(perpendicular(Vec2::new(1.0, 0.0)), Vec2::new(0.0, 1.0));
    assert_eq!(cross(Vec2::new(1.0, 0.0), Vec2::new(0.0, 2.0)), 2.0);
}
