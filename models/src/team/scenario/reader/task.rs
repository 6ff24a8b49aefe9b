//! Reading the tasks of a team: plans, roles, and what they need.

use super::{AMOUNTS, Names, among, new_name, not_known, one_of};
use crate::missions::Diagnostic;
use crate::missions::Spanned;
use crate::missions::reader::fields::Fields;
use crate::team::scenario::{Give, Needs, PlanSpec, RoleSpec, Take, TaskSpec};
use crate::team::{Capability, CapabilitySet, MAX_STEPS};
use cotama_core::team::Combine;

/// The most plans of a task, and roles of a plan.
const MOST: usize = 16;

pub(super) fn task(mut fields: Fields<'_>, names: &mut Names) -> Option<TaskSpec> {
    let after = fields.optional_text("after");
    // A task follows one that stands before it, so nothing goes round in a circle.
    let after = match after.ok()? {
        None => Some(None),
        Some(it) => among(&fields, Some(&it), "task before this one", &names.tasks).map(Some),
    };
    let name = new_name(&mut fields, "task", &mut names.tasks);
    let arrival = fields.optional_integer("arrives_ms", AMOUNTS);
    let ends = ["from", "to"].map(|key| {
        let text = fields.text(key);
        names.places.place(&fields, text.as_ref())
    });
    let utility = fields.integer("skip_ms", AMOUNTS);
    let combine = [("sum", Combine::Sum), ("mean", Combine::Mean), ("max", Combine::Max)];
    let combine = one_of(&mut fields, "combine", "way to combine costs", combine);
    let plans = fields.tables_up_to("plan", true, MOST).unwrap_or_default();
    let plans: Vec<_> = plans.into_iter().map(|it| plan(it, names)).collect();
    fields.finish();
    Some(TaskSpec {
        name: name?,
        arrival_ms: arrival.ok()?.unwrap_or(0),
        after: after?,
        start: ends[0]?,
        goal: ends[1]?,
        utility_ms: utility?,
        combine: combine.ok()?.unwrap_or(Combine::Mean),
        plans: plans.into_iter().collect::<Option<_>>()?,
    })
}

fn plan(mut fields: Fields<'_>, names: &Names) -> Option<PlanSpec> {
    let name = fields.text("name");
    let extra = fields.optional_integer("extra_ms", AMOUNTS);
    let roles = fields.tables_up_to("role", true, MOST).unwrap_or_default();
    let roles: Vec<_> = roles.into_iter().map(|it| role(it, names)).collect();
    let span = fields.span_of("role");
    let roles = roles.into_iter().collect::<Option<Vec<_>>>();
    if let Some(why) = roles.as_deref().and_then(broken_chain) {
        let help = "the first role takes the object or says words; each `give` to a partner is \
                    followed by the role that takes it there";
        fields.report(Diagnostic::new(span, why, "these roles").help(help));
    }
    fields.finish();
    Some(PlanSpec { name: name?.value, extra_ms: extra.ok()?.unwrap_or(0), roles: roles? })
}

/// Why the object does not go from role to role; none where it does.
fn broken_chain(roles: &[RoleSpec]) -> Option<String> {
    let gives = |it: &RoleSpec| match it.give {
        Give::Partner(place) => Some(place),
        _ => None,
    };
    let takes = |it: &RoleSpec| match it.take {
        Take::Partner(place) => Some(place),
        _ => None,
    };
    let first = roles.first().filter(|it| takes(it).is_some());
    let last = roles.last().filter(|it| gives(it).is_some());
    let between = roles.windows(2).find(|it| gives(&it[0]) != takes(&it[1]));
    let alone = first.or(last).or(between.map(|it| &it[0]))?;
    Some(format!("the role `{}` has no partner for what it gives or takes", alone.name))
}

fn role(mut fields: Fields<'_>, names: &Names) -> Option<RoleSpec> {
    let name = fields.text("name");
    let actions = if fields.has("actions") {
        let lists = fields.lists_of_texts("actions", MAX_STEPS);
        lists.map(|all| all.iter().map(|it| needs(&fields, it, names)).collect::<Vec<_>>())
    } else {
        fields.texts("needs").map(|it| vec![needs(&fields, &it, names)])
    };
    let take =
        end(&mut fields, "take", &[("object", Some(Take::Object)), ("words_at", None)], names);
    let take = take.map(|it| match it {
        End::Word(it) => it,
        End::Partner(place) => Take::Partner(place),
        End::Words(place) => Take::Words(place),
    });
    let known = [("goal", Some(Give::Goal)), ("nobody", Some(Give::Nobody))];
    let give = end(&mut fields, "give", &known, names).and_then(|it| match it {
        End::Word(it) => Some(it),
        End::Partner(place) => Some(Give::Partner(place)),
        End::Words(_) => None,
    });
    let times = ["take_ms", "give_ms"].map(|key| fields.integer(key, AMOUNTS));
    fields.finish();
    Some(RoleSpec {
        name: name?.value,
        actions: actions?.into_iter().collect::<Option<_>>()?,
        take: take?,
        give: give?,
        take_ms: times[0]?,
        give_ms: times[1]?,
    })
}

/// The source or the target of an object.
enum End<T> {
    Word(T),
    Partner(crate::team::scenario::Place),
    Words(crate::team::scenario::Place),
}

/// A word, or a table with `partner_at` or `words_at` a place; the latter where it is known.
fn end<T: Copy>(
    fields: &mut Fields<'_>,
    key: &'static str,
    known: &[(&'static str, Option<T>)],
    names: &Names,
) -> Option<End<T>> {
    if fields.is_table(key) {
        let mut table = fields.table(key)?;
        let words = known.iter().any(|it| it.0 == "words_at") && table.has("words_at");
        let at = table.text(if words { "words_at" } else { "partner_at" });
        let place = names.places.place(&table, at.as_ref());
        table.finish();
        return Some(if words { End::Words(place?) } else { End::Partner(place?) });
    }
    let found = fields.text(key)?;
    let words = known.iter().filter(|it| it.1.is_some());
    let at = fields.index_of(&found, "word here", words.clone().map(|it| it.0))?;
    words.clone().nth(at).and_then(|it| it.1).map(End::Word)
}

/// The sets of which one skill each is needed: `move`, `hand | gripper`.
fn needs(fields: &Fields<'_>, texts: &[Spanned<String>], names: &Names) -> Option<Needs> {
    let any = |text: &Spanned<String>| {
        let each = text.value.split('|').map(str::trim).map(|name| {
            let at = names.skills.iter().position(|it| it == name);
            if at.is_none() {
                not_known(fields, name, text.span.clone(), "skill", &names.skills);
            }
            at.and_then(|it| Capability::new(u8::try_from(it).ok()?))
        });
        let each = each.collect::<Vec<_>>().into_iter().collect::<Option<Vec<_>>>()?;
        Some(CapabilitySet::of(&each))
    };
    let all: Vec<_> = texts.iter().map(any).collect();
    all.into_iter().collect::<Option<_>>().map(Needs)
}
