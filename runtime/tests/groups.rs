//! The laws of a Lie group, on every group and both kinds of tables.
#![cfg(feature = "alloc")]
#![allow(clippy::unwrap_used)]

mod common;

use coadjoint::groups::{
    Aff1, Cayley, Chart, ElementError, Exponential, Heisenberg, MatrixGroup, Power, Product,
    Rotations, SE2, SE23, SL2, SL2Algebra, SO4, SO5, SU2, SU3, Sp4, SpecialUnitary, StaticAlgebra,
    StaticMatrixGroup, TableError,
};
use coadjoint::{LieGroup, SE3, SO3};
use common::{chart_laws, group_laws, small};
use nalgebra::{DMatrix, DVector};

/// The matrices of a basis that the program knows.
fn basis_of<A: StaticAlgebra>() -> Vec<DMatrix<f64>> {
    let mut basis = vec![DMatrix::zeros(A::MATRIX_SIZE, A::MATRIX_SIZE); A::DIM];
    for &(i, row, column, value) in A::BASIS.unwrap() {
        basis[i][(row, column)] = value;
    }
    basis
}

/// The basis of SE3 in `bases.json`.
fn se3_basis() -> Vec<DMatrix<f64>> {
    let mut basis = vec![DMatrix::zeros(4, 4); 6];
    for i in 0..3 {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        basis[i][(k, j)] = 1.0;
        basis[i][(j, k)] = -1.0;
        basis[i + 3][(i, 3)] = 1.0;
    }
    basis
}

