//! Links and pictures that leave the book's folder.

use std::fmt::Write;
use std::io;
use std::path::Path;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use pulldown_cmark::{Event, Options, Parser, Tag, TagEnd};

/// The page with links out of the folder of sources replaced by the names of the files, as from the root of the
/// repository, and with pictures from there put into the page. `source` is the folder of sources, two below `docs`.
///
/// # Errors
/// A picture that cannot be read.
pub fn without_outside(page: &str, source: &Path) -> io::Result<String> {
    let options = Options::ENABLE_TABLES | Options::ENABLE_MATH;
    let mut written = String::with_capacity(page.len());
    let mut done = 0;
    let mut link: Option<(String, String)> = None;
    for (event, place) in Parser::new_ext(page, options).into_offset_iter() {
        match event {
            Event::Start(Tag::Link { dest_url, .. }) if dest_url.starts_with("../") => {
                link = Some((from_root(&dest_url), String::new()));
            }
            Event::Text(text) | Event::Code(text) if link.is_some() => {
                if let Some((_, shown)) = &mut link {
                    shown.push_str(&text);
                }
            }
            Event::End(TagEnd::Link) => {
                if let Some((path, shown)) = link.take() {
                    written.push_str(&page[done..place.start]);
                    // A text that is the file's own name, or its end, says no more than the path.
                    if !path.ends_with(&shown) {
                        let _ = write!(written, "{shown}, ");
                    }
                    let _ = write!(written, "`{path}`");
                    done = place.end;
                }
            }
            Event::Start(Tag::Image { dest_url, .. }) if dest_url.starts_with("../") => {
                let picture = STANDARD.encode(std::fs::read(source.join(&*dest_url))?);
                let address = format!("data:image/svg+xml;base64,{picture}");
                written.push_str(&page[done..place.start]);
                written.push_str(&page[place.clone()].replace(&*dest_url, &address));
                done = place.end;
            }
            _ => {}
        }
    }
    written.push_str(&page[done..]);
    Ok(written)
}

/// The path from the root of the repository, of one relative to `docs/book/src`, without a heading.
fn from_root(link: &str) -> String {
    let mut folders = vec!["docs", "book", "src"];
    for part in link.split('#').next().unwrap_or_default().split('/') {
        match part {
            ".." => drop(folders.pop()),
            part => folders.push(part),
        }
    }
    folders.join("/")
}
