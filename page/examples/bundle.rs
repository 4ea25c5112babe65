//! Puts the page together: `cargo run --example bundle -- WASM FRONT OUT` writes one HTML file that opens from disk.
//!
//! The library, packed by gzip and written in base64, stands in one classic script: `file://` lets a page load neither
//! modules nor files.

use std::error::Error;
use std::fs;
use std::io::Write;
use std::path::Path;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::Compression;
use flate2::write::GzEncoder;
use wasm_bindgen_cli_support::Bindgen;

/// The scripts in the order they run in.
const SCRIPTS: [&str; 9] = [
    "start.js",
    "state.js",
    "vector.js",
    "canvas.js",
    "body.js",
    "orbit.js",
    "drift.js",
    "form.js",
    "page.js",
];

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [wasm, front, out] = &arguments[..] else {
        return Err(
            "arguments: the library, the folder of the page's sources, the file to write".into()
        );
    };
    let mut bindgen = Bindgen::new();
    bindgen
        .input_path(wasm)
        .no_modules(true)?
        .typescript(false)
        .omit_default_module_path(true)
        .out_name("library")
        .remove_name_section(true);
    let mut output = bindgen.generate_output()?;
    let glue = output.js().to_owned();
    let library = output.wasm_mut().emit_wasm();

    let mut packer = GzEncoder::new(Vec::new(), Compression::best());
    packer.write_all(&library)?;
    let packed = packer.finish()?;

    let front = Path::new(front);
    let read = |name: &str| {
        fs::read_to_string(front.join(name)).map_err(|error| format!("{name}: {error}"))
    };
    let mut script = format!("{}\nconst LIBRARY = \"{}\";\n", glue, STANDARD.encode(&packed));
    for name in SCRIPTS {
        script.push_str(&read(name)?);
    }
    if script.contains("</script") {
        return Err("a script must not hold the tag that ends it".into());
    }
    let page = read("index.html")?
        .replace("/*STYLE*/", &read("style.css")?)
        .replace("/*SCRIPT*/", &script);
    fs::write(out, &page)?;
    println!(
        "{out}: {} kB; the library {} kB, packed {} kB",
        page.len() / 1000,
        library.len() / 1000,
        packed.len() / 1000
    );
    Ok(())
}
