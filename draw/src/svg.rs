//! Writing SVG: elements, text that cannot break them, and how wide a text is about.

use std::fmt::Write;

/// A document that grows downwards. Writing into a string cannot fail, so results are dropped.
#[derive(Debug, Default)]
pub(crate) struct Svg {
    body: String,
}

impl Svg {
    /// Opens a group with a name that pointers and screen readers show.
    pub(crate) fn open(&mut self, title: &str) {
        let _ = writeln!(self.body, "<g><title>{}</title>", escaped(title));
    }

    /// Closes the group opened last.
    pub(crate) fn close(&mut self) {
        self.body.push_str("</g>\n");
    }

    /// A text with its baseline at (x, y), where it has its `anchor`: `start`, `middle` or `end`; `style` is further attributes.
    pub(crate) fn text(&mut self, (x, y): (f64, f64), anchor: &str, style: &str, text: &str) {
        let text = escaped(text);
        let _ = writeln!(
            self.body,
            r#"<text x="{x:.1}" y="{y:.1}" text-anchor="{anchor}" {style}>{text}</text>"#
        );
    }

    /// A straight line.
    pub(crate) fn line(&mut self, (x1, y1): (f64, f64), (x2, y2): (f64, f64), style: &str) {
        let _ = writeln!(
            self.body,
            r#"<line x1="{x1:.1}" y1="{y1:.1}" x2="{x2:.1}" y2="{y2:.1}" {style}/>"#
        );
    }

    /// A line through points; nothing if there are fewer than two.
    pub(crate) fn polyline(&mut self, points: &[(f64, f64)], style: &str) {
        if points.len() > 1 {
            let points = coordinates(points);
            let _ = writeln!(self.body, r#"<polyline points="{points}" fill="none" {style}/>"#);
        }
    }

    /// A filled area.
    pub(crate) fn polygon(&mut self, points: &[(f64, f64)], style: &str) {
        if points.len() > 2 {
            let points = coordinates(points);
            let _ = writeln!(self.body, r#"<polygon points="{points}" {style}/>"#);
        }
    }

    /// Filled outlines.
    pub(crate) fn path(&mut self, data: &str, style: &str) {
        if !data.is_empty() {
            let _ = writeln!(self.body, r#"<path d="{data}" {style}/>"#);
        }
    }

    /// The whole document, with a title and a description for those who cannot see it.
    pub(crate) fn finish(
        &self,
        (width, height): (f64, f64),
        title: &str,
        description: &str,
    ) -> String {
        let (title, description, body) = (escaped(title), escaped(description), &self.body);
        format!(
            r##"<svg xmlns="http://www.w3.org/2000/svg" width="{width:.0}" height="{height:.0}" viewBox="0 0 {width:.0} {height:.0}" role="img" aria-labelledby="title description" {FONTS} font-size="13" fill="#222222">
<title id="title">{title}</title>
<desc id="description">{description}</desc>
<rect width="100%" height="100%" fill="#ffffff"/>
{body}</svg>
"##
        )
    }

    /// The picture as an element of a page that holds [`STYLE_SHEET`](crate::STYLE_SHEET).
    pub(crate) fn element(&self, (width, height): (f64, f64), label: &str) -> String {
        let (label, body) = (escaped(label), &self.body);
        format!(
            "<svg class=\"plot\" width=\"{width:.0}\" height=\"{height:.0}\" viewBox=\"0 0 {width:.0} {height:.0}\" \
             role=\"img\" aria-label=\"{label}\" {FONTS} font-size=\"13\">\n{body}</svg>\n"
        )
    }
}

/// Fonts whose letters are no wider than [`width`] supposes.
const FONTS: &str = r#"font-family="DejaVu Sans, Verdana, sans-serif""#;

fn coordinates(points: &[(f64, f64)]) -> String {
    let mut text = String::new();
    let mut last = String::new();
    for (x, y) in points {
        let next = format!("{x:.1},{y:.1}");
        // Points that fall together on paper are one.
        if next != last {
            if !text.is_empty() {
                text.push(' ');
            }
            text.push_str(&next);
            last = next;
        }
    }
    text
}

/// The text with what has a meaning in XML written out: for elements and quoted attributes of SVG and HTML. Control
/// characters, and those that change the direction of text, become spaces.
pub fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            '\u{61c}'
            | '\u{200e}'
            | '\u{200f}'
            | '\u{2028}'..='\u{202e}'
            | '\u{2066}'..='\u{2069}' => {
                out.push(' ');
            }
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => out.push(' '),
            c => out.push(c),
        }
    }
    out
}

/// About how wide a text is at this size of font, in pixels; rather too wide than too narrow.
pub(crate) fn width(text: &str, size: f64) -> f64 {
    // Ideographs and the like take twice the room.
    let units = text.chars().map(|c| if c >= '\u{2e80}' { 1.1 } else { 0.62 });
    units.sum::<f64>() * size
}

/// The text, cut with an ellipsis where it is wider than `room` pixels.
pub(crate) fn cut(text: &str, size: f64, room: f64) -> String {
    if width(text, size) <= room {
        return text.to_owned();
    }
    let mut short = String::new();
    for c in text.chars() {
        short.push(c);
        if width(&short, size) + size > room {
            break;
        }
    }
    short.pop();
    short.push('…');
    short
}

/// The text in lines no wider than `room` pixels; a word wider than that is cut.
pub(crate) fn wrapped(text: &str, size: f64, room: f64) -> Vec<String> {
    let mut lines = Vec::new();
    let mut line = String::new();
    for word in text.split_whitespace() {
        if !line.is_empty() && width(&line, size) + width(word, size) + size > room {
            lines.push(cut(&std::mem::take(&mut line), size, room));
        }
        if !line.is_empty() {
            line.push(' ');
        }
        line.push_str(word);
    }
    if !line.is_empty() {
        lines.push(cut(&line, size, room));
    }
    lines
}
