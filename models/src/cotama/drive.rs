//! Drives of the robot, from a standstill to a standstill.

use cotama_core::units::Millis;

/// How fast the speed changes, in mm/s²: the default of the micro-controller (Pioneer 3-DX,
/// acceleration and deceleration).
pub const ACCELERATION: u64 = 300;
/// How long planning a path takes: assumed.
pub const PLANNING: Millis = Millis(2_000);

/// How long a drive over a way from a standstill takes at a pace in mm/s, in ms: the end stops it.
/// A pace of 0 counts as 1.
///
/// ```
/// use cotama_models::cotama::drive_ms;
/// assert_eq!(drive_ms(3_000, 600), 6_000); // 5 s of way, 1 s to speed up
/// ```
pub const fn drive_ms(way_mm: u64, pace: u64) -> u64 {
    let pace = if pace == 0 { 1 } else { pace };
    let way = way_mm.saturating_mul(1_000) / pace;
    way.saturating_add(pace.saturating_mul(1_000) / (2 * ACCELERATION))
}
