//! A trace as the report looks at it: activities with places and times, stops, stretches of one
//! choice.

use cotama_models::missions::faults::{Faults, PowerError};
use cotama_models::missions::{Mission, Way, Zone};
use cotama_sim::story::{Point, points};
use cotama_sim::trace::{Abort, End, Event, Plan, Record, Request, RunFaults, Sample, Trace};
use std::collections::HashMap;

/// The view of a trace, in the order of the path.
pub(super) struct View<'t> {
    pub(super) trace: &'t Trace,
    /// The mission, or why it cannot be read.
    pub(super) mission: Result<Mission, String>,
    /// The way over the floor; none of a run on a line without one.
    pub(super) way: Option<Way>,
    pub(super) activities: Vec<Step>,
    pub(super) stops: Vec<Stop>,
    pub(super) stretches: Vec<Stretch>,
    pub(super) plans: Vec<&'t Plan>,
    pub(super) events: Vec<&'t Event>,
    pub(super) samples: Vec<&'t Sample>,
    pub(super) requests: Vec<&'t Request>,
    pub(super) abort: Option<&'t Abort>,
    /// The story of a supervised run; none of another one.
    pub(super) points: Vec<Point<'t>>,
    pub(super) end: Option<&'t End>,
    /// The length of the path, in mm: nothing in the trace lies behind it.
    pub(super) length_mm: u64,
}

/// An activity, with what became of it.
pub(super) struct Step {
    pub(super) id: String,
    pub(super) x_start_mm: u64,
    pub(super) x_end_mm: u64,
    /// When it started and ended; planned durations after the end of the run for one that did not
    /// start.
    pub(super) start_us: u64,
    pub(super) end_us: u64,
    pub(super) started: bool,
}

impl Step {
    pub(super) fn travels(&self) -> bool {
        self.x_start_mm < self.x_end_mm
    }
}

/// A place where activities, or something in the way, take time but no path.
pub(super) struct Stop {
    pub(super) x_mm: u64,
    pub(super) start_us: u64,
    pub(super) end_us: u64,
    /// Number of activities.
    pub(super) count: usize,
    pub(super) reached: bool,
}

/// A part of the run with one choice.
pub(super) struct Stretch {
    pub(super) choice: String,
    /// From where and when.
    pub(super) from: (u64, u64),
    /// To where and when.
    pub(super) to: (u64, u64),
}

impl<'t> View<'t> {
    pub(super) fn new(trace: &'t Trace) -> Self {
        let header = &trace.header;
        let mission = header.mission().map_err(|errors| {
            errors
                .to_string()
                .lines()
                .next()
                .unwrap_or("the mission text cannot be read")
                .to_owned()
        });
        let given = mission.as_ref().ok().and_then(|it| it.way.clone());
        let drawn = || header.floor.as_ref().map(|it| it.way(&header.mission));
        let mut view = Self {
            trace,
            way: given.or_else(drawn),
            mission,
            activities: Vec::new(),
            stops: Vec::new(),
            stretches: Vec::new(),
            plans: Vec::new(),
            events: Vec::new(),
            samples: Vec::new(),
            requests: Vec::new(),
            abort: None,
            points: points(&trace.records),
            end: None,
            length_mm: header.path_length_mm,
        };
        for record in &trace.records {
            view.length_mm = view.length_mm.max(record.x_mm());
            match record {
                Record::Plan(it) => view.plans.push(it),
                Record::Event(it) => view.events.push(it),
                Record::Sample(it) => view.samples.push(it),
                Record::Request(it) => view.requests.push(it),
                Record::Abort(it) => view.abort = Some(it),
                Record::End(it) => view.end = Some(it),
                _ => {}
            }
        }
        view.activities = view.steps();
        let ends = view.activities.iter().map(|step| step.x_end_mm);
        view.length_mm = ends.fold(view.length_mm, u64::max);
        view.find_stops();
        view.find_waits();
        view.find_stretches();
        view
    }

    /// Returns how far the real power was from that of the model, in thousandths of it: the zones
    /// that the run came to, in the order of the path.
    pub(super) fn power_errors(&self) -> Vec<(&Zone, i32)> {
        let Ok(mission) = &self.mission else { return Vec::new() };
        let given = match &self.trace.header.options.faults {
            RunFaults::None => return Vec::new(),
            RunFaults::Script => None,
            RunFaults::File { source, text } => match Faults::parse(source, text, mission) {
                Ok(faults) => Some(faults),
                Err(_) => return Vec::new(),
            },
        };
        let faults = given.as_ref().unwrap_or(&mission.run.faults);
        let reached = self.last().0;
        let zone = |it: &PowerError| Some((mission.zones.get(it.zone)?, it.permille));
        let mut errors: Vec<(&Zone, i32)> = faults.power_errors.iter().filter_map(zone).collect();
        errors.retain(|it| it.0.x_start.0 < reached && it.1 != 0);
        errors.sort_by_key(|it| it.0.x_start);
        errors
    }

    /// Whether the mission goes over a floor.
    pub(super) fn is_on_floor(&self) -> bool {
        self.way.is_some()
    }

    /// Returns place and time of the run's end.
    pub(super) fn last(&self) -> (u64, u64) {
        self.trace.records.last().map_or((0, 0), |record| (record.x_mm(), record.t_us()))
    }

