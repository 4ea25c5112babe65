//! Plots as SVG: labelled axes with units, curves that differ in grey print too, in light and dark schemes.
//!
//! Data are plain numbers, so that this crate knows neither groups nor integrators. [`Panel`] is a
//! pair of axes with its curves, alone or in a picture of several; [`run`] draws the plots of
//! `coadjoint simulate --plot`.
//!
//! ```
//! use coadjoint_draw::{Axis, Curve, Panel, Style};
//!
//! let points = vec![(0.1, 1e-3), (0.2, 8e-3), (0.4, 6.4e-2)];
//! let panel = Panel {
//!     heading: "error".to_owned(),
//!     across: "step size (s)".to_owned(),
//!     x: Axis::logarithmic(0.1, 0.4, 4),
//!     y: Axis::logarithmic(1e-3, 0.1, 4),
//!     curves: vec![Curve::line("order 3", Style::new(0), points)],
//!     ..Panel::default()
//! };
//! assert!(panel.with_legend().alone(440.0, 220.0).contains("order 3"));
//! ```
//!
//! # Limits
//!
//! Widths of texts are estimated, rather too wide than too narrow; no font is read.

mod axis;
pub mod curves;
mod panel;
pub mod run;
mod style;
mod svg;
pub mod vectors;

pub use axis::Axis;
pub use curves::unbeaten;
pub use panel::{Curve, Panel, Swatch, sheet};
pub use style::{STYLE_SHEET, Style};
pub use svg::escaped;
