//! Whether `::coadjoint` is a name in the crate that is being compiled.

use std::collections::BTreeMap;

/// The correction where the crate being compiled has no dependency called `coadjoint`; `None`
/// where it has one, or where nothing is known about its dependencies.
pub(crate) fn help() -> Option<String> {
    advice(std::env::args())
}

/// As [`help`], for the arguments that the compiler was called with.
fn advice(arguments: impl Iterator<Item = String>) -> Option<String> {
    let mut externs: BTreeMap<String, String> = BTreeMap::new();
    let mut arguments = arguments.peekable();
    while let Some(argument) = arguments.next() {
        // Arguments in a file are not looked up.
        if argument.starts_with('@') {
            return None;
        }
        if argument == "--crate-name" && arguments.peek().is_some_and(|name| name == "coadjoint") {
            return None;
        }
        let value = match argument.strip_prefix("--extern") {
            Some("") => arguments.next().unwrap_or_default(),
            Some(value) => value.trim_start_matches('=').to_owned(),
            None => continue,
        };
        let (name, file) = value.split_once('=').unwrap_or((&value, ""));
        // `priv:name`, `noprelude:name`.
        let name = name.rsplit(':').next().unwrap_or(name);
        externs.insert(name.to_owned(), file.to_owned());
    }
    if externs.is_empty() || externs.contains_key("coadjoint") {
        return None;
    }
    let is_runtime = |file: &String| {
        let name = file.rsplit(['/', '\\']).next().unwrap_or(file);
        name.starts_with("libcoadjoint-") || name.starts_with("libcoadjoint.")
    };
    let renamed = externs.iter().find(|(_, file)| is_runtime(file)).map(|(name, _)| name);
    let path = renamed.map_or_else(|| "path::to::coadjoint".to_owned(), |name| format!("::{name}"));
    Some(format!(
        "this crate has no dependency called `coadjoint`: say where the runtime is, `crate = {path}`, \
         among the arguments of this attribute"
    ))
}

#[cfg(test)]
mod tests {
    use super::advice;

    fn of(arguments: &[&str]) -> Option<String> {
        advice(arguments.iter().map(|&argument| argument.to_owned()))
    }

    #[test]
    fn a_renamed_dependency_is_found_by_its_file() {
        let help =
            of(&["rustc", "--extern", "lie=/target/libcoadjoint-0a1b.rmeta"]).unwrap_or_default();
        assert!(help.contains("crate = ::lie`"), "{help}");
        let help = of(&["rustc", "--extern=mine=/target/libmine-0a1b.rmeta"]).unwrap_or_default();
        assert!(help.contains("crate = path::to::coadjoint"), "{help}");
    }

    #[test]
    fn nothing_is_said_where_nothing_is_wrong_or_known() {
        assert_eq!(of(&["rustc", "--extern", "coadjoint=/target/libcoadjoint-0a1b.rmeta"]), None);
        assert_eq!(of(&["rustc", "--extern", "priv:coadjoint=/x/libcoadjoint-1.rmeta"]), None);
        assert_eq!(of(&["rustc", "--crate-name", "coadjoint", "--extern", "a=/x/liba.so"]), None);
        assert_eq!(of(&["rustc", "@arguments"]), None);
        assert_eq!(of(&["rust-analyzer-proc-macro-srv"]), None);
    }
}
