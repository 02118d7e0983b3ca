//! Plane vectors: nalgebra's `Vector2<f64>` and the little 2-D algebra that contacts need.

/// A vector in the plane of the drum.
pub type Vec2 = nalgebra::Vector2<f64>;

/// The vector turned by +90° (counter-clockwise).
#[inline]
pub fn perpendicular(v: Vec2) -> Vec2 {
    Vec2::new(-v.y, v.x)
}

/// The z component of a × b: the moment of force `b` acting at lever `a`.
#[inline]
pub fn cross(a: Vec2, b: Vec2) -> f64 {
    a.x * b.y - a.y * b.x
}

/// The scalar product in a fixed order of operations, so that bits do not depend on a library's version.
#[inline]
pub fn dot(a: Vec2, b: Vec2) -> f64 {
    a.x * b.x + a.y * b.y
}

/// The corners (left and low, right and high) of the box round `points`; none without points.
pub fn bounds(points: &[Vec2]) -> Option<(Vec2, Vec2)> {
    let first = *points.first()?;
    Some(points.iter().fold((first, first), |(low, high), point| (low.inf(point), high.sup(point))))
}

/// A rotation of the plane, kept as cosine and sine.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rotation {
    /// Cosine of the angle.
    pub cos: f64,
    /// Sine of the angle.
    pub sin: f64,
}

impl Rotation {
    /// No rotation.
    pub const IDENTITY: Self = Self { cos: 1.0, sin: 0.0 };

    /// The rotation by `angle` [rad], with bits that are the same on every platform.
    pub fn new(angle: f64) -> Self {
        let (sin, cos) = libm::sincos(angle);
        Self { cos, sin }
    }

    /// From the turned frame to the fixed one: `v` turned by the angle.
    #[inline]
    pub fn apply(self, v: Vec2) -> Vec2 {
        Vec2::new(self.cos * v.x - self.sin * v.y, self.sin * v.x + self.cos * v.y)
    }

    /// From the fixed frame to the turned one: `v` turned by minus the angle.
    #[inline]
    pub fn apply_inverse(self, v: Vec2) -> Vec2 {
        Vec2::new(self.cos * v.x + self.sin * v.y, self.cos * v.y - self.sin * v.x)
    }
}
