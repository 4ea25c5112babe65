//! Groups of any type behind one type, so that the laws are compiled once and not for each group.

use std::any::Any;
use std::fmt::{self, Debug};
use std::rc::Rc;

use coadjoint::LieGroup;
use coadjoint::groups::{CayleyGroup, Coordinates, ElementError};
use nalgebra::DVector;

type Vector = DVector<f64>;

/// An element of whatever group.
#[derive(Clone)]
pub struct Element(Rc<dyn Any>);

impl Debug for Element {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Element")
    }
}

/// A group with both charts whose type is forgotten.
#[derive(Clone, Debug)]
pub struct AnyGroup(Rc<dyn Erased>);

impl AnyGroup {
    /// Forgets the type of `group`.
    #[must_use]
    pub fn new<G>(group: G) -> Self
    where
        G: CayleyGroup<Scalar = f64> + 'static,
        G::Element: 'static,
    {
        Self(Rc::new(group))
    }
}

fn known<G: LieGroup<Scalar = f64>>(x: &Vector) -> G::Vector {
    G::Vector::from_entries(x.len(), |i| x[i])
}

fn forgotten<V: Coordinates<f64>>(x: &V) -> Vector {
    DVector::from_fn(x.dim(), |i, _| x[i])
}

fn wrapped<E: 'static>(g: E) -> Element {
    Element(Rc::new(g))
}

fn unwrapped<E: 'static>(g: &Element) -> &E {
    g.0.downcast_ref().expect("an element of this group")
}

/// Declares the methods of [`Erased`] once, implements them by those of a group, and implements the traits of groups for
/// [`AnyGroup`] by them.
macro_rules! erased {
    ($($group:ident {
        $($name:ident($($x:ident: $kind:ident),*) -> $result:ident;)*
    } with { $($own:tt)* })*) => {
        trait Erased: Debug {
            $($(fn $name(&self, $($x: erased!(@type $kind)),*) -> erased!(@result $result);)*)*
            fn with_entries(&self, entry: &dyn Fn(usize, usize) -> f64) -> Result<Element, ElementError>;
        }

        impl<G: CayleyGroup<Scalar = f64>> Erased for G
        where
            G::Element: 'static,
        {
            $($(fn $name(&self, $($x: erased!(@type $kind)),*) -> erased!(@result $result) {
                erased!(@out $result G::$name(self, $(erased!(@in $kind $x)),*))
            })*)*

            fn with_entries(&self, entry: &dyn Fn(usize, usize) -> f64) -> Result<Element, ElementError> {
                self.element_from_matrix(entry).map(wrapped)
            }
        }

        $(impl $group for AnyGroup {
            $($own)*

            $(fn $name(&self, $($x: erased!(@type $kind)),*) -> erased!(@result $result) {
                self.0.$name($($x),*)
            })*
        })*
    };
    (@type vector) => { &Vector };
    (@type element) => { &Element };
    (@type index) => { usize };
    (@result vector) => { Vector };
    (@result element) => { Element };
    (@result index) => { usize };
    (@result number) => { f64 };
    (@result maybe) => { Option<Vector> };
    (@result moved) => { (Element, Vector) };
    (@in vector $x:ident) => { &known::<G>($x) };
    (@in element $x:ident) => { unwrapped::<G::Element>($x) };
    (@in index $x:ident) => { $x };
    (@out vector $e:expr) => { forgotten(&$e) };
    (@out element $e:expr) => { wrapped($e) };
    (@out index $e:expr) => { $e };
    (@out number $e:expr) => { $e };
    (@out maybe $e:expr) => { $e.map(|x| forgotten(&x)) };
    (@out moved $e:expr) => {{
        let (g, x) = $e;
        (wrapped(g), forgotten(&x))
    }};
}

erased! {
    LieGroup {
        dim() -> index;
        identity() -> element;
        compose(g: element, h: element) -> element;
        inverse(g: element) -> element;
        exp(x: vector) -> element;
        log(g: element) -> maybe;
        ad_star(x: vector, mu: vector) -> vector;
        coadjoint(g: element, mu: vector) -> vector;
        exp_transport(x: vector, mu: vector) -> moved;
        dexp_transpose(x: vector, mu: vector) -> vector;
        exp_extent(x: vector) -> number;
        element_defect(g: element) -> number;
        casimir_count() -> index;
        casimir(i: index, mu: vector) -> number;
        matrix_size() -> index;
        matrix_entry(g: element, i: index, j: index) -> number;
    } with {
        type Scalar = f64;
        type Vector = Vector;
        type Element = Element;

        fn element_from_matrix(
            &self,
            entry: impl Fn(usize, usize) -> f64,
        ) -> Result<Element, ElementError> {
            self.0.with_entries(&entry)
        }
    }
    CayleyGroup {
        cayley(x: vector) -> element;
        cayley_extent(x: vector) -> number;
        cayley_inverse(g: element) -> maybe;
        dcay_transpose(x: vector, mu: vector) -> vector;
    } with {}
}
