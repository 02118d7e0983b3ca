//! The import rules of ARCHITECTURE.md, read off the sources.

use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};

/// The levels of the top modules, read off the table in the documentation of `src/lib.rs`.
fn levels() -> HashMap<String, u32> {
    let text = fs::read_to_string("src/lib.rs").expect("the root");
    let mut levels = HashMap::new();
    for row in text.lines().filter_map(|line| line.strip_prefix("//! | ")) {
        let Some(level) = row.split_whitespace().next().and_then(|word| word.parse().ok()) else { continue };
        for module in row.split('`').skip(1).step_by(2) {
            assert_eq!(levels.insert(module.to_owned(), level), None, "{module} is listed twice");
        }
    }
    levels
}

fn sources(folder: &Path, extension: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            found.extend(sources(&path, extension));
        } else if path.extension().is_some_and(|end| end == extension) {
            found.push(path);
        }
    }
    found
}

/// `src/contact/table.rs` is `contact::table`, `src/drum/mod.rs` is `drum`.
fn module_of(path: &Path) -> String {
    let inside = path.strip_prefix("src").unwrap_or(path).with_extension("");
    let parts: Vec<_> = inside.iter().map(|part| part.to_string_lossy().into_owned()).collect();
    let parts =
        if parts.last().is_some_and(|last| last == "mod") { &parts[..parts.len() - 1] } else { &parts[..] };
    parts.join("::")
}

/// Code without its comments and without the tests at its end.
fn code_of(path: &Path) -> String {
    let text = fs::read_to_string(path).expect("a source");
    let code = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or(&text);
    code.lines().filter(|line| !line.trim_start().starts_with("//")).collect::<Vec<_>>().join("\n")
}

/// The top modules that a source mentions as `crate::…`.
fn imports(path: &Path) -> Vec<String> {
    let code = code_of(path);
    assert!(!code.contains("crate::{"), "{} imports in braces, which this test cannot read", path.display());
    let name = |rest: &str| rest.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
    code.split("crate::").skip(1).map(name).collect()
}

#[test]
fn modules_import_from_lower_levels_only() {
    let levels = levels();
    let mut seen = 0;
    for path in sources(Path::new("src"), "rs") {
        let module = module_of(&path);
        let top = module.split("::").next().unwrap_or_default().to_owned();
        if top == "lib" {
            continue;
        }
        let level = levels.get(&top).unwrap_or_else(|| panic!("{top} has no level in src/lib.rs"));
        for import in imports(&path).iter().filter(|import| **import != top) {
            // What is not a module is a constant of the root.
            let Some(other) = levels.get(import) else { continue };
            assert!(other < level, "{module} (level {level}) imports {import} (level {other})");
            seen += 1;
        }
    }
    assert!(seen > 80, "only {seen} imports were found");
}

#[test]
fn libraries_stay_where_they_belong() {
    let owners: &[(&str, &[&str])] = &[
        ("pyo3", &["python"]),
        ("numpy", &["python"]),
        ("parry2d", &["physics::drum"]),
        ("rayon", &["threads"]),
        ("std::fs", &["io::checkpoint"]),
        ("std::time", &["python"]),
        ("std::env", &["python"]),
        ("HashMap", &[]),
        ("sha2", &["io::checkpoint"]),
    ];
    for path in sources(Path::new("src"), "rs") {
        let module = module_of(&path);
        let code = code_of(&path);
        for (library, modules) in owners {
            let mentions = code.contains(&format!("{library}::")) || code.contains(&format!("use {library}"));
            let allowed =
                modules.iter().any(|owner| module == *owner || module.starts_with(&format!("{owner}::")));
            assert!(!mentions || allowed, "{module} uses {library}");
        }
    }
}

#[test]
fn python_keeps_to_its_own_rules() {
    let text = |path: &Path| fs::read_to_string(path).expect("a source");
    for path in sources(Path::new("python/drumrs"), "py") {
        let inside =
            path.strip_prefix("python/drumrs").expect("inside the package").to_string_lossy().into_owned();
        let code = text(&path);
        let imports = |name: &str| {
            code.lines().any(|line| {
                let line = line.trim_start();
                let words = || line.split(|c: char| !(c.is_alphanumeric() || c == '_' || c == '.'));
                (line.starts_with("from ") || line.starts_with("import "))
                    && words().any(|word| word.trim_start_matches("drumrs.").split('.').next() == Some(name))
            })
        };
        if inside != "simulation.py" {
            assert!(!imports("_core"), "{inside} imports _core; only simulation.py may");
        }
        if inside != "__main__.py" && !inside.starts_with("cli/") {
            assert!(!imports("cli"), "{inside} imports the command line");
        }
        if ["figures", "analysis", "study", "viewer"].iter().any(|seer| inside.starts_with(seer)) {
            assert!(!imports("simulation"), "{inside} sees a Simulation");
        }
        if inside.starts_with("sweep") {
            let painters = ["figures", "study", "report", "viewer"];
            assert!(!painters.iter().any(|name| imports(name)), "{inside} knows what is made of its results");
        }
    }
}

#[test]
fn files_stay_short() {
    for folder in ["src", "tests", "benches", "python", "examples"] {
        for extension in ["rs", "py"] {
            for path in sources(Path::new(folder), extension) {
                let lines = fs::read_to_string(&path).expect("a source").lines().count();
                assert!(lines <= 450, "{} has {lines} lines", path.display());
            }
        }
    }
}
