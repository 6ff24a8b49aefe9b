//! Names that are unique, from those of a file, which need not be.

use std::collections::HashSet;

/// The names of some objects, made unique: of those that share a name the first one keeps it, the
/// others are named `name (id)`, and `name (id) (id)` and so on where that is taken too.
pub(super) fn unique<'a>(objects: impl Iterator<Item = (&'a str, &'a str)> + Clone) -> Vec<String> {
    let mut given = HashSet::with_capacity(objects.size_hint().0);
    let first: Vec<bool> = objects.clone().map(|(name, _)| given.insert(name)).collect();
    let mut added = HashSet::new();
    let rename = |((name, id), first): ((&str, &str), bool)| {
        let mut name = name.to_owned();
        if !first {
            while given.contains(name.as_str()) || added.contains(&name) {
                name = format!("{name} ({id})");
            }
            added.insert(name.clone());
        }
        name
    };
    objects.zip(first).map(rename).collect()
}
