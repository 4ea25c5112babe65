//! Committed texts under `golden/`.

use std::path::PathBuf;

/// Compares a text with the committed file of this name; with `COADJOINT_BLESS` set, writes the file.
pub fn check(name: &str, text: &str) {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("golden").join(name);
    if std::env::var_os("COADJOINT_BLESS").is_some() {
        std::fs::write(&path, text).expect("a file that can be written");
    }
    let committed = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(committed == text, "{} differs from the text written now", path.display());
}
