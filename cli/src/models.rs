//! `cotama models`: what models there are, and what is known of one.

pub(crate) mod law;

use crate::answers::model::{
    ComponentRow, LawRow, ModelKind, ModelRow, ModelsAnswer, NumbersRow, Shown, SignalRow,
};
use crate::args::ModelsArgs;
use crate::catalogue::{self, Entry, Kind};
use crate::exit::{Exit, Failure};
use crate::model::{self, Found};
use crate::output::Screen;
use crate::render;
use cotama_core::net::owned::OwnedNet;
use cotama_core::net::{Known, Net, Role, Signal};
use cotama_core::system::System;
use cotama_models::nets::families::Family;

/// Shows all models, or one.
pub(crate) fn models(args: &ModelsArgs, screen: &Screen) -> Result<Exit, Failure> {
    let Some(name) = &args.name else {
        let entries = catalogue::entries();
        let answer = answer(entries.iter().map(entry_row).collect());
        return said(args, screen, &answer, || {
            render::models::table(&answer, &entries, screen.width())
        });
    };
    let family = catalogue::entry(name).filter(|it| matches!(it.kind, Kind::Family(_)));
    let (row, net) = match family {
        Some(family) => (entry_row(&family), None),
        None => match model::find(name)? {
            Found::System(system) => (system_row(system), None),
            // A robot or a mission is known by the name that it was asked by.
            Found::Owned(it) => {
                (ModelRow { name: name.clone(), ..it.system.with(system_row) }, None)
            }
            Found::Net(it) => {
                let known = it.known;
                let net = it.plain(name, "listed")?;
                (net_row(name, &net.view().net(), known), Some(net))
            }
            Found::Time(net) => {
                let net = model::played(name, &net)?;
                (net_row(name, &net.view().net(), None), Some(net))
            }
        },
    };
    let answer = answer(vec![row]);
    said(args, screen, &answer, || {
        render::models::one(&answer.models[0], net.as_ref(), screen.width())
    })
}

fn answer(models: Vec<ModelRow>) -> ModelsAnswer {
    ModelsAnswer { schema: "cotama/models/1", models }
}

fn said(
    args: &ModelsArgs,
    screen: &Screen,
    answer: &ModelsAnswer,
    text: impl FnOnce() -> String,
) -> Result<Exit, Failure> {
    if args.json.json {
        Screen::json(answer)?;
    } else {
        screen.print(&text())?;
    }
    Ok(Exit::Success)
}

fn entry_row(entry: &Entry) -> ModelRow {
    match entry.kind {
        Kind::Net(net, known) => net_row(entry.name, net, Some(known)),
        Kind::Family(family) => family_row(family),
        Kind::System(system) => system_row(system),
    }
}

fn net_row(name: &str, net: &Net<'_>, known: Option<Known>) -> ModelRow {
    let shown = match known {
        Some(Known::Explored { .. }) => Shown::WhileCompiling,
        Some(Known::LeftToChecker) => Shown::LeftToChecker,
        None => Shown::Claimed,
    };
    let (states, firings, settle) = match known {
        Some(Known::Explored { markings, firings, settle }) => {
            (Some(markings as u64), Some(firings as u64), Some(settle))
        }
        _ => (None, None, None),
    };
    ModelRow {
        name: name.to_owned(),
        kind: ModelKind::Net,
        description: net.doc.to_owned(),
        places: Some(net.places.len() as u64),
        transitions: Some(net.transitions.len() as u64),
        timed: Some(timed(net)),
        states,
        firings,
        settle,
        laws: net.laws.iter().map(|it| LawRow { law: law::text(net, it), shown }).collect(),
        events: net.events.iter().map(signal).collect(),
        outputs: net.outputs.iter().map(signal).collect(),
        numbers: None,
        components: vec![],
    }
}

fn family_row(family: &Family) -> ModelRow {
    let numbers = Some(NumbersRow { least: family.least, most: family.most });
    let nothing = OwnedNet::new(family.name, family.description);
    ModelRow {
        kind: ModelKind::Family,
        places: None,
        transitions: None,
        timed: None,
        numbers,
        ..net_row(family.name, &nothing.view().net(), None)
    }
}

fn system_row(system: &System<'_>) -> ModelRow {
    let nets = || system.components.iter().map(|it| it.net);
    let own = |net: &Net<'_>| {
        // The complement of a shared place is as shared as the place.
        let shared = |role: Role| match role {
            Role::Shared => true,
            Role::Complement(of) => {
                net.places.get(of.0 as usize).is_some_and(|of| of.role == Role::Shared)
            }
            _ => false,
        };
        net.places.iter().filter(|place| !shared(place.role)).count() as u64
    };
    let component = |it: &cotama_core::system::Component<'_>| ComponentRow {
        name: it.name.to_owned(),
        net: it.net.name.to_owned(),
    };
    let nothing = OwnedNet::new(system.name, system.doc);
    ModelRow {
        kind: ModelKind::System,
        places: Some(nets().map(own).sum()),
        transitions: Some(nets().map(|net| net.transitions.len() as u64).sum()),
        timed: Some(nets().map(timed).sum()),
        components: system.components.iter().map(component).collect(),
        ..net_row(system.name, &nothing.view().net(), None)
    }
}

fn timed(net: &Net<'_>) -> u64 {
    net.transitions.iter().filter(|it| it.within.is_some()).count() as u64
}

fn signal(signal: &Signal<'_>) -> SignalRow {
    SignalRow { name: signal.name.to_owned(), doc: signal.doc.to_owned() }
}
