//! The Lie–Poisson vector field of a Hamiltonian.

use super::LieAlgebra;
use crate::poly::Polynomial;

impl LieAlgebra {
    /// ad\*_{∂H/∂μ} μ, component by component: how each coordinate of the momentum moves. Variables
    /// of `hamiltonian` beyond the dimension are constants.
    ///
    /// ```
    /// use coadjoint_symbolic::lie::catalogue::lookup;
    /// use coadjoint_symbolic::number::ratio;
    /// use coadjoint_symbolic::poly::Polynomial;
    ///
    /// // A symmetric body, H = (μ₀² + μ₁²)/2 + μ₂²: its spin μ₂ is an integral.
    /// let square = |i, half| (Polynomial::variable(3, i).pow(2)).scale(&ratio(half, 2));
    /// let h = &(&square(0, 1) + &square(1, 1)) + &square(2, 2);
    /// let field = lookup("SO3").unwrap().hamiltonian_field(&h);
    /// assert!(field[2].is_zero() && !field[0].is_zero());
    /// ```
    #[must_use]
    pub fn hamiltonian_field(&self, hamiltonian: &Polynomial) -> Vec<Polynomial> {
        let dim = self.dim();
        let variables = hamiltonian.variables();
        let omega = hamiltonian.gradient(dim);
        let mut field = vec![Polynomial::zero(variables); dim];
        for constant in self.structure() {
            let momentum = Polynomial::variable(variables, constant.k);
            let product = (&omega[constant.i] * &momentum).scale(&constant.value);
            field[constant.j] = &field[constant.j] + &product;
        }
        field
    }
}
