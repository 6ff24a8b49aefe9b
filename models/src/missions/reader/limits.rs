//! The limits of a mission file, changed in its text.

use std::cmp::Reverse;
use toml::de::DeTable;

/// Returns the text of a mission file with other limits on duration and energy, where given, and
/// nothing else changed; the text itself when it has no limits. Of a mission with axes they are
/// goals of constraints, by index.
pub(crate) fn with_limits(
    text: &str,
    limits: [Option<u64>; 2],
    constraints: Option<[Option<usize>; 2]>,
) -> String {
    let mut changed = text.to_owned();
    let Ok(file) = DeTable::parse(text) else { return changed };
    let written = |axis: usize, key: &str| {
        let Some(constraints) = constraints else {
            return Some(file.get_ref().get("limits")?.get_ref().get(key)?.span());
        };
        let all = file.get_ref().get("constraint")?.get_ref().as_array()?;
        Some(all.get(constraints[axis]?)?.get_ref().get("goal")?.span())
    };
    let keys = ["duration_ms", "energy_mj"].into_iter().enumerate().zip(limits);
    let edits = keys.filter_map(|((axis, key), limit)| Some((written(axis, key)?, limit?)));
    let mut edits: Vec<_> = edits.collect();
    // The later one first, so that the place of the other stays right.
    edits.sort_by_key(|(span, _)| Reverse(span.start));
    for (span, limit) in edits {
        changed.replace_range(span, &limit.to_string());
    }
    changed
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::missions::embedded;

    #[test]
    fn limits_are_changed_in_their_place_and_nothing_else() {
        let patrol = embedded::mission("patrol").unwrap().text;
        let changed = with_limits(patrol, [Some(1), Some(2)], None);
        let expected = patrol.replacen("duration_ms = 600000", "duration_ms = 1", 1).replacen(
            "= 8640000",
            "= 2",
            1,
        );
        assert_eq!(changed, expected);
        let inline = "limits = { energy_mj = 0x10, duration_ms = 1_0 } # 1_0";
        let changed = with_limits(inline, [Some(77), None], None);
        assert_eq!(changed, "limits = { energy_mj = 0x10, duration_ms = 77 } # 1_0");
    }
}
