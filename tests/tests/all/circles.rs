//! Files of a crate depend on one another in one direction.
//!
//! File A depends on file B where A imports or names an item that B defines, `mod.rs` and re-exports seen through. Tests
//! within the crates do not count.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use coadjoint_tests::sources;
use proc_macro2::{TokenStream, TokenTree};
use syn::visit::{self, Visit};
use syn::{Attribute, Item, UseTree};

const CRATES: [&str; 17] = [
    "bench",
    "cli",
    "codegen",
    "docs/book/formulas",
    "draw",
    "geometry",
    "learn",
    "macros",
    "native",
    "page",
    "paper",
    "program",
    "python",
    "run",
    "runtime",
    "symbolic",
    "tests",
];

/// The circle that there may be: that of an evaluator, whose parts call one another as the parts of an expression do, since a
/// value may be a function, whose body is evaluated.
const KEPT: (&str, [&str; 3]) =
    ("codegen", ["parse::rust::evaluate", "parse::rust::signature", "parse::rust::value"]);

/// Names that lead from the root of a crate to a module or an item.
type Names = Vec<String>;

/// `use path as name`; of a glob the name is `*`.
struct Import {
    path: Names,
    name: String,
    public: bool,
}

/// The source of a module that is a file.
#[derive(Default)]
struct Module {
    items: BTreeSet<String>,
    imports: Vec<Import>,
    /// Paths in code other than imports.
    paths: Vec<Names>,
    /// Inline modules around the place that is being read.
    depth: usize,
}

fn is_test(attributes: &[Attribute]) -> bool {
    let mut of_test = attributes.iter().filter(|attribute| attribute.path().is_ident("cfg"));
    of_test.any(|attribute| {
        let meta = attribute.meta.require_list().expect("cfg(…)").tokens.to_string();
        meta.split(|c: char| !c.is_alphanumeric()).any(|word| word == "test")
            && !meta.contains("not (test")
            && !meta.contains("not(test")
    })
}

impl Module {
    /// A path as seen from the module of the file.
    fn seen_from_the_file(&self, mut path: Names) -> Names {
        for _ in 0..self.depth {
            if path.first().is_some_and(|name| name == "super") {
                path.remove(0);
            }
        }
        path
    }

    fn import(&mut self, tree: &UseTree, mut path: Names, public: bool) {
        let (name, path) = match tree {
            UseTree::Path(next) => {
                path.push(next.ident.to_string());
                return self.import(&next.tree, path, public);
            }
            UseTree::Group(group) => {
                return group.items.iter().for_each(|tree| self.import(tree, path.clone(), public));
            }
            UseTree::Glob(_) => ("*".to_owned(), path),
            UseTree::Name(one) if one.ident == "self" => {
                (path.last().cloned().unwrap_or_default(), path)
            }
            UseTree::Name(one) => {
                path.push(one.ident.to_string());
                (one.ident.to_string(), path)
            }
            UseTree::Rename(one) => {
                if one.ident != "self" {
                    path.push(one.ident.to_string());
                }
                (one.rename.to_string(), path)
            }
        };
        let path = self.seen_from_the_file(path);
        self.imports.push(Import { path, name, public });
    }

    /// Paths in the arguments of a macro.
    fn tokens(&mut self, tokens: TokenStream) {
        let mut path = Names::new();
        let mut colons = 0;
        for token in tokens {
            match token {
                TokenTree::Ident(name) => {
                    if colons != 2 {
                        self.named(std::mem::take(&mut path));
                    }
                    path.push(name.to_string());
                    colons = 0;
                }
                TokenTree::Punct(sign) if sign.as_char() == ':' => colons += 1,
                other => {
                    self.named(std::mem::take(&mut path));
                    colons = 0;
                    if let TokenTree::Group(group) = other {
                        self.tokens(group.stream());
                    }
                }
            }
        }
        self.named(path);
    }

    fn named(&mut self, path: Names) {
        if path.len() > 1 {
            let path = self.seen_from_the_file(path);
            self.paths.push(path);
        }
    }
}

