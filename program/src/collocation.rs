//! The numbers of a step by collocation, for kernels and for the runtime's generic step: Gauss's nodes about its middle
//! (E. Hairer, C. Lubich, G. Wanner, *Geometric Numerical Integration*, II.1.3), the series of its chart, and the limits of its
//! solution and acceptance, which come from experiments (`docs/measurements/collocation.md`).

/// Steps whose rates are kept, for the first guess of the next one.
pub const KEPT: usize = 7;

/// The largest rate of a coordinate of x beyond which fewer of these serve: rates vary too much over such steps.
pub const LONG: f64 = 0.5;

/// The most of these that serve long steps.
pub const KEPT_LONG: usize = 5;

/// The largest share of the highest polynomial in the velocity up to which steps with two nodes and more are accepted, by
/// the number of nodes; with one node the largest product of the velocity, the force, and what that changes.
pub const LARGEST_TAIL: [f64; MAX_NODES] = [0.08, 0.25, 0.06, 1e-2, 1e-2, 1e-2, 1e-2, 1e-2];

/// The rate of a coordinate of x that a smaller velocity is compared with in steps of two nodes: where it passes through zero within a
/// step, its acceleration, which is the highest polynomial through these, is as large as it is however short the step.
pub const SLOW: f64 = 0.05;

/// The largest highest polynomial in the force, relative to the momentum: where it is larger, as where momenta grow along
/// the step on a group that is not compact, a velocity that is resolved does not tell that the step is.
pub const LARGEST_FORCE: f64 = 0.25;

/// The largest square of a reach, by the number of nodes, up to which a step is an ordinary one: of the arguments of H's
/// functions from the start to the first node, from node to node and to the end, each in the units in which its function varies. Steps
/// that reach farther are accepted only where parts that do not lead to their end; in the shortest parts the way of the momentum
/// alone is looked at.
pub const LARGEST_REACH: [f64; MAX_NODES] = [0.25, 2.25, 2.25, 2.25, 2.25, 2.25, 2.25, 2.25];

/// Sweeps of an ordinary step in this dimension at most: where the first guess is that far from the solution, H bends much
/// along the step. Beyond [`LARGEST_MODEL`] sweeps converge linearly, and their number says nothing of H.
pub fn ordinary_sweeps(dim: usize) -> f64 {
    if dim > LARGEST_MODEL { f64::from(MAX_SWEEPS) } else { 18.0 }
}

/// The share of its limit from which on the measure of a step with one node is taken with the Hessian at the solution.
pub const NEAR_LIMIT: f64 = 0.5;

/// Sweeps allowed before the solver gives up.
pub const MAX_SWEEPS: u32 = 60;

/// The error that ends a solution, relative to the momentum. Stopping earlier is a force that works in one direction:
/// stopped at 1e-15, the energy of a body with a root drifts by 7e-11 in 10⁶ steps.
pub const SOLVED: f64 = 6e-17;

/// The change below which a sweep that changes no less than the one before is down to rounding.
pub const ROUNDING: f64 = 6e-14;

/// Up to this dimension sweeps are corrected by a linear model, whose Hessian costs as many gradients.
pub const LARGEST_MODEL: usize = 24;

/// The degree of the series of the exponential chart in a step: the orders of the step, and that of the force at its middle, which a step with one
/// node is judged by.
pub const fn degree(nodes: usize) -> usize {
    if nodes == 1 { 1 } else { 2 * nodes - 2 }
}

/// The most nodes of a step.
pub const MAX_NODES: usize = 8;

/// The roots of Legendre's polynomials of degree 1 … 8 that are not negative, ascending, and their weights for an interval
/// of length two.
const GAUSS: [&[(f64, f64)]; MAX_NODES] = [
    &[(0.0, 2.0)],
    &[(0.577_350_269_189_625_764_51, 1.0)],
    &[(0.0, 8.0 / 9.0), (0.774_596_669_241_483_377_04, 5.0 / 9.0)],
    &[
        (0.339_981_043_584_856_264_80, 0.652_145_154_862_546_142_63),
        (0.861_136_311_594_052_575_22, 0.347_854_845_137_453_857_37),
    ],
    &[
        (0.0, 128.0 / 225.0),
        (0.538_469_310_105_683_091_04, 0.478_628_670_499_366_468_04),
        (0.906_179_845_938_663_992_80, 0.236_926_885_056_189_087_51),
    ],
    &[
        (0.238_619_186_083_196_908_63, 0.467_913_934_572_691_047_39),
        (0.661_209_386_466_264_513_66, 0.360_761_573_048_138_607_57),
        (0.932_469_514_203_152_027_81, 0.171_324_492_379_170_345_04),
    ],
    &[
        (0.0, 512.0 / 1225.0),
        (0.405_845_151_377_397_166_91, 0.381_830_050_505_118_944_95),
        (0.741_531_185_599_394_439_86, 0.279_705_391_489_276_667_90),
        (0.949_107_912_342_758_524_53, 0.129_484_966_168_869_693_27),
    ],
    &[
        (0.183_434_642_495_649_804_94, 0.362_683_783_378_361_982_97),
        (0.525_532_409_916_328_985_82, 0.313_706_645_877_887_287_34),
        (0.796_666_477_413_626_739_59, 0.222_381_034_453_374_470_54),
        (0.960_289_856_497_536_231_68, 0.101_228_536_290_376_259_15),
    ],
];

