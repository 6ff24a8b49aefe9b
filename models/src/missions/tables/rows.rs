//! Rows of a printed table, short enough for one line each.

use cotama_core::{hardware::Equipment, units::Millimetres};

use super::{Activity, Alternative};

/// The equipment of these bits.
///
/// # Panics
/// When a count of units passes its field: for a constant, at compile time.
#[must_use]
pub const fn units(bits: u64) -> Equipment {
    match Equipment::from_bits(bits) {
        Some(units) => units,
        None => panic!("a count of units passes its field"),
    }
}

/// An activity between two places of the path, in mm.
pub const fn activity(x_start: u64, x_end: u64, alternatives: &[Alternative]) -> Activity<'_> {
    Activity { x_start: Millimetres(x_start), x_end: Millimetres(x_end), alternatives }
}

/// An alternative that travels, with the bits of the equipment that it needs.
pub const fn travel(speed_mm_s: u64, power_mw: u64, needs: u64, quality: u32) -> Alternative {
    Alternative::travelling(speed_mm_s, power_mw, units(needs), quality)
}

/// An alternative that stays in its place, with the bits of the equipment that it needs.
pub const fn stand(duration_ms: u64, power_mw: u64, needs: u64, quality: u32) -> Alternative {
    Alternative::standing(duration_ms, power_mw, units(needs), quality)
}