impl<'ast> Visit<'ast> for Module {
    fn visit_item(&mut self, item: &'ast Item) {
        let (attributes, name) = match item {
            Item::Const(item) => (&item.attrs, Some(&item.ident)),
            Item::Enum(item) => (&item.attrs, Some(&item.ident)),
            Item::Fn(item) => (&item.attrs, Some(&item.sig.ident)),
            Item::Macro(item) => (&item.attrs, item.ident.as_ref()),
            Item::Static(item) => (&item.attrs, Some(&item.ident)),
            Item::Struct(item) => (&item.attrs, Some(&item.ident)),
            Item::Trait(item) => (&item.attrs, Some(&item.ident)),
            Item::Type(item) => (&item.attrs, Some(&item.ident)),
            Item::Union(item) => (&item.attrs, Some(&item.ident)),
            Item::Impl(item) => (&item.attrs, None),
            Item::Mod(item) => (&item.attrs, None),
            Item::Use(item) => (&item.attrs, None),
            _ => return,
        };
        if is_test(attributes) {
            return;
        }
        self.items.extend(name.map(ToString::to_string));
        match item {
            Item::Use(item) => {
                let public = !matches!(item.vis, syn::Visibility::Inherited);
                self.import(&item.tree, Names::new(), public);
            }
            Item::Mod(item) => {
                self.depth += 1;
                visit::visit_item_mod(self, item);
                self.depth -= 1;
            }
            item => visit::visit_item(self, item),
        }
    }

    fn visit_path(&mut self, path: &'ast syn::Path) {
        self.named(path.segments.iter().map(|segment| segment.ident.to_string()).collect());
        visit::visit_path(self, path);
    }

    fn visit_macro(&mut self, called: &'ast syn::Macro) {
        self.tokens(called.tokens.clone());
    }
}

/// The modules of a crate that are files, by their paths.
struct Sources(BTreeMap<Names, Module>);

impl Sources {
    /// The files of `src` but for tests, and for the program beside a library.
    fn read(src: &str) -> Self {
        let files = sources::rust(src);
        let library = files.iter().any(|(path, _)| *path == format!("{src}/lib.rs"));
        let modules = files.into_iter().filter_map(|(path, text)| {
            let inside = &path[src.len() + 1..];
            if inside.ends_with("tests.rs") || (library && inside == "main.rs") {
                return None;
            }
            let mut module = Module::default();
            module.visit_file(&syn::parse_file(&text).unwrap_or_else(|e| panic!("{path}: {e}")));
            Some((module_of(inside), module))
        });
        Self(modules.collect())
    }

    /// A path in the module `from`, from the root of the crate; `None` where it leads out of the crate.
    fn seen_from_root(&self, from: &Names, path: &[String]) -> Option<Names> {
        let mut base = from.clone();
        let mut rest = path;
        if rest.first().is_some_and(|name| name == "crate") {
            return Some(rest[1..].to_vec());
        }
        while let Some((first, after)) = rest.split_first() {
            match first.as_str() {
                "self" => {}
                "super" => drop(base.pop()?),
                _ => break,
            }
            rest = after;
        }
        let relative = rest.len() < path.len();
        base.extend(rest.first().cloned());
        if !relative && !self.0.contains_key(&base) {
            return None;
        }
        base.extend(rest.iter().skip(1).cloned());
        Some(base)
    }

    /// The file that defines the item of a path from the root.
    fn defining(&self, path: &[String], seen: &mut BTreeSet<Names>) -> Option<Names> {
        if !seen.insert(path.to_vec()) {
            return None;
        }
        let mut module = Names::new();
        for (at, name) in path.iter().enumerate() {
            module.push(name.clone());
            if self.0.contains_key(&module) {
                continue;
            }
            module.pop();
            let Module { items, imports, .. } = &self.0[&module];
            if items.contains(name) {
                return Some(module);
            }
            for import in imports {
                let rest = match import.name.as_str() {
                    "*" => &path[at..],
                    own if own == name => &path[at + 1..],
                    _ => continue,
                };
                let target = self.seen_from_root(&module, &import.path);
                let target = target.map(|target| [&target, rest].concat());
                match target.and_then(|target| self.defining(&target, seen)) {
                    None if import.name == "*" => {}
                    found => return found,
                }
            }
            // An item of an inline module, or one that a macro defines.
            return Some(module);
        }
        Some(module)
    }

