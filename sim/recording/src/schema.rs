//! Types of messages, as ROS 2 Humble defines them.

use std::fmt::Write;

/// The definitions of all types that are written, each under its name.
const DEFINITIONS: &str = include_str!("definitions.msg");

/// Returns the definition of a type, as `nav_msgs/msg/Path`, followed by those of all types that
/// are in it: the text of the schema encoding `ros2msg`.
pub(crate) fn schema(kind: &str) -> String {
    let whole = kind.replacen("/msg/", "/", 1);
    let mut names = vec![whole.as_str()];
    let mut text = String::new();
    let mut done = 0;
    while let Some(name) = names.get(done).copied() {
        let own = definition(name).unwrap_or_default();
        if done > 0 {
            let _ = write!(text, "{}\nMSG: {name}\n", "=".repeat(80));
        }
        text += own;
        text.push('\n');
        let types = own.lines().filter_map(|it| it.split([' ', '[']).next());
        for part in types.filter(|it| it.contains('/')) {
            if !names.contains(&part) {
                names.push(part);
            }
        }
        done += 1;
    }
    text
}

/// Returns the lines of a definition.
fn definition(name: &str) -> Option<&'static str> {
    let all = DEFINITIONS.split("MSG: ").filter_map(|it| it.split_once('\n'));
    { all }.find(|it| it.0 == name).map(|it| it.1.trim_end())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::messages;

    #[test]
    fn a_schema_holds_every_type_that_is_in_it() {
        for kind in messages::KINDS {
            let text = schema(kind);
            assert!(!text.is_empty(), "{kind}");
            for line in text.lines().filter(|it| !it.starts_with("MSG") && !it.contains('=')) {
                let part = line.split([' ', '[']).next().unwrap();
                let there = text.contains(&format!("MSG: {part}\n"));
                assert!(there || !part.contains('/'), "{kind}: {part}");
            }
        }
        let path = schema(messages::PATH);
        assert!(path.starts_with("std_msgs/Header header\ngeometry_msgs/PoseStamped[] poses\n=="));
        assert_eq!(path.matches("MSG: ").count(), 6);
    }
}
