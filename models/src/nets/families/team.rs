use super::{Draft, Family};
use crate::team::protocol::{self, TEXT, Team};

/// A team that agrees on who does which task: `n` robots, two tasks, `n - 2` failures, at least
/// one.
pub const TEAM: Family = Family {
    name: "team",
    description: "Robots agree by messages on who does which of two tasks; n - 2 of them fail, or \
                  one.",
    least: 2,
    most: protocol::MOST_ROBOTS as u32,
    grow: |net, n| grow(net, &team(n).without_old_messages()),
};

/// The same, with what is in the air of older rounds.
pub const TEAM_OLD: Family = Family {
    name: "team_old",
    description: "The team, with messages of older rounds in the air.",
    grow: |net, n| grow(net, &team(n)),
    ..TEAM
};

/// The same as the text of the thesis has it.
pub const TEAM_TEXT: Family = Family {
    name: "team_text",
    description: "The team as the thesis's text has it: no deadlines, no releases, no copies of \
                  tasks, acknowledgements without a round.",
    grow: |net, n| grow(net, &team(n).with(TEXT)),
    ..TEAM
};

fn team(n: u32) -> Team {
    Team::new(n as usize, n.saturating_sub(2).max(1))
}

fn grow(draft: &mut Draft, team: &Team) {
    let net = protocol::net(team);
    draft.net.places = net.places;
    draft.net.transitions = net.transitions;
    draft.net.laws = net.laws;
}
