//! Groups known by name that have no closed forms here: tables, checked against codegen's exact
//! catalogue by a test that also writes them.

macro_rules! groups {
    ($($module:ident: $group:ident, $algebra:ident;)*) => {
        $(
            #[rustfmt::skip]
            mod $module;
            pub use $module::{$algebra, $group};
        )*
    };
}

groups! {
    aff1: Aff1, Aff1Algebra;
    sl2: SL2, SL2Algebra;
    so4: SO4, SO4Algebra;
    so5: SO5, SO5Algebra;
    su3: SU3, SU3Algebra;
    su4: SU4, SU4Algebra;
    u2: U2, U2Algebra;
    u3: U3, U3Algebra;
}
