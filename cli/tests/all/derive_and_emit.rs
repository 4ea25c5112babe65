//! `emit`: what is written is code, and what is committed; cases `derive` and `emit` show the rest.

use crate::support::{BODY, Folder, run, text_of};

#[test]
fn code_is_written_as_it_is_printed() {
    let module = run(&format!("emit {BODY} --truncation 5")).ok();
    assert!(syn::parse_file(&module.out).is_ok());
    let folder = Folder::new();
    let printed = folder.run(&format!("emit {BODY} --truncation 5 --out rigid_body.rs")).ok();
    assert_eq!(printed.out, "");
    assert_eq!(folder.text("rigid_body.rs"), module.out);
    let header = run("emit examples/c/toutatis.toml --language c --truncation 7").ok();
    assert_eq!(header.out, text_of("examples/c/toutatis.h"));
}