/// The times of nodes, of which there are 1 to [`MAX_NODES`], from the beginning of a step on and in its lengths, and their
/// weights.
pub fn nodes(count: usize) -> impl Iterator<Item = (f64, f64)> {
    let halves = GAUSS[count.clamp(1, MAX_NODES) - 1].iter();
    let both = |&(root, weight): &(f64, f64)| {
        let signs: &[f64] = if root == 0.0 { &[1.0] } else { &[-1.0, 1.0] };
        signs.iter().map(move |sign| (0.5 + 0.5 * sign * root, 0.5 * weight))
    };
    halves.flat_map(both)
}

/// The coefficients of `M` nodes, for a step of length one.
#[derive(Clone, Debug)]
pub struct Nodes<const M: usize> {
    /// cᵢ − ½, the times of the nodes from the middle.
    pub times: [f64; M],
    /// bᵢ, the weights of the whole step.
    pub weights: [f64; M],
    /// aᵢⱼ − bⱼ/2, the weights from the middle to the nodes i; by j, then by i.
    pub matrix: [[f64; M]; M],
    /// (2M − 1) bᵢ P_{M−1}(2cᵢ − 1): the coefficient of the highest polynomial through values at the nodes.
    pub highest: [f64; M],
}

/// P₀ … P_M at x.
const fn legendre(degree: usize, x: f64) -> [f64; MAX_NODES + 1] {
    let mut p = [0.0; MAX_NODES + 1];
    (p[0], p[1]) = (1.0, x);
    let mut k = 1;
    while k < degree {
        let n = k as f64;
        p[k + 1] = ((2.0 * n + 1.0) * x * p[k] - n * p[k - 1]) / (n + 1.0);
        k += 1;
    }
    p
}

impl<const M: usize> Nodes<M> {
    /// The coefficients.
    #[allow(clippy::new_without_default)]
    pub const fn new() -> Self {
        assert!(M >= 1 && M <= MAX_NODES, "a step has 1 to 8 nodes");
        let [mut times, mut weights, mut highest] = [[0.0; M]; 3];
        let mut values = [[0.0; MAX_NODES + 1]; M];
        let mut i = 0;
        while i < M {
            let (ahead, at) = (i >= M / 2, if i >= M / 2 { i } else { M - 1 - i } - M / 2);
            let (root, weight) = GAUSS[M - 1][at];
            let root = if ahead { root } else { -root };
            let p = legendre(M, root);
            times[i] = 0.5 * root;
            weights[i] = 0.5 * weight;
            highest[i] = (2 * M - 1) as f64 * weights[i] * p[M - 1];
            values[i] = p;
            i += 1;
        }
        // Each cardinal function in Legendre's polynomials, whose integrals are P_{k+1} − P_{k−1}.
        let mut matrix = [[0.0; M]; M];
        i = 0;
        while i < M {
            let mut j = 0;
            while j < M {
                let mut sum = 2.0 * times[i];
                let mut k = 1;
                while k < M {
                    sum += values[j][k] * (values[i][k + 1] - values[i][k - 1]);
                    k += 1;
                }
                matrix[j][i] = 0.5 * weights[j] * sum;
                j += 1;
            }
            i += 1;
        }
        Self { times, weights, matrix, highest }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Nodes and weights integrate all powers up to 2M − 1 over the step, and up to M − 1 to each node, as Gauss's do
    /// and no others.
    fn integrate<const M: usize>() {
        let nodes = Nodes::<M>::new();
        let power = |x: f64, k: usize| (0..k).fold(1.0, |p, _| p * x);
        let integral = |x: f64, k: usize| power(x, k + 1) / (k + 1) as f64;
        for k in 0..2 * M {
            let sum: f64 = (0..M).map(|i| nodes.weights[i] * power(nodes.times[i], k)).sum();
            let exact = integral(0.5, k) - integral(-0.5, k);
            assert!((sum - exact).abs() < 1.2e-16, "{M} nodes, power {k}: {:e}", sum - exact);
        }
        for i in 0..M {
            for k in 0..M {
                let sum: f64 = (0..M).map(|j| nodes.matrix[j][i] * power(nodes.times[j], k)).sum();
                let half = 0.5 * (integral(0.5, k) + integral(-0.5, k));
                let exact = integral(nodes.times[i], k) - half;
                assert!((sum - exact).abs() < 1e-16, "{M} nodes, node {i}, power {k}");
            }
            for j in 0..M {
                let skew =
                    nodes.weights[i] * nodes.matrix[j][i] + nodes.weights[j] * nodes.matrix[i][j];
                assert!(skew.abs() < 4e-17, "{M} nodes: {skew:e}");
                assert_eq!(nodes.matrix[j][i], -nodes.matrix[M - 1 - j][M - 1 - i]);
            }
        }
    }

    #[test]
    fn nodes_are_those_of_gauss() {
        integrate::<1>();
        integrate::<2>();
        integrate::<3>();
        integrate::<4>();
        integrate::<5>();
        integrate::<6>();
        integrate::<7>();
        integrate::<8>();
    }
}
