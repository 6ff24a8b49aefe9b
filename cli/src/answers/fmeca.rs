//! The answer of `cotama fmeca`.

use schemars::JsonSchema;
use serde::Serialize;

/// The failure modes of the delivery robot, what reacts to them, and which of them look alike.
#[derive(Debug, JsonSchema, Serialize)]
pub(crate) struct FmecaAnswer {
    #[schemars(extend("const" = "cotama/fmeca/1"))]
    pub(crate) schema: &'static str,
    pub(crate) counts: CountsRow,
    /// One row a failure mode.
    pub(crate) rows: Vec<FmecaRow>,
    /// One cause-effect diagram a function.
    pub(crate) diagrams: Vec<DiagramRow>,
    pub(crate) diagnosability: Diagnosability,
}

/// How many failure modes are seen and answered; every one of them is in `detected` or in
/// `undetectable`.
#[derive(Clone, Copy, Debug, JsonSchema, PartialEq, Eq, Serialize)]
pub(crate) struct CountsRow {
    pub(crate) rows: usize,
    pub(crate) functions: usize,
    /// Rows that always raise a flag.
    pub(crate) detected: usize,
    /// Those of them that are reported to the contextual supervisor.
    pub(crate) reported: usize,
    /// Those of them that are recorded, with a reaction of their own.
    pub(crate) recorded: usize,
    /// Rows that nothing of the architecture sees, declared as such with a reason.
    pub(crate) undetectable: usize,
}

/// A failure mode.
#[derive(Clone, Debug, JsonSchema, Serialize)]
pub(crate) struct FmecaRow {
    pub(crate) id: &'static str,
    /// The function that suffers.
    pub(crate) function: &'static str,
    pub(crate) component: &'static str,
    pub(crate) failure: &'static str,
    pub(crate) cause: &'static str,
    pub(crate) effect: &'static str,
    /// While the robot drives itself: `weak`, `medium`, `hard` or `fatal`.
    pub(crate) severity_autonomous: &'static str,
    /// While the operator drives.
    pub(crate) severity_operator: &'static str,
    /// Who gets its event while the robot drives itself: `adapter`, `local` or `global`.
    pub(crate) class: &'static str,
    /// `permanent`, `transient` or `intermittent`.
    pub(crate) persistence: &'static str,
    /// Modules lost, in words.
    pub(crate) loss: &'static str,
    /// Modules that are faulty with it.
    pub(crate) modules_faulty: Vec<&'static str>,
    /// Whether it is a fault of one module, whichever it is.
    pub(crate) any_one_module: bool,
    /// Hardware, and the map, that is lost with it.
    pub(crate) resources_lost: Vec<&'static str>,
    /// Modules that are unavailable after it, those that need faulty or lost ones among them.
    pub(crate) modules_unavailable: Vec<&'static str>,
    /// Who sees it, in words.
    pub(crate) observer: &'static str,
    /// How it is seen, in words.
    pub(crate) detection: &'static str,
    pub(crate) detection_latency_ms: u32,
    /// Flags that it always raises.
    pub(crate) flags_always: Vec<&'static str>,
    /// Flags that it may raise too.
    pub(crate) flags_sometimes: Vec<&'static str>,
    /// It can only happen, or only matters, while these modules are available.
    pub(crate) only_with_modules: Vec<&'static str>,
    /// It can only happen while these modules are not.
    pub(crate) only_without_modules: Vec<&'static str>,
    /// Why nothing of the architecture sees it; null if something does.
    pub(crate) undetectable_reason: Option<&'static str>,
    /// The report to the contextual supervisor; null if it is recorded only.
    pub(crate) report: Option<&'static str>,
    pub(crate) reaction: &'static str,
    /// The mean time between failures, in thousandths of an hour.
    pub(crate) mtbf_mh: u32,
    /// How well the rate is known: `stated`, `inferred` or `assumed`.
    pub(crate) rate_label: &'static str,
    pub(crate) rate_source: &'static str,
    /// How the fault is injected in simulation.
    pub(crate) injection: &'static str,
}

