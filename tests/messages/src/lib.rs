//! What the compiler says about mistakes under the attributes: `tests/ui` has a program and the expected messages for
//! each.
