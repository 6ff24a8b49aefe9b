//! Broken files and what is said about them. The messages are in `tests/golden/tina/broken.txt`;
//! `UPDATE_GOLDEN=1 cargo test -p cotama-verification --test engines tpn` writes them again.

use cotama_verification::tina;
use std::fmt::Write as _;

/// A name for each broken file, and what it holds.
const FILES: &[(&str, &[u8])] = &[
    ("not_text", b"pl a\npl \xff"),
    ("another_format", b"<?xml version=\"1.0\"?>"),
    ("no_keyword", b"net n\nplace a"),
    ("a_number_first", b"7"),
    ("wrong_character", b"pl a.b"),
    ("hyphen", b"tr t a-b -> c"),
    ("control_character", b"pl a\x1b[31m"),
    ("name_missing", b"pl a\npl"),
    ("name_is_a_keyword", b"pl a\ntr pl a -> b"),
    ("name_not_closed", b"pl {a b\npl c"),
    ("name_with_a_brace", b"pl {a{b}"),
    ("name_with_a_backslash", b"pl {a\\b}"),
    ("label_missing", b"pl a : (1)"),
    ("tokens_missing", b"pl a ()"),
    ("tokens_not_closed", b"pl a (1\npl b"),
    ("tokens_negative", b"pl a (-1)"),
    ("tokens_too_many", b"pl a (4294967296)"),
    ("tokens_too_many_with_a_letter", b"pl a (5G)"),
    ("tokens_beyond_64_bits", b"pl a (99999999999999999999)"),
    ("tokens_with_two_letters", b"pl a (1KK)"),
    ("tokens_sum", b"pl a (4G)\npl a (4G)"),
    ("arc_at_a_place", b"pl a (1) t -> u"),
    ("interval_with_a_comma_missing", b"tr t [1 2] a -> b"),
    ("interval_not_closed", b"tr t [1,2 a -> b"),
    ("interval_with_a_letter", b"tr t [1K,2K] a -> b"),
    ("interval_negative", b"tr t [-1,2] a -> b"),
    ("interval_with_a_fraction", b"tr t [1.5,2] a -> b"),
    ("interval_from_infinity", b"tr t [w,w[ a -> b"),
    ("interval_to_closed_infinity", b"tr t [1,w] a -> b"),
    ("interval_backwards", b"tr t [5,4] a -> b"),
    ("interval_without_a_point", b"tr t\n  ]3,3] a -> b"),
    ("interval_too_large", b"tr t [0,288230376151711744] a -> b"),
    ("intervals_that_do_not_meet", b"tr t [0,2] a -> b\ntr t [3,4]"),
    ("interval_after_the_arcs", b"tr t a -> b [1,2]"),
    ("arrow_missing", b"tr t a b\npl c"),
    ("two_arrows", b"tr t a -> b -> c"),
    ("weight_missing", b"tr t a* -> b"),
    ("weight_is_a_name", b"tr t a*n -> b"),
    ("read_without_weight", b"tr t a? -> b"),
    ("read_as_output", b"tr t a -> b?1"),
    ("weights_sum", b"tr t a*4G a*4G -> b"),
    ("inhibitor", "tr t {größer}?-1 -> b".as_bytes()),
    ("stopwatch", b"tr t a!1 -> b"),
    ("priorities", b"pl a\npr t > u"),
    ("labels", b"lb a b"),
    ("note_without_a_kind", b"nt note 2 text"),
    ("note_without_a_text", b"nt note 0"),
];

#[test]
fn every_refusal_gives_cause_position_and_remedy() {
    let mut messages = String::new();
    for (name, bytes) in FILES {
        let error = tina::read(&format!("{name}.net"), bytes).expect_err(name);
        writeln!(messages, "{error}\n").unwrap();
    }
    cotama_golden::compare("tests/golden/tina/broken.txt", &messages);
}
