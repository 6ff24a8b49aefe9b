//! The subject of a check: a net with or without time, from the command line.

use crate::args::Semantics;
use crate::exit::Failure;
use crate::model::{self, Found};
use cotama_core::net::owned::OwnedNet;
use cotama_core::system::System;
use cotama_models::robots::requirements::{Requirement as RobotRequirement, Watch};
use cotama_models::team::protocol::Requirement;
use cotama_verification::check::Model;
use cotama_verification::flat::{self, FlatError, Looks, Rounds, flat};
use cotama_verification::property::Ids;
use cotama_verification::pt::Pt;

/// A model as it is checked.
#[derive(Debug)]
pub(crate) struct Subject {
    /// Name on the command line.
    pub(crate) name: String,
    pub(crate) model: Model,
    /// The net with its laws, unless it is from a file that has none.
    pub(crate) net: Option<OwnedNet>,
    /// Notes on the model as it is checked.
    pub(crate) notes: Vec<String>,
    /// Meaning of a system of nets; of a system alone.
    pub(crate) semantics: Option<Semantics>,
    /// A system that acts in rounds.
    pub(crate) rounds: Option<Rounds>,
    /// Requirements of the protocol of a team.
    pub(crate) requirements: Vec<Requirement>,
    /// Requirements of the supervisors of a robot.
    pub(crate) required: Vec<RobotRequirement>,
    place_ids: Vec<String>,
    transition_ids: Vec<String>,
}

/// Why there is no subject.
#[derive(Debug)]
pub(crate) enum Unmade {
    Failure(Failure),
    /// A limit that is an answer.
    TooLarge(Box<TooLarge>),
}

/// A system that is too large to be one net.
#[derive(Debug)]
pub(crate) struct TooLarge {
    /// The limit that it passes, in words.
    pub(crate) why: String,
    /// Meaning that was wanted.
    pub(crate) semantics: Option<Semantics>,
    /// Requirements that nothing is known of.
    pub(crate) required: Vec<RobotRequirement>,
}

impl From<Failure> for Unmade {
    fn from(failure: Failure) -> Self {
        Self::Failure(failure)
    }
}

/// For commands to which a limit is no answer.
impl From<Unmade> for Failure {
    fn from(unmade: Unmade) -> Self {
        match unmade {
            Unmade::Failure(failure) => failure,
            Unmade::TooLarge(it) => Self::new(it.why),
        }
    }
}

impl Subject {
    /// The model of this name, or of the file at this path; without its intervals where that is
    /// wanted.
    pub(crate) fn load(
        name: &str,
        untimed: bool,
        semantics: Option<Semantics>,
    ) -> Result<Self, Unmade> {
        Self::of(name, model::find(name)?, untimed, semantics)
    }

    /// The same of a model that was found.
    pub(crate) fn of(
        name: &str,
        found: Found,
        untimed: bool,
        semantics: Option<Semantics>,
    ) -> Result<Self, Unmade> {
        let loaded = Self::found(name, found, untimed, semantics.unwrap_or(Semantics::Rounds))?;
        if semantics == Some(Semantics::Rounds) && loaded.semantics.is_none() {
            return Err(Failure::new(format!(
                "`{name}` is one net: rounds are those of several that work together"
            ))
            .help("leave --semantics out")
            .into());
        }
        Ok(loaded)
    }

