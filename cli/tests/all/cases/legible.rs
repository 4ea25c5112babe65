//! Pictures that can be read; `paper/tests/all/page.rs` has its own looked at here, too.
#![allow(clippy::unwrap_used)]

/// No two of at least this number of texts of a picture overlap, and none leaves it. Widths are those of a wide font.
pub fn legible(svg: &str, least: usize) -> Result<(), String> {
    let document = roxmltree::Document::parse(svg).map_err(|error| error.to_string())?;
    let number = |node: &roxmltree::Node<'_, '_>, name| -> Option<f64> {
        node.attribute(name).map(|value| value.parse().unwrap())
    };
    let root = document.root_element();
    let [width, height] = ["width", "height"].map(|name| number(&root, name).unwrap());
    let texts = document.descendants().filter(|node| node.tag_name().name() == "text");
    let boxes: Vec<(f64, f64, f64, f64, String)> = texts
        .map(|node| {
            let [x, y] = ["x", "y"].map(|name| number(&node, name).unwrap());
            let size = number(&node, "font-size").unwrap_or(13.0);
            let text = node.text().unwrap_or_default().to_owned();
            let wide = 0.6 * size * text.chars().count() as f64;
            let left = match node.attribute("text-anchor").unwrap() {
                "start" => x,
                "middle" => x - wide / 2.0,
                _ => x - wide,
            };
            (left, left + wide, y - 0.75 * size, y + 0.2 * size, text)
        })
        .collect();
    if boxes.len() < least {
        return Err(format!("only {} texts", boxes.len()));
    }
    for (i, a) in boxes.iter().enumerate() {
        if !(a.0 >= 0.0 && a.1 <= width && a.3 <= height) {
            return Err(format!("outside: {a:?}"));
        }
        let overlaps = |b: &&(f64, f64, f64, f64, String)| {
            !(a.1 <= b.0 || b.1 <= a.0 || a.3 <= b.2 || b.3 <= a.2)
        };
        if let Some(b) = boxes[i + 1..].iter().find(overlaps) {
            return Err(format!("{a:?} and {b:?}"));
        }
    }
    Ok(())
}
