//! The answer of `cotama fmeca`.

#[cfg(test)]
use schemars::JsonSchema;
use serde::Serialize;

/// The failure modes of an analysis, what reacts to them, how critical they are, and which of them
/// look alike. Without a file it is that of the robot `p3dx-delivery`.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct FmecaAnswer<'a> {
    #[cfg_attr(test, schemars(extend("const" = "cotama/fmeca/1")))]
    pub(crate) schema: &'static str,
    /// Subject of the analysis.
    pub(crate) title: &'a str,
    /// The time of operation for which occurrence classes count failures, in hours.
    pub(crate) period_h: u32,
    pub(crate) counts: CountsRow,
    /// One row a failure mode.
    pub(crate) rows: Vec<FmecaRow<'a>>,
    /// One cause-effect diagram a function.
    pub(crate) diagrams: Vec<DiagramRow<'a>>,
    pub(crate) diagnosability: Diagnosability<'a>,
}

/// How many failure modes are seen and answered; every one of them is in `detected`, in
/// `undetectable` or in `unexplained`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct CountsRow {
    pub(crate) rows: usize,
    pub(crate) functions: usize,
    /// Rows that always raise a flag.
    pub(crate) detected: usize,
    /// Detectable failure modes of a robot that are reported to the contextual supervisor.
    pub(crate) reported: usize,
    /// Detectable failure modes that are not reported, with a reaction of their own.
    pub(crate) recorded: usize,
    /// Rows that nothing of the architecture sees, declared as such with a reason.
    pub(crate) undetectable: usize,
    /// Rows that always raise no flag, and no reason is stated.
    pub(crate) unexplained: usize,
}

/// A failure mode.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct FmecaRow<'a> {
    pub(crate) id: &'a str,
    /// The function that suffers.
    pub(crate) function: &'a str,
    pub(crate) component: &'a str,
    pub(crate) failure: &'a str,
    pub(crate) cause: &'a str,
    pub(crate) effect: &'a str,
    /// While the robot drives itself: `weak`, `medium`, `hard` or `fatal`.
    pub(crate) severity_autonomous: &'a str,
    /// While the operator drives; null if the file makes no difference.
    pub(crate) severity_operator: Option<&'a str>,
    /// Receiver of its event while the robot drives itself; of a robot: `adapter`,
    /// `local` or `global`.
    pub(crate) class: &'a str,
    /// `permanent`, `transient` or `intermittent`; null if the file does not say.
    pub(crate) persistence: Option<&'a str>,
    /// Functions lost with it, in words.
    pub(crate) loss: &'a str,
    /// Modules that are faulty with it; this and what else is about modules is of robots only.
    pub(crate) modules_faulty: Vec<&'a str>,
    /// Hardware that is lost with it.
    pub(crate) resources_lost: Vec<&'a str>,
    /// Modules that are unavailable after it, those that need faulty or lost ones among them.
    pub(crate) modules_unavailable: Vec<&'a str>,
    /// Observer that sees it, in words.
    pub(crate) observer: &'a str,
    /// How it is seen, in words.
    pub(crate) detection: &'a str,
    pub(crate) detection_latency_ms: u32,
    /// Flags that it always raises.
    pub(crate) flags_always: Vec<&'a str>,
    /// Flags that it may raise too.
    pub(crate) flags_sometimes: Vec<&'a str>,
    /// Why nothing sees it; null if something does, or no reason is stated.
    pub(crate) undetectable_reason: Option<&'a str>,
    /// The report to the contextual supervisor; null where nothing sees it, or of a file.
    pub(crate) report: Option<&'a str>,
    pub(crate) reaction: &'a str,
    /// The rounds of a robot's supervisors in which its reaction is done at worst, from the period
    /// in which it is told; the requirements CS1, CS2, CS5 and AS4 of `cotama check` say so. Null
    /// where nothing sees it, or of a file.
    pub(crate) reaction_rounds: Option<u64>,
    /// The longest time from the failure to the end of its reaction, if nothing else fails, without
    /// what the operator takes: latency, what is tried first, and rounds. Null without a body too.
    pub(crate) reaction_ms: Option<u64>,
    /// The mean time between failures, in thousandths of an hour.
    pub(crate) mtbf_mh: u64,
    /// How well the rate is known: `stated`, `inferred` or `assumed`.
    pub(crate) rate_label: &'a str,
    pub(crate) rate_source: &'a str,
    /// How the fault is injected in simulation.
    pub(crate) injection: &'a str,
    pub(crate) criticality: CriticalityRow,
    /// Reaction of the robot's decisional level, or the receiver of its event, in words.
    #[serde(skip)]
    pub(crate) event: String,
}

