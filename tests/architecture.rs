//! The rules of ARCHITECTURE.md for modules, libraries and names, read off the sources.

use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};

/// The levels of the modules, by path, read off the table in the documentation of `src/lib.rs`.
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

/// The module of the table that `path` is in: the longest that it begins with.
fn listed<'a>(levels: &'a HashMap<String, u32>, path: &str) -> Option<(&'a str, u32)> {
    let within = |module: &str| path == module || path.starts_with(&format!("{module}::"));
    let found = levels.iter().filter(|(module, _)| within(module));
    found.max_by_key(|(module, _)| module.len()).map(|(module, &level)| (module.as_str(), level))
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

/// `src/physics/vector.rs` is `physics::vector`, `src/physics/drum/mod.rs` is `physics::drum`.
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

/// The paths that a source mentions as `crate::…`.
fn imports(path: &Path) -> Vec<String> {
    let code = code_of(path);
    assert!(!code.contains("crate::{"), "{} imports in braces, which this test cannot read", path.display());
    let is_path = |c: char| c.is_alphanumeric() || c == '_' || c == ':';
    let name = |rest: &str| rest.chars().take_while(|&c| is_path(c)).collect::<String>();
    code.split("crate::").skip(1).map(|rest| name(rest).trim_end_matches(':').to_owned()).collect()
}

#[test]
fn modules_import_from_lower_levels_only() {
    let levels = levels();
    let mut seen = 0;
    for path in sources(Path::new("src"), "rs") {
        let module = module_of(&path);
        let Some((own, level)) = listed(&levels, &module) else {
            let code = code_of(&path);
            let is_folder = code.lines().all(|line| {
                let line = line.trim();
                line.is_empty() || line.starts_with("pub mod ")
            });
            assert!(module == "lib" || is_folder, "{module} has no level in src/lib.rs");
            continue;
        };
        for import in imports(&path) {
            // What is not a module is a constant of the root.
            let Some((other, low)) = listed(&levels, &import) else {
                let top = import.split("::").next().unwrap_or_default();
                assert!(top == "PHYSICS_VERSION", "{module} imports {import}, which has no level");
                continue;
            };
            if other != own {
                assert!(low < level, "{module} (level {level}) imports {import} (level {low})");
                seen += 1;
            }
        }
    }
    assert!(seen > 80, "only {seen} imports were found");
}

/// What happens knows nothing of how it is made fast.
#[test]
fn physics_knows_no_engine() {
    for path in sources(Path::new("src/physics"), "rs") {
        let code = code_of(&path);
        let words: Vec<&str> = code.split(|c: char| !(c.is_alphanumeric() || c == '_')).collect();
        for word in ["engine", "wide", "rayon", "simd", "F64x4", "LANES", "CHUNK", "chunk_count", "Threads"] {
            assert!(!words.contains(&word), "{} mentions {word}", path.display());
        }
    }
}

/// The words that declare a name, and the name.
fn declared(code: &str) -> Vec<(&str, &str)> {
    let mut words = code.split(|c: char| !(c.is_alphanumeric() || c == '_')).filter(|word| !word.is_empty());
    let (mut found, mut last) = (Vec::new(), "");
    for word in &mut words {
        if ["fn", "struct", "enum", "trait", "type", "mod", "const", "static"].contains(&last) {
            found.push((last, word));
        }
        last = word;
    }
    found
}

/// A name means one thing.
#[test]
fn no_public_type_is_declared_twice() {
    let mut places: HashMap<String, String> = HashMap::new();
    for path in sources(Path::new("src"), "rs") {
        let module = module_of(&path);
        // The class that Python sees bears the name of what it holds.
        if module.starts_with("python") {
            continue;
        }
        for line in code_of(&path).lines().filter(|line| line.trim_start().starts_with("pub")) {
            let Some((_, name)) = declared(line)
                .into_iter()
                .find(|(kind, _)| ["struct", "enum", "trait", "type"].contains(kind))
            else {
                continue;
            };
            // A type of a trait is no type of its own.
            if line.starts_with("    ") && line.trim_start().starts_with("pub type") {
                continue;
            }
            if let Some(other) = places.insert(name.to_owned(), module.clone()) {
                panic!("{name} is declared in {other} and in {module}");
            }
        }
    }
    assert!(places.len() > 60, "only {} types were found", places.len());
}

/// Names that once stood for something else: the left column of the vocabulary, where it is unambiguous.
const FORMER_TYPES: &[&str] = &[
    "Ahead",
    "Balance",
    "Board",
    "Campaign",
    "Copies",
    "Delivery",
    "Elsewhere",
    "Ends",
    "Entry",
    "Fixed",
    "Fresh",
    "Held",
    "Instant",
    "Journey",
    "Known",
    "Lanes",
    "Matter",
    "Meeting",
    "Met",
    "Meter",
    "Needs",
    "Nobody",
    "Place",
    "PostOffice",
    "Pull",
    "Rest",
    "Row",
    "Scene",
    "Score",
    "Sink",
    "SlotLaw",
    "Slots",
    "Surroundings",
    "Sweep",
    "Traits",
];
const FORMER_FUNCTIONS: &[&str] = &[
    "abroad",
    "along_curve",
    "arrive",
    "ask_for",
    "blockers",
    "hand_over",
    "heir",
    "keep_list",
    "look",
    "meet",
    "pace",
    "parting",
    "parting_speed",
    "pass_on",
    "pull",
    "run_here",
    "run_on",
    "seen",
    "settle",
    "share_since_touch",
    "show",
    "spin_rate",
    "twist",
];
const FORMER_MODULES: &[&str] = &[
    "ahead",
    "blockers",
    "bodies",
    "cache",
    "fit",
    "gate",
    "heir",
    "lanes",
    "laws",
    "motions",
    "order",
    "patch",
    "post",
    "side",
    "sight",
    "slots",
    "start",
    "sweep",
    "threads",
    "turnstile",
];

#[test]
fn names_are_those_of_the_vocabulary() {
    for path in sources(Path::new("src"), "rs") {
        let (module, code) = (module_of(&path), code_of(&path));
        for part in module.split("::") {
            assert!(!FORMER_MODULES.contains(&part), "{module}: not {part}");
        }
        for (kind, name) in declared(&code) {
            let former = match kind {
                "fn" => FORMER_FUNCTIONS,
                "mod" => FORMER_MODULES,
                _ => FORMER_TYPES,
            };
            assert!(
                !former.contains(&name),
                "{module} declares {kind} {name}, which the vocabulary calls otherwise"
            );
        }
    }
}

#[test]
fn libraries_stay_where_they_belong() {
    let owners: &[(&str, &[&str])] = &[
        ("pyo3", &["python"]),
        ("numpy", &["python"]),
        ("parry2d", &["physics::drum"]),
        ("rayon", &["engine::parallel"]),
        ("wide", &["engine"]),
        ("bytemuck", &["engine"]),
        ("std::arch", &["engine", "python"]),
        ("std::thread", &["python"]),
        ("std::fs", &[]),
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

/// Import-linter, which checks the layers of the Python package, does not see the compiled core.
#[test]
fn few_python_modules_import_the_core() {
    for path in sources(Path::new("python/drumrs"), "py") {
        let code = fs::read_to_string(&path).expect("a source");
        let imports = code.lines().map(str::trim_start).any(|line| {
            let mut words = line.split(|c: char| !(c.is_alphanumeric() || c == '_'));
            (line.starts_with("from ") || line.starts_with("import ")) && words.any(|word| word == "_core")
        });
        let may = [
            "cores.py",
            "simulation.py",
            "registry.py",
            "jobs.py",
            "config/derived.py",
            "analysis/blocks.py",
        ]
        .iter()
        .any(|end| path.ends_with(end));
        assert!(!imports || may, "{} imports _core", path.display());
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
