//! Failure modes, effects and criticality analysis (FMECA) of the delivery robot: what can fail,
//! how it shows, how severe it is, and what is done.
//!
//! The method is that of Durand, Godary-Dejean, Lapierre, Crestani, IROS 2010, and Durand et al.,
//! TAROS 2010, Section IV. The rows are the project's own: those marked as seed rules follow TAROS
//! 2010, the others fill the same form; rates are assumed but where [`Description::rate_label`]
//! says otherwise. Firmware links [`RULES`] alone, the texts stand apart in [`TEXTS`].

use super::flags::Flags;
use super::fmeca_table::{FailureMode, RULES, TEXTS};
use super::health::Health;
use super::label::Label;
use super::modules::{Module, Modules};
use super::report::{Class, Report};
use super::resources::Resources;
use super::severity::{Severity, by_availability};
use super::situation::Situation;
use core::fmt::{self, Write};

/// How long a fault stays.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Persistence {
    /// Until repaired.
    Permanent,
    /// It passes.
    Transient,
    /// It comes and goes.
    Intermittent,
}

/// How a failure mode shows (inferred from its detection and its effect): it is possible while the
/// flags raised are all of `always` and some of `sometimes`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Signature {
    /// Flags that it always raises; none when nothing of the architecture sees it.
    pub always: Flags,
    /// Flags that it may raise too: effects that depend on the place, and detections of which one
    /// is enough.
    pub sometimes: Flags,
    /// It can only happen, or only matters, while these modules are available.
    pub present: Modules,
    /// It can only happen while these modules are not.
    pub absent: Modules,
}

/// What reacts to a failure mode needs to know of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rule {
    /// The row.
    pub mode: FailureMode,
    /// Modules that are faulty with it.
    pub faulty: Modules,
    /// Whether it is a fault of one module, whichever it is.
    pub one_module: bool,
    /// Resources that are lost with it.
    pub lost: Resources,
    /// Severity while the robot drives itself.
    pub autonomous: Severity,
    /// Severity while the operator drives.
    pub operator: Severity,
    /// The class of its event while the robot drives itself.
    pub class: Class,
    /// How long it stays.
    pub persistence: Persistence,
    /// How long its detection takes, in milliseconds.
    pub latency_ms: u32,
    /// How it shows.
    pub signature: Signature,
    /// The report to the contextual supervisor; none for what is recorded only. A report means in
    /// each mode what [`decide`](super::decide) says. Hard faults without a report of their own ask
    /// for judgement: [`Report::Ambiguous`] (inferred).
    pub report: Option<Report>,
}

/// The words of a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Description {
    /// The function that suffers.
    pub function: &'static str,
    /// The component that fails.
    pub component: &'static str,
    /// How it fails.
    pub failure: &'static str,
    /// Why.
    pub cause: &'static str,
    /// With what effect.
    pub effect: &'static str,
    /// Modules lost, in words.
    pub modules: &'static str,
    /// Who sees it, in words.
    pub observer: &'static str,
    /// How it is seen.
    pub detection: &'static str,
    /// Why nothing of the architecture sees it, where nothing does.
    pub silent: Option<&'static str>,
    /// What is done.
    pub reaction: &'static str,
    /// Mean time between failures, in thousandths of an hour.
    pub mtbf_mh: u32,
    /// How well the rate is known; stated: by a data sheet.
    pub rate_label: Label,
    /// Where the rate comes from.
    pub rate: &'static str,
    /// How the fault is injected in simulation.
    pub injection: &'static str,
}

impl FailureMode {
    /// What reacts to it needs to know.
    pub const fn rule(self) -> &'static Rule {
        &RULES[self as usize]
    }

    /// Its words.
    pub const fn description(self) -> &'static Description {
        &TEXTS[self as usize]
    }

    /// What is broken with it; `part` is the module of a fault of one module, and does not matter
    /// else.
    pub const fn health(self, part: Modules) -> Health {
        let rule = self.rule();
        let faulty = if rule.one_module { part } else { rule.faulty };
        Health { faulty, lost: rule.lost, suspected: Modules::NONE }
    }

    /// Its class by the two rules of [`by_rules`](super::by_rules): the worse of severity and what
    /// is left available, and global where the operator is needed and cannot be reached.
    ///
    /// ```
    /// use cotama_models::cotama::{Class, FailureMode, Modules, Situation, local, path_following};
    /// let driving = Situation {
    ///     local: local::State::Following,
    ///     following: path_following::State::Optimal,
    ///     ..Situation::AT_REST
    /// };
    /// // An encoder is "hard" in the table, but every configuration needs NAV.
    /// assert_eq!(FailureMode::Odo1.rule().class, Class::Local);
    /// assert_eq!(FailureMode::Odo1.effective(Modules::NONE, driving), Class::Global);
    /// ```
    pub const fn effective(self, part: Modules, situation: Situation) -> Class {
        use super::configurations::Mode::{Autonomous, Rest};
        let rule = self.rule();
        let severity = if matches!(situation.mode(), Autonomous | Rest) {
            rule.autonomous
        } else {
            rule.operator
        };
        let left = situation.lost.health().union(self.health(part)).available();
        let operator = left.has(Module::Lan);
        match severity.class().worse(by_availability(situation, left, operator)) {
            Class::Local if !operator => Class::Global,
            class => class,
        }
    }
}