/// so(3) by its brackets alone.
struct Brackets;
impl StaticAlgebra for Brackets {
    const DIM: usize = 3;
    const MATRIX_SIZE: usize = 3;
    const STRUCTURE: &'static [(usize, usize, usize, f64)] = Rotations::<3>::STRUCTURE;
    const BASIS: Option<&'static [(usize, usize, usize, f64)]> = None;
    const CASIMIRS: &'static [&'static [(f64, &'static [(usize, u32)])]] = Rotations::<3>::CASIMIRS;
}

/// se(2), whose translations are a nilpotent ideal: the blocks of ad_x agree.
struct Plane;
impl StaticAlgebra for Plane {
    const DIM: usize = 3;
    const MATRIX_SIZE: usize = 3;
    const STRUCTURE: &'static [(usize, usize, usize, f64)] =
        &[(0, 1, 2, 1.0), (1, 0, 2, -1.0), (0, 2, 1, -1.0), (2, 0, 1, 1.0)];
    const BASIS: Option<&'static [(usize, usize, usize, f64)]> =
        Some(&[(0, 1, 0, 1.0), (0, 0, 1, -1.0), (1, 0, 2, 1.0), (2, 1, 2, 1.0)]);
    const CASIMIRS: &'static [&'static [(f64, &'static [(usize, u32)])]] =
        &[&[(1.0, &[(1, 2)]), (1.0, &[(2, 2)])]];
}

#[test]
fn closed_forms() {
    group_laws(&SO3::<f64>::new(), 1.0, true);
    group_laws(&SE3::<f64>::new(), 0.5, true);
    group_laws(&SE3::<f64>::new(), 1.2, true);
    chart_laws(&SO3::<f64>::new(), Cayley, 1.0, true);
    chart_laws(&SE3::<f64>::new(), Cayley, 1.0, true);
}

#[test]
fn small_groups_in_closed_form() {
    group_laws(&SU2::<f64>::new(), 1.0, true);
    group_laws(&SU2::<f64>::new(), 2.5, true);
    group_laws(&SE2::<f64>::new(), 1.0, true);
    group_laws(&SE2::<f64>::new(), 2.9, true);
    group_laws(&Heisenberg::<f64>::new(), 1.0, true);
    chart_laws(&SU2::<f64>::new(), Cayley, 1.0, true);
    chart_laws(&SE2::<f64>::new(), Cayley, 1.0, true);
    chart_laws(&Heisenberg::<f64>::new(), Cayley, 1.0, true);
}

#[test]
fn groups_by_name() {
    group_laws(&SO4::<f64>::new(), 0.7, true);
    chart_laws(&SO4::<f64>::new(), Cayley, 0.7, true);
    group_laws(&SO5::<f64>::new(), 0.5, true);
    group_laws(&SU3::<f64>::new(), 0.6, true);
    group_laws(&SL2::<f64>::new(), 0.7, true);
    chart_laws(&SL2::<f64>::new(), Cayley, 0.5, true);
    group_laws(&SE23::<f64>::new(), 1.0, true);
    chart_laws(&SE23::<f64>::new(), Cayley, 1.0, true);
    group_laws(&Sp4::<f64>::new(), 0.5, true);
    chart_laws(&Sp4::<f64>::new(), Cayley, 0.5, true);
    group_laws(&Aff1::<f64>::new(), 1.0, true);
    chart_laws(&Aff1::<f64>::new(), Cayley, 0.7, true);
}

/// f32 and four lanes of f64 agree with f64, lane by lane, to their own rounding.
#[test]
fn other_scalars() {
    use coadjoint::{Scalar, lanes::F64x4};
    use nalgebra::{SVector, SimdValue};
    let x: [SVector<f64, 8>; 4] = core::array::from_fn(|lane| {
        SVector::from_fn(|i, _| (0.3 + lane as f64) * ((i * 5 % 8) as f64 / 8.0 - 0.4))
    });
    let mu = SVector::<f64, 8>::from_fn(|i, _| 1.0 - i as f64 / 5.0);
    let lanes = SU3::<F64x4>::new();
    let xs = SVector::<F64x4, 8>::from_fn(|i, _| {
        let mut value = F64x4::of(0.0);
        for (lane, x) in x.iter().enumerate() {
            value.replace(lane, x[i]);
        }
        value
    });
    let mus = SVector::<F64x4, 8>::from_fn(|i, _| F64x4::of(mu[i]));
    let (g, moved) = lanes.exp_transport(&xs, &mus);
    let (p, slope) = Exponential.pull_back_with_derivative(&lanes, &xs, &mus);
    let log = lanes.log(&lanes.exp(&(xs * F64x4::of(0.3)))).unwrap();
    for (lane, x) in x.iter().enumerate() {
        let (h, expected) = SU3::<f64>::new().exp_transport(x, &mu);
        let (q, t) = Exponential.pull_back_with_derivative(&SU3::<f64>::new(), x, &mu);
        for i in 0..8 {
            small("lane's momentum", (moved[i].extract(lane) - expected[i]).abs(), 1e-14);
            small("lane's dexp", (p[i].extract(lane) - q[i]).abs(), 1e-14);
            // By differences.
            small("lane's slope", (slope[(i, 0)].extract(lane) - t[(i, 0)]).abs(), 1e-9);
            small("lane's log", (log[i].extract(lane) - 0.3 * x[i]).abs(), 1e-13);
        }
        small("lane's exp", (g[(0, 4)].extract(lane) - h[(0, 4)]).abs(), 1e-14);
    }
    let small_x = x[1].map(|v| v as f32);
    let single = SU3::<f32>::new().exp(&small_x);
    let double = SU3::<f64>::new().exp(&x[1]);
    small("f32", f64::from((single[(1, 2)] - double[(1, 2)] as f32).abs()), 3e-6);
}

#[test]
fn products() {
    group_laws(&Product::<SO3, SE2, 6>::default(), 1.0, true);
    chart_laws(&Product::<SO3, SE2, 6>::default(), Cayley, 0.7, true);
    group_laws(&Power::<SU2, 3, 9>::default(), 1.0, true);
    chart_laws(&Power::<SU2, 3, 9>::default(), Cayley, 0.7, true);
    group_laws(&Product::<Power<SO3, 2, 6>, Heisenberg, 9>::default(), 0.7, true);
}

#[test]
fn static_tables() {
    group_laws(&StaticMatrixGroup::<Rotations<3>, 3, 3>::new(), 1.0, true);
    chart_laws(&StaticMatrixGroup::<Rotations<3>, 3, 3>::new(), Cayley, 1.0, true);
    group_laws(&StaticMatrixGroup::<Brackets, 3, 3>::new(), 1.0, true);
    let plane = StaticMatrixGroup::<Plane, 3, 3>::new();
    group_laws(&plane, 1.0, true);
    let x = nalgebra::Vector3::new(0.3, 40.0, -7.0);
    assert!((plane.exp_extent(&x) - SE2::new().exp_extent(&x)).abs() < 1e-15);
}

#[test]
fn dynamic_tables() {
    let bases = [
        basis_of::<Rotations<3>>(),
        basis_of::<Rotations<4>>(),
        se3_basis(),
        basis_of::<SL2Algebra>(),
    ];
    for basis in bases {
        let group = MatrixGroup::from_basis(&basis).unwrap();
        group_laws(&group, 0.7, true);
        group_laws(&group, 1.5, false);
    }
    // so(n), se(3) and sl(2) = sp(2) have the Cayley map, su(3) has not.
    for (basis, size) in [
        (basis_of::<Rotations<3>>(), 0.7),
        (basis_of::<Rotations<4>>(), 0.7),
        (basis_of::<Rotations<5>>(), 0.7),
        (se3_basis(), 1.0),
        (basis_of::<SL2Algebra>(), 0.5),
    ] {
        let group = MatrixGroup::from_basis(&basis).unwrap().into_cayley().unwrap();
        chart_laws(&group, Cayley, size, true);
    }
    let su3 = MatrixGroup::from_basis(&basis_of::<SpecialUnitary<3>>()).unwrap();
    group_laws(&su3, 0.7, true);
    group_laws(&su3, 2.0, false);
    assert!(matches!(su3.into_cayley(), Err(TableError::NoCayley { .. })));
}

#[test]
fn brackets_alone() {
    // The affine group of the line, [a, b] = b: no centre, so that log exists.
    let affine =
        MatrixGroup::from_structure_constants(2, &[(0, 1, 1, 1.0), (1, 0, 1, -1.0)]).unwrap();
    group_laws(&affine, 1.0, true);
    // Heisenberg, [a, b] = c: the centre is invisible in the adjoint matrices.
    let heisenberg =
        MatrixGroup::from_structure_constants(3, &[(0, 1, 2, 1.0), (1, 0, 2, -1.0)]).unwrap();
    group_laws(&heisenberg, 1.0, false);
    let g = heisenberg.exp(&DVector::from_vec(vec![0.1, 0.2, 0.3]));
    assert_eq!(heisenberg.log(&g), None);
    assert_eq!(heisenberg.into_cayley().err(), Some(TableError::NotFaithful));
}

/// Large matrices are multiplied and inverted without their zeros.
#[test]
fn large_groups_by_brackets_are_their_factors() {
    let sl2 = [(0, 1, 1, 2.0), (0, 2, 2, -2.0), (1, 2, 0, 1.0)];
    let both = |copies: usize| -> Vec<_> {
        let copy = |at: usize| sl2.map(|(i, j, k, c)| (3 * at + i, 3 * at + j, 3 * at + k, c));
        let one = (0..copies).flat_map(copy);
        one.flat_map(|(i, j, k, c)| [(i, j, k, c), (j, i, k, -c)]).collect()
    };
    let small = MatrixGroup::from_structure_constants(3, &both(1)).unwrap();
    let large = MatrixGroup::from_structure_constants(18, &both(6)).unwrap();
    let x = DVector::from_fn(18, |i, _| 0.4 * (1.0 + i as f64).sin());
    let mu = DVector::from_fn(18, |i, _| (2.0 + i as f64).cos());
    let g = large.compose(&large.exp(&x), &large.exp(&x));
    let carried = large.coadjoint(&g, &mu);
    let back = large.compose(&g, &large.inverse(&g));
    assert!((back - DMatrix::identity(18, 18)).amax() < 1e-13);
    for at in (0..18).step_by(3) {
        let (x, mu) = (x.rows(at, 3).into_owned(), mu.rows(at, 3).into_owned());
        let own = small.compose(&small.exp(&x), &small.exp(&x));
        assert!((g.view((at, at), (3, 3)) - &own).amax() < 1e-14);
        assert!((carried.rows(at, 3) - small.coadjoint(&own, &mu)).amax() < 1e-13);
    }
    assert!((large.log(&large.exp(&x)).unwrap() - x).amax() < 1e-13);
}

#[test]
fn mistakes_in_tables_are_named() {
    let [h, x, y] = [0, 1, 2].map(|i| basis_of::<SL2Algebra>()[i].clone());
    assert!(matches!(
        MatrixGroup::from_basis(&[x.clone(), y]),
        Err(TableError::NotClosed { i: 0, j: 1, .. })
    ));
    assert_eq!(
        MatrixGroup::from_basis(&[h.clone(), x.clone(), &h * 2.0 - &x]).err(),
        Some(TableError::Dependent { index: 2 })
    );
    assert!(matches!(
        MatrixGroup::from_structure_constants(2, &[(0, 1, 1, 1.0)]),
        Err(TableError::NotAntisymmetric { i: 0, j: 1 })
    ));
    // [a, b] = a, [a, c] = b, [b, c] = 0: [[a, b], c] + … = b.
    let table = [(0, 1, 0, 1.0), (1, 0, 0, -1.0), (0, 2, 1, 1.0), (2, 0, 1, -1.0)];
    assert!(matches!(
        MatrixGroup::from_structure_constants(3, &table),
        Err(TableError::Jacobi { .. })
    ));
    assert_eq!(MatrixGroup::from_basis(&[]).err(), Some(TableError::Empty));
    let wrong = vec![vec![(1.0, vec![(0, 2)])]];
    assert_eq!(
        MatrixGroup::from_basis(&basis_of::<Rotations<3>>()).unwrap().with_casimirs(wrong).err(),
        Some(TableError::NotInvariant { index: 0 })
    );
}

#[test]
fn matrices_outside_a_group_are_refused() {
    // Diagonal, all ones but for the first entry.
    let diagonal = |first: f64| {
        move |i: usize, j: usize| {
            if i != j {
                0.0
            } else if i == 0 {
                first
            } else {
                1.0
            }
        }
    };
    let (reflection, stretch) = (diagonal(-1.0), diagonal(2.0));
    assert!(matches!(
        SO3::<f64>::new().element_from_matrix(reflection),
        Err(ElementError::Determinant { .. })
    ));
    assert!(matches!(
        SO3::<f64>::new().element_from_matrix(stretch),
        Err(ElementError::NotOrthogonal { .. })
    ));
    let so4 = MatrixGroup::from_basis(&basis_of::<Rotations<4>>()).unwrap();
    assert!(matches!(so4.element_from_matrix(reflection), Err(ElementError::Determinant { .. })));
    let se3 = MatrixGroup::from_basis(&se3_basis()).unwrap();
    assert!(matches!(se3.element_from_matrix(stretch), Err(ElementError::Determinant { .. })));
    let shear = |i: usize, j: usize| f64::from(u8::from(i == j || (i, j) == (0, 1)));
    assert!(matches!(se3.element_from_matrix(shear), Err(ElementError::NotInGroup { .. })));
    assert!(matches!(
        SE3::<f64>::new().element_from_matrix(|i, j| if i == 3 && j == 0 {
            0.5
        } else {
            shear(i, j)
        }),
        Err(ElementError::WrongEntry { row: 3, column: 0, .. })
    ));
}

/// A coordinate far below the others keeps its digits: on the affine group μ₁ moves by the factor e^b along x = (b, 0), and its
/// (d^R exp_x)ᵀ is (e^b − 1)/b, whatever μ₀ is.
#[test]
fn small_coordinates_beside_large_ones_keep_their_digits() {
    let affine =
        MatrixGroup::from_structure_constants(2, &[(0, 1, 1, 1.0), (1, 0, 1, -1.0)]).unwrap();
    for b in [0.3, -0.7, 1.4, -5.0] {
        for small in [1.0, 1e-9, 1e-26] {
            let (x, mu) = (DVector::from_vec(vec![b, 0.0]), DVector::from_vec(vec![1.0, small]));
            let (_, moved) = affine.exp_transport(&x, &mu);
            let pulled = affine.dexp_transpose(&x, &mu);
            let off = |found: f64, factor: f64| (found / (small * factor) - 1.0).abs();
            assert!(off(moved[1], b.exp()) < 4e-15, "{b}, {small}: {}", moved[1]);
            assert!(off(pulled[1], b.exp_m1() / b) < 4e-15, "{b}, {small}: {}", pulled[1]);
            assert_eq!(moved[0], 1.0);
        }
    }
}
