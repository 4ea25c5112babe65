//! The laws of a Lie group, on every group and both kinds of tables.
#![cfg(feature = "alloc")]
#![allow(clippy::unwrap_used)]

mod common;

use coadjoint::groups::{
    Aff1, CayleyAlgebra, ElementError, Heisenberg, MatrixGroup, Power, Product, SE2, SL2, SO4, SO5,
    SU2, SU3, SU4, StaticAlgebra, StaticMatrixGroup, TableError, U2, U3,
};
use coadjoint::{LieGroup, SE3, SO3};
use common::{cayley_laws, distance, element_distance, group_laws, small};
use nalgebra::{DMatrix, DVector, Vector3, Vector6};

/// The basis of so(n) in the order of `bases.json`: E_{ji} − E_{ij}, i < j.
fn so(n: usize) -> Vec<DMatrix<f64>> {
    let mut basis = Vec::new();
    for i in 0..n {
        for j in i + 1..n {
            let mut e = DMatrix::zeros(n, n);
            e[(i, j)] = -1.0;
            e[(j, i)] = 1.0;
            basis.push(e);
        }
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

fn sl2_basis() -> Vec<DMatrix<f64>> {
    [[1.0, 0.0, 0.0, -1.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]]
        .map(|rows| DMatrix::from_row_slice(2, 2, &rows))
        .to_vec()
}

/// The basis of SU3 in `bases.json`: a complex matrix a + ib as [[a, −b], [b, a]].
fn su3_basis() -> Vec<DMatrix<f64>> {
    let real = |i: usize, j: usize| {
        let mut e = DMatrix::zeros(6, 6);
        for block in [0, 3] {
            e[(block + i, block + j)] = 1.0;
            e[(block + j, block + i)] = -1.0;
        }
        e
    };
    let imaginary = |entries: &[(usize, usize, f64)]| {
        let mut e = DMatrix::zeros(6, 6);
        for &(i, j, value) in entries {
            e[(i, j + 3)] = -value;
            e[(i + 3, j)] = value;
        }
        e
    };
    let mut basis = Vec::new();
    for (i, j) in [(0, 1), (0, 2), (1, 2)] {
        basis.push(real(i, j));
        basis.push(imaginary(&[(i, j, 1.0), (j, i, 1.0)]));
    }
    basis.push(imaginary(&[(0, 0, 1.0), (1, 1, -1.0)]));
    basis.push(imaginary(&[(1, 1, 1.0), (2, 2, -1.0)]));
    basis
}

/// so(3) as static tables.
struct Rotations;
impl StaticAlgebra for Rotations {
    const DIM: usize = 3;
    const MATRIX_SIZE: usize = 3;
    const STRUCTURE: &'static [(usize, usize, usize, f64)] = &[
        (0, 1, 2, 1.0),
        (1, 0, 2, -1.0),
        (1, 2, 0, 1.0),
        (2, 1, 0, -1.0),
        (2, 0, 1, 1.0),
        (0, 2, 1, -1.0),
    ];
    const BASIS: Option<&'static [(usize, usize, usize, f64)]> = Some(&[
        (0, 2, 1, 1.0),
        (0, 1, 2, -1.0),
        (1, 0, 2, 1.0),
        (1, 2, 0, -1.0),
        (2, 1, 0, 1.0),
        (2, 0, 1, -1.0),
    ]);
    const CASIMIRS: &'static [&'static [(f64, &'static [(usize, u32)])]] =
        &[&[(1.0, &[(0, 2)]), (1.0, &[(1, 2)]), (1.0, &[(2, 2)])]];
}
impl CayleyAlgebra for Rotations {}

/// so(3) by its brackets alone.
struct Brackets;
impl StaticAlgebra for Brackets {
    const DIM: usize = 3;
    const MATRIX_SIZE: usize = 3;
    const STRUCTURE: &'static [(usize, usize, usize, f64)] = Rotations::STRUCTURE;
    const BASIS: Option<&'static [(usize, usize, usize, f64)]> = None;
    const CASIMIRS: &'static [&'static [(f64, &'static [(usize, u32)])]] = Rotations::CASIMIRS;
}

#[test]
fn closed_forms() {
    group_laws(&SO3::<f64>::new(), 1.0, true);
    group_laws(&SE3::<f64>::new(), 0.5, true);
    group_laws(&SE3::<f64>::new(), 1.2, true);
    cayley_laws(&SO3::<f64>::new(), 1.0);
    cayley_laws(&SE3::<f64>::new(), 1.0);
}

#[test]
fn small_groups_in_closed_form() {
    group_laws(&SU2::<f64>::new(), 1.0, true);
    group_laws(&SU2::<f64>::new(), 2.5, true);
    group_laws(&SE2::<f64>::new(), 1.0, true);
    group_laws(&SE2::<f64>::new(), 2.9, true);
    group_laws(&Heisenberg::<f64>::new(), 1.0, true);
    cayley_laws(&SU2::<f64>::new(), 1.0);
    cayley_laws(&SE2::<f64>::new(), 1.0);
    cayley_laws(&Heisenberg::<f64>::new(), 1.0);
}

#[test]
fn groups_by_name() {
    group_laws(&SO4::<f64>::new(), 0.7, true);
    cayley_laws(&SO4::<f64>::new(), 0.7);
    group_laws(&SO5::<f64>::new(), 0.5, true);
    group_laws(&SU3::<f64>::new(), 0.6, true);
    group_laws(&U2::<f64>::new(), 0.8, true);
    cayley_laws(&U2::<f64>::new(), 0.8);
    group_laws(&U3::<f64>::new(), 0.6, true);
    group_laws(&SL2::<f64>::new(), 0.7, true);
    cayley_laws(&SL2::<f64>::new(), 0.5);
    group_laws(&Aff1::<f64>::new(), 1.0, true);
    cayley_laws(&Aff1::<f64>::new(), 0.7);
    // SU(4) has 15 dimensions: its laws are those of its tables, tried lightly.
    let x = nalgebra::SVector::<f64, 15>::from_fn(|i, _| 0.1 * (i as f64 - 7.0));
    let su4 = SU4::<f64>::new();
    let g = su4.exp(&x);
    let identity = su4.compose(&g, &su4.exp(&-x));
    small("SU(4)", element_distance(&su4, &identity, &su4.identity()), 1e-14);
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
    let (p, slope) = lanes.dexp_transpose_with_derivative(&xs, &mus);
    let log = lanes.log(&lanes.exp(&(xs * F64x4::of(0.3)))).unwrap();
    for (lane, x) in x.iter().enumerate() {
        let (h, expected) = SU3::<f64>::new().exp_transport(x, &mu);
        let (q, t) = SU3::<f64>::new().dexp_transpose_with_derivative(x, &mu);
        for i in 0..8 {
            small("lane's momentum", (moved[i].extract(lane) - expected[i]).abs(), 1e-14);
            small("lane's dexp", (p[i].extract(lane) - q[i]).abs(), 1e-14);
            small("lane's slope", (slope[(i, 0)].extract(lane) - t[(i, 0)]).abs(), 1e-13);
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
    cayley_laws(&Product::<SO3, SE2, 6>::default(), 0.7);
    group_laws(&Power::<SU2, 3, 9>::default(), 1.0, true);
    cayley_laws(&Power::<SU2, 3, 9>::default(), 0.7);
    group_laws(&Product::<Power<SO3, 2, 6>, Heisenberg, 9>::default(), 0.7, true);
}

#[test]
fn static_tables() {
    group_laws(&StaticMatrixGroup::<Rotations, 3, 3>::new(), 1.0, true);
    cayley_laws(&StaticMatrixGroup::<Rotations, 3, 3>::new(), 1.0);
    group_laws(&StaticMatrixGroup::<Brackets, 3, 3>::new(), 1.0, true);
}

#[test]
fn dynamic_tables() {
    for basis in [so(3), so(4), se3_basis(), sl2_basis()] {
        let group = MatrixGroup::from_basis(&basis).unwrap();
        group_laws(&group, 0.7, true);
        group_laws(&group, 1.5, false);
    }
    for n in [3, 4, 5] {
        cayley_laws(&MatrixGroup::from_basis(&so(n)).unwrap().into_cayley().unwrap(), 0.7);
    }
    cayley_laws(&MatrixGroup::from_basis(&se3_basis()).unwrap().into_cayley().unwrap(), 1.0);
    // sl(2) = sp(2) has the Cayley map, su(3) has not.
    cayley_laws(&MatrixGroup::from_basis(&sl2_basis()).unwrap().into_cayley().unwrap(), 0.5);
    let su3 = MatrixGroup::from_basis(&su3_basis()).unwrap();
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
fn closed_forms_agree_with_tables_from_zero_to_beyond_a_turn() {
    let so3 = SO3::<f64>::new();
    let se3 = SE3::<f64>::new();
    let table3 = MatrixGroup::from_basis(&so(3)).unwrap();
    let rotations = StaticMatrixGroup::<Rotations, 3, 3>::new();
    let table6 = MatrixGroup::from_basis(&se3_basis()).unwrap();
    // bases.json orders so(3) by axis, so(n) by plane: both agree up to order and sign for n = 3;
    // the static table is the one by axis.
    assert_eq!(table3.dim(), 3);
    let axis = Vector3::new(0.6, -0.48, 0.64);
    let mu = Vector3::new(1.0, 2.0, -0.5);
    let v = Vector3::new(0.3, -1.1, 0.7);
    let force = Vector3::new(-0.2, 0.9, 1.4);
    for angle in
        [0.0, 1e-9, 1e-4, 0.1, 1.0, 1.4999, 1.5001, 2.0, 3.0, 3.2, 4.5, 6.0, 6.25, 7.0, 40.0, 80.0]
    {
        let x = axis * angle;
        small("exp", element_gap3(&so3.exp(&x), &rotations.exp(&x)), 4e-14);
        let bound = 2e-14 * (1.0 + angle * angle);
        let (a, b) = (so3.dexp_transpose(&x, &mu), rotations.dexp_transpose(&x, &mu));
        small("dexp", distance::<SO3>(&a, &b), bound);
        let (_, a) = so3.dexp_transpose_with_derivative(&x, &mu);
        let (_, b) = rotations.dexp_transpose_with_derivative(&x, &mu);
        small("slope", (a - b).amax(), bound);

        let x = Vector6::new(x.x, x.y, x.z, v.x, v.y, v.z);
        let nu = Vector6::new(mu.x, mu.y, mu.z, force.x, force.y, force.z);
        let (xd, nud) = (dynamic(&x), dynamic(&nu));
        let (g, moved) = se3.exp_transport(&x, &nu);
        let (gd, movedd) = table6.exp_transport(&xd, &nud);
        let gd = se3.element_from_matrix(|i, j| gd[(i, j)]).unwrap();
        small("exp on SE(3)", element_distance(&se3, &g, &gd), bound);
        small("transport on SE(3)", distance::<MatrixGroup>(&dynamic(&moved), &movedd), bound);
        let (a, da) = se3.dexp_transpose_with_derivative(&x, &nu);
        let (b, db) = table6.dexp_transpose_with_derivative(&xd, &nud);
        small("dexp on SE(3)", distance::<MatrixGroup>(&dynamic(&a), &b), bound);
        let gap = (0..36).map(|k| (da[(k / 6, k % 6)] - db[(k / 6, k % 6)]).abs());
        small("slope on SE(3)", gap.fold(0.0, f64::max), bound);
        if angle < 6.2 {
            let a = dynamic(&se3.dexp_inverse_transpose(&x, &nu));
            let b = table6.dexp_inverse_transpose(&xd, &nud);
            // Conditioning: the function has a double pole at 2π.
            let bound = bound * (1.0 + 40.0 / (std::f64::consts::TAU - angle).powi(2));
            small("dexp⁻¹ on SE(3)", distance::<MatrixGroup>(&a, &b), bound);
        }
    }
}

fn element_gap3(a: &nalgebra::UnitQuaternion<f64>, b: &nalgebra::Matrix3<f64>) -> f64 {
    (a.to_rotation_matrix().matrix() - b).amax()
}

fn dynamic(v: &Vector6<f64>) -> DVector<f64> {
    DVector::from_column_slice(v.as_slice())
}

#[test]
fn mistakes_in_tables_are_named() {
    let [h, x, y] = [0, 1, 2].map(|i| sl2_basis()[i].clone());
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
        MatrixGroup::from_basis(&so(3)).unwrap().with_casimirs(wrong).err(),
        Some(TableError::NotInvariant { index: 0 })
    );
}

#[test]
fn matrices_outside_a_group_are_refused() {
    let reflection = |i: usize, j: usize| {
        if i != j {
            0.0
        } else if i == 0 {
            -1.0
        } else {
            1.0
        }
    };
    let stretch = |i: usize, j: usize| {
        if i != j {
            0.0
        } else if i == 0 {
            2.0
        } else {
            1.0
        }
    };
    assert!(matches!(
        SO3::<f64>::new().element_from_matrix(reflection),
        Err(ElementError::Determinant { .. })
    ));
    assert!(matches!(
        SO3::<f64>::new().element_from_matrix(stretch),
        Err(ElementError::NotOrthogonal { .. })
    ));
    let so4 = MatrixGroup::from_basis(&so(4)).unwrap();
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