/// How critical a failure mode is: ranks with their product, and its field of the criticality
/// matrix.
#[derive(Clone, Copy, Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct CriticalityRow {
    /// From 1 to 10; of the worse severity.
    pub(crate) severity: u8,
    /// From 1 to 10.
    pub(crate) occurrence: u8,
    /// From 1, seen for sure and at once, to 10, never seen.
    pub(crate) detection: u8,
    /// The risk priority number: the product of the three ranks.
    pub(crate) rpn: u16,
    /// `insignificant`, `marginal`, `critical` or `catastrophic`.
    pub(crate) severity_class: &'static str,
    /// `improbable`, `remote`, `occasional`, `probable` or `frequent`.
    pub(crate) occurrence_class: &'static str,
    /// `negligible`, `tolerable`, `undesirable` or `intolerable`.
    pub(crate) class: &'static str,
    /// The Action Priority of the three ranks: `H`, `M` or `L`.
    pub(crate) action_priority: &'static str,
    /// The same with the detection that runs have shown, of a measurement; absent without one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) measured: Option<MeasuredRow>,
    /// The criticality number of MIL-STD-1629A in thousand millionths, where the file gives α and
    /// β.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) number_e9: Option<u64>,
}

/// How critical a failure mode is with the detection rank that runs have shown.
#[derive(Clone, Copy, Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct MeasuredRow {
    /// From 1 to 10: the decade of the longest delay where it was named in at least 95 % of the
    /// runs, 9 in fewer, 10 in none.
    pub(crate) detection: u8,
    /// The product of severity, occurrence and this rank.
    pub(crate) rpn: u16,
    /// `H`, `M` or `L`.
    pub(crate) action_priority: &'static str,
}

/// A cause-effect diagram: what takes a function away.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct DiagramRow<'a> {
    pub(crate) function: &'a str,
    pub(crate) ribs: Vec<RibRow<'a>>,
}

/// The failure modes of one component, for one function.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct RibRow<'a> {
    pub(crate) component: &'a str,
    pub(crate) modes: Vec<&'a str>,
}

/// Which failure modes cannot be told apart, and what would help.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct Diagnosability<'a> {
    /// The sound robot, then each single loss that leaves it running.
    pub(crate) statuses: Vec<StatusRow<'a>>,
    /// Observations that the architecture does not make.
    pub(crate) probes: Vec<ProbeRow<'a>>,
}

/// The diagnosability in one status of the robot.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct StatusRow<'a> {
    /// As `sonar lost`; of a file there is one, `sound`.
    pub(crate) status: String,
    /// The loss.
    pub(crate) lost: Option<&'a str>,
    pub(crate) modules_unavailable: Vec<&'a str>,
    /// How many failure modes can happen and always raise a flag.
    pub(crate) detectable: usize,
    /// Failure modes that can happen and that no available observer is sure to see.
    pub(crate) undetectable: Vec<UndetectableRow<'a>>,
    /// Failure modes that cannot happen, or do not matter, any more or yet.
    pub(crate) impossible: Vec<&'a str>,
    /// The largest sets of failure modes that some flags leave open.
    pub(crate) groups: Vec<GroupRow<'a>>,
    /// Whether these are all groups; there can be too many to tell.
    pub(crate) groups_complete: bool,
    /// Every two that some flags leave open, with the probes of which each one would tell them
    /// apart.
    pub(crate) pairs: Vec<PairRow<'a>>,
    /// How many further pairs there are.
    pub(crate) pairs_left_out: usize,
    /// Whether probes could tell all pairs apart.
    pub(crate) separable: bool,
    /// The fewest probes that tell all pairs apart that any probe can.
    pub(crate) least_probes: Vec<&'a str>,
}

