//! The styles of curves: colour, dashes and markers, and the colours of a page, light and dark.

use std::fmt::Write as _;

/// A colour that keeps its contrast with white, one that keeps it with black, and a pattern of dashes.
const STYLES: [(&str, &str, &str); 8] = [
    ("#0060a8", "#6cb6ff", ""),
    ("#c04a00", "#ff9d57", "8 3"),
    ("#00805c", "#3fd0a0", "2 2.5"),
    ("#8a2f8f", "#dc9ce0", "10 3 2 3"),
    ("#000000", "#f0f0f0", "16 4"),
    ("#a06a00", "#e3b341", "5 2.5 1.5 2.5 1.5 2.5"),
    ("#c8206a", "#ff7eb6", "4 4"),
    ("#606060", "#a8a8a8", "14 3 5 3"),
];

/// The attributes of a band.
pub(crate) const BAND: &str =
    r##"class="band" fill="#bdbdbd" fill-opacity="0.55" stroke="#8a8a8a" stroke-width="0.6""##;

/// The rules for a page that holds pictures: pictures follow the reader's choice of light or dark, and is light
/// in print. The variables `--ink`, `--paper`, `--faint`, `--grid`, `--frame` and `--s0` to `--s7` serve the page too.
pub const STYLE_SHEET: &str = "\
:root{color-scheme:light;--paper:#ffffff;--ink:#1f2328;--faint:#555555;--grid:#dddddd;--frame:#444444;--band:#bdbdbd;\
--s0:#0060a8;--s1:#c04a00;--s2:#00805c;--s3:#8a2f8f;--s4:#000000;--s5:#a06a00;--s6:#c8206a;--s7:#606060}
@media screen and (prefers-color-scheme:dark){:root{color-scheme:dark;--paper:#0f1318;--ink:#e6e8ea;--faint:#a3a9b0;\
--grid:#2c333b;--frame:#9aa1a9;--band:#5a6068;\
--s0:#6cb6ff;--s1:#ff9d57;--s2:#3fd0a0;--s3:#dc9ce0;--s4:#f0f0f0;--s5:#e3b341;--s6:#ff7eb6;--s7:#a8a8a8}}
svg.plot{fill:var(--ink);max-width:100%;height:auto}
.plot .ground{fill:var(--paper)}
.plot .grid{stroke:var(--grid)}
.plot .frame{stroke:var(--frame)}
.plot .note{fill:var(--faint)}
.plot .band{fill:var(--band);stroke:var(--faint)}
.plot .s0{stroke:var(--s0)}.plot .s1{stroke:var(--s1)}.plot .s2{stroke:var(--s2)}.plot .s3{stroke:var(--s3)}
.plot .s4{stroke:var(--s4)}.plot .s5{stroke:var(--s5)}.plot .s6{stroke:var(--s6)}.plot .s7{stroke:var(--s7)}
.plot .m0{fill:var(--s0)}.plot .m1{fill:var(--s1)}.plot .m2{fill:var(--s2)}.plot .m3{fill:var(--s3)}
.plot .m4{fill:var(--s4)}.plot .m5{fill:var(--s5)}.plot .m6{fill:var(--s6)}.plot .m7{fill:var(--s7)}
";

/// The look of a curve: a number that selects colour, dashes and marker; after eight they repeat with thicker lines.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Style(usize);

impl Style {
    /// Curve number `number`.
    pub fn new(number: usize) -> Self {
        Self(number)
    }

    fn kind(self) -> usize {
        self.0 % STYLES.len()
    }

    /// The attributes of its line.
    pub(crate) fn line(self) -> String {
        let kind = self.kind();
        let (colour, _, dashes) = STYLES[kind];
        let thickness = 1.5 + (self.0 / STYLES.len()) as f64;
        let mut text = format!(
            r#"class="s{kind}" stroke="{colour}" stroke-width="{thickness}" stroke-linejoin="round""#
        );
        // Writing to a String cannot fail.
        if !dashes.is_empty() {
            let _ = write!(text, r#" stroke-dasharray="{dashes}""#);
        }
        text
    }

    /// The attributes of its markers.
    pub(crate) fn fill(self) -> String {
        let kind = self.kind();
        format!(r#"class="m{kind}" fill="{}""#, STYLES[kind].0)
    }

    /// The outline of a marker around a point, as the data of a path.
    pub(crate) fn marker(self, (x, y): (f64, f64)) -> String {
        match self.kind() {
            0 => format!("M{:.1} {y:.1}a3 3 0 1 0 6 0a3 3 0 1 0 -6 0z", x - 3.0),
            1 => format!("M{:.1} {:.1}h5.4v5.4h-5.4z", x - 2.7, y - 2.7),
            2 => format!("M{x:.1} {:.1}l3.6 6h-7.2z", y - 3.8),
            3 => format!("M{x:.1} {:.1}l3.8 3.8l-3.8 3.8l-3.8 -3.8z", y - 3.8),
            4 => format!("M{x:.1} {:.1}l3.6 -6h-7.2z", y + 3.8),
            5 => {
                format!("M{:.1} {:.1}h2v2.6h2.6v2h-2.6v2.6h-2v-2.6h-2.6v-2h2.6z", x - 1.0, y - 3.6)
            }
            6 => format!(
                "M{:.1} {y:.1}a3 3 0 1 0 6 0a3 3 0 1 0 -6 0zM{:.1} {y:.1}a1.6 1.6 0 1 1 3.2 0a1.6 1.6 0 1 1 -3.2 0z",
                x - 3.0,
                x - 1.6
            ),
            _ => format!("M{:.1} {:.1}h7v2h-7z", x - 3.5, y - 1.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{STYLE_SHEET, STYLES, Style};

    #[test]
    fn the_style_sheet_has_every_colour() {
        for (i, (light, dark, _)) in STYLES.iter().enumerate() {
            for text in [format!("--s{i}:{light}"), format!("--s{i}:{dark}")] {
                assert!(STYLE_SHEET.contains(&text), "{text}");
            }
        }
        let markers: std::collections::BTreeSet<String> =
            (0..STYLES.len()).map(|i| Style::new(i).marker((0.0, 0.0))).collect();
        assert_eq!(markers.len(), STYLES.len());
    }
}
