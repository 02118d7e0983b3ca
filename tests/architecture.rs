//! The import rules of ARCHITECTURE.md, read off the sources.

use std::fs;
use std::path::{Path, PathBuf};

/// Modules by level; a module imports only from lower levels, or from its own folder.
const LEVELS: &[(&str, u32)] = &[
    ("vector", 0),
    ("error", 0),
    ("threads", 1),
    ("particles", 2),
    ("drum", 1),
    ("contact", 1),
    ("contact::laws", 1),
    ("contact::linear", 1),
    ("contact::table", 2),
    ("config", 2),
    ("neighbors", 3),
    ("energy", 2),
    ("packing", 3),
    ("integrator", 2),
    ("forces", 3),
    ("recorder", 3),
    ("start", 3),
    ("summary", 4),
    ("state", 4),
    ("simulation", 5),
    ("checkpoint", 6),
    ("python", 7),
];

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

fn level_of(module: &str) -> Option<u32> {
    let matches =
        LEVELS.iter().filter(|(name, _)| module == *name || module.starts_with(&format!("{name}::")));
    matches.max_by_key(|(name, _)| name.len()).map(|(_, level)| *level)
}

/// The `crate::…` paths that a source mentions outside of comments and its tests.
fn imports(text: &str) -> Vec<String> {
    let code = text.split("#[cfg(test)]").next().unwrap_or(text);
    code.lines()
        .filter(|line| !line.trim_start().starts_with("//"))
        .flat_map(|line| line.split("crate::").skip(1))
        .map(|rest| {
            let path: String =
                rest.chars().take_while(|c| c.is_alphanumeric() || *c == '_' || *c == ':').collect();
            path.trim_end_matches(':').to_owned()
        })
        .collect()
}

#[test]
fn modules_import_from_lower_levels_only() {
    let mut seen = 0;
    for path in sources(Path::new("src"), "rs") {
        let module = module_of(&path);
        let Some(level) = level_of(&module) else {
            assert_eq!(module, "lib", "{module} has no level");
            continue;
        };
        let top = module.split("::").next().unwrap_or_default();
        for import in imports(&fs::read_to_string(&path).expect("a source")) {
            let Some(other) = level_of(&import) else { continue };
            let same_folder = import.split("::").next() == Some(top);
            assert!(
                same_folder || other < level,
                "{module} (level {level}) imports {import} (level {other})"
            );
            seen += 1;
        }
    }
    assert!(seen > 50, "only {seen} imports were found");
}

#[test]
fn libraries_stay_where_they_belong() {
    let owners: &[(&str, &[&str])] = &[
        ("pyo3", &["python"]),
        ("numpy", &["python"]),
        ("parry2d", &["drum"]),
        ("rayon", &["threads"]),
        ("std::fs", &["checkpoint"]),
        ("std::time", &["python"]),
        ("std::env", &["python"]),
        ("HashMap", &[]),
        ("sha2", &["checkpoint"]),
    ];
    for path in sources(Path::new("src"), "rs") {
        let module = module_of(&path);
        let text = fs::read_to_string(&path).expect("a source");
        let code =
            text.lines().filter(|line| !line.trim_start().starts_with("//")).collect::<Vec<_>>().join("\n");
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
                    && words().any(|word| word == name || word.trim_start_matches("drumrs.") == name)
            })
        };
        if inside != "simulation.py" {
            assert!(!imports("_core"), "{inside} imports _core; only simulation.py may");
        }
        if inside != "__main__.py" && inside != "__init__.py" {
            assert!(!imports("cli"), "{inside} imports the command line");
        }
        if inside.starts_with("figures") || inside.starts_with("analysis") {
            assert!(!imports("simulation"), "{inside} sees a Simulation");
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
