//! Motors and batteries that make no sense are refused.

use super::broken::refused;

#[test]
fn motors_without_a_mass_and_batteries_that_are_never_on_are_refused() {
    let body = "[body]\nspeed_max_mm_s = 300\nacceleration_mm_s2 = 300\n\
                motion_power = { c0 = 1, c1 = 1, c2 = 0 }\n";
    let motors = "[body.motors]\nvoltage_mv = 12_000\nno_load_mrad_s = 12_300\n\
                  resistance_mohm = 1_000\nlimit_ma = 8_000\nrolling_permille = 84\n\
                  stall_ms = 100\n";
    let battery = "[body.battery]\ncapacity_mah = 7_200\nfull_mv = 13_000\nempty_mv = 11_100\n\
                   cutoff_mv = 13_000\nresistance_mohm = 10\ncells = 6\n";
    let refused = |text: String| refused("[hardware.base]\n", &(text + "[hardware.base]\n"));
    assert_eq!(
        refused(format!("{body}{motors}")),
        "r.toml:7:1: motors move a mass | help: add `mass_g` to `body`, or leave its `motors` out"
    );
    assert_eq!(
        refused(format!("{body}{battery}")),
        "r.toml:11:13: `cutoff_mv` must be below `full_mv` | help: give a lower voltage, or a \
         higher `full_mv`"
    );
    assert_eq!(
        refused(format!("{body}mass_g = 9_000\n{}", motors.replace("stall_ms = 100\n", ""))),
        "r.toml:8:1: missing key `stall_ms` in `motors` | help: add `stall_ms`"
    );
}