/// A failure mode that is not detected.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct UndetectableRow<'a> {
    pub(crate) id: &'a str,
    /// Whether the FMECA declares it so; otherwise its observers are unavailable.
    pub(crate) declared: bool,
    pub(crate) reason: String,
}

/// Failure modes with flags in common.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct GroupRow<'a> {
    pub(crate) modes: Vec<&'a str>,
    /// The flags with which all of them are possible.
    pub(crate) flags: Vec<&'a str>,
    /// Flags that may be raised too and still rule none out.
    pub(crate) flags_optional: Vec<&'a str>,
}

/// Two failure modes with flags in common.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct PairRow<'a> {
    #[serde(flatten)]
    pub(crate) shared: GroupRow<'a>,
    /// Each one of them would tell the two apart; none can if it is empty.
    pub(crate) probes: Vec<&'a str>,
}

/// An observation that could be added.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct ProbeRow<'a> {
    pub(crate) name: &'a str,
    /// Observer and observation, in words.
    pub(crate) doc: &'a str,
    /// The failure modes that it would show.
    pub(crate) shows: Vec<&'a str>,
}

/// Detection of the failures of a robot in the plane by its signals, one run a seed.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct MeasureAnswer {
    #[cfg_attr(test, schemars(extend("const" = "cotama/measure/1")))]
    pub(crate) schema: &'static str,
    pub(crate) mission: String,
    pub(crate) robot: String,
    /// Runs of each failure.
    pub(crate) seeds: u64,
    /// Place of the robot on its path when a failure happens, in mm.
    pub(crate) x_mm: u64,
    /// Time after a failure in which it has to be found, in ms.
    pub(crate) window_ms: u64,
    /// One row for each failure that harms a device.
    pub(crate) rows: Vec<MeasureRow>,
    /// Failures that harm no device of the plane: their flags are told.
    pub(crate) told: Vec<String>,
}

/// The detection of a failure.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct MeasureRow {
    pub(crate) id: String,
    pub(crate) failure: String,
    /// Runs in which it happened.
    pub(crate) runs: u64,
    /// Runs in which something was diagnosed after it.
    pub(crate) found: u64,
    /// The exact interval of the probability of that.
    pub(crate) found_rate: RateRow,
    /// Runs in which it was among the rows that it was taken for.
    pub(crate) named: u64,
    /// The exact interval of the probability of that.
    pub(crate) named_rate: RateRow,
    /// The median delay of a detection; null where there was none.
    pub(crate) median_ms: Option<u64>,
    /// The longest delay.
    pub(crate) worst_ms: Option<u64>,
    /// The delay that the robot's file assumes.
    pub(crate) assumed_ms: u64,
    /// The detection rank that the runs show, from 1 to 10; null without a run.
    pub(crate) detection: Option<u8>,
    /// Runs in which a flag was raised before anything failed.
    pub(crate) false_alarms: u64,
    /// Rows that it was taken for, and in how many runs, the most first.
    pub(crate) taken_for: Vec<TakenRow>,
    /// Why it is not as assumed: taken for others, not raised, late. Null where it is named in at
    /// least 95 % of the runs, and in time.
    pub(crate) why: Option<String>,
}

/// An interval of a probability (Clopper and Pearson) that holds the truth with 95 %.
#[derive(Clone, Copy, Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct RateRow {
    /// The least that is believed, in thousandths.
    #[serde(rename = "low_permille")]
    pub(crate) low: u64,
    /// The most that is believed, in thousandths.
    #[serde(rename = "high_permille")]
    pub(crate) high: u64,
}

/// Rows of the FMECA that explain flags, and how often.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(JsonSchema))]
pub(crate) struct TakenRow {
    pub(crate) rows: Vec<String>,
    pub(crate) runs: u64,
}
