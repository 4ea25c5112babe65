//! Quotes without a partner in TOML.

/// The byte at which a text opens that is never closed; nothing where every text is.
///
/// A text in single quotes ends on its line, one in triple quotes anywhere. Where a closing quote
/// is missing in a list, the next text's opening quote closes it, and what follows is no separator:
/// that text is taken to be the one left open.
pub(crate) fn unclosed_quote(text: &str) -> Option<usize> {
    let bytes = text.as_bytes();
    let mut at = 0;
    // The first text on this line that something other than a separator follows.
    let mut doubtful = None;
    while let Some(&byte) = bytes.get(at) {
        match byte {
            b'\n' => doubtful = None,
            b'#' => {
                let line = bytes[at..].iter().position(|b| *b == b'\n');
                at += line.unwrap_or(bytes.len() - at);
                continue;
            }
            b'"' | b'\'' => {
                let long = bytes[at..].starts_with(&[byte; 3]);
                let Some(end) = end(bytes, at, byte, long) else {
                    return Some(doubtful.unwrap_or(at));
                };
                let next = bytes[end..].iter().find(|b| !matches!(b, b' ' | b'\t'));
                let separated = next.is_none_or(|b| {
                    matches!(b, b',' | b']' | b'}' | b'=' | b'.' | b'#' | b'\r' | b'\n')
                });
                if !separated && doubtful.is_none() {
                    doubtful = Some(at);
                }
                at = end;
                continue;
            }
            _ => {}
        }
        at += 1;
    }
    None
}

/// Where the text that opens at `start` ends, its closing quotes included.
fn end(bytes: &[u8], start: usize, quote: u8, long: bool) -> Option<usize> {
    let width = if long { 3 } else { 1 };
    let mut at = start + width;
    while let Some(&byte) = bytes.get(at) {
        match byte {
            b'\\' if quote == b'"' => at += 1,
            b'\n' if !long => return None,
            _ if byte == quote && (!long || bytes[at..].starts_with(&[quote; 3])) => {
                return Some(at + width);
            }
            _ => {}
        }
        at += 1;
    }
    None
}

#[cfg(test)]
mod tests {
    use super::unclosed_quote;

    #[test]
    fn the_quote_without_a_partner_is_found() {
        assert_eq!(unclosed_quote("a = \"b\nc = \"d\""), Some(4));
        assert_eq!(unclosed_quote("a = [\"x, \"y\", \"z\"]"), Some(5));
        assert_eq!(unclosed_quote("a = \"b # \\\" c\" # \"\n"), None);
    }
}
