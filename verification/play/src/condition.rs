//! Conditions of arcs in words.

use alloc::borrow::ToOwned;
use alloc::format;
use alloc::string::String;
use cotama_core::net::{Arc, Net, Place, PlaceId, Role};

/// Returns the condition of an arc, as a guard.
pub fn condition(net: &Net<'_>, arc: Arc) -> String {
    let place = |PlaceId(id): PlaceId| net.places.get(id as usize);
    let name = |id| place(id).map_or("?", |it: &Place<'_>| it.name);
    match place(arc.place).map(|it| (it.role, it.bound)) {
        Some((Role::Complement(of), 1)) => format!("!{}", name(of)),
        Some((Role::Complement(of), bound)) => {
            format!("{} <= {}", name(of), bound.saturating_sub(arc.weight))
        }
        _ if arc.weight == 1 => name(arc.place).to_owned(),
        _ => format!("{} >= {}", name(arc.place), arc.weight),
    }
}
