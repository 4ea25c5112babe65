//! A panel: two axes, curves, and the texts around them.

use crate::axis::Axis;
use crate::style::{BAND, Style};
use crate::svg::{Svg, cut, width, wrapped};

/// The width of a picture with panels one below the other.
pub(crate) const WIDTH: f64 = 900.0;
/// Free space at the right.
pub(crate) const RIGHT: f64 = 30.0;
/// The height between the axes' ends, in such a picture.
const HEIGHT: f64 = 190.0;
/// The height of a line of text.
const LINE: f64 = 20.0;
/// The size of most texts.
const FONT: f64 = 13.0;
/// The length of a stroke in a legend: the longest pattern of dashes shows twice.
const STROKE: f64 = 44.0;
/// The size of a heading.
const HEADING: f64 = 15.0;

/// The sample beside a name in a legend.
#[derive(Clone, Copy, Debug)]
pub enum Swatch {
    /// A stroke of this style.
    Stroke(Style),
    /// A stroke with a marker.
    Both(Style),
    /// A marker.
    Marker(Style),
    /// A box filled as a band is.
    Band,
}

/// A curve in the units of its panel's axes.
#[derive(Clone, Debug, Default)]
pub struct Curve {
    /// Its name.
    pub name: String,
    /// Its colour, dashes and marker.
    pub style: Style,
    /// Joins its points.
    pub joined: bool,
    /// Marks its points.
    pub marked: bool,
    /// Its points; one that is not finite breaks the line.
    pub points: Vec<(f64, f64)>,
}

impl Curve {
    /// A line.
    pub fn line(name: impl Into<String>, style: Style, points: Vec<(f64, f64)>) -> Self {
        Self { name: name.into(), style, joined: true, marked: false, points }
    }

    /// Its sample in a legend.
    fn sample(&self) -> Swatch {
        match (self.joined, self.marked) {
            (true, false) => Swatch::Stroke(self.style),
            (true, true) => Swatch::Both(self.style),
            (false, _) => Swatch::Marker(self.style),
        }
    }
}

/// A panel, ready to be placed.
#[derive(Clone, Debug, Default)]
pub struct Panel {
    /// The quantity drawn, with its unit: the label of the vertical axis, above it.
    pub heading: String,
    /// Remarks, each on a line of its own.
    pub notes: Vec<String>,
    /// Samples and their names.
    pub legend: Vec<(Swatch, String)>,
    /// The label of the horizontal axis.
    pub across: String,
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// A band behind the curves, as its outline.
    pub band: Vec<(f64, f64)>,
    /// The curves.
    pub curves: Vec<Curve>,
}

/// The place of a panel in the picture.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    /// The upper edge.
    pub(crate) top: f64,
    /// The left edge of texts.
    pub(crate) edge: f64,
    /// The vertical axis.
    pub(crate) left: f64,
    /// The right end of the horizontal axis.
    pub(crate) right: f64,
    /// The height between the axes' ends.
    pub(crate) height: f64,
}

impl Place {
    /// The place in a picture with panels one below the other.
    pub(crate) fn below(top: f64, left: f64) -> Self {
        Self { top, edge: left, left, right: WIDTH - RIGHT, height: HEIGHT }
    }
}

impl Panel {
    /// Adds a legend with one entry for each name of a curve.
    pub fn with_legend(mut self) -> Self {
        for curve in &self.curves {
            if !self.legend.iter().any(|(_, name)| *name == curve.name) {
                self.legend.push((curve.sample(), curve.name.clone()));
            }
        }
        self
    }

    /// The room that the labels of the vertical axis need.
    pub(crate) fn left(&self) -> f64 {
        let widest = self.y.ticks.iter().map(|tick| width(&tick.label, FONT)).fold(0.0, f64::max);
        widest + 22.0
    }

    /// The panel alone, as an element of a page; `height` is that between the axes' ends.
    pub fn alone(&self, width: f64, height: f64) -> String {
        let mut svg = Svg::default();
        let place = Place { top: 0.0, edge: 2.0, left: self.left(), right: width - 16.0, height };
        let bottom = self.draw(&mut svg, place);
        svg.element((width, bottom), &self.heading)
    }

