//! A requirement of a user's own that fails: what `docs/campaigns.md` shows is what happens.

use std::panic::{AssertUnwindSafe, catch_unwind};

const PAGE: &str = include_str!("../../../../docs/campaigns.md");

mod user {
    use cotama_campaign::testing::CampaignTest;
    use cotama_models::missions::{Mission, embedded};

    pub(super) fn a_delivery_ends_within_its_limits_whatever_fails() {
        let delivery = embedded::mission("delivery").unwrap();
        let mission = Mission::parse(delivery.name, delivery.text).unwrap();
        let test = CampaignTest::new(&mission).runs(5_000);
        test.requires("not-failed");
    }
}

/// The lines from this one to a line `}`, moved to the left.
fn source_from(first: &str) -> String {
    let source = include_str!("own.rs");
    let from = source.lines().skip_while(|it| !it.contains(first));
    let (mut lines, mut ended) = (String::new(), false);
    for line in from.take_while(|it| !std::mem::replace(&mut ended, *it == "    }")) {
        lines += line.strip_prefix("    ").unwrap_or(line);
        lines.push('\n');
    }
    lines.replace("pub(super) ", "")
}

#[test]
fn the_page_shows_a_requirement_that_fails_and_the_message_of_its_test() {
    let failed =
        catch_unwind(AssertUnwindSafe(user::a_delivery_ends_within_its_limits_whatever_fails));
    let said = failed.unwrap_err().downcast::<String>().unwrap();
    println!("{said}");
    let (first, file) = said.split_once("format =").unwrap();
    assert!(PAGE.contains(&source_from("fn a_delivery")), "{}", source_from("fn a_delivery"));
    assert!(PAGE.contains(first), "the page does not show\n{first}");
    let block = format!("```toml weak.toml\nformat ={file}```\n");
    assert!(PAGE.contains(&block), "the page does not show\n{block}");
}
