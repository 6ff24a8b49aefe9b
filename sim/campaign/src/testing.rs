//! A campaign as a test: a requirement of a user's own, a budget, and on failure the shrunk
//! scenario.

use crate::observed::Observed;
use crate::plan::Plan;
use crate::requirement::Requirement;
use crate::space::{Rates, Space};
use crate::strategy::{BLOCK, StrategyName};
use crate::subject::{Policy, Subject};
use cotama_models::missions::Mission;

/// A test over drawn faults. It panics with the smallest plan that it can find.
///
/// ```should_panic
/// use cotama_models::missions::{Mission, embedded};
/// use cotama_campaign::testing::CampaignTest;
/// let delivery = embedded::mission("delivery").unwrap();
/// let mission = Mission::parse(delivery.name, delivery.text).unwrap();
/// // The operator is asked sooner or later.
/// CampaignTest::new(&mission).runs(500).check("nobody is asked", |_, run| run.requests == 0);
/// ```
#[derive(Clone, Debug)]
pub struct CampaignTest<'m> {
    mission: &'m Mission,
    policy: Policy,
    runs: u64,
    seed: u64,
    strategy: StrategyName,
    faults: (u64, u64),
}

impl<'m> CampaignTest<'m> {
    /// A thousand runs with one to three faults, drawn uniformly from seed 0.
    pub fn new(mission: &'m Mission) -> Self {
        let policy = Policy::default();
        let strategy = StrategyName::Uniform;
        Self { mission, policy, runs: 1_000, seed: 0, strategy, faults: (1, 3) }
    }

    /// The budget: so many runs.
    #[must_use]
    pub const fn runs(self, runs: u64) -> Self {
        Self { runs, ..self }
    }

    /// Another seed.
    #[must_use]
    pub const fn seed(self, seed: u64) -> Self {
        Self { seed, ..self }
    }

    /// Another strategy.
    #[must_use]
    pub const fn strategy(self, strategy: StrategyName) -> Self {
        Self { strategy, ..self }
    }

    /// From so many to so many faults a run.
    #[must_use]
    pub const fn faults(self, least: u64, most: u64) -> Self {
        Self { faults: (least, most), ..self }
    }

    /// Another planner.
    #[must_use]
    pub const fn policy(self, policy: Policy) -> Self {
        Self { policy, ..self }
    }

    /// The smallest plan found that breaks the requirement, and its run; none if none did.
    ///
    /// # Panics
    /// When the mission cannot be run.
    pub fn find(&self, holds: impl Fn(&Plan, &Observed) -> bool) -> Option<(u64, Plan, Observed)> {
        self.search(&self.subject(), &holds)
    }

    fn search(
        &self,
        subject: &Subject<'_>,
        holds: &dyn Fn(&Plan, &Observed) -> bool,
    ) -> Option<(u64, Plan, Observed)> {
        let space = Space::of(self.mission, Rates::Even, self.faults.0..=self.faults.1);
        let strategy = self.strategy.strategy(&space);
        let runs = strategy.total(&space).map_or(self.runs, |it| it.min(self.runs));
        let mut first = 0;
        while first < runs {
            let mut draws = strategy.block(&space, self.seed, first);
            for run in first..runs.min(first + BLOCK) {
                let plan = draws.next();
                let observed = subject.run(&plan);
                if !holds(&plan, &observed) {
                    let plan = crate::shrink::shrink_by(&plan, &mut |it: &Plan| {
                        !holds(it, &subject.run(it))
                    });
                    let observed = subject.run(&plan.plan);
                    return Some((run, plan.plan, observed));
                }
                draws.learn(&observed, i64::MAX);
            }
            first += BLOCK;
        }
        None
    }

    /// Panics with the smallest plan found that breaks a requirement of
    /// [`Requirement`]'s language, a property of the supervisors
    /// among them, as [`check`](Self::check) does; what broke a property stands above the plan.
    ///
    /// ```
    /// use cotama_models::missions::{Mission, embedded};
    /// use cotama_campaign::testing::CampaignTest;
    /// use std::panic::{AssertUnwindSafe, catch_unwind};
    /// let delivery = embedded::mission("delivery").unwrap();
    /// let mission = Mission::parse(delivery.name, delivery.text).unwrap();
    /// let test = CampaignTest::new(&mission);
    /// // The operator takes longer than that to answer.
    /// let asked = "AG (ls.Waits -> AF<=5s !ls.Waits)";
    /// let failed = catch_unwind(AssertUnwindSafe(|| test.requires(asked))).unwrap_err();
    /// let said = failed.downcast::<String>().unwrap();
    /// assert!(said.starts_with(&format!("`{asked}` does not hold of run ")), "{said}");
    /// ```
    ///
    /// # Panics
    /// When a run breaks it, when it is no requirement of this mission, or when the mission cannot
    /// be run.
    pub fn requires(&self, requirement: &str) {
        let asked: Requirement = match requirement.parse() {
            Ok(asked) => asked,
            Err(error) => panic!("{error}"),
        };
        let subject = match self.subject().watching(std::slice::from_ref(&asked)) {
            Ok(subject) => subject,
            Err(error) => panic!("{error}"),
        };
        if let Some(found) = self.search(&subject, &|_, run| asked.holds(run)) {
            self.fail(requirement, found);
        }
    }

    fn subject(&self) -> Subject<'m> {
        match Subject::new(self.mission, self.policy) {
            Ok(subject) => subject,
            Err(error) => panic!("the mission cannot be run: {error}"),
        }
    }

    /// Panics with the smallest plan found that breaks the requirement, as a scenario that `cotama
    /// run MISSION --faults FILE` replays.
    ///
    /// # Panics
    /// When a run breaks it, or the mission cannot be run.
    pub fn check(&self, name: &str, holds: impl Fn(&Plan, &Observed) -> bool) {
        if let Some(found) = self.find(holds) {
            self.fail(name, found);
        }
    }

    fn fail(&self, name: &str, (run, plan, observed): (u64, Plan, Observed)) -> ! {
        let text = plan.compact(self.mission);
        let (outcome, strategy, seed) = (observed.outcome.name(), self.strategy.name(), self.seed);
        let witness = observed.witness.map_or_else(String::new, |it| {
            format!("# broken after {} ms; last there was {}\n", it.at_ms, it.seen.join(", "))
        });
        panic!(
            "`{name}` does not hold of run {run} (seed {seed}, {strategy}): {outcome}, {} ms, {} \
             mm\n{witness}{text}",
            observed.time_ms, observed.x_mm
        );
    }
}
