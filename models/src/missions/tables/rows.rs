//! Rows of a printed table, short enough for one line each.
//!
//! ```
//! use cotama_core::hardware::Equipment;
//! use cotama_models::missions::tables::Alternative;
//! use cotama_models::missions::tables::rows::{activity, stand, travel, units};
//! const WAYS: [Alternative; 2] = [travel(410, 18_224, 0x1, 3), stand(8_000, 7_500, 0, 2)];
//! assert_eq!(WAYS[0], Alternative::travelling(410, 18_224, units(0x1), 3));
//! assert_eq!(WAYS[1], Alternative::standing(8_000, 7_500, Equipment::NONE, 2));
//! assert!(activity(0, 31_000, &WAYS).travels());
//! ```

use cotama_core::{hardware::Equipment, units::Millimetres};

use super::{Activity, Alternative};

/// The equipment of these bits, as [`Equipment::from_bits`] takes them.
///
/// # Panics
/// When a count of units passes its field: for a constant, at compile time.
pub const fn units(bits: u64) -> Equipment {
    match Equipment::from_bits(bits) {
        Some(units) => units,
        None => panic!("a count of units passes its field"),
    }
}

/// An activity between two places of the path, both in mm.
pub const fn activity(x_start: u64, x_end: u64, alternatives: &[Alternative]) -> Activity<'_> {
    Activity { x_start: Millimetres(x_start), x_end: Millimetres(x_end), alternatives }
}

/// An alternative that travels: its speed in mm/s, its power in mW, the bits of the equipment that
/// it needs, and its quality for each 100 mm.
///
/// # Panics
/// As [`units`] does.
pub const fn travel(speed_mm_s: u64, power_mw: u64, needs: u64, quality: u32) -> Alternative {
    Alternative::travelling(speed_mm_s, power_mw, units(needs), quality)
}

/// An alternative that stays in its place: its duration in ms, its power in mW, the bits of the
/// equipment that it needs, and its quality.
///
/// # Panics
/// As [`units`] does.
pub const fn stand(duration_ms: u64, power_mw: u64, needs: u64, quality: u32) -> Alternative {
    Alternative::standing(duration_ms, power_mw, units(needs), quality)
}
