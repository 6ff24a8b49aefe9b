//! Three at a time do not fit where one was.
cotama_core::net! {
    pub mod store {
        places { Truck: 1, Shelf: 1 of 3 }
        events { Unload }
        transitions { unload on Unload: Truck => Shelf * 3; }
    }
}
