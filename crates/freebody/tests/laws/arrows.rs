//! Dependencies point one way: a module of the core uses only modules of the layers below its own.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

/// The layers, lowest first, as `ARCHITECTURE.md` tells them.
const LAYERS: &[&[&str]] = &[
    &["error", "graph", "scalar", "solve", "spec"],
    &["algebra", "benchmark", "expr", "motion", "plane"],
    &["gauges", "joints", "shapes"],
    &["mechanism"],
    &["mode", "bound_values"],
    &["kinematics"],
    &["cables"],
    &["contact"],
    &["builder"],
    &["forces"],
    &["compile"],
    &["dynamics"],
    &["assembly", "metadata", "free_bodies", "hybrid"],
    &["initial", "symbolic"],
];

#[test]
fn a_module_uses_only_what_lies_below_it() {
    let sources = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut modules = BTreeSet::new();
    for entry in fs::read_dir(&sources).expect("the sources").map(|entry| entry.expect("an entry").path()) {
        let module = entry.file_stem().and_then(|name| name.to_str()).expect("a name").to_string();
        if module == "lib" {
            continue;
        }
        let below = LAYERS.iter().take_while(|layer| !layer.contains(&module.as_str())).flat_map(|layer| *layer);
        let below: BTreeSet<&str> = below.copied().collect();
        for (file, line, used) in uses(&entry) {
            assert!(used == module || below.contains(used.as_str()), "{file}:{line}: `{module}` uses `{used}`");
        }
        modules.insert(module);
    }
    let listed: BTreeSet<String> = LAYERS.concat().into_iter().map(str::to_string).collect();
    assert_eq!(listed, modules, "every module has one layer");
}

/// Each `crate::module` in a file, or in those of a folder, with its place; comments left out.
fn uses(path: &Path) -> Vec<(String, usize, String)> {
    if path.is_dir() {
        let inside = fs::read_dir(path).expect("a folder of sources");
        return inside.flat_map(|entry| uses(&entry.expect("an entry").path())).collect();
    }
    let text = fs::read_to_string(path).expect("a source");
    let mut found = vec![];
    for (number, line) in text.lines().enumerate() {
        let code = line.split("//").next().unwrap_or_default();
        for after in code.split("crate::").skip(1) {
            let name: String = after.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
            found.push((path.display().to_string(), number + 1, name));
        }
    }
    found
}
