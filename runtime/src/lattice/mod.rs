//! Lattices of classical spins: one energy over the edges of a graph, for any number of sites.
//!
//! The energy is H = Σ a·M b over the edges (a, b), with a matrix M for each bond, and f·s + s·A s over the sites. Spins move
//! as everywhere here, ds/dt = s × ∂H/∂s; physicists who write ds/dt = −s × ∂H/∂s turn the sign of H. Lengths of spins are
//! those given, and are kept to rounding.
//!
//! | [`Family`] | energies | keeps |
//! |---|---|---|
//! | [`Family::Axes`] | any M | a Poisson map |
//! | [`Family::Bonds`] | any M | a Poisson map; the total spin, where M are isotropic |
//! | [`Family::Sublattices`] | any M | the energy without A; not symplectic |
//! | [`Lattice::gauss`] | any | a Poisson map to rounding; the total spin, where H does |
//!
//! The first three are compositions of exact rotations and several times as fast. Sublattices: M. Krech, A. Bunker,
//! D. P. Landau, *Fast spin dynamics algorithms for classical spin systems*, Comput. Phys. Commun. 111 (1998) 1–13.

mod colours;
mod composition;
mod couplings;
mod error;
mod family;
mod gauss;
mod graph;
mod lanes;
mod layout;
mod rotations;
mod sums;
mod threads;

use alloc::sync::Arc;
use alloc::vec::Vec;

use nalgebra::{Matrix3, Vector3};

pub use composition::Order;
pub use error::LatticeError;
pub use family::Family;
pub use gauss::{GaussStep, NoField};
pub use graph::{Boundary, Graph};
pub use rotations::RotationStep;

use couplings::{Bond, Energies, UserFunction};
use error::{check_factors, check_spins, finite};
use graph::{Edge, MOST, Offset};

/// Spins on a graph with their energy.
#[derive(Clone, Debug)]
pub struct Lattice {
    graph: Graph,
    energies: Energies,
}

impl Lattice {
    /// The sites of a graph, without an energy.
    #[must_use]
    pub fn new(graph: Graph) -> Self {
        Self { graph, energies: Energies::default() }
    }

    /// Adds a·M b for the first site a of every cell and the first site b of the cell at an offset from it.
    ///
    /// # Errors
    /// As [`Lattice::bond_between`].
    pub fn bond(
        self,
        offset: impl AsRef<[isize]>,
        matrix: Matrix3<f64>,
    ) -> Result<Self, LatticeError> {
        self.bond_between(offset, [0, 0], matrix)
    }

    /// Adds a·M b for a site a of every cell and a site b of the cell at an offset from it; `sites` are their numbers in the
    /// cells. An offset out of an open lattice joins nothing.
    ///
    /// # Errors
    /// [`LatticeError::Offset`], [`LatticeError::NoSite`], [`LatticeError::SelfEdge`], [`LatticeError::DuplicateEdge`],
    /// [`LatticeError::NoEdges`], [`LatticeError::TooLarge`], [`LatticeError::Coefficient`].
    pub fn bond_between(
        self,
        offset: impl AsRef<[isize]>,
        sites: [usize; 2],
        matrix: Matrix3<f64>,
    ) -> Result<Self, LatticeError> {
        let edges = self.graph.edges(Offset { by: offset.as_ref(), sites })?;
        self.with_bond(edges, matrix, None)
    }

    /// As [`Lattice::bond_between`], with the energy of each edge times a factor; edges are those of
    /// [`Graph::edges_between`].
    ///
    /// # Errors
    /// As [`Lattice::bond_between`], and [`LatticeError::Factors`].
    pub fn bond_each(
        self,
        offset: impl AsRef<[isize]>,
        sites: [usize; 2],
        matrix: Matrix3<f64>,
        factors: Vec<f64>,
    ) -> Result<Self, LatticeError> {
        let edges = self.graph.edges(Offset { by: offset.as_ref(), sites })?;
        self.with_bond(edges, matrix, Some(factors))
    }

    /// Adds a·M b for all edges between nearest neighbours, or for those the graph was made of.
    ///
    /// # Errors
    /// As [`Lattice::bond_between`].
    pub fn nearest(mut self, matrix: Matrix3<f64>) -> Result<Self, LatticeError> {
        for edges in self.graph.nearest()? {
            self = self.with_bond(edges, matrix, None)?;
        }
        Ok(self)
    }

    /// Adds a·M b for these edges (a, b).
    ///
    /// # Errors
    /// As [`Lattice::bond_between`].
    pub fn edges(self, edges: &[[usize; 2]], matrix: Matrix3<f64>) -> Result<Self, LatticeError> {
        let edges = self.graph.listed(edges)?;
        self.with_bond(edges, matrix, None)
    }

