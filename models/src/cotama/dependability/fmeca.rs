//! Failure modes, effects and criticality analysis (FMECA) of the delivery robot: what can fail,
//! how it shows, how severe it is, and what is done.
//!
//! The method is that of Durand, Godary-Dejean, Lapierre, Crestani, IROS 2010, and Durand et al.,
//! TAROS 2010, Section III.A. The rows are the project's own: those that name TAROS 2010 follow
//! it, the others fill the same form; rates are assumed but where
//! [`Description::rate_label`] says otherwise. Firmware links [`RULES`] alone, the texts stand
//! apart in [`TEXTS`].

use super::adjustment::Adjustment;
use super::rule::{Description, Rule};
use super::table::{FailureMode, RULES, TEXTS};
use crate::cotama::decisions::{Class, Report, Severity, Situation, by_availability};
use crate::cotama::modules::{Health, Mode, Module, Modules};

impl FailureMode {
    /// Returns the adjustment on this failure mode, if its reaction is a setting.
    pub const fn adjustment(self) -> Option<Adjustment> {
        self.rule().adjustment
    }

    /// Returns the rule: the facts that a reaction needs.
    pub const fn rule(self) -> &'static Rule {
        &RULES[self as usize]
    }

    /// Returns the words of the row.
    pub const fn description(self) -> &'static Description {
        &TEXTS[self as usize]
    }

    /// How severe it is in an autonomy mode: the operator's column wherever the operator decides.
    pub const fn severity(self, mode: Mode) -> Severity {
        match mode {
            Mode::Rest | Mode::Autonomous => self.rule().autonomous,
            Mode::HandOver | Mode::Teleprogrammed | Mode::Teleoperated => self.rule().operator,
        }
    }

    /// Returns the parts that it breaks; `part` is the module of a fault of one module, and does
    /// not matter else.
    pub const fn health(self, part: Modules) -> Health {
        let rule = self.rule();
        let faulty = if rule.one_module { part } else { rule.faulty };
        Health { faulty, lost: rule.lost, suspected: Modules::NONE }
    }

    /// Returns the class by the two rules of [`by_rules`](crate::cotama::by_rules): the worse of
    /// severity and the modules left available, and global where the operator is needed and cannot
    /// be reached.
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
        let severity = self.severity(situation.mode());
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
            rule.report.is_some() != (text.silent.is_some() || text.tolerated.is_some()),
            "a failure mode is detected, but neither reported nor tolerated with a reason"
        );
        assert!(
            text.tolerated.is_none() || rule.autonomous as u8 <= Severity::Weak as u8,
            "only a weak failure mode can be tolerated"
        );
        assert!(
            !matches!(rule.report, Some(Report::Minor))
                || rule.adjustment.is_some()
                    && rule.autonomous as u8 <= Severity::Medium as u8
                    && rule.operator as u8 <= Severity::Medium as u8,
            "a minor failure mode is weak or medium, and something is adjusted on it"
        );
        assert!(
            rule.class as u8 == rule.autonomous.class() as u8,
            "the class of a failure mode is not that of its severity"
        );
        assert!(text.mtbf_mh > 0, "a failure mode without a rate");
        at += 1;
    }
};
