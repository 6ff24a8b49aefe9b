//! The options of `cotama run` for teams.

use super::number::whole;
use clap::{Args, ValueEnum};
use cotama_models::team::scenario::{MAX_ROBOTS, Method, Trust};

#[derive(Args, Clone, Debug)]
pub(crate) struct TeamArgs {
    /// How many messages of a team get lost, in percent, with at most one decimal [default: 5 for
    /// `fleet`, 0 for `service`]
    #[arg(long, value_name = "PERCENT", value_parser = loss)]
    pub(crate) loss: Option<u16>,
    /// How many robots the scenario `fleet` has [default: 40]
    #[arg(long, value_name = "N", value_parser = whole(1, MAX_ROBOTS as u64))]
    pub(crate) robots: Option<u64>,
    /// How many deliveries the fleet has [default: 200]
    #[arg(long, value_name = "N", value_parser = whole(1, 2_000))]
    pub(crate) tasks: Option<u64>,
    /// How many robots of the fleet fail for good; as many others have a lesser failure [default:
    /// 5, but at most an eighth of the robots]
    #[arg(long, value_name = "N", value_parser = whole(0, MAX_ROBOTS as u64))]
    pub(crate) failures: Option<u64>,
    /// The first robot of the fleet gives tasks out, not a desk, and so many times whoever does
    /// then fails, and the next robot takes over; 0 for never
    #[arg(long, value_name = "N", value_parser = whole(0, MAX_ROBOTS as u64))]
    pub(crate) kills: Option<u64>,
    /// How often the gripper of the first robot of the fleet fails, in percent, with at most one
    /// decimal: grippers then take and give for a minute, and ten uses of each went well before
    #[arg(long, value_name = "PERCENT", value_parser = share)]
    pub(crate) gripper: Option<u16>,
    /// What bids take the reliability of skills to be [default: as the file of the team says;
    /// learned]
    #[arg(long, value_enum, value_name = "WHAT", hide_possible_values = false)]
    pub(crate) trust: Option<Trusted>,
    /// How tasks are given to the robots of a team [default: as its file says; optimal]
    #[arg(long, value_enum, value_name = "HOW", hide_possible_values = false)]
    pub(crate) allocation: Option<Allocation>,
    /// Runs so many seeds of a team with each allocation, or what else `--compare` names, and
    /// compares; no report is written
    #[arg(long, value_name = "N", value_parser = whole(2, 100_000), conflicts_with = "report")]
    #[arg(conflicts_with = "trace")]
    pub(crate) seeds: Option<u64>,
    /// What differs where many seeds are compared
    #[arg(long, value_enum, value_name = "WHAT", default_value_t, requires = "seeds")]
    #[arg(hide_possible_values = false)]
    pub(crate) compare: Compare,
    /// The cup of the scenario `service` stands so that two fingers cannot grasp it
    #[arg(long)]
    pub(crate) hidden_handle: bool,
}

impl TeamArgs {
    /// The first of these options that was given.
    pub(crate) fn first(&self) -> Option<&'static str> {
        let given = [
            ("--loss", self.loss.is_some()),
            ("--hidden-handle", self.hidden_handle),
            ("--allocation", self.allocation.is_some()),
            ("--trust", self.trust.is_some()),
            ("--seeds", self.seeds.is_some()),
        ];
        given.into_iter().find(|it| it.1).map(|it| it.0).or(self.first_of_size())
    }

    /// The first of those that say what the scenario `fleet` is.
    pub(crate) fn first_of_size(&self) -> Option<&'static str> {
        let given = [
            ("--robots", self.robots.is_some()),
            ("--tasks", self.tasks.is_some()),
            ("--failures", self.failures.is_some()),
            ("--kills", self.kills.is_some()),
            ("--gripper", self.gripper.is_some()),
        ];
        given.into_iter().find(|it| it.1).map(|it| it.0)
    }
}

/// How tasks are given to robots.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Allocation {
    /// All open tasks at once, at the least cost
    Optimal,
    /// The rounds of the thesis: one task of several robots after the other, then all of one
    Rounds,
    /// One task after the other, each to who asks least
    OneByOne,
}

impl From<Allocation> for Method {
    fn from(it: Allocation) -> Self {
        match it {
            Allocation::Optimal => Self::Optimal,
            Allocation::Rounds => Self::Rounds,
            Allocation::OneByOne => Self::OneByOne,
        }
    }
}

/// What bids take the reliability of skills to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Trusted {
    /// Nothing ever fails
    Certain,
    /// What the file states, for the whole run
    Stated,
    /// What the file states, and each use since
    Learned,
    /// What is true of the simulated robots, which nobody knows
    Known,
}

impl From<Trusted> for Trust {
    fn from(it: Trusted) -> Self {
        match it {
            Trusted::Certain => Self::Certain,
            Trusted::Stated => Self::Stated,
            Trusted::Learned => Self::Learned,
            Trusted::Known => Self::Known,
        }
    }
}

/// What differs where many seeds are compared.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum Compare {
    /// How tasks are given to robots
    #[default]
    Allocation,
    /// What bids take the reliability of skills to be
    Trust,
}

/// A share in percent with at most one decimal, in thousandths; messages that get lost.
fn loss(text: &str) -> Result<u16, String> {
    permille(text, 50)
}

/// Any share.
fn share(text: &str) -> Result<u16, String> {
    permille(text, 100)
}

fn permille(text: &str, most: u16) -> Result<u16, String> {
    let (whole, tenth) = text.split_once('.').unwrap_or((text, "0"));
    let digits = |it: &str| !it.is_empty() && it.bytes().all(|it| it.is_ascii_digit());
    let number = (digits(whole) && digits(tenth) && tenth.len() == 1)
        .then(|| Some(whole.parse::<u16>().ok()?.checked_mul(10)? + tenth.parse::<u16>().ok()?));
    let number = number.flatten().filter(|it| *it <= most * 10);
    number.ok_or_else(|| format!("a number from 0 to {most} with at most one decimal is needed"))
}

#[cfg(test)]
mod tests {
    use super::loss;

    #[test]
    fn losses_have_at_most_one_decimal() {
        assert_eq!((loss("5"), loss("0.5"), loss("50")), (Ok(50), Ok(5), Ok(500)));
        for wrong in ["", "-1", "50.1", "1.25", "5%", ".5", "5.", "x"] {
            assert!(loss(wrong).is_err(), "{wrong}");
        }
    }
}
