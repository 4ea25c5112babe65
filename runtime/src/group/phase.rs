//! A point of T\*G in the left trivialisation.

use core::fmt::{self, Debug};

use crate::group::LieGroup;

/// A phase point (g, μ) ∈ G × 𝔤\* ≅ T\*G: the group element (configuration, attitude) and the
/// *body* momentum μ = J_R, coordinates dual to the group's basis.
pub struct Phase<G: LieGroup> {
    /// g, the configuration.
    pub group_element: G::Element,
    /// μ, the body momentum.
    pub momentum: G::Vector,
}

impl<G: LieGroup> Phase<G> {
    /// The phase point (g, μ).
    #[must_use]
    pub fn new(group_element: G::Element, momentum: impl Into<G::Vector>) -> Self {
        Self { group_element, momentum: momentum.into() }
    }

    /// The phase point (e, μ) over the neutral element.
    #[must_use]
    pub fn at_identity(momentum: impl Into<G::Vector>) -> Self
    where
        G: Default,
    {
        Self::new(G::default().identity(), momentum)
    }

    /// The spatial momentum J_L = Ad\*_g μ, which every integrator here conserves.
    #[must_use]
    pub fn spatial_momentum(&self, group: &G) -> G::Vector {
        group.coadjoint(&self.group_element, &self.momentum)
    }
}

// Derived impls would ask for `G: Clone` where the fields' types are what matters.
impl<G: LieGroup> Clone for Phase<G> {
    fn clone(&self) -> Self {
        Self { group_element: self.group_element.clone(), momentum: self.momentum.clone() }
    }
}

impl<G: LieGroup> Debug for Phase<G> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Phase")
            .field("group_element", &self.group_element)
            .field("momentum", &self.momentum)
            .finish()
    }
}
