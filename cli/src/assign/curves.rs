//! `cotama assign --curves`: how the work of a coalition grows with the team.

use crate::answers::curves::{
    BenchmarkRow, BoundsRow, CapableRow, CurveRow, CurvesAnswer, MessagesRow,
};
use crate::args::AssignArgs;
use crate::exit::{Exit, Failure};
use crate::output::{self, Screen};
use crate::render;
use cotama_models::team::curves::{Benchmark, Growth, PayOff, benchmark, growth};
use cotama_pages::curves::{self as page, Curves, Messages};
use cotama_sim::fleet::scenarios::{Worst, worst};
use cotama_sim::fleet::{Kind, run};

/// Counts the work of teams of up to so many robots.
pub(super) fn curves(args: &AssignArgs, most: u64, screen: &Screen) -> Result<Exit, Failure> {
    let report = args.report.as_deref();
    report.map_or(Ok(()), output::report)?;
    let teams = || 2..=most as usize;
    let curves = Curves {
        growth: teams().map(|it| (growth(it), messages(it))).collect(),
        benchmark: teams().flat_map(|it| (0..=it).map(move |own| benchmark(it, own))).collect(),
    };
    let mut answer = CurvesAnswer {
        schema: "cotama/assign-curves/1",
        growth: curves.growth.iter().map(growth_row).collect(),
        benchmark: curves.benchmark.iter().map(benchmark_row).collect(),
        report: None,
    };
    if let Some(folder) = report {
        output::make_folder(folder)?;
        let path = folder.join("index.html");
        output::file(&path, page::html(&curves).as_bytes())?;
        answer.report = Some(path.display().to_string());
    }
    if args.json.json {
        Screen::json(&answer)?;
    } else {
        screen.print(&render::curves::screen(&answer, screen.width()))?;
    }
    Ok(Exit::Success)
}

/// Messages of a round, counted in a run.
fn messages(robots: usize) -> Messages {
    use Kind::{Ack, Announce, Assign, Bid, Reply, Request};
    let sent = |case| {
        let run = run(&worst(case, robots));
        [Announce, Request, Reply, Bid, Assign, Ack].into_iter().map(|it| run.sent(it)).sum()
    };
    Messages {
        singles: sent(Worst::Singles),
        central: sent(Worst::Together),
        distributed: sent(Worst::TogetherDistributed),
    }
}

fn growth_row((it, sent): &(Growth, Messages)) -> CurveRow {
    CurveRow {
        robots: it.robots,
        coalitions: it.coalitions,
        central_steps: it.central,
        distributed_steps: it.distributed,
        orderings: it.orderings,
        assignment_steps: it.assignment,
        bounds: BoundsRow {
            central_steps: it.bounds.central,
            distributed_steps: it.bounds.distributed,
            orderings: it.bounds.orderings,
            size_limit_permille: it.bounds.share_permille,
            steps_a_message: it.bounds.steps_a_message,
        },
        messages: MessagesRow {
            singles: sent.singles,
            central: sent.central,
            distributed: sent.distributed,
        },
        steps_a_message: sent.steps_a_message(it),
    }
}

fn benchmark_row(it: &Benchmark) -> BenchmarkRow {
    let condition = |(name, own): (&'static str, PayOff)| CapableRow {
        name,
        passed: own.passed,
        passed_permille: it.share_permille(own.passed),
        rule_permille: own.rule_permille,
        steps: own.steps,
        pays: own.pays,
    };
    BenchmarkRow {
        robots: it.robots,
        capable: it.capable,
        coalitions: it.all.coalitions,
        steps: it.all.steps,
        capable_steps: it.all.steps_capable(),
        busiest_steps: it.busiest,
        conditions: ["cap1", "cap2", "cap3"]
            .into_iter()
            .zip(it.pay_offs())
            .map(condition)
            .collect(),
    }
}