    /// As [`Lattice::edges`], with the energy of each edge times a factor.
    ///
    /// # Errors
    /// As [`Lattice::bond_each`].
    pub fn edges_each(
        self,
        edges: &[[usize; 2]],
        matrix: Matrix3<f64>,
        factors: Vec<f64>,
    ) -> Result<Self, LatticeError> {
        let edges = self.graph.listed(edges)?;
        self.with_bond(edges, matrix, Some(factors))
    }

    fn with_bond(
        mut self,
        edges: Vec<Edge>,
        matrix: Matrix3<f64>,
        factors: Option<Vec<f64>>,
    ) -> Result<Self, LatticeError> {
        if edges.is_empty() {
            return Err(LatticeError::NoEdges);
        }
        if let Some(factors) = &factors {
            check_factors(factors, edges.len())?;
        }
        let others = self.energies.bonds.iter().map(|bond| bond.edges.len());
        if others.sum::<usize>() + edges.len() > MOST {
            return Err(LatticeError::TooLarge { most: MOST });
        }
        finite(matrix.as_slice())?;
        // Matrices that are symmetric but for rounding are symmetric.
        let symmetric = (matrix + matrix.transpose()) * 0.5;
        let rounding = (matrix - symmetric).amax() <= 4.0 * f64::EPSILON * matrix.amax();
        let matrix = if rounding { symmetric } else { matrix };
        self.energies.bonds.push(Bond { edges, matrix, factors });
        Ok(self)
    }

    /// Adds f·s + s·A s for every site.
    ///
    /// # Errors
    /// [`LatticeError::Coefficient`].
    pub fn site(
        mut self,
        field: Vector3<f64>,
        anisotropy: Matrix3<f64>,
    ) -> Result<Self, LatticeError> {
        finite(field.as_slice())?;
        finite(anisotropy.as_slice())?;
        self.energies.field += field;
        self.energies.anisotropy += (anisotropy + anisotropy.transpose()) * 0.5;
        Ok(self)
    }

    /// Adds factor·(f·s + s·A s), with a factor for each site.
    ///
    /// # Errors
    /// [`LatticeError::Coefficient`], [`LatticeError::Factors`].
    pub fn site_each(
        mut self,
        factors: &[f64],
        field: Vector3<f64>,
        anisotropy: Matrix3<f64>,
    ) -> Result<Self, LatticeError> {
        finite(field.as_slice())?;
        finite(anisotropy.as_slice())?;
        check_factors(factors, self.graph.sites())?;
        self.energies.add_own(factors, field, (anisotropy + anisotropy.transpose()) * 0.5);
        Ok(self)
    }

    /// Adds F(t)·s for every site: `advance_from` of a step is given the time. [`Lattice::energy`] and [`Lattice::gradient`]
    /// are those without it.
    #[must_use]
    pub fn driven(mut self, field: impl Fn(f64) -> [f64; 3] + Send + Sync + 'static) -> Self {
        self.energies.driven = Some(UserFunction(Arc::new(field)));
        self
    }

    /// Damps every site: beside ω = ∂H/∂s it has the velocity Γ (s × ω), with this diagonal of Γ. For unit spins and equal
    /// numbers that is the damping of Gilbert, Landau and Lifshitz. The energy falls, lengths are kept; [`Lattice::gauss`] alone
    /// makes such steps.
    ///
    /// # Errors
    /// [`LatticeError::Coefficient`].
    pub fn damped(mut self, damping: [f64; 3]) -> Result<Self, LatticeError> {
        finite(&damping)?;
        self.energies.damping = damping;
        Ok(self)
    }

    /// Adds a velocity η to ω = ∂H/∂s, ds/dt = s × (ω + η): a function of the time, the number of a site, its spin and its ω.
    /// Lengths are kept; [`Lattice::gauss`] alone makes such steps.
    #[must_use]
    pub fn moved(
        mut self,
        velocity: impl Fn(f64, usize, [f64; 3], [f64; 3]) -> [f64; 3] + Send + Sync + 'static,
    ) -> Self {
        self.energies.velocity = Some(UserFunction(Arc::new(velocity)));
        self
    }

    /// The graph.
    #[must_use]
    pub fn graph(&self) -> &Graph {
        &self.graph
    }

    /// Steps of size `step`, which may be negative, composed of exact rotations.
    ///
    /// # Errors
    /// [`LatticeError::NotAdmitted`]; [`LatticeError::Stopped`] for a step that is zero or not finite.
    pub fn rotations(
        &self,
        family: Family,
        order: Order,
        step: f64,
    ) -> Result<RotationStep, LatticeError> {
        RotationStep::new(self.graph.sites(), &self.energies, family, order, step)
    }

