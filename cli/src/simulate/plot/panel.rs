//! A panel: two axes, curves, and what is written around them.

use super::axis::Axis;
use super::svg::{Anchor, Svg, cut, width};

/// The width of a picture.
pub const WIDTH: f64 = 900.0;
/// Free space at the right.
const RIGHT: f64 = 30.0;
/// The height between the axes' ends.
const HEIGHT: f64 = 190.0;
/// The height of a line of text.
pub const LINE: f64 = 20.0;
/// The size of most texts.
pub const FONT: f64 = 13.0;
/// The length of a stroke in a legend: the longest pattern of dashes shows twice.
const STROKE: f64 = 44.0;

/// A colour that keeps its contrast with white, and a pattern of dashes that tells the curve apart in
/// grey.
const STYLES: [(&str, &str); 8] = [
    ("#0060a8", ""),
    ("#c04a00", "8 3"),
    ("#00805c", "2 2.5"),
    ("#8a2f8f", "10 3 2 3"),
    ("#000000", "16 4"),
    ("#a06a00", "5 2.5 1.5 2.5 1.5 2.5"),
    ("#c8206a", "4 4"),
    ("#606060", "14 3 5 3"),
];

/// The attributes of curve number `i`; after eight, they come again with thicker lines.
pub fn style(i: usize) -> String {
    let (colour, dashes) = STYLES[i % STYLES.len()];
    let thickness = 1.5 + (i / STYLES.len()) as f64;
    let dashes = match dashes {
        "" => String::new(),
        dashes => format!(r#" stroke-dasharray="{dashes}""#),
    };
    format!(r#"stroke="{colour}" stroke-width="{thickness}" stroke-linejoin="round"{dashes}"#)
}

/// The attributes of a band.
pub const BAND: &str =
    r##"fill="#bdbdbd" fill-opacity="0.55" stroke="#8a8a8a" stroke-width="0.6""##;

/// What stands for a name in a legend.
#[derive(Clone, Debug)]
pub enum Sample {
    /// A stroke with these attributes.
    Stroke(String),
    /// A box filled as a band is.
    Band,
}

/// A curve in the units of its panel's axes.
#[derive(Clone, Debug)]
pub struct Curve {
    /// Its name.
    pub name: String,
    /// Its attributes.
    pub style: String,
    /// Its points.
    pub points: Vec<(f64, f64)>,
}

/// A panel, ready to be placed.
#[derive(Clone, Debug)]
pub struct Panel {
    /// What is drawn, with its unit: the label of the vertical axis, above it.
    pub heading: String,
    /// Remarks, each on a line of its own.
    pub notes: Vec<String>,
    /// Samples and their names.
    pub legend: Vec<(Sample, String)>,
    /// The label of the horizontal axis.
    pub across: String,
    /// Time.
    pub x: Axis,
    /// What is drawn.
    pub y: Axis,
    /// A band behind the curves, as its outline.
    pub band: Vec<(f64, f64)>,
    /// The curves.
    pub curves: Vec<Curve>,
}

impl Panel {
    /// The room that the labels of the vertical axis need.
    pub fn left(&self) -> f64 {
        let widest = self.y.ticks.iter().map(|tick| width(&tick.label, FONT)).fold(0.0, f64::max);
        widest + 22.0
    }

    /// Draws the panel from `top` down, its vertical axis at `left`; returns where it ends.
    pub fn draw(&self, svg: &mut Svg, top: f64, left: f64) -> f64 {
        svg.open(&self.heading);
        let right = WIDTH - RIGHT;
        let mut y = top + 18.0;
        let heading = cut(&self.heading, 15.0, right - left);
        svg.text((left, y), Anchor::Start, r#"font-size="15" font-weight="bold""#, &heading);
        for note in &self.notes {
            y = paragraph(svg, note, left, y);
        }
        if !self.legend.is_empty() {
            y = legend(svg, &self.legend, left, y);
        }
        let (above, below) = (y + 14.0, y + 14.0 + HEIGHT);
        let place = |(time, value): (f64, f64)| {
            let across = left + self.x.share(time) * (right - left);
            (across, below - self.y.share(value) * HEIGHT)
        };
        let grid = r##"stroke="#dddddd""##;
        for tick in &self.y.ticks {
            let at = below - self.y.share(tick.at) * HEIGHT;
            svg.line((left, at), (right, at), grid);
            svg.text((left - 8.0, at + 4.5), Anchor::End, "", &tick.label);
        }
        // Labels that would touch are left out; their lines stay.
        let mut free = f64::NEG_INFINITY;
        for tick in &self.x.ticks {
            let at = left + self.x.share(tick.at) * (right - left);
            svg.line((at, above), (at, below), grid);
            let half = width(&tick.label, FONT) / 2.0;
            if at - half > free {
                svg.text((at, below + 18.0), Anchor::Middle, "", &tick.label);
                free = at + half + 8.0;
            }
        }
        svg.line((left, above), (left, below), r##"stroke="#444444""##);
        svg.line((left, below), (right, below), r##"stroke="#444444""##);
        let middle = (left + right) / 2.0;
        svg.text((middle, below + 38.0), Anchor::Middle, "", &self.across);
        let outline: Vec<(f64, f64)> = self.band.iter().map(|&point| place(point)).collect();
        svg.polygon(&outline, BAND);
        for curve in &self.curves {
            svg.open(&curve.name);
            let points: Vec<(f64, f64)> = curve.points.iter().map(|&point| place(point)).collect();
            svg.polyline(&points, &curve.style);
            svg.close();
        }
        svg.close();
        below + 52.0
    }
}

/// Writes a text in lines as wide as the picture; returns the baseline of the last.
pub fn paragraph(svg: &mut Svg, text: &str, left: f64, mut y: f64) -> f64 {
    const SIZE: f64 = 12.0;
    let room = WIDTH - RIGHT - left;
    let mut line = String::new();
    let mut write = |line: &str, y: &mut f64| {
        *y += 17.0;
        let line = cut(line, SIZE, room);
        svg.text((left, *y), Anchor::Start, r##"font-size="12" fill="#555555""##, &line);
    };
    for word in text.split_whitespace() {
        if !line.is_empty() && width(&line, SIZE) + width(word, SIZE) + SIZE > room {
            write(&line, &mut y);
            line.clear();
        }
        if !line.is_empty() {
            line.push(' ');
        }
        line.push_str(word);
    }
    if !line.is_empty() {
        write(&line, &mut y);
    }
    y
}

/// Draws samples with their names, in as many rows as they need; returns the last row's baseline.
pub fn legend(svg: &mut Svg, items: &[(Sample, String)], left: f64, above: f64) -> f64 {
    let (right, mut y) = (WIDTH - RIGHT, above + LINE + 2.0);
    let mut x = left;
    for (sample, name) in items {
        let name = cut(name, FONT, right - left - STROKE - 8.0);
        let wide = STROKE + 8.0 + width(&name, FONT);
        if x > left && x + wide > right {
            (x, y) = (left, y + LINE);
        }
        let middle = y - 4.5;
        match sample {
            Sample::Stroke(style) => svg.line((x, middle), (x + STROKE, middle), style),
            Sample::Band => {
                let (a, b, from, to) = (x, x + STROKE, middle - 6.0, middle + 6.0);
                svg.polygon(&[(a, from), (b, from), (b, to), (a, to)], BAND);
            }
        }
        svg.text((x + STROKE + 8.0, y), Anchor::Start, "", &name);
        x += wide + 22.0;
    }
    y
}
