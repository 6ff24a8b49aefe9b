//! The sections of a system come in their order.
use cotama_core::{net, system};
net! { pub mod lamp { places { Off: 1, On } events { toggle } transitions { on on toggle: Off =>
    On; } } }
system! {
    pub mod room {
        nets { lamp: lamp }
        links {}
    }
}
