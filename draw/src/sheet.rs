//! A whole picture: a title, settings, panels one below the other.

use crate::panel::{FONT, LINE, Panel, Place, RIGHT, WIDTH};
use crate::svg::{Anchor, Svg, cut, width};

/// A picture of panels one below the other, each of this height in pixels between the ends of its axes, as the text of an
/// SVG file. `description` is for those who cannot see it.
#[must_use]
pub fn sheet(
    title: &str,
    settings: &[String],
    panels: &[Panel],
    height: f64,
    description: &str,
) -> String {
    let left = panels.iter().map(Panel::left).fold(60.0, f64::max);
    let mut svg = Svg::default();
    let mut y = heading(&mut svg, title, settings, left) + 14.0;
    for panel in panels {
        let place = Place { height, ..Place::below(y, left) };
        y = panel.draw(&mut svg, place);
    }
    svg.finish((WIDTH, y + 8.0), title, description)
}

/// Writes title and settings; returns the last baseline.
pub(crate) fn heading(svg: &mut Svg, title: &str, settings: &[String], left: f64) -> f64 {
    let title = cut(title, 21.0, WIDTH - left - 20.0);
    svg.text((left, 32.0), Anchor::Start, r#"font-size="20" font-weight="bold""#, &title);
    // In one line, or more where they need it.
    let (mut x, mut y) = (left, 36.0 + LINE);
    for text in settings {
        let text = cut(text, FONT, WIDTH - left - RIGHT);
        let wide = width(&text, FONT);
        if x > left && x + wide > WIDTH - 20.0 {
            (x, y) = (left, y + LINE);
        }
        svg.text((x, y), Anchor::Start, "", &text);
        x += wide + 18.0;
    }
    y
}