// Every row is detected and answered, or declared invisible with a reason.
const _: () = {
    let mut at = 0;
    while at < RULES.len() {
        let (rule, text) = (&RULES[at], &TEXTS[at]);
        assert!(rule.mode as usize == at, "RULES must be in the order of the enum FailureMode");
        assert!(
            rule.signature.always.is_empty() == text.silent.is_some(),
            "a failure mode needs a flag that it always raises, or a reason why none is"
        );
        assert!(
            !rule.signature.always.is_empty() || rule.signature.sometimes.is_empty(),
            "a failure mode raises flags only sometimes: nothing detects it"
        );
        assert!(
            rule.signature.always.common(rule.signature.sometimes).is_empty(),
            "a failure mode raises a flag both always and sometimes"
        );
        assert!(
            rule.report.is_some()
                || text.silent.is_some()
                || rule.class as u8 <= Class::Adapter as u8,
            "a hard or fatal failure mode is detected, but reported to nobody"
        );
        assert!(
            rule.class as u8 == rule.autonomous.class() as u8,
            "the class of a failure mode is not that of its severity"
        );
        assert!(text.mtbf_mh > 0, "a failure mode without a rate");
        at += 1;
    }
};

/// The FMECA as comma-separated values, a heading and one line a row, fields quoted where they must
/// be (RFC 4180, with plain line ends).
#[derive(Clone, Copy, Debug)]
pub struct FmecaCsv;

/// The columns of [`FmecaCsv`].
pub const FMECA_COLUMNS: &str = "id,function,component,failure_mode,cause,effect,severity_auto,severity_teleop,\
modules_lost,observer,detection_rule,detection_latency_s,cs_event_auto,reaction,persistence,mtbf_h,rate_source,injection";

impl fmt::Display for FmecaCsv {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{FMECA_COLUMNS}")?;
        for mode in FailureMode::ALL {
            let (rule, text) = (mode.rule(), mode.description());
            for field in
                [mode.name(), text.function, text.component, text.failure, text.cause, text.effect]
            {
                quoted(f, field)?;
                f.write_char(',')?;
            }
            write!(f, "{},{},", rule.autonomous.name(), rule.operator.name())?;
            for field in [text.modules, text.observer, text.detection] {
                quoted(f, field)?;
                f.write_char(',')?;
            }
            thousandths(f, rule.latency_ms)?;
            write!(f, ",{},", rule.class.name())?;
            quoted(f, text.reaction)?;
            write!(f, ",{},", rule.persistence.name())?;
            thousandths(f, text.mtbf_mh)?;
            f.write_char(',')?;
            quoted(f, text.rate)?;
            f.write_char(',')?;
            quoted(f, text.injection)?;
            f.write_char('\n')?;
        }
        Ok(())
    }
}

impl Persistence {
    /// Its name in the FMECA.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Permanent => "permanent",
            Self::Transient => "transient",
            Self::Intermittent => "intermittent",
        }
    }
}

fn quoted(f: &mut fmt::Formatter<'_>, field: &str) -> fmt::Result {
    if !field.contains([',', '"', '\n']) {
        return f.write_str(field);
    }
    f.write_char('"')?;
    for (at, part) in field.split('"').enumerate() {
        write!(f, "{}{part}", if at == 0 { "" } else { "\"\"" })?;
    }
    f.write_char('"')
}

/// A number of thousandths as a decimal number without trailing zeros.
fn thousandths(f: &mut fmt::Formatter<'_>, number: u32) -> fmt::Result {
    let (whole, rest) = (number / 1000, number % 1000);
    match rest {
        0 => write!(f, "{whole}"),
        _ if rest % 100 == 0 => write!(f, "{whole}.{}", rest / 100),
        _ if rest % 10 == 0 => write!(f, "{whole}.{:02}", rest / 10),
        _ => write!(f, "{whole}.{rest:03}"),
    }
}
