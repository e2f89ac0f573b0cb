//! Dependencies point one way: a module of the core uses only modules of the layers below its own, and within a folder no
//! file comes back to itself by what it uses.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

/// The layers, lowest first, as `ARCHITECTURE.md` tells them.
const LAYERS: &[&[&str]] = &[
    &["error", "graph", "scalar", "solve", "spec"],
    &["algebra", "benchmark", "expr", "motion", "plane", "series"],
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
    &["batch", "initial", "symbolic"],
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

#[test]
fn within_a_folder_no_file_comes_back_to_itself() {
    let mut folders = vec![Path::new(env!("CARGO_MANIFEST_DIR")).join("src")];
    while let Some(folder) = folders.pop() {
        let mut files = BTreeMap::new();
        for path in fs::read_dir(&folder).expect("a folder of sources").map(|entry| entry.expect("an entry").path()) {
            if path.is_dir() {
                folders.push(path);
            } else if path.file_stem().is_some_and(|name| name != "mod" && name != "lib") {
                files.insert(
                    path.file_stem().and_then(|name| name.to_str()).expect("a name").to_string(),
                    siblings(&path),
                );
            }
        }
        // Of files without a circle there is always one that uses none of those that are left.
        while let Some(last) = files.keys().find(|file| files[*file].iter().all(|used| !files.contains_key(used))) {
            let last = last.clone();
            files.remove(&last);
        }
        assert!(files.is_empty(), "{}: a circle among {:?}", folder.display(), files.keys().collect::<Vec<_>>());
    }
}

/// What a file names where it takes something from the files beside it.
fn siblings(path: &Path) -> Vec<String> {
    let text = fs::read_to_string(path).expect("a source");
    let imports = text.split("use super::").skip(1).filter(|import| !import.starts_with("super"));
    let imports = imports.filter_map(|import| import.split(';').next());
    imports.flat_map(|import| import.split(|c: char| !c.is_alphanumeric() && c != '_')).map(str::to_string).collect()
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