/// A cause-effect diagram: what takes a function away.
#[derive(Clone, Debug, JsonSchema, Serialize)]
pub(crate) struct DiagramRow {
    pub(crate) function: &'static str,
    pub(crate) ribs: Vec<RibRow>,
}

/// The failure modes of one component, for one function.
#[derive(Clone, Debug, JsonSchema, Serialize)]
pub(crate) struct RibRow {
    pub(crate) component: &'static str,
    pub(crate) modes: Vec<&'static str>,
}

/// Which failure modes cannot be told apart, and what would help.
#[derive(Clone, Debug, JsonSchema, Serialize)]
pub(crate) struct Diagnosability {
    /// The sound robot, then each single loss that leaves it running.
    pub(crate) statuses: Vec<StatusRow>,
    /// Observations that the architecture does not make.
    pub(crate) probes: Vec<ProbeRow>,
    pub(crate) ambiguous_case: AmbiguousCase,
}

/// What can be told in one status of the robot.
#[derive(Clone, Debug, JsonSchema, Serialize)]
pub(crate) struct StatusRow {
    /// As `sonar lost`.
    pub(crate) status: &'static str,
    /// The resource that is lost.
    pub(crate) lost: Option<&'static str>,
    pub(crate) modules_unavailable: Vec<&'static str>,
    /// How many failure modes can happen and always raise a flag.
    pub(crate) detectable: usize,
    /// Failure modes that can happen and that no available observer is sure to see.
    pub(crate) undetectable: Vec<UndetectableRow>,
    /// Failure modes that cannot happen, or do not matter, any more or yet.
    pub(crate) impossible: Vec<&'static str>,
    /// The largest sets of failure modes that some flags leave open.
    pub(crate) groups: Vec<GroupRow>,
    /// Every two that some flags leave open, with the probes of which each one would tell them
    /// apart.
    pub(crate) pairs: Vec<PairRow>,
    /// Whether probes could tell all pairs apart.
    pub(crate) separable: bool,
    /// The fewest probes that tell all pairs apart that any probe can.
    pub(crate) least_probes: Vec<&'static str>,
}

/// A failure mode that is not detected.
#[derive(Clone, Debug, JsonSchema, Serialize)]
pub(crate) struct UndetectableRow {
    pub(crate) id: &'static str,
    /// Whether the FMECA declares it so; otherwise its observers are unavailable.
    pub(crate) declared: bool,
    pub(crate) reason: String,
}

/// Failure modes with flags in common.
#[derive(Clone, Debug, JsonSchema, Serialize)]
pub(crate) struct GroupRow {
    pub(crate) modes: Vec<&'static str>,
    /// The flags with which all of them are possible.
    pub(crate) flags: Vec<&'static str>,
    /// Flags that may be raised too and still rule none out.
    pub(crate) flags_optional: Vec<&'static str>,
}

/// Two failure modes with flags in common.
#[derive(Clone, Debug, JsonSchema, Serialize)]
pub(crate) struct PairRow {
    #[serde(flatten)]
    pub(crate) shared: GroupRow,
    /// Each one of them would tell the two apart; none can if it is empty.
    pub(crate) probes: Vec<&'static str>,
}

/// An observation that could be added.
#[derive(Clone, Debug, JsonSchema, Serialize)]
pub(crate) struct ProbeRow {
    pub(crate) name: &'static str,
    /// Who would observe what.
    pub(crate) doc: &'static str,
    /// The failure modes that it would show.
    pub(crate) shows: Vec<&'static str>,
    /// The modules without which it would see nothing.
    pub(crate) needs: Vec<&'static str>,
}

/// Point 3 of the published run.
#[derive(Clone, Debug, JsonSchema, Serialize)]
pub(crate) struct AmbiguousCase {
    pub(crate) flags: Vec<&'static str>,
    pub(crate) candidates: Vec<&'static str>,
    pub(crate) modules_suspect: Vec<&'static str>,
    /// The class of the decision while a path is followed.
    pub(crate) decision: &'static str,
    /// The same when the operator cannot be reached.
    pub(crate) decision_without_operator: &'static str,
    /// The probes of the least set that would settle it.
    pub(crate) probes: Vec<&'static str>,
    /// The case in words, one paragraph each.
    pub(crate) text: Vec<String>,
}
