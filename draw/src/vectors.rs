//! Vectors at places of a plane: arrows for their components in it, and colours for that out of it.

use crate::panel::{WIDTH, heading};
use crate::svg::Svg;

/// The largest side of the square of a place, in pixels.
const LARGEST: f64 = 36.0;
/// The least length of an arrow along the plane, in pixels.
const LEAST: f64 = 7.0;
/// The distance of the squares from the left.
const LEFT: f64 = 40.0;

/// The colour of a component out of the plane from −1 to 1: blue, white, orange.
fn colour(component: f64) -> String {
    let end = if component < 0.0 { [0.0, 96.0, 168.0] } else { [192.0, 74.0, 0.0] };
    let part = component.abs().min(1.0);
    let [r, g, b] = end.map(|own| (255.0 + (own - 255.0) * part).round() as u8);
    format!("fill=\"#{r:02x}{g:02x}{b:02x}\"")
}

/// A picture of these vectors at their places, the first axis to the right and the second one up, as the text of an SVG file;
/// arrows and colours are of vectors over their lengths.
pub fn plane(title: &str, settings: &[String], vectors: &[([f64; 2], [f64; 3])]) -> String {
    let mut svg = Svg::default();
    let top = heading(&mut svg, title, settings, LEFT) + 14.0;
    let places = || vectors.iter().map(|(place, _)| *place);
    let ends = [0, 1].map(|axis| {
        let ends = (f64::INFINITY, f64::NEG_INFINITY);
        places().fold(ends, |(low, high), place| (low.min(place[axis]), high.max(place[axis])))
    });
    let first = places().next().unwrap_or_default();
    let gaps = places().map(|[x, y]| (x - first[0]).hypot(y - first[1]));
    let gap = gaps.filter(|gap| *gap > 0.0).fold(f64::INFINITY, f64::min);
    let gap = if gap.is_finite() { gap } else { 1.0 };
    let [wide, tall] = ends.map(|(low, high)| (high - low) / gap + 1.0);
    let side = ((WIDTH - 2.0 * LEFT) / wide).min(LARGEST);
    let middle = |[x, y]: [f64; 2]| {
        let across = LEFT + side * ((x - ends[0].0) / gap + 0.5);
        (across, top + side * ((ends[1].1 - y) / gap + 0.5))
    };
    let units = vectors.iter().filter_map(|(place, vector)| {
        let length = vector.iter().map(|own| own * own).sum::<f64>().sqrt();
        (length > 0.0).then(|| (middle(*place), vector.map(|own| own / length)))
    });
    for ((x, y), [_, _, out]) in units.clone() {
        let corners = [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)];
        let corners = corners.map(|(right, down)| (x + right * side, y + down * side));
        svg.polygon(&corners, &colour(out));
    }
    for ((x, y), [right, up, _]) in units {
        let [across, down] = [0.45 * side * right, -0.45 * side * up];
        // Squares that are too small have colours alone.
        if 2.0 * across.hypot(down) >= LEAST.min(0.3 * side) && side >= LEAST {
            let tail = [(-1.0, 0.35), (-1.0, -0.35)];
            let tail = tail.map(|(along, aside)| {
                (x + along * across - aside * down, y + along * down + aside * across)
            });
            svg.polygon(&[(x + across, y + down), tail[0], tail[1]], "fill=\"#222222\"");
        }
    }
    let description = "Each square is a site: its arrow has the first two components of the vector, its colour the third.";
    svg.finish((WIDTH, top + side * tall + 16.0), title, description)
}
