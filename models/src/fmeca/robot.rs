//! The delivery robot's analysis, from its typed rows.

use super::analysis::{Analysis, Flag, Mode, Probe};
use super::diagnosis::Status;
use super::set::Set;
use crate::cotama::{self, FailureMode, Flags, Modules};

/// A mission of the robot takes minutes; this is a working day (assumed).
const PERIOD_H: u32 = 8;

impl Analysis {
    /// The FMECA of COTAMA's delivery robot: the rows on which its diagnosis and its decisions run.
    pub fn of_the_robot() -> Self {
        let flag = |it: &cotama::Flag| Flag {
            name: it.name().to_owned(),
            doc: it.doc().to_owned(),
            observer: it.observers().to_string(),
        };
        let probe = |it: &cotama::Probe| Probe {
            name: it.name().to_owned(),
            doc: it.doc().to_owned(),
            shows: set(FailureMode::ALL.len(), it.shows().bits()),
        };
        Self {
            title: "the delivery robot".to_owned(),
            period_h: PERIOD_H,
            flags: cotama::Flag::ALL.iter().map(flag).collect(),
            probes: cotama::Probe::ALL.iter().map(probe).collect(),
            modes: FailureMode::ALL.iter().map(|&it| mode(it)).collect(),
        }
    }
}

impl Status {
    /// The robot while these modules are available: flags without an observer are not raised, rows
    /// that need a missing module cannot happen, probes that need one see nothing.
    pub fn of_the_robot(name: &str, available: Modules) -> Self {
        let is_possible = |mode: &FailureMode| {
            let signature = mode.rule().signature;
            available.covers(signature.present) && signature.absent.common(available).is_empty()
        };
        let modes = FailureMode::ALL.iter().enumerate().filter(|(_, it)| is_possible(it));
        let works = |probe: &cotama::Probe| available.covers(probe.needs());
        let probes = cotama::Probe::ALL.iter().enumerate().filter(|(_, it)| works(it));
        Self {
            name: name.to_owned(),
            flags: set(cotama::Flag::ALL.len(), Flags::seen_by(available).bits()),
            modes: Set::of(FailureMode::ALL.len(), modes.map(|it| it.0)),
            probes: Set::of(cotama::Probe::ALL.len(), probes.map(|it| it.0)),
        }
    }
}

/// The same set: both have one bit a member, in the order of declaration.
fn set(length: usize, bits: u64) -> Set {
    Set::of(length, (0..64).filter(|bit| bits & (1 << bit) != 0))
}

fn mode(mode: FailureMode) -> Mode {
    let (rule, text) = (mode.rule(), mode.description());
    let flags = |flags: Flags| set(cotama::Flag::ALL.len(), flags.bits());
    Mode {
        id: mode.name().to_owned(),
        function: text.function.to_owned(),
        component: text.component.to_owned(),
        failure: text.failure.to_owned(),
        cause: text.cause.to_owned(),
        effect: text.effect.to_owned(),
        severity: rule.autonomous,
        severity_operator: Some(rule.operator),
        persistence: Some(rule.persistence),
        lost: text.modules.to_owned(),
        observer: text.observer.to_owned(),
        detection: text.detection.to_owned(),
        latency_ms: rule.latency_ms,
        flags: flags(rule.signature.always),
        sometimes: flags(rule.signature.sometimes),
        silent: text.silent.map(str::to_owned),
        detection_rank: None,
        event: rule.class.name().to_owned(),
        reaction: text.reaction.to_owned(),
        mtbf_mh: text.mtbf_mh.into(),
        alpha_permille: None,
        beta_permille: None,
        rate_label: text.rate_label,
        rate_source: text.rate.to_owned(),
        injection: text.injection.to_owned(),
    }
}