    fn found(
        name: &str,
        found: Found,
        untimed: bool,
        semantics: Semantics,
    ) -> Result<Self, Unmade> {
        let loaded = match found {
            Found::System(system) => return Self::of_system(name, system, semantics),
            Found::Owned(it) => {
                return match it.system.with(|system| Self::of_system(name, system, semantics)) {
                    Ok(subject) => Ok(Self { required: it.requirements, ..subject }),
                    Err(Unmade::TooLarge(large)) => Err(Unmade::TooLarge(
                        TooLarge { required: it.requirements, ..*large }.into(),
                    )),
                    Err(refused) => Err(refused),
                };
            }
            Found::Time(net) => {
                let plain = untimed || model::is_untimed(&net);
                let model = if plain { Model::Plain(net.untimed()) } else { Model::from(net) };
                return Ok(Self::new(name, model, None));
            }
            Found::Net(loaded) => *loaded,
        };
        let is_random = loaded.random.is_some();
        if let Some(random) = loaded.random.filter(|_| !untimed) {
            return Err(Failure::from(random).into());
        }
        let extras = loaded.extras;
        let view = loaded.net.view();
        let timed = view.net().transitions.iter().any(|it| it.within.is_some());
        let model = if !extras.is_empty() {
            if timed && !untimed {
                let message = format!("its intervals of time and its {}", extras.named());
                return Err(Failure::of(name, format!("{message} are not checked together"))
                    .help("--untimed leaves the intervals out")
                    .into());
            }
            Model::Plain(Pt::extended(&view.net(), &extras))
        } else if untimed {
            Model::from(&view.net())
        } else {
            Model::timed(&view.net()).map_err(|defect| {
                Failure::of(name, format!("its intervals of time cannot be kept: {defect}"))
                    .help("--untimed leaves them out")
            })?
        };
        // A drawing of the net alone would lack what it cannot hold.
        let net = extras.is_empty().then_some(loaded.net);
        let subject = Self {
            place_ids: loaded.place_ids,
            transition_ids: loaded.transition_ids,
            notes: loaded.notes,
            requirements: loaded.requirements,
            ..Self::new(name, model, net)
        };
        let subject = if is_random {
            let rest = if extras.is_empty() { "" } else { ", immediate ones before the others" };
            subject.noted(&format!(
                "random delays are left out: enabled transitions fire in any order{rest}"
            ))
        } else {
            subject
        };
        Ok(if timed && untimed { subject.noted("intervals of time are left out") } else { subject })
    }

    fn of_system(name: &str, system: &System<'_>, semantics: Semantics) -> Result<Self, Unmade> {
        let refused = |error| {
            let why = format!("`{name}` cannot be checked as one net: {error}");
            if matches!(error, FlatError::TooMany | FlatError::TooMuch) {
                let (semantics, required) = (Some(semantics), Vec::new());
                return Unmade::TooLarge(TooLarge { why, semantics, required }.into());
            }
            Unmade::Failure(Failure::new(why))
        };
        let (net, rounds, note) = if semantics == Semantics::Rounds {
            let rounds = flat::rounds(system).map_err(refused)?;
            let note = "nets of a system act in rounds, as they are executed";
            (rounds.net().map_err(refused)?, Some(rounds), note)
        } else {
            let note = "nets of a system are checked in every interleaving, rounds among them, at \
                any time";
            (flat(system).map_err(refused)?, None, note)
        };
        let subject = Self::new(name, Model::from(&net.view().net()), Some(net)).noted(note);
        Ok(Self { semantics: Some(semantics), rounds, ..subject })
    }

    fn new(name: &str, model: Model, net: Option<OwnedNet>) -> Self {
        let (place_ids, transition_ids) = (Vec::new(), Vec::new());
        Self {
            name: name.to_owned(),
            model,
            net,
            notes: Vec::new(),
            semantics: None,
            rounds: None,
            requirements: Vec::new(),
            required: Vec::new(),
            place_ids,
            transition_ids,
        }
    }

    fn noted(mut self, note: &str) -> Self {
        self.notes.push(note.to_owned());
        self
    }

    /// The same system in rounds, with the observers of a requirement of its robot; nothing of
    /// other models.
    pub(crate) fn watched_by(&self, watches: &[Watch]) -> Result<Option<Self>, FlatError> {
        let Some(mut rounds) = self.rounds.clone() else { return Ok(None) };
        for it in watches {
            let looks = if it.at_end { Looks::AtEnd } else { Looks::BeforeOutside };
            rounds.watch(&it.name, looks, (&it.begins, &it.ends), it.most)?;
        }
        let net = rounds.net()?;
        let subject = Self::new(&self.name, Model::from(&net.view().net()), Some(net));
        Ok(Some(Self { semantics: self.semantics, rounds: Some(rounds), ..subject }))
    }

    /// Returns the ids of places and transitions in its file.
    pub(crate) fn ids(&self) -> Ids<'_> {
        Ids { places: &self.place_ids, transitions: &self.transition_ids }
    }

    /// Whether transitions fire within their intervals.
    pub(crate) fn is_timed(&self) -> bool {
        matches!(self.model, Model::Timed { .. })
    }

    /// The unit of its intervals; none without them, and of a file of TINA, which names none.
    pub(crate) fn time_unit(&self) -> Option<&'static str> {
        (self.is_timed() && self.net.is_some()).then_some("ms")
    }

    /// The same without intervals.
    pub(crate) fn without_time(mut self) -> Self {
        if let Model::Timed { untimed, .. } = self.model {
            self.model = Model::Plain(untimed);
        }
        self
    }
}