    /// The activities of the mission, or what the records tell of them.
    fn steps(&self) -> Vec<Step> {
        let (last_x, last_us) = self.last();
        let started = self.trace.records.iter().filter_map(|record| match record {
            Record::Activity(it) => Some((it.activity.as_str(), it.x_mm, it.t_us)),
            _ => None,
        });
        let started: Vec<_> = started.collect();
        let next =
            |index: usize| started.get(index + 1).map_or((last_x, last_us), |&(_, x, t)| (x, t));
        let times: HashMap<&str, (u64, u64)> = started
            .iter()
            .enumerate()
            .map(|(index, &(id, _, t))| (id, (t, next(index).1)))
            .collect();
        let planned: HashMap<&str, u64> = self
            .plans
            .iter()
            .flat_map(|plan| &plan.plan)
            .map(|row| (row.activity.as_str(), row.duration_ms.saturating_mul(1000)))
            .collect();
        let mut steps: Vec<Step> = match &self.mission {
            Ok(mission) => mission
                .scenario()
                .activities
                .iter()
                .map(|it| Step::unstarted(it.id.clone(), it.x_start.0, it.x_end.0))
                .collect(),
            Err(_) => started
                .iter()
                .enumerate()
                .map(|(index, &(id, x, _))| Step::unstarted(id.into(), x, next(index).0.max(x)))
                .collect(),
        };
        let mut free_us = last_us;
        for step in &mut steps {
            if let Some(&(start_us, end_us)) = times.get(step.id.as_str()) {
                (step.start_us, step.end_us, step.started) = (start_us, end_us.max(start_us), true);
            } else {
                step.start_us = free_us;
                step.end_us =
                    free_us.saturating_add(planned.get(step.id.as_str()).copied().unwrap_or(0));
                free_us = step.end_us;
            }
        }
        steps
    }

    fn find_stops(&mut self) {
        for step in self.activities.iter().filter(|step| !step.travels()) {
            match self.stops.last_mut() {
                Some(stop) if stop.x_mm >= step.x_start_mm => {
                    stop.end_us = stop.end_us.max(step.end_us);
                    stop.count += 1;
                    stop.reached |= step.started;
                }
                _ => self.stops.push(Stop {
                    x_mm: step.x_start_mm,
                    start_us: step.start_us,
                    end_us: step.end_us,
                    count: 1,
                    reached: step.started,
                }),
            }
        }
    }

    /// Adds what stood in the way, or made the way longer, to the stops: each place once, in the
    /// order of the path.
    fn find_waits(&mut self) {
        self.stops.extend(self.events.iter().filter(|it| it.lost_us > 0).map(|it| Stop {
            x_mm: it.x_mm,
            start_us: it.t_us.saturating_sub(it.lost_us),
            end_us: it.t_us,
            count: 0,
            reached: true,
        }));
        self.stops.sort_by_key(|it| it.x_mm);
        self.stops.dedup_by(|next, stop| {
            let same = next.x_mm == stop.x_mm;
            if same {
                stop.start_us = stop.start_us.min(next.start_us);
                stop.end_us = stop.end_us.max(next.end_us);
                stop.count += next.count;
                stop.reached |= next.reached;
            }
            same
        });
    }

    fn find_stretches(&mut self) {
        let mut current = "";
        for record in &self.trace.records {
            let choice = match record {
                Record::Activity(it) => {
                    current = &it.activity;
                    &it.choice
                }
                // A plan changes the current activity only if it is not done yet.
                Record::Plan(plan) => match plan.plan.first() {
                    Some(row) if row.activity == current => &row.choice,
                    _ => continue,
                },
                _ => continue,
            };
            let from = (record.x_mm(), record.t_us());
            if let Some(last) = self.stretches.last_mut() {
                last.to = from;
            }
            if self.stretches.last().is_none_or(|last| last.choice != *choice) {
                self.stretches.push(Stretch { choice: choice.clone(), from, to: from });
            }
        }
        let end = self.last();
        if let Some(last) = self.stretches.last_mut() {
            last.to = end;
        }
        self.stretches.retain(|stretch| stretch.from != stretch.to);
    }
}

impl Step {
    fn unstarted(id: String, x_start_mm: u64, x_end_mm: u64) -> Self {
        Self { id, x_start_mm, x_end_mm, start_us: 0, end_us: 0, started: false }
    }
}

/// The option that leads a choice: the first of its ids. Choices with the same one are a family.
pub(super) fn family(choice: &str) -> &str {
    choice.split(' ').next().unwrap_or(choice)
}

/// The families of all plans, in the order of their first use; their place is their colour.
pub(super) fn families<'t>(plans: &[&'t Plan]) -> Vec<&'t str> {
    let mut families = Vec::new();
    for row in plans.iter().flat_map(|plan| &plan.plan) {
        let family = family(&row.choice);
        if families.len() < 64 && !families.contains(&family) {
            families.push(family);
        }
    }
    families
}

/// The class of a choice's colour; the text beside it says the same.
pub(super) fn tint(families: &[&str], choice: &str) -> String {
    let place = families.iter().position(|&it| it == family(choice));
    place.filter(|&place| place < 6).map_or("f6".into(), |place| format!("f{place}"))
}
