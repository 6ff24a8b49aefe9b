//! The words in which the Model Checking Contest wants to hear how an answer was found.

/// The contest's names of techniques, each once.
pub(crate) fn techniques(used: &[impl AsRef<str>], jobs: usize) -> Vec<&'static str> {
    let mut names = Vec::new();
    for technique in used {
        let name = match technique.as_ref() {
            "initial" => "INITIAL_STATE",
            "structural" => "TOPOLOGICAL",
            "reductions" => "STRUCTURAL_REDUCTION",
            "stubborn" => "STUBBORN_SETS",
            "coverability" => "COVERABILITY",
            "classes" => "STATE_CLASSES",
            _ => "EXPLICIT",
        };
        if !names.contains(&name) {
            names.push(name);
        }
    }
    names.push(if jobs > 1 { "PARALLEL_PROCESSING" } else { "SEQUENTIAL_PROCESSING" });
    names
}

#[cfg(test)]
mod tests {
    use super::techniques;

    #[test]
    fn each_technique_is_named_once() {
        let named =
            techniques(&["structural", "reductions", "structural", "explicit", "temporal"], 1);
        assert_eq!(
            named,
            ["TOPOLOGICAL", "STRUCTURAL_REDUCTION", "EXPLICIT", "SEQUENTIAL_PROCESSING"]
        );
        assert_eq!(techniques(&[""; 0], 2), ["PARALLEL_PROCESSING"]);
    }
}
