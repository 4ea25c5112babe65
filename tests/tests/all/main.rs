//! Tests that need several of the crates, each in a module of its own: one program, which is linked once and shares what
//! it instantiates.
#![allow(missing_docs)]

mod allocation;
mod attribute;
mod catalogue;
mod circles;
mod collocation;
mod comoving;
mod defects;
mod devices;
mod documents;
mod emitted_steps;
mod fields;
mod geometry;
mod golden_files;
mod hygiene;
mod implementations;
mod judged_collocation;
mod kernel_page;
mod kernels;
mod kicked;
mod lanes;
mod laws;
mod layers;
mod learned_step;
mod operations;
mod parts;
mod potential;
mod predictor;
mod runtime_groups;
mod smooth;
mod stress;
mod system_files;
mod systems_integrals;
mod systems_library;
mod systems_literature;
mod systems_reference;
mod toutatis;
