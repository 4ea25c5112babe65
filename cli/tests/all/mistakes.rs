//! Files that are no text; cases `mistakes_*` show other bad input.

use crate::support::{BODY, Folder};

/// The messages give the place of bytes that are not UTF-8, and name other encodings and separators.
#[test]
fn files_that_are_not_the_text_they_should_be_are_refused_with_the_reason() {
    let folder = Folder::new();
    let utf16 = |text: &str| -> Vec<u8> {
        "\u{feff}".encode_utf16().chain(text.encode_utf16()).flat_map(u16::to_le_bytes).collect()
    };
    let rows = "mu_1;mu_2;mu_3\n1;2,5;3\n";
    folder.write("latin.toml", b"group = \"SO3\"\nname = \"Li\xc3\xa9 \xe9\"");
    folder.write("wide.toml", utf16("group = \"SO3\""));
    folder.write("wide.csv", utf16(rows));
    folder.write("latin.csv", b"# a\nmu_1,\xb5_2,mu_3\n1,2,3\n");
    folder.write("semicolons.csv", rows);
    folder.write("tabs.csv", "mu_1\tmu_2\n1\t2\n");
    let byte = |byte, column| {
        format!("byte {byte} at line 2, column {column} is not UTF-8; save the file as UTF-8")
    };
    let wide = "it is UTF-16, by its first two bytes; save the file as UTF-8";
    folder.refused(&[("derive latin.toml", &byte("0xe9", 13)), ("derive wide.toml", wide)]);
    for (file, word) in [
        ("wide.csv", "UTF-16"),
        ("latin.csv", &byte("0xb5", 6)),
        ("semicolons.csv", "semicolons stand between the names of columns; write commas"),
        ("tabs.csv", "tabs stand between the names of columns"),
    ] {
        folder.refused(&[
            (&format!("ensemble {BODY} --initial {file} --out out.csv --time 1"), word),
            (&format!("learn {file} --dt 0.1"), word),
            (&format!("verify {BODY} {file}"), word),
        ]);
    }
}