    /// The files that each file depends on.
    fn dependencies(&self) -> BTreeMap<&Names, BTreeSet<Names>> {
        let of = |(own, module): (&'_ Names, &Module)| {
            let imports = module.imports.iter().filter(|import| !import.public);
            let paths = imports.map(|import| &import.path).chain(&module.paths);
            let paths = paths.filter_map(|path| self.seen_from_root(own, path));
            let files = paths.filter_map(|path| self.defining(&path, &mut BTreeSet::new()));
            files.filter(|file| file != own).collect()
        };
        self.0.iter().map(|entry| (entry.0, of(entry))).collect()
    }
}

/// The module that a file of a crate is.
fn module_of(file: &str) -> Names {
    let inside = Path::new(file).with_extension("");
    let mut names: Names = inside.iter().map(|name| name.to_str().unwrap().to_owned()).collect();
    if names.last().is_some_and(|name| ["lib", "main", "mod"].contains(&name.as_str())) {
        names.pop();
    }
    names
}

/// Files that can be reached from one another, circle by circle.
fn circles(graph: &BTreeMap<&Names, BTreeSet<Names>>) -> BTreeSet<Vec<String>> {
    let reached = |start: &Names| {
        let mut found = BTreeSet::new();
        let mut open = vec![start];
        while let Some(file) = open.pop() {
            open.extend(graph[file].iter().filter(|next| found.insert((*next).clone())));
        }
        found
    };
    let reached: BTreeMap<&Names, _> = graph.keys().map(|file| (*file, reached(file))).collect();
    let circle = |file: &Names| {
        let back = reached[file].iter().filter(|other| reached[*other].contains(file));
        back.map(|file| file.join("::")).collect::<Vec<_>>()
    };
    let mut found: BTreeSet<_> = graph.keys().map(|file| circle(file)).collect();
    found.remove(&Vec::new());
    found
}

#[test]
fn files_of_a_crate_form_no_circle() {
    let mut found = BTreeSet::new();
    let mut files = 0;
    for name in CRATES {
        let sources = Sources::read(&format!("{name}/src"));
        files += sources.0.len();
        found.extend(circles(&sources.dependencies()).into_iter().map(|circle| (name, circle)));
    }
    let kept = |(name, circle): &(&str, Vec<String>)| {
        *name == KEPT.0 && circle.iter().all(|file| KEPT.1.contains(&file.as_str()))
    };
    found.retain(|one| !kept(one));
    assert!(found.is_empty(), "{found:#?}");
    assert!(files > 400, "{files} files");
}

/// A circle through an import, one through a re-export and one through a path in a macro are seen.
#[test]
fn circles_are_seen() {
    let module = |text: &str| {
        let mut module = Module::default();
        module.visit_file(&syn::parse_str(text).unwrap());
        module
    };
    let names = |text: &str| text.split("::").map(str::to_owned).collect::<Names>();
    let sources = |texts: &[(&str, &str)]| {
        let root = (Names::new(), module("mod a; mod b;"));
        let others = texts.iter().map(|(name, text)| (names(name), module(text)));
        Sources(others.chain([root]).collect())
    };
    let found = |texts: &[(&str, &str)]| circles(&sources(texts).dependencies());
    let both = BTreeSet::from([vec!["a".to_owned(), "b".to_owned()]]);
    assert_eq!(
        found(&[("a", "use crate::b::B; struct A;"), ("b", "use super::a::A; struct B;")]),
        both
    );
    assert_eq!(
        found(&[
            ("a", "fn f() { crate::b::B }"),
            ("b", "pub use self::inner::I; struct B;"),
            ("b::inner", "struct I(crate::b::B);"),
        ]),
        BTreeSet::new()
    );
    let in_macro = "fn f() { assert!(x == (crate::a::A)) } struct B;";
    assert_eq!(found(&[("a", "use crate::b::B; struct A;"), ("b", in_macro)]), both);
    let in_test = "#[cfg(test)] mod tests { use crate::a::A; } struct B;";
    assert_eq!(found(&[("a", "use crate::b::B; struct A;"), ("b", in_test)]), BTreeSet::new());
}