    /// Draws the panel; returns where it ends.
    pub(crate) fn draw(&self, svg: &mut Svg, place: Place) -> f64 {
        let Place { top, edge, left, right, height } = place;
        svg.open(&self.heading);
        let mut y = top + 18.0;
        for (i, line) in wrapped(&self.heading, HEADING, right - edge).iter().enumerate() {
            y += if i > 0 { LINE } else { 0.0 };
            svg.text((edge, y), "start", r#"font-size="15" font-weight="bold""#, line);
        }
        for note in &self.notes {
            y = paragraph(svg, note, (edge, right), y);
        }
        if !self.legend.is_empty() {
            y = legend(svg, &self.legend, (edge, right), y);
        }
        let (above, below) = (y + 14.0, y + 14.0 + height);
        let at = |(x, value): (f64, f64)| {
            let across = left + self.x.share(x) * (right - left);
            (across, below - self.y.share(value) * height)
        };
        self.axes(svg, (left, right), (above, below));
        let outline: Vec<(f64, f64)> = self.band.iter().map(|&point| at(point)).collect();
        svg.polygon(&outline, BAND);
        for curve in &self.curves {
            svg.open(&curve.name);
            let finite = |p: &(f64, f64)| p.0.is_finite() && p.1.is_finite();
            for piece in curve.points.chunk_by(|a, b| finite(a) && finite(b)) {
                let points: Vec<(f64, f64)> =
                    piece.iter().filter(|p| finite(p)).map(|&point| at(point)).collect();
                if curve.joined {
                    svg.polyline(&points, &curve.style.line());
                }
                if curve.marked {
                    let outlines: String = points.iter().map(|&p| curve.style.marker(p)).collect();
                    svg.path(&outlines, &curve.style.fill());
                }
            }
            svg.close();
        }
        svg.close();
        below + 52.0
    }

    fn axes(&self, svg: &mut Svg, (left, right): (f64, f64), (above, below): (f64, f64)) {
        let grid = r##"class="grid" stroke="#dddddd""##;
        for tick in &self.y.ticks {
            let at = below - self.y.share(tick.at) * (below - above);
            svg.line((left, at), (right, at), grid);
            svg.text((left - 8.0, at + 4.5), "end", "", &tick.label);
        }
        // Labels that would touch are left out; their lines stay.
        let mut free = f64::NEG_INFINITY;
        for tick in &self.x.ticks {
            let at = left + self.x.share(tick.at) * (right - left);
            svg.line((at, above), (at, below), grid);
            let half = width(&tick.label, FONT) / 2.0;
            if at - half > free {
                svg.text((at, below + 18.0), "middle", "", &tick.label);
                free = at + half + 8.0;
            }
        }
        let frame = r##"class="frame" stroke="#444444""##;
        svg.line((left, above), (left, below), frame);
        svg.line((left, below), (right, below), frame);
        let middle = (left + right) / 2.0;
        let across = cut(&self.across, FONT, right - left);
        svg.text((middle, below + 38.0), "middle", "", &across);
    }
}

/// Writes a text in lines from one place to the other; returns the baseline of the last.
pub(crate) fn paragraph(svg: &mut Svg, text: &str, (left, right): (f64, f64), mut y: f64) -> f64 {
    for line in wrapped(text, 12.0, right - left) {
        y += 17.0;
        let look = r##"class="note" font-size="12" fill="#555555""##;
        svg.text((left, y), "start", look, &line);
    }
    y
}

/// Draws samples with their names, in as many rows as they need; returns the last row's baseline.
pub(crate) fn legend(
    svg: &mut Svg,
    items: &[(Swatch, String)],
    (left, right): (f64, f64),
    above: f64,
) -> f64 {
    let mut y = above + LINE + 2.0;
    let mut x = left;
    for (sample, name) in items {
        let stroke = if matches!(sample, Swatch::Marker(_)) { 10.0 } else { STROKE };
        let name = cut(name, FONT, right - left - stroke - 8.0);
        let wide = stroke + 8.0 + width(&name, FONT);
        if x > left && x + wide > right {
            (x, y) = (left, y + LINE);
        }
        let middle = y - 4.5;
        if let Swatch::Stroke(style) | Swatch::Both(style) = sample {
            svg.line((x, middle), (x + stroke, middle), &style.line());
        }
        if let Swatch::Marker(style) | Swatch::Both(style) = sample {
            svg.path(&style.marker((x + stroke / 2.0, middle)), &style.fill());
        }
        if let Swatch::Band = sample {
            let (a, b, from, to) = (x, x + stroke, middle - 6.0, middle + 6.0);
            svg.polygon(&[(a, from), (b, from), (b, to), (a, to)], BAND);
        }
        svg.text((x + stroke + 8.0, y), "start", "", &name);
        x += wide + 18.0;
    }
    y
}

/// A picture of panels one below the other, each of this height in pixels between the ends of its axes, as the text of an
/// SVG file. `description` is for those who cannot see it.
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
    svg.text((left, 32.0), "start", r#"font-size="20" font-weight="bold""#, &title);
    // In one line, or more where they need it.
    let (mut x, mut y) = (left, 36.0 + LINE);
    for text in settings {
        let text = cut(text, FONT, WIDTH - left - RIGHT);
        let wide = width(&text, FONT);
        if x > left && x + wide > WIDTH - 20.0 {
            (x, y) = (left, y + LINE);
        }
        svg.text((x, y), "start", "", &text);
        x += wide + 18.0;
    }
    y
}
