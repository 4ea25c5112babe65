//! Says in one sentence what the crate cannot be built without.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let has = |feature: &str| std::env::var_os(feature).is_some();
    if !has("CARGO_FEATURE_STD") && !has("CARGO_FEATURE_LIBM") {
        println!(
            "cargo::error=coadjoint needs its feature `std` (on by default) or, where there is no \
             standard library, `libm`: coadjoint = {{ version = \"{}\", default-features = false, \
             features = [\"libm\"] }}",
            env!("CARGO_PKG_VERSION")
        );
    }
}
