//! Numbers of an analysis, by themselves.

#[path = "../../src/fmeca/reader/amount.rs"]
mod amount;

use amount::thousandths;

#[test]
fn numbers_are_read_exactly_or_not_at_all() {
    let read = ["400", "0.2", "0.001", "1.2e6", "1e-3", "4.50", "0", "1_000", "5000e-4", "0e99"];
    let read: Vec<_> = read.into_iter().map(thousandths).collect();
    let some = [400_000, 200, 1, 1_200_000_000, 1, 4500, 0, 1_000_000, 500, 0].map(Some);
    assert_eq!(read, some);
    for wrong in ["", ".", "-1", "+1", "1,5", "0.0001", "1e-4", "nan", "1e30", "0x10", "e3"] {
        assert_eq!(thousandths(wrong), None, "{wrong}");
    }
}
