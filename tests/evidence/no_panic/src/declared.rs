//! The roots of what is asked of nets and systems as they are declared.
//!
//! They come as their caller can make them at worst: with any lists, and numbers of nothing.

use cotama_core::net::{EventId, Net, PlaceId, Within};
use cotama_core::system::{Component, Delivery, Of, System, Target};

// `no_mangle` counts as unsafe because two equal names would meet at link time: these begin with
// `root_`, which nothing else does, and the linker starts at one of them at a time.
#[unsafe(no_mangle)]
fn root_within_is_sound(within: Within) -> bool {
    within.is_sound()
}

#[unsafe(no_mangle)]
fn root_system_alone<'s>(net: &'s Net<'s>, component: &'s [Component<'s>; 1]) -> [&'s str; 2] {
    [Component::alone(net).name, System::alone(component).name]
}

#[unsafe(no_mangle)]
fn root_system_read(
    system: &System<'_>,
    event: Of<EventId>,
    place: Of<PlaceId>,
) -> (bool, Option<Delivery>, Option<Target>) {
    (system.is_alone(), system.delivery(event), system.target(place))
}
