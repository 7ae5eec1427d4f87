//! The rules that one grain a site can follow. Every choice of a rule names all of them, so that a new one does not compile until
//! each has been decided on.

/// A rule for grains on sites; each is a method of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SiteRule {
    /// Voids that go up, each by itself.
    Litwiniszyn,
    /// Voids that go up and keep out of each other's way.
    CaramHong,
    /// Grains that try down, to the sides, and up.
    Savage,
    /// Grains that fly and collide.
    GuttHaff,
    /// Forces in a pile at rest.
    HemmingssonHerrmann,
    /// A lattice gas.
    Gas(GasRule),
}

/// A rule for particles that fly from site to site.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GasRule {
    /// Particles without loss.
    Fhp,
    /// Grains that lose energy.
    PengHerrmann,
    /// Elongated grains.
    BaxterBehringer,
    /// Piles and their avalanches.
    KarolyiKertesz,
}
