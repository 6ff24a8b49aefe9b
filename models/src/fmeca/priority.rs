//! Action Priority: which failure mode is to be worked on first, by severity, then occurrence, then
//! detection.

/// The Action Priority of a failure mode (AIAG & VDA FMEA Handbook, 1st edition, 2019, table
/// "Action Priority (AP) for DFMEA and PFMEA"). Neither the handbook nor SAE J1739:2021 was read:
/// two public transcriptions of the table agree where they were read, and with eight rows of a
/// published case (Pop et al., Applied Sciences 16(5):2591, 2026, as one of them quotes it).
///
/// Ranks of severity, occurrence and detection go in as this analysis has them: the table is the
/// handbook's, the scales of the ranks are [ours](super::Criticality).
///
/// ```
/// use cotama_models::fmeca::ActionPriority;
/// // Severe and undetected, but rare: it is looked at, not at first.
/// assert_eq!(ActionPriority::of(10, 1, 10).name(), "L");
/// assert_eq!(ActionPriority::of(10, 2, 10).name(), "H");
/// assert_eq!(ActionPriority::of(7, 3, 6).name(), "M");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ActionPriority {
    /// Better prevention or detection is optional.
    Low,
    /// Prevention or detection is to be improved, or left with a reason.
    Medium,
    /// Prevention or detection has to be improved, or a reason is on record why not.
    High,
}

use ActionPriority::{High as H, Low as L, Medium as M};

/// The table: severity from 9 to 10, 7 to 8, 4 to 6, 2 to 3, and 1; in it occurrence from 8 to 10,
/// 6 to 7, 4 to 5, 2 to 3, and 1; in it detection from 7 to 10, 5 to 6, 2 to 4, and 1.
const TABLE: [[[ActionPriority; 4]; 5]; 5] = [
    [[H, H, H, H], [H, H, H, H], [H, H, H, M], [H, M, L, L], [L, L, L, L]],
    [[H, H, H, H], [H, H, H, M], [H, M, M, M], [M, M, L, L], [L, L, L, L]],
    [[H, H, M, M], [M, M, M, L], [M, L, L, L], [L, L, L, L], [L, L, L, L]],
    [[M, M, L, L], [L, L, L, L], [L, L, L, L], [L, L, L, L], [L, L, L, L]],
    [[L, L, L, L], [L, L, L, L], [L, L, L, L], [L, L, L, L], [L, L, L, L]],
];

impl ActionPriority {
    /// All of them, the best one first.
    pub const ALL: [Self; 3] = [L, M, H];

    /// The priority of ranks from 1 to 10.
    pub fn of(severity: u8, occurrence: u8, detection: u8) -> Self {
        let severity = match severity {
            9.. => 0,
            7..=8 => 1,
            4..=6 => 2,
            2..=3 => 3,
            0..=1 => 4,
        };
        let occurrence = match occurrence {
            8.. => 0,
            6..=7 => 1,
            4..=5 => 2,
            2..=3 => 3,
            0..=1 => 4,
        };
        let detection = match detection {
            7.. => 0,
            5..=6 => 1,
            2..=4 => 2,
            0..=1 => 3,
        };
        TABLE[severity][occurrence][detection]
    }

    /// Returns the letter in print.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Low => "L",
            Self::Medium => "M",
            Self::High => "H",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::ActionPriority;

    /// The rows of a published case (Pop et al., Applied Sciences 16(5):2591, 2026, Tables 2 and 3,
    /// as a public transcription quotes them), and the corners that the handbook is known for.
    #[test]
    fn the_table_gives_the_priorities_of_a_published_case() {
        for (ranks, name) in [
            ((6, 6, 4), "M"),
            ((6, 4, 4), "L"),
            ((6, 6, 2), "M"),
            ((6, 4, 2), "L"),
            ((6, 4, 6), "L"),
            ((7, 6, 6), "H"),
            ((7, 3, 6), "M"),
            ((7, 3, 4), "L"),
            ((10, 2, 2), "L"),
            ((9, 6, 1), "H"),
            ((2, 10, 10), "M"),
            ((1, 10, 10), "L"),
        ] {
            assert_eq!(ActionPriority::of(ranks.0, ranks.1, ranks.2).name(), name, "{ranks:?}");
        }
    }

    #[test]
    fn a_worse_rank_never_lowers_the_priority() {
        let of = ActionPriority::of;
        for s in 1..10 {
            for o in 1..10 {
                for d in 1..10 {
                    let here = of(s, o, d);
                    assert!(of(s + 1, o, d) >= here && of(s, o + 1, d) >= here);
                    assert!(of(s, o, d + 1) >= here);
                }
            }
        }
    }
}
