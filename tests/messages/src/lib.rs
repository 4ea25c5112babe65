//! The compiler's messages for mistakes under the attributes: `tests/ui` has a program and the expected messages for
//! each.