    /// Steps of size `step`, which may be negative, by Gauss's method with `M` nodes (1 to 8) on quaternions: order 2M.
    ///
    /// # Errors
    /// [`LatticeError::Stopped`] for a step that is zero or not finite.
    pub fn gauss<const M: usize>(&self, step: f64) -> Result<GaussStep<M>, LatticeError> {
        self.gauss_with(step, None)
    }

    /// As [`Lattice::gauss`], of this energy and a further one: `gradient` is given all spins and writes its ∂H/∂s.
    ///
    /// # Errors
    /// As [`Lattice::gauss`].
    pub fn gauss_of<const M: usize, F: Fn(&[[f64; 3]], &mut [[f64; 3]])>(
        &self,
        step: f64,
        gradient: F,
    ) -> Result<GaussStep<M, F>, LatticeError> {
        self.gauss_with(step, Some(gradient))
    }

    /// As [`Lattice::gauss_of`], or, without a gradient, as [`Lattice::gauss`].
    ///
    /// # Errors
    /// As [`Lattice::gauss`].
    pub fn gauss_with<const M: usize, F: Fn(&[[f64; 3]], &mut [[f64; 3]])>(
        &self,
        step: f64,
        gradient: Option<F>,
    ) -> Result<GaussStep<M, F>, LatticeError> {
        GaussStep::new(self.graph.sites(), &self.energies, step, gradient)
    }

    /// The energy of a state.
    ///
    /// # Errors
    /// [`LatticeError::Sites`], [`LatticeError::NonFinite`].
    pub fn energy(&self, spins: &[[f64; 3]]) -> Result<f64, LatticeError> {
        check_spins(self.graph.sites(), spins)?;
        let Energies { bonds, field, anisotropy, own, .. } = &self.energies;
        let spin = |site: u32| Vector3::from(spins[site as usize]);
        let bonds = bonds.iter().map(|Bond { edges, matrix, factors }| {
            let of = |at: usize| {
                let [a, b] = edges[at].map(spin);
                let factor = factors.as_ref().map_or(1.0, |factors| factors[at]);
                [a.dot(&(matrix * b)) * factor]
            };
            sums::tree(0..edges.len(), &of)[0]
        });
        let of = |site: usize| {
            let spin = Vector3::from(spins[site]);
            let own = own.iter().map(|own| own.of(site, spins[site])[0]);
            [spin.dot(&(field + anisotropy * spin)) + own.sum::<f64>()]
        };
        Ok(bonds.sum::<f64>() + sums::tree(0..spins.len(), &of)[0])
    }

    /// ∂H/∂s of all sites.
    ///
    /// # Errors
    /// As [`Lattice::energy`].
    pub fn gradient(&self, spins: &[[f64; 3]]) -> Result<Vec<[f64; 3]>, LatticeError> {
        check_spins(self.graph.sites(), spins)?;
        let Energies { bonds, field, anisotropy, own, .. } = &self.energies;
        let spin = |site: u32| Vector3::from(spins[site as usize]);
        let single = |(site, s): (usize, &[f64; 3])| {
            let own = own.iter().map(|own| Vector3::from(own.direction) * own.of(site, *s)[1]);
            field + 2.0 * anisotropy * Vector3::from(*s) + own.sum::<Vector3<f64>>()
        };
        let mut gradient: Vec<Vector3<f64>> = spins.iter().enumerate().map(single).collect();
        for Bond { edges, matrix, factors } in bonds {
            for (at, &[a, b]) in edges.iter().enumerate() {
                let factor = factors.as_ref().map_or(1.0, |factors| factors[at]);
                gradient[a as usize] += matrix * spin(b) * factor;
                gradient[b as usize] += matrix.tr_mul(&spin(a)) * factor;
            }
        }
        Ok(gradient.into_iter().map(Into::into).collect())
    }

    /// The sum of all spins.
    ///
    /// # Errors
    /// As [`Lattice::energy`].
    pub fn total_spin(&self, spins: &[[f64; 3]]) -> Result<[f64; 3], LatticeError> {
        check_spins(self.graph.sites(), spins)?;
        Ok(sums::tree(0..spins.len(), &|site: usize| spins[site]))
    }

    /// The shift for [`Family::Axes`] that suits a state: half the mean of s·∂H/∂s over that of |s|².
    ///
    /// # Errors
    /// As [`Lattice::energy`].
    pub fn shift(&self, spins: &[[f64; 3]]) -> Result<f64, LatticeError> {
        let gradient = self.gradient(spins)?;
        let of = |site: usize| {
            let spin = Vector3::from(spins[site]);
            [spin.dot(&Vector3::from(gradient[site])), spin.norm_squared()]
        };
        let [along, squares] = sums::tree(0..spins.len(), &of);
        Ok(if squares > 0.0 { 0.5 * along / squares } else { 0.0 })
    }
}
