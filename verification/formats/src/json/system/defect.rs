//! Defects of systems in words, with what they are about.

use super::super::name::Misnamed;
use super::Ports;
use cotama_core::system::SystemError;

/// The defect of a system whose nets are sound.
pub(super) fn of_system(defect: SystemError, ports: &Ports<'_>) -> Misnamed {
    match defect {
        SystemError::UnknownId { list: "clears", at } => {
            let name = ports.clears.get(at).map(|it| &it.mailbox);
            let message = "only what comes by mail can be emptied".to_owned();
            Misnamed::about(name, message).help("a link to it says `\"mail\": 1`")
        }
        SystemError::UnknownId { at, .. } => {
            let name = ports.shared.get(at).map(|it| it.of.name());
            let message = "nothing waits for what does not come by mail".to_owned();
            Misnamed::about(name, message).help("a link to it says `\"mail\": 1`")
        }
        SystemError::Unbound(of) => {
            let (net, name) = (ports.net(of.component), ports.place(of));
            let it = name.map_or("", |it| it.as_str());
            let message = format!("the place `{net}.{it}` is shared and belongs to nobody");
            Misnamed::about(name, message).help("an entry of `shared` says whose it is")
        }
        SystemError::Binding { at } => {
            let name = ports.shared.get(at).map(|it| &it.place);
            let it = name.map_or("", |it| it.as_str());
            Misnamed::about(name, format!("`{it}` cannot be this place")).help(
                "its role is `shared`; it is named once, by a place that is not shared itself and \
                 has the same bound, or by a mailbox that holds so many",
            )
        }
        SystemError::Delivery { at } => {
            let name = ports.links.get(at).map(|it| &it.to);
            let it = name.map_or("", |it| it.as_str());
            Misnamed::about(name, format!("links to `{it}` deliver in two ways, or without room"))
                .help("all have the same `mail`, which is at least 1, or none has any")
        }
        SystemError::Circle { component } => {
            let (name, net) = (ports.component(component), ports.net(component));
            let message = format!("what `{net}` says at once comes back to it, or goes on too far");
            Misnamed::about(name, message).help("let one of the links deliver by `mail`")
        }
        SystemError::ChangesMailbox(of) => {
            let (net, name) = (ports.net(of.component), ports.transition(of));
            let it = name.map_or("", |it| it.as_str());
            let message = format!("`{net}.{it}` changes a shared place that is a mailbox");
            Misnamed::about(name, message).help("it can only be read")
        }
        SystemError::Overfills(of) => {
            let (net, name) = (ports.net(of.component), ports.transition(of));
            let it = name.map_or("", |it| it.as_str());
            let message = format!("`{net}.{it}` mails more at once than a mailbox holds");
            Misnamed::about(name, message).help("give the mailbox more room")
        }
        other => Misnamed::about(None, other.to_string()),
    }
}
