//! `cotama allocate`: one bare allocation problem.

pub(crate) mod instance;

use crate::answers::{AllocateAnswer, Status};
use crate::args::{AllocateArgs, AllocatorName, Objective as Wanted};
use crate::exit::{Exit, Failure};
use crate::infeasible;
use crate::input;
use crate::kind::{self, Kind};
use crate::mission;
use crate::output::Screen;
use crate::render;
use crate::solve::{Method, Verdict, solve};
use cotama_core::exact::Objective;
use cotama_core::problem::Problem;
use cotama_models::missions::tables::ENERGY;
use instance::Instance;

/// Solves one allocation problem.
pub(crate) fn allocate(args: &AllocateArgs, screen: &Screen) -> Result<Exit, Failure> {
    let wanted = (args.objective != Wanted::Quality).then_some(args.objective);
    mission::pursued(wanted, Some(args.allocator))?;
    mission::searched(args.allocator == AllocatorName::Panorama, args.steps)?;
    let (limit, wanted) = (input::INSTANCE_BYTES, [Kind::Instance]);
    let text = kind::text(&args.instance, "an instance", limit, &wanted)?;
    let instance = Instance::parse(&args.instance, &text)?;
    drop(text);
    let slices: Vec<_> = instance.activities.iter().map(Vec::as_slice).collect();
    let problem = Problem::new(&slices, instance.limits, [0, 1])
        .map_err(|error| Failure::of(input::name(&args.instance), error.to_string()))?;
    let objective = match args.objective {
        Wanted::MinEnergy => [Objective::Least(ENERGY)],
        _ => [Objective::MostQuality],
    };
    let method = match args.allocator {
        AllocatorName::Exact => Method::Exact(&objective),
        AllocatorName::Panorama => Method::Rule,
    };
    let solution =
        solve(&problem, method, args.steps).map_err(|error| Failure::new(error.to_string()))?;
    let planned = solution.planned();
    let reason = match solution.verdict {
        Verdict::Infeasible { shortfall } => Some(infeasible::short(shortfall, args.steps)),
        Verdict::Missed => Some(infeasible::missed("leave out `--allocator panorama`")),
        _ => None,
    };
    let answer = AllocateAnswer {
        schema: "cotama/allocate/1",
        status: solution.status(),
        quality: planned.map(|it| it.quality),
        duration_ms: planned.map(|it| it.cost[0]),
        energy_mj: planned.map(|it| it.cost[1]),
        bound: solution.bound(),
        steps: solution.steps,
        reason,
        choice: solution.plan,
    };
    if args.json.json {
        Screen::json(&answer)?;
    } else {
        screen.print(&render::allocate::screen(
            &answer,
            problem.limits(),
            args.objective.name(),
            screen.width(),
        ))?;
    }
    Ok(exit(answer.status))
}

/// The exit code of a status.
pub(crate) fn exit(status: Status) -> Exit {
    match status {
        Status::Optimal | Status::Feasible => Exit::Success,
        Status::Infeasible => Exit::Violated,
        Status::Unknown => Exit::Unknown,
    }
}
